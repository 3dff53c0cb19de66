-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable with `rolls = true` is wound on a drum against a brake T. Along a free wire tension + EI
-- curvature^2/2 is constant, so it arrives with T - EI/(2 (R + r)^2). There its section already has the tilt
-- of the place where it lies, so its surface does not slide, and friction keeps that tension. Regression: the
-- chords' tilt while they took their places counted as a slide of the surface, and friction of up to mu times
-- the arriving shear force was added to the tension, with edges of any length.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, TURNS, TIME = 0.03, 0.9, 3 -- [m], [-], [s]

-- The drum turns about z; o.tilt turns the scene about x. o.swapped: the wire is numbered from its feed.
local function wound(o)
  local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
  local r = sw.scene{}:wire{ cable = o.cable, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 2 }.radius
  local top, angle, tilt = R + r, 2 * math.pi * TURNS, o.tilt or 0
  local length = 0.2 + top * angle
  local c, s = math.cos(tilt), math.sin(tilt)
  local from, to = { 0, -c * top, -s * top }, { -length, -c * top, -s * top }
  if o.swapped then from, to = to, from end
  local drum = scene:obstacle{ shape = "cylinder", radius = R, length = 0.1, friction = 0.3,
    rotation = { axis = { 1, 0, 0 }, angle = tilt } }
  local wire = scene:wire{ cable = o.cable, rolls = true, segments = math.ceil(length / o.edge), from = from,
    to = to }
  local function at(place) return o.swapped and wire.length - place or place end
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  scene:feed(wire, { s = at(0.12), force = o.swapped and -o.brake or o.brake })
  local turn = { axis = { 0, -s, c }, angle = angle }
  scene:clamp(wire, { s = at(0) }):follow{ about = { 0, 0, 0 }, turn = turn, duration = TIME }
  drum:follow{ turn = turn, duration = TIME }
  t.fine(scene:run{ duration = TIME, dt = o.dt, frames = false })
  local sum = 0
  for k = 0, 20 do sum = sum + wire:tension(at(0.03 + 0.0045 * k)) / 21 end
  return sum, o.brake - wire.beam.EI / (2 * top ^ 2)
end

describe("a cable that rolls, wound on a drum", function()
  for _, o in ipairs{
    { cable = "GXL 1.5", brake = 6, edge = 0.006, dt = 0.01 },
    { cable = "GXL 1.5", brake = 6, edge = 0.006, dt = 0.002 },
    { cable = "GXL 1.5", brake = 6, edge = 0.003, dt = 0.002 },
    { cable = "GXL 1.5", brake = 6, edge = 0.006, dt = 0.005, tilt = 0.7 },
    { cable = "GXL 1.5", brake = 6, edge = 0.006, dt = 0.005, swapped = true },
    { cable = "FLRY-B 0.5", brake = 3, edge = 0.006, dt = 0.01 },
    { cable = "FLRY-B 0.5", brake = 3, edge = 0.006, dt = 0.002 },
  } do
    local name = ("%s, edges of %g m, steps of %g s%s%s"):format(o.cable, o.edge, o.dt,
      o.tilt and ", tilted" or "", o.swapped and ", ends swapped" or "")
    it("keeps the tension that it came on with: " .. name, function()
      local tension, expected = wound(o)
      print(("measured: %.3f N for %.3f N"):format(tension, expected))
      t.near(expected, tension, 0.08 * o.brake, "tension of the wound part")
    end)
  end

  -- Pulls of 5 and 5.4 N stick with a friction of 0.8, but would slide with 0.05. Regression: the velocity of
  -- the drum was taken at the wire's axis, and that of the wire at its surface; so touches that stuck counted
  -- as sliding at the step's start and lost their friction.
  it("goes with a drum on which it sticks, although it would slide with the friction of sliding", function()
    local drum_radius, r, angle, h = 0.02, 0.002, 0.8, math.cos(math.pi / 4)
    local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
    local drum = scene:obstacle{ shape = "cylinder", radius = drum_radius, length = 0.1, friction = 0.8,
      kinetic_friction = 0.05, rotation = { h, h, 0, 0 } }
    local path, a = {}, drum_radius + r
    for k = 0, 10 do path[#path + 1] = { -a, 0, -0.1 * (1 - k / 10) } end
    for k = 1, 40 do
      local phi = math.pi * k / 40
      path[#path + 1] = { -a * math.cos(phi), 0, a * math.sin(phi) }
    end
    for k = 1, 5 do path[#path + 1] = { a, 0, -0.1 * k / 5 } end
    local wire = scene:wire{ E = 1e8, density = 1200, radius = r, rolls = true, segments = 120, path = path }
    scene:force{ kind = "damping", mass = 20, stiffness = 0.002 }
    for _, s in ipairs{ 0, wire.length } do
      scene:force{ kind = "point", on = wire, s = s, force = { 0, 0, -5 } }
    end
    t.fine(scene:run{ duration = 0.3, dt = 0.002, frames = false })
    scene:force{ kind = "point", on = wire, s = 0, force = { 0, 0, -0.4 } }
    t.fine(scene:run{ duration = 0.5, dt = 0.002, frames = false })
    local before = wire:position(0)[3]
    drum:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 0, 1, 0 }, angle = angle },
      duration = 1, relative = true }
    t.fine(scene:run{ duration = 1.2, dt = 0.002, frames = false })
    t.share((drum_radius + r) * angle, wire:position(0)[3] - before, 0.002, "way")
  end)
end)
