-- SPDX-License-Identifier: GPL-3.0-or-later
--- Abrasion where wires slide on obstacles and on each other, at the place where it is largest, from every
-- step of a run with wear = true: work of friction per area, and worn depth by Archard's law,
--     depth = coefficient x normal force x way / area.
-- The area is the wire's length times the width of rubbing across it. For a mesh, the friction of all
-- particles of a section counts at the section's place. Friction in feeds, sliders and
-- clips is left out, and so is that of blows. A touch shorter than an edge rubs at one or two nodes only. Its
-- work is then spread over their edges, so the value is a lower bound.
-- @module softworld.check.abrasion
local worn = require "softworld.check.worn"

local abrasion = {}

-- Returns the width on which the wire rubs, and a note if nobody gave it.
local function width(entry, given)
  if given and given.width then return given.width end
  return entry.object.radius, ("on a width of %.3g m, assumed to be the wire's radius"):format(
    entry.object.radius)
end

local ALONE = 0.25 -- least share of the largest wear that the places beside a short touch have [-]

-- Returns the length over which wear is spread, if it is only at one node or two [m]; else nil.
local function lonely(list, k)
  local function at(i) return list[i] and list[i].wear or 0 end
  local least = ALONE * at(k)
  local before, after = at(k - 1) > least, at(k + 1) > least
  if before and (after or at(k - 2) > least) or after and at(k + 2) > least then return nil end
  local first, last = before and k - 1 or k, after and k + 1 or k
  local function border(i) return ((list[i] or list[i + 1]).s + (list[i + 1] or list[i]).s) / 2 end
  return border(last) - border(first - 1)
end

local function join(a, b) return a and b and a .. "; " .. b or a or b end

--- Returns the largest of { rubbed =, slid = } over places by of(place), times repeats, over the width.
function abrasion.largest(entry, context, of)
  local given = context.abrasion
  local places = worn.places(entry)
  if not places then return worn.missing() end
  local across, assumed = width(entry, given)
  local best, list, number = { value = 0, note = assumed }, {}, nil
  for _, place in ipairs(places) do
    local now = of(place) / across * (given and given.repeats or 1)
    if place.side == 0 then list[#list + 1] = { wear = now, s = place.s } end
    if now > best.value then best.value, best.s, number = now, place.s, #list end
  end
  local length = number and lonely(list, number)
  if length and length > entry.object.radius then
    worn.at_least(best, ("spread over %.3g m of edges, though the touch may be shorter"):format(length))
  end
  return best
end

--- Returns the source of the coefficient in words.
function abrasion.source(given)
  return ("%.3g 1/Pa, %s"):format(given.coefficient, join(given.source, given.flag)
    or "assumed: its source is not given")
end

return abrasion
