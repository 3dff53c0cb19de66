-- SPDX-License-Identifier: GPL-3.0-or-later
--- Landing error: the largest distance of the wire's centre line from a wanted path, at the end of the run.
-- Path and wire are polylines; the distance is measured at the wire's nodes and at the ends of its part that
-- must lie there. A path may go on beyond the wire; the row says how far. A detour of the path that the wire
-- leaves out makes a range.
-- @module softworld.check.landing
local detour = require "softworld.check.detour"
local number = require "softworld.output.number"
local terms = require "softworld.check.terms"
local vec = require "softworld.vec"

local SLACK = 1e-9 -- rounding of arc lengths [m]
local MOST_OFF = 0.5 -- share of the path's length that may lie beyond the wire [-]

-- Returns the distance of a point from the piece between a and b.
local function from_piece(p, a, b)
  local way, to = vec.sub(b, a), vec.sub(p, a)
  local long = vec.dot(way, way)
  local share = long > 0 and math.max(0, math.min(1, vec.dot(to, way) / long)) or 0
  return vec.norm(vec.sub(to, vec.scale(way, share)))
end

local function from_path(p, path)
  local least = math.huge
  for i = 1, math.max(1, #path - 1) do
    least = math.min(least, from_piece(p, path[i], path[i + 1] or path[i]))
  end
  return least
end

-- Returns the part of the wire's line from arc length `from` to `to`: points, and their arc lengths [m].
local function part_of(x, from, to)
  local points, places, before, s = {}, {}, nil, 0
  local function add(p, at) points[#points + 1], places[#places + 1] = p, at end
  for i = 1, #x, 3 do
    local p = { x[i], x[i + 1], x[i + 2] }
    local way = before and vec.sub(p, before) or p
    local long = before and vec.norm(way) or 0
    for _, at in ipairs(to > from and { from, to } or { from }) do
      if s < at and at < s + long then add(vec.add(before, vec.scale(way, (at - s) / long)), at) end
    end
    s, before = s + long, p
    if s >= from and s <= to then add(p, s) end
  end
  return points, places
end

-- Returns the length of a wire's line [m].
local function length_of(x)
  local sum = 0
  for i = 4, #x, 3 do
    sum = sum + vec.norm{ x[i] - x[i - 3], x[i + 1] - x[i - 2], x[i + 2] - x[i - 1] }
  end
  return sum
end

-- Returns how far the farthest of these points is from a line, and its number.
local function farthest(points, line)
  local most, which = 0, nil
  for i, p in ipairs(points) do
    local far = from_path(p, line)
    if far > most then most, which = far, i end
  end
  return most, which
end

-- Returns a note if the wire as a whole does not reach all of the path; and a doubt if it reaches less than
-- half of it: a path in mm passes close to the wire, too.
local function uncovered(wanted, beyond, corner, points, reach)
  if wanted.from or wanted.to then return nil end
  local note = ("point %d of the path is %s from the wire, which is not counted"):format(corner,
    number.text(beyond, "m"))
  local share = detour.share_beyond(points, wanted.path, reach)
  return note, share > MOST_OFF and ("%.3g %% of the path's length is not counted; is its unit right (m)?")
    :format(100 * share) or nil
end

-- Says which part of the path the wire does not reach. A part between others that the wire reaches is a
-- detour which the wire leaves out: the error is then known between the value and the detour's distance.
local function add_rest(best, wanted, points, radius)
  local beyond, corner = farthest(wanted.path, points)
  local reach = best.value + radius
  if beyond <= reach or #wanted.path < 2 then return best end
  best.note, best.doubt = uncovered(wanted, beyond, corner, points, reach)
  local off, gap = detour.distance(points, wanted.path, radius)
  if off > reach + gap then
    best.low, best.high = best.value, off
    best.note = ("the wire leaves out a detour of the path, %s aside"):format(number.text(off, "m"))
  end
  return best
end

local function value(entry, context)
  local wanted, wire = context.landing, entry.object
  if not wanted then
    return { value = 0 / 0, note = "the wanted path is missing; give landing = { path = points }" }
  end
  if wanted.wire and wanted.wire ~= entry.name then return nil end
  local x, from = wire:positions(), wanted.from or 0
  local long = length_of(x)
  for _, name in ipairs{ "from", "to" } do
    local at = wanted[name]
    if at and at > math.max(long, wire.length) + SLACK then
      return { value = 0 / 0, note = ("landing.%s = %g m is beyond the wire's end at %g m"):format(name, at,
        wire.length) }
    end
  end
  local points, places = part_of(x, math.min(from, long - SLACK), wanted.to or math.huge)
  local far, which = farthest(points, wanted.path)
  return add_rest({ value = far, s = places[which], time = context.run.time }, wanted, points, wire.radius)
end

return { name = "landing_error", unit = "m", side = "max", places = true, on = "wire", asked = true,
  terms = terms.places,
  label = "largest distance from the wanted path at the end", missing = "allowed landing error",
  wanted = function(context) return context.landing ~= nil end, value = value,
  reference = function(entry) return entry.object.length / 100 end }
