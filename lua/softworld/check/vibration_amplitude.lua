-- SPDX-License-Identifier: GPL-3.0-or-later
--- Amplitude of a wire whose holds all shake at random with a spectrum of acceleration W(f): three times the
-- standard deviation relative to the holds, at the node where it is largest, by Miles' response of each mode,
--     sigma^2 = W(f) / (2 damping) / (32 pi^3 f^3)  (displacement for a participation of 1),
-- times shape and participation, with squares summed over the modes.
-- @module softworld.check.vibration_amplitude
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

-- Returns the variances of the nodes' displacement [m2].
local function variances(found, given, mass)
  local sums = {}
  for i = 1, #mass do sums[i] = 0 end
  for n, f in ipairs(found) do
    local W = spectrum_at(given.spectrum, f)
    local P = participation(found.shapes[n], mass)
    local along = given.direction and vec.dot(P, vec.unit(given.direction)) or vec.norm(P)
    local one = W / (2 * given.damping) / (32 * math.pi ^ 3 * f ^ 3) * along ^ 2
    for i = 1, W > 0 and #mass or 0 do
      local x = found.shapes[n]
      sums[i] = sums[i] + one * (x[3 * i - 2] ^ 2 + x[3 * i - 1] ^ 2 + x[3 * i] ^ 2)
    end
  end
  return sums
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
    local mass, places = masses(entry.object)
    local best = { value = 0 }
    for i, variance in ipairs(variances(found, given, mass)) do
      local now = SIGMAS * math.sqrt(variance)
      if now > best.value then best = { value = now, s = places[i] } end
    end
    best.note = ("%d modes up to %.4g Hz, damping ratio %g%s"):format(#found, found[#found], given.damping,
      swings.note(given))
    if not whole then best.low, best.high = best.value, math.huge end
    return best
  end,
  reference = function(entry) return entry.object.length end }
