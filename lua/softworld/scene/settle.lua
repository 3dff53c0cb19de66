-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:settle with error bars.
-- @module softworld.scene.settle
local checks = require "softworld.checks"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local inherited = require "softworld.inherited"
local kept = require "softworld.run.kept"
local rest = require "softworld.scene.rest"
local counted = require "softworld.output.number".count
local process = require "softworld.run.process"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"
local working = require "softworld.run.working"

local core_settle = core.class.scene.settle

-- Returns the core's result and the events that are new. wanted: the script's progress; level: name of the
-- level, if there are several.
local function settle(scene, args, wanted, level)
  build.check(scene, "scene:settle", 4)
  local before, data = rest.events(scene), build.data(scene)
  unread.used(data)
  kept.begin(scene)
  data.runs = (data.runs or 0) + 1 -- peaks start again, as in a run
  if data.running and scene.time > data.began then data.settled = scene.time end -- the run has lost peaks
  local line <close> = working.settles(wanted, scene, level)
  local result = build.call(3, core_settle, scene, args, line.show)
  if wanted then
    line.clear()
    io.stderr:write(("%s: %s, %s\n"):format(line.name, result.reason,
      counted(result.iterations, "iteration")))
  end
  return result, rest.fresh(scene, before)
end

-- Returns the arguments without progress, and progress, checked.
local function without_progress(given)
  local args = inherited.copy(given)
  local wanted = args.progress
  if wanted ~= nil and type(wanted) ~= "boolean" then
    error("scene:settle: progress must be true or false, got " .. checks.got(wanted), 0)
  end
  args.progress = nil
  return args, wanted
end

local function with_bars(scene, given)
  local args, wanted = without_progress(given)
  local job = trust.job(scene, "scene:settle", args)
  for _, q in ipairs(job.quantities) do
    if q.at then
      error(("scene:settle: tolerance: quantity '%s': at is a time of a run, and settling has none; leave it "
        .. "out"):format(q.name), 0)
    end
  end
  job.advice = "hold wires that can move freely, use smaller moves, or give a larger max_iterations"
  core.check_settle(args)
  local iterations, events = 0, {}
  local _ <close> = working.several(wanted)
  local result = trust.once(job, function(_, level)
    local r
    r, events = settle(scene, args, wanted, level)
    iterations = iterations + r.iterations
    r.start = scene.time
    return r
  end)
  job.begin_processes() -- settling did not start any of them
  result.iterations = iterations
  return result, events
end

--- Static equilibrium: { tolerance = [m], max_iterations =, progress = }. Jaws of grippers that hold with a
-- force keep that force; others keep their opening. With a table of quantities as tolerance
-- the result has error bars, see help "tolerance". On a terminal a line shows how long it takes, after a
-- second; progress = true writes lines elsewhere too, and one about each level; false: none.
function core.class.scene.settle(scene, args)
  process.guard "scene:settle"
  local result, events
  if trust.wanted(args) then
    build.check(scene, "scene:settle", 3)
    result, events = build.call(3, with_bars, scene, args)
  elseif type(args) == "table" and not core.type(args) then
    local plain, wanted = build.call(3, without_progress, args)
    result, events = settle(scene, plain, wanted)
  else
    result, events = settle(scene, args)
  end
  return rest.new(scene, result, events)
end

return settle
