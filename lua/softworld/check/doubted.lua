-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows whose value an event of the run doubts: such a row does not pass, because the true value may be
-- worse.
-- @module softworld.check.doubted
local checks = require "softworld.checks"

local doubted = {}

-- What is wrong after an event of this kind, as the row says it.
--   own: only rows of the wire that the event names are in doubt, and those of grippers and ties, which may
--     hold it
--   places: places are in doubt too, not only peaks
--   named: the event names the wires in its text
--   all: every row is in doubt
--   always: an error bar says nothing of it. Other doubts end with a bar, which comes from other steps
--   members: only rows of these names are in doubt
--   only, unless: pattern of the event's text that such an event has, or has not
local kinds = {
  coarse = { "a step was too long for peaks" },
  threshold = { "an end is near the limit of friction: small differences decide its peaks", own = true,
    places = true },
  edges = { "an end that was struck buckles in waves too short for its edges", own = true,
    only = "buckles in half waves" },
  rebound = { "an end strikes again: small differences decide its peaks", own = true, places = true },
  jam = { "friction of a slider locks: small differences decide forces and places", places = true },
  energy = { "steps made energy: take smaller steps", only = "^steps made .* from nowhere" },
  ["energy at once"] = { "forces jumped in steps that made energy at any size: take another dt",
    places = true, only = "accepted although" },
  ["energy unknown"] = { "much energy comes from nowhere: forces may be off as much" },
  buckling = { "a straight or plane wire should have buckled", own = true, places = true, always = true },
  integrator = { "the integrator gains energy in contact: take tr-bdf2", always = true },
  crash = { "forces are wrong after a crash", always = true },
  pressed = { "a hold presses a wire into something: depth or edges decide the force" },
  ["pressed in each other"] = { "wires are in each other where they press: tensions are too small",
    own = true, named = true, always = true, only = "mm in each other where they press" },
  unkept = { "pads press with another force than the wanted one", places = true, always = true },
  unsettled = { "wires moved where no equilibrium was found: inertia is in peaks", places = true,
    always = true },
  caught = { "pads hold a mesh by more than their friction: forces are too large", always = true },
  overload = { "a hold overloads a wire: forces are wrong", always = true },
  breaking = { "the wire would have broken; the run went on as if it held", always = true },
  walls = { "walls of a mesh meet, which its springs do not feel", own = true, always = true },
  kink = { "walls in a fold do not touch each other: forces are too low", own = true, always = true },
  clip = { "the clip's model does not cover this", always = true, unless = "OVERLOADED" },
  joint = { "a joint passes no twist, which one wire would resist: bends, places and forces may be off",
    own = true, named = true, places = true, always = true },
  couple = { "a wire lies nearly along the axis of a couple, where its action is undefined", own = true,
    named = true, places = true, always = true },
  together = { "friction brakes wires that go round each other: tensions and moments may be wrong",
    own = true, named = true, always = true },
  untwisted = { "pads do not twist a rod: its torsion and moments about its axis are missing", own = true,
    named = true, always = true, members = checks.set "max_torsion peak_moment peak_margin" },
  spun = { "friction does not resist a turn of a rod about its axis: torsion and moments about it may be off",
    own = true, named = true, always = true, members = checks.set "max_torsion peak_moment peak_margin" },
  ["untwisted rolled"] = { "a wire has rolled in pads, which friction would keep from it", own = true,
    named = true, places = true, always = true, only = "has rolled in the pads" },
  passed = { "a wire slipped over a grip that has no body: real fingers would stop it", own = true,
    places = true, always = true },
  through = { "wires passed through each other, which contact would prevent: scene:wire_contact{}",
    own = true, named = true, places = true, always = true },
  undamped = { "damping of solid elements is missing", own = true, always = true },
  pierced = { "something is inside an element of an object, whose faces do not touch", own = true,
    named = true, places = true, always = true },
  unbalanced = { "forces after a change of model may be too large", own = true, always = true },
  grasp = { "a gripper held another wire than the one to grasp", places = true, always = true },
  ["grasp far"] = { "a gripper took a wire far from its centre, as no real one can", places = true,
    always = true, only = " from its centre: " },
  late = { "a process went on after the force or touch that it waited for: peaks depend on dt" },
  held = { "a feed without its force at rest was let go", always = true },
  hand = { "something was moved by hand: this is not the script's process", all = true, always = true },
}

local UNKNOWN = "come from nowhere" -- in events `energy` about a gap that no step made
-- Above this share of the energy in play all peaks are in doubt [-]. Below it, from 0.05 on, forces of
-- grippers get a range. With 0.2 a limit may pass that the force exceeds by a fifth; with 0.05 no row has a
-- range any more (spec/check/doubted_spec).
local MUCH = 0.1

local second = { energy = kinds["energy at once"], pressed = kinds["pressed in each other"],
  untwisted = kinds["untwisted rolled"], grasp = kinds["grasp far"] }

-- Returns what is wrong after an event. Events `energy` have three meanings, `pressed`, `untwisted` and
-- `grasp` two.
local function kind_of(e)
  local other = second[e.kind]
  if other and e.text:find(other.only) then return other end
  if e.kind == "energy" and e.text:find(UNKNOWN, 1, true) then
    return (e.value or 0) > MUCH and kinds["energy unknown"] or nil
  end
  return kinds[e.kind]
end

-- Members without `peaks` that depend on forces all the same.
local mean = checks.set "mean_force fatigue"

-- True if the event doubts the row of this object.
local function concerns(kind, e, member, entry)
  if kind.members and member ~= doubted.OWN and not kind.members[member.name] then return false end
  if kind.only and not e.text:find(kind.only) then return false end
  if kind.unless and e.text:find(kind.unless) then return false end
  local held = member.on == "gripper" or member.on == "tie" or member == doubted.OWN
  local named = kind.named and e.text:find(("'%s'"):format(entry.name), 1, true)
  return not kind.own or held or e.object == entry.name or named ~= nil
end

--- Stands for the checks of the script: what they read is unknown, so every event doubts them.
doubted.OWN = { peaks = true, places = true }

-- Poses do not compute the motion of a jump, and may jump earlier than the wire or to another side. Bars come
-- from poses too. A chosen model has compared them with the motion.
local function jumped(member, run)
  if not (run.jumps and run.jumps > 0) or run.model then return nil end
  if not (member.peaks or mean[member.name] or member.places) then return nil end
  return ("poses jumped %s: neither this motion nor its end is computed; run without quasistatic"):format(
    run.jumps == 1 and "once" or run.jumps .. " times")
end

--- Returns why the row of an object may not pass, or nil.
-- @tparam table member of softworld.check.registry; peaks: true if its value is a peak of the motion; places:
-- if it is a place
-- @tparam table value of the row
-- @tparam table entry { name =, object = }
-- @tparam table run
function doubted.why(member, value, entry, run)
  local peaks, leapt = member.peaks or mean[member.name], jumped(member, run)
  if leapt then return leapt end
  for _, e in ipairs(run.events) do
    local kind = kind_of(e)
    local met = kind and (kind.all or peaks or kind.places and member.places)
    local asked = met and (kind.always or not value.error)
    if asked and concerns(kind, e, member, entry) then
      local dt = e.text:match "with dt = ([%d.e-]+) s"
      return ("%s (event '%s')%s"):format(kind[1], e.kind, dt and (": dt = %s s, or tolerance, would tell")
        :format(dt) or "")
    end
  end
end

--- Widens the range of a gripper's forces where energy comes from nowhere: they are no more exact than its
-- share of the energy in play. A value with an error bar keeps it.
function doubted.widen(value, member, run)
  local force = member.on == "gripper" and (member.unit == "N" or member.unit == "N m")
  for _, e in ipairs(force and not value.error and run.events or {}) do
    if e.kind == "energy" and e.text:find(UNKNOWN, 1, true) then
      value.low, value.high = (value.low or value.value) * (1 - math.min(1, e.value)),
        (value.high or value.value) * (1 + e.value)
      value.note = ("%senergy from nowhere: may be off by %.2g %%"):format(
        value.note and value.note .. "; " or "", 100 * e.value)
    end
  end
  return value
end

return doubted
