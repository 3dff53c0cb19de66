-- SPDX-License-Identifier: GPL-3.0-or-later
--- Natural frequencies of a wire as it lies at the end of the run, for checks of vibration.
-- @module softworld.check.swings
local MOST = 200 -- most modes asked for [-]
local FIRST = 12
-- A check must come before scene:settle, which starts new peaks.
local ADVICE = "let the run last until the wire is at rest, or give vibration = { tolerance = }"

local ALONE = "give vibration = { alone = true }"

local swings = {}

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
