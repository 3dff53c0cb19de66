-- SPDX-License-Identifier: GPL-3.0-or-later
--- Puts the scene back into the state in which a run ended, if other computations have followed: the finest
-- run may ask for a comparison on finer edges, and stay after it; a computation made to choose may be the
-- script's run, so that it need not be computed again.
--
-- A snapshot with all frames does that. It cannot undo what the functions of the script's processes have done
-- since; a scene with processes is computed again.
-- @module softworld.model.ended
local build = require "softworld.scene.build"
local coarsest = require "softworld.run.coarsest"
local core = require "softworld.core"
local kept = require "softworld.run.kept"

local ended = {}

-- Keeps the state of the scene, in which the run of this entry has just ended.
local function keep(context, entry)
  entry.summary = kept.take(context.scene)
  entry.snapshot = context.scene:snapshot()
  core.whole_snapshot(entry.snapshot)
end

-- Puts the scene back into the state of an entry.
local function put(context, entry)
  build.back(context.scene, entry.snapshot, true)
  build.data(context.scene).restores = entry.run.restores -- the run's records are those of the scene again
  kept.put(context.scene, entry.summary)
end

-- Frees the snapshot of an entry, if it has one.
local function free(entry)
  if entry.snapshot then entry.snapshot:close() end
  entry.snapshot = nil
end

--- Called when the finest run has ended, before it is checked.
function ended.begin(context, run)
  ended.close(context)
  context.ended = not run.refused and { run = run } or nil
end

--- Called before another computation: keeps the state if it may be needed. That of a computation made to
-- choose (context.last) may, from the first level on that may be a run's last one.
function ended.leave(context)
  local run, last = context.ended, context.last
  local plain = not context.job.scripted
  if run and not run.left then
    run.left = true
    if plain then keep(context, run) end
  elseif last and plain and last.k >= coarsest.LEAST and not context.job.shape then
    keep(context, last)
    context.finals[last.key] = last
  end
  context.last = nil
end

--- Puts the scene back into the run's final state. False if the run must be computed again.
function ended.back(context)
  local run = context.ended
  if not run or not run.left then return true end
  if not run.snapshot then return false end
  put(context, run)
  return true
end

--- Puts the scene back into the state in which the computation with this key ended, and returns it; nil if
-- that is not known.
function ended.resume(context, key)
  local entry = context.finals[key]
  if not entry then return nil end
  put(context, entry)
  return entry
end

--- Forgets the computations made to choose: their keys will mean others.
function ended.forget(context)
  for _, entry in pairs(context.finals) do free(entry) end
  context.finals = {}
end

--- Frees what was kept of the finest run.
function ended.close(context)
  if context.ended then free(context.ended) end
  context.ended = nil
end

return ended
