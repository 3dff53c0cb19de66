-- SPDX-License-Identifier: GPL-3.0-or-later
--- What checks need of ties and clips that are released in a run: their values, read just before.
-- @module softworld.check.released
local build = require "softworld.scene.build"

local released = {}

-- Checks of the scene as it is at the end, which a released clip does not concern.
local at_end = { seated = true }

--- Begins a run: nothing has been released. start: of the run [s].
function released.begin(data, start) data.began, data.released = start, nil end

--- Reads the values of a tie or a clip of the last run, before it is released. kind: "tie" or "clip".
function released.note(fixing, kind)
  local scene = fixing.scene
  local data, values = build.data(scene), {}
  if not data.began or not fixing:exists() then return end
  local context = { scene = scene, run = { start = data.began, time = scene.time, events = {} } }
  for _, member in ipairs(require("softworld.check.registry").list) do
    local wanted = member.on == kind and not at_end[member.name]
    local fine, value = pcall(wanted and member.value or function() end, { object = fixing }, context)
    if fine and value then
      value.note = ("%sreleased at %.6g s"):format(value.note and value.note .. "; " or "", scene.time)
      values[member.name] = value
    end
  end
  data.released = data.released or {}
  table.insert(data.released, { kind = kind, name = fixing.name, object = fixing, released = values })
end

--- Returns what a check takes for the objects of this kind that were released in the last run.
function released.all(scene, kind)
  local list = {}
  for _, entry in ipairs(build.data(scene).released or {}) do
    if entry.kind == kind then list[#list + 1] = entry end
  end
  return list
end

--- Returns a copy of the value of a released object; nil: it has none.
function released.value(entry, name)
  local value = entry.released[name]
  if not value then return nil end
  local copy = {}
  for key, x in pairs(value) do copy[key] = x end
  return copy
end

return released
