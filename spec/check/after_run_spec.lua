-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of a scene that was changed after its run, of a run without a step, and of checks that measure
-- nothing; names that a spreadsheet would take for formulas.
local sw = require "softworld"

local function wire_of(scene, name, y)
  local w = scene:wire { name = name, E = 5e6, density = 1500, radius = 0.0025, from = { 0, y, 0.2 },
    to = { 0.3, y, 0.2 }, segments = 10 }
  scene:clamp(w, { s = 0 })
  return w
end

local function hung(name)
  local scene = sw.scene { name = "hung" }
  return scene, wire_of(scene, name or "cable", 0)
end

local LIMITS = { max_tension = 80, min_bend_radius = 0.01 }

-- Returns the rows of an object by their names without it.
local function rows_of(check, object)
  local found = {}
  for _, row in ipairs(check.rows) do
    if row.object == object then found[row.name:sub(#object + 2)] = row end
  end
  return found
end

describe("run:check of a scene that was changed after its run", function()
  it("is open for a wire that was made later, which has no values of the run", function()
    local scene = hung()
    local run = scene:run { duration = 0.05 }
    wire_of(scene, "later", 0.1)
    local check = run:check { limits = LIMITS }
    local later = rows_of(check, "later")
    assert.equal("OPEN", later.changed.verdict)
    assert.truthy(later.changed.note:find("made after the run", 1, true), later.changed.note)
    assert.is_nil(later.max_tension)
    assert.equal("PASS", check:row "cable.max_tension".verdict)
    assert.equal("OPEN", check.verdict)
  end)

  it("is open for a wire that was remodelled later: its peaks are those of the new model", function()
    local scene, wire = hung()
    local run = scene:run { duration = 0.05 }
    wire:remodel { model = "radial" }
    local rows = rows_of(run:check { limits = LIMITS }, "cable")
    assert.equal("OPEN", rows.changed.verdict)
    assert.truthy(rows.changed.note:find("remodelled after the run", 1, true), rows.changed.note)
    assert.is_nil(rows.max_tension)
  end)

  it("judges a wire that was made or remodelled before the run's end", function()
    local scene, wire = hung()
    wire:remodel { model = "radial" }
    scene:process(function(p)
      p:wait(0.02)
      wire_of(scene, "second", 0.1)
      p:wait(0.02)
    end)
    local check = scene:run { duration = 0.05, dt = 0.005 }:check { limits = LIMITS }
    for _, name in ipairs { "cable", "second" } do
      local rows = rows_of(check, name)
      assert.is_nil(rows.changed)
      assert.equal("PASS", rows.max_tension.verdict)
    end
  end)
end)

describe("run:check where nothing was computed", function()
  it("is open for a run of 0 s, though all values keep their limits", function()
    local scene = hung()
    local check = scene:run { duration = 0 }:check { limits = LIMITS }
    assert.equal("PASS", check:row "cable.max_tension".verdict)
    assert.equal("OPEN", check:row "run".verdict)
    assert.equal("OPEN", check.verdict)
  end)

  it("is open for a check that gives the largest of no values", function()
    local scene = hung()
    local run = scene:run { duration = 0.05 }
    local function one(value, side)
      local function of() return value end
      return run:check { checks = { { name = "x", unit = "m", [side] = 1, of = of } } }:row "x".verdict
    end
    assert.equal("OPEN", one(-math.huge, "max"))
    assert.equal("FAIL", one(math.huge, "max"))
    assert.equal("FAIL", one(-math.huge, "min"))
    assert.equal("PASS", one(math.huge, "min")) -- such as the bend radius of a straight wire
  end)

  it("leaves out a place or a time that is no finite number", function()
    local scene = hung()
    local row = scene:run { duration = 0.05 }:check { checks = { { name = "x", unit = "m", max = 1,
      of = function() return 0.5, 0 / 0, math.huge end } } }:row "x"
    assert.is_nil(row.s)
    assert.is_nil(row.time)
  end)
end)

describe("run:check of checks of one's own", function()
  it("refuses the full name of another check, as of max_tension of a wire", function()
    local scene = hung()
    local run = scene:run { duration = 0.05 }
    for _, name in ipairs { "cable.max_tension", "max_tension", "cycle_time" } do
      assert.error_matches(function()
        run:check { checks = { { name = name, unit = "N", max = 1, of = function() return 0 end } } }
      end, "there is another check '" .. name:gsub("%p", "%%%0") .. "'")
    end
  end)

  it("prints a unit in one line", function()
    local scene = hung()
    local text = tostring(scene:run { duration = 0.05 }:check { checks = { { name = "x", unit = "N\nPASS",
      max = 1, of = function() return 0.5 end } } })
    assert.is_nil(text:find("\nPASS", 1, true), text)
  end)
end)

describe("check:csv", function()
  it("writes no text that a spreadsheet computes", function()
    for _, name in ipairs { "=1+1", "+1", "@x", "-2+3" } do
      local scene = hung(name)
      local path = os.tmpname()
      scene:run { duration = 0.05 }:check { limits = { max_tension = 80 }, checks = { { name = "own",
        unit = "-", max = 1, source = "=A1", of = function() return -0.5 end } } }:csv(path)
      local text = io.open(path):read "a"
      os.remove(path)
      for line in text:gmatch "[^\n]+" do
        for cell in (line .. ","):gmatch '"?([^",]*)"?,' do
          assert.is_nil(cell:find "^[=+@]", cell)
          assert.is_true(not cell:find "^-" or cell == "-" or tonumber(cell) ~= nil, cell)
        end
      end
      assert.truthy(text:find(",'" .. name .. ",", 1, true), text)
      assert.truthy(text:find(",'=A1,", 1, true), text)
      assert.truthy(text:find(",-0.5,", 1, true), text) -- numbers stay
    end
  end)
end)
