-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of runs with broken ties or slip, of runs that were cut short or lack data; error bars of a run.
local sw = require "softworld"
local laid = require "spec.check.laid"

local laying, wide, fails = laid.laying, laid.wide, laid.fails

describe("run:check of broken ties and slipping wires", function()
  it("fails where a tie breaks", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    scene:tie(wire, { name = "t", s = 0.2, strength = 3, stiffness = 1e4 })
    local hand = scene:gripper{ name = "hand" }
    scene:process(function()
      hand:grasp(wire, { s = 0.19 })
      hand:move{ by = { 0, 0, 1e-3 }, duration = 0.1 }
    end)
    local row = scene:run{ dt = 0.001 }:check{}:row "events"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("a tie of wire 'w' breaks at", 1, true), row.note)
  end)

  -- A slip below the gripper's slip tolerance has no event.
  it("fails where the friction is used up, even if the slip is too small for an event", function()
    for _, force in ipairs{ 0.3, 0.5, 1.1 } do
      local scene = sw.scene{}
      scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.0015 },
        to = { 0.3, 0, 0.0015 }, segments = 30 }
      scene:clamp(wire, { s = 0 })
      local hand = scene:gripper{ name = "hand", at = { 0.28, 0, 0.0015 }, slip_tolerance = 0.01,
        pads = { width = 0.02, friction = 0.3, opening = 0.006 } }
      scene:process(function()
        hand:grasp(wire, { s = 0.28, approach = "plates", force = force })
        hand:move{ by = { 0.0009, 0, 0 }, duration = 0.2 }
      end)
      local check = scene:run{ dt = 0.005 }:check{}
      assert.equal("PASS", check:row "events".verdict)
      assert.is_true(check:row "peak_margin".value >= 1)
      assert.equal("FAIL", check:row "peak_margin".verdict)
    end
  end)
end)

describe("run:check of a wire without an entry of the catalogue", function()
  it("is open, and names what is missing", function()
    local run = laying{ EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = 0.0015 }
    local check = run:check{ limits = wide() }
    assert.equal("OPEN", check.verdict)
    for name, words in pairs{ min_bend_radius = "its wire has no entry of the catalogue",
      max_tension = "the catalogue has no breaking_load here" } do
      assert.equal("OPEN", check:row(name).verdict)
      assert.truthy(check:row(name).note:find(words, 1, true), check:row(name).note)
    end
  end)

  it("judges by the breaking load that the wire was given", function()
    local run = laying{ EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = 0.0015, breaking_load = 1e-6,
      breaking_flag = "measured" }
    local row = run:check{}:row "max_tension"
    assert.same({ "FAIL", "user", "breaking load of the wire, measured" },
      { row.verdict, row.from, row.source })
  end)
end)

describe("run:check of a run that is not whole", function()
  local function refused(run, words)
    local check = run:check{ limits = { cycle_time = 100 } }
    assert.same({ "FAIL", 1, false }, { check.verdict, #check.rows, check.ok })
    assert.truthy(check.reason:find(words, 1, true), check.reason)
    for _, key in ipairs{ "value", "limit", "margin", "error" } do assert.is_nil(check.rows[1][key]) end
    assert.truthy(tostring(check):find(words, 1, true))
  end

  it("fails with its reason and no numbers: too few steps", function()
    refused(laying(nil, { max_steps = 20 }), "the run was cut short: the allowed number of steps was used")
  end)

  it("fails: the run's time ended before the process", function()
    refused(laying(nil, { duration = 0.3 }),
      "the run was cut short: 0.3 s have passed, and a process has not ended")
  end)

  it("fails: stopped by an observer", function()
    local scene = sw.scene{}
    scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    scene:observe{ every = 0.05, call = function(o) if o.calls > 1 then o:stop "enough" end end }
    refused(scene:run{ duration = 1, dt = 0.01 }, "the run was cut short: enough")
  end)

  it("fails: it diverged", function()
    local scene = sw.scene{ name = "wild" }
    local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1 },
      to = { 0.5, 0, 0.1 } }
    scene:clamp(wire, { s = 0 })
    refused(scene:run{ duration = 1, dt = 1.2 * scene:stable_dt(), integrator = "velocity-verlet",
      unstable = true }, "the run FAILED")
  end)

  it("fails: its error bars were refused", function()
    local scene = sw.scene{ name = "bars" }
    local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1 },
      to = { 0.5, 0, 0.1 } }
    scene:clamp(wire, { s = 0 })
    refused(scene:run{ duration = 0.3, dt = 0.01, integrator = "velocity-verlet", unstable = true,
      tolerance = { tip = 1e-3 } }, "the run FAILED")
  end)

  it("is refused once the scene has advanced, or was restored", function()
    local run, scene = laying()
    local snapshot = scene:snapshot()
    scene:run{ duration = 0.01, dt = 0.005 }
    fails(function() run:check{} end, "has gone on since this run")
    scene:restore(snapshot)
    fails(function() run:check{} end, "when a snapshot was restored")
  end)

  it("is refused once the scene has settled, because settling clears the peaks", function()
    local scene = sw.scene{}
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 20 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.3 }):follow{ points = { { 0, 0, 0 }, { -0.05, 0, 0 } }, relative = true,
      duration = 0.2 }
    assert(scene:settle().ok)
    local run = scene:run{ duration = 0.2, dt = 0.005 }
    local most = wire:max_tension()
    assert.equal(most, run:check{}:row "max_tension".value)
    assert(scene:settle().ok)
    assert.is_true(wire:max_tension() < most)
    fails(function() run:check{} end, "has gone on since this run", "before scene:settle")
  end)

  it("is open where a wire was removed", function()
    local scene = sw.scene{}
    local wires = {}
    for k = 1, 2 do
      wires[k] = scene:wire{ name = "w" .. k, cable = "GXL 1.5", from = { 0, k, 0 }, to = { 0.2, k, 0 } }
    end
    scene:process(function(p)
      p:wait(0.02)
      scene:remove(wires[1])
      p:wait(0.02)
    end)
    local check = scene:run{ dt = 0.01 }:check{}
    assert.equal("OPEN", check:row "w1.removed".verdict)
    assert.equal("w2", check:row "max_tension".object)
  end)
end)

describe("error bars of a run", function()
  it("leave a row open when they cover its limit", function()
    local function run_of()
      local scene = sw.scene{ gravity = { 0, 0, -9.81 } }
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
        segments = 16 }
      scene:clamp(wire, { s = 0 })
      return scene:run{ duration = 0.05, dt = 0.005,
        tolerance = { ["w.min_bend_radius"] = 0.5, own = nil, { name = "own", value = 1, unit = "m",
          of = function() return wire:position(0.2)[3] end } } }, wire
    end
    local run, wire = run_of()
    assert(run.ok, run.reason)
    local bar = run.quantities["w.min_bend_radius"].error
    assert.is_true(bar > 0)
    local inside = wire:min_bend_radius() - wire.radius
    local function verdict(limit)
      local check = run:check{ limits = { min_bend_radius = { min = limit, sure = true } } }
      local row = check:row "min_bend_radius"
      assert.equal(bar, row.error)
      return row.verdict
    end
    assert.equal("OPEN", verdict(inside))
    assert.equal("OPEN", verdict(inside - 0.5 * bar))
    assert.equal("PASS", verdict(inside - 1.01 * bar))
    assert.equal("FAIL", verdict(inside + 1.01 * bar))
    local own = run:check{ checks = { { name = "own", unit = "m", max = 1, of = function()
      return wire:position(0.2)[3]
    end } } }:row "own"
    assert.equal(run.quantities.own.error, own.error)
  end)
end)
