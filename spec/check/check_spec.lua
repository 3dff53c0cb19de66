-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check: unsafe results do not pass, missing data are reported, wrong arguments are refused by name.
local sw = require "softworld"
local laid = require "spec.check.laid"

local laying, wide, fails = laid.laying, laid.wide, laid.fails

describe("run:check", function()
  local run, scene, wire

  setup(function() run, scene, wire = laying() end)

  it("judges by catalogue, standard and script, and gives place, time, step and margin", function()
    local limits = wide()
    limits.cycle_time = 2
    local check = run:check{ use = "movement", limits = limits }
    assert.equal("PASS", check.verdict, tostring(check))
    assert.is_true(check.ok)
    local bend = check:row "w.min_bend_radius"
    local radius, s, time = wire:min_bend_radius()
    assert.same({ radius - wire.radius, s, time, "standard", "m", "min" },
      { bend.value, bend.s, bend.time, bend.from, bend.unit, bend.side })
    assert.is_near(5 * 2 * wire.radius, bend.limit, 1e-12) -- IEC 62440: 5 D moving, below 8 mm
    assert.is_near(4 * 2 * wire.radius, run:check{ use = "fixed" }:row "min_bend_radius".limit, 1e-12)
    assert.equal(bend.value - bend.limit, bend.margin)
    -- the wire's place at the end is laid once: 4 D
    local last = check:row "end_bend_radius"
    assert.is_near(wire:min_bend_radius{ now = true } - wire.radius, last.value, 1e-12)
    assert.is_near(4 * 2 * wire.radius, last.limit, 1e-12)
    assert.same({ "standard", run.time }, { last.from, last.time })
    assert.has_error(function() run:check{ use = "fixed" }:row "end_bend_radius" end)
    assert.truthy(bend.step == "lift" or bend.step == "lay", bend.step)
    local pull, load = check:row "max_tension", wire:cable().breaking_load
    assert.same({ "catalogue", load.value, load.low, load.high, "N" },
      { pull.from, pull.limit, pull.limit_low, pull.limit_high, pull.unit })
    assert.equal("user", check:row "cycle_time".from)
    assert.equal("script", check:row "cycle_time".source:match "script")
  end)

  it("says which limit is missing, and is open there", function()
    local check = run:check{}
    assert.equal("OPEN", check.verdict)
    local row = check:row "left.peak_force"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("limits = { ['left.peak_force'] = } [N]", 1, true), row.note)
    assert.is_nil(row.limit)
  end)

  it("prefers a limit with the object's name to one without", function()
    local check = run:check{ limits = { peak_force = 1e-9,
      ["left.peak_force"] = { max = 9, source = "sheet" } } }
    local row = check:row "peak_force"
    assert.same({ 9, "user", "sheet" }, { row.limit, row.from, row.source })
  end)

  it("leaves out rows that the script switches off, and says so", function()
    local limits = wide()
    limits.peak_force, limits["left.peak_moment"] = false, false
    local check = run:check{ limits = limits }
    assert.same({ "left.peak_force", "left.peak_moment" }, check.skipped)
    assert.truthy(tostring(check):find("left out by the script: left.peak_force, left.peak_moment", 1, true))
    fails(function() check:row "peak_force" end, "there is no row 'peak_force'")
  end)

  -- The wire lies straight at the end; a check of that state, or of frames that miss the lift, would pass.
  it("finds a bend that occurred between frames and is gone after the release", function()
    local least = wire:min_bend_radius()
    local now = wire:min_bend_radius{ now = true }
    assert.is_true(now > 1.2 * least, now .. " " .. least)
    local limits = { min_bend_radius = { min = (least + now) / 2 - wire.radius, sure = true } }
    local other = laying(nil, { frame = 5 })
    assert.is_true(other.scene:frame_count() <= 2)
    for _, r in ipairs{ run, other } do
      assert.equal("FAIL", r:check{ limits = limits }:row "min_bend_radius".verdict)
    end
  end)

  it("is open where frames leave the sidewall pressure uncertain around the limit", function()
    local row = run:check{ limits = { max_sidewall = 1 } }:row "max_sidewall"
    assert.is_true(row.high > row.low)
    local between = { max = (row.low + row.high) / 2, sure = true }
    assert.equal("OPEN", run:check{ limits = { max_sidewall = between } }:row "max_sidewall".verdict)
    assert.equal("PASS", run:check{ limits = { max_sidewall = { max = row.high, sure = true } } }
      :row "max_sidewall".verdict)
    local life = { curve = { { 1, 1e9 }, { 10, 1e3 } } }
    assert.equal("OPEN", run:check{ fatigue = life }:row "fatigue".verdict)
    local bare = run:check{ limits = { fatigue = 1 } }:row "fatigue" -- the cable's own curves count bending
    assert.same({ "OPEN", math.huge }, { bare.verdict, bare.high })
  end)

  -- The frame at the start belongs to no step: two frames of two steps miss one, three of three too.
  it("does not count the frame at the start of the run as a step", function()
    local straight
    for _, case in ipairs{ { 0.02, "OPEN", true }, { 0.01, "PASS", true }, { 0.02, "OPEN" } } do
      local steps = case[3] and 2 or 3
      if case[3] then
        straight = sw.scene{}
        straight:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
      end
      local r = straight:run{ duration = 0.01 * steps, dt = 0.01, frame = case[1] }
      assert.equal(steps, r.steps)
      local row = r:check{ fatigue = { curve = { { 1, 1e9 }, { 10, 1e3 } } } }:row "fatigue"
      assert.equal(case[2], row.verdict, row.note)
    end
  end)

  it("is open where a limit of the run applies to nothing: penetration without obstacles", function()
    local bare = sw.scene{ gravity = { 0, 0, 0 } }
    bare:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local row = bare:run{ duration = 0.01 }:check{ limits = { penetration = 1e-4 } }:row "penetration"
    assert.equal("OPEN", row.verdict)
    assert.is_nil(row.value)
  end)

  it("is open where a limit applies to nothing in the run", function()
    for name, limit in pairs{ peak_margin = 0.5, max_ovalisation = 0.1 } do -- no pads squeeze, no mesh
      local row = run:check{ limits = { [name] = limit } }:row(name)
      assert.equal("OPEN", row.verdict)
      assert.truthy(row.note:find("nothing in this run has this value", 1, true), row.note)
    end
    local row = run:check{ limits = { ["left.peak_margin"] = 0.5 } }:row "left.peak_margin"
    assert.equal("FAIL", row.verdict, "asked for by name")
  end)

  it("passes a value that equals the limit", function()
    local limits = wide()
    for _, side in ipairs{ "max", "min" } do
      limits.max_tension = { [side] = (wire:max_tension()), sure = true }
      local row = run:check{ limits = limits }:row "max_tension"
      assert.same({ "PASS", 0 }, { row.verdict, row.margin })
    end
  end)

  it("judges by the catalogue where the script limits only the other side", function()
    local verdicts = {}
    local limits = { min_bend_radius = { max = 1e3, sure = true }, peak_force = { min = 0, sure = true } }
    for _, row in ipairs(run:check{ use = "movement", limits = limits }.rows) do
      local name = row.name:match "[^.]+$"
      if limits[name] then
        verdicts[#verdicts + 1] = ("%s %s %s %s"):format(name, row.side, row.from, row.verdict)
      end
    end
    assert.same({ "min_bend_radius max user PASS", "min_bend_radius min standard PASS",
      "peak_force min user PASS", "peak_force nil nil OPEN" }, verdicts)
  end)

  it("does not pass a limit that is 1000 times too large, and reports it", function()
    local row = run:check{ limits = { max_tension = 80e3 } }:row "max_tension"
    assert.equal("OPEN", row.verdict)
    local words = "differs by a factor of 298 from the catalogue's, 268.5 N; is its unit right (N)?"
    assert.truthy(row.note:find(words, 1, true), row.note)
    row = run:check{ limits = { min_bend_radius = 30 } }:row "min_bend_radius"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("is its unit right (m)?", 1, true), row.note)
    row = run:check{ limits = { max_tension = { max = 80e3, sure = true } } }:row "max_tension"
    assert.equal("PASS", row.verdict)
  end)

  it("accepts the script's own checks, whose errors and NaN fail", function()
    local list = {
      { name = "good", unit = "m", of = function(r) return r.time, 0.1, 0.6 end, max = 10 },
      { name = "raises", unit = "N", of = function() error "no such thing" end, max = 1 },
      { name = "nan", unit = "N", of = function() return 0 / 0 end, max = 1 },
      { name = "nan alone", unit = "N", of = function() return 0 / 0 end },
      { name = "text", unit = "N", of = function() return "3" end, max = 4 },
      { name = "table", unit = "N", of = function() return {} end, max = 4 },
      { name = "without", unit = "N", of = function() return 3 end },
      { name = "both", unit = "N", of = function() return 3 end, min = 1, max = 2 },
    }
    local check = run:check{ checks = list }
    local verdicts = {}
    for _, one in ipairs(list) do verdicts[#verdicts + 1] = check:row(one.name).verdict end
    assert.same({ "PASS", "FAIL", "FAIL", "FAIL", "FAIL", "FAIL", "OPEN", "PASS" }, verdicts) -- both: its min
    assert.equal("FAIL", check.verdict)
    assert.truthy(check:row "raises".note:find("no such thing", 1, true))
    assert.truthy(check:row "text".note:find("must return a number, got '3'", 1, true))
    assert.same({ 0.1, 0.6, "lay" }, { check:row "good".s, check:row "good".time, check:row "good".step })
    local both = {}
    for _, row in ipairs(check.rows) do if row.name == "both" then both[row.side] = row.verdict end end
    assert.same({ min = "PASS", max = "FAIL" }, both)
    assert.is_nil(check:row "nan".margin)
  end)

  it("refuses wrong arguments by name", function()
    fails(function() run:check{ limit = {} } end, "there is no parameter 'limit'; did you mean 'limits'?")
    fails(function() run:check{ use = "moving" } end, "run:check: use = 'moving'", "movement")
    fails(function() run:check{ limits = 3 } end, "limits must be")
    fails(function() run:check{ limits = { max_tensoin = 3 } } end, "did you mean 'max_tension'?")
    for name, meant in pairs{ tension = "'max_tension'", torsion = "'max_torsion'", slips = "known are: ",
      bend_radius = "'min_bend_radius' or 'end_bend_radius'", temperature = "'max_temperature' or 'min_",
      force = "'peak_force', 'mean_force' or 'insertion_force'", penetration_depth = "'penetration'" } do
      fails(function() run:check{ limits = { [name] = 3 } } end, ("no check '%s'; "):format(name), meant)
    end
    fails(function() run:check{ limits = { ["rigth.peak_force"] = 3 } } end,
      "there is no check 'rigth.peak_force'")
    fails(function() run:check{ limits = { max_tension = 0 / 0 } } end,
      "limits['max_tension'] = ", "nan is not allowed")
    for _, value in ipairs{ math.huge, -math.huge } do
      fails(function() run:check{ limits = { max_tension = value } } end, "it must be a finite number")
      fails(function() run:check{ limits = { max_tension = { min = value } } } end, "limits['max_tension']")
      fails(function() run:check{ checks = { { name = "x", unit = "m", of = print, min = value } } } end,
        "checks[1]")
    end
    fails(function() run:check{ limits = { max_tension = "80 N" } } end, "must be a number, false", "'80 N'")
    fails(function() run:check{ limits = { max_tension = {} } } end, "neither max nor min is given")
    fails(function() run:check{ limits = { max_tension = { max = 1, min = 2 } } } end,
      "min = 2 is above max = 1, so no value can pass")
    fails(function() run:check{ limits = { max_tension = { mx = 1 } } } end, "did you mean 'max'?")
    local one = { name = "x", unit = "m", of = function() return 1 end, max = 1, min = 2 }
    fails(function() run:check{ checks = { one } } end, "checks[1], 'x': min = 2 is above max = 1")
    fails(function() run:check{ checks = one } end, "checks must be a list of tables, without the key")
    fails(function() run:check{ checks = { { name = "x", unit = "m" } } } end, "checks[1]: of is required")
    fails(function() run:check{ checks = { { name = "x", unit = "m", of = print, max = 1 / 0 } } } end,
      "checks[1]: max = inf m is not allowed; it must be finite")
    fails(function() run:check{ checks = { { name = "x", unit = "-", of = print, min = -1 / 0 } } } end,
      "checks[1]: min = -inf is not allowed; it must be finite")
    one.min = nil
    fails(function() run:check{ checks = { one, one } } end, "there is another check 'x'")
    one.name = "max_tension"
    fails(function() run:check{ checks = { one } } end, "there is another check 'max_tension'")
    fails(function() run:check{ landing = { path = {} } } end, "landing.path has no points")
    fails(function() run:check{ landing = { path = { { 0, 0 } } } } end, "landing.path[1]")
    fails(function() run:check{ landing = { path = { { 0, 0, 0 } }, wire = "v" } } end, "landing.wire = 'v'")
    for words, curve in pairs{ ["fewer than 2 points"] = { { 1, 2 } },
      ["curve[2]: each range must be larger"] = { { 1, 2 }, { 2, 2 } },
      ["curve[1][1] = 0 N"] = { { 0, 1 }, { 1, 2 } }, ["curve[1] must be"] = { 1, 2 } } do
      fails(function() run:check{ fatigue = { curve = curve } } end, words)
    end
    fails(function() run.check {} end, "run:check")
    local check = run:check{}
    fails(function() check.verdict = "PASS" end, "can only be read")
    fails(function() return check.verdcit end, "did you mean 'verdict'?")
    fails(function() check:csv() end, "check:csv expects the name of a .csv file, got nil")
    fails(function() check.json "x" end, "check:json is a method: call it with a colon")
  end)

  it("is refused when the script's own check advances the scene", function()
    local other, its_scene = laying()
    fails(function()
      other:check{ checks = { { name = "x", unit = "m", max = 1, of = function()
        its_scene:settle{ max_iterations = 1 }
        return 0
      end } } }
    end, "scene:settle: scene 'lay' cannot be changed inside the function `of` of the check 'x'")
    other, its_scene = laying()
    fails(function()
      other:check{ checks = { { name = "x", unit = "m", max = 1, of = function()
        return its_scene:run{ duration = 0.01, dt = 0.005 }.time
      end } } }
    end, "cannot be run inside the function `of` of the check 'x'")
  end)

  it("is open where the cable has no limit for the use", function()
    local own = sw.cable.define{ name = "only fixed", outer_diameter = 0.003, mass_per_length = 0.02,
      EA = 1e4, EI = 1e-3, GJ = 1e-3, friction = 0.3, temperature = { low = -20, high = 80 },
      bend = { fixed = 4 }, flag = "guessed", source = "this spec", spread = 0.1 }
    local other = laying{ cable = own }
    local row = other:check{}:row "min_bend_radius"
    assert.same({ "catalogue", 4 * 0.003 }, { row.from, row.limit })
    row = other:check{ use = "movement" }:row "min_bend_radius"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("no bend limit for the use 'movement'", 1, true), row.note)
  end)

  it("is open where there is no wire to judge", function()
    local loose = sw.scene{}
    loose:particles{ positions = { { 0, 0, 0 }, { 0.1, 0, 0 } }, masses = 0.1, radius = 0.01 }
    local check = loose:run{ duration = 0.01, dt = 0.005 }:check{}
    assert.same({ "OPEN", "OPEN" }, { check.verdict, check:row "wires".verdict })
  end)

  it("needs the wanted path for a landing error", function()
    local row = run:check{ limits = { landing_error = 0.01 } }:row "landing_error"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("the wanted path is missing", 1, true), row.note)
    row = run:check{ landing = { path = { { 0, 0, 0.0015 }, { 1, 0, 0.0015 } } } }:row "landing_error"
    assert.equal("OPEN", row.verdict)
    local beyond = { path = { { 0, 0, 0.0015 }, { 1, 0, 0.0015 } }, from = 5 }
    row = run:check{ limits = { landing_error = 1 }, landing = beyond }:row "landing_error"
    assert.equal("FAIL", row.verdict, "nothing of the wire is there")
    beyond.to = 1
    fails(function() run:check{ landing = beyond } end, "landing: from = 5 m is beyond to = 1 m")
  end)

  it("fails at slips, losses and crashes, and describes the first", function()
    scene:tell{ kind = "crash", object = "left", value = 0.003, text = "left runs into the table" }
    -- told after the end of a run, the crash does not count in the next run
    local again = scene:run{ duration = 0.01, dt = 0.005 }
    assert.equal("PASS", again:check{}:row "events".verdict)
    local crash = sw.scene{ name = "crash" }
    crash:obstacle{ name = "table", shape = "plane" }
    local w = crash:wire{ cable = "GXL 1.5", from = { 0, 0, 0.05 }, to = { 0.2, 0, 0.05 } }
    local hand = crash:gripper{ name = "hand" }
    crash:process(function()
      hand:grasp(w, { s = 0.1 })
      hand:move{ by = { 0, 0, -0.055 }, duration = 0.3 }
    end)
    local row = crash:run{ dt = 0.005 }:check{}:row "events"
    assert.equal("FAIL", row.verdict)
    assert.is_true(row.value >= 1 and row.time > 0)
    assert.truthy(row.note:find("table", 1, true), row.note)
  end)
end)
