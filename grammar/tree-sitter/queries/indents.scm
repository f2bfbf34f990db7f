; Lines between braces, brackets and parentheses stand one level deeper. The names are Neovim's;
; `cargo xtask editors` translates them for other editors.

(_ "{" "}" @indent.end) @indent.begin
(_ "[" "]" @indent.end) @indent.begin
(_ "(" ")" @indent.end) @indent.begin
["}" "]" ")"] @indent.branch
