-- SPDX-License-Identifier: GPL-3.0-or-later
-- Coulomb friction: thresholds within 2 %, accelerations within 1 %, no creep.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

describe("a rod on a slope", function()
  for _, angle in ipairs{ 5, 20, 45 } do
    local threshold = math.tan(math.rad(angle))
    it(("of %d degrees stays where it is when rough enough"):format(angle), function()
      local c = cases.incline{ angle = angle, friction = 1.02 * threshold }
      t.fine(c.run{ duration = 1 })
      -- the friction springs stretch by micrometres, once
      t.below(2e-5, math.abs(c.measured().distance), "distance [m]")
      local before = c.measured().distance
      t.fine(c.scene:run{ duration = 5 })
      t.below(1e-7, math.abs(c.measured().distance - before), "creep in 5 s [m]")
    end)

    it(("of %d degrees slides when not"):format(angle), function()
      local c = cases.incline{ angle = angle, friction = 0.98 * threshold }
      t.fine(c.run{ duration = 1 })
      t.share(c.exact.acceleration, c.measured().acceleration, 0.01, "acceleration")
    end)
  end

  for _, row in ipairs{ { 0.3, 10 }, { 0.3, 20 }, { 0.5, 45 } } do
    it(("has the acceleration of friction %g on %d degrees"):format(row[1], row[2]), function()
      local c = cases.incline{ angle = row[2], friction = row[1] }
      t.fine(c.run{ duration = 0.5 })
      t.near(c.exact.acceleration, c.measured().acceleration,
        math.max(0.01 * c.exact.acceleration, 1e-4), "acceleration")
    end)
  end

  it("slides the same with every implicit integrator and step", function()
    for _, integrator in ipairs{ "tr-bdf2", "sdirk2", "implicit-euler", "bdf2" } do
      for _, dt in ipairs{ 0.01, 0.002 } do
        local c = cases.incline{ angle = 20, friction = 0.3 }
        t.fine(c.run{ duration = 0.2, dt = dt, integrator = integrator })
        -- the speed is compared: distances differ by the method's first-order error in its first step
        t.share(c.exact.acceleration * 0.2, c.measured().speed, 0.01, integrator .. ": speed")
      end
    end
  end)

  it("slides the same down any slope in space", function()
    local random = t.random(17)
    for _ = 1, 3 do
      local c = cases.incline{ angle = 20, friction = 0.3, rotation = t.turn(random),
        at = { 1, -1, 2 } }
      t.fine(c.run{ duration = 0.5 })
      t.share(c.exact.acceleration, c.measured().acceleration, 0.01, "acceleration")
    end
  end)
end)

-- The error allowed in friction is measured by the wire's own forces, not by those of other wires.
describe("a light rod in a scene with a stiff and heavy wire", function()
  local function scene_of(angle, friction)
    local c = cases.incline{ angle = angle, friction = friction }
    local heavy = c.scene:wire{ EA = 1e9, EI = 1e4, mass_per_length = 10, radius = 0.01,
      from = { 0, 5, 5 }, to = { 0, 6, 5 }, segments = 10 }
    c.scene:clamp(heavy, { s = 0 })
    return c
  end

  for _, row in ipairs{ { 0.3, 20 }, { 0.3, 10 }, { 0.5, 45 } } do
    it(("slides or holds as it does alone: friction %g on %d degrees"):format(row[1], row[2]), function()
      local c = scene_of(row[2], row[1])
      t.fine(c.run{ duration = 0.5 })
      t.near(c.exact.acceleration, c.measured().acceleration,
        math.max(0.01 * c.exact.acceleration, 1e-4), "acceleration")
    end)
  end

  it("holds as it does alone when the heavy one lies on the same slope", function()
    local c = cases.incline{ angle = 10, friction = 0.3 }
    local slope = c.frame
    c.scene:wire{ EA = 1e6, EI = 10, mass_per_length = 5, radius = 0.01, from = slope.point(0, 0.3, 0.01),
      to = slope.point(0.5, 0.3, 0.01), segments = 10 }
    t.fine(c.run{ duration = 0.5 })
    t.near(0, c.measured().acceleration, 1e-4, "acceleration")
  end)
end)

describe("a rod pushed over a floor", function()
  for _, row in ipairs{ { 0.3, 0.4 }, { 0.392, 0.4 }, { 0.408, 0.4 }, { 0.5, 0.4 }, { 1, 0.4 } } do
    it(("by %g of its weight with friction %g"):format(row[1], row[2]), function()
      local c = cases.push{ force = row[1], friction = row[2] }
      t.fine(c.run())
      local a = c.exact.acceleration
      if a == 0 then t.below(2e-5, math.abs(c.measured().distance), "distance [m]")
      else t.share(a, c.measured().acceleration, 0.01, "acceleration") end
      -- kinetic energy of 1 kg after 1 s
      t.near(a ^ 2 / 2, c.measured().speed ^ 2 / 2, math.max(0.02 * a ^ 2 / 2, 1e-9), "energy")
    end)
  end

  it("comes to rest after v^2/(2 mu g) without a push", function()
    local c = cases.push{ force = 0, friction = 0.4 }
    c.wire:set_velocity{ 1, 0, 0 }
    local x = c.wire:position(0.5)[1]
    t.fine(c.scene:run{ duration = 1, dt = 0.005 })
    local gone = c.wire:position(0.5)[1] - x
    t.share(1 / (2 * 0.4 * 9.8), gone, 0.01, "distance")
    t.near(0, c.wire:velocity(0.5)[1], 1e-6, "speed")
  end)
end)
