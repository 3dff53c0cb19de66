-- SPDX-License-Identifier: GPL-3.0-or-later
--- What scene:settle returns. A failure, and events, that the script has not looked at are reported at its
-- end, as for runs. The library's own calls are within unread.excused.
-- @module softworld.scene.rest
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local place = require "softworld.place"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"

local rest = {}

local TOLD = { kink = "kinked", held = "held" } -- fields of the result with the text of such an event

--- Returns the scene's events by kind and object; the count of one tells how often it was reported.
function rest.events(scene)
  local found = {}
  for _, e in ipairs(scene:events()) do found[e.kind .. " " .. e.object] = e end
  return found
end

--- Returns the events that were reported since `before`, in the order of their kinds and objects.
function rest.fresh(scene, before)
  local list = {}
  for key, e in pairs(rest.events(scene)) do
    if not before[key] or before[key].count < e.count then list[#list + 1] = e end
  end
  table.sort(list, function(a, b)
    if a.kind == b.kind then return a.object < b.object end
    return a.kind < b.kind
  end)
  return list
end

local Rest = { __name = "rest" }
local field = checks.fields("the result of scene:settle",
  "ok reason iterations residual unstable transient jumped events",
  "kinked held steps rejected evaluations quantities met levels advice error_bars where refused asked start")

function Rest.__index(self, key)
  local apart, value = unread.look(self, key)
  if apart then return value end
  return field(self, key)
end

-- Returns the texts of the events, for print: all of those that say how it came to rest, else the first.
local function told(self)
  local list, parts = self.events, {}
  for _, e in ipairs(list) do
    if TOLD[e.kind] or #parts == 0 then parts[#parts + 1] = "; " .. e.text end
  end
  if #list > #parts then parts[#parts + 1] = ("; %s in all (.events)"):format(counted(#list, "event")) end
  return table.concat(parts)
end

function Rest:__tostring()
  if not self.ok then return self.reason end
  local unstable = self.unstable > 0 and ", unstable in " .. counted(self.unstable, "direction") or ""
  return ("at rest after %s%s%s"):format(counted(self.iterations, "iteration"), unstable, told(self))
end

local Settled = { __name = "settled" }

function Settled.__index(result, key)
  if key == "error_bars" then return trust.error_bars end
  local apart, value = unread.look(result, key)
  if apart then return value end
  return trust.refuse(result, key)
end

function Settled:__tostring()
  if not self.ok then return ("not settled: %s"):format(self.reason) end
  local unmet = trust.unmet(self)
  return ("settled on %s%s%s\n%s"):format(counted(#self.levels, "level"), unmet and ", " .. unmet or "",
    told(self), tostring(self:error_bars()))
end

-- Keeps in mind what a script must look at; returns the mark, or nil.
local function mark_of(what, result, list)
  if not result.ok then
    return unread.add(("softworld: %s FAILED: %s; the script did not look at its result"):format(what,
      result.reason), true)
  end
  local first = list[1]
  if not first then return nil end
  local event = ("%s: %s"):format(first.kind, first.text)
  return unread.note(("softworld: note: %s is ok, but has %s; see .events of its result: %s"):format(what,
    counted(#list, "event"), event), event)
end

--- Makes the result of a settle from the core's, or from that of error bars. list: its events.
function rest.new(scene, result, list)
  local at = place.of_caller()
  local what = ("scene:settle of '%s'%s"):format(scene.name, at and " at " .. at or "")
  local mark, unmet = mark_of(what, result, list), result.levels and trust.watch(result, what)
  local keys = { "events" }
  result.events = list
  for _, e in ipairs(list) do
    local key = TOLD[e.kind]
    if key then result[key], keys[#keys + 1] = e.text, key end
  end
  if not result.ok then
    unread.hide(result, mark, "ok", "reason")
  elseif mark then
    unread.hide(result, mark, table.unpack(keys))
  end
  if unmet then unread.hide(result, unmet, "met", "advice") end
  return setmetatable(result, result.levels and Settled or Rest)
end

return rest
