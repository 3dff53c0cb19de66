-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ties to points and between wires: pull, slack, breaking, snapshots, every model.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local meshes = require "spec.physics.meshes"

local G = 9.81

local function rod(scene, options)
  local o = options or {}
  return scene:wire{ name = o.name, E = o.E or 1e9, density = 1200, radius = 0.003,
    segments = o.segments or 20, from = o.from or { 0, 0, 0 }, to = o.to or { 0.4, 0, 0 }, model = o.model }
end

local function damped(scene, wire) scene:force{ kind = "damping", on = wire, mass = 20, stiffness = 2e-3 } end

describe("a tie to a point", function()
  -- A string that nothing else holds has no rest without the tie: poses fail. Their trial positions are
  -- freed when the tie is asked again whether it may break (only a sanitizer sees the fault).
  it("may be the only hold of a wire in poses that fail", function()
    local scene = sw.scene{}
    local wire = rod(scene, { model = "string" })
    scene:tie(wire, { s = 0.16, strength = 0.03 })
    local run = scene:run{ duration = 0.004, max_steps = 8, quasistatic = true }
    assert.is_true(run.ok or #run.reason > 20)
  end)

  -- A reading of forces between two ties makes the scene's system anew, a reading of places does not. The
  -- ties, a save and a snapshot between them do not depend on that.
  it("is the same whether or not something was read before the next one", function()
    local function hung(between)
      local scene = sw.scene{}
      local wire, ties, kept = rod(scene), {}, nil
      scene:obstacle{ shape = "plane", at = { 0, 0, -0.005 } }
      t.fine(scene:run{ duration = 0.02, dt = 5e-3 })
      for k = 1, 12 do
        ties[k] = scene:tie(wire, { s = k / 31, slack = k % 3 == 0 and 0.001 or nil })
        if k == 6 then kept = scene:snapshot() end
        between(scene, wire, k)
      end
      t.fine(scene:run{ duration = 0.02, dt = 5e-3 })
      local at, pull = wire:positions(), {}
      for k, tie in ipairs(ties) do pull[k] = tie:tension() end
      scene:restore(kept)
      t.fine(scene:run{ duration = 0.02, dt = 5e-3 })
      return { at, pull, (wire:positions()) }
    end
    local plain = hung(function() end)
    assert.same(plain, hung(function(scene) scene:energy() end))
    assert.same(plain, hung(function(_, wire) wire:tension(0.1) end))
    assert.same(plain, hung(function(scene, wire, k)
      if k == 4 then assert.equal(0, scene:contacts()) end
      if k == 8 then
        local path = os.tmpname()
        scene:save(path)
        os.remove(path)
      end
      wire:velocity(0.1)
    end))
  end)

  -- 48 times the time if each tie has the others built in anew.
  it("takes as long as any other, however many there are", function()
    local function seconds(count)
      local scene = sw.scene{}
      local wire, start = rod(scene, { segments = 200 }), os.clock()
      for k = 1, count do scene:tie(wire, { s = 0.4 * (k - 0.5) / count }) end
      return os.clock() - start
    end
    local few, many = seconds(250), seconds(1000)
    assert(many < 16 * few, ("%.3g s for 250 ties, %.3g s for 1000"):format(few, many))
  end)

  -- Two ties at its quarters hang a rod up. Each bears half of m g and stretches by that over its
  -- stiffness. Each s lies between nodes, which must not matter.
  for _, model in ipairs{ "string", "rod" } do
    it("bears a " .. model .. " by force over stiffness", function()
      local scene = sw.scene{}
      local wire = rod(scene, { model = model })
      damped(scene, wire)
      local ties = {}
      for i, s in ipairs{ 0.1037, 0.2963 } do
        ties[i] = scene:tie(wire, { s = s, to = { s, 0, 0.05 }, slack = 0.04, stiffness = 2e4 })
      end
      t.fine(scene:run{ duration = 2, dt = 5e-3 })
      local half = 0.5 * wire.beam.mass_per_length * wire.length * G
      for _, tie in ipairs(ties) do
        t.share(half, tie:force()[3], model == "rod" and 1e-3 or 5e-3, "force")
        t.share(t.norm(tie:force()), tie:tension(), 1e-9, "tension")
        t.share(0.04 + tie:tension() / 2e4, tie:distance(), 1e-9, "distance")
        t.above(tie:tension() * 0.999, tie.raw_peak_force, "peak")
      end
    end)
  end

  for _, model in ipairs(meshes.few) do
    it("bears a wire that is a " .. model[1], function()
      local scene, wire = meshes.scene(model, { gravity = { 0, 0, -G }, E = 1e8 })
      scene:force{ kind = "damping", on = wire, mass = 30 }
      local sum, ties = 0, {}
      for i, s in ipairs{ 0.137, 0.363 } do ties[i] = scene:tie(wire, { s = s, stiffness = 1e4 }) end
      t.fine(scene:run{ duration = 0.6, dt = 1e-2 })
      for _, tie in ipairs(ties) do sum = sum + tie:force()[3] end
      t.share(wire.beam.mass_per_length * wire.length * G, sum, 5e-3, "weight")
    end)
  end

  it("holds the wire where it is if no place is given, from mid-run on", function()
    local scene = sw.scene{}
    local wire = rod(scene)
    damped(scene, wire)
    t.fine(scene:run{ duration = 0.1, dt = 5e-3 })
    local at = wire:position(0.2)
    scene:tie(wire, { s = 0.2 })
    t.fine(scene:run{ duration = 1, dt = 5e-3 })
    t.below(1e-4, t.distance(at, wire:position(0.2)), "way of the tied place") -- m g / 1e5 N/m, and swinging
    t.below(at[3] - 5e-4, wire:position(0)[3], "height of the end") -- a cantilever's w L^4/(8 EI) is 1.05 mm
  end)

  it("leaves the wire alone within its slack", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = rod(scene)
    local tie = scene:tie(wire, { s = 0.2, to = { 0.2, 0.1, 0 } }) -- the slack is the distance
    wire:set_velocity{ 0, 0.5, 0 }
    t.fine(scene:run{ duration = 0.3, dt = 5e-3 }) -- up to y = 0.15, never more than 0.1 m from y = 0.1
    t.near(0.15, wire:position(0.2)[2], 1e-9, "place")
    assert.are.equal(0, tie.raw_peak_force)
    t.fine(scene:run{ duration = 0.2, dt = 1e-3 })
    assert.is_true(tie.raw_peak_force > 0)
  end)

  -- The pull grows; the tie breaks at the first step whose pull is above the strength.
  it("breaks at its strength, records the time, and bears no force after that", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = rod(scene, { E = 1e11 })
    damped(scene, wire)
    local tie = scene:tie(wire, { name = "t", s = 0.2, strength = 3, stiffness = 1e4 })
    local hand = scene:grip(wire, { s = 0.2 })
    hand:follow(sw.trajectory{ points = { { 0, 0, 0 }, { 0, 0, -1e-3 } }, duration = 1, law = "linear",
      relative = true })
    t.fine(scene:run{ duration = 0.28, dt = 1e-3 })
    t.share(2.8, tie:tension(), 1e-6, "pull before")
    t.share(2.8, tie:force()[3], 1e-6, "force")
    assert.is_nil(tie.broken)
    local snapshot = scene:snapshot()
    for _ = 1, 2 do
      local run = t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
      t.near(0.301, tie.broken.time, 1.001e-3, "time") -- 3 N is at 0.3 s
      t.near(3.01, tie.broken.force, 0.011, "force")
      assert.are.equal(0, tie:tension())
      t.below(1e-3, t.norm(hand:force()), "force of the hand") -- damping at 1 mm/s: 0.3 mN
      assert.is_truthy(require "softworld.output.summary".text(run:document()):find("t: BROKE at", 1, true))
      assert.is_truthy(tostring(tie):find "broken")
      scene:restore(snapshot)
      assert.is_nil(tie.broken)
      t.share(2.8, tie:tension(), 1e-6, "pull after restoring")
    end
    tie:release()
    assert.has_error(function() tie:tension() end,
      "tie 't' was released, or taken back when a snapshot was restored")
  end)

  it("refuses arguments that make no sense, naming them", function()
    local scene = sw.scene{}
    local wire = rod(scene, { name = "w" })
    local function refused(message, args)
      args.name = "t"
      local ok, text = pcall(scene.tie, scene, wire, args)
      assert.is_false(ok)
      assert.is_truthy(text:find(message, 1, true), text)
    end
    refused("tie 't': s is required, at least 0 m", {})
    refused("tie 't': s = 0.5 m is beyond the end of wire 'w' at 0.4 m", { s = 0.5 })
    refused("tie 't': to must be a table of 3 finite numbers [m]", { s = 0.1, to = { 1, 2 } })
    refused("tie 't': slack = -1 m is not allowed", { s = 0.1, slack = -1 })
    refused("tie 't': strength = 0 N is not allowed", { s = 0.1, strength = 0 })
    refused("there is no parameter 'strenght'; did you mean 'strength'?", { s = 0.1, strenght = 1 })
    refused("tie 't': to[1] must be a wire (from scene:wire), got a scene",
      { s = 0.1, to = { scene, s = 0.1 } })
    refused("tie 't': to.s is required", { s = 0.1, to = { wire } })
    assert.are.equal("t", scene:tie(wire, { s = 0.1, name = "t" }).name)
  end)
end)

describe("a tie of two wires", function()
  -- The upper rod is clamped; the lower one hangs from it by two ties.
  local function hung(options)
    local o = options or {}
    local scene = sw.scene{}
    local upper = rod(scene, { name = "upper" })
    local lower = rod(scene, { name = "lower", from = { 0, 0, -0.006 }, to = { 0.4, 0, -0.006 },
      model = o.model })
    scene:clamp(upper, { s = 0 })
    scene:clamp(upper, { s = 0.4 })
    damped(scene, nil)
    local ties = {}
    for i, s in ipairs{ 0.1, 0.3 } do
      ties[i] = scene:tie(lower, { s = s, to = { upper, s = s }, strength = o.strength, stiffness = 2e4 })
    end
    return scene, upper, lower, ties
  end

  for _, model in ipairs{ "rod", "string" } do
    it("hangs one from the other, a " .. model, function()
      local scene, _, lower, ties = hung{ model = model }
      t.fine(scene:run{ duration = 1, dt = 5e-3 })
      local weight = lower.beam.mass_per_length * lower.length * G
      t.share(weight, ties[1]:force()[3] + ties[2]:force()[3], 2e-3, "force on the lower wire")
      for _, tie in ipairs(ties) do
        t.share(0.006 + tie:tension() / 2e4, tie:distance(), 1e-6, "distance")
      end
      t.share(ties[1]:tension() ^ 2 / 2e4, scene:energy().join, 1e-3, "energy of both")
    end)
  end

  -- Both wires fly and turn together. Ties are inner forces: momentum stays, and angular momentum stays as
  -- exactly as steps of this size keep it for one turning wire (3e-4).
  it("passes on momentum and angular momentum, and keeps their sums", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local a = rod(scene)
    local b = rod(scene, { from = { 0, 0.01, 0 }, to = { 0.4, 0.01, 0 } })
    local tie = scene:tie(a, { s = 0.1, to = { b, s = 0.3 }, slack = 0.25 })
    a:set_velocity({ 0, 0, 1 }, { 0, 3, 0 }, { 0.2, 0, 0 })
    local p, l = t.momentum(a)
    t.fine(scene:run{ duration = 0.5, dt = 5e-4 })
    local p1, l1 = t.momentum(a)
    local p2, l2 = t.momentum(b)
    for k = 1, 3 do
      t.near(p[k], p1[k] + p2[k], 1e-6, "momentum")
      t.near(l[k], l1[k] + l2[k], 1e-3 * t.norm(l), "moment of momentum")
    end
    assert.is_true(tie.raw_peak_force > 0)
    t.above(1e-3, p2[3], "what the other wire has got of it")
  end)

  -- The pull grows by 0.2 N/ms: a whole step would take the tie far beyond its strength.
  it("breaks at the right moment within a long step, with any method", function()
    for _, how in ipairs{ { dt = 0.02 }, { dt = 0.005 }, { dt = 0.02, integrator = "bdf2" },
      { dt = 0.02, tolerance = 1e-4 } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = rod(scene, { E = 1e11 })
      damped(scene, wire)
      local tie = scene:tie(wire, { name = "t", s = 0.2, strength = 8, stiffness = 1e4 })
      local hand = scene:grip(wire, { s = 0.2 })
      hand:follow(sw.trajectory{ points = { { 0, 0, 0 }, { 0, 0, -2.1e-3 } }, duration = 0.1, law = "linear",
        relative = true })
      how.duration = 0.1
      local run = t.fine(scene:run(how))
      t.near(8, tie.broken.force, 0.081, "force")
      t.above(8, tie.broken.force, "force")
      t.near(0.08 / 2.1, tie.broken.time, 5e-4, "time")
      t.near(8, tie.raw_peak_force, 0.081, "peak")
      t.below(40, run.rejected, "rejected steps")
      local told = {}
      for _, e in ipairs(run.events) do if e.kind == "tie" then told[#told + 1] = e.text end end
      assert.same({ ("a tie of wire 'wire1' breaks at %.4g N; it bears 8 N"):format(tie.broken.force) },
        told)
    end
  end)

  -- The same in equilibria: poses are cut at that moment, whatever the time between them.
  local function drawn_down(to_wire)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = rod(scene, { E = 1e11 })
    local args = { name = "t", s = 0.2, strength = 8, stiffness = 1e4 }
    if to_wire then
      local other = rod(scene, { E = 1e11, from = { 0, 0, 0.006 }, to = { 0.4, 0, 0.006 } })
      scene:clamp(other, { s = 0.2 })
      args.to, args.slack = { other, s = 0.2 }, 0.006
    end
    local tie = scene:tie(wire, args)
    return scene, tie, scene:gripper{}, wire
  end

  it("breaks at the right moment between two poses of a quasi-static run", function()
    for _, to_wire in ipairs{ false, true } do
      for _, dt in ipairs{ 0.1, 0.02, 0.005 } do
        local scene, tie, hand, wire = drawn_down(to_wire)
        scene:process(function(p)
          hand:grasp(wire, { s = 0.2 })
          hand:move{ by = { 0, 0, -2.1e-3 }, duration = 0.1, law = "linear" }
          p:wait(0.05)
        end)
        local run = t.fine(scene:run{ dt = dt, quasistatic = true })
        t.above(8, tie.broken.force, "force")
        t.below(8.081, tie.broken.force, "force")
        t.near(0.08 / 2.1, tie.broken.time, 5e-4, "time")
        t.near(8, tie.raw_peak_force, 0.081, "peak")
        t.below(1e-6, t.norm(hand:force()), "force of the hand after that")
        local told = {}
        for _, e in ipairs(run.events) do if e.kind == "tie" then told[#told + 1] = e end end
        assert.are.equal(1, #told)
        assert.matches("breaks at 8.0%d* N; it bears 8 N", told[1].text)
        t.near(tie.broken.time, told[1].time, 1e-12, "time told")
      end
    end
  end)

  it("breaks at the right moment where pads hold the wire too", function()
    local scene, tie, hand, wire = drawn_down()
    scene:process(function()
      hand:grasp(wire, { s = 0.2, approach = "plates", force = 40 })
      hand:move{ by = { 0, 0, -2.1e-3 }, duration = 0.1, law = "linear" }
    end)
    t.fine(scene:run{ dt = 0.02, quasistatic = true })
    t.above(8, tie.broken.force, "force")
    t.below(8.081, tie.broken.force, "force")
    t.share(40, hand:state().squeeze, 2e-3, "force of the pads after that")
  end)

  it("breaks, records the time, and is whole again after a restore", function()
    local scene, _, lower, ties = hung{ strength = 2 }
    t.fine(scene:run{ duration = 0.5, dt = 5e-3 })
    local snapshot = scene:snapshot()
    local times = {}
    for k = 1, 2 do
      scene:force{ kind = "line", on = lower, force = { 0, 0, -15 } }
      t.fine(scene:run{ duration = 0.3, dt = 1e-3 })
      times[k] = ties[1].broken.time
      t.above(2, ties[1].broken.force, "force")
      t.below(2.0201, ties[1].broken.force, "force")
      assert.are.equal(0, ties[1]:tension())
      t.below(-0.1, lower:position(0.2)[3], "height of the lower wire")
      scene:restore(snapshot)
      assert.is_nil(ties[1].broken)
      t.share(0.5 * lower.beam.mass_per_length * lower.length * G, ties[1]:tension(), 2e-2, "pull")
    end
    assert.are.equal(times[1], times[2])
    ties[1]:release()
    ties[2]:release()
    t.fine(scene:run{ duration = 0.3, dt = 5e-3 })
    t.below(-0.1, lower:position(0.2)[3], "height of the lower wire")
  end)

  it("can be read by observers", function()
    local scene = sw.scene{}
    local one = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.2 }, to = { 0.4, 0, 0.2 } }
    local two = scene:wire{ cable = "GXL 1.5", from = { 0, 0.01, 0.2 }, to = { 0.4, 0.01, 0.2 } }
    scene:clamp(one, { s = 0 })
    local tie, looks, most = scene:tie(one, { s = 0.2, to = { two, s = 0.2 } }), 0, 0
    scene:observe{ every = 0.01, call = function()
      looks, most = looks + 1, math.max(most, tie:tension())
      assert.is_true(tie:distance() >= 0 and tie.raw_peak_force >= most - 1e-12 and not tie.broken)
    end }
    scene:run{ duration = 0.1 }
    assert.is_true(looks >= 9 and most > 0)
  end)

  it("lets tied wires touch each other", function()
    local scene, upper, lower = hung()
    scene:wire_contact{ between = { upper, lower } }
    scene:force{ kind = "line", on = lower, force = { 0, 0, 20 } } -- pressed upwards
    t.fine(scene:run{ duration = 0.3, dt = 2e-3 })
    local apart = upper:position(0.1)[3] - lower:position(0.1)[3]
    t.near(0.006, apart, 2e-4, "distance of the axes at a tie")
  end)

  it("says how to name the other wire", function()
    local scene = sw.scene{}
    local one = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.4, 0, 0 } }
    local two = scene:wire{ cable = "GXL 1.5", from = { 0, 0.1, 0 }, to = { 0.4, 0.1, 0 } }
    local fine, why = pcall(scene.tie, scene, one, two, { s = 0.2 })
    assert.is_false(fine)
    assert.is_truthy(why:find("another wire is in it: to = { wire, s = 0.2 }", 1, true), why)
  end)

  it("refuses meshes, and more than two ends", function()
    local scene = sw.scene{}
    local a = rod(scene, { name = "a" })
    local b = meshes.wire(scene, { "radial", { model = "radial", name = "b" } })
    local ok, text = pcall(scene.tie, scene, a, { s = 0.1, to = { b, s = 0.1 } })
    assert.is_false(ok)
    assert.is_truthy(text:find("wire 'b' is a radial, a mesh of particles", 1, true), text)
    local c = rod(scene, { name = "c" })
    assert.has_error(function()
      scene:join{ ends = { { a, s = 0 }, { c, s = 0 }, { a, s = 0.4 } }, slack = 0.1 }
    end)
    assert.has_error(function() scene:join{ ends = { { a, s = 0 }, { c, s = 0 } } }:read() end)
  end)
end)
