-- SPDX-License-Identifier: GPL-3.0-or-later
--- Natural frequencies of a wire where it lies at the end of the run, for checks of vibration.
-- @module softworld.check.swings
local MOST = 200 -- modes that are asked for at most [-]
local FIRST = 12
-- A check comes before scene:settle, which begins the peaks anew.
local ADVICE = "let the run last until the wire is at rest, or give vibration = { tolerance = }"

local swings = {}

-- As many as there are, if these are fewer than wanted.
local function ask(wire, count, args)
  local fine, found = pcall(wire.frequencies, wire, { modes = count, shapes = args.shapes,
    tolerance = args.tolerance })
  if fine then return found, count end
  local free = tonumber(tostring(found):match "more than the (%d+) free unknowns")
  if not free or free < 1 then
    error((tostring(found):gsub("call scene:settle%(%) first", ADVICE)), 0)
  end
  return wire:frequencies{ modes = free, shapes = args.shapes, tolerance = args.tolerance }, free, true
end

--- Frequencies of the wire up to one, or args.modes of them; args as of wire:frequencies. Returns them, and
-- whether they are all that is asked for.
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
