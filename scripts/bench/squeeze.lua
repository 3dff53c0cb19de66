-- SPDX-License-Identifier: GPL-3.0-or-later
--- Wires that are meshes of particles under extreme loads: squeezed, twisted, bent, turned inside out, thrown
-- onto an edge. The note of a row has the values by which it is judged.
-- @module bench.squeeze
local core = require "softworld.core"
local stable = require "bench.stable"

local squeeze = {}

local radius, slices = 0.01, 20 -- [m], [-]

--- Meshes and their kind of section.
squeeze.meshes = { { "tube", "springs" }, { "radial", "springs" }, { "cubic", "springs" },
  { "composite", "springs" }, { "radial", "solid" }, { "cubic", "solid" } }

-- Makes a scene with a wire. Long composite wires have a simple core, since the tests load the shell.
local function scene_of(o, length, segments)
  local sw = require "softworld"
  local scene = sw.scene{ name = "mesh", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ model = o.mesh[1], section = o.mesh[2] == "solid" and "solid" or nil,
    E = 1e7, density = 1200, radius = radius, from = { 0, 0, 0 }, to = { length, 0, 0 },
    segments = segments, core = o.mesh[1] == "composite" and not segments and "line" or nil }
  return scene, wire
end

-- Runs the scene for a duration in steps of dt; adds the results to a row.
local function drive(scene, o, duration, row)
  local began = core.clock()
  local r = scene:advance({ dt = o.dt, integrator = o.integrator }, scene.time + duration)
  row.rejected, row.steps = (row.rejected or 0) + r.rejected, (row.steps or 0) + r.steps
  row.wall = (row.wall or 0) + core.clock() - began
  row.status, row.reason = r.ok and "ok" or "failed", not r.ok and r.reason or nil
  return r.ok
end

-- Returns how far particles have moved relative to their ring, over the radius [-]: the largest change of the
-- distance to the first particle of the ring.
local function deformed(wire, before, per_ring)
  local now, most = wire:particles(), 0
  for p = 0, #now // 3 - 1 do
    local first, d, d0 = p - p % per_ring, 0, 0
    for k = 1, 3 do
      d = d + (now[3 * p + k] - now[3 * first + k]) ^ 2
      d0 = d0 + (before[3 * p + k] - before[3 * first + k]) ^ 2
    end
    most = math.max(most, math.abs(d ^ 0.5 - d0 ^ 0.5))
  end
  return most / radius
end

local function per_ring_of(wire) return #wire:particles() // 3 // (wire.segments + 1) end

-- The wire lies between two plates; the upper plate moves down by a share of the diameter and up again.
local function pressed(o)
  local length = 0.1
  local scene, wire = scene_of(o, length, slices)
  local before, size = wire:particles(), { 3 * length, 0.2, 2 * radius }
  scene:force{ kind = "damping", mass = 20 } -- [1/s]
  scene:obstacle{ shape = "box", size = size, at = { length / 2, 0, -2 * radius }, friction = 0.3 }
  local plate = scene:obstacle{ shape = "box", size = size, at = { length / 2, 0, 2 * radius },
    friction = 0.3 }
  local down = -2 * radius * o.share
  plate:follow{ points = { { 0, 0, 0 }, { 0, 0, down } }, duration = 1, relative = true }
  local row, most, fall = {}, 0, 0
  for _ = 1, 20 do -- the force of a section that folds through falls with further squeezing
    if not drive(scene, o, 0.05, row) then break end
    local force = plate:force()[3]
    most, fall = math.max(most, force), math.max(fall, most - force)
  end
  local force = plate:force()[3]
  fall = fall / most
  plate:follow{ points = { { 0, 0, 0 }, { 0, 0, 2 * radius } }, duration = 0.4, relative = true }
  if row.status == "ok" and drive(scene, o, 0.8, row) then
    local left = deformed(wire, before, per_ring_of(wire))
    row.note = ("%.0f N/m, falls by up to %.0f %%, afterwards %.2g radii off"):format(force / length,
      100 * fall, left)
    row.status = left > 0.05 and "stays" or fall > 0.1 and "folds" or "ok"
  end
  scene:close()
  return row
end

-- One end is twisted, slowly enough that waves decay.
local function twisted(o)
  local scene, wire = scene_of(o, 1, nil)
  scene:force{ kind = "damping", mass = 5 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = 1 })
  hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 4, relative = true,
    turn = { axis = { 1, 0, 0 }, angle = 2 * math.pi * o.turns } }
  local row = {}
  if drive(scene, o, 4.5, row) then
    local middle, GJ = wire:position(0.5), 1e7 * math.pi * radius ^ 4 / 4 / 1.35
    row.note = ("torque %.3f of GJ angle/L, middle %.2f m off the axis"):format(
      math.abs(hand:moment()[1]) / (GJ * 2 * math.pi * o.turns), (middle[2] ^ 2 + middle[3] ^ 2) ^ 0.5)
  end
  scene:close()
  return row
end

-- Both ends are moved side by side, so that the middle bends like a hairpin.
local function bent(o)
  local length = 5 * radius
  local scene, wire = scene_of(o, length, slices)
  scene:force{ kind = "damping", mass = 20 }
  scene:clamp(wire, { s = 0 })
  local hand, half, points = scene:clamp(wire, { s = length }), length / 2, {}
  for k = 0, 20 do -- on an arc, to one diameter above the other end
    local a, u = math.pi * k / 20, k / 20
    points[k + 1] = { half * (math.cos(a) - 1), 0, half * math.sin(a) * (1 - u) + 2 * radius * u }
  end
  hand:follow{ points = points, duration = 4, relative = true,
    turn = { axis = { 0, 1, 0 }, angle = -math.pi } }
  local row = {}
  if drive(scene, o, 4.5, row) then
    row.note = ("bend radius %.2f times the wire's"):format(wire:min_bend_radius{ now = true } / radius)
  end
  scene:close()
  return row
end

-- In the middle of the wire, the particles above the axis are pushed through the lower side and released.
local function inverted(o)
  local length = 0.1
  local scene, wire = scene_of(o, length, slices)
  local before, per_ring = wire:particles(), per_ring_of(wire)
  scene:force{ kind = "damping", mass = 20 }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = length })
  scene:force{ kind = function(t, x, _, f)
    for i = 1, t < 0.2 and #x or 0, 3 do
      local near = math.abs(before[i] - length / 2) < 0.01
      if near and before[i + 2] > 0.2 * radius then f[i + 2] = -o.push end
    end
  end, on = wire }
  local row = {}
  if drive(scene, o, 0.2, row) then
    local most = deformed(wire, before, per_ring)
    if drive(scene, o, 1, row) then
      local left = deformed(wire, before, per_ring)
      row.note = ("%.2g radii off, afterwards %.2g"):format(most, left)
      if left > 0.05 then row.status = "stays" end
    end
  end
  scene:close()
  return row
end

-- The wire flies horizontally onto the upper edge of a thin wall.
local function flung(o)
  local length = 0.3
  local scene, wire = scene_of(o, length, nil)
  scene:obstacle{ shape = "box", size = { 0.004, 0.3, 0.2 }, at = { length / 2, 0, -radius - 0.12 },
    friction = 0.3 }
  wire:set_velocity{ 0, 0, -10 }
  local kinetic, row, gain, depth = scene:energy().kinetic, {}, 0, 0
  for _ = 1, 25 do
    if not drive(scene, o, 0.002, row) then break end
    gain = math.max(gain, scene:energy().total / kinetic - 1)
    depth = math.max(depth, (scene:penetration()))
  end
  if row.status == "ok" then
    row.gain = gain
    row.note = ("%.2f mm deep, energy up to %+.1f %%"):format(1e3 * depth, 100 * gain)
    if gain > 0.02 or gain ~= gain then row.status = "gains" end
    if depth > radius then row.status = "through" end
  end
  scene:close()
  return row
end

--- Calls add(item, run, options) for every row.
function squeeze.add_all(add)
  for _, mesh in ipairs(squeeze.meshes) do
    local function put(item, run, o)
      o.mesh, o.model, o.segments = mesh, mesh[1] .. (mesh[2] == "solid" and ", solid" or ""), slices
      add(item, run, o)
    end
    put("squeezed to 60 %", pressed, { share = 0.4, dt = 0.005 })
    put("twisted by 10 turns", twisted, { turns = 10, dt = 0.01 })
    put("bent to its own radius", bent, { dt = 0.01 })
    put("pushed inside out", inverted, { push = 100, dt = 0.002 })
    for _, dt in ipairs{ 0.002, 0.0005 } do put("10 m/s onto an edge", flung, { dt = dt }) end
  end
end

--- Returns the largest step [s] with which an explicit method stays bounded on a mesh, how it was found, and
-- scene:stable_dt() scaled to the method's limit [s].
function squeeze.measure(integrator, mesh, scale, rounds)
  local length, scene, wire = 0.1, scene_of({ mesh = mesh }, 0.1, slices)
  scene:clamp(wire, { s = 0 })
  wire:set_velocity{ 1e-6 * length, 0, 1e-6 * length }
  local snapshot, start, own = scene:snapshot(), scene:energy().total, scale * scene:stable_dt()
  local found, how = stable.largest(function(dt)
    scene:restore(snapshot)
    local r = scene:advance({ dt = dt, integrator = integrator, unstable = true },
      stable.steps * dt)
    return r.ok and r.rejected == 0 and scene:energy().total < stable.blown * start
  end, own, own * 3, rounds or 7)
  scene:close()
  return found, how, own
end

return squeeze
