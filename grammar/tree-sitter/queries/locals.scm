; Where a name may be used, and what declares it.

(file) @local.scope
(scenario) @local.scope
(reward) @local.scope
(reward_use) @local.scope
(on_block) @local.scope
(when_block) @local.scope
(formation) @local.scope
(function) @local.scope
(region) @local.scope
(ending) @local.scope
(behavior) @local.scope
(sweep) @local.scope

(parameter name: (identifier) @local.definition)
(let name: (identifier) @local.definition)
(state name: (identifier) @local.definition)
(constant name: (identifier) @local.definition)
(region name: (identifier) @local.definition)
(table name: (identifier) @local.definition)
(player name: (identifier) @local.definition)
(sweep name: (identifier) @local.definition)

(identifier) @local.reference
