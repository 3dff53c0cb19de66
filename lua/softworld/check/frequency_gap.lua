-- SPDX-License-Identifier: GPL-3.0-or-later
--- Gap between the natural frequencies of a wire, as it lies at the end, and bands of excitation: the least
-- distance over the band's edge, below 0 if a frequency is in a band. Edges make errors of frequencies; where
-- waves of the bands turn by more than 1 rad in an edge, modes are wrong or missing.
-- @module softworld.check.frequency_gap
local holding = require "softworld.check.holding"
local swings = require "softworld.check.swings"
local terms = require "softworld.check.terms"

-- Returns the gap of a frequency from a band, above 0 outside.
local function apart(f, band)
  if f < band[1] then return (band[1] - f) / band[1] end
  if f > band[2] then return (f - band[2]) / band[2] end
  local low = band[1] > 0 and (f - band[1]) / band[1] or math.huge
  return -math.min(low, (band[2] - f) / band[2])
end

-- Returns the least and the largest gap of a frequency known to within an error.
local function range(f, bar, band)
  local low, high = apart(f - bar, band), apart(f + bar, band)
  if low > high then low, high = high, low end
  local middle = (band[1] + band[2]) / 2 -- the worst frequency lies there, or at an end
  return math.min(low, apart(math.max(f - bar, math.min(f + bar, middle)), band)), high
end

-- Widens the value by the errors of edges, and says where they are too long for the bands.
local function widen(value, found, bands, wire)
  local errors, edge = swings.errors(wire)
  local low, high, top = math.huge, math.huge, 0
  for _, band in ipairs(bands) do
    top = math.max(top, band[2])
    for _, f in ipairs(found) do
      local _, bar = errors(f)
      local from, to = range(f, bar, band)
      low, high = math.min(low, from), math.min(high, to)
    end
  end
  local turn = errors(top)
  value.low, value.high = low, high
  if turn <= swings.MOST then return end
  value.low, value.high = -math.huge, math.huge
  value.note = value.note .. "; " .. swings.advice(wire, turn, edge, top)
end

local function least(found, bands)
  local best = { value = math.huge }
  for n, f in ipairs(found) do
    for _, band in ipairs(bands) do
      local now = apart(f, band)
      if now < best.value then
        best.value = now
        best.note = ("mode %d, %.4g Hz, and the band of %g to %g Hz"):format(n, f, band[1], band[2])
      end
    end
  end
  return best
end

return { name = "frequency_gap", unit = "-", side = "min", on = "wire", asked = true,
  terms = terms.one,
  label = "distance of natural frequencies from bands of excitation", missing = "wanted distance",
  wanted = function(context) return context.vibration ~= nil and context.vibration.bands ~= nil end,
  value = function(entry, context)
    local given = context.vibration
    if not (given and given.bands) then
      return { value = 0 / 0, note = "the bands are missing; give vibration = { bands = { { from, to } } } "
        .. "[Hz]" }
    end
    local highest = 0
    for _, band in ipairs(given.bands) do highest = math.max(highest, band[2]) end
    local found, whole = swings.up_to(entry.object, highest, given)
    if found.unstable > 0 then return { value = 0 / 0, note = found.note } end
    local value = least(found, given.bands)
    value.note = (value.note or "no natural frequency") .. swings.note(given)
    widen(value, found, given.bands, entry.object)
    if not whole then
      value.low = -math.huge
      value.note = ("%s; %d modes reach up to %.4g Hz only"):format(value.note, #found, found[#found])
    end
    return holding.widen(value, context.run)
  end,
  limit = function()
    return { value = 0, from = "definition", source = "no natural frequency within a band" }
  end }
