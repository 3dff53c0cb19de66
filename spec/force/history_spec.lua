-- SPDX-License-Identifier: GPL-3.0-or-later
-- What forces remember: snapshots and changes of the scene keep it, and only accepted steps write it.
local arc = require "force.arc"
local sw = require "softworld"
local tools = require "physics.tools"

local function plastic(N)
  return arc.new{ N = N, force = { kind = "plastic", yield_moment = 0.01, hardening = 0.005 } }
end

-- Returns the force at a bent shape and the work dissipated, bit by bit.
local function fingerprint(scene, wire)
  local list = { ("%a"):format(scene:energy().dissipated) }
  for _, f in ipairs(scene:evaluate(wire).plastic.force) do list[#list + 1] = ("%a"):format(f) end
  return table.concat(list, " ")
end

local function swinging()
  local scene = sw.scene{}
  local wire = scene:wire{ EA = 500, EI = 0.01, mass_per_length = 0.1, radius = 0.005,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 12 }
  local clamp = scene:clamp(wire, { s = 0 })
  scene:force{ kind = "plastic", on = wire, yield_moment = 0.05, hardening = 0.002 }
  scene:force{ kind = "stick_slip", on = wire, EI_stick = 0.02, friction_moment = 0.01 }
  return scene, wire, clamp
end

local function bits(scene, wire)
  local list = { ("%a"):format(scene:energy().total), ("%a"):format(scene:energy().dissipated) }
  for _, x in ipairs(wire:positions()) do list[#list + 1] = ("%a"):format(x) end
  return table.concat(list, " ")
end

describe("the memory of forces", function()
  it("is restored by a snapshot, bit by bit", function()
    for _, integrator in ipairs{ "tr-bdf2", "implicit-midpoint", "bdf2", "rk4", "velocity-verlet" } do
      local scene, wire = swinging()
      local dt = math.min(0.005, 0.2 * scene:stable_dt())
      local function go() tools.fine(scene:run{ duration = 0.1, dt = dt, integrator = integrator }) end
      go()
      local here, before = bits(scene, wire), scene:snapshot()
      go()
      local there = bits(scene, wire)
      assert.are_not.equal(here, there)
      scene:restore(before)
      assert.are.equal(here, bits(scene, wire))
      go()
      assert.are.equal(there, bits(scene, wire))
      scene:pin(wire, { s = 0.77 }) -- another system in between
      go()
      scene:restore(before)
      assert.are.equal(here, bits(scene, wire))
      go()
      assert.are.equal(there, bits(scene, wire))
    end
  end)

  it("is not touched by a step that fails", function()
    local scene, wire = swinging()
    tools.fine(scene:run{ duration = 0.15, dt = 0.005 })
    local calls, fails_at = 0, math.huge
    scene:force{ on = wire, kind = function()
      calls = calls + 1
      if calls == fails_at then error "no" end
    end }
    tools.fine(scene:run{ duration = 0.005, dt = 0.005 })
    local before = fingerprint(scene, wire)
    for _, more in ipairs{ 1, 2, 3, 4 } do
      fails_at = calls + more
      assert.has_error(function() scene:run{ duration = 0.005, dt = 0.005 } end)
      assert.are.equal(before, fingerprint(scene, wire))
    end
  end)

  it("is the same after rejected steps as after small ones", function()
    local function ends(options)
      local scene, wire = swinging()
      options.duration = 0.4
      local run = tools.fine(scene:run(options))
      return wire:position(1), scene:energy().dissipated, run.rejected
    end
    local here, work, rejected = ends{ tolerance = 2e-6, dt = 0.05 }
    assert.is_true(rejected > 0)
    local there, also = ends{ dt = 0.0005 }
    tools.below(5e-3, tools.distance(here, there), "ends apart")
    tools.share(also, work, 0.02, "work dissipated")
  end)

  it("balances energy and work when steps are small", function()
    local scene = swinging()
    local start = scene:energy().total
    local function missing(dt)
      local s = swinging()
      tools.fine(s:run{ duration = 0.3, dt = dt, integrator = "implicit-midpoint" })
      local now = s:energy()
      assert.is_true(now.dissipated > 0.01)
      return math.abs(now.total + now.dissipated - start) / now.dissipated
    end
    tools.below(0.01, missing(0.0005), "energy missing, of the work")
  end)

  it("outlives clamps put on and taken off", function()
    local bent = plastic(12)
    bent:sweep(2.5, 8)
    bent.last:release()
    local scene, wire = bent.scene, bent.wire
    tools.fine(scene:settle{ tolerance = 1e-12 })
    local tip, work = wire:position(arc.L), scene:energy().dissipated
    -- at a node, between nodes, so near a node that one is inserted; and a wide gripper
    for _, place in ipairs{ { s = 0.25 }, { s = 0.25 + 0.3 * arc.L / 12 }, { s = 0.26 },
      { s = 0.31, width = 0.1 }, { s = arc.L } } do
      local kind = place.width and "grip" or "clamp"
      local hold = scene[kind](scene, wire, place)
      tools.fine(scene:settle{ tolerance = 1e-12 })
      tools.below(3.5e-4, tools.distance(tip, wire:position(arc.L)), "shift of the end, held")
      hold:release()
      tools.fine(scene:settle{ tolerance = 1e-12 })
      tools.below(2e-5, tools.distance(tip, wire:position(arc.L)), "shift of the end")
      tools.share(work, scene:energy().dissipated, 1e-12, "work dissipated")
    end
  end)

  it("shifts a bent wire under a new clamp by the mesh's error only", function()
    tools.order_at_least(1.9, { 12, 24, 48 }, function(N)
      local bent = plastic(N)
      bent:sweep(2.5, 4 * N)
      bent.last:release()
      tools.fine(bent.scene:settle{ tolerance = 1e-12 })
      local tip = bent.wire:position(arc.L)
      bent.scene:clamp(bent.wire, { s = 0.25 })
      tools.fine(bent.scene:settle{ tolerance = 1e-12 })
      return tools.distance(tip, bent.wire:position(arc.L))
    end, "shift of the end")
  end)

  it("ends with its force", function()
    local bent = plastic(8)
    bent:sweep(2.5, 8)
    bent.last:release()
    bent.force:release()
    tools.fine(bent.scene:settle{ tolerance = 1e-12 })
    tools.near(0, bent.wire:position(arc.L)[3], 1e-9, "end")
    assert.is_nil(bent.scene:energy().dissipated)
  end)

  it("is separate for each wire", function()
    local scene = sw.scene{}
    local wires = {}
    for k = 1, 2 do
      wires[k] = scene:wire{ EA = 500, EI = 0.01, mass_per_length = 0.1, radius = 0.005,
        from = { 0, k, 0 }, to = { k == 1 and 1 or 0.2, k, 0 }, segments = 8 }
      scene:clamp(wires[k], { s = 0 })
    end
    scene:force{ kind = "plastic", yield_moment = 0.1, hardening = 0.002 }
    tools.fine(scene:settle())
    assert.is_true(scene:energy().dissipated > 0)
    scene:gravity{ 0, 0, 0 }
    tools.fine(scene:settle())
    assert.is_true(wires[1]:position(1)[3] < -0.1)
    tools.near(0, wires[2]:position(0.2)[3], 1e-9, "end of the short wire")
  end)
end)
