-- SPDX-License-Identifier: GPL-3.0-or-later
--- Natural frequencies of a wire as it lies at the end of the run, for checks of vibration.
-- @module softworld.check.swings
local MOST = 200 -- most modes asked for [-]
local FIRST = 12
-- A check must come before scene:settle, which starts new peaks.
local ADVICE = "let the run last until the wire is at rest, or give vibration = { tolerance = }"

local ALONE = "give vibration = { alone = true }"

local swings = {}

-- Returns the longest edge of a wire and its mean tension, at least 0 [m], [N].
local function edge_and_tension(wire)
  local _, s = wire:positions()
  local longest, sum = 0, 0
  for i = 2, #s do
    local edge = s[i] - s[i - 1]
    longest, sum = math.max(longest, edge), sum + edge * wire:tension((s[i] + s[i - 1]) / 2)
  end
  return longest, math.max(0, sum / (s[#s] - s[1]))
end

--- Returns a function that gives for a frequency [Hz] the phase of an edge in its waves [rad], by
-- EI k^4 + T k^2 = m (2 pi f)^2 and the longest edge, and the error of a natural frequency [Hz]: about
-- phase^3 / 20 of it where bending carries the wave, phase^2 / 24 where tension does. Also that edge [m].
function swings.errors(wire)
  local beam, h, T = wire.beam, edge_and_tension(wire)
  return function(f)
    local push = beam.mass_per_length * (2 * math.pi * f) ^ 2
    local stiff = T + math.sqrt(T * T + 4 * beam.EI * push)
    if stiff <= 0 then return math.huge, 0 end
    local k2 = 2 * push / stiff
    local tense, phase2 = T / (T + beam.EI * k2), h * h * k2
    return math.sqrt(phase2), f * (tense * phase2 / 24 + (1 - tense) * phase2 ^ 1.5 / 20)
  end, h
end

swings.MOST = 1 -- largest phase of an edge in waves that edges resolve [rad]

--- Returns the frequency whose waves turn by swings.MOST in an edge, for the function of swings.errors [Hz].
function swings.resolved(errors)
  local low, high = 1e-9, 1e12
  for _ = 1, 100 do
    local middle = math.sqrt(low * high)
    if errors(middle) < swings.MOST then low = middle else high = middle end
  end
  return low
end

--- Returns a note with the number of segments that resolve waves of this frequency.
function swings.advice(wire, turn, edge, top)
  return ("edges of %.3g m are too long for waves of %.4g Hz: segments = %d would do"):format(edge, top,
    math.ceil(wire.segments * turn / swings.MOST))
end

--- Returns what follows a row's note: the others stay fixed with alone = true.
function swings.note(args) return args.alone and "; the other wires stay fixed" or "" end

-- Returns the first count modes, or all if there are fewer.
local function ask(wire, count, args)
  local fine, found = pcall(wire.frequencies, wire, { modes = count, shapes = args.shapes,
    tolerance = args.tolerance, alone = args.alone })
  if fine then return found, count end
  local free = tonumber(tostring(found):match "more than the (%d+) free unknowns")
  if not free or free < 1 then
    error((tostring(found):gsub("call scene:settle%(%) first", ADVICE):gsub("give alone = true", ALONE)), 0)
  end
  return wire:frequencies{ modes = free, shapes = args.shapes, tolerance = args.tolerance,
    alone = args.alone }, free, true
end

--- Returns the frequencies of the wire up to `highest`, or args.modes of them, and whether these are all that
-- is asked for. args as of wire:frequencies.
function swings.up_to(wire, highest, args)
  local count = args.modes or FIRST
  while true do
    local found, got, all = ask(wire, count, args)
    if args.modes or all or (found[#found] or 0) > highest then return found, true end
    if got >= MOST then return found, false end
    count = math.min(MOST, 2 * count)
  end
end

return swings
