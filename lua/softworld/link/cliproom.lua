-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks that no wire begins in the walls or the floor of a clip. They would push it out with a force that
-- has no meaning: they are springs, and the energy with which they begin comes from nowhere.
-- @module softworld.link.cliproom
local build = require "softworld.scene.build"
local core = require "softworld.core"
local fixing = require "softworld.link.fixing"
local vec = require "softworld.vec"

local cliproom = {}

local MOST, SHARE = 1e-4, 0.25 -- a wire may begin this deep: [m], of its radius [-]
local APART = 0.25 -- distance of places that are looked at, over the wire's radius [-]
local WINDOW = 0.25 -- places up to this share of the width from the middle, where the clip acts most [-]
local STIFFNESS = 50 -- default, see help "clip": over the larger force and per radius [-]
local EMPTY = 0 -- the core's state of a wire that the clip has not caught
local met = setmetatable({}, { __mode = "k" }) -- of clips: the wires that they have met

-- Returns the sizes of the clip for a wire [m]: between wire and seat, thickness of walls, lips' top.
local function sizes(clip, wire, reading)
  local k = clip.stiffness or STIFFNESS * math.max(clip.insertion, clip.retention) / wire.radius
  return (clip.radius or wire.radius) - wire.radius, 2 * math.pi * reading.strength / k, reading.out
end

-- Returns how deep a place is in walls or floor, the shortest way out: to the seat, outside or over the lips.
-- up: over the seat; aside: from its middle plane [m].
local function depth_at(up, aside, clearance, thick, top)
  local to_seat = math.max(math.abs(aside) - clearance, -clearance - up)
  local outwards = math.min(clearance + thick - math.abs(aside), up + clearance + thick, top - up)
  return math.min(to_seat, outwards)
end

-- Returns the deepest place of a wire: depth [m], arc length [m], "wall" or "floor".
local function deepest(clip, wire, reading)
  local clearance, thick, top = sizes(clip, wire, reading)
  local side = vec.cross(clip.axis, clip.direction)
  local x, s = wire:positions()
  local depth, place, what = 0, nil, nil
  local function point(i) return vec.sub({ x[3 * i - 2], x[3 * i - 1], x[3 * i] }, clip.at) end
  for i = 1, #s - 1 do
    local a, b = point(i), point(i + 1)
    local long = vec.norm(vec.sub(b, a))
    if vec.norm(a) - long < clip.width + thick + top then
      local count = math.ceil(long / (APART * wire.radius))
      for k = 0, count do
        local share = count > 0 and k / count or 0
        local p = vec.add(a, vec.sub(b, a), share)
        local up, aside = vec.dot(p, clip.direction), vec.dot(p, side)
        local d = depth_at(up, aside, clearance, thick, top)
        if d > depth and math.abs(vec.dot(p, clip.axis)) < WINDOW * clip.width then
          depth, place = d, s[i] + share * (s[i + 1] - s[i])
          what = math.abs(aside) > -up and "wall" or "floor"
        end
      end
    end
  end
  return depth, place, what
end

local function check(clip, wire, reading)
  local depth, s, what = deepest(clip, wire, reading)
  local most = math.max(MOST, SHARE * wire.radius)
  if depth > most then
    error(("clip '%s': wire '%s' begins %.3g mm deep in its %s at s = %.4g m; at most %.3g mm are allowed. "
      .. "Put the wire into the seat (at), over the mouth or beside the clip, or give on = the wire of this "
      .. "clip"):format(clip.name, wire.name, 1e3 * depth, what, s, 1e3 * most), 0)
  end
end

--- Raises an error without a place if a wire begins in the body of a clip that has not met it yet. Later it
-- may be pressed in.
function cliproom.check(scene)
  for _, clip in ipairs(fixing.all(scene)) do
    local known = getmetatable(clip).__name == "clip" and (met[clip.object] or {})
    for _, entry in ipairs(known and build.data(scene).wires or {}) do
      local wire = entry.object
      if core.exists(wire) and (clip.on == nil or clip.on == wire) and not known[entry] then
        local r = clip.object:read(wire)
        known[entry] = true
        if r.state == EMPTY and r.insertions + r.removals + r.broken == 0 then check(clip, wire, r) end
      end
    end
    if known then met[clip.object] = known end
  end
end

return cliproom
