-- SPDX-License-Identifier: GPL-3.0-or-later
-- People read csrc/step/stages.def as the contents of csrc/step, so it has to be true: each stage is defined
-- in the file of its row, earlier rows of a section lead to later ones, and no file of the room is missing.
local tree = require "house.tree"

local function read(path)
  local file = assert(io.open(path))
  local text = file:read "a"
  file:close()
  return text
end

-- The rows { section =, name =, file = }, in their order.
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

  it("is read completely by this spec", function()
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
  it("calls each stage from a row before it or from the binding", function()
    local bind = tree.run("cat " .. tree.quote(tree.root) .. "/csrc/bind/*.c")
    bind = bind:gsub("LSW_DO[%u_]*%(L, ([%w_]+), ", "%1(") -- the binding calls functions by macros
    for k, row in ipairs(rows) do
      local led = row.rung or bind:find("%f[%w_]" .. row.name .. "%(") ~= nil
      for j = 1, k - 1 do
        local others = code[rows[j].file]:gsub("\n[%w_ %*]-%f[%w_]" .. row.name .. "%b()%s*{", "")
        led = led or others:find("%f[%w_]" .. row.name .. "%(") ~= nil
      end
      assert.is_true(led, "no file of a row before it calls " .. row.name)
    end
  end)
  it("has rungs that each call the next one, except the last", function()
    local rungs = {}
    for _, row in ipairs(rows) do if row.rung then rungs[#rungs + 1] = row end end
    assert.equal(5, #rungs)
    for k, row in ipairs(rungs) do
      local goes = code[row.file]:find("sw_rung_go(p, below,", 1, true)
        or code[row.file]:find("return sw_obey(p, below,", 1, true)
      assert.equal(k < #rungs, goes ~= nil, row.name)
    end
  end)
  it("contains every file of the room", function()
    local names = tree.run("cd " .. tree.quote(tree.root) .. "/csrc && ls step/*.c")
    for name in names:gmatch "[^\n]+" do
      assert.is_string(code[name], name .. " is in no row of csrc/step/stages.def")
    end
  end)
end)
