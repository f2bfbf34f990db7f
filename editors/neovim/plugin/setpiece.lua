-- Starts the server for scenarios, and runs the commands of its lenses.
if vim.g.loaded_setpiece then
  return
end
vim.g.loaded_setpiece = true

local setpiece = require("setpiece")

if vim.treesitter.language and vim.treesitter.language.register then
  vim.treesitter.language.register("setpiece", "pitch")
end

for name, action in pairs(setpiece.commands) do
  vim.lsp.commands[name] = function(command)
    action(unpack(command.arguments or {}))
  end
end

if vim.fn.executable(setpiece.command()) == 0 then
  vim.api.nvim_create_autocmd("FileType", {
    pattern = setpiece.filetypes,
    once = true,
    callback = function()
      vim.notify(setpiece.missing(), vim.log.levels.WARN)
    end,
  })
elseif vim.lsp.enable then
  vim.lsp.enable("setpiece")
else
  vim.api.nvim_create_autocmd("FileType", {
    pattern = setpiece.filetypes,
    callback = setpiece.attach,
  })
end
