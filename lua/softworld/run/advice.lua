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
  { "no equilibrium exists", "a run without quasistatic, which computes how the wire slips; a larger force "
    .. "of the jaws; or a smaller pull" },
  { "nothing holds a wire", "a clamp, or an obstacle that the wire can lie on" },
  { "which nothing holds, is carried away", "a clamp, or an obstacle that the wire can lie on; or a run "
    .. "without quasistatic" },
}

local function is_explicit(integrator)
  for _, m in ipairs(core.registry().integrators) do
    if m.name == integrator then return not m.implicit end
  end
  return false
end

-- Kinds of events of what is driven into something, or presses or points a wire into it. Their object is
-- what is driven, or the wire between two things; their text quotes what it is driven into.
local driven = { crash = true, pressed = true }

-- Returns what was driven into the obstacle that presses on this wire, and since when [s]; or nil.
local function driven_into(events, obstacle, wire)
  local by, since
  local into = ("'%s'"):format(obstacle)
  for _, e in ipairs(events) do
    local other = driven[e.kind] and e.object ~= wire and e.object ~= obstacle
    if other and e.text:find(into, 1, true) and e.first < (since or math.huge) then
      by, since = e.object, e.first
    end
  end
  return by, since
end

-- Returns a phrase for the first of what ran deep into an obstacle, or nil.
local function crash_of(events)
  local first
  for _, e in ipairs(events) do
    local name = e.kind == "crash"
      and (e.text:match " deep into '(.-)'; " or e.text:match " deep into '(.*)'$")
    if name and not (first and first.first <= e.first) then
      first = { first = e.first, by = e.object, into = name }
    end
  end
  return first and ("another path: that of '%s' leads into '%s' from t = %.3f s on"):format(first.by,
    first.into, first.first)
end

-- Returns a phrase for a wire that two obstacles squeeze, or nil.
local function squeeze_of(events, wire)
  for _, e in ipairs(events) do
    local one, two, between = e.text:match "^obstacles '(.-)' and '(.-)' squeeze wire '(.-)' by "
    if e.kind == "crash" and between == wire then
      return ("other paths: '%s' and '%s' squeeze '%s' from t = %.3f s on, and its section does not yield; "
        .. "or pads, or a mesh as the wire's model"):format(one, two, wire, e.first)
    end
  end
end

-- Returns a phrase for a wire that its own path presses against an obstacle, or nil.
local function path_of(reason, scene)
  local name, wire = reason:match "; obstacle '(.-)' presses '(.-)' with "
  if not name then return crash_of(scene:events()) end
  local squeeze = squeeze_of(scene:events(), wire)
  if squeeze then return squeeze end
  local by, since = driven_into(scene:events(), name, wire)
  if by then
    return ("another path: that of '%s' leads into '%s' from t = %.3f s on"):format(by, name, since)
  end
  local crash = crash_of(scene:events())
  if crash then return crash end
  since = reason:find("is crushed", 1, true) and reason:match ", after touching since t = (%S+) s"
  return since and ("another path: '%s' and '%s' are pressed into each other from t = %s s on; or a smaller "
    .. "force, or a finer mesh"):format(wire, name, since)
end

--- Returns the reason of a failed run with what to try next. After a crash smaller steps do not help, but
-- another path.
function advice.added(reason, args, scene)
  local smaller = reason:find("; take smaller steps", 1, true)
  local phrase = not smaller and advice.of(reason, args, scene) or scene and path_of(reason, scene)
  if not phrase then return reason end
  return ("%s; try %s"):format(smaller and reason:sub(1, smaller - 1) or reason, phrase)
end

--- Returns a phrase that follows "try". scene: that of the run, if known.
function advice.of(reason, args, scene)
  local path = scene and not reason:find("no equilibrium exists", 1, true) and path_of(reason, scene)
  if path then return path end
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
