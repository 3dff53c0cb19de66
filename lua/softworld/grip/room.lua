-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks that a wire has room between open pads. A wire that begins inside a finger would be pushed out of
-- it with forces that have no meaning.
-- @module softworld.grip.room
local vec = require "softworld.vec"

local room = {}

local MOST, SHARE = 1e-4, 0.1 -- a wire may be this deep in a pad that it leans on: [m], of its radius [-]
local APART = 0.5 -- distance of places that are looked at, over the wire's radius [-]

-- Returns the deepest place of a wire in a solid { shape, at, q }: depth [m], arc length [m]; 0 if it is
-- nowhere inside.
local function deepest(wire, solid)
  local at, back = solid.at, vec.conjugate(solid.q)
  local low, high = solid.shape:bounds()
  local reach = vec.norm(vec.sub(high, low)) + wire.radius
  local x, s = wire:positions()
  local depth, place = 0, nil
  local function point(i) return vec.rotate(back, vec.sub({ x[3 * i - 2], x[3 * i - 1], x[3 * i] }, at)) end
  for i = 1, #s - 1 do
    local a, b = point(i), point(i + 1)
    local long = vec.norm(vec.sub(b, a))
    if vec.norm(a) - long < reach then
      local count = math.ceil(long / (APART * wire.radius))
      for k = 0, count do
        local share = count > 0 and k / count or 0
        local gap = solid.shape:distance(vec.add(a, vec.sub(b, a), share))
        if wire.radius - gap > depth then
          depth, place = wire.radius - gap, s[i] + share * (s[i + 1] - s[i])
        end
      end
    end
  end
  return depth, place
end

--- Returns obstacles as solids, a list of { name, shape, at, q }: as they are, or as they would be if what
-- carries them went from one pose to another. from, to: { place, quaternion }.
function room.solids(obstacles, from, to)
  local list = {}
  for i, obstacle in ipairs(obstacles) do
    local at, q = obstacle:pose()
    if to then
      local turn = vec.multiply(to[2], vec.conjugate(from[2]))
      at, q = vec.add(to[1], vec.rotate(turn, vec.sub(at, from[1]))), vec.multiply(turn, q)
    end
    list[i] = { name = obstacle.name, shape = obstacle.shape, at = at, q = q }
  end
  return list
end

--- Raises an error without a place if one of the wires is inside one of the open fingers, given as solids.
-- q: rotation of the tool.
function room.check(self, wires, solids, opening, q)
  for _, wire in ipairs(wires) do
    for _, finger in ipairs(solids) do
      local depth, s = deepest(wire, finger)
      if depth > math.max(MOST, SHARE * wire.radius) then
        local along = math.abs(vec.dot(vec.unit(wire:tangent(s)), vec.rotate(q, { 1, 0, 0 })))
        error(("gripper '%s': its jaws are %.3g mm open, and wire '%s' is %.3g mm deep inside '%s' at s = "
          .. "%.4g m; there the wire runs at %.3g degrees to the pads' x axis. Turn the pads (rotation), "
          .. "give s instead of a place (at), open them (pads.opening) or take narrower ones (pads.width)")
          :format(self.name, 1e3 * opening, wire.name, 1e3 * depth, finger.name, s,
          math.deg(math.acos(math.min(1, along)))), 0)
      end
    end
  end
end

return room
