-- SPDX-License-Identifier: GPL-3.0-or-later
--- A rod lies along the fall line of a rough slope and is released.
-- Options: angle [deg] (20), friction (0.3), across (false): if true, it lies across the slope and rolls.
-- run{ duration =, dt = }.
-- exact.acceleration = max(0, g (sin - mu cos)) [m/s2]; exact.threshold = tan(angle). Across:
-- 2/3 g sin for friction above tan(angle)/3, below that as for sliding.
-- error(): of the distance travelled, over g t^2/2 [-].
-- @module softworld.cases.incline
local sw = require "softworld"
local frame = require "softworld.cases.frame"

return function(options)
  local f = frame.new(options)
  local angle, mu = math.rad(options.angle or 20), options.friction or 0.3
  local radius = 0.0025
  local scene = sw.scene{ name = "incline", gravity = f.gravity }
  local half = { math.cos(angle / 2), 0, math.sin(angle / 2), 0 } -- x axis points downhill
  local slope = frame.new{ rotation = frame.product(f.quaternion, half), at = options.at }
  scene:obstacle{ shape = "plane", friction = mu, at = f.point(0, 0, 0),
    rotation = slope.quaternion }
  local wire = scene:wire{ E = options.E or 1e8, density = 1500, radius = radius,
    segments = options.segments or 20, model = options.model,
    rolls = options.across, from = slope.point(0, 0, radius),
    to = options.across and slope.point(0, 0.5, radius) or slope.point(0.5, 0, radius) }
  local a = math.max(0, f.g * (math.sin(angle) - mu * math.cos(angle)))
  local threshold = math.tan(angle) / (options.across and 3 or 1)
  if options.across and mu >= threshold then a = 2 / 3 * f.g * math.sin(angle) end
  local c = { name = "incline", scene = scene, wire = wire, frame = slope,
    exact = { acceleration = a, threshold = threshold, source = "closed form" } }

  function c.run(o)
    local p = { duration = 0.5, dt = 0.01 }
    for k, v in pairs(o or {}) do p[k] = v end
    -- first it sinks into the slope under the normal component of gravity
    local across = f.g * math.cos(angle)
    scene:gravity(slope.vector(0, 0, -across))
    c.settled = scene:settle()
    if not c.settled.ok then return c.settled end
    scene:run{ duration = 10 * p.dt, dt = p.dt, integrator = p.integrator }
    scene:gravity(f.gravity)
    c.before, c.duration = slope.local_point(wire:position(wire.length / 2)), p.duration
    return scene:run(p)
  end

  function c.measured()
    local now = slope.local_point(wire:position(wire.length / 2))
    local v = slope.local_vector(wire:velocity(wire.length / 2))
    return { distance = now[1] - c.before[1], speed = v[1],
      acceleration = 2 * (now[1] - c.before[1]) / c.duration ^ 2 }
  end

  function c.error()
    return math.abs(c.measured().acceleration - c.exact.acceleration) / f.g
  end
  return c
end
