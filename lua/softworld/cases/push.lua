-- SPDX-License-Identifier: GPL-3.0-or-later
--- A stiff rod of 1 kg on a rough floor, pushed along its axis by force * m g.
-- Options: force (1), friction (0.4), g 9.8 as in the DisMech case it is taken from.
-- exact.acceleration = g max(0, force - mu).
-- @module softworld.cases.push
local sw = require "softworld"
local frame = require "softworld.cases.frame"

return function(options)
  local o1 = {}
  for k, v in pairs(options) do o1[k] = v end
  o1.gravity = o1.gravity or { 0, 0, -9.8 }
  local f = frame.new(o1)
  local mu, share, radius = options.friction or 0.4, options.force or 1, 0.025
  local scene = sw.scene{ name = "push", gravity = f.gravity }
  scene:obstacle{ shape = "plane", friction = mu, at = f.point(0, 0, 0), rotation = f.quaternion }
  local wire = scene:wire{ E = 1e5, density = 1 / (math.pi * radius ^ 2), radius = radius,
    segments = options.segments or 20, model = options.model,
    from = f.point(0, 0, radius), to = f.point(1, 0, radius) }
  local c = { name = "push", scene = scene, wire = wire, frame = f,
    exact = { acceleration = f.g * math.max(0, share - mu), source = "closed form" } }

  function c.run(o)
    local p = { duration = 1, dt = 0.005 }
    for k, v in pairs(o or {}) do p[k] = v end
    local settled = scene:settle()
    if not settled.ok then return settled end
    scene:run{ duration = 10 * p.dt, dt = p.dt, integrator = p.integrator }
    scene:force{ kind = "line", on = wire, force = f.vector(share * f.g / wire.length, 0, 0) }
    c.before = f.local_point(wire:position(wire.length / 2))
    c.duration = p.duration
    return scene:run(p)
  end

  function c.measured()
    local now = f.local_point(wire:position(wire.length / 2))
    return { distance = now[1] - c.before[1], speed = f.local_vector(wire:velocity(0.5))[1],
      acceleration = 2 * (now[1] - c.before[1]) / c.duration ^ 2 }
  end

  function c.error() return math.abs(c.measured().acceleration - c.exact.acceleration) / f.g end
  return c
end
