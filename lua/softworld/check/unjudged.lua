-- SPDX-License-Identifier: GPL-3.0-or-later
--- Open rows for what a check cannot judge: limits that apply to nothing, wires that were changed or removed,
-- runs without a step, peaks that began anew.
-- @module softworld.check.unjudged
local build = require "softworld.scene.build"
local registry = require "softworld.check.registry"
local sealed = require "softworld.sealed"

local unjudged = {}

-- Adds a row for each limit that applies to nothing in the scene.
local function add_unused(self, list, open)
  for _, member in ipairs(registry.list) do
    if list[member.name] and not self.made[member.name] then
      open(member.name, nil, member.label, member.unit, {}, "nothing in this run has this value; limits = { "
        .. member.name .. " = false } leaves it out")
    end
  end
end

-- Adds a row for each wire that has changed since the run, instead of its values.
local function add_changed(context, open)
  for _, entry in ipairs(context.wires) do
    if entry.changed then
      open("changed", entry.name, "changed after the run", "-", {}, entry.changed
        .. "; check the run before")
    end
  end
end

-- Adds a row for a run without a step: it shows the start only.
local function add_nothing(self, open)
  if self.time > self.start then return end
  open("run", nil, "the run", "-", {}, "its duration is 0 s: nothing was computed")
end

-- Adds a row for a run in which a process has settled the scene. That began the peaks of wires anew, so those
-- before are lost.
local function add_settled(self, open)
  local time = sealed.fields(self.run).settled
  if not time then return end
  open("settled", nil, "settled during the run", "-", { time = time }, "scene:settle began the peaks, wear "
    .. "and distances of wires anew, so rows of wires are of the time after it; end the run and check it "
    .. "before you settle")
end

-- Adds a row for each wire that was removed during the run.
local function add_gone(self, gone, open)
  for _, g in ipairs(gone) do
    if g.kind == "wire" and g.time > self.start then
      open("removed", g.label, "removed during the run", "-", { time = g.time },
        "its values were lost with it; check the run before you remove it")
    end
  end
end

--- Adds the open rows. list: limits by name; alone: true if the script has no checks of its own; start(name,
-- object, label, unit, value) adds a row without a verdict.
function unjudged.add(self, context, list, alone, start)
  local function open(name, object, label, unit, value, note)
    local row = start(name, object, label, unit, value)
    row.verdict, row.note = "OPEN", note
  end
  local gone = build.data(self.scene).gone or {}
  add_unused(self, list, open)
  add_changed(context, open)
  add_nothing(self, open)
  add_settled(self, open)
  add_gone(self, gone, open)
  if #context.wires > 0 or not alone then return end
  open("wires", nil, "there is no wire", "-", {}, ("nothing of the scene can be judged: it has no wire%s; "
    .. "give checks of your own"):format(#gone > 0 and " any more" or ""))
end

return unjudged
