-- SPDX-License-Identifier: GPL-3.0-or-later
-- Random wires that are bent slowly: over a peg, from a clamp, between clamps, and hung from a grip. Each
-- builder takes a draw of parameters and a number of segments, and returns the run and its wire.
local sw = require "softworld"

local LENGTH, SLOWLY = 0.3, 0.5 -- [m], [s]
local builders = {}

local function radius(cable) return sw.cable(cable).outer_diameter.value / 2 end

local function begin(o, from, to, segments, peg_at)
  local scene = sw.scene{}
  if peg_at then
    scene:obstacle{ shape = "cylinder", radius = o.peg, length = 0.2, at = { peg_at, 0, 0 }, friction = 0.3,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  end
  scene:force{ kind = "damping", mass = 20, stiffness = 0.003 }
  return scene, scene:wire{ name = "a", cable = o.cable, segments = segments, from = from, to = to }
end

local function finish(scene, wire, duration)
  return scene:run{ duration = duration or 0.6, dt = 0.005 }, wire
end

-- Leads a pin at the wire's end `s` on an arc downwards about a point `free` before it.
local function pull_down(scene, wire, s, side, free, o)
  local points = {}
  for i = 0, 20 do
    local angle, taut = o.turn * i / 20, 1 - (1 - o.taut) * math.min(1, i / 3)
    points[i + 1] = { side * free * (taut * math.cos(angle) - 1), 0, -free * taut * math.sin(angle) }
  end
  scene:pin(wire, { s = s }):follow{ points = points, relative = true, duration = SLOWLY }
end

local function lead(hold, o, side)
  hold:follow{ points = { { 0, 0, 0 }, { -o.inwards, 0, side * o.aside } }, relative = true,
    duration = SLOWLY }
end

--- Both ends are pulled down beside a peg.
function builders.draped(o, segments)
  local z = o.peg + radius(o.cable) + 1e-4
  local scene, wire = begin(o, { -LENGTH / 2, 0, z }, { LENGTH / 2, 0, z }, segments, o.shift)
  pull_down(scene, wire, 0, -1, LENGTH / 2, o)
  pull_down(scene, wire, LENGTH, 1, LENGTH / 2, o)
  return finish(scene, wire)
end

--- One end is clamped, the other one is pulled down over a peg.
function builders.clamped(o, segments)
  local z = o.peg + radius(o.cable) + 1e-4
  local scene, wire = begin(o, { 0, 0, z }, { LENGTH, 0, z }, segments, LENGTH * o.at)
  scene:clamp(wire, { s = 0 })
  pull_down(scene, wire, LENGTH, 1, LENGTH * (1 - o.at), o)
  return finish(scene, wire)
end

--- A cantilever, its end free or led aside by a pin.
function builders.cantilever(o, segments)
  local to = { o.length * math.cos(o.tilt), 0, o.length * math.sin(o.tilt) }
  local scene, wire = begin(o, { 0, 0, 0 }, to, segments)
  scene:clamp(wire, { s = 0 })
  if o.pinned then lead(scene:pin(wire, { s = o.length }), o, -1) end
  return finish(scene, wire, 1)
end

--- Between two clamps, of which one is led aside.
function builders.between(o, segments)
  local scene, wire = begin(o, { 0, 0, 0 }, { LENGTH, 0, 0 }, segments)
  scene:clamp(wire, { s = 0 })
  lead(scene:clamp(wire, { s = LENGTH }), o, 1)
  return finish(scene, wire)
end

--- Hung from a clamp at an inner place.
function builders.gripped(o, segments)
  local scene, wire = begin(o, { 0, 0, 0 }, { LENGTH, 0, 0 }, segments)
  scene:clamp(wire, { s = LENGTH * o.at })
  return finish(scene, wire)
end

local CABLES = { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" }

--- Draws parameters [SI units]. Pegs lie, and clamps hold, anywhere between nodes.
local function draw(random)
  local function between(low, high) return low + (high - low) * random() end
  local length = between(0.1, 0.35)
  return { cable = CABLES[1 + math.floor(3 * random())], segments = math.floor(between(16, 41)),
    peg = between(0.004, 0.03), shift = between(-0.03, 0.03), at = between(0.3, 0.6),
    turn = between(0.2, 1.4), taut = between(0.9, 0.99), length = length, tilt = between(-0.3, 0.6),
    pinned = random() < 0.5, inwards = between(0.02, 0.2) * length, aside = between(0.05, 0.3) * length }
end

return { builders = builders, draw = draw }
