-- The client of `setpiece lsp`, and the commands of its lenses.
local M = {}

--- The command: `vim.g.setpiece_command`, or `setpiece` on the PATH.
function M.command()
  return vim.g.setpiece_command or "setpiece"
end

--- What to say if the command can't be found.
function M.missing()
  return ("`%s` can't be run: in Setpiece's sources, `cargo install --path setpiece` installs it; "):format(
    M.command()
  ) .. "or set vim.g.setpiece_command"
end

--- Scenarios, and the scripts that they name.
M.filetypes = { "pitch", "rhai" }

--- The configuration of the server.
function M.config()
  return { cmd = { M.command(), "lsp" }, filetypes = M.filetypes, root_markers = { ".git" } }
end

--- The folder of a project: the nearest one with `.git`, else that of the file.
local function root_of(path)
  local folder = vim.fn.fnamemodify(path, ":p:h")
  local git = vim.fn.finddir(".git", vim.fn.escape(folder, " ;,") .. ";")
  return git == "" and folder or vim.fn.fnamemodify(git, ":p:h:h")
end

local clients = {}

--- Attaches the server to a buffer; one server per project. For Neovim before 0.11.
function M.attach(event)
  local root = root_of(event.file)
  local config = { name = "setpiece", cmd = M.config().cmd, root_dir = root }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = event.buf })
    return
  end
  local id = clients[root]
  if not (id and vim.lsp.get_client_by_id(id)) then
    id = vim.lsp.start_client(config)
    clients[root] = id
  end
  if id then
    vim.lsp.buf_attach_client(event.buf, id)
  end
end

--- Runs the command in a terminal below; `done` is called if it ends well.
local function terminal(arguments, done)
  local command = vim.list_extend({ M.command() }, arguments)
  local options = {
    on_exit = function(_, code)
      if code == 0 and done then
        done()
      end
    end,
  }
  vim.cmd("botright new")
  if vim.fn.has("nvim-0.11") == 1 then
    options.term = true
    vim.fn.jobstart(command, options)
  else
    vim.fn.termopen(command, options)
  end
end

--- The actions behind the lenses: most take the path of a text, and the name of what the lens
--- stands at.
M.commands = {
  ["setpiece.run"] = function(path, scenario)
    terminal({ "run", path, "--scenario", scenario, "--episodes", "20" })
  end,
  ["setpiece.draw"] = function(path, scenario)
    local picture = vim.fn.tempname() .. ".png"
    local arguments = { "render", path, "--scenario", scenario, "--step", "0", "-o", picture }
    terminal(arguments, function()
      if vim.ui.open then
        vim.ui.open(picture)
      end
    end)
  end,
  ["setpiece.check"] = function(path, check)
    terminal({ "test", path, "--filter", check })
  end,
  ["setpiece.uses"] = function(_, _, places)
    vim.fn.setqflist({}, " ", {
      title = "Uses",
      items = vim.lsp.util.locations_to_items(places, "utf-16"),
    })
    vim.cmd("copen")
  end,
}

--- The columns that a line is indented by: one level deeper behind an opening bracket.
function M.indent(number)
  local before = vim.fn.prevnonblank(number - 1)
  local function code(line)
    return (vim.fn.getline(line):gsub('"[^"]*"', ""):gsub("//.*", ""):gsub("%s+$", ""))
  end
  local width = vim.fn.indent(before)
  if code(before):match("[{%[(]$") then
    width = width + vim.fn.shiftwidth()
  end
  if code(number):match("^%s*[}%])]") then
    width = width - vim.fn.shiftwidth()
  end
  return math.max(width, 0)
end

return M
