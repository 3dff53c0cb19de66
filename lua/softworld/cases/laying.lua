-- SPDX-License-Identifier: GPL-3.0-or-later
--- Laying over three thin walls. The wire starts straight from (0, 0, 0.15) to
-- (-1, 0, 0.15). A level clamp at its first end moves by 2 m in 5 s (minimum jerk) over
-- a table with walls 10 mm thick and 100 mm high at x = 0.4, 0.9 and 1.4 m.
-- Options: gamma (10), friction (0.3), segments (100), distance [m] (2), duration [s] (5).
-- No exact answer; measured() returns values that must stay small.
-- @module softworld.cases.laying
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

return function(options)
  local f = frame.new(options)
  local p = wires.parameters{ gamma = options.gamma or 10, g = f.g,
    segments = options.segments or 100, model = options.model }
  local mu = options.friction or 0.3
  local scene = sw.scene{ name = "laying", gravity = f.gravity }
  local obstacles = {}
  obstacles[1] = scene:obstacle{ name = "table", shape = "plane", friction = mu, at = f.point(0, 0, 0),
    rotation = f.quaternion }
  for i, x in ipairs{ 0.4, 0.9, 1.4 } do
    obstacles[i + 1] = scene:obstacle{ name = "wall " .. i, shape = "box", size = { 0.01, 1, 0.1 },
      at = f.point(x, 0, 0.05), rotation = f.quaternion, friction = mu }
  end
  local wire = wires.straight(scene, f, p, { 0, 0, 0.15 }, { -1, 0, 0.15 })
  local clamp = scene:clamp(wire, { s = 0 })
  local duration = options.duration or 5
  local c = { name = "laying", scene = scene, wire = wire, clamp = clamp, frame = f,
    parameters = p, duration = duration, obstacles = obstacles }

  --- options of scene:run.
  function c.run(o)
    clamp:follow{ points = { f.point(0, 0, 0.15), f.point(options.distance or 2, 0, 0.15) },
      times = { 0, duration }, law = "minimum-jerk" }
    local q = { duration = duration }
    for k, v in pairs(o or {}) do q[k] = v end
    return scene:run(q)
  end

  function c.measured()
    local depth, s, t = scene:penetration()
    local tip = f.local_point(wire:position(wire.length))
    return { penetration = depth, where = s, when = t, tip = tip,
      tension = wire:max_tension(), bend_radius = wire:min_bend_radius(),
      energy = scene:energy().total }
  end
  return c
end
