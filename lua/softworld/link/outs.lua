-- SPDX-License-Identifier: GPL-3.0-or-later
--- Wires that came out of clips (event `out`) or did not go in (event `unreached`): a script that asks the
-- clip needs no note about it.
-- @module softworld.link.outs
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local unread = require "softworld.unread"

local outs = {}

local looked = setmetatable({}, { __mode = "k" }) -- clips that the script asked
local marks = setmetatable({}, { __mode = "k" })  -- by clip: marks of notes about it alone

outs.looks = checks.set "pulled_out seated state wire ratio height" -- what a script reads to see it

--- The script reads one of these.
function outs.seen(clip)
  looked[clip] = true
  for _, mark in ipairs(marks[clip] or {}) do unread.seen(mark) end
  marks[clip] = nil
end

local function clip_of(scene, event)
  if event.kind ~= "out" and event.kind ~= "unreached" then return nil end
  for _, entry in ipairs(build.data(scene).fixings) do
    if entry.name == event.object then return entry.fixing end
  end
end

--- Returns the events without those of clips that the script has asked.
function outs.others(scene, events)
  local list = {}
  for _, e in ipairs(events) do
    local clip = clip_of(scene, e)
    if not (clip and looked[clip]) then list[#list + 1] = e end
  end
  return list
end

--- Keeps the mark of a note about these events: asking the clip counts as a look if they are all of one clip.
function outs.keep(scene, events, mark)
  local clip = clip_of(scene, events[1])
  for _, e in ipairs(events) do
    if not clip or clip_of(scene, e) ~= clip then return end
  end
  marks[clip] = marks[clip] or {}
  table.insert(marks[clip], mark)
end

return outs
