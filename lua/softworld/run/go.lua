-- SPDX-License-Identifier: GPL-3.0-or-later
--- Computes a run: advances the core between the turns of processes, with observers and the progress bar.
-- @module softworld.run.go
local core = require "softworld.core"
local advice = require "softworld.run.advice"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local document = require "softworld.run.document"
local holding = require "softworld.check.holding"
local kept = require "softworld.run.kept"
local ledger = require "softworld.run.ledger"
local observe = require "softworld.run.observe"
local process = require "softworld.run.process"
local turns = require "softworld.run.turns"
local reactions = require "softworld.grip.reactions"
local released = require "softworld.check.released"
local save = require "softworld.scene.save"
local rolled = require "softworld.link.rolled"
local settings = require "softworld.run.settings"
local tables = require "softworld.rows"
local told = require "softworld.run.told"
local waiting = require "softworld.run.waiting"
local working = require "softworld.run.working"

local go = {}
local chunk = 64 -- steps between two looks at progress; fixed, so that results never depend on it
local default_frame = 1 / 30 -- [s]

--- Fields of `frames`.
go.frames = tables.list{
  { "memory", "number", "B", "memory that all frames of the scene may take; when it is full, every second "
    .. "frame is dropped",
    min = 1e4, max = 1e12, default = 256e6 },
}

local function merge(total, part)
  for _, key in ipairs{ "steps", "rejected", "iterations", "evaluations", "jumps" } do
    total[key] = total[key] + part[key]
  end
  total.smallest_dt = math.min(total.smallest_dt, part.smallest_dt)
  total.ok, total.reason, total.time = part.ok, part.reason, part.time
  total.last_jump = part.last_jump or total.last_jump
end

local advance = core.class.scene.advance

-- Returns those of scene:run's arguments that the core takes.
local function options_of(args)
  local options = {}
  for k, v in pairs(args) do options[k] = v end
  options.progress, options.duration, options.save, options.resume, options.guard = nil, nil, nil, nil, nil
  options.frame = args.frames ~= false and (options.frame or default_frame) or nil
  options.frames = nil
  return options
end

-- Advances until the end of time or of the processes. Returns the reason of the end, and "stopped" or
-- "unfinished" if something was left undone.
local function drive(scene, args, total, bar)
  local start = total.start
  local stop = args.duration and start + args.duration or math.huge
  local options = options_of(args)
  local bounds = type(args.frames) == "table" and go.frames:read(args.frames, "scene:run: frames")
  core.keep_frames(scene, bounds and bounds.memory or nil)
  local left = (args.max_steps or math.huge) - total.steps
  if left <= 0 then -- a run that goes on from a file counts the steps before it
    return ("the allowed number of steps was used: max_steps = %d, and %d were made before the file was "
      .. "saved"):format(args.max_steps, total.steps), "stopped"
  end
  while true do
    if args.guard then args.guard:look(options, total) end
    local alive, wake, watching = turns.step(scene)
    if args.guard then args.guard:stepped(total) end
    if stop == math.huge and alive == 0 then return "all processes have ended" end
    if process.reached(scene, stop) then
      waiting.at_end(scene)
      return ("%g s have passed"):format(args.duration), alive > 0 and "unfinished" or nil
    end
    local target = math.min(stop, wake)
    if target == math.huge then
      waiting.look(scene, bar, args.progress == false)
      -- a process waits for a condition without an end: step by step
      target = scene.time + (args.dt or 0.01)
    end
    options.max_steps = math.min(left, watching and 1 or chunk)
    local part = build.call(6, advance, scene, options, target, observe.arguments(scene))
    merge(total, part)
    left = left - part.steps
    bar:update(scene.time - start, total.steps)
    if not part.ok then return part.reason end
    local asked = observe.settle(scene)
    local stopped = reactions.look(scene) or asked
    if stopped then return stopped, "stopped" end
    if left <= 0 then
      waiting.at_end(scene)
      return "the allowed number of steps was used", "stopped"
    end
  end
end

local function new_total(scene)
  return { steps = 0, rejected = 0, iterations = 0, evaluations = 0, jumps = 0, smallest_dt = math.huge,
    ok = true, reason = "", time = scene.time, start = scene.time, wall = 0, cpu = 0 }
end

-- Prepares everything for the first step.
local function begin(scene, args)
  local data = build.data(scene)
  local total, going = data.going or new_total(scene), data.going
  turns.check_steps(scene)
  kept.begin(scene)
  data.origin = data.origin or save.origin(scene)
  if not data.going then build.call(3, core.begin_run, scene, args.wear) end -- else the file's run goes on
  told.begin(scene)
  rolled.look(scene)
  data.going = nil
  local now = settings.of(args)
  if going then settings.tell(scene, total.settings, now, data.from_file) end
  total.settings = now
  observe.begin(scene, args, total.start)
  total.drawn = document.wires(scene)
  if not going then -- else the file has what was released, and when it settled
    released.begin(data, total.start)
    data.settled = nil
  end
  return data, total
end

-- Stores the frame of the end. The scene's Lua functions have been asked at this time before; what they raise
-- now is no fault of the run.
local function close_frames(scene)
  local fine, why = pcall(core.close_frames, scene)
  if not fine and checks.is_interrupt(why) then error(why, 0) end
end

-- Returns: 1. whether it ended without an error, 2. the reason or the error, 3. see drive.
local function drive_shown(scene, args, total, level, hindrance)
  local bar <close> = working.bar(args, scene, level)
  if bar.passing then bar:update(0, total.steps) end -- its first steps may take long
  local data = build.data(scene)
  local fine, reason, cut
  data.running, data.slow = true, args.quasistatic
  if hindrance then
    fine, reason, total.ok = true, ("at t = %.6g s: %s"):format(scene.time, hindrance), false
  else -- protected: a coroutine that dies by an error leaves its variables unclosed
    fine, reason, cut = pcall(drive, scene, args, total, bar)
  end
  data.running, data.slow, data.saving = nil, nil, nil
  if fine and total.ok then bar:finish() elseif fine then bar:fail(reason) end
  observe.finish(scene, fine and total.ok, reason)
  if fine and total.ok and args.frames ~= false then close_frames(scene) end
  return fine, reason, cut
end

-- Returns the wires that exist, and how often each was remodelled: a check reads them as they are later.
local function present(data)
  local found = {}
  for _, w in ipairs(data.wires) do found[w.object] = build.remodels(w.object) end
  return found
end

local begun = 0

--- Returns the number of runs that have begun to compute.
function go.begun() return begun end

--- Computes one run and returns its fields. level: its name if it is one of several; hindrance: why it cannot
-- begin.
function go.once(scene, args, level, hindrance)
  local data, total = begin(scene, args)
  begun = begun + 1
  local wall, cpu = core.clock() - total.wall, os.clock() - total.cpu
  local function note_time() total.wall, total.cpu = core.clock() - wall, os.clock() - cpu end
  data.saving = args.save and function()
    note_time()
    save.write(scene, args.save, total)
  end
  local fine, reason, cut = drive_shown(scene, args, total, level, hindrance)
  if not fine then error(reason, 0) end
  note_time()
  total.reason, total.scene, total.name = reason, scene, scene.name
  ledger.close(total)
  if not total.ok and not level then total.reason = advice.added(total.reason, args, scene) end
  total.restores, total.cut, total.settled = data.restores, cut, data.settled
  data.runs = (data.runs or 0) + 1
  total.number, total.present, total.holding = data.runs, present(data), holding.now(scene)
  return total
end

return go
