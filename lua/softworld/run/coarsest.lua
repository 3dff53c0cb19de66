-- SPDX-License-Identifier: GPL-3.0-or-later
--- Leaves out the coarsest levels of a job that computes error bars.
-- @module softworld.run.coarsest
local build = require "softworld.scene.build"
local narrow = require "softworld.link.narrow"
local sealed = require "softworld.sealed"

local coarsest = {}

coarsest.LEAST = 3 -- levels that show how fast the quantities converge

--- Leaves out the coarsest level of a job and counts it in job.skipped; the finest stays, unless too few are
-- left. False if the script's own edges are the coarsest already.
function coarsest.finer(job)
  if job.share >= 1 then return false end
  job.skipped = job.skipped + 1
  for i, n in ipairs(job.first) do job.first[i] = 2 * n end
  job.share, job.most = 2 * job.share, math.max(coarsest.LEAST, job.most - 1)
  return true
end

--- Leaves out the n coarsest levels of a job. The finest stays; nil if too few would be left. Returns a
-- function that takes them in again.
function coarsest.skip(job, n)
  if job.most - n < coarsest.LEAST then return nil end
  local first, share, most, skipped = job.first, job.share, job.most, job.skipped
  job.first = {}
  for i, count in ipairs(first) do job.first[i] = count << n end
  job.share, job.most, job.skipped = share * 2 ^ n, most - n, skipped + n
  return function() job.first, job.share, job.most, job.skipped = first, share, most, skipped end
end

--- Leaves out the coarsest levels on which a wire's edges are too long for the corners of a channel.
function coarsest.pass(job)
  for i, w in ipairs(build.data(job.scene).wires) do
    local longest = narrow.edge(job.scene, w.object.radius)
    while w.object.length / job.first[i] > longest and coarsest.finer(job) do end
  end
end

local JAMS = { breaking = true, crash = true } -- events of wires that are jammed

--- True if a wire is jammed or torn in a run: its events say so.
function coarsest.is_jammed(result)
  for _, event in ipairs(sealed.fields(result).events or {}) do
    if JAMS[event.kind] then return true end
  end
  return false
end

return coarsest
