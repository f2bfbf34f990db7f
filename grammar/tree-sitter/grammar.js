/**
 * The Setpiece language for tree-sitter.
 *
 * The same shapes as ../src/setpiece.pest, which decides; the word lists are held to it by a test
 * (tests/tests/highlighting.rs). Words that only some places know (`left`, `ball`, `all`) are names elsewhere.
 */
const ROLES = ["GK", "CB", "LB", "RB", "DM", "CM", "LM", "RM", "AM", "CF"];
const EVENTS = [
  "advantage", "assist", "ball_lost", "ball_won", "catch", "corner", "foul", "free_kick", "full_time", "goal_kick", "goal",
  "half_time", "handball", "header", "interception", "kickoff", "offside", "out_of_play", "own_goal", "parry", "pass",
  "penalty", "red_card", "save", "shot", "slide", "tackle", "throw_in", "touch", "woodwork", "yellow_card",
];
const QUALIFIERS = ["attempted", "completed", "intercepted", "on_target", "off_target", "blocked", "taken"];
const UNITS = ["m/s", "km/h", "deg", "rad", "ms", "m", "s", "%"];
const LONG_UNITS = ["steps", "step", "episodes", "episode"];
const OVER_TIME = ["count", "max", "min", "mean", "sum", "first", "last", "series"];

const PREC = { or: 1, and: 2, not: 3, compare: 4, set: 5, sum: 6, term: 7, unary: 8, member: 9 };
const NUMBER = "[0-9]+(_[0-9]+)*(\\.[0-9]+)?(e[+-]?[0-9]+)?";

const list = (rule) => seq(rule, repeat(seq(",", rule)), optional(","));
const block = (statement) => seq("{", repeat(seq(statement, optional(","))), "}");
const escaped = (words) => words.map((word) => word.replace("/", "\\/")).join("|");

module.exports = grammar({
  name: "setpiece",
  word: ($) => $.identifier,
  extras: ($) => [/[\s;\uFEFF\u00A0]/, $.line_comment, $.block_comment, $.doc_comment],
  conflicts: ($) => [
    [$.give],
    [$._key, $.player],
    [$._name, $.argument],
    [$._expression, $.parameter],
  ],
  inline: ($) => [$._body],

  rules: {
    file: ($) => repeat(seq($._item, optional(","))),

    // ---------------------------------------------------------------- words

    line_comment: ($) => token(choice(seq("//", /[^\/\n]?[^\n]*/), seq("////", /[^\n]*/))),
    block_comment: ($) => token(seq("/*", /([^*]|\*+[^*\/])*/, /\*+\//)),
    doc_comment: ($) => token(prec(1, seq("///", /([^\/\n][^\n]*)?/))),
    identifier: ($) => /[A-Za-z_][A-Za-z0-9_]*/,
    free_name: ($) => token(prec(-1, /[0-9]*[A-Za-z_][A-Za-z0-9_]*/)),
    role: ($) => choice(...ROLES),
    boolean: ($) => choice("true", "false"),
    string: ($) => token(seq('"', /([^"\\\n]|\\.)*/, '"')),
    raw_string: ($) => token(prec(1, seq('"""', /([^"]|"[^"]|""[^"])*/, '"""'))),
    quantity: ($) => choice(
      token(new RegExp(NUMBER)),
      token(prec(1, new RegExp(`${NUMBER}(${escaped(UNITS)})`))),
      token(prec(1, new RegExp(`${NUMBER}[ \\t]*(${escaped(LONG_UNITS)})`))),
    ),
    type: ($) => token(prec(-2, /[A-Za-z_][A-Za-z0-9_]*\?/)),
    _type: ($) =>
      seq(choice($.identifier, $.type, "behavior", "formation", "region"), optional(token.immediate("?"))),
    _key: ($) => choice($.identifier, "left", "right", "ball", "formation", "state", "start"),
    _named: ($) => choice($.identifier, $.free_name),

    // ---------------------------------------------------------------- expressions

    _value: ($) => choice($._expression, $.switch),
    switch: ($) => choice("on", "off"),
    _expression: ($) => choice(
      $.if_expression, $.binary_expression, $.unary_expression, $.has_ball, $.changes, $.member, $.own, $.tuple,
      $.list, $.call, $.over_time, $.event, $.quantity, $.boolean, $.string, $.role, $._name,
    ),
    _name: ($) => choice(
      $.identifier, alias(choice("left", "right", "ball", "all", ...OVER_TIME), $.identifier),
    ),
    if_expression: ($) => prec.right(seq(
      "if", $._expression, "then", $._expression, "else", $._expression,
    )),
    binary_expression: ($) => choice(
      ...[
        [PREC.or, "or"], [PREC.and, "and"], [PREC.compare, "in"], [PREC.compare, "=="], [PREC.compare, "!="],
        [PREC.compare, "<="], [PREC.compare, ">="], [PREC.compare, "<"], [PREC.compare, ">"], [PREC.set, "|"],
        [PREC.set, "&"], [PREC.sum, "+"], [PREC.sum, "-"], [PREC.term, "*"], [PREC.term, "/"],
      ].map(([level, sign]) => prec.left(level, seq($._expression, sign, $._expression))),
    ),
    unary_expression: ($) => choice(
      prec(PREC.not, seq("not", $._expression)),
      prec(PREC.unary, seq(choice("-", "+"), $._expression)),
    ),
    has_ball: ($) => prec(PREC.compare, seq($._expression, "has", "ball")),
    changes: ($) => prec.right(PREC.compare, seq($._expression, "changes", optional(seq("to", $._expression)))),
    member: ($) => prec(PREC.member, seq($._expression, ".", choice($.identifier, $.role))),
    own: ($) => prec.right(PREC.member, seq("own", choice($.tuple, repeat1(seq(".", choice($.identifier, $.role)))))),
    tuple: ($) => seq("(", $._expression, repeat(seq(",", $._expression)), ")"),
    list: ($) => seq("[", optional(list($._expression)), "]"),
    call: ($) => prec(PREC.member + 1, seq(
      field("function", choice($.callee, $.member)), token.immediate("("), optional(list($.argument)), ")",
    )),
    callee: ($) => choice($.identifier, alias(choice("all", "until", ...OVER_TIME), $.identifier)),
    argument: ($) => choice(
      seq(field("name", $.identifier), ":", $._value),
      seq($._expression, optional(choice(
        seq(":", $._expression),
        seq("for", $.identifier, "in", $._expression, optional($._filter)),
        $._filter,
      ))),
    ),
    _filter: ($) => seq("where", $._expression),
    over_time: ($) => prec.right(seq(choice(...OVER_TIME), "of", choice($.end_event, $._expression))),

    // ---------------------------------------------------------------- events

    event_name: ($) => choice(...EVENTS),
    event: ($) => prec.right(seq(
      $.event_name, optional($.qualifier), optional(seq("by", $._expression)), optional(seq("to", $._expression)),
      optional(seq("from", $._expression)),
    )),
    qualifier: ($) => choice(...QUALIFIERS),
    end_event: ($) => prec.right(seq("end", optional(choice("success", "failure")))),
    _events: ($) => prec.left(seq(choice($.event, $.end_event), repeat(seq("or", choice($.event, $.end_event))))),

    // ---------------------------------------------------------------- items

    _item: ($) => choice(
      $.import, $.scenario, $.reward, $.formation, $.constant, $.function, $.region, $.table, $.ending, $.behavior, $.suite, $.check, $.curriculum,
    ),
    import: ($) => seq("import", $.string, optional(seq("as", $.identifier))),
    constant: ($) => seq("const", field("name", $.identifier), optional($._annotation), "=", $._value),
    function: ($) => seq("fn", field("name", $.identifier), $.parameters, optional(seq("->", field("type", $._type))), "=", $._value),
    table: ($) => seq("table", field("name", $.identifier), optional(seq("over", $._expression)), choice(seq("from", $.string), seq("=", $._expression))),
    region: ($) => seq("region", field("name", $.identifier), optional($.parameters), "=", $._expression),
    ending: ($) => seq("ending", field("name", $.identifier), optional($.parameters), "=", $._expression),
    behavior: ($) => seq("behavior", field("name", $.identifier), optional($.parameters), choice($.script, $.opaque)),
    // Kept as text: its words are still words of the language.
    opaque: ($) => seq("{", repeat(choice($._word, $.opaque, $.string, $.quantity, $.role, /[^{}"A-Za-z0-9_\s]/)), "}"),
    _word: ($) => choice(
      $.identifier, "choose", "finish", "repeat", "sprinting", "times", "if", "else", "let", "state", "script", "do", "until", "interrupt", "when", "for", "in", "with", "on", "off", "to", "by",
    ),
    _annotation: ($) => seq(":", field("type", $._type)),
    _extends: ($) => seq("extends", $.reference),
    reference: ($) => prec.right(seq(
      field("name", $._named), repeat(seq(token.immediate("."), $._named)),
      optional(seq(token.immediate("("), optional(list($.argument)), ")")),
    )),
    parameters: ($) => seq("(", optional(list($.parameter)), ")"),
    parameter: ($) => seq(
      field("name", $.identifier), optional($._annotation), optional(seq("=", choice($.switch, $._expression))),
      optional(seq("in", choice($.list, $.range))),
    ),
    range: ($) => seq($._expression, "..", $._expression),

    // ---------------------------------------------------------------- levels

    suite: ($) => seq("suite", field("name", $.identifier), $._suite_body),
    _suite_body: ($) => block(choice($.sweep, $.entry)),
    sweep: ($) => seq("each", field("name", $.identifier), "in", $.list, $._suite_body),
    entry: ($) => seq($.reference, $.episodes),
    episodes: ($) => prec.right(seq(
      "for", $._expression, optional("episodes"), optional(seq("seed", $._expression)),
    )),
    check: ($) => seq("check", $.string, block(choice($.play, $.expect))),
    play: ($) => prec.right(seq(
      "play", $.reference, optional(seq("with", $.identifier)), $.episodes, optional(seq("over", "params")),
    )),
    expect: ($) => seq("expect", choice(seq("never", $.identifier), $.goal)),
    curriculum: ($) => seq("curriculum", field("name", $.identifier), block(choice($.stage, $.mix))),
    stage: ($) => prec.right(seq(
      "stage", field("name", $.identifier), "=", $.reference,
      optional(choice(seq("until", $.goal, repeat(seq("or", $.goal))), $.adapt)),
    )),
    adapt: ($) => prec.right(seq(
      "adapt", field("name", $.identifier), "from", $._expression, "to", $._expression, "keeping", $.measure, "in",
      $.range,
    )),
    mix: ($) => seq("mix", "current", ":", $._expression, optional(","), "earlier", ":", $._expression),
    goal: ($) => prec.right(PREC.compare, seq(
      $.measure, choice("<", "<=", ">", ">=", "==", "!="), $._expression,
    )),
    measure: ($) => prec.right(seq($._measured, optional(seq("(", list($.measured), ")")))),
    measured: ($) => choice(
      seq($._measured, ":", $._expression), seq($._measured, choice($.string, $.identifier)), $._expression,
    ),
    _measured: ($) => choice($.identifier, alias(choice(...OVER_TIME), $.identifier)),

    // ---------------------------------------------------------------- scenarios

    scenario: ($) => seq(
      optional("abstract"), "scenario", field("name", $._named), optional($.parameters), optional($._extends),
      block($._scenario_statement),
    ),
    _scenario_statement: ($) => choice(
      $.param, $.let, $.constant, $.region, $.rules, $.world, $.pitch, $.agents, $.ball, $.team, $.kickoff, $.start,
      $.reward_use, $.end, $.rounds, $.substitute, $.require, $.record, $.remove, $.mirror, $.observe,
    ),
    param: ($) => seq("param", $.parameter),
    let: ($) => seq("let", choice(
      seq(field("name", $.identifier), optional($._annotation), "=", $._value),
      seq("(", $.identifier, repeat1(seq(",", $.identifier)), ")", "=", $._expression),
    )),
    rules: ($) => seq("rules", $.fields),
    world: ($) => seq("world", $.fields),
    pitch: ($) => seq("pitch", $.fields),
    agents: ($) => seq("agents", $.fields),
    ball: ($) => seq("ball", $._place, optional($.jitter), optional($.fields)),
    team: ($) => seq("team", choice("left", "right"), block($._team_statement)),
    kickoff: ($) => seq("kickoff", $._expression, optional($.fields)),
    start: ($) => seq(
      "start", choice($.identifier, alias(choice(...EVENTS), $.identifier)), optional(seq("for", $._expression)),
      optional(seq("at", $._expression)), optional($.fields),
    ),
    require: ($) => seq("require", $._expression, optional(seq("with", $._expression)), optional($.label)),
    record: ($) => seq("record", field("name", $.identifier), "=", $._expression),
    remove: ($) => seq("remove", choice(
      seq(choice("reward", "end", "require", "record", "substitute"), choice($.identifier, $.string)),
      "ball", "rounds", "world", "pitch", "start", "observe",
    )),
    substitute: ($) => seq("substitute", $._expression, "when", $._expression, optional($.fields)),
    rounds: ($) => seq("rounds", $._expression, "when", $._expression),
    mirror: ($) => seq("mirror", ":", $.identifier),
    _sight: ($) => seq(choice("noise", "when", "delayed", "stack"), $._expression),
    observe: ($) => seq("observe", "vector", block(seq($._expression, repeat($._sight), optional($.label)))),
    end: ($) => seq("end", choice(
      seq("limit", $._expression),
      choice("success", "failure"),
      seq(optional(choice("success", "failure")), choice($._trigger, seq($.reference, optional($._trigger)))),
    )),
    _trigger: ($) => choice(seq("when", $._expression), $.script),
    reward_use: ($) => seq(
      "reward", choice(
        seq($.script, optional($._audience)),
        seq(field("name", $.identifier), $._body),
        seq($.reference, optional(seq($._audience, optional($._body)))),
      ), optional($._naming),
      optional(seq("*", $._expression)),
    ),
    _audience: ($) => seq("for", $._expression),
    label: ($) => seq("as", $.string),
    labels: ($) => seq("as", "[", $.string, repeat(seq(",", $.string)), optional(","), "]"),
    _naming: ($) => choice($.label, $.labels),
    script: ($) => seq("script", choice($.string, seq("rhai", $.raw_string))),
    fields: ($) => block($.field),
    field: ($) => seq(field("key", $._key), ":", choice($.fields, $.script, $._value)),

    // ---------------------------------------------------------------- teams

    formation: ($) => seq(
      "formation", field("name", $.identifier), optional($.parameters), optional($._extends), block($._team_statement),
    ),
    _team_statement: ($) => choice($.moved, $.each, $.absent, $.player, $.field),
    moved: ($) => seq(
      "place", choice($.role, $.identifier), $._place, optional($._turned), optional($.fields),
    ),
    each: ($) => seq("each", choice("outfield", "all", $.role), $.fields),
    absent: ($) => seq($.role, "absent"),
    player: ($) => prec.right(seq(
      optional(seq("maybe", $._point)), optional(seq(field("name", $.identifier), ":")),
      optional(seq(optional(seq($.quantity, "..")), $.quantity)), $.role, optional($._place),
      optional($._turned), optional(seq("when", $._expression)), optional($.fields),
    )),
    _turned: ($) => choice(seq($.facing, optional($.jitter)), seq($.jitter, optional($.facing))),
    facing: ($) => seq("facing", optional(seq("away", "from")), $._expression),
    jitter: ($) => seq("jitter", $._expression),
    _place: ($) => choice(
      seq("at", $._expression),
      seq("in", $._expression),
      seq(choice("behind", seq(choice("ahead", "left", "right"), "of")), $._expression, "by", $._expression),
      prec.right(seq("between", $._point, "and", $._point, optional(seq("at", $._expression)))),
      seq("beyond", $._expression, "by", $._expression, "from", $._expression),
      seq("offset", "from", $._expression, "along", $._expression, "by", $._expression),
    ),
    // Binds tighter than `and`.
    _point: ($) => prec(PREC.sum, $._expression),

    // ---------------------------------------------------------------- rewards

    reward: ($) => seq(
      "reward", field("name", $.identifier), optional($.parameters), optional($._extends), $._body,
    ),
    _body: ($) => block($._reward_statement),
    _reward_statement: ($) => choice($.state, $.let, $.give, $.on_block, $.when_block, $.assign),
    state: ($) => seq("state", field("name", $.identifier), optional($._annotation), "=", $._value),
    assign: ($) => seq(field("name", $.identifier), "=", $._value),
    // `on` and `when` behind a `give` may begin a block of their own, which its brace decides.
    give: ($) => seq(
      "give", choice($.script, $._expression), optional(seq("to", $._expression)),
      optional(seq("per", "second")), optional("once"), optional($._naming),
      optional(choice(
        seq("on", $._events, optional(seq("when", $._expression))),
        seq("when", $._expression, optional(seq("on", $._events))),
      )),
      optional($._naming),
    ),
    on_block: ($) => seq("on", $._events, optional(seq("when", $._expression)), $._body),
    when_block: ($) => prec.right(seq(
      "when", $._expression, $._body, repeat(seq("else", "when", $._expression, $._body)), optional(seq("else", $._body)),
    )),
  },
});
