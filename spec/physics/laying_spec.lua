-- SPDX-License-Identifier: GPL-3.0-or-later
-- Laying over thin walls: no wall is passed, the weight is carried, and a turned scene gives the same.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local t = require "spec.physics.tools"

describe("laying over thin walls", function()
  for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
    it(("stays out of table and walls with steps of %g ms"):format(1e3 * dt), function()
      local c = cases.laying{}
      local walls = {}
      local r = t.fine(c.run{ dt = dt, frame = 0.02 })
      t.below(1e-4, (c.scene:penetration()), "penetration [m]")
      -- every frame: the wire's middle line is above wall tops wherever it crosses one
      for i = 1, c.scene:frame_count() do
        local x = c.scene:frame(i).wires[1]
        for k = 1, #x - 3, 3 do
          for w, wall in ipairs{ 0.4, 0.9, 1.4 } do
            if (x[k] - wall) * (x[k + 3] - wall) < 0 then
              local f = (wall - x[k]) / (x[k + 3] - x[k])
              t.above(0.1, x[k + 2] + f * (x[k + 5] - x[k + 2]), "height over a wall")
              walls[w] = true
            end
          end
        end
      end
      assert.is_true(walls[1] and walls[2] and walls[3])
      t.share(5, r.time, 1e-9, "time")
    end)
  end

  it("carries the whole weight on clamp, table and walls in the end", function()
    local c = cases.laying{}
    t.fine(c.run())
    t.fine(c.scene:run{ duration = 3 }) -- comes to rest
    local sum = c.clamp:force()[3]
    for _, o in ipairs(c.obstacles) do sum = sum - o:force()[3] end
    t.share(c.parameters.mass_per_length * 9.81, sum, 0.02, "weight carried")
  end)

  it("has little kinetic energy in the end", function()
    local c = cases.laying{}
    t.fine(c.run())
    -- almost at rest: far below that of the clamp's largest speed, 1/2 m (0.75 m/s)^2
    local scale = 0.5 * c.parameters.mass_per_length * 0.75 ^ 2
    t.below(0.3 * scale, c.scene:energy().kinetic, "kinetic energy at the end")
  end)

  it("is the same in a turned scene", function()
    local q = t.turn(t.random(29))
    local a, b = cases.laying{ segments = 40 }, cases.laying{ segments = 40, rotation = q }
    t.fine(a.run{ duration = 1 })
    t.fine(b.run{ duration = 1 })
    -- before the first impact on a wall's edge, so rounding decides little
    t.below(1e-5, t.distance(a.measured().tip, b.measured().tip), "tips differ by")
  end)
end)
