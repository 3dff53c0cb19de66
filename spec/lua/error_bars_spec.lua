-- SPDX-License-Identifier: GPL-3.0-or-later
-- Error bars: names of quantities, answers, refusals; a scene is never left half done.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local program = require "spec.host.program"
local t = require "spec.physics.tools"
local cantilever = require "spec.lua.cantilever"

local make = cantilever.make

local function state(scene, wire)
  local x, s = wire:positions()
  return { x = x, s = s, v = wire:velocities(), e = scene:energy().total, t = scene.time }
end

describe("an equilibrium with error bars", function()
  it("gives value, error and unit, and leaves the scene at its finest mesh", function()
    local scene, wire, clamp = make()
    local r = t.fine(scene:settle{ tolerance = { tip = 1e-4, ["clamp1.moment"] = 1e-3, max_tension = 0.01,
      { name = "sag", value = 1e-4, unit = "m", of = function() return -wire:position(0.5)[3] end } } })
    assert.is_true(r.met)
    local q = r.quantities
    assert.are.same({ "sag", "clamp1.moment", "max_tension", "tip" }, r.asked)
    assert.are.same({ "m", "N m", "N", "m" }, { q.sag.unit, q["clamp1.moment"].unit, q.max_tension.unit,
      q.tip.unit })
    assert.are.same(wire:position(1), q.tip.value)
    assert.are.equal(-wire:position(0.5)[3], q.sag.value)
    assert.are.same(clamp:moment(), q["clamp1.moment"].value)
    local tension, s = wire:max_tension()
    assert.are.same({ tension, s }, { q.max_tension.value, q.max_tension.where })
    for _, one in pairs(q) do
      assert.is_true(one.error > 0 and one.error <= one.tolerance and one.met, one.name)
      assert.are.equal(#r.levels, #one.levels)
    end
    assert.are.equal(r.levels[#r.levels].segments[1], wire.segments)
    assert.is_true(wire.segments >= 12)
    assert.matches("sag = .* mm %+%- .* um %(asked for 100.0 um: met%)", tostring(r:error_bars()))
    assert.matches("tip = %(0%.", tostring(r))
    local moment = q["clamp1.moment"]
    moment.value[1], moment.value[3] = 1e-17, -1e-19 -- rounding of another machine
    assert.matches("^%(0, %-?0%.%d+, 0%) N m %+%-", tostring(moment))
  end)

  it("names the tolerances that it missed, and the levels that they need", function()
    local scene = make()
    local r = t.fine(scene:settle{ tolerance = { tip = 1e-6 }, levels = 4 })
    assert.is_false(r.met)
    assert.is_false(r.quantities.tip.met)
    local least = r.quantities.tip.error
    assert.is_true(least > 1e-6 and least < 1e-2)
    local levels = tonumber(r.advice:match "levels = (%d+)")
    assert.is_true(levels > 4, r.advice)
    scene = make()
    local better = t.fine(scene:settle{ tolerance = { tip = 1e-6 }, levels = levels + 1 })
    assert.is_true(better.met, better.advice)
    assert.is_nil(tostring(better):find("NOT met", 1, true))
    assert.matches("^settled on %d levels, 1 of 1 tolerances NOT met: tip\n", tostring(r))
    -- far out of reach: finer levels are not computed
    scene = make()
    local hopeless = t.fine(scene:settle{ tolerance = { tip = 1e-14 } })
    assert.is_false(hopeless.met)
    assert.are.equal(3, #hopeless.levels)
    assert.matches("needs more than levels = 12: give a larger tolerance", hopeless.advice)
  end)

  it("knows every quantity of the objects", function()
    local scene, wire = make()
    scene:obstacle{ shape = "plane", at = { 0, 0, -0.3 }, friction = 0.3, name = "table" }
    local left = scene:gripper{ name = "left" }
    left:grasp(wire, { s = 0.6 })
    local list = {}
    for _, name in ipairs{ "tip", "position", "max_tension", "min_bend_radius", "max_strain", "max_stress",
      "wire1.tip", "clamp1.force", "clamp1.moment", "left.force", "left.moment", "peak_force",
      "mean_force", "peak_moment", "mean_moment", "impulse", "table.force", "energy", "penetration" } do
      list[name] = 1e3
    end
    local r = t.fine(scene:settle{ tolerance = list })
    assert.is_true(r.met)
    for name in pairs(list) do assert.is_true(r.quantities[name].error < 1e3, name) end
    assert.are.equal(41, #r.quantities.position.value)
  end)

  it("writes its progress when asked", function()
    local script = [[
      local scene = require "softworld".scene { name = "mine" }
      scene:clamp(scene:wire { E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 },
        segments = 24 }, { s = 0 })
      assert(scene:settle { tolerance = { tip = 1 }, progress = %s }.events)
      assert(scene:run { duration = 0.01, tolerance = { tip = 1 }, progress = %s }.events)]]
    local _, err, code = program.script(script:format("true", "true"))
    assert.are.equal(0, code, err)
    assert.matches("^mine, level 1, 6 segments: at rest, %d+ iterations\nmine, level 2, 12", err)
    assert.matches("mine, level 3, 24 segments: t = 10.00 ms, %d+ steps in", err)
    _, err = program.script(script:format("nil", "nil"))
    assert.are.equal("", err)
    program.clean()
    assert.has_error(function() make():settle{ tolerance = { tip = 1 }, progress = 3 } end)
  end)

  it("covers wires that touch each other", function()
    local scene = sw.scene{}
    local lower = scene:wire{ name = "lower", EA = 1e3, EI = 1e-3, mass_per_length = 0.03, radius = 0.002,
      from = { -0.2, 0, 0 }, to = { 0.2, 0, 0 }, segments = 24 }
    scene:wire{ name = "upper", EA = 1e3, EI = 1e-3, mass_per_length = 0.03, radius = 0.002,
      from = { 0, -0.1, 0.005 }, to = { 0, 0.1, 0.005 }, segments = 24 }
    scene:clamp(lower, { s = 0 })
    scene:clamp(lower, { s = lower.length })
    scene:wire_contact{ friction = 0.3 }
    scene:force{ kind = "damping", mass = 5 }
    local r = t.fine(scene:run{ duration = 0.5, tolerance = { ["lower.max_tension"] = 0.1,
      ["upper.position"] = 0.02 } })
    assert.is_true(r.met and #scene:touches() > 0)
    assert.is_true(r.quantities["lower.max_tension"].value > 0.5)
  end)

  it("gives no numbers where there is no equilibrium", function()
    local scene, wire = make()
    local clamp_free = sw.scene{}
    local loose = clamp_free:wire{ E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 0 },
      to = { 1, 0, 0 }, segments = 8 }
    local before = state(clamp_free, loose)
    local r = clamp_free:settle{ tolerance = { tip = 1e-3 }, max_iterations = 50 }
    assert.is_false(r.ok)
    assert.matches("level 3, 24 segments: ", r.where)
    assert.is_truthy(r.advice)
    assert.has_error(function() return r.quantities end)
    assert.has_error(function() return r:error_bars() end)
    assert.matches("there are no numbers: ", select(2, pcall(function() return r.quantities.tip end)))
    assert.matches("not settled", tostring(r))
    assert.are.same(before, state(clamp_free, loose))
    assert.is_true(scene:settle().ok and wire.segments == 12)
  end)
end)

describe("a run with error bars", function()
  it("ends like a plain run with the finest mesh and step, bit for bit", function()
    local function build_scene(segments)
      local scene, wire = make(segments)
      local left, log = scene:gripper{ name = "left" }, {}
      scene:process(function(p)
        log[#log + 1] = wire.segments
        left:grasp(wire, { s = 0.9 })
        left:move{ by = { 0, 0, 0.1 }, duration = 0.2 }
        p:wait(0.1)
        left:release()
        p:wait(0.1)
      end)
      return scene, wire, left, log
    end
    local scene, wire, left, log = build_scene(24)
    local r = t.fine(scene:run{ dt = 0.01, integrator = "bdf2",
      tolerance = { ["left.peak_force"] = 0.5, tip = 3e-3 } })
    local k = #r.levels
    assert.are.equal(k, #log) -- the function ran once per level
    local plain, plain_wire, plain_left = build_scene(6 << (k - 1))
    t.fine(plain:run{ dt = 0.01 / 2 ^ (k - 3), integrator = "bdf2", parts = false })
    assert.are.same(state(plain, plain_wire), state(scene, wire))
    assert.are.equal(plain_left.peak_force, left.peak_force)
    assert.are.equal(left.peak_force, r.quantities["left.peak_force"].value)
    assert.is_true(r.quantities["left.peak_force"].when > 0)
    assert.are.equal(scene.time, r.time)
    assert.is_true(#r:series().time > 10 and #r:frames() > 5)
  end)

  it("reads quantities at their own times", function()
    local scene, wire = make(24)
    local seen = {}
    local function tip() return wire:position(1) end
    local r = t.fine(scene:run{ duration = 0.2, tolerance = {
      { name = "a", value = 1e-3, unit = "m", at = 0.05, of = tip },
      { name = "b", value = 1e-3, unit = "m", at = 0.2, of = tip },
      { name = "c", value = 1e-3, unit = "m", of = tip },
      { name = "t", value = 1, unit = "s", at = 0.125, of = function()
        seen[#seen + 1] = scene.time
        return scene.time + 1
      end } } })
    assert.are.same(r.quantities.b.value, r.quantities.c.value)
    assert.is_true(t.distance(r.quantities.a.value, r.quantities.c.value) > 0.01)
    t.near(0.05, r.quantities.a.when, 1e-12, "time of a")
    for _, time in ipairs(seen) do t.near(0.125, time, 1e-12, "time of t") end
    assert.are.equal(#r.levels, #seen)
  end)

  it("starts each level from its own equilibrium where the scene is at rest", function()
    -- hanging still after settling: nothing may begin to swing on any level
    local scene, wire = make(24)
    t.fine(scene:settle())
    local r = t.fine(scene:run{ duration = 0.1, tolerance = { tip = 1e-3 } })
    for _, v in ipairs(wire:velocities()) do t.below(1e-6, math.abs(v), "speed") end
    assert.is_true(#r.levels >= 3)
    -- a wire that was just released must move
    local pin_scene, pin_wire = make(24)
    local pin = pin_scene:pin(pin_wire, { s = 1 })
    t.fine(pin_scene:settle())
    pin:release()
    t.fine(pin_scene:run{ duration = 0.1, tolerance = { tip = 1e-2 } })
    t.above(0.1, t.norm(pin_wire:velocity(1)), "speed of the end")
  end)

  it("leaves out a level that fails, and fails when the finest one does", function()
    local function with_limit(low, high)
      local scene, wire = make(24)
      scene:force{ on = wire, kind = function(_, x, _, f)
        local n = #x / 3 - 1
        if n >= low and n <= high then f[#f] = f[#f] + 1e9 end
      end }
      return scene, wire
    end
    local scene = with_limit(0, 8)
    local r = t.fine(scene:run{ duration = 0.1, tolerance = { tip = 1e-3 } })
    assert.is_false(r.levels[1].ok)
    assert.are.equal(#r.levels - 1, #r.quantities.tip.levels)
    local wire
    scene, wire = with_limit(0, 1e9)
    local before = state(scene, wire)
    r = scene:run{ duration = 0.1, tolerance = { tip = 1e-3 } }
    assert.is_false(r.ok)
    assert.are.equal(3, #r.levels)
    assert.is_false(r.met)
    assert.matches("^level 3, 24 segments: at t = ", r.where)
    assert.matches("^run of 'bench': FAILED", tostring(r))
    assert.matches("smaller dt", r.advice)
    r = scene:run{ duration = 0.1, tolerance = { tip = 1e-3 }, integrator = "rk4", dt = 1,
      unstable = true }
    assert.is_false(r.ok)
    assert.matches("stable_dt", r.advice)
    assert.has_error(function() return r.quantities end)
    assert.has_error(function() return r:error_bars() end)
    assert.has_error(function() return r:series() end)
    assert.are.same(before, state(scene, wire))
  end)

  -- A wire over a peg, 4 times as long on one side as on the other; friction bears only exp(0.2 pi) = 1.9
  -- times. Long edges catch on the many small faces that stand for the peg; shorter edges find no
  -- equilibrium.
  it("fails where its levels have no equilibrium to begin with", function()
    local scene, points = sw.scene{ name = "slides" }, {}
    for i = 1, 24 do
      local x, z = 0.01 * math.cos(i * math.pi / 12), 0.01 * math.sin(i * math.pi / 12)
      for _, value in ipairs{ x, -0.1, z, x, 0.1, z } do points[#points + 1] = value end
    end
    scene:obstacle{ name = "peg", shape = "hull", points = points, friction = 0.2, at = { 0, 0, -0.011 } }
    local wire = scene:wire{ EA = 100, EI = 1e-6, mass_per_length = 0.01, radius = 0.001, segments = 5,
      from = { -0.1, 0, 0 }, to = { 0.4, 0, 0 } }
    t.fine(scene:settle())
    local before = state(scene, wire)
    local r = scene:run{ duration = 0.1, tolerance = { tip = 0.01 } }
    assert.is_false(r.ok)
    assert.is_false(r.met)
    assert.matches("^at t = 0 s: no equilibrium to begin with: wire 'wire1', which nothing holds, ", r.reason)
    assert.matches("^level 4, 40 segments: at t = 0 s: no equilibrium", r.where)
    assert.matches("^run of 'slides': FAILED %(at t = 0 s: no equilibrium to begin with", tostring(r))
    assert.same({ 0, 0, 0 }, { r.steps, r.start, r.time })
    for _, read in ipairs{ "error_bars", "series" } do
      local fine, why = pcall(r[read], r)
      assert.is_false(fine)
      assert.matches("no equilibrium to begin with", why)
    end
    assert.matches("there are no numbers: at t = 0 s: no equilibrium",
      select(2, pcall(function() return r.quantities.tip end)))
    assert.same({}, r:frames())
    assert.same(before, state(scene, wire))
    r = scene:run{ duration = 0.1, tolerance = { tip = 0.01 }, model = "auto", integrator = "bdf2" }
    assert.is_false(r.ok)
    assert.matches("no equilibrium to begin with", r.reason)
    r = scene:run{ duration = 0.1, check = { trial = true, limits = { max_tension = 5 } } }
    assert.is_false(r.ok)
    assert.equal("FAIL", r:check().verdict)
    assert.same(before, state(scene, wire))
  end)

  it("shows its bars in the summary and the document", function()
    local scene = make(24)
    local earlier = t.fine(scene:run{ duration = 0.05 })
    local r = t.fine(scene:run{ duration = 0.05, tolerance = { tip = 1e-2, max_tension = 1e-9 } })
    local text = {}
    r:summary{ write = function(_, line) text[#text + 1] = line end }
    text = table.concat(text)
    assert.matches("max_tension .* %+%- .* %(NOT as asked%)", text)
    assert.matches("tip +%(0%..-%) m +%+%- .* um", text)
    assert.is_false(r.met)
    assert.matches("\n  ! 1 of 2 tolerances NOT met: max_tension %(.*levels", text)
    assert.matches("ok .*, 1 of 2 tolerances NOT met: max_tension, t = .* levels, .*\nmax_tension = ",
      tostring(r))
    local doc = r:document()
    assert.is_false(doc.met)
    assert.are.equal("max_tension", doc.quantities[1].name)
    assert.is_false(doc.quantities[1].met)
    assert.are.equal(r.quantities.tip.error, doc.quantities[2].error)
    local path = os.tmpname()
    os.remove(path)
    r:save(path .. ".json")
    local file <close> = assert(io.open(path .. ".json"))
    os.remove(path .. ".json")
    assert.matches('"quantities":%[{.-"name":"max_tension"', (file:read "a"))
    assert.is_true(#earlier:series().time > 0) -- what came before is still there
    assert.has_error(function() return earlier:error_bars() end)
    assert.is_nil(earlier.quantities)
  end)

  it("can be followed by another run with error bars", function()
    local scene, wire = make(12)
    local first = t.fine(scene:run{ duration = 0.1, tolerance = { tip = 1e-3 } })
    local second = t.fine(scene:run{ duration = 0.1, tolerance = { tip = 1e-3 } })
    t.near(0.2, scene.time, 1e-12, "time")
    assert.is_true(first.met and second.met)
    local whole, whole_wire = make(48)
    t.fine(whole:run{ duration = 0.2, dt = 1e-3 })
    t.below(first.quantities.tip.error + second.quantities.tip.error + 1e-3,
      t.distance(wire:position(1), whole_wire:position(1)), "tip off")
  end)
end)
