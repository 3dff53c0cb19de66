-- SPDX-License-Identifier: GPL-3.0-or-later
--- Watching a run while it goes on: does what the free checks stand on still hold? Where it does not, the
-- run goes back to a snapshot from before that moment, and on from there with the next rung of the choice.
--
-- A snapshot brings back the scene, but no Lua function that has gone on since: it is taken anew when a
-- process has. Where there is no way back, or the rung cannot be changed on the way, the run ends there and
-- is computed again from its start.
-- @module softworld.model.guard
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local process = require "softworld.run.process"

local guard = {}
guard.__index = guard

local LOOKS = 20 -- at a run of known duration, one each [-]
local FRAMES = 4 -- new ones between two looks at least [-]
local BEFORE = 2 -- frames from before a look that it sees too [-]

-- What a guard raises to end a run: { state =, time = [s] }.
local Broken = { __name = "model given up" }

--- What a guard raised, or nil: it is another error.
function guard.found(raised) return getmetatable(raised) == Broken and raised or nil end

--- A guard of a run of a context; share: the tightest tolerance over its value, times the slack of the
-- checks. nil: no choice stands on a check that can be looked at on the way.
function guard.new(context, share)
  local open, switches = {}, false
  for _, state in ipairs(context.states) do
    state.went_on, state.no_way, state.broke = nil, nil, nil
    if state.by == "free" and state.rung < state.last then
      open[#open + 1], switches = state, switches or state.choice.onward ~= nil
    end
  end
  if #open == 0 then return nil end
  return setmetatable({ context = context, scene = context.scene, share = share, open = open,
    switches = switches }, guard)
end

-- Keep the state as it is, to go back to where a choice can.
local function keep(self, total)
  if self.snapshot then self.snapshot:close() end
  self.snapshot = self.switches and self.scene:snapshot() or nil
  self.mark = process.mark(self.scene)
  self.jumps, self.time = total.jumps, self.scene.time
end

--- Processes have gone on, or not. Of those that do at each step there is no state at each.
function guard:stepped(total)
  if #self.open == 0 then return end
  self.start = self.start or self.scene.time
  self.from, self.frames = self.from or self.start, self.frames or self.scene:frame_count()
  local count = self.scene:frame_count()
  if not self.mark then
    keep(self, total)
  elseif count > (self.moved or -1) and not process.is_at(self.scene, self.mark) then
    keep(self, total)
    self.moved = count
  end
end

--- The run is over, or given up.
function guard:close()
  if self.snapshot then self.snapshot:close() end
  self.snapshot = nil
end

local function is_due(self, total)
  if not self.mark or #self.open == 0 then return false end
  if total.jumps > self.jumps then return true end
  local lasts = self.context.args.duration
  local soon = lasts and self.scene.time < self.time + lasts / LOOKS
  return not soon and self.scene:frame_count() - self.frames >= FRAMES
end

-- The first choice whose check does not hold, and why.
local function broken(self, total)
  local run = { start = self.start, time = self.scene.time, jumps = total.jumps - self.jumps,
    steps = total.steps, events = {} }
  for i, state in ipairs(self.open) do
    local f = state.choice.look(self.context, run)
    local why = state.choice.broken(f, self.share, state.rung)
    if why then return i, why end
  end
end

-- Back to the snapshot, where processes are as they were.
local function back(self, total)
  build.back(self.scene, self.snapshot, true)
  total.jumps = self.jumps
  if total.jumps == 0 then total.last_jump = nil end
end

-- The next rung from the snapshot on; returns why that is not possible, or nil.
local function go_on(self, state, options, total)
  if not state.choice.onward then return ("a run cannot change its %s on the way"):format(
    state.choice.name) end
  if not process.is_at(self.scene, self.mark) then return "a process has gone on since the snapshot" end
  back(self, total)
  local fine, why = pcall(state.choice.onward, self.context, options)
  if fine then return nil end
  if checks.is_interrupt(why) then error(why, 0) end
  back(self, total)
  return build.plain(tostring(why))
end

local function switch(self, i, why, options, total)
  local state, moment = table.remove(self.open, i), self.scene.time
  local no_way = go_on(self, state, options, total)
  if no_way then
    state.no_way, state.broke = no_way, why
    error(setmetatable({ state = state, time = moment }, Broken), 0)
  end
  local rungs = state.choice.rungs
  state.went_on = { time = self.scene.time, text = ("%s until %s, where the run went back to a snapshot, "
    .. "because by %s %s; %s from there"):format(rungs[state.rung].as, number.text(self.scene.time, "s"),
    number.text(moment, "s"), why, rungs[state.rung + 1].as) }
  self.from = self.scene.time
end

-- Time of a frame, or of the first [s].
local function time_of(scene, i)
  local frame = scene:frame(math.max(1, i))
  return frame and frame.t or scene.time
end

--- Between two steps: look, and go back if need be. options: of the run, which the next rung may change.
function guard:look(options, total)
  if not is_due(self, total) then return end
  self.context.watching = true
  local i, why = facts.reading(self.scene, self.from, broken, self, total)
  self.context.watching = nil
  if i then switch(self, i, why, options, total) end
  self.frames = self.scene:frame_count()
  if not i then self.from = math.max(self.from, time_of(self.scene, self.frames - BEFORE)) end
  keep(self, total)
end

return guard
