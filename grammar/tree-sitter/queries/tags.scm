; The names that a file declares, with the comment above, and those that it uses.

(
  (doc_comment)* @doc
  .
  (scenario name: (_) @name) @definition.class
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  (reward name: (_) @name) @definition.function
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  (function name: (_) @name) @definition.function
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  (ending name: (_) @name) @definition.function
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  (behavior name: (_) @name) @definition.function
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  (formation name: (_) @name) @definition.class
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  [
    (region name: (_) @name)
    (table name: (_) @name)
    (constant name: (_) @name)
    (param (parameter name: (_) @name))
  ] @definition.constant
  (#strip! @doc "^///\\s*")
)
(
  (doc_comment)* @doc
  .
  [
    (suite name: (_) @name)
    (curriculum name: (_) @name)
  ] @definition.module
  (#strip! @doc "^///\\s*")
)

(scenario (reference name: (_) @name) @reference.class)
(formation (reference name: (_) @name) @reference.class)
(entry (reference name: (_) @name) @reference.class)
(play (reference name: (_) @name) @reference.class)
(stage (reference name: (_) @name) @reference.class)
(reward (reference name: (_) @name) @reference.call)
(reward_use (reference name: (_) @name) @reference.call)
(end (reference name: (_) @name) @reference.call)
(callee (identifier) @name) @reference.call
