-- SPDX-License-Identifier: GPL-3.0-or-later
--- Decides where a study is computed: in processes of this machine, or in tasks of a cluster.
-- @module softworld.study.where
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local cluster = require "softworld.study.cluster"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local slurm = require "softworld.study.slurm"

local where = {}

local KNOWN = checks.set "here slurm"

local run = rows.call("study:run", "{...}", "sets where and how the next evaluations are computed", {
  gives = "the study",
  example = 'study:run { on = "slurm", tasks = 40, options = { partition = "short" } }',
  { "on", "choice", "-", "in processes of this machine, or as tasks of a cluster",
    choices = { "here", "slurm" }, usual = "SOFTWORLD_ON of the environment, else here" },
  { "tasks", "integer", "-", "number of tasks on the cluster, for all evaluations of a method", min = 1,
    max = 10000000,
    usual = "such that each computes for seconds" },
  { "seconds", "number", "s", "computing time of a task", min = 0, above = true, default = 30 },
  { "options", "table", "-", "of sbatch: { partition = 'short', time = '1:00:00', cpus_per_task = 4 }" },
  { "detach", "boolean", "-", "end the script after its tasks are sent; run it again to collect results",
    default = false },
})

rows.calls{
  { "study:cancel", "", "ends its tasks on the cluster, also those of other processes; results so far are "
    .. "kept",
    "how many there were" },
}

-- Returns the place that the environment asks for.
local function usual()
  local on = os.getenv "SOFTWORLD_ON"
  if on == nil or on == "" then return "here" end
  checks.word("SOFTWORLD_ON", on, KNOWN, 0)
  return on
end

--- Sets the place of a new study that does not give one.
function where.of_study(own) own.on = own.on or usual() end

local function do_run(self, args)
  local own, o = sealed.fields(self), run:read(args == nil and {} or args)
  slurm.options("study:run", o.options)
  own.on, own.tasks, own.seconds = o.on or usual(), math.tointeger(o.tasks), o.seconds
  own.options, own.detach = o.options, o.detach
  return self
end

local function do_cancel(self) return cluster.cancel(sealed.fields(self)) end

--- study:run { on =, tasks =, options = }: see help "cluster".
function where.run(self, args) return build.call(3, do_run, self, args) end

--- study:cancel().
function where.cancel(self) return build.call(3, do_cancel, self) end

return where
