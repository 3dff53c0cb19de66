-- SPDX-License-Identifier: GPL-3.0-or-later
--- Suggests what to try next when a run failed, by its reason and options.
-- @module softworld.run.advice
local core = require "softworld.core"
local number = require "softworld.output.number"

local advice = {}

-- Words of the core's reasons, the most specific first.
local known = {
  { "fed too fast", "a slower feed, or a smaller dt" },
  { "feed slips", "a slower feed, or a smaller dt" },
  { "tolerance needs steps below", "a larger tolerance or dt, an obstacle with less friction, or fewer "
    .. "segments" },
  { "is crushed", "a smaller force or travel of whatever presses there, or a finer mesh" },
  { "hold of a wire turns", "slower turns, or a smaller dt" },
  { "cuts too deep", "a smaller dt, slower moves, or rounder edges" },
  { "impacts do not come to an end", "a smaller dt, or restitution = 0" },
  { "nothing holds a wire", "a clamp, or an obstacle that the wire can lie on" },
}

local function is_explicit(integrator)
  for _, m in ipairs(core.registry().integrators) do
    if m.name == integrator then return not m.implicit end
  end
  return false
end

--- Returns a phrase that follows "try".
function advice.of(reason, args)
  if args.integrator and is_explicit(args.integrator) then
    return "dt below scene:stable_dt(), or an implicit integrator"
  end
  for _, row in ipairs(known) do
    if reason:find(row[1], 1, true) then return row[2] end
  end
  local smaller = args.dt and ("dt = %s"):format(number.text(args.dt / 4, "s")) or "a smaller dt"
  if args.quasistatic then return smaller .. " (poses nearer to each other), or a run without quasistatic" end
  return smaller .. ", slower moves, more segments, or integrator = 'implicit-euler'"
end

return advice
