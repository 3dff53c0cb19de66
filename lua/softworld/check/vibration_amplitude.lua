-- SPDX-License-Identifier: GPL-3.0-or-later
--- Amplitude of a wire whose holds all shake at random with a spectrum of acceleration W(f): three times the
-- standard deviation relative to the holds, at the node where it is largest, by Miles' response of each mode,
--     sigma^2 = W(f) / (2 damping) / (32 pi^3 f^3)  (displacement for a participation of 1),
-- times shape and participation, with squares summed over the modes.
-- @module softworld.check.vibration_amplitude
local counted = require "softworld.output.number".count
local holding = require "softworld.check.holding"
local swings = require "softworld.check.swings"
local vec = require "softworld.vec"

local SIGMAS = 3 -- a peak in standard deviations [-]

-- Returns the spectrum at f: straight lines in logarithms, 0 beyond its ends.
local function spectrum_at(points, f)
  for i = 1, #points - 1 do
    local a, b = points[i], points[i + 1]
    if f >= a[1] and f <= b[1] then
      return a[2] * (b[2] / a[2]) ^ (math.log(f / a[1]) / math.log(b[1] / a[1]))
    end
  end
  return 0
end

-- Returns the mass of each node [kg].
local function masses(wire)
  local _, s = wire:positions()
  local list, per_length = {}, wire.beam.mass_per_length
  for i = 1, #s do
    list[i] = per_length * ((s[i + 1] or s[i]) - (s[i - 1] or s[i])) / 2
  end
  return list, s
end

-- Returns the participation of a mode by direction: shape times mass [sqrt(kg)].
local function participation(shape, mass)
  local sum = { 0, 0, 0 }
  for i = 1, #mass do
    for k = 1, 3 do sum[k] = sum[k] + mass[i] * shape[3 * i - 3 + k] end
  end
  return sum
end

-- Returns 2 damping times the variance of a displacement of 1 in a mode with frequency f.
local function response(W, f) return W / (32 * math.pi ^ 3 * f ^ 3) end

-- Returns the least and the largest response of a frequency known to within an error. Between its points the
-- spectrum is a power of f, so its extremes are at points, or at the ends.
local function responses(points, f, bar)
  local from, to = math.max(f - bar, f * 1e-3), f + bar
  local low, high = math.huge, 0
  local function look(at)
    local one = response(spectrum_at(points, at), at)
    low, high = math.min(low, one), math.max(high, one)
  end
  look(from)
  look(to)
  for _, p in ipairs(points) do
    if p[1] > from and p[1] < to then look(p[1]) end
  end
  if from < points[1][1] or to > points[#points][1] then low = 0 end
  return low, high
end

-- Error of an amplitude by the shape of its mode, over phase^2. Edges are straight, so a shape of given mass
-- is phase^2/12 too large, and its mass in the middle of waves as much too small: phase^2/12 in all.
local SHAPE = 1 / 8

-- Largest participation^2 x shape^2 of all modes together at one node: participations have the mass as sum of
-- squares, and shapes are at most 2 / sqrt(mass), at a free end.
local ALL = 4

-- Returns lists of the nodes' variances: value, least, largest [m2].
local function variances(found, given, mass, errors)
  local sums, least, most = {}, {}, {}
  for i = 1, #mass do sums[i], least[i], most[i] = 0, 0, 0 end
  for n, f in ipairs(found) do
    local phase, bar = errors(f)
    local P = participation(found.shapes[n], mass)
    local along = given.direction and vec.dot(P, vec.unit(given.direction)) or vec.norm(P)
    local one = along ^ 2 / (2 * given.damping)
    local now = response(spectrum_at(given.spectrum, f), f)
    local low, high = responses(given.spectrum, f, bar)
    if phase > swings.MOST then low, high = 0, 0 end -- counted by unresolved()
    local shape = 1 + SHAPE * phase ^ 2
    for i = 1, high + now > 0 and #mass or 0 do
      local x = found.shapes[n]
      local all = one * (x[3 * i - 2] ^ 2 + x[3 * i - 1] ^ 2 + x[3 * i] ^ 2)
      sums[i], least[i] = sums[i] + all * now, least[i] + all * low / shape ^ 2
      most[i] = most[i] + all * high * shape ^ 2
    end
  end
  return sums, least, most
end

-- Returns the largest variance of modes that edges do not resolve [m2], and the frequency from which on.
local function unresolved(found, given, errors)
  local from, most = swings.resolved(errors), 0
  if #found == 0 or found[#found] <= from then return 0 end
  for _, p in ipairs(given.spectrum) do
    if p[1] >= from then most = math.max(most, response(p[2], p[1])) end
  end
  most = math.max(most, response(spectrum_at(given.spectrum, from), from))
  return (given.direction and 1 or 3) * ALL * most / (2 * given.damping)
end

local function largest(list)
  local best, at = 0, nil
  for i, v in ipairs(list) do
    if v > best then best, at = v, i end
  end
  return SIGMAS * math.sqrt(best), at
end

local MATTERS = 0.1 -- share of the range from which unresolved modes are named [-]

-- Returns the amplitude with its range by the length of edges.
local function amplitude(wire, found, given)
  local errors, edge = swings.errors(wire)
  local mass, places = masses(wire)
  local sums, least, most = variances(found, given, mass, errors)
  local value, at = largest(sums)
  local rest = SIGMAS * math.sqrt(unresolved(found, given, errors))
  local high = math.sqrt(largest(most) ^ 2 + rest ^ 2)
  local best = { value = value, s = at and places[at], low = math.min(value, (largest(least))),
    high = math.max(value, high) }
  best.note = ("%s up to %.4g Hz, damping ratio %g%s"):format(counted(#found, "mode"), found[#found] or 0,
    given.damping, swings.note(given))
  if rest > MATTERS * best.high then
    local top = given.spectrum[#given.spectrum][1]
    best.note = best.note .. "; " .. swings.advice(wire, errors(top), edge, top)
  end
  return best
end

return { name = "vibration_amplitude", unit = "m", side = "max", on = "wire", asked = true,
  label = "amplitude of vibration, 3 sigma", missing = "allowed amplitude",
  wanted = function(context) return context.vibration ~= nil and context.vibration.spectrum ~= nil end,
  value = function(entry, context)
    local given = context.vibration
    if not (given and given.spectrum) then
      return { value = 0 / 0, note = "it needs vibration = { spectrum = { { f [Hz], W [(m/s2)2/Hz] } }, "
        .. "damping = }" }
    end
    local args = { shapes = true, modes = given.modes, tolerance = given.tolerance,
      alone = given.alone }
    local found, whole = swings.up_to(entry.object, given.spectrum[#given.spectrum][1], args)
    if found.unstable > 0 then return { value = 0 / 0, note = found.note } end
    local best = amplitude(entry.object, found, given)
    if not whole then best.high = math.huge end
    return holding.widen(best, context.run)
  end,
  reference = function(entry) return entry.object.length end }
