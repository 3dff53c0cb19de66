-- SPDX-License-Identifier: GPL-3.0-or-later
--- Watches a run while it is computed and checks whether the facts behind the free checks still hold. If not,
-- the run goes back to a snapshot before that moment and continues with the next rung of the choice.
--
-- A snapshot restores the scene, but no Lua function that has run since. Therefore a new snapshot is taken
-- when a process has gone on. If going back is impossible, or the rung cannot be changed during a run, the
-- run ends and is computed again from its start.
-- @module softworld.model.guard
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local process = require "softworld.run.process"

local guard = {}
guard.__index = guard

local LOOKS = 20 -- looks at a run of known duration, at most [-]
local FRAMES = 4 -- least new frames between two looks [-]
local BEFORE = 2 -- frames before a look that the next look sees again [-]

-- The error a guard raises to end a run: { state =, time = [s] }.
local Broken = { __name = "model given up" }

--- Returns the error if a guard raised it, else nil.
function guard.found(raised) return getmetatable(raised) == Broken and raised or nil end

--- Returns a guard for a run; share: the smallest tolerance over its value, times the slack of the checks.
-- nil: no choice relies on a check that can be looked at during the run.
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

-- Takes a snapshot to go back to, if a choice can continue from one.
local function keep(self, total)
  if self.snapshot then self.snapshot:close() end
  self.snapshot = self.switches and self.scene:snapshot() or nil
  self.mark = process.mark(self.scene)
  self.jumps, self.time = total.jumps, self.scene.time
end

--- Called after each step. Takes a new snapshot if a process has gone on, at most once per frame.
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

--- Called when the run is over or given up.
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

-- Returns the number of the first choice whose check does not hold, and why.
local function broken(self, total)
  local run = { start = self.start, time = self.scene.time, jumps = total.jumps - self.jumps,
    last_jump = total.last_jump, steps = total.steps, events = {} }
  for i, state in ipairs(self.open) do
    local f = state.choice.look(self.context, run)
    local why = state.choice.broken(f, self.share, state.rung)
    if why then return i, why end
  end
end

-- Goes back to the snapshot; processes are still in the state of that moment.
local function back(self, total)
  self.seen = nil
  build.back(self.scene, self.snapshot, true)
  total.jumps = self.jumps
  if total.jumps == 0 then total.last_jump = nil end
end

-- Continues with the next rung from the snapshot. Returns why that is not possible, or nil.
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
  local time, as, next_as = self.scene.time, rungs[state.rung].as, rungs[state.rung + 1].as
  local whole = time <= self.start -- nothing of the run is left
  local where = whole and ("%s given up: the run went back to its start, because by"):format(as)
    or ("%s until %s, where the run went back to a snapshot, because by"):format(as, number.text(time, "s"))
  state.went_on = { time = time, whole = whole, text = ("%s %s %s; %s from there"):format(where,
    number.text(moment, "s"), why, next_as) }
  self.from = self.scene.time
end

-- Returns the time of frame i, or of the first frame if i is below 1 [s].
local function time_of(scene, i)
  local frame = scene:frame(math.max(1, i))
  return frame and frame.t or scene.time
end

--- Called between two steps: looks at the run and goes back if needed. options: of the run; the next rung may
-- change them.
function guard:look(options, total)
  if not is_due(self, total) then return end
  self.seen = self.seen or {} -- what earlier looks found; a long record is not read again
  self.context.watching, self.context.seen = true, self.seen
  local i, why = facts.reading(self.scene, self.from, broken, self, total)
  self.context.watching, self.context.seen = nil, nil
  if i then switch(self, i, why, options, total) end
  self.frames = self.scene:frame_count()
  if not i then self.from = math.max(self.from, time_of(self.scene, self.frames - BEFORE)) end
  keep(self, total)
end

return guard
