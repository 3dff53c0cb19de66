-- SPDX-License-Identifier: GPL-3.0-or-later
-- sw.compare: which values changed beyond their error, which rows exist on one side only, whose verdict
-- changed; wrong input is refused by name.
local sw = require "softworld"
local csv = require "softworld.csv"
local jsonread = require "softworld.output.jsonread"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/check"
local program = dofile(here .. "/../host/program.lua")

-- A cable of a length [m] hangs at rest, so that its tension is its weight.
local function run_of(length, options)
  local scene = sw.scene{ name = ("hung, %g m"):format(length) }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 1 }, to = { 0, 0, 1 - length },
    segments = 8 }
  scene:clamp(wire, { s = 0 })
  scene:settle()
  return scene:run(options or { duration = 0.02, dt = 0.01 })
end

local function own(name, value, more)
  local one = { name = name, unit = "m", of = function() return value end, max = 1, sure = true }
  for key, x in pairs(more or {}) do one[key] = x end
  return one
end

local function named(comparison, name)
  for _, row in ipairs(comparison.rows) do
    if row.name == name then return row end
  end
end

local function fails(words, ...)
  local fine, why = pcall(sw.compare, ...)
  assert.is_false(fine)
  assert.truthy(why:find(words, 1, true), why)
end

describe("sw.compare", function()
  local run, folder

  setup(function() run, folder = run_of(0.2), program.folder() end)
  teardown(program.clean)

  it("finds no difference between a check and itself, its file and its run", function()
    local check = run:check{}
    local path = check:json(folder .. "/same.json")
    for _, other in ipairs{ check, path, run } do
      for _, comparison in ipairs{ sw.compare(check, other), sw.compare(other, check) } do
        assert.is_true(comparison.same, tostring(comparison))
        assert.equal(#check.rows, #comparison.rows)
        for _, row in ipairs(comparison.rows) do assert.equal("same", row.status) end
      end
    end
  end)

  it("reports by how much values changed, and whether that is better", function()
    local a = run:check{ checks = { own("rises", 0.5), own("falls", 0.5), own("stays", 0.5) } }
    local b = run:check{ checks = { own("rises", 0.75), own("falls", 0.4), own("stays", 0.5) } }
    local c = sw.compare(a, b)
    assert.is_false(c.same)
    local rises, falls = named(c, "rises"), named(c, "falls")
    assert.same({ "changed", 0.25, 0.5, false }, { rises.status, rises.change, rises.share, rises.better })
    assert.same({ "changed", true }, { falls.status, falls.better })
    assert.equal("same", named(c, "stays").status)
    assert.truthy(tostring(c):find("rises%s+500.0 mm %-> 750.0 mm%s+%+250.0 mm %(%+50 %%%)%s+worse"),
      tostring(c))
    assert.is_nil(tostring(c):find("stays", 1, true))
  end)

  -- Error bars of 0.1: a change within the sum of both bars is no change.
  it("counts a change within the errors as no change", function()
    local function of(value, low, high)
      local check = run:check{ checks = { own("v", value) } }
      local path = check:json(folder .. "/v.json")
      local text = program.read(path):gsub('("name":"v")', ('%%1,"low":%.17g,"high":%.17g'):format(low, high))
      return program.write(folder .. ("/v%g.json"):format(value), text)
    end
    local a, near, far = of(0.5, 0.4, 0.6), of(0.65, 0.55, 0.75), of(0.8, 0.7, 0.9)
    local row = named(sw.compare(a, near), "v")
    assert.equal("same", row.status)
    assert.is_near(0.15, row.change, 1e-12)
    assert.is_near(0.2, row.error, 1e-12)
    assert.equal("changed", named(sw.compare(a, far), "v").status)
    assert.equal("same", named(sw.compare(a, far, { tolerance = 0.5 }), "v").status)
  end)

  -- A wire that stays straight has an infinite bend radius.
  it("never counts infinity as a finite number, nor NaN as anything", function()
    local inf, nan = math.huge, 0 / 0
    for _, case in ipairs{ { inf, 1, "changed" }, { 1, inf, "changed" }, { inf, inf, "same" },
      { -inf, inf, "changed" }, { -inf, -inf, "same" }, { nan, nan, "changed" }, { nan, 1, "changed" },
      { inf, nan, "changed" } } do
      local x, y, status = table.unpack(case)
      local a, b = run:check{ checks = { own("v", x) } }, run:check{ checks = { own("v", y) } }
      for _, comparison in ipairs{ sw.compare(a, b), sw.compare(a:json(folder .. "/inf.json"), b),
        sw.compare(a, b, { tolerance = 1 }) } do
        local row = named(comparison, "v")
        assert.same({ status, status == "same" }, { row.status, comparison.same }, ("%g, %g"):format(x, y))
        assert.is_nil(row.change)
      end
    end
  end)

  it("says that a value is the same by the tolerance alone, and shows both values", function()
    local a, b = run:check{ checks = { own("v", 0.999) } }, run:check{ checks = { own("v", 1.001) } }
    local comparison = sw.compare(a, b, { tolerance = 0.01 })
    assert.same({ "same", true }, { named(comparison, "v").status, named(comparison, "v").tolerated })
    local text = tostring(comparison)
    assert.matches("PASS %-> FAIL +v +999.0 mm %-> 1.001 m +the same within the tolerance", text)
    assert.is_nil(text:find("within its error", 1, true))
  end)

  it("reports changed verdicts and limits, also where the value is the same", function()
    local unlimited = own("w", 0.5)
    unlimited.max = nil
    local a = run:check{ checks = { own("v", 0.5), unlimited } }
    local b = run:check{ checks = { own("v", 0.5, { max = 0.25 }), own("w", 0.5) } }
    local c = sw.compare(a, b)
    local v, w = named(c, "v"), named(c, "w")
    assert.same({ "same", true, true, "PASS", "FAIL", false },
      { v.status, v.verdict_changed, v.limit_changed, v.verdict_a, v.verdict_b, v.better })
    assert.same({ "OPEN", "PASS" }, { w.verdict_a, w.verdict_b })
    assert.truthy(tostring(c):find("PASS -> FAIL  v", 1, true), tostring(c))
    assert.truthy(tostring(c):find("limit: 1.000 m -> 250.0 mm", 1, true), tostring(c))
  end)

  it("reports rows that are on one side only, also for the same name in another unit", function()
    local a = run:check{ checks = { own("old", 0.5), own("v", 0.5) } }
    local b = run:check{ checks = { own("new", 0.5), own("v", 0.5, { unit = "N" }) } }
    local count = { ["only in a"] = 0, ["only in b"] = 0 }
    for _, row in ipairs(sw.compare(a, b).rows) do
      if row.status ~= "same" then count[row.status] = count[row.status] + 1 end
    end
    assert.same({ ["only in a"] = 2, ["only in b"] = 2 }, count)
  end)

  -- The weight per length is the same, so the tension at the clamp is proportional to the length.
  it("compares two runs", function()
    local c = sw.compare(run, run_of(0.4))
    local row = named(c, "w.max_tension")
    assert.equal("changed", row.status)
    assert.is_near(1, row.share, 0.1)
    assert.equal(row.value_b - row.value_a, row.change)
  end)

  it("has no numbers of a failed run", function()
    local c = sw.compare(run, run_of(0.2, { duration = 1, dt = 0.01, max_steps = 1 }))
    local text = tostring(c)
    assert.truthy(text:find("b has no numbers: the run was cut short", 1, true), text)
    for _, r in ipairs(c.rows) do assert.is_nil(r.value_b) end
  end)

  it("is written as CSV and JSON with the same numbers", function()
    local c = sw.compare(run:check{ checks = { own("a;b", 1 / 3) } },
      run:check{ checks = { own("a;b", 0 / 0) } })
    local data = jsonread.decode(program.read(c:json(folder .. "/c.json")))
    local path = c:csv(folder .. "/c.csv")
    local names = {}
    for name in program.read(path):match "^[^\n]*":gmatch "[^,]+" do names[name] = true end
    local columns = csv.read(path, { text = names }).columns
    assert.same({ false, #c.rows }, { data.same, #data.rows })
    for i, row in ipairs(c.rows) do
      assert.equal(row.value_a, data.rows[i].value_a == "inf" and math.huge or data.rows[i].value_a)
      assert.equal(row.value_a and ("%.17g"):format(row.value_a) or "", columns.value_a[i])
      assert.equal(tostring(row.verdict_changed), columns.verdict_changed[i])
    end
    assert.equal("nan", data.rows[#data.rows].value_b)
    assert.equal("changed", c.rows[#c.rows].status)
  end)

  it("refuses anything but a check, a run or a file of a check", function()
    local check = run:check{}
    fails("sw.compare: a must be a check, a run or the name of a file of check:json, got nil", nil, check)
    fails("sw.compare: b must be a check, a run", check, { rows = {} })
    fails("sw.compare: b: cannot read no/such.json", check, "no/such.json")
    fails("sw.compare: a: the name of a file is empty", "", check)
    fails("did you mean 'tolerance'?", check, check, { tolerence = 1 })
    local wrong = { [""] = "the file is empty", ["{}"] = "no rows", ['{"rows":[]}'] = "no verdict",
      ['{"verdict":"PASS","rows":[1]}'] = "row 1 is not an object",
      ['{"verdict":"PASS","rows":{"x":1}}'] = "its rows are not a list",
      ['{"verdict":"PASS","rows":[{"verdict":"PASS"}]}'] = "row 1 has no name",
      ['{"verdict":"PASS","rows":[{"verdict":"x"}]}'] = "row 1 has no verdict",
      ['{"verdict":"PASS","rows":[{"verdict":"PASS","name":"x","unit":"m","value":[]}]}']
        = "row 1 has value" }
    for text, words in pairs(wrong) do
      local path = program.write(folder .. "/wrong.json", text)
      fails(("b: %s is not what check:json writes: "):format(path), check, path)
      fails(words, check, path)
    end
  end)

  it("is read-only, and suggests the right name for a misspelt one", function()
    local c = sw.compare(run, run)
    for _, name in ipairs{ "sme", "csw" } do
      local fine, why = pcall(function() return c[name] end)
      assert.is_false(fine)
      assert.truthy(why:find("did you mean", 1, true), why)
    end
    assert.is_false(pcall(function() c.same = true end))
    assert.is_false(pcall(c.csv, {}, "x"))
    assert.is_false(pcall(c.csv, c))
  end)
end)
