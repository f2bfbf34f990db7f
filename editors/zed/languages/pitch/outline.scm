(scenario "scenario" @context name: (_) @name) @item
(reward "reward" @context name: (_) @name) @item
(reward_use "reward" @context name: (_) @name) @item
(formation "formation" @context name: (_) @name) @item
(region "region" @context name: (_) @name) @item
(table "table" @context name: (_) @name) @item
(ending "ending" @context name: (_) @name) @item
(behavior "behavior" @context name: (_) @name) @item
(function "fn" @context name: (_) @name) @item
(constant "const" @context name: (_) @name) @item
(suite "suite" @context name: (_) @name) @item
(check "check" @context (string) @name) @item
(curriculum "curriculum" @context name: (_) @name) @item
(stage "stage" @context name: (_) @name) @item
(param "param" @context (parameter name: (_) @name)) @item
(team "team" @context ["left" "right"] @name) @item
(player name: (_) @name (role) @context) @item
