-- SPDX-License-Identifier: GPL-3.0-or-later
--- Abrasion where wires slide on obstacles and on each other, at the place where it is largest, from every
-- step of a run with wear = true: work of friction per area, and worn depth by Archard's law,
--     depth = coefficient x normal force x way / area.
-- The area is the wire's length times the width of rubbing across it. For a mesh, the friction of all
-- particles of a section counts at the section's place. Friction in feeds, sliders and
-- clips is left out, and so is that of blows.
-- @module softworld.check.abrasion
local worn = require "softworld.check.worn"

local abrasion = {}

-- Returns the width on which the wire rubs, and a note if nobody gave it.
local function width(entry, given)
  if given and given.width then return given.width end
  return entry.object.radius, ("on a width of %.3g m, assumed to be the wire's radius"):format(
    entry.object.radius)
end

local function join(a, b) return a and b and a .. "; " .. b or a or b end

--- Returns the largest of { rubbed =, slid = } over places by of(place), times repeats, over the width.
function abrasion.largest(entry, context, of)
  local given = context.abrasion
  local places = worn.places(entry)
  if not places then return worn.missing() end
  local across, assumed = width(entry, given)
  local best = { value = 0, note = assumed }
  for _, place in ipairs(places) do
    local now = of(place) / across * (given and given.repeats or 1)
    if now > best.value then best.value, best.s = now, place.s end
  end
  return best
end

--- Returns the source of the coefficient in words.
function abrasion.source(given)
  return ("%.3g 1/Pa, %s"):format(given.coefficient, join(given.source, given.flag)
    or "assumed: its source is not given")
end

return abrasion
