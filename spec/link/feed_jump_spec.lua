-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feed's force that is not the asked one, because it jumps past it, is told.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A hand bends a cable down over an edge and pulls it out of a feed. The stiff cable strikes the edge.
local function bent(case)
  local scene = sw.scene{}
  local like = sw.scene{}:wire{ cable = case.cable, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 2 }
  local r = like.radius
  local wire = scene:wire{ cable = case.cable, from = { -0.15, 0, r }, to = { 0.15, 0, r },
    segments = math.ceil(0.3 / case.edge) }
  scene:obstacle{ shape = "box", size = { 0.12, 0.2, 0.05 }, at = { -0.06, 0, -0.025 },
    friction = case.friction }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
  local feed = scene:feed(wire, { s = 0, force = -case.force })
  local hand = scene:clamp(wire, { s = wire.length })
  hand:follow(function(time)
    local u = time ^ 3 * (10 - 15 * time + 6 * time ^ 2)
    local a, l = 1.2 * u, 0.15 + 0.05 * u
    return { l * math.cos(a), 0, r - l * math.sin(a) }, { axis = { 0, 1, 0 }, angle = a }
  end)
  t.fine(scene:settle())
  return scene, wire, feed
end

local function jump_of(run)
  for _, e in ipairs(run.events) do if e.kind == "jump" then return e end end
end

-- Regression: of these 16 scenes 11 have steps in which the force is off by 7 to 90 %, without an event.
-- A drive obeys to 1e-7 of its force or the cable's weight. 1 % is the least deviation of the read-out that
-- is told. The text has six digits of forces of up to 0.3 N: 1e-6 N.
describe("a feed whose force jumps past the asked one", function()
  it("tells the force, the asked one and the time, and nothing where it obeys", function()
    local told = 0
    for _, force in ipairs{ 0.1, 0.17 } do
      for _, edge in ipairs{ 0.005, 0.007 } do
        for _, friction in ipairs{ 0, 0.25 } do
          for _, dt in ipairs{ 0.02, 0.01 } do
            local case = { cable = "H07V-K 4", force = force, edge = edge, friction = friction }
            local scene, wire, feed = bent(case)
            local least = 0.01 * math.max(force, wire.beam.mass_per_length * 9.81 * wire.length)
            for _ = 1, 0.8 / dt do
              local from = scene.time
              local run = t.fine(scene:run{ duration = dt, dt = dt })
              local e, off = jump_of(run), feed:drive_force() + force
              local least_told = math.abs(off) > least and math.abs(off) * (1 - 1e-6) or 0
              t.above(least_told, e and math.abs(e.value) or 0, "told deviation [N]")
              if e then
                told = told + 1
                local is, at, asked = e.text:match "force is (%S+) N at t = (%S+) s instead of (%S+) N:"
                t.near(-force, tonumber(asked), 1e-6, "asked force")
                t.near(e.value, is - asked, 1e-6, "deviation")
                t.near(e.time, tonumber(at), 1e-6, "time")
                assert.is_true(e.time > from and e.time <= scene.time)
                if e.time == scene.time then t.near(off, e.value, 1e-6, "deviation at the step's end") end
              end
            end
          end
        end
      end
    end
    t.above(3, told, "steps with jumps")
  end)

  it("tells nothing where a wire that hangs free is pulled out", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
      for _, dt in ipairs{ 0.02, 0.005 } do
        local scene = sw.scene{}
        local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 40 }
        scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
        local feed = scene:feed(wire, { s = 0, force = -2 })
        local hand = scene:clamp(wire, { s = wire.length })
        t.fine(scene:settle())
        local start = feed:fed()
        hand:follow{ points = { { 0, 0, 0 }, { 0.1, 0, 0 } }, duration = 0.5, relative = true }
        local run = t.fine(scene:run{ duration = 0.6, dt = dt })
        assert.is_nil(jump_of(run))
        t.share(-2, feed:drive_force(), 1e-6, "force [N]")
        t.share(0.1, feed:fed() - start, 0.01, "fed [m]")
      end
    end
  end)
end)
