-- SPDX-License-Identifier: GPL-3.0-or-later
--- Slips, losses and crashes of grippers: logs events and reacts to them.
-- @module softworld.grip.reactions
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local grasped = require "softworld.grip.grasped"
local mixed = require "softworld.grip.mixed"
local rolled = require "softworld.link.rolled"
local sealed = require "softworld.sealed"
local stand = require "softworld.grip.stand"
local unread = require "softworld.unread"
local untwisted = require "softworld.grip.untwisted"
local vec = require "softworld.vec"

local reactions = {}

local looked = setmetatable({}, { __mode = "k" }) -- grippers whose slips the script asked for
local marks = setmetatable({}, { __mode = "k" })  -- by gripper: mark of the note about its slips

reactions.looks = checks.set "events slip_event state peak_margin" -- what a script reads to see slips

--- The script reads one of these.
function reactions.seen(gripper)
  looked[gripper] = true
  if marks[gripper] then unread.seen(marks[gripper]) end
end

reactions.words = { "record", "warn", "stop" }
reactions.on_slip_row = { "on_slip", "reaction", "-",
  "reaction when the wire slips or is lost: one of these, or a function(gripper, event)",
    choices = reactions.words,
  usual = "as before" }

function reactions.check(what, value, level)
  local known = checks.set(table.concat(reactions.words, " "))
  if type(value) ~= "function" then checks.word(what, value, known, level + 1) end
end

--- Sets the reaction to a slipping or lost wire: "record" (default), "warn", "stop" or a function, called
-- with the gripper and the event.
function reactions.set_on_slip(self, value, level)
  reactions.check("gripper '" .. self.name .. "': on_slip", value, level + 1)
  self.on_slip = value
  reactions.watch(self)
end

--- Starts to measure slip.
function reactions.watch(self)
  self.slip_event = nil
  if self.tool then
    self.tool:watch(self.slip_tolerance, self.on_slip ~= nil and self.on_slip ~= "record")
  end
end

local function slip_text(self, event)
  return ("gripper '%s': the wire slips, %.3g mm by t = %.4g s at s = %.4g m; it turned by %.3g rad"):format(
    self.name, 1e3 * event.distance, event.time, event.s, event.turned)
end

local function crash_text(self, event)
  return ("gripper '%s': '%s' runs into '%s' at t = %.4g s"):format(self.name, event.part,
    event.obstacle, event.time)
end

local function lost_text(self, event)
  if event.wire then
    return ("gripper '%s': wire '%s' is lost from between the pads at t = %.4g s; they hold the others")
      :format(self.name, event.wire, event.time)
  end
  return ("gripper '%s': nothing is left between the pads at t = %.4g s"):format(self.name, event.time)
end

local function missed_text(self, event)
  return ("gripper '%s' closed on nothing at t = %.4g s"):format(self.name, event.time)
end

local texts = { slip = slip_text, lost = lost_text, missed = missed_text }

--- Stores a note for each gripper from which the wire slipped or was lost since a time, or that closed on
-- nothing, unless something reacts to it or the script asks for it. what: the run in words. Returns their
-- marks; mark.lost: the note is about a lost wire, which run.events shows too.
function reactions.tell(scene, since, what)
  local list = {}
  for _, self in ipairs(build.data(scene).grippers) do
    local own = sealed.fields(self)
    local quiet = own.on_slip == nil or own.on_slip == "record"
    local said, lost
    for _, e in ipairs(quiet and not looked[self] and own.events or {}) do
      local text = (e.kind ~= "missed" or e.alone) and texts[e.kind] -- else an error told it
      if text and e.time >= since then said, lost = text(self, e), e.kind == "lost" end
    end
    if said then
      marks[self] = unread.note(("softworld: note: %s is ok, but %s; see .events of the gripper"):format(what,
        said), said)
      marks[self].lost = lost
      list[#list + 1] = marks[self]
    end
  end
  return list
end

--- Returns the events without those of lost wires: reactions.tell has notes about them.
function reactions.others(events)
  local list = {}
  for _, e in ipairs(events) do
    if e.kind ~= "lost" then list[#list + 1] = e end
  end
  return list
end

-- Logs the event and reacts to it; returns a text if the run has to stop.
local function react(self, event, reaction, text)
  self.events[#self.events + 1] = event
  if reaction == "warn" then io.stderr:write("softworld: ", text(self, event), "\n")
  elseif reaction == "stop" then return text(self, event)
  elseif type(reaction) == "function" then reaction(self, event) end
end

-- The same for a lost wire, which the run's list shows too.
local function react_to_loss(self, event)
  self.scene:tell{ kind = "lost", object = self.name, s = event.s, time = event.time,
    text = lost_text(self, event) }
  return react(self, event, self.on_slip, lost_text)
end

-- Looks for a crash of an imposed grip: it drives the wire itself into an obstacle.
local function look_at_hold(self)
  local crash = self.hold:crash()
  if not crash or crash.time == self.crash_time then return end
  self.crash_time = crash.time
  return react(self, { kind = "crash", time = crash.time, part = self.name, obstacle = crash.obstacle,
    depth = crash.depth, s = self.s }, self.on_crash, crash_text)
end

-- Tells of each of several wires that is no longer between the pads; the gripper goes on with the others.
local function look_at_list(self)
  local why
  for _, wire in ipairs(grasped.strays(self)) do
    local left = {}
    for _, grip in ipairs(self.grips) do
      if grip.wire ~= wire then left[#left + 1] = grip end
    end
    self.grips, self.wire = left, left[1].wire
    local astray = { [wire.name] = true } -- scripts may go on to ask for the force on it
    for name in pairs(self.astray or {}) do astray[name] = true end
    self.astray = astray
    local s = stand.nearest_place(wire, (self.tool:pose()))
    local event = { kind = "lost", time = self.scene.time, s = s, wire = wire.name }
    why = react_to_loss(self, event) or why
  end
  return why
end

-- Looks for events of one gripper with pads; returns why the run has to stop, or nil.
local function look_at(self)
  local now, why = self.tool:state(), nil
  if now.crash_time and now.crash_time ~= self.crash_time then
    self.crash_time = now.crash_time
    why = react(self, { kind = "crash", time = now.crash_time, part = now.crash_part,
      obstacle = now.crash_obstacle, depth = now.crash_depth }, self.on_crash, crash_text)
  end
  if self.held and now.slip_time and not self.slip_event then
    self.slip_event = { kind = "slip", time = now.slip_time, s = now.slip_place, distance = now.slip,
      turned = vec.norm(now.turned) }
    why = react(self, self.slip_event, self.on_slip, slip_text) or why
  end
  if self.unchecked and self.held and now.squeeze > 0 and now.jaws ~= "moves" then
    self.unchecked = nil
    grasped.check(self) -- outside a process: logs an event, and the run goes on
  end
  if self.unlooked and now.jaws ~= "moves" then -- outside a process nothing waits for the jaws
    self.unlooked = nil
    if now.jaws == "empty" then
      self.events[#self.events + 1] = { kind = "missed", time = self.scene.time, alone = true }
    end
  end
  if self.held and now.normal == 0 and not now.frozen then
    self.held = false
    local event = { kind = "lost", time = now.lost_time or self.scene.time, s = now.place }
    why = react_to_loss(self, event) or why
  elseif self.held and #self.grips > 1 then
    why = look_at_list(self) or why
  end
  if self.frozen and now.lost_time then mixed.lose(self, now) end
  if self.held then untwisted.look(self) end
  return why
end

--- Looks for events of the scene's grippers after steps of a run. Returns why the run has to stop, or nil.
function reactions.look(scene)
  local why
  for _, self in ipairs(build.data(scene).grippers) do
    if self.tool and not self.left then why = look_at(self) or why
    elseif self.hold then why = look_at_hold(self) or why end
  end
  rolled.look(scene)
  return why
end

return reactions
