-- SPDX-License-Identifier: GPL-3.0-or-later
--- A cable that a clamp on its end lifts, draws along a table and lays down again.
-- @module contact.laid_down
local sw = require "softworld"
local t = require "physics.tools"

-- case: cable, friction mu, length [m], segments, height [m], duration [s], way [m], damping [s], direction
-- turn [rad], law of the drive or the share of its way as a function of the share of the duration, rest [s]
-- after it (0.5), tolerance of the run; swap: the clamp is at the wire's other end. Returns the pull on the
-- clamp at the end over mu m g, and whether an event said that forces at rest may be off.
return function(case, dt, swap)
  local scene, r = sw.scene{}, sw.cable(case.cable).outer_diameter.value / 2
  local c, s, way = math.cos(case.turn), math.sin(case.turn), case.way
  local near, far = { 0, 0, r }, { -case.length * c, -case.length * s, r }
  scene:obstacle{ shape = "plane", friction = case.mu }
  local wire = scene:wire{ cable = case.cable, segments = case.segments, from = swap and far or near,
    to = swap and near or far }
  scene:force{ kind = "damping", mass = 0, stiffness = case.damping }
  local hold = scene:clamp(wire, { s = swap and wire.length or 0 })
  if type(case.law) == "function" then
    hold:follow(function(time)
      local share = case.law(math.max(0, math.min(1, time / case.duration)))
      return { way * share * c, way * share * s, r + case.height * math.sin(math.pi * share) ^ 2 }
    end)
  else
    hold:follow{ relative = true, duration = case.duration, law = case.law,
      points = { { 0, 0, 0 }, { way / 2 * c, way / 2 * s, case.height }, { way * c, way * s, 0 } } }
  end
  local told = false
  for _, e in ipairs(t.fine(scene:run{ dt = dt, tolerance = case.tolerance,
    duration = case.duration + (case.rest or 0.5) }).events) do
    told = told or e.kind == "coarse" and e.text:find("forces at rest may be off", 1, true) ~= nil
  end
  local f = hold:force()
  return (f[1] * c + f[2] * s) / (case.mu * 9.81 * wire.beam.mass_per_length * case.length), told
end
