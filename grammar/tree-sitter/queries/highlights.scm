; Colours of the Setpiece language.

(line_comment) @comment
(block_comment) @comment
(doc_comment) @comment.documentation
(string) @string
(raw_string) @string.special
(quantity) @number
(boolean) @boolean
(role) @constant.builtin
(qualifier) @constant
(type) @type
(callee) @function.call
(label) @label
(labels) @label

(scenario name: (_) @type.definition)
(reward name: (_) @function)
(formation name: (_) @function)
(region name: (_) @constant)
(table name: (_) @constant)
(ending name: (_) @function)
(behavior name: (_) @function)
(function name: (_) @function)
(constant name: (_) @constant)
(record name: (_) @property)
(parameter name: (_) @variable.parameter)
(suite name: (_) @constant)
(curriculum name: (_) @constant)
(stage name: (_) @constant)
(player name: (_) @variable)
(field key: (_) @property)
(argument name: (_) @property)
(member (identifier) @property)
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
