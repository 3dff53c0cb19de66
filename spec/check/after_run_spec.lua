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

  it("fails a check whose place or time is no number, such as a vector", function()
    local scene = hung()
    local run = scene:run { duration = 0.05 }
    local function row_of(s, time)
      return run:check { checks = { { name = "x", unit = "m", max = 1,
        of = function() return 0.5, s, time end } } }:row "x"
    end
    local row = row_of(scene:find "cable":position(0))
    assert.equal("FAIL", row.verdict)
    assert.matches("must return a place along the wire %[m%] as its second value, or nil, got ", row.note)
    row = row_of(0.1, "late")
    assert.equal("FAIL", row.verdict)
    assert.matches("must return a time %[s%] as its third value, or nil, got ", row.note)
    assert.equal("PASS", row_of(nil, 0.05).verdict)
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

-- A wire hangs in a tie at its end, which is released at 0.2 s. to_wire: the tie holds it at another wire.
local function released_tie(run_args, to_wire, keeps)
  local scene, wire = hung()
  local to
  if to_wire then
    local upper = wire_of(scene, "upper", 0.05)
    scene:clamp(upper, { s = 0.3 })
    to = { upper, s = 0.3 }
  end
  local tie = scene:tie(wire, { name = "t", s = 0.3, to = to, strength = 1 })
  scene:tie(wire, { name = "other", s = 0.15, strength = 1 })
  scene:process(function(p)
    p:wait(0.2)
    if not keeps then tie:release() end
    p:wait(0.1)
  end)
  return scene:run(run_args or { dt = 0.005 }), scene
end

describe("run:check of ties and clips that are released in the run", function()
  for _, to_wire in ipairs { false, true } do
    it("judges the largest pull before the release, also of a tie to " .. (to_wire and "a wire" or "a point"),
      function()
        local run, scene = released_tie(nil, to_wire)
        local row = run:check { limits = { ["t.strength_used"] = 0.01 } }:row "t.strength_used"
        assert.equal("FAIL", row.verdict)
        assert.is_true(row.time <= 0.2)
        assert.truthy(row.note:find("released at 0.2 s", 1, true), row.note)
        -- the same pull as that of a tie that stays, over the same time
        local kept, other = released_tie(nil, to_wire, true)
        local tie = other:find "t"
        assert.is_near(tie:over(kept.start, 0.2).raw_peak_force, row.value, 1e-12)
        row = run:check { limits = { ["t.strength_used"] = 0.9 } }:row "t.strength_used"
        assert.equal("PASS", row.verdict)
        assert.has_error(function() scene:run { duration = 0.1 }:check {}:row "t.strength_used" end)
      end)
  end

  it("has the same row in a run that goes on from a file", function()
    local path, copy = os.tmpname(), os.tmpname()
    local function script()
      local scene, wire = hung()
      local tie = scene:tie(wire, { name = "t", s = 0.3, strength = 1 })
      scene:process(function(p)
        p:step("hang", function() p:wait(0.2) end)
        p:step("let go", function() tie:release() end)
        p:step("fall", function()
          os.execute(("cp '%s' '%s'"):format(path, copy)) -- of the time when the tie was released
          p:wait(0.1)
        end)
      end)
      return scene
    end
    local args = { limits = { ["t.strength_used"] = 0.9 } }
    local wanted = script():run { dt = 0.005, save = path }:check(args):row "t.strength_used"
    os.remove(path)
    local scene = script()
    assert.is_true(scene:resume(copy))
    local row = scene:run { dt = 0.005 }:check(args):row "t.strength_used"
    os.remove(copy)
    assert.same({ "PASS", wanted.value, wanted.time, wanted.note },
      { row.verdict, row.value, row.time, row.note })
    assert.is_true(row.time <= 0.2)
    assert.has_error(function() scene:run { duration = 0.1 }:check {}:row "t.strength_used" end)
  end)

  it("has a row with an error bar", function()
    local run = released_tie { duration = 0.3, check = { limits = { ["t.strength_used"] = 0.9 } } }
    local row = run:check():row "t.strength_used"
    assert.equal("PASS", row.verdict)
    assert.is_true(row.error < 0.5 * row.value, tostring(row.error))
  end)

  it("judges a clip that held a wire until it was taken away", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local wire = scene:wire { name = "w", E = 5e6, density = 1500, radius = 0.0025, from = { 0, 0, 0 },
      to = { 0.2, 0, 0 }, segments = 20 }
    local hold = scene:clamp(wire, { s = 0 })
    scene:clip { name = "c", at = { 0.1, 0, 0 }, width = 0.01, insertion = 1, retention = 3 }
    hold:follow { points = { { 0, 0, 0 }, { 0, 0, 0.02 } }, relative = true, duration = 0.2 }
    scene:process(function(p)
      p:wait(0.3)
      scene:remove "c"
      p:wait(0.1)
    end)
    local check = scene:run { dt = 0.005 }:check {}
    local row = check:row "c.retention_used"
    assert.is_true(row.value > 0 and row.value < 1, tostring(row.value))
    assert.truthy(row.note:find("released at 0.3 s", 1, true), row.note)
    assert.has_error(function() check:row "c.seated" end) -- it need not hold at the end
  end)
end)
