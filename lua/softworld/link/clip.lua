-- SPDX-License-Identifier: GPL-3.0-or-later
--- Snap-in clips along the way of a wire, and how a gripper presses a wire into one.
--
--     local clip = scene:clip{ name = "c1", at = { 0.2, 0, 0.03 }, width = 0.008,
--       insertion = 12, retention = 40, friction = 0.3 }
--     scene:process(function(p)
--       gripper:grasp(wire, { s = 0.25 })
--       gripper:clip{ into = clip, max_force = 30 }
--       print(clip.inserted.time, clip.inserted.s, clip.inserted.peak_force)
--     end)
--
-- The force of the clip on the wire is the force `clip` of the core (help "clip").
-- @module softworld.link.clip
local core = require "softworld.core"
local build = require "softworld.scene.build"
local fixing = require "softworld.link.fixing"
local outs = require "softworld.link.outs"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local vec = require "softworld.vec"
local fixshape = require "softworld.link.fixshape"
local vector = require "softworld.vector"

local properties = {}
local Clip = fixing.class("clip", properties, { "on", "radius", "damper", "stiffness", "turned" })
local EMPTY, INSERTING, SEATED = 0, 1, 2 -- the core's states
local BROKEN = { "its floor", "a wall", "a wall from outside", [5] = "it within one step" }
local SNAP = 2e-3 -- default time of the snap damping [s]
local STRONGEST = 1e12 -- largest force [N]
local STEEPEST = 1e6 -- largest ratio of insertion and retention: flanks of no length have no slope
local THERE = 0.5 -- share of the clip's length that a wire must pass through to be in it

local read_field = Clip.__index

-- Reads a field, and keeps in mind that the script asked for what shows whether its wire came out.
function Clip.__index(self, key)
  if outs.looks[key] and not sealed.by_library() then outs.seen(self) end
  return read_field(self, key)
end

local new = rows.call("scene:clip", "{...}", "a snap-in clip that holds a wire", {
  gives = "a clip",
  example = "scene:clip { at = { 0.2, 0, 0.03 }, width = 0.008, insertion = 12, retention = 40 }",
  { "name", "text", "-", "name in messages", usual = "clip1, ..." },
  { "at", "vector", "m", "the wire's centre line in the seat", required = true },
  { "direction", "vector", "-", "from the seat to the mouth", default = { 0, 0, 1 } },
  { "axis", "vector", "-", "along the wire", default = { 1, 0, 0 } },
  { "width", "number", "m", "along the axis", min = 1e-6, max = 1000, required = true },
  { "insertion", "number", "N", "largest force of the lips on the way in", min = 0, above = true,
    required = true },
  { "retention", "number", "N", "largest force of the lips on the way out", min = 0, above = true,
    required = true },
  { "friction", "number", "-", "friction coefficient against sliding along the axis", min = 0, max = 100,
    default = 0 },
  { "radius", "number", "m", "of the seat", min = 0, above = true, max = 1000, usual = "that of each wire" },
  { "way", "number", "m", "travel of the wire over the lips", min = 1e-6,
    max = 1000, usual = "1.5 of the radius" },
  { "stiffness", "number", "N/m", "of floor and side walls", min = 0, above = true, max = 1e12,
    usual = "50 times the larger force over the radius" },
  { "strength", "number", "N", "force at which floor and walls break, also when pressed from outside",
    min = 0,
    above = true, max = 1e10, usual = "20 times the larger force" },
  { "snap", "number", "s", "time that the lips take to pull a wire in", min = 0, max = 1000,
    default = SNAP },
  { "on", "wire", "-", "wire of this clip", usual = "all of the scene" },
})

rows.calls{
  { "clip:seated", "wire", "whether a wire, or this one, is in the seat", "true or false" },
  { "clip:state", "wire", "state of this wire, or of all wires",
    "empty, inserting (under the lips), seated or broken" },
  { "clip:force", "wire", "force on this wire, with friction; without argument on all wires",
    "{x, y, z} [N]" },
  { "clip:ratio", "wire", "largest pull so far over retention; at 1 it came out", "-" },
  { "clip:run_ratio", "wire", "the same of the last run, for wires that are in it now", "-" },
  { "clip:tilt", "wire", "rise of the seated wire within the clip's width at its largest pull, over the "
    .. "length of the lips' inner flank; tilted, it comes out at less than the retention", "-" },
  { "clip:height", "wire", "height of the wire over the seat, and of the lips; nil when no wire passes",
    "m, m" },
  { "clip:release", "", "takes the clip away" },
  { "clip.name", nil, "name in messages" },
  { "clip:exists", "", "whether it is still in the scene", "true or false" },
  { "clip.wire", nil, "in the seat", "a wire, or nil" },
  { "clip.inserted", nil, "the last insertion", "nil, or time [s], s [m], peak_force [N], wire, count" },
  { "clip.pulled_out", nil, "the last time a wire came out",
    "nil, or time [s], peak_force [N], wire, count" },
  { "clip.overloaded", nil, "how it broke", "nil, or time [s], force [N], by, wire, strength [N]" },
  { "clip.peak_insertion_force", nil, "of the last insertion, or of that under way", "N" },
}

local function check_axes(what, args)
  args.direction, args.axis = vec.unit(args.direction), vec.unit(args.axis)
  if not args.direction or not args.axis then
    error(what .. ": direction and axis must not be zero vectors", 0)
  end
  local along = vec.dot(args.direction, args.axis)
  if math.abs(along) > 0.995 then
    error(what .. ": axis (along the wire) and direction (towards the mouth) are parallel; they must be "
      .. "perpendicular", 0)
  end
  args.axis = vec.unit(vec.add(args.axis, args.direction, -along))
end

local function check_wires(scene, what, args)
  if args.on ~= nil then fixing.wire(scene, what, "on", args.on) end
  if not args.radius then return end
  for _, entry in ipairs(build.data(scene).wires) do
    local thick = entry.object.radius
    if (args.on == nil or args.on == entry.object) and args.radius < thick * (1 - 1e-9) then
      error(("%s: radius = %.6g m of the seat is below the %.6g m of wire '%s'; leave radius out, or give on "
        .. "= the wire of this clip"):format(what, args.radius, thick, entry.name), 0)
    end
  end
end

local function checked(scene, args)
  local what
  args, what = fixing.arguments(scene, new, "clip", args)
  check_axes(what, args)
  local larger = math.max(args.insertion, args.retention)
  if larger > STRONGEST or larger > STEEPEST * math.min(args.insertion, args.retention) then
    error(("%s: insertion = %g N and retention = %g N are not allowed; they must be at most %g N, and "
      .. "one at most %g times the other"):format(what, args.insertion, args.retention, STRONGEST,
      STEEPEST), 0)
  end
  check_wires(scene, what, args)
  return args
end

-- Makes the damping of the wire's snap; if it fails, the clip is released too.
local function make_damper(scene, args, time, force)
  if time == 0 then return nil end
  local ok, damper = pcall(scene.force, scene, { kind = "snap", at = args.at, direction = args.direction,
    axis = args.axis, width = args.width, insertion = args.insertion, retention = args.retention,
    radius = args.radius, way = args.way, time = time, on = args.on })
  if ok then return damper end
  force:release()
  error(damper, 0)
end

--- scene:clip{ at = {x, y, z}, width =, insertion =, retention =, ... }: see help "clip".
fixing.made(Clip, function(scene, given)
  local args = checked(scene, given)
  local name, time = args.name, args.snap
  remarks.seat(build.data(scene), ("clip '%s'"):format(name), args.at)
  args.name, args.snap, args.kind = nil, nil, "clip"
  local force = scene:force(args)
  force:call_it(name)
  return { name = name, object = force, at = args.at, damper = make_damper(scene, args, time, force),
    direction = args.direction, axis = args.axis, width = args.width, on = args.on, radius = args.radius,
    insertion = args.insertion, retention = args.retention, stiffness = args.stiffness }
end)

function Clip.exists(self) return core.exists(self.object) and self.object.held end

--- Returns the clip's readings, one for each wire it acts on: { { wire =, share =, u =, ... } }.
local function readings(self)
  local list = {}
  fixing.check(self)
  for _, entry in ipairs(build.data(self.scene).wires) do
    if core.exists(entry.object) and (self.on == nil or self.on == entry.object) then
      local r = self.object:read(entry.object)
      r.wire = entry.object
      list[#list + 1] = r
    end
  end
  return list
end

-- True if the wire is in the seat. Before the first step the core has no state: then the place decides.
local function is_seated(r)
  return r.share >= THERE and r.u < r.out and (r.state == SEATED or r.state == EMPTY and r.u > -r.out)
end

-- Returns the reading of this wire, or of all if wire is nil.
local function chosen(self, wire, verb)
  if wire ~= nil then fixing.wire(self.scene, "clip:" .. verb, "the argument", wire) end
  local list = {}
  for _, r in ipairs(readings(self)) do
    if wire == nil or r.wire == wire then list[#list + 1] = r end
  end
  return list
end

--- True if a wire (or this one) is in the seat.
function Clip:seated(wire)
  for _, r in ipairs(chosen(self, wire, "seated")) do
    if is_seated(r) then return true end
  end
  return false
end

--- Returns "empty", "inserting" (under the lips), "seated", or "broken" (by the wire).
function Clip:state(wire)
  local state = "empty"
  for _, r in ipairs(chosen(self, wire, "state")) do
    if r.broken > 0 then return "broken" end
    if is_seated(r) then return "seated" end
    if r.share >= THERE and r.u > 0 and r.u < r.way then state = "inserting" end
  end
  return state
end

--- Returns the force on the wire, friction included [N].
function Clip:force(wire)
  local sum = { 0, 0, 0 }
  for _, r in ipairs(chosen(self, wire, "force")) do
    sum = vec.add(sum, { r.force_x, r.force_y, r.force_z })
  end
  return vector.of(sum)
end

--- Returns how near the seated wire was to being pulled out: largest pull so far over retention. For a wire
-- that came out it is 1 or hardly less.
function Clip:ratio(wire)
  local most = 0
  for _, r in ipairs(chosen(self, wire, "ratio")) do
    most = math.max(most, r.state == SEATED and r.peak or r.removals > 0 and r.out_peak or 0)
  end
  return most / self.retention
end

--- Returns the largest pull of the last run on wires that are in the clip now, over retention.
function Clip:run_ratio(wire)
  local most = 0
  for _, r in ipairs(chosen(self, wire, "run_ratio")) do
    most = math.max(most, r.state == SEATED and r.run_peak or 0)
  end
  return most / self.retention
end

--- Returns how askew the seated wire was at its largest pull: its rise within the clip's width, over the
-- length of the lips' inner flank [-].
function Clip:tilt(wire)
  local most = 0
  for _, r in ipairs(chosen(self, wire, "tilt")) do
    local pulled = r.state == SEATED and r.peak > 0
    most = math.max(most, pulled and math.abs(r.peak_slope) * self.width / r.out or 0)
  end
  return most
end

--- Returns the height of the wire over the seat towards the mouth, and the lips' height [m]; nil if
-- no wire passes.
function Clip:height(wire)
  for _, r in ipairs(chosen(self, wire, "height")) do
    if r.share >= THERE then return r.u, r.way end
  end
end

--- Removes the clip.
function Clip:release()
  require("softworld.check.released").note(self, "clip")
  self.object:release()
  if self.damper then self.damper:release() end
end

local function latest(self, count, time)
  local best
  for _, r in ipairs(readings(self)) do
    if r[count] > 0 and (not best or r[time] > best[time]) then best = r end
  end
  return best
end

--- The wire in the seat, or nil.
function properties.wire(self)
  for _, r in ipairs(readings(self)) do
    if is_seated(r) then return r.wire end
  end
end

--- The last insertion: { time = [s], s = [m], peak_force = [N], wire =, count = }, or nil.
function properties.inserted(self)
  local r = latest(self, "insertions", "in_time")
  return r and { time = r.in_time, s = r.in_s, peak_force = r.in_peak, wire = r.wire,
    count = math.tointeger(r.insertions) }
end

--- The last pull-out: { time = [s], peak_force = [N], wire =, count = }, or nil.
function properties.pulled_out(self)
  local r = latest(self, "removals", "out_time")
  return r and { time = r.out_time, peak_force = r.out_peak, wire = r.wire,
    count = math.tointeger(r.removals) }
end

--- The break of the clip: { time = [s], force = [N], by = "its floor" and so on, wire =, strength = [N] }
-- of the first wire that was pressed through it, or nil.
function properties.overloaded(self)
  local best
  for _, r in ipairs(readings(self)) do
    if r.broken > 0 and (not best or r.broken_time < best.broken_time) then best = r end
  end
  return best and { time = best.broken_time, force = best.broken_force, by = BROKEN[best.broken],
    wire = best.wire, strength = best.strength }
end

--- Peak force of the last insertion, or of the present one [N]; 0 before the first.
function properties.peak_insertion_force(self)
  local most = 0
  for _, r in ipairs(readings(self)) do
    most = math.max(most, r.state == INSERTING and r.peak or r.in_peak)
  end
  return most
end

--- Adds rows to a run's summary.
function Clip:report(add)
  local into, out = self.inserted, self.pulled_out
  if into then
    add(("%s: largest force as '%s' went in"):format(self.name, into.wire.name), into.peak_force, "N",
      into.s, into.time)
  end
  if out then
    add(("%s: '%s' was PULLED OUT, at"):format(self.name, out.wire.name), out.peak_force, "N", nil, out.time)
  end
  local broken = self.overloaded
  if broken then
    add(("%s: OVERLOADED, '%s' broke through %s with"):format(self.name, broken.wire.name, broken.by),
      broken.force, "N", nil, broken.time)
  elseif self:seated() then
    add(self.name .. ": largest pull so far, of its retention", ("%.1f %%"):format(100 * self:ratio()), "")
  elseif not out then
    add(self.name .. ": state", self:state(), "")
  end
end

--- Returns triangles for pictures, in the world's axes.
function Clip:solids()
  local r = readings(self)[1]
  local radius = self.radius or self.on and self.on.radius or r and r.wire.radius or self.width / 2
  return { fixshape.clip(self, radius) }
end

function Clip:__tostring()
  if not self:exists() then return ("clip '%s' (released)"):format(self.name) end
  local ok, state = pcall(Clip.state, self)
  return ("clip '%s' (%s), in %.4g N, out %.4g N"):format(self.name, ok and state or "?", self.insertion,
    self.retention)
end

return Clip
