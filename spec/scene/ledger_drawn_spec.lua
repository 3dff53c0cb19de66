-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable hangs over a peg and is drawn off it. Its axial force swings from step to step, so the forces at a
-- step's ends are not those of the step: by them alone the clamp's work was -18 uJ in a step of 5 ms in which
-- its impulse did 19 uJ, and the cable gained what it should. Steps were redone for nothing, with the event
-- `energy`, or the run ended. The bound of the work is that of the impulse where it is larger and nothing
-- strikes.
local sw = require "softworld"
local t = require "physics.tools"

local R = 0.0335 -- of the peg [m]

-- Returns the run, and the peak force of the clamp over the cable's weight.
local function drawn(cable, segments, dt)
  local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ shape = "cylinder", radius = R, length = 0.3, friction = 0.23,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  local path = { { 0.066, 0, R + r } }
  for i = 0, 10 do
    local a = math.pi / 20 * i
    path[#path + 1] = { -(R + r) * math.sin(a), 0, (R + r) * math.cos(a) }
  end
  path[#path + 1] = { -R - r, 0, -0.144 }
  local wire = scene:wire{ cable = cable, path = path, segments = segments }
  scene:force{ kind = "damping", mass = 0, stiffness = 3e-3 }
  local hold = scene:clamp(wire, { s = 0 })
  t.fine(scene:settle())
  hold:follow{ relative = true, points = { { 0, 0, 0 }, { 0.051, 0, 0.017 } }, duration = 0.31 }
  local run = scene:run{ dt = dt, duration = 1 }
  return run, hold:over().peak_force / (9.81 * wire.beam.mass_per_length * wire.length)
end

describe("a cable that is drawn off a peg", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it(("makes no energy, and is not told to: %s"):format(cable), function()
      local events, first = 0, nil
      for segments = 36, 44 do
        for _, dt in ipairs{ 0.01, 0.005 } do
          local run, peak = drawn(cable, segments, dt)
          t.fine(run)
          local books = run:ledger()
          t.below(0.005, books.gap / books.play, ("gap over play, %d edges, %g s"):format(segments, dt))
          for _, e in ipairs(run.events) do events = events + (e.kind == "energy" and 1 or 0) end
          first = first or peak
          t.share(first, peak, 0.03, ("peak, %d edges, %g s"):format(segments, dt))
        end
      end
      t.below(2, events, "events `energy` in 18 runs")
    end)
  end
end)
