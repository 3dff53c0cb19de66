-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes for bench.auto in which a wire is drawn over a peg: a wire that hangs down behind the peg, and a
-- nearly weightless and limp wire, for which the capstan equation gives the true force.
-- @module bench.autoguided
local draw = require "bench.autodraw"
local sw = require "softworld"

local autoguided = {}

local LENGTH, FREE = 0.5, 0.2 -- length of a wire, of its part from the hand to the peg [m]

-- Adds the peg: a cylinder along y.
local function peg(scene, radius, friction, z)
  scene:obstacle { name = "peg", shape = "cylinder", radius = radius, length = 0.4, friction = friction,
    at = { 0, 0, z }, rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
end

-- The wire lies on the peg, its far end is free. The hand draws it along, and up or down. (If both ends were
-- held and drawn down, the wire would form an arch that falls off the peg to a random side.)
local function pegged(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 1, 5, 20 })
  local mu, radius = draw.pick(random, { 0, 0.1, 0.3 }), draw.between(random, 0.02, 0.04)
  local pull, lift = draw.between(random, 0.02, 0.1), draw.between(random, -0.08, 0.03)
  return function(options)
    local scene = sw.scene { name = "pegged" }
    peg(scene, radius, mu, -radius - section.radius)
    local w = draw.made(scene, section, options, { name = "w", from = { -FREE, 0, 0 },
      to = { LENGTH - FREE, 0, 0 }, segments = 40 })
    scene:clamp(w, { s = 0, name = "hand" }):follow { relative = true, duration = duration,
      points = { { 0, 0, 0 }, { -pull, 0, lift } } }
    return draw.finish(scene, options), { "hand.force", "peg.mean_force" }, duration
  end
end

local ERROR = 0.003 -- of the capstan equation: bending, EI/(T R^2) = 0.001, and stretch [-]
local ENDS, WAY = 0.1, 0.03 -- straight length at each end of the arc, how far the wire is drawn [m]
local POINTS = 40 -- intervals of the arc

-- Point of the arc about the peg's axis at the angle a from the x axis; direction of the wire there.
local function on_arc(R, a) return { R * math.cos(a), 0, R * math.sin(a) } end
local function along(a) return { math.sin(a), 0, -math.cos(a) } end
local function beyond(p, t, way) return { p[1] + way * t[1], 0, p[3] + way * t[3] } end

-- Returns the wire's path (straight, round the peg by an angle, straight) and its directions at both ends.
local function round(R, angle)
  local first, path = math.pi / 2 + angle / 2, {}
  for i = 10, 1, -1 do path[#path + 1] = beyond(on_arc(R, first), along(first), -ENDS * i / 10) end
  for i = 0, POINTS do path[#path + 1] = on_arc(R, first - angle * i / POINTS) end
  for i = 1, 10 do
    path[#path + 1] = beyond(on_arc(R, first - angle), along(first - angle), ENDS * i / 10)
  end
  return path, along(first), along(first - angle)
end

-- A force T pulls at the wire's start, a hand at its end. The hand needs exp(mu angle) times this force.
local function capstan(random)
  local mu, angle = draw.between(random, 0.05, 0.4), draw.between(random, 0.5, 1.2) * math.pi
  local T, R, duration = draw.between(random, 0.5, 3), draw.between(random, 0.03, 0.05),
    draw.pick(random, { 5, 20 })
  local radius = 0.0025
  local wide = R + radius
  local EI = 0.001 * T * wide ^ 2
  local section = { EA = 1e4, EI = EI, GJ = EI, mass_per_length = 0.02, radius = radius }
  local path, into, out = round(wide, angle)
  local pull = T * math.exp(mu * angle)
  return function(options)
    local scene = sw.scene { name = "capstan", gravity = { 0, 0, 0 } }
    peg(scene, R, mu, 0)
    local w = draw.made(scene, section, options, { name = "w", path = path, segments = 32 })
    scene:force { kind = "point", on = w, s = 0, force = { -T * into[1], 0, -T * into[3] } }
    scene:pin(w, { s = w.length, name = "hand" }):follow { relative = true, duration = duration,
      points = { { 0, 0, 0 }, beyond({ 0, 0, 0 }, out, WAY) } }
    return draw.finish(scene, options), { "hand.force" }, duration
  end, false, { ["hand.force"] = { value = { pull * out[1], 0, pull * out[3] }, error = ERROR * pull } }
end

autoguided.scenes = { { name = "pegged", of = pegged, flat = true },
  { name = "capstan", of = capstan, flat = true } }

return autoguided
