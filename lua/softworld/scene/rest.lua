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

-- By the result: ok and reason of a failure with its mark, or the new events with theirs; the mark of
-- tolerances that are not met.
local hidden = setmetatable({}, { __mode = "k" })

local TOLD = { kink = "kinked", held = "held" } -- fields of the result with the text of such an event
local FIELD = { kinked = "kink", held = "held" }

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

local function text_of(list, kind)
  for _, e in ipairs(list or {}) do if e.kind == kind then return e.text end end
end

-- Returns a field of the result that is kept apart; reading it counts as a look.
local function look(self, key)
  local own = hidden[self]
  if not own then return nil end
  if own.ok == false and (key == "ok" or key == "reason") then
    if own.mark then unread.seen(own.mark) end
    return own[key]
  end
  if own.unmet and (key == "met" or key == "advice") then
    unread.seen(own.unmet)
    if key == "met" then return false end
    return own.advice
  end
  if key ~= "events" and not FIELD[key] then return nil end
  if own.ok and own.mark then unread.seen(own.mark) end
  if key == "events" then return own.events end
  return text_of(own.events, FIELD[key])
end

local Rest = { __name = "rest" }
local field = checks.fields("the result of scene:settle",
  "ok reason iterations residual unstable transient jumped events",
  "kinked held steps rejected evaluations quantities met levels advice error_bars where refused asked start")

function Rest.__index(self, key)
  local value = look(self, key)
  if value ~= nil then return value end
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
  local value = look(result, key)
  if value ~= nil then return value end
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

--- Returns the reason of a result without looking at it.
function rest.reason(result)
  local own = hidden[result]
  return own and own.reason or rawget(result, "reason")
end

--- Makes the result of a settle from the core's, or from that of error bars. list: its events.
function rest.new(scene, result, list)
  local at = place.of_caller()
  local what = ("scene:settle of '%s'%s"):format(scene.name, at and " at " .. at or "")
  local own = { ok = result.ok, events = list, mark = mark_of(what, result, list) }
  own.unmet = result.levels and trust.watch(result, what) or nil
  if own.unmet then
    own.advice = result.advice
    result.met, result.advice = nil, nil
  end
  if not result.ok then
    own.reason = result.reason
    result.ok, result.reason = nil, nil
  end
  hidden[result] = own
  return setmetatable(result, result.levels and Settled or Rest)
end

return rest
