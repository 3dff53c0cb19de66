-- SPDX-License-Identifier: GPL-3.0-or-later
--- What holds wires at the end of a run. Natural frequencies are read when a check is made. If something was
-- released or added since the run, they are those of another hold.
-- @module softworld.check.holding
local build = require "softworld.scene.build"
local core = require "softworld.core"
local fixing = require "softworld.link.fixing"
local sealed = require "softworld.sealed"

local holding = {}

--- Returns what holds now: object -> its name. Clamps, pins, grips, sliders, joins, clips, ties.
function holding.now(scene)
  local data, found = build.data(scene), {}
  for _, list in ipairs{ data.holds, data.joins } do
    for _, entry in ipairs(list) do
      if core.exists(entry.object) and entry.object.held then found[entry.object] = entry.name or "a hold" end
    end
  end
  for _, f in ipairs(fixing.all(scene)) do found[f] = f.name end
  return found
end

-- Returns the first name, by the alphabet, of what one has and the other lacks; or nil.
local function lacking(one, other)
  local least
  for object, name in pairs(one) do
    if not other[object] and (not least or name < least) then least = name end
  end
  return least
end

--- Opens the range of a value that depends on what holds the wire, if that was changed after the run.
function holding.widen(value, run)
  local was = sealed.fields(run).holding
  if not was then return value end
  local now = holding.now(run.scene)
  local gone, new = lacking(was, now), lacking(now, was)
  if not (gone or new) then return value end
  value.low, value.high = -math.huge, math.huge
  value.note = ("%s'%s' was %s after the run, and this is read as the wire is held now; check the run "
    .. "before"):format(value.note and value.note .. "; " or "", gone or new, gone and "released" or "made")
  return value
end

return holding
