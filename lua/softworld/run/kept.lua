-- SPDX-License-Identifier: GPL-3.0-or-later
--- Keeps the summary of a run when the scene goes on. The next run or settle starts new peaks, so the summary
-- is stored before that if the script still has the run.
-- @module softworld.run.kept
local build = require "softworld.scene.build"
local sealed = require "softworld.sealed"

local kept = {}

local weak = { __mode = "v" }
local last = setmetatable({}, { __mode = "k" }) -- scene -> its last run, and the function for its summary

local ever = setmetatable({}, { __mode = "k" }) -- scenes of which a run has ended

--- Called when a run has ended; summary(run) gives its rows as long as the scene stays as it is.
function kept.ended(scene, run, summary)
  ever[scene] = true
  last[scene] = { run = setmetatable({ run }, weak), summary = summary }
end

--- Called before the scene goes on: stores the summary.
function kept.begin(scene)
  local before = last[scene]
  local run = before and before.run[1]
  last[scene] = nil
  if not run then return end
  local own = sealed.fields(run)
  if own.ok and own.restores == build.data(scene).restores then
    own.summary_rows = build.call(4, before.summary, run) -- refused if the scene has diverged since
  end
end

--- Called when nobody will read the summary of the last run as long as the scene is in other states. Returns
-- what kept.put takes when it is back in this one.
function kept.take(scene)
  local before = last[scene]
  last[scene] = nil
  return before
end

function kept.put(scene, before) last[scene] = before end

--- True if a run of the scene has ended, also if the scene was restored since.
function kept.ran(scene) return ever[scene] == true end

--- Returns the stored rows, or nil.
function kept.rows(run) return sealed.fields(run).summary_rows end

return kept
