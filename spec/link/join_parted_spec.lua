-- SPDX-License-Identifier: GPL-3.0-or-later
-- Joined wires lie in each other at the join. When it is released they come apart slowly, without energy from
-- nowhere, and this depth is no penetration.
local sw = require "softworld"
local t = require "spec.physics.tools"

local RADIUS = 0.0015 -- of GXL 1.5, outside [m]

-- Two cables in one line, or a branch on a trunk, on a table or (o.hung) below a clamp.
local function joined(o)
  local scene = sw.scene{ name = "joined" }
  local function at(x, y) return o.hung and { 0, 0, 0.5 - x } or { x, y or 0, RADIUS } end
  if not o.hung then scene:obstacle{ name = "table", shape = "plane", friction = 0.3 } end
  local long = o.branch and 0.4 or 0.2
  local one = scene:wire{ name = "one", cable = "GXL 1.5", from = at(0), to = at(long),
    segments = long * 200 }
  local two = scene:wire{ name = "two", cable = "GXL 1.5", from = at(0.2),
    to = o.branch and at(0.2, 0.15) or at(0.4), segments = 30 }
  local join = scene:join{ ends = { { one, s = 0.2 }, { two, s = 0 } } }
  scene:wire_contact{ friction = 0.2, between = { one, two } }
  scene:force{ kind = "damping", mass = 5, stiffness = 0.001 }
  if o.hung then scene:clamp(one, { s = 0 }) end
  return scene, one, two, join
end

-- Returns the run and the highest speed after the release [m/s].
local function released(o)
  local scene, one, two, join = joined(o)
  local fastest = 0
  scene:process(function(p)
    p:wait(0.1)
    join:release()
    for _ = 1, 40 do
      p:wait(0.02)
      for k = 0, 10 do
        for _, wire in ipairs{ one, two } do
          fastest = math.max(fastest, t.norm(wire:velocity(wire.length * k / 10)))
        end
      end
    end
  end)
  local run = t.fine(scene:run{ dt = o.dt or 0.01 })
  return run, fastest, scene
end

describe("a join that is released between wires that touch", function()
  for _, o in ipairs{ { dt = 0.02 }, { dt = 0.01 }, { dt = 0.002 }, { dt = 0.01, branch = true },
    { dt = 0.002, branch = true }, { dt = 0.0005, branch = true } } do
    it(("lets them come apart at dt = %g s%s"):format(o.dt, o.branch and ", of a branch" or ""), function()
      local run, fastest, scene = released(o)
      assert.equal(0, #run.events)
      t.below(0.03, fastest, "speed")
      t.below(0.01, run:ledger().gap / run:ledger().play, "share of the energy from nowhere")
      t.below(1e-5, scene:penetration(), "penetration of the run")
      t.below(1e-5, select(4, scene:penetration()), "penetration at the end")
      assert.equal("PASS", run:check{ limits = { max_tension = 80 } }:row "penetration".verdict)
    end)
  end

  -- An event `energy` told 22 and 30 % from nowhere, at any step.
  it("lets them come apart in one pose", function()
    for _, branch in ipairs{ false, true } do
      local scene, one, two, join = joined{ branch = branch }
      scene:process(function(p)
        p:wait(0.1)
        join:release()
        p:wait(0.1)
      end)
      local run = t.fine(scene:run{ dt = 0.01, quasistatic = true })
      assert.equal(0, #run.events)
      t.below(1e-9, run:ledger().gap, "energy from nowhere [J]")
      t.near(2 * RADIUS, math.abs(one:position(0.2).z - two:position(0).z), 1e-4, "distance")
    end
  end)

  -- Their round caps pushed each other along the line, with 254 N at 5 ms.
  it("leaves two halves in line between hands where they are, without a push", function()
    for _, dt in ipairs{ 0.02, 0.005, 0.002, 0.0005 } do
      local scene, one, two, join = joined{}
      local first, second = scene:gripper{ name = "first" }, scene:gripper{ name = "second" }
      local pushed
      scene:process(function(p)
        first:grasp(one, { s = 0.01 })
        second:grasp(two, { s = 0.19 })
        second:move{ by = { 1e-7, 0, 0 }, duration = 0.2 }
        join:release()
        p:wait(0.5)
        pushed = first.peak_force
        if dt < 0.02 then second:move{ by = { -1e-5, 0, 0 }, duration = 0.1 } end
      end)
      local run = t.fine(scene:run{ dt = dt })
      t.below(0.1, pushed, "push after the release [N]")
      if dt < 0.02 then t.above(1, first.peak_force, "push of ends that are pressed together [N]") end
      for _, e in ipairs(run.events) do assert.equal("buckling", e.kind) end
    end
  end)

  it("lets the lower one fall", function()
    local run, fastest, scene = released{ hung = true }
    assert.equal(0, #run.events)
    t.above(1, fastest, "speed")
    t.below(1e-5, scene:penetration(), "penetration")
  end)

  it("counts what is deep elsewhere, or later", function()
    local scene, _, two, join = joined{}
    join:release()
    scene:remove(two)
    scene:wire{ name = "three", cable = "GXL 1.5", from = { 0.19, -0.05, RADIUS },
      to = { 0.19, 0.05, RADIUS }, segments = 20 }
    scene:wire_contact{ friction = 0.2 }
    t.fine(scene:run{ dt = 0.01, duration = 0.05 })
    t.near(2 * RADIUS, scene:penetration(), 3e-4, "depth of wires that were drawn in each other")
  end)
end)
