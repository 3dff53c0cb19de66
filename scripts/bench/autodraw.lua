-- SPDX-License-Identifier: GPL-3.0-or-later
--- Random parts of scenes for bench.auto.
-- @module bench.autodraw
local draw = {}

--- Returns a number from a to b.
function draw.between(random, a, b) return a + (b - a) * random() end
--- Returns an item of a list.
function draw.pick(random, list) return list[1 + math.floor(random() * #list)] end

--- Returns a wire's section.
function draw.wire_of(random)
  return draw.pick(random, { { E = 5e6, density = 1500, radius = 0.0025 }, { E = 50e6, density = 1500,
    radius = 0.0025 },
    { EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03, radius = 0.0018 },
    { EA = 1e5, EI = 1.3e-3, GJ = 1.6e-3, mass_per_length = 0.02, radius = 0.0015 } })
end

local STIFF = { E = true, EI = true, EA = true, GJ = true }

--- Adds a wire of this section, with more arguments and the options of a model; options.stiffer: a factor.
function draw.made(scene, section, options, more)
  local args = { segments = 24, rolls = options.rolls, model = options.auto and "auto" or nil }
  for key, value in pairs(section) do args[key] = STIFF[key] and value * (options.stiffer or 1) or value end
  for key, value in pairs(more) do args[key] = value end
  return scene:wire(args)
end

--- Adds the parts that all scenes have.
function draw.finish(scene, options)
  scene:force{ kind = "damping", mass = 5 }
  if options.contact then scene:wire_contact{} end
  return scene
end

return draw
