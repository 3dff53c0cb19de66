-- SPDX-License-Identifier: GPL-3.0-or-later
--- Landing error: the largest distance of the wire's centre line from a wanted path, at the end of the run.
-- Path and wire are polylines; the distance is measured at the wire's nodes.
-- @module softworld.check.landing
local vec = require "softworld.vec"

local SLACK = 1e-9 -- rounding of arc lengths [m]

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

return { name = "landing_error", unit = "m", side = "max", on = "wire", asked = true,
  label = "largest distance from the wanted path at the end", missing = "allowed landing error",
  wanted = function(context) return context.landing ~= nil end,
  value = function(entry, context)
    local wanted = context.landing
    if not wanted then
      return { value = 0 / 0, note = "the wanted path is missing; give landing = { path = points }" }
    end
    if wanted.wire and wanted.wire ~= entry.name then return nil end
    local x, best, s = entry.object:positions(), { value = 0, time = context.run.time }, 0
    local from, to = wanted.from or 0, wanted.to or math.huge
    local before, seen
    for i = 1, #x, 3 do
      local p = { x[i], x[i + 1], x[i + 2] }
      if before then s = s + vec.norm(vec.sub(p, before)) end
      before = p
      local within = s >= from - SLACK and s <= to + SLACK
      local far = within and from_path(p, wanted.path) or 0
      seen = seen or within
      if far > best.value then best.value, best.s = far, s end
    end
    return seen and best or { value = 0 / 0, note = "no node of the wire is between from and to" }
  end,
  reference = function(entry) return entry.object.length / 100 end }
