-- SPDX-License-Identifier: GPL-3.0-or-later
-- csrc/step/stages.def is read by people as the contents of csrc/step. It has to be true: each stage
-- is defined where its row says, what comes first in a section leads to what comes after it, and no
-- file of the room is left out.
local tree = require "house.tree"

local function read(path)
  local file = assert(io.open(path))
  local text = file:read "a"
  file:close()
  return text
end

-- Rows { section =, name =, file = } in their order.
local function rows_of(text)
  local rows, section = {}, nil
  for line in text:gmatch "[^\n]+" do
    section = line:match "^/%* %-%-%- (.-) %-+ %*/$" or section
    local kind, name, file, what = line:match '^SW_(%u+)%(([%w_]+), "([^"]+)", "([^"]+)"%)$'
    if kind then
      rows[#rows + 1] = { section = section, rung = kind == "RUNG", file = file, what = what,
        name = kind == "RUNG" and "sw_rung_" .. name or name }
    end
  end
  return rows
end

local function defines(code, name) -- at the beginning of a line, with a body
  return ("\n" .. code):find("\n[%w_ %*]-%f[%w_]" .. name .. "%b()%s*{") ~= nil
end

describe("the list of stages", function()
  local rows = rows_of(read(tree.root .. "/csrc/step/stages.def"))
  local code = {}
  for _, row in ipairs(rows) do
    code[row.file] = code[row.file] or read(tree.root .. "/csrc/" .. row.file)
  end

  it("has each line of the file that is a row", function()
    local count = 0
    for _ in read(tree.root .. "/csrc/step/stages.def"):gmatch "\nSW_%u+%(" do count = count + 1 end
    assert.equal(count, #rows)
    assert.is_true(count > 20)
  end)
  it("names functions in the files that define them", function()
    for _, row in ipairs(rows) do
      assert.is_true(defines(code[row.file], row.name), row.name .. " is not defined in " .. row.file)
    end
  end)
  it("goes from what comes first to what that leads to", function()
    local bind = tree.run("cat " .. tree.quote(tree.root) .. "/csrc/bind/*.c")
    bind = bind:gsub("LSW_DO[%u_]*%(L, ([%w_]+), ", "%1(") -- the binding's ways to call a function and raise
    for k, row in ipairs(rows) do
      local led = row.rung or bind:find("%f[%w_]" .. row.name .. "%(") ~= nil
      for j = 1, k - 1 do
        local others = code[rows[j].file]:gsub("\n[%w_ %*]-%f[%w_]" .. row.name .. "%b()%s*{", "")
        led = led or others:find("%f[%w_]" .. row.name .. "%(") ~= nil
      end
      assert.is_true(led, "no file of a row before it calls " .. row.name)
    end
  end)
  it("has rungs that call the next one, but for the last", function()
    local rungs = {}
    for _, row in ipairs(rows) do if row.rung then rungs[#rungs + 1] = row end end
    assert.equal(5, #rungs)
    for k, row in ipairs(rungs) do
      local goes = code[row.file]:find("sw_rung_go(p, below,", 1, true)
        or code[row.file]:find("return sw_obey(p, below,", 1, true)
      assert.equal(k < #rungs, goes ~= nil, row.name)
    end
  end)
  it("leaves no file of the room out", function()
    local names = tree.run("cd " .. tree.quote(tree.root) .. "/csrc && ls step/*.c")
    for name in names:gmatch "[^\n]+" do
      assert.is_string(code[name], name .. " is in no row of csrc/step/stages.def")
    end
  end)
end)
