-- SPDX-License-Identifier: GPL-3.0-or-later
--- Pads on a rod that does not roll. Their friction acts at the rod's axis and neither twists it nor keeps it
-- from turning: its torsion, and their moment about its axis, stay 0. An event tells it where pads turn about
-- the axis against another hold. The turn between both is measured by vectors that go with them: one of them
-- is carried along the rod without twist and compared with the other. A rod with material frames, such as one
-- that is curved at rest, rolls in the pads by itself; the turn is that of its material against the pads.
-- If a hold lets go of a twisted rod, pads between it and another one keep nothing of the torsion: this is
-- told too.
-- @module softworld.grip.untwisted
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local number = require "softworld.output.number"
local stand = require "softworld.grip.stand"
local vec = require "softworld.vec"

local untwisted = {}

local TOLD = 0.2 -- smaller turns are left out [rad]
local MORE = 1.02 -- an angle that has grown by this factor is told instead of the last one [-]
local keeps = checks.set "clamp grip feed" -- holds that keep a wire from turning
local function is_plain(wire)
  return wire.model == "rod" and wire.beam.GJ > 0 and not wire:get().spin_inertia
end

-- Adds what holds the wire, with its place and orientation, to the list.
local function add(list, wire, object, pads, at, q)
  local s, distance = core.nearest_place(wire, at)
  if distance > 2 * wire.radius then return end
  list[#list + 1] = { object = object, grips = pads and object.grips, pads = pads, s = s, q = q,
    twists = not pads or object.frozen ~= nil }
end

-- Returns the nearest holds before and after s, of those that keep the wire from turning, or twist it.
local function nearest(list, s, twists)
  local before, after
  for _, h in ipairs(list) do
    local counts = h.twists or not twists
    if counts and h.s < s and not (before and before.s > h.s) then before = h end
    if counts and h.s > s and not (after and after.s < h.s) then after = h end
  end
  return before, after
end

-- Returns the other holds that keep the wire from turning.
local function holds_of(self, wire)
  local list, data = {}, build.data(self.scene)
  for _, g in ipairs(data.grippers) do
    if g ~= self and g.tool and g.held and not g.left then add(list, wire, g, true, g.tool:pose()) end
  end
  for _, h in ipairs(data.holds) do
    if keeps[h.kind] and core.exists(h.object) and h.object.held then
      add(list, wire, h.object, false, h.object:pose())
    end
  end
  return list
end

-- Returns how far the angle of a record has turned since its first look [rad].
local function turned(seen, angle)
  seen.angle = seen.angle or angle
  local turn = math.abs(angle - seen.angle)
  return math.min(turn, 2 * math.pi - turn)
end

local CLOSES = { 0, 1, 0 } -- pads close along it; the wire stays across it, however it swings between them

-- Returns the turn of a hold against the pads since the first look [rad]. seen: what that look found.
local function turn_of(self, wire, s, hold, seen)
  local _, q = self.tool:pose()
  local u, last = core.carried(wire, s, hold.s, vec.rotate(q, CLOSES))
  if not u then return 0 end
  seen.theirs = seen.theirs or hold.pads and CLOSES or vec.rotate(vec.conjugate(hold.q), u)
  local v = vec.across(vec.rotate(hold.q, seen.theirs), last)
  return turned(seen, math.atan(vec.dot(vec.cross(u, v), last), vec.dot(u, v)))
end

local WAY = "Give the wire rolls = true, or grasp it imposed"

local function tell(self, wire, hold)
  self.scene:tell{ kind = "untwisted", object = self.name, s = hold.s, text = ("the pads of '%s' and '%s' "
    .. "turn against each other about the axis of wire '%s'. Pads do not twist a rod: its torsion and their "
    .. "moment about this axis are missing. %s or mixed"):format(self.name, hold.object.name, wire.name,
    WAY) }
end

-- Looks at a wire with material frames.
local function look_at_frames(self, wire, s, across, seen)
  local _, q = self.tool:pose()
  local t = wire:tangent(s)
  local ours = vec.across(vec.rotate(q, CLOSES), t)
  local turn = turned(seen, math.atan(vec.dot(vec.cross(ours, across), t), vec.dot(ours, across)))
  if turn <= MORE * (seen.most or TOLD / MORE) then return end
  seen.most, seen.time = turn, seen.time or self.scene.time
  self.scene:tell{ kind = "untwisted", object = self.name, s = s, value = turn, time = seen.time,
    text = ("wire '%s' has rolled in the pads of '%s' by %.3g degrees: they do not keep a rod from turning "
    .. "about its axis, as friction would. Places and bends are wrong. %s"):format(wire.name, self.name,
    math.deg(turn), WAY) }
end

-- True if two orientations are the same.
local function rests(p, q)
  for k = 1, 4 do
    if math.abs(p[k] - q[k]) > 1e-9 then return false end
  end
  return true
end

-- Begins to measure, or does not where the pads twist the wire.
local function begin(self)
  local measures = self.wire and is_plain(self.wire)
  self.turns_seen = { grips = self.grips, told = not measures }
  return self.turns_seen
end

-- Looks at the nearest hold (nil: there is none) on one side of s. Its turn counts from its grasp on.
local function look_at_hold(self, wire, s, hold, seen, side)
  local last = seen[side]
  if not hold or seen.told then seen[side] = nil return end
  if not last or last.by ~= hold.object or last.grips ~= hold.grips then
    last = { by = hold.object, grips = hold.grips } -- no field `object`: snapshots copy no such tables
    seen[side] = last
  end
  local whole = (seen.whole or last.whole) and last.q and rests(last.q, hold.q)
  last.q = hold.q
  if turn_of(self, wire, s, hold, last) <= TOLD and not (whole and not stand.is_moving(self)) then return end
  local other = hold.pads and hold.object.turns_seen
  seen.told = true
  if not (other and other.grips == hold.object.grips and other.told) then tell(self, wire, hold) end
end

-- True if the hold of an earlier look is gone.
local function is_gone(hold, list)
  for _, h in ipairs(list) do
    if h.object == hold.object and h.twists then return false end
  end
  return true
end

-- Tells of torsion that a hold let go, and that friction of the pads would have kept. before, after: the
-- nearest holds that twist the wire.
local function look_at_torsion(self, wire, s, list, seen)
  local last, before, after = seen.torsion, nearest(list, s, true)
  local bears = self.tool:state().most * wire.radius
  seen.torsion = before and after and { moment = wire:twist_moment(s), before = before, after = after,
    bears = bears } or nil
  if not last then return end
  local first, second = is_gone(last.before, list), is_gone(last.after, list)
  if first == second then return end -- both stay, or none
  local gone, other = first and last.before or last.after, first and last.after or last.before
  local left = seen.torsion and seen.torsion.moment or 0
  local lost = math.abs(last.moment) - math.abs(left)
  local angle = math.min(lost, last.bears) * math.abs(other.s - s) / wire.beam.GJ
  if angle <= TOLD then return end
  seen.told = true
  self.scene:tell{ kind = "untwisted", object = self.name, s = s, value = lost, text = ("'%s' has let go of "
    .. "wire '%s', and the pads of '%s' keep nothing of its torsion of %s (%s up to '%s'). Their friction "
    .. "would bear %s. %s or mixed"):format(gone.object.name, wire.name, self.name, number.text(lost, "N m"),
    number.text(lost * math.abs(other.s - s) / wire.beam.GJ, "rad"), other.object.name,
    number.text(last.bears, "N m"), WAY) }
end

--- Looks at the turns of a gripper whose pads hold a wire. They count from the first look since the grasp.
function untwisted.look(self)
  local seen, wire = self.turns_seen, self.wire
  if not seen or seen.grips ~= self.grips then seen = begin(self) end
  if seen.told or self.frozen or not is_plain(wire) then return end
  local s = core.nearest_place(wire, (self.tool:pose()))
  local across = core.across(wire, s)
  if across then return look_at_frames(self, wire, s, across, seen) end
  local list = holds_of(self, wire)
  local before, after = nearest(list, s)
  look_at_hold(self, wire, s, before, seen, "before")
  look_at_hold(self, wire, s, after, seen, "after")
  if not seen.told then look_at_torsion(self, wire, s, list, seen) end
end

-- Returns the turn about a wire's axis where a gripper is [rad].
local function turn_along(self, wire, turn)
  return vec.dot(vec.unit(turn.axis), wire:tangent(core.nearest_place(wire, self:position()))) * turn.angle
end

--- Notes that a move begins which turns the gripper. Looks may be too far apart to see a whole turn.
function untwisted.turns(self, turn)
  local seen, wire = self.turns_seen, self.wire
  if self.tool and wire and seen and not seen.told then
    seen.whole = math.abs(turn_along(self, wire, turn)) > math.pi
  end
  for _, g in ipairs(build.data(self.scene).grippers) do
    local other = g ~= self and g.held and g.turns_seen
    for _, side in ipairs{ other and other.before or false, other and other.after or false } do
      local mine = side and side.by == self
      for _, grip in ipairs(self.grips) do mine = mine or side and grip.hold == side.by end
      if mine and math.abs(turn_along(self, g.wire, turn)) > math.pi then side.whole = true end
    end
  end
end

local LOOKS = 50 -- places at which the torsion of a wire is read

--- Returns the moments about a wire's axis at places along it, and their distance [N m], [m].
function untwisted.torsion(wire)
  local list, step = {}, wire.length / LOOKS
  for k = 1, LOOKS do
    local fine, moment = pcall(wire.twist_moment, wire, (k - 0.5) * step)
    list[k] = fine and math.abs(moment) or 0 -- lines beside a mesh bear none
  end
  return list, step
end

-- Returns the places of the outermost other holds that twist the wire.
local function between_others(self)
  local first, last = math.huge, -math.huge
  for _, h in ipairs(holds_of(self, self.wire)) do
    if h.twists then first, last = math.min(first, h.s), math.max(last, h.s) end
  end
  return first, last
end

-- Returns the angle of torsion that is lost between two places, and its largest moment [rad], [N m].
local function lost_between(self, before, now, step, first, last)
  local angle, most = 0, 0
  for k, moment in ipairs(before) do
    local s = (k - 0.5) * step
    local lost = s > first and s < last and math.max(0, moment - (now and now[k] or 0)) or 0
    angle, most = angle + lost * step / self.wire.beam.GJ, math.max(most, lost)
  end
  return angle, most
end

local LEAST = 1e-3 -- smaller torsion may be lost [rad]

--- True if other holds keep torsion of the wire that a mesh would lose.
function untwisted.others_keep(self)
  if self.wire.beam.GJ <= 0 then return false end
  local torsion, step = untwisted.torsion(self.wire)
  return (lost_between(self, torsion, nil, step, between_others(self))) > LEAST
end

--- Tells of torsion that a wire has lost as a frozen grip was thawed. before: its moments until then [N m].
-- leaves: the grip lets go, and only torsion between others would remain.
function untwisted.thawed(self, before, leaves)
  local now, step = untwisted.torsion(self.wire)
  local first, last = 0, self.wire.length
  if leaves then first, last = between_others(self) end
  local angle, most = lost_between(self, before, now, step, first, last)
  if angle <= TOLD then return end
  self.scene:tell{ kind = "untwisted", object = self.name, s = self.s, value = most, text = ("the thaw of "
    .. "'%s' takes the torsion of %s (%s) from wire '%s': the wire beside a mesh bears none. Make all of it "
    .. "a mesh before the grasp, wire:remodel{ model = '%s' }, or grasp it imposed"):format(self.name,
    number.text(most, "N m"), number.text(angle, "rad"), self.wire.name, self.mesh_model or "radial") }
end

return untwisted
