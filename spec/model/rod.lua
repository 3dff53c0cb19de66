-- SPDX-License-Identifier: GPL-3.0-or-later
--- The soft wire of the specs of chosen models.
local rod = { radius = 0.0025 } -- [m]

function rod.wire(scene, more)
  local args = { name = "w", E = 5e6, density = 1500, radius = rod.radius, from = { 0, 0, 0 },
    to = { 0.6, 0, 0 }, segments = 24, model = "auto" }
  for key, value in pairs(more or {}) do args[key] = value end
  if args.path then args.from, args.to = nil, nil end
  return scene:wire(args)
end

--- Makes two damped wires that hang one above the other and sag, so near that only touches show whether they
-- meet. slack: how their second ends come nearer, as clamp:follow takes it. Returns the lower wire.
function rod.beside(scene, slack)
  local lower
  scene:force { kind = "damping", mass = 5 }
  for k, name in ipairs { "a", "b" } do
    local z = 2.2 * rod.radius * (k - 1)
    local w = rod.wire(scene, { name = name, from = { 0, 0, z }, to = { 0.6, 0, z } })
    lower = lower or w
    scene:clamp(w, { s = 0 })
    scene:clamp(w, { s = 0.6 }):follow(slack)
  end
  return lower
end

return rod
