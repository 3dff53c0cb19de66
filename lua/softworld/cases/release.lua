-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire clamped level, straight and at rest, is released: undamped swing for 1 s.
-- Options: gamma (10 or 100), axial (EA L^2/EI; default that of the round section, which the
-- reference has with radius 2.5 mm), radius (0.0025 m), section (of meshes), every: time between
-- samples [s] (0.1; must divide 0.1 by a whole number, at the finest 0.05).
-- error(): root mean square of the tip's distance over L, samples 0.1 .. 1 s.
-- largest(t): largest distance up to t [m].
-- @module softworld.cases.release
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Geometrically exact Hermite elements, 64 against 32 of them (128 against 64 for
-- gamma = 100), same L, r, rho, g, EA; error below 7e-5 m, about 5e-6 m: t [s],
-- tip x, tip z [m].
local exact = {
  [10] = {
    { 0, 1, 0 }, { 0.05, 0.9997802804, -0.01228664019 }, { 0.1, 0.9974036755, -0.04799326216 },
    { 0.15, 0.989413268, -0.1362740875 }, { 0.2, 0.9601006233, -0.2684564189 },
    { 0.25, 0.8906225889, -0.4245891627 }, { 0.3, 0.7959826539, -0.5631101146 },
    { 0.35, 0.6840285843, -0.6851581705 }, { 0.4, 0.5518483248, -0.7830938456 },
    { 0.45, 0.387452889, -0.8513469418 }, { 0.5, 0.2179142026, -0.8720748006 },
    { 0.55, 0.08543313836, -0.8591366139 }, { 0.6, -0.0003282280957, -0.8406128029 },
    { 0.65, -0.0246348378, -0.8383884044 }, { 0.7, 0.002169300872, -0.8508932676 },
    { 0.75, 0.0764821834, -0.8682629101 }, { 0.8, 0.2004904074, -0.8756993916 },
    { 0.85, 0.3489957658, -0.8559364628 }, { 0.9, 0.5141202672, -0.7962282477 },
    { 0.95, 0.666979579, -0.6988551058 }, { 1, 0.794672023, -0.5726210878 },
  },
  [100] = {
    { 0, 1, 0 }, { 0.05, 0.999621185, -0.01222057387 }, { 0.1, 0.9957529646, -0.04900368358 },
    { 0.15, 0.983062495, -0.1111087947 }, { 0.2, 0.954771201, -0.1819136833 },
    { 0.25, 0.9046531868, -0.2941833718 }, { 0.3, 0.8300766697, -0.4718854227 },
    { 0.35, 0.690471681, -0.6973102347 }, { 0.4, 0.4440918201, -0.8757091529 },
    { 0.45, 0.1556629684, -0.9302229205 }, { 0.5, -0.08980569443, -0.9118438407 },
    { 0.55, -0.3079401249, -0.8550188559 }, { 0.6, -0.4903390261, -0.7701593436 },
    { 0.65, -0.6118819472, -0.6851894057 }, { 0.7, -0.6773346775, -0.5939553738 },
    { 0.75, -0.7126081416, -0.4816978364 }, { 0.8, -0.725856774, -0.3550716066 },
    { 0.85, -0.6993936813, -0.2294848025 }, { 0.9, -0.6162397654, -0.1221315787 },
    { 0.95, -0.4888886184, -0.07129002113 }, { 1, -0.3655485694, -0.08710495463 },
  },
}

return function(options)
  local f = frame.new(options)
  local gamma = options.gamma or 10
  local rows = exact[gamma]
  local p = wires.parameters{ gamma = gamma, g = f.g, segments = options.segments,
    model = options.model, axial = options.axial, radius = options.radius, section = options.section }
  local scene = sw.scene{ name = "release", gravity = f.gravity }
  local wire = wires.straight(scene, f, p, { 0, 0, 0 }, { 1, 0, 0 })
  local clamp = scene:clamp(wire, { s = 0 })
  local c = { name = "release", scene = scene, wire = wire, clamp = clamp, frame = f,
    parameters = p, exact = rows, duration = 1,
    source = "geometrically exact Hermite elements, error about 5e-6 m" }
  c.run = wires.compared(c, rows, options.every)

  function c.error()
    local sum, count = 0, 0
    for _, sample in ipairs(c.samples) do
      if math.abs(sample.row[1] * 10 - math.floor(sample.row[1] * 10 + 0.5)) < 1e-9 then
        sum, count = sum + wires.off(sample) ^ 2, count + 1
      end
    end
    return (sum / count) ^ 0.5
  end
  return c
end
