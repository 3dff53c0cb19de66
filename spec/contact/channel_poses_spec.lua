-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is drawn through a channel with a bend, from pose to pose. Regression: where the next pose did not
-- follow directly from the last one, the wire swung into it, and friction kept what it had in the swing: the
-- pull in poses of 3.5 mm was 12 % too small.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local WAY = 0.05 * math.sqrt(2) -- of the drawn end [m]

-- Returns the mean pull of the end between 0.2 and 0.8 of its way [N]. o.mirrored: the channel bends to the
-- right.
local function pull(o)
  local scene <close> = sw.scene{}
  local cable = o.cable or "GXL 1.5"
  local r, side = sw.cable(cable).outer_diameter.value / 2, o.mirrored and -1 or 1
  scene:channel{ points = { { -0.3, 0, 0 }, { 0, 0, 0 }, { 0.2, side * 0.2, 0 } }, width = 0.01,
    depth = 0.012, friction = 0.3 }
  local bend, a = 0.02, math.pi / 4
  local path = { { -0.4, 0, r } }
  for k = 0, 12 do
    local phi = a * k / 12
    path[#path + 1] = { bend * (math.sin(phi) - math.tan(a / 2)), side * bend * (1 - math.cos(phi)), r }
  end
  path[#path + 1] = { 0.25, side * 0.25, r }
  if o.swapped then
    local other = {}
    for k = 1, #path do other[k] = path[#path + 1 - k] end
    path = other
  end
  local wire = scene:wire{ cable = cable, segments = o.segments or 60, path = path }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  local hold = scene:clamp(wire, { s = o.swapped and 0 or wire.length })
  hold:follow{ points = { { 0, 0, 0 }, { 0.05, side * 0.05, 0 } }, relative = true, duration = 1 }
  local run = t.fine(scene:run{ duration = 1, dt = o.dt, quasistatic = o.quasistatic })
  return hold:over(0.2, 0.8).mean_force, run
end

describe("a cable drawn through a channel in poses", function()
  for _, o in ipairs{ {}, { segments = 120 }, { mirrored = true }, { swapped = true },
    { cable = "FLRY-B 0.5" } } do
    local name = ("%s, %d segments%s%s"):format(o.cable or "GXL 1.5", o.segments or 60,
      o.mirrored and ", bend to the right" or "", o.swapped and ", ends swapped" or "")
    it("has the same pull at any distance of poses: " .. name, function()
      o.quasistatic, o.dt = true, 0.005
      local fine = pull(o)
      for _, dt in ipairs{ 0.1, 0.05, 0.033, 0.02 } do
        o.dt = dt
        local found = pull(o)
        local what = ("pull in poses of %.2f mm"):format(1e3 * WAY * dt)
        print(("measured: %s: %.4f N, %.4f N in fine ones"):format(what, found, fine))
        t.share(fine, found, 0.01, what)
      end
      o.quasistatic, o.dt = false, 0.01
      t.share(pull(o), fine, 0.04, "pull in motion and in poses")
    end)
  end
end)
