; Colours of the Setpiece language. A later pattern wins, so the general ones come first.

(identifier) @variable
(line_comment) @comment
(block_comment) @comment
(doc_comment) @comment.documentation
(string) @string
(raw_string) @string.special
(quantity) @number
(boolean) @boolean
(role) @constant.builtin
(event_name) @constant.builtin
(qualifier) @constant.builtin
(type) @type
(callee (identifier) @function.call)
(label (string) @label)
(labels (string) @label)

(scenario name: (_) @type.definition)
(scenario (reference name: (_) @type))
(reward name: (_) @function)
(reward_use name: (_) @function)
(reward_use (reference name: (_) @function))
(formation name: (_) @function)
(region name: (_) @constant)
(table name: (_) @constant)
(ending name: (_) @function)
(end (reference name: (_) @function))
(behavior name: (_) @function)
(function name: (_) @function)
(function type: (_) @type)
(constant name: (_) @constant)
(constant type: (_) @type)
(let name: (_) @variable)
(let type: (_) @type)
(state name: (_) @variable)
(state type: (_) @type)
(record name: (_) @property)
(parameter name: (_) @variable.parameter)
(parameter type: (_) @type)
(suite name: (_) @constant)
(sweep name: (_) @variable.parameter)
(curriculum name: (_) @constant)
(stage name: (_) @constant)
(player name: (_) @variable)
(field key: (_) @property)
(argument name: (_) @property)
(member (identifier) @property .)
(call function: (member (identifier) @function.call .))

[
  "abstract" "scenario" "reward" "formation" "behavior" "region" "table" "ending" "const" "fn" "let" "param"
  "state" "record" "curriculum" "suite" "check" "import"
] @keyword

[
  "absent" "adapt" "agents" "ahead" "all" "along" "as" "at" "away" "ball" "behind" "between" "beyond" "by"
  "choose" "current" "delayed" "do" "each" "earlier" "else" "end" "episodes" "expect" "extends" "facing" "failure" "finish" "for" "from" "give" "if" "interrupt"
  "jitter" "keeping" "kickoff" "left" "limit" "maybe" "mirror" "mix" "never" "noise" "observe" "of" "off" "offset" "on" "once" "outfield"
  "over" "own" "params" "per" "pitch" "place" "play" "remove" "repeat" "require" "rhai" "right" "rounds" "rules" "script" "second" "seed" "sprinting" "stack" "stage" "start" "substitute" "success"
  "team" "then" "times" "to" "until" "vector" "when" "where" "with" "world"
] @keyword.control

[
  "and" "or" "not" "in" "has" "changes"
] @keyword.operator

["=" "==" "!=" "<" "<=" ">" ">=" "+" "-" "*" "/" "|" "&" "->" ".."] @operator
["(" ")" "[" "]" "{" "}"] @punctuation.bracket
["," ":" "."] @punctuation.delimiter
