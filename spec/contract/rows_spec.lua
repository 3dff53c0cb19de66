-- SPDX-License-Identifier: GPL-3.0-or-later
-- Every parameter row has a unit and a text; help and the checks read the same rows.
local sw = require "softworld"
local samples = require "contract.samples"
local core = sw.core

-- Returns { title, rows } of every table of rows.
local function tables()
  local list = {}
  for name, rows in pairs(samples.registry.params) do list[#list + 1] = { name, rows } end
  for _, family in ipairs{ "forces", "holds", "shapes" } do
    for _, entry in ipairs(samples.registry[family]) do
      list[#list + 1] = { family .. " " .. entry.name, entry.params }
    end
  end
  list[#list + 1] = { "trajectory", core.trajectory_parameters() }
  table.sort(list, function(a, b) return a[1] < b[1] end)
  return list
end

-- Units of mechanics: products and quotients of these units with whole powers.
local function is_unit(text)
  if text == "-" then return true end
  for part in text:gmatch "[^ /]+" do
    local name = part:match "^(%a+)%d*$"
    if part ~= "1" and not (name and ("m s kg N Pa rad J Hz"):find("%f[%a]" .. name .. "%f[%A]")) then
      return false
    end
  end
  return text ~= ""
end

local function inside(row, value)
  if row.min and (value < row.min or (row.above and value == row.min)) then return false end
  return not (row.max and (value > row.max or (row.below and value == row.max)))
end

for _, entry in ipairs(tables()) do
  local title, rows = entry[1], entry[2]
  describe("rows of " .. title, function()
    it("have a unit and a text", function()
      for _, row in ipairs(rows) do
        assert.is_true(is_unit(row.unit), ("%s: unit '%s'"):format(row.name, row.unit))
        assert.is_true(#row.doc >= 8, row.name)
        assert.is_nil(row.doc:find "%.$", row.name .. ": its text ends with a full stop")
      end
    end)

    it("have defaults inside their range", function()
      for _, row in ipairs(rows) do
        local numeric = row.type == "number" or row.type == "integer"
        if numeric and row.default and not row.required then
          assert.is_true(inside(row, row.default), ("%s = %g"):format(row.name, row.default))
        end
        if row.min and row.max then assert.is_true(row.min < row.max, row.name) end
        if row.type == "choice" then assert.is_true(#row.choices > 0, row.name) end
      end
    end)

    it("have different names that are valid in Lua", function()
      local seen = {}
      for _, row in ipairs(rows) do
        assert.is_nil(seen[row.name], row.name .. " comes twice")
        seen[row.name] = true
        assert.is_truthy(row.name:find "^%a[%w_]*$")
        assert.is_truthy(load("return { " .. row.name .. " = 1 }"), row.name .. " is a keyword of Lua")
      end
    end)
  end)
end

describe("help", function()
  local function said(topic)
    local lines, real = {}, print
    rawset(_G, "print", function(...)
      local parts = table.pack(...)
      for i = 1, parts.n do parts[i] = tostring(parts[i]) end
      lines[#lines + 1] = table.concat(parts, "\t")
    end)
    local ok, message = pcall(sw.help, topic)
    rawset(_G, "print", real)
    assert(ok, message)
    return table.concat(lines, "\n")
  end

  it("knows every registered name and every parameter", function()
    for _, family in ipairs{ "forces", "holds", "shapes", "integrators", "models" } do
      for _, entry in ipairs(samples.registry[family]) do
        local text = said(entry.name)
        assert.is_nil(text:find "no help on", entry.name)
        assert.is_truthy(text:find(entry.name, 1, true))
        if not entry.inner then
          for _, row in ipairs(entry.params or {}) do
            assert.is_truthy(text:find(row.name, 1, true), entry.name .. ": " .. row.name)
          end
        end
      end
    end
    for name, rows in pairs(samples.registry.params) do
      for _, row in ipairs(rows) do assert.is_truthy(said(name):find(row.doc, 1, true)) end
    end
  end)

  it("shows families, topics and the list of everything", function()
    for _, topic in ipairs{ "models", "holds", "obstacles", "forces", "integrators", "shape",
      "gripper", "process", "snapshot", "units", "trajectory" } do
      assert.is_nil(said(topic):find "no help on", topic)
    end
    local all = said()
    for _, word in ipairs{ "rod", "clamp", "box", "drag", "tr-bdf2", "settle", "gripper" } do
      assert.is_truthy(all:find(word, 1, true), word)
    end
  end)

  it("guesses at typing errors", function()
    assert.is_truthy(said "wier":find "did you mean 'wire'")
    assert.is_truthy(said "qqqqqqqqqqq":find "help%(%) lists")
  end)

  it("shows the methods of any object and survives any value", function()
    local scene = sw.scene{}
    local text = said(scene)
    for _, word in ipairs{ "settle", "snapshot", "run", "process", "gripper" } do
      assert.is_truthy(text:find(word, 1, true), word)
    end
    said(12)
    said(false)
    said(print)
    said({})
    said(scene:gripper{})
  end)
end)
