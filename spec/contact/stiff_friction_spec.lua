-- SPDX-License-Identifier: GPL-3.0-or-later
-- A clamp presses a stiff cable on a rod or on another cable, and the cable's end swings after the stop. Each
-- half swing draws the cable over the ridge by more than it yields, so the pull between clamp and ridge goes
-- from one limit of friction to the other. Friction that sticks was a spring a thousand times softer than the
-- cable: the largest tension was 0.01 N for 0.27 N in all steps of 1 ms or more, and no event told it.
local sw = require "softworld"
local t = require "physics.tools"

local MU = 0.3

-- Returns the least and largest pull of the clamp along the cable after the stop, the largest tension, and
-- the clamp's force upwards at the end [N].
local function swings(on, dt, o)
  local scene, r = sw.scene{}, sw.cable("H07V-K 4").outer_diameter.value / 2
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local function at(x, y, z) return { c * x - s * y, s * x + c * y, z } end
  scene:obstacle{ shape = "plane", friction = 0.5 }
  if on == "cable" then -- a swing rolls over a round cable: the clamp draws by more than that yields
    local under = scene:wire{ cable = "H07V-K 4", segments = 21, from = at(0, -0.12, r), to = at(0, 0.12, r) }
    scene:force{ kind = "damping", on = under, mass = 1.5, stiffness = 7e-4 }
    scene:wire_contact{ friction = MU }
  else
    scene:obstacle{ shape = "cylinder", radius = r, length = 0.24, at = { 0, 0, r }, friction = MU,
      rotation = { axis = at(1, 0, 0), angle = math.pi / 2 } }
  end
  local wire = scene:wire{ cable = "H07V-K 4", segments = o.segments or 38, from = at(-0.135, 0, 0.0132),
    to = at(0.0555, 0, 0.0132) }
  scene:force{ kind = "damping", on = wire, mass = 3.5, stiffness = 1.5e-3 }
  local clamp = scene:clamp(wire, { s = wire.length })
  local stop, times = at(-0.026, 0.021, -0.0079), { 0, 0.32 }
  local points = { { 0, 0, 0 }, stop }
  if on == "cable" then
    for i, way in ipairs{ 3e-5, -3e-5, 0 } do
      points[i + 2], times[i + 2] = at(-0.026 + way, 0.021, -0.0079), 0.32 + 0.1 * i
    end
  end
  clamp:follow{ points = points, times = times, relative = true, law = "minimum-jerk", start = 0.02 }
  local run = t.fine(scene:run{ dt = dt, duration = 0.86, tolerance = o.tolerance, frames = false })
  local along, series, low, high = {}, run:series(), math.huge, -math.huge
  for _, column in ipairs(series.columns) do
    local axis = column.name:match "^clamp1.force_([xy])$"
    if axis then along[axis] = column.values end
  end
  for i, time in ipairs(series.time) do
    local pull = c * along.x[i] + s * along.y[i]
    if time > 0.36 then low, high = math.min(low, pull), math.max(high, pull) end
  end
  return low, high, (wire:max_tension()), clamp:force()[3]
end

describe("friction that sticks is as stiff as the cable", function()
  for on, segments in pairs{ rod = 31, cable = 41 } do
    it("a cable pressed on a " .. on, function()
      local low, high, tension, down = swings(on, 2e-4, {})
      t.share(tension, MU * math.abs(down), 0.15, "largest tension is about mu N [N]")
      for _, o in ipairs{ { dt = 0.02 }, { dt = 0.01 }, { dt = 0.005 }, { dt = 0.002 }, { dt = 0.001 },
        { dt = 0.01, tolerance = 1e-5 }, { dt = 0.01, turn = 0.9 }, { dt = 0.005, segments = segments } } do
        local least, most, largest = swings(on, o.dt, o)
        local what = ("%g ms, turned %g, %d edges: "):format(1e3 * o.dt, o.turn or 0, o.segments or 38)
        t.share(tension, largest, 0.03, what .. "largest tension")
        t.share(high, most, 0.05, what .. "largest pull")
        t.share(low, least, 0.08, what .. "least pull")
      end
    end)
  end
end)
