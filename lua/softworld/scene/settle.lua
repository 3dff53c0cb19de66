-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:settle with error bars.
-- @module softworld.scene.settle
local core = require "softworld.core"
local build = require "softworld.scene.build"
local inherited = require "softworld.inherited"
local kept = require "softworld.run.kept"
local rest = require "softworld.scene.rest"
local counted = require "softworld.output.number".count
local process = require "softworld.run.process"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"

local core_settle = core.class.scene.settle

-- Returns the core's result and the events that are new.
local function settle(scene, args)
  build.check(scene, "scene:settle", 4)
  local before, data = rest.events(scene), build.data(scene)
  unread.used(data)
  kept.begin(scene)
  data.runs = (data.runs or 0) + 1 -- peaks start again, as in a run
  local result = build.call(3, core_settle, scene, args)
  return result, rest.fresh(scene, before)
end

local function with_bars(scene, given)
  local args = inherited.copy(given)
  local job = trust.job(scene, "scene:settle", args)
  local shown = args.progress
  if shown ~= nil and type(shown) ~= "boolean" then
    error("scene:settle: progress must be true or false, got " .. type(shown), 0)
  end
  args.progress = nil
  for _, q in ipairs(job.quantities) do
    if q.at then
      error(("scene:settle: tolerance: quantity '%s': at is a time of a run, and settling has none; leave it "
        .. "out"):format(q.name), 0)
    end
  end
  job.advice = "hold wires that can move freely, use smaller moves, or give a larger max_iterations"
  core.check_settle(args)
  local iterations, events = 0, {}
  local result = trust.once(job, function(_, level)
    local r
    r, events = settle(scene, args)
    if shown then
      io.stderr:write(("%s, %s: %s, %s\n"):format(scene.name, level, r.reason,
        counted(r.iterations, "iteration")))
    end
    iterations = iterations + r.iterations
    r.start = scene.time
    return r
  end)
  job.begin_processes() -- settling did not start any of them
  result.iterations = iterations
  return result, events
end

--- Static equilibrium: { tolerance = [m], max_iterations = }. Jaws of grippers that hold with a
-- force keep that force; others keep their opening. With a table of quantities as tolerance
-- the result has error bars, see help "tolerance"; progress = true then prints every level.
function core.class.scene.settle(scene, args)
  process.guard "scene:settle"
  local result, events
  if trust.wanted(args) then
    build.check(scene, "scene:settle", 3)
    result, events = build.call(3, with_bars, scene, args)
  else
    result, events = settle(scene, args)
  end
  return rest.new(scene, result, events)
end

return settle
