-- SPDX-License-Identifier: GPL-3.0-or-later
--- The place of a gripper: its pads and its carrier, and the place of a wire near it.
-- @module softworld.grip.stand
local build = require "softworld.scene.build"
local number = require "softworld.output.number"
local pads = require "softworld.grip.pads"
local remarks = require "softworld.remarks"
local room = require "softworld.grip.room"
local told = require "softworld.run.told"
local vec = require "softworld.vec"

local stand = {}

--- Raises an error if the gripper was made after a snapshot that was restored.
function stand.check_there(self, level)
  if self.gone then
    error(("gripper '%s' was made after the snapshot that was restored; make it again")
      :format(self.name), level)
  end
  if self.left then
    error(("gripper '%s' was taken away at t = %.6g s"):format(self.name, self.left), level)
  end
end

--- Same, and raises an error if the scene may not be changed at this moment.
function stand.check_scene(self, level)
  stand.check_there(self, level + 1)
  build.check(self.scene, "gripper '" .. self.name .. "'", level + 1)
end

--- Returns the arc length of the wire nearest to a point, and the distance.
function stand.nearest_place(wire, at)
  local x, s = wire:positions()
  local best, place = math.huge, 0
  for i = 1, #s - 1 do
    local a, b, t, e = 3 * i - 2, 3 * i + 1, 0, 0
    for k = 0, 2 do
      local d = x[b + k] - x[a + k]
      t, e = t + d * (at[k + 1] - x[a + k]), e + d * d
    end
    t = e > 0 and math.max(0, math.min(1, t / e)) or 0
    local d2 = 0
    for k = 0, 2 do d2 = d2 + (at[k + 1] - x[a + k] - t * (x[b + k] - x[a + k])) ^ 2 end
    if d2 < best then best, place = d2, s[i] + t * (s[i + 1] - s[i]) end
  end
  return place, best ^ 0.5
end

-- Returns the orientation of a tool at arc length s: x along the wire, z as close to up as possible.
local function facing(scene, wire, s)
  local up = vec.unit(vec.scale(scene:gravity(), -1)) or { 0, 0, 1 }
  return vec.facing(vec.unit(wire:tangent(s)), up)
end

-- Returns the sides of several wires along y, from the place `at` of one of them: of those that fit between
-- the open pads together with it. height: of the pads along z [m].
local function sides(wire, wires, at, y, z, opening, height)
  local low, high = -wire.radius, wire.radius
  for _, one in ipairs(wires) do
    local way = vec.sub(one:position((stand.nearest_place(one, at))), at)
    local off = vec.dot(way, y)
    local l, h = math.min(low, off - one.radius), math.max(high, off + one.radius)
    if h - l <= opening and math.abs(vec.dot(way, z)) <= height then low, high = l, h end
  end
  return low, high
end

-- Returns place and orientation of pads around a wire at s. Two fingers close along the tool's y axis by the
-- same way: of several wires they stand in the middle, or one finger would come first and bend them.
local function around(self, wire, s, wires)
  local at = wire:position(s)
  local q = self.rotation and pads.quaternion(self.rotation) or facing(self.scene, wire, s)
  if not wires or #wires < 2 or self.pads.fingers ~= 2 then return at, q end
  local y, z = vec.rotate(q, { 0, 1, 0 }), vec.rotate(q, { 0, 0, 1 })
  local opening = self.tool and self.tool:state().opening or self.pads.opening or 4 * wire.radius
  local low, high = sides(wire, wires, at, y, z, opening, self.pads.height or 0.02)
  return vec.add(at, y, 0.5 * (low + high)), q
end

-- Returns where pads are made: at the gripper's place, or around the wire, of several wires, at s.
local function place_of(self, wire, s, wires)
  if s then return around(self, wire, s, wires) end
  return self.at or { 0, 0, 0 }, self.rotation
end

--- Makes the gripper's pads at its place (at, rotation) or around the wire, of several wires, at s.
function stand.make_tool(self, level, wire, s, wires)
  local at, rotation = place_of(self, wire, s, wires)
  build.call(level, function()
    self.tool, self.obstacles, self.opening, self.span = remarks.without(pads.make, self.scene, self, at,
      rotation, wire and wire.radius)
  end)
end

--- True while the gripper follows a move that another process, or none, waits for.
function stand.is_moving(self)
  return (self.busy_until or -math.huge) > self.scene.time * (1 + 1e-12) + 1e-12
end

--- Tells that a gripper which went on with its move took the wire away from its centre. free: distance that
-- is not told [m].
function stand.tell_distance(self, wire, s, free)
  local distance = vec.norm(vec.sub(wire:position(s), self:position()))
  if distance <= free then return end
  self.scene:tell{ kind = "grasp", object = self.name, s = s, value = distance, text = ("gripper '%s' grasps "
    .. "wire '%s' as it moves, with s = %.4g m %.3g mm from its centre: it goes on with its move and carries "
    .. "the wire there"):format(self.name, wire.name, s, 1e3 * distance) }
end

-- Returns the longest way to a wire that a gripper takes without a word: its pads reach so far [m].
local function reach(self, wire)
  return math.max(self.pads.opening or 0, self.width, 4 * wire.radius)
end

--- Tells that a gripper at rest is farther away from the wire than it reaches. from: its centre, or nil: it
-- has no place yet; text: what happens.
function stand.tell_far(self, wire, s, from, text)
  local distance = from and vec.norm(vec.sub(wire:position(s), from)) or 0
  if distance <= reach(self, wire) then return end
  told.tell(self.scene, { kind = "grasp", object = self.name, s = s, value = distance, text = ("gripper '%s' "
    .. "grasps wire '%s' at s = %.4g m, which is %s from its centre: %s"):format(self.name, wire.name, s,
      number.text(distance, "m"), text) })
end

stand.JUMPS = "it jumps there at once; let it move or approach first"
stand.STAYS = "it holds the wire there"

--- Makes a carrier, a moving place, for a gripper without pads: while it holds nothing, or for several wires.
function stand.make_carrier(self)
  local at, q = self.at or { 0, 0, 0 }, self.rotation or self.facing or nil
  if self.hold then at, q = self.hold:pose() end
  self.carrier = self.scene:tool{ name = self.name, at = at, rotation = q }
  return self.carrier
end

-- Makes the pads, unless they would stand in one of the wires.
local function make_beside(self, wire, s, wires, level)
  local at, rotation = place_of(self, wire, s, wires)
  build.call(level, function()
    room.check(self, wires, pads.solids(self, at, rotation, wire.radius))
  end)
  if s then stand.tell_far(self, wire, s, self.at, stand.JUMPS) end
  stand.make_tool(self, level + 1, wire, s, wires)
end

-- Puts the pads at the wire's arc length s, unless they would stand in one of the wires there. They are
-- looked at before they move: pads that jump there and back jolt the scene.
local function put_beside(self, wire, s, wires)
  local opening, from, to = self.tool:state().opening, { self.tool:pose() }, nil
  if s then to = { around(self, wire, s, wires) } end
  room.check(self, wires, room.solids(self.obstacles, from, to), opening, (to or from)[2])
  if not to then return end
  stand.tell_far(self, wire, s, from[1], stand.JUMPS)
  self.tool:pose(to[1], to[2])
end

--- Puts the open pads at the wire's arc length s, or in the middle of several wires there. Pads that move
-- stay on their way. Raises an error, and leaves the pads as they were, if they would stand in a wire.
function stand.place_tool(self, wire, s, wires, level)
  if not self.tool and self.carrier then
    if stand.is_moving(self) then
      error(("gripper '%s' is moving until t = %g s without pads; grasp by pads after that"):format(self.name,
        self.busy_until), level)
    end
    self.at = (self.carrier:pose())
  end
  if not self.tool then return make_beside(self, wire, s, wires, level + 1) end
  local moves = s and stand.is_moving(self)
  if moves then stand.tell_distance(self, wire, s, 0.5 * self.width) end
  put_beside(self, wire, not moves and s or nil, wires)
end

return stand
