-- SPDX-License-Identifier: GPL-3.0-or-later
--- Pads on a rod that does not roll. Their friction acts at the rod's axis and neither twists it nor keeps it
-- from turning: its torsion, and their moment about its axis, stay 0. An event tells it where pads turn about
-- the axis against another hold. The turn between both is measured by vectors that go with them: one of them
-- is carried along the rod without twist and compared with the other. A rod with material frames, such as one
-- that is curved at rest, rolls in the pads by itself; the turn is that of its material against the pads.
-- @module softworld.grip.untwisted
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local stand = require "softworld.grip.stand"
local vec = require "softworld.vec"

local untwisted = {}

local TOLD = 0.2 -- smaller turns are left out [rad]
local keeps = checks.set "clamp grip feed" -- holds that keep a wire from turning
local records = setmetatable({}, { __mode = "k" }) -- by gripper: what was seen since its grasp

local function is_plain(wire)
  return wire.model == "rod" and wire.beam.GJ > 0 and not wire:get().spin_inertia
end

-- Adds what holds the wire, with its place and orientation, to the list.
local function add(list, wire, object, pads, at, q)
  local s, distance = core.nearest_place(wire, at)
  if distance > 2 * wire.radius then return end
  list[#list + 1] = { object = object, grips = pads and object.grips, pads = pads, s = s, q = q }
end

-- Returns the nearest holds before and after s that keep the wire from turning.
local function neighbours(self, wire, s)
  local list, data = {}, build.data(self.scene)
  for _, g in ipairs(data.grippers) do
    if g ~= self and g.tool and g.held and not g.left then add(list, wire, g, true, g.tool:pose()) end
  end
  for _, h in ipairs(data.holds) do
    if keeps[h.kind] and core.exists(h.object) and h.object.held then
      add(list, wire, h.object, false, h.object:pose())
    end
  end
  local before, after
  for _, h in ipairs(list) do
    if h.s < s and not (before and before.s > h.s) then before = h end
    if h.s > s and not (after and after.s < h.s) then after = h end
  end
  return before, after
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
  if turn <= TOLD then return end
  seen.told = true
  self.scene:tell{ kind = "untwisted", object = self.name, s = s, value = turn, text = ("wire '%s' has "
    .. "rolled in the pads of '%s' by %.3g degrees: they do not keep a rod from turning about its axis, as "
    .. "friction would. Places and bends are wrong. %s"):format(wire.name, self.name, math.deg(turn), WAY) }
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
  records[self] = { grips = self.grips, time = self.scene.time, told = not measures }
  return records[self]
end

-- Looks at the nearest hold (nil: there is none) on one side of s. Its turn counts from its grasp on.
local function look_at_hold(self, wire, s, hold, seen, side)
  local last = seen[side]
  if not hold or seen.told then seen[side] = nil return end
  if not last or last.object ~= hold.object or last.grips ~= hold.grips then
    last = { object = hold.object, grips = hold.grips }
    seen[side] = last
  end
  local whole = seen.whole and last.q and rests(last.q, hold.q)
  last.q = hold.q
  if turn_of(self, wire, s, hold, last) <= TOLD and not (whole and not stand.is_moving(self)) then return end
  local other = records[hold.object]
  seen.told = true
  if not (other and other.grips == hold.object.grips and other.told) then tell(self, wire, hold) end
end

--- Looks at the turns of a gripper whose pads hold a wire. They count from the first look since the grasp;
-- after a resume from a file, from there.
function untwisted.look(self)
  local seen, wire = records[self], self.wire
  if not seen or seen.grips ~= self.grips or self.scene.time < seen.time then seen = begin(self) end
  if seen.told or self.frozen then return end
  local s = core.nearest_place(wire, (self.tool:pose()))
  local across = core.across(wire, s)
  if across then return look_at_frames(self, wire, s, across, seen) end
  local before, after = neighbours(self, wire, s)
  look_at_hold(self, wire, s, before, seen, "before")
  look_at_hold(self, wire, s, after, seen, "after")
end

--- Notes that a move begins which turns the gripper. Looks may be too far apart to see a whole turn.
function untwisted.turns(self, turn)
  local seen, wire = records[self], self.wire
  if not seen or seen.told or not wire then return end
  local along = vec.dot(vec.unit(turn.axis), wire:tangent(core.nearest_place(wire, (self.tool:pose()))))
  seen.whole = math.abs(turn.angle * along) > math.pi
end

return untwisted
