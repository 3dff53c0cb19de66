-- SPDX-License-Identifier: GPL-3.0-or-later
-- The output of run:check: the same numbers in the terminal, CSV, JSON and JUnit XML, also with odd names
-- and texts.
local sw = require "softworld"
local csv = require "softworld.csv"
local jsonread = require "softworld.output.jsonread"
local number = require "softworld.output.number"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/check"
local program = dofile(here .. "/../host/program.lua")

local odd = 'a "b" <c> & d, e; \1 \255 #'

local function check_of()
  local scene = sw.scene{ name = "odd & <name>" }
  scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 8 }
  local run = scene:run{ duration = 0.02, dt = 0.01 }
  return run:check{ limits = { max_stress = false }, checks = {
    { name = odd, unit = "m", of = function() return 1 / 3 end, max = 0.3 },
    { name = "open", unit = "-", of = function() return 1 end },
    { name = "raises", unit = "-", of = function() error(odd .. "\nsecond line") end, max = 1 },
    { name = "nan", unit = "-", of = function() return 0 / 0 end, max = 1 },
    { name = "tiny", unit = "m", of = function() return 5e-324, 0.1, 0.01 end, min = -1e300, sure = true },
  } }
end

local columns = { "value", "error", "low", "high", "limit", "limit_low", "limit_high", "margin", "s", "time" }

describe("the output of a check", function()
  local check, folder

  setup(function() check, folder = check_of(), program.folder() end)
  teardown(program.clean)

  it("has every number to its last bit as CSV", function()
    local path = check:csv(folder .. "/c.csv")
    local names = {}
    for name in program.read(path):match "^[^\n]*":gmatch "[^,]+" do names[name] = true end
    local data = csv.read(path, { text = names })
    assert.equal(#check.rows, data.count)
    for i, row in ipairs(check.rows) do
      assert.equal(row.verdict, data.columns.verdict[i])
      assert.equal(row.unit, data.columns.unit[i])
      for _, name in ipairs(columns) do
        local text = data.columns[name][i]
        if row[name] == nil then
          assert.equal("", text)
        elseif row[name] ~= row[name] then
          assert.equal("nan", text)
        else
          assert.equal(row[name], tonumber(text) or text == "inf" and math.huge, name)
        end
      end
    end
  end)

  it("has the same numbers as JSON", function()
    local path = check:json(folder .. "/c.json")
    local data = jsonread.decode(program.read(path))
    assert.equal(check.verdict, data.verdict)
    assert.equal(#check.rows, #data.rows)
    assert.same({ "w.max_stress" }, data.skipped)
    for i, row in ipairs(check.rows) do
      for _, name in ipairs(columns) do
        local value = data.rows[i][name]
        if row[name] and row[name] - row[name] ~= 0 then
          assert.equal(row[name] == math.huge and "inf" or "nan", value)
        else
          assert.equal(row[name], value, name)
        end
      end
    end
  end)

  it("has the same numbers as JUnit XML, which is well formed", function()
    local text = program.read(check:junit(folder .. "/c.xml"))
    local count = { PASS = 0, FAIL = 0, OPEN = 0 }
    for _, row in ipairs(check.rows) do count[row.verdict] = count[row.verdict] + 1 end
    assert.truthy(text:find(('<testsuite name="odd &amp; &lt;name&gt;" tests="%d" failures="%d" errors="%d"')
      :format(#check.rows, count.FAIL, count.OPEN), 1, true), text)
    local i = 0
    for case in text:gmatch "<testcase.-</testcase>" do
      i = i + 1
      local row = check.rows[i]
      assert.equal(row.verdict, case:match '<property name="verdict" value="(%u+)"/>')
      local value = case:match '<property name="value" value="([^"]*)"/>'
      assert.is_true(value == nil and row.value == nil or value == "nan" or value == "inf"
        or tonumber(value) == row.value)
      assert.equal(row.verdict == "FAIL", case:find "<failure" ~= nil)
      assert.equal(row.verdict == "OPEN", case:find "<error" ~= nil)
    end
    assert.equal(#check.rows, i)
    assert.is_nil(text:find "[%z\1-\9\11-\31]")
    assert.truthy(utf8.len(text))
    assert.is_nil(text:gsub("&%a+;", ""):find("&", 1, true))
  end)

  it("has one aligned line with rounded numbers for each row on the terminal", function()
    local text, lines = tostring(check), {}
    for line in (text .. "\n"):gmatch "(.-)\n" do lines[#lines + 1] = line end
    assert.truthy(lines[1]:find("check of 'odd & <name>', t = 0 s to 20.00 ms: FAIL", 1, true), lines[1])
    local heads = {}
    for _, line in ipairs(lines) do
      if line:find "^  %u%u%u%u  " then heads[#heads + 1] = line end
    end
    assert.equal(#check.rows, #heads)
    local first
    for i, row in ipairs(check.rows) do
      assert.equal(row.verdict, heads[i]:sub(3, 6))
      if row.value and row.value == row.value then
        local value = number.text(row.value, row.unit ~= "-" and row.unit or nil)
        assert.truthy(heads[i]:find(value, 1, true), heads[i])
      end
      if row.margin then
        local at = number.columns(heads[i]:sub(1, heads[i]:find("margin", 1, true)))
        first = first or at
        if utf8.len(heads[i]) then assert.equal(first, at, text) end
      end
    end
    assert.truthy(text:find("left out by the script: w.max_stress", 1, true))
    assert.is_nil(text:find "[%z\1-\9\11-\31]")
  end)

  it("is an error where the file cannot be written, and the old file stays", function()
    local path = program.write(folder .. "/old.csv", "old")
    local fine, why = pcall(check.csv, check, folder .. "/no/such/c.csv")
    assert.is_false(fine)
    assert.truthy(why:find("no/such", 1, true), why)
    assert.equal("old", program.read(path))
  end)
end)
