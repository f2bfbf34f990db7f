-- Neovim with the plugin of editors/neovim against the real server; `cargo xtask editors --drive`
-- runs it headless. SETPIECE names the command, FIXTURE a folder of texts.
local PATIENCE = 30000

local command = vim.env.SETPIECE
vim.g.setpiece_command = command
local folder = vim.loop.fs_realpath(vim.env.FIXTURE)
local failed = false

local function wait(what, fit)
  if not vim.wait(PATIENCE, fit, 20) then
    error("waited in vain for " .. what, 0)
  end
end

local function text(buffer)
  return table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n") .. "\n"
end

local function write(buffer, new)
  local lines = vim.split(new:gsub("\n$", ""), "\n", { plain = true })
  vim.api.nvim_buf_set_lines(buffer, 0, -1, false, lines)
end

local function replace(old, new, whole)
  local start, finish = whole:find(old, 1, true)
  assert(start, old .. " stands in the text")
  return whole:sub(1, start - 1) .. new .. whole:sub(finish + 1)
end

--- Opens a text in the window; its buffer.
local function open(name)
  vim.cmd("edit " .. vim.fn.fnameescape(folder .. "/" .. name))
  return vim.api.nvim_get_current_buf()
end

--- Puts the cursor on some words of a buffer, or behind them.
local function go(buffer, words, behind)
  vim.api.nvim_set_current_buf(buffer)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local start, finish = line:find(words, 1, true)
    if start then
      vim.api.nvim_win_set_cursor(0, { number, behind and finish or start - 1 })
      return
    end
  end
  error(words .. " doesn't stand in the text", 0)
end

local function attached(buffer)
  if vim.lsp.get_clients then
    return #vim.lsp.get_clients({ bufnr = buffer, name = "setpiece" }) > 0
  end
  return next(vim.lsp.buf_get_clients(buffer)) ~= nil
end

--- Waits until a buffer has so many problems; the first of them.
local function problems(buffer, count)
  wait(count .. " problems", function()
    return #vim.diagnostic.get(buffer) == count
  end)
  return vim.diagnostic.get(buffer)[1]
end

local function request(method, params)
  local answers, why = vim.lsp.buf_request_sync(0, method, params, PATIENCE)
  local _, answer = next(answers or {})
  assert(answer and not answer.err, why or vim.inspect(answer))
  return answer.result
end

local function test(name, body)
  local fine, why = xpcall(body, debug.traceback)
  io.stdout:write((fine and "ok - " or "not ok - ") .. name .. "\n")
  if not fine then
    io.stdout:write(tostring(why) .. "\n")
    failed = true
  end
end

local drill, shapes, sound

test("the server is attached to scenarios", function()
  drill, shapes = open("drill.pitch"), open("shapes.pitch")
  sound = text(drill)
  for _, buffer in ipairs({ drill, shapes }) do
    assert(vim.bo[buffer].filetype == "pitch", vim.bo[buffer].filetype)
    wait("the server", function()
      return attached(buffer)
    end)
    problems(buffer, 0)
  end
end)

test("a typo is reported, and its quick fix mends it", function()
  vim.api.nvim_set_current_buf(drill)
  write(drill, replace("striker: CF", "striker: CFF", sound))
  local problem = problems(drill, 1)
  assert(problem.code == "SP0203" or problem.user_data.lsp.code == "SP0203", vim.inspect(problem))
  assert(vim.api.nvim_buf_get_lines(drill, problem.lnum, problem.lnum + 1, true)[1]:find("CFF"))
  go(drill, "CFF")
  vim.ui.select = function(items, _, choose)
    choose(items[1], 1)
  end
  vim.lsp.buf.code_action()
  wait("the fix", function()
    return text(drill) == sound
  end)
  problems(drill, 0)
end)

test("a formation that two files use is renamed in both", function()
  go(drill, "back_two")
  vim.lsp.buf.rename("narrow_two")
  wait("the new name", function()
    return text(drill):find("narrow_two") and text(shapes):find("narrow_two")
  end)
  assert(not (text(drill) .. text(shapes)):find("back_two"))
  problems(drill, 0)
end)

test("hover shows a place in metres", function()
  go(drill, "(0.02, 0)")
  vim.lsp.buf.hover()
  local shown
  wait("the hover", function()
    for _, window in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(window).relative ~= "" then
        shown = text(vim.api.nvim_win_get_buf(window))
      end
    end
    return shown
  end)
  assert(shown:find("1%.088 ?m"), shown)
  vim.cmd("silent! close")
end)

test("the regions of the opponents are offered behind `them.`", function()
  vim.cmd("only!")
  local whole = text(drill)
  write(drill, replace("them.box", "them.", whole))
  go(drill, "them.", true)
  local found = request("textDocument/completion", vim.lsp.util.make_position_params(0, "utf-16"))
  local labels = {}
  for _, item in ipairs(found.items or found) do
    labels[item.label] = true
  end
  for _, region in ipairs({ "box", "half", "goal" }) do
    assert(labels[region], vim.inspect(vim.tbl_keys(labels)))
  end
  write(drill, whole)
  problems(drill, 0)
end)

test("a text is formatted as `setpiece fmt` does", function()
  vim.api.nvim_set_current_buf(drill)
  local rough = text(drill):gsub("\n +", "\n  "):gsub("%(0.02, 0%)", "( 0.02,0 )")
  write(drill, rough)
  local expected = vim.fn.system({ command, "fmt", "-" }, rough)
  assert(vim.v.shell_error == 0 and expected ~= rough, expected)
  if vim.lsp.buf.format then
    vim.lsp.buf.format({ async = false, timeout_ms = PATIENCE })
  else
    vim.lsp.buf.formatting_sync(nil, PATIENCE)
  end
  assert(text(drill) == expected, text(drill))
end)

test("lines are indented as the formatter does", function()
  local whole = text(drill)
  vim.cmd("silent keepjumps normal! gg=G")
  assert(text(drill) == whole, text(drill))
  write(drill, whole:gsub("\n +", "\n"))
  vim.cmd("silent keepjumps normal! gg=G")
  assert(text(drill) == whole, text(drill))
end)

test("a lens runs its scenario in a terminal", function()
  vim.cmd("silent wall")
  go(drill, "scenario drill")
  if vim.lsp.codelens.enable then
    vim.lsp.codelens.enable(true, { bufnr = drill })
  else
    vim.lsp.codelens.refresh()
  end
  wait("lenses", function()
    return #vim.lsp.codelens.get(vim.lsp.codelens.enable and { bufnr = drill } or drill) > 0
  end)
  vim.ui.select = function(items, _, choose)
    for number, item in ipairs(items) do
      if vim.inspect(item):find("setpiece.run", 1, true) then
        return choose(item, number)
      end
    end
    error(vim.inspect(items), 0)
  end
  vim.lsp.codelens.run()
  wait("the terminal", function()
    return vim.bo.buftype == "terminal"
  end)
  local buffer = vim.api.nvim_get_current_buf()
  wait("the results", function()
    return text(buffer):find("mean return", 1, true)
  end)
  vim.cmd("bwipeout!")
end)

local has_parser = #vim.api.nvim_get_runtime_file("parser/setpiece.so", false) > 0
if not (vim.treesitter.language and vim.treesitter.language.register) then
  io.stdout:write("left out: colours and folds by the parser need Neovim 0.9\n")
elseif has_parser then
  test("the parser colours and folds", function()
    vim.cmd("edit! " .. vim.fn.fnameescape(folder .. "/drill.pitch"))
    local buffer = vim.api.nvim_get_current_buf()
    assert(vim.treesitter.highlighter.active[buffer], "no highlighter")
    local parser = vim.treesitter.get_parser(buffer, "setpiece")
    local tree = parser:parse()[1]
    assert(not tree:root():has_error(), "an error in the tree")
    local captures = {}
    local query = vim.treesitter.query.get("setpiece", "highlights")
    for id, node in query:iter_captures(tree:root(), buffer) do
      captures[query.captures[id] .. " " .. vim.treesitter.get_node_text(node, buffer)] = true
    end
    for _, expected in ipairs({ "keyword scenario", "type.definition drill", "number 0.02" }) do
      assert(captures[expected], expected)
    end
    vim.wo.foldmethod = "expr"
    vim.cmd("normal! zx")
    local line = vim.fn.search("team left", "nw")
    assert(vim.fn.foldlevel(line + 1) == 2, "fold level " .. vim.fn.foldlevel(line + 1))
  end)
end

vim.cmd(failed and "cquit 1" or "qall!")
