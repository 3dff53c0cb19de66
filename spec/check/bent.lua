-- SPDX-License-Identifier: GPL-3.0-or-later
local sw = require "softworld"

local L, RADIUS = 0.1, require "spec.check.capstan".RADIUS

-- A wire between two clamps that follow a circle of curvature k(t); turn(t): both about the wire.
return function(k, turn, run_options, wire_options)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local given = { name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02, radius = RADIUS,
    from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 40 }
  for key, value in pairs(wire_options or {}) do given[key] = value end
  local wire = scene:wire(given)
  turn = turn or function() return 0 end
  -- the rotation: first about the wire as it was drawn, then in the plane of the circle
  local function rotation(roll, angle)
    local a, b, c, d = math.cos(roll / 2), math.sin(roll / 2), math.cos(angle / 2), math.sin(-angle / 2)
    return { a * c, b * c, a * d, -b * d }
  end
  local function place(s)
    return function(t)
      local angle = k(t) * s
      local r = math.abs(angle) > 1e-9 and s / angle
      return r and { r * math.sin(angle), 0, r * (1 - math.cos(angle)) } or { s, 0, 0 },
        rotation(turn(t), angle)
    end
  end
  for _, s in ipairs{ 0, L } do
    scene:clamp(wire, { s = s }):follow{ duration = 4, func = place(s) }
  end
  local options = { duration = 4, dt = 0.02, quasistatic = true, wear = true, frame = 4 }
  for key, value in pairs(run_options or {}) do options[key] = value end
  return scene:run(options), scene, wire
end
