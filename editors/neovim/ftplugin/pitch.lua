-- Options of buffers with scenarios.
vim.bo.commentstring = "// %s"
vim.bo.comments = ":///,://"
vim.bo.expandtab = true
vim.bo.shiftwidth = 4
vim.bo.tabstop = 4
vim.bo.indentexpr = "v:lua.require'setpiece'.indent(v:lnum)"
vim.bo.indentkeys = "0},0],0),!^F,o,O"
vim.b.undo_ftplugin = "setlocal commentstring< comments< expandtab< shiftwidth< tabstop< "
  .. "indentexpr< indentkeys<"

-- Colours and folds by the parser, if it is beside these files (Neovim 0.9 and newer).
if vim.treesitter.language and vim.treesitter.language.register then
  if pcall(vim.treesitter.start, 0, "setpiece") then
    vim.wo.foldexpr = "v:lua.vim.treesitter.foldexpr()"
  end
end
