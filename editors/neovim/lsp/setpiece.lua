-- The server's entry for `vim.lsp.enable("setpiece")`, Neovim 0.11 and newer.
return require("setpiece").config()
