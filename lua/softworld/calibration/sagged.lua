-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire that hangs in a plane, as in a photograph: its equilibrium as a rod, and the distances of measured
-- points from it.
-- @module softworld.calibration.sagged
local core = require "softworld.core"
local unread = require "softworld.unread"

local sagged = {}

-- Segments; a mesh with twice as many gives the second-order error, which is removed. The rest is of fourth
-- order in the edge over the length (EI / weight)^(1/3) of the bends at the ends [-].
local COARSE, PER_BEND = { 60, 80, 110, 150, 200, 270, 360, 480 }, 10
local GRAVITY = 9.81 -- [m/s2]
local ITERATIONS = 5000 -- of an equilibrium; slack wires that are stiff move far from the arc [-]

-- Returns a polygon of n equal edges of a given length, in an arc below the chord between the ends with nodes
-- at its corners. The half angle a of the arc, sin(a) / (n sin(a / n)) = chord / length, is found by
-- bisection.
local function arc(from, to, length, n)
  local dx, dz = to[1] - from[1], to[2] - from[2]
  local chord = math.sqrt(dx * dx + dz * dz)
  local low, high = 0, math.pi
  for _ = 1, 60 do
    local a = 0.5 * (low + high)
    if math.sin(a) / (n * math.sin(a / n)) > chord / length then low = a else high = a end
  end
  local half = 0.5 * (low + high) * (dx < 0 and -1 or 1)
  local heading, points = math.atan(dz, dx) - half * (1 - 1 / n), { { from[1], 0, from[2] } }
  for k = 1, n do
    local before = points[k]
    points[k + 1] = { before[1] + length / n * math.cos(heading), 0,
      before[3] + length / n * math.sin(heading) }
    heading = heading + 2 * half / n
  end
  return points
end

local function direction(d) return { d[1], 0, d[2] } end

local function place(scene, o, wire)
  if o.ends == "cantilever" then
    wire.from = { o.from[1], 0, o.from[2] }
    local d = o.directions[1]
    local size = math.sqrt(d[1] ^ 2 + d[2] ^ 2)
    wire.to = { o.from[1] + o.length * d[1] / size, 0, o.from[2] + o.length * d[2] / size }
  else
    wire.path = arc(o.from, o.to, o.length, wire.segments)
  end
  local w = scene:wire(wire)
  if o.ends == "hung" then
    scene:pin(w, { s = 0 })
    scene:pin(w, { s = w.length })
    return w
  end
  scene:clamp(w, { s = 0, direction = direction(o.directions[1]) })
  if o.ends == "clamped" then scene:clamp(w, { s = w.length, direction = direction(o.directions[2]) }) end
  return w
end

-- Returns the segments of the coarser mesh: the number goes up in steps, so that it does not change between
-- the neighbours of which a fit takes a difference.
local function segments_of(o, EI, mass_per_length)
  local wanted = PER_BEND * o.length * (GRAVITY * mass_per_length / EI) ^ (1 / 3)
  for _, n in ipairs(COARSE) do
    if n >= wanted then return n end
  end
  return COARSE[#COARSE]
end

-- Returns the stations of one mesh, count of them and the first.
local function stations(o, wire, segments, count)
  local scene = core.scene { gravity = { 0, 0, -GRAVITY } }
  wire.segments = segments
  local w = place(scene, o, wire)
  local rest, list = unread.excused(scene.settle, scene, { max_iterations = ITERATIONS }), {}
  if not rest.ok then error("no equilibrium: " .. rest.reason, 0) end
  for k = 0, count do
    local s = w.length * k / count
    local x, t = w:position(s), w:tangent(s)
    list[k + 1] = { x[1], x[3], t[1], t[3] }
  end
  scene:close()
  return list
end

--- Returns the equilibrium of o { ends = "clamped" | "hung" | "cantilever", from =, to = {x, z}, directions
-- =, length =, radius = } with EI, EA and a mass per length: stations { { x, z, tx, tz }, ... } along it.
-- Raises an error if there is none.
function sagged.curve(o, EI, EA, mass_per_length)
  local wire = { EI = EI, EA = EA, GJ = EI, mass_per_length = mass_per_length, radius = o.radius }
  local n = segments_of(o, EI, mass_per_length)
  local coarse, fine = stations(o, wire, n, n), stations(o, wire, 2 * n, n)
  for k, at in ipairs(fine) do
    for i = 1, 4 do at[i] = (4 * at[i] - coarse[k][i]) / 3 end
  end
  return fine
end

-- Returns place and direction on the Hermite cubic between two stations, at t from 0 to 1.
local function between(a, b, h, t)
  local u = 1 - t
  local h0, h1 = (1 + 2 * t) * u * u, t * t * (3 - 2 * t)
  local m0, m1 = h * t * u * u, -h * t * t * u
  local d0, d1 = 6 * t * t - 6 * t, h * (1 - 4 * t + 3 * t * t)
  local d2 = h * (3 * t * t - 2 * t)
  return h0 * a[1] + h1 * b[1] + m0 * a[3] + m1 * b[3], h0 * a[2] + h1 * b[2] + m0 * a[4] + m1 * b[4],
    d0 * (a[1] - b[1]) + d1 * a[3] + d2 * b[3], d0 * (a[2] - b[2]) + d1 * a[4] + d2 * b[4]
end

--- Returns places along the curve for a picture: xs, zs.
function sagged.line(list)
  local xs, zs, parts = { list[1][1] }, { list[1][2] }, 5
  for k = 2, #list do
    local a, b = list[k - 1], list[k]
    local h = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
    for i = 1, parts do xs[#xs + 1], zs[#zs + 1] = between(a, b, h, i / parts) end
  end
  return xs, zs
end

--- Returns the distance of a point {x, z} to the left of the curve, at the nearest place (beyond an end, from
-- the extension) [m].
function sagged.beside(list, point)
  local nearest, least = 1, math.huge
  for k = 1, #list do
    local d = (point[1] - list[k][1]) ^ 2 + (point[2] - list[k][2]) ^ 2
    if d < least then nearest, least = k, d end
  end
  local at = list[nearest]
  local along = (point[1] - at[1]) * at[3] + (point[2] - at[2]) * at[4]
  local k = math.max(1, math.min(#list - 1, along > 0 and nearest or nearest - 1))
  local a, b = list[k], list[k + 1]
  local h = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
  local t = 0.5
  for _ = 1, 20 do
    local x, z, dx, dz = between(a, b, h, t)
    local step = ((point[1] - x) * dx + (point[2] - z) * dz) / (dx * dx + dz * dz)
    local before = t
    t = math.max(0, math.min(1, t + step))
    if math.abs(t - before) < 1e-12 then break end
  end
  local x, z, dx, dz = between(a, b, h, t)
  return (dx * (point[2] - z) - dz * (point[1] - x)) / math.sqrt(dx * dx + dz * dz)
end

return sagged
