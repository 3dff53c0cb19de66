-- SPDX-License-Identifier: GPL-3.0-or-later
--- Events of the library between two runs: the next run has them, for it begins with an empty list. One is
-- that restoring a snapshot ended a process that had not begun.
-- @module softworld.run.told
local core = require "softworld.core"
local build = require "softworld.scene.build"
local place = require "softworld.place"
local remarks = require "softworld.remarks"

local told = {}

local tell = core.class.scene.tell

--- scene:tell{ kind =, object =, s =, value =, time =, text = }: adds an event to the run under way.
function core.class.scene.tell(scene, event)
  build.call(3, tell, scene, event)
  local caller = debug.getinfo(2, "S")
  if not build.data(scene).running and caller and not place.is_ours(caller.source) then
    remarks.untold()
  end
end

--- Adds an event of the library to the run under way, else to the next one.
function told.tell(scene, event)
  tell(scene, event)
  local data = build.data(scene)
  if data.running then return end
  data.told = data.told or {}
  table.insert(data.told, event)
end

local restore = core.class.scene.restore

--- scene:restore(snapshot). own: the library calls it, and makes the processes again.
function core.class.scene.restore(scene, snapshot, own)
  local unborn = {}
  for _, p in ipairs(not own and core.type(scene) == "scene" and core.data(scene).processes or {}) do
    if not p.begun then unborn[#unborn + 1] = p.number end
  end
  build.through(restore, scene, snapshot)
  for _, number in ipairs(unborn) do
    local who = ("process %d"):format(number)
    told.tell(scene, { kind = "ended", object = who,
      text = ("scene:restore ended %s, which had not begun; make it after scene:restore"):format(who) })
  end
end

--- Called when a run has begun: adds the events that were told before it.
function told.begin(scene)
  local data = build.data(scene)
  for _, event in ipairs(data.told or {}) do tell(scene, event) end
  data.told = nil
end

return told
