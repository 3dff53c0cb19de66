-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scenes shared by the contact specs.
local core = require "softworld.core"
local cable = require "softworld.cable"

local scenes = {}

-- A soft wire of 30 g/m, 5 mm thick.
scenes.wire = { EA = 2e3, EI = 1e-3, mass_per_length = 0.03, radius = 0.0025 }

-- Cables of the catalogue: thin, usual, thick, very soft.
scenes.cables = { "GXL 0.5", "GXL 1.5", "FLRY-B 10", "H07V-K 10", "identified white" }

--- Returns the properties of a catalogue cable, in the form of scenes.wire.
function scenes.cable(name)
  local c = cable.get(name)
  return { EA = c.EA.value, EI = c.EI.value, GJ = c.GJ.value, mass_per_length = c.mass_per_length.value,
    radius = c.outer_diameter.value / 2 }
end

function scenes.add_wire(scene, from, to, segments, changes)
  local t = { from = from, to = to, segments = segments }
  for k, v in pairs(scenes.wire) do t[k] = v end
  for k, v in pairs(changes or {}) do t[k] = v end
  return scene:wire(t)
end

--- A wire of length L lying straight on a table along x.
function scenes.lying(options)
  local o = options or {}
  local s = core.scene{ gravity = o.gravity }
  local L, n = o.length or 1, o.segments or 50
  local w = scenes.add_wire(s, { 0, 0, 0.0025 }, { L, 0, 0.0025 }, n, o.wire)
  local table_ = s:obstacle{ shape = "plane", friction = o.friction or 0.3 }
  return s, w, table_, L
end

--- Adds a table and two rails on it. Three wires of radius r fit exactly side by side between the rails.
function scenes.railed(s, r, friction)
  local plane = s:obstacle{ shape = "plane", friction = friction }
  local rails = {}
  for k, y in ipairs{ -r - 0.005, 5 * r + 0.005 } do
    rails[k] = s:obstacle{ shape = "box", size = { 1, 0.01, 0.05 }, at = { 0.2, y, 0.025 },
      friction = friction }
  end
  return plane, rails
end

--- Returns a wire of 0.4 m with its middle at o.at, turned by o.turn and tilted by o.tilt. It is flung at
-- o.speed along x against a wall of 10 mm by 1 m by 0.5 m at x = 0.3.
function scenes.flung(o)
  local s = core.scene{ gravity = { 0, 0, -9.81 } }
  local wall = s:obstacle{ shape = "box", size = { 0.01, 1, 0.5 }, at = { 0.3, 0, 0.25 },
    friction = o.friction or 0.3 }
  local d = { math.cos(o.turn) * math.cos(o.tilt), math.sin(o.turn) * math.cos(o.tilt),
    math.sin(o.tilt) }
  local from, to = {}, {}
  for k = 1, 3 do
    from[k] = o.at[k] - 0.2 * d[k]
    to[k] = o.at[k] + 0.2 * d[k]
  end
  local w = scenes.add_wire(s, from, to, o.segments, o.wire)
  w:set_velocity{ o.speed or 30, 0, 0 }
  return s, w, wall
end

--- Returns true if the wire's axis crosses the plane x = 0.3 more than `margin` inside the wall's outline:
-- such a wire has passed through the wall.
function scenes.pierces(wire, margin)
  local x = wire:positions()
  for i = 1, #x - 3, 3 do
    local a, b = x[i] - 0.3, x[i + 3] - 0.3
    if a * b < 0 then
      local f = a / (a - b)
      local y = x[i + 1] + f * (x[i + 4] - x[i + 1])
      local z = x[i + 2] + f * (x[i + 5] - x[i + 2])
      if math.abs(y) < 0.5 - margin and z < 0.5 - margin and z > margin then return true, y, z end
    end
  end
  return false
end

return scenes
