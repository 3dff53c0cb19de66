-- SPDX-License-Identifier: GPL-3.0-or-later
--- Puts the scene back into the state in which its run ended, if other computations have followed: the finest
-- run may ask for a comparison on finer edges, and stay after it.
--
-- A snapshot with all frames does that. It cannot undo what the functions of the script's processes have done
-- since; a scene with processes is computed again.
-- @module softworld.model.ended
local build = require "softworld.scene.build"
local core = require "softworld.core"
local kept = require "softworld.run.kept"

local ended = {}

--- Called when the finest run has ended, before it is checked.
function ended.begin(context, run)
  ended.close(context)
  context.ended = not run.refused and { run = run } or nil
end

--- Called before another computation: keeps the state.
function ended.leave(context)
  local last = context.ended
  if not last or last.left then return end
  last.left = true
  if context.job.scripted then return end
  last.summary = kept.take(context.scene)
  last.snapshot = context.scene:snapshot()
  core.whole_snapshot(last.snapshot)
end

--- Puts the scene back into the run's final state. False if the run must be computed again.
function ended.back(context)
  local last = context.ended
  if not last or not last.left then return true end
  if not last.snapshot then return false end
  build.back(context.scene, last.snapshot, true)
  build.data(context.scene).restores = last.run.restores -- the run's records are those of the scene again
  kept.put(context.scene, last.summary)
  return true
end

--- Frees what was kept.
function ended.close(context)
  local last = context.ended
  if last and last.snapshot then last.snapshot:close() end
  context.ended = nil
end

return ended
