-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two cables wound round each other, clamped at both ends, with their helices as shapes without load.
local sw = require "softworld"

--- Makes the pair in a scene. o: cables, pitch [m], turns; per: edges in a turn (default 24). Returns the
-- clamps of both far ends, and the distance between the ends [m].
return function(scene, o)
  local distance, reach, ends = o.pitch * o.turns, 0, {}
  for _, cable in ipairs(o.cables) do reach = reach + sw.cable(cable).outer_diameter.value / 2 end
  for k, cable in ipairs(o.cables) do
    local path, per, out = {}, o.per or 24, (k == 1 and 1 or -1) * 0.5025 * reach
    for i = 0, 8 * per * o.turns do
      local x = distance * i / (8 * per * o.turns)
      local phi = 2 * math.pi * x / o.pitch
      path[#path + 1] = { x, out * math.cos(phi), out * math.sin(phi) }
    end
    local wire = scene:wire{ cable = cable, path = path, segments = per * o.turns, rest = "path" }
    scene:clamp(wire, { s = 0 })
    ends[k] = scene:clamp(wire, { s = wire.length })
  end
  scene:wire_contact{ friction = 0.2 }
  scene:force{ kind = "damping", mass = 30, stiffness = 0.001 }
  return ends, distance
end
