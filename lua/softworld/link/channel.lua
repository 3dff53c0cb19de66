-- SPDX-License-Identifier: GPL-3.0-or-later
--- Channels: troughs along a way, made of obstacles. Each leg has a floor and two walls, mitred where
-- legs meet, and a lid when the channel is closed.
--
--     local duct = scene:channel{ name = "duct", points = { {0, 0, 0}, {0.3, 0, 0}, {0.3, 0.2, 0} },
--       width = 0.015, depth = 0.012, friction = 0.2 }
--     print(duct:contains(wire), duct:force()[3])
--     duct:close()
--
-- @module softworld.link.channel
local checks = require "softworld.checks"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local fixing = require "softworld.link.fixing"
local rows = require "softworld.rows"
local vec = require "softworld.vec"
local vector = require "softworld.vector"

local dot, cross, add, unit, norm = vec.dot, vec.cross, vec.add, vec.unit, vec.norm

local properties = {}
local Channel = fixing.class("channel", properties, { "lids", "count" })
local SHARPEST = 0.3 -- least cosine between a leg and the mitre's normal; below it corners are spikes

local new = rows.call("scene:channel", "{...}", "a trough along points, with mitred corners and a lid", {
  gives = "a channel",
  example = "scene:channel { points = { { 0, 0, 0 }, { 0.3, 0, 0 } }, width = 0.015, depth = 0.012 }",
  { "name", "text", "-", "name in messages", usual = "channel1, ..." },
  { "points", "points", "m", "way-points of the middle of its floor, two or more" },
  { "width", "number", "m", "inside", min = 1e-6, max = 1000, required = true },
  { "depth", "number", "m", "inside", min = 1e-6, max = 1000, required = true },
  { "thickness", "number", "m", "of floor and walls", min = 1e-6, max = 1000, default = 0.002 },
  { "up", "vector", "-", "where it is open", default = { 0, 0, 1 } },
  { "friction", "number", "-", "on the wire", min = 0, max = 100, default = 0 },
  { "restitution", "number", "-", "share of the approach speed kept in an impact", min = 0, max = 1,
    default = 0 },
  { "lid", "boolean", "-", "closed from the start", usual = "false" },
})

rows.calls{
  { "channel:contains", "wire", "share of the wire's length inside, in steps of 1/200", "-" },
  { "channel:close", "", "puts the lid on; refused while a wire stands out", "the channel" },
  { "channel:open", "", "takes the lid off", "the channel" },
  { "channel:force", "", "of all wires on it", "{x, y, z} [N]" },
  { "channel:release", "", "takes the channel away" },
  { "channel.name", nil, "name in messages" },
  { "channel:exists", "", "whether it is still in the scene", "true or false" },
  { "channel.closed", nil, "is the lid on", "true or false" },
  { "channel.parts", nil, "its parts: floor, walls and lid", "a list of obstacles" },
}

-- --- geometry ----------------------------------------------------------------------

local function read_points(what, given)
  if type(given) ~= "table" or #given < 2 then
    error(what .. ": points is required, a list of at least two {x, y, z} [m]", 0)
  end
  local points = {}
  rows.whole(what .. ": points", given)
  for i, p in ipairs(given) do points[i] = checks.vector(("%s: points[%d]"):format(what, i), p, "m", 0) end
  return points
end

-- Returns the legs: from, to, along, side (to the left) and up; the last three are orthogonal unit vectors.
local function legs_of(what, points, up)
  local legs = {}
  for i = 1, #points - 1 do
    local along = unit(add(points[i + 1], points[i], -1))
    if not along then error(("%s: points %d and %d are the same"):format(what, i, i + 1), 0) end
    local side = unit(cross(up, along))
    if not side or norm(cross(up, along)) < 0.2 then
      error(("%s: leg %d is parallel to up; legs must be across the direction of the open side"):format(what,
        i), 0)
    end
    legs[i] = { from = points[i], to = points[i + 1], along = along, side = side, up = cross(along, side) }
  end
  return legs
end

-- Returns the normals of the planes in which legs meet, and those of the two ends.
local function mitres_of(what, legs)
  local mitres = { legs[1].along }
  for i = 2, #legs do
    local normal = unit(add(legs[i - 1].along, legs[i].along))
    if not normal or dot(normal, legs[i].along) < SHARPEST then
      error(("%s: legs %d and %d meet at %.0f degrees; a channel may turn by at most %.0f degrees"):format(
        what,
        i - 1, i, math.deg(math.acos(math.max(-1, dot(legs[i - 1].along, legs[i].along)))),
        2 * math.deg(math.acos(SHARPEST))), 0)
    end
    mitres[i] = normal
  end
  mitres[#legs + 1] = legs[#legs].along
  return mitres
end

-- Returns where the line along the leg, y to the left and z up, meets the mitre at one of its ends.
local function corner(leg, at, normal, y, z)
  local offset = add(add({ 0, 0, 0 }, leg.side, y), leg.up, z)
  return add(add(at, offset), leg.along, -dot(offset, normal) / dot(leg.along, normal))
end

-- Returns a leg's prism from y1 to y2 and z1 to z2, as flat points of a hull.
local function prism(what, self, i, y1, y2, z1, z2)
  local leg, points = self.legs[i], {}
  for _, p in ipairs{ { y1, z1 }, { y2, z1 }, { y2, z2 }, { y1, z2 } } do
    local a = corner(leg, leg.from, self.mitres[i], p[1], p[2])
    local b = corner(leg, leg.to, self.mitres[i + 1], p[1], p[2])
    if dot(add(b, a, -1), leg.along) <= 0 then
      error(("%s: leg %d is too short for the bends at its ends with this width"):format(what, i), 0)
    end
    for k = 1, 3 do points[#points + 1] = a[k] end
    for k = 1, 3 do points[#points + 1] = b[k] end
  end
  return points
end

-- Returns the parts of the trough, each { name, points }.
local function trough(what, self)
  local half, t, parts = self.width / 2, self.thickness, {}
  local list = { { "floor", -half - t, half + t, -t, 0 }, { "left", half, half + t, 0, self.depth },
    { "right", -half - t, -half, 0, self.depth } }
  for i = 1, #self.legs do
    for _, p in ipairs(list) do
      local points = prism(what, self, i, table.unpack(p, 2))
      parts[#parts + 1] = { checks.part_name(self.name, (" %s %d"):format(p[1], i)), points }
    end
  end
  return parts
end

local function lid(what, self)
  local half, t, parts = self.width / 2 + self.thickness, self.thickness, {}
  for i = 1, #self.legs do
    parts[i] = { checks.part_name(self.name, (" lid %d"):format(i)),
      prism(what, self, i, -half, half, self.depth, self.depth + t) }
  end
  return parts
end

local LID = 0.7 -- transparency in pictures, so that the wire is visible

local function remove(parts)
  for _, part in ipairs(parts) do part:remove() end
end

-- Makes all of the parts, or raises an error and makes none.
local function raise(self, parts, transparency)
  for _, part in ipairs(parts) do core.shape{ shape = "hull", points = part[2] } end -- check all first
  local list, shown = {}, build.data(self.scene).obstacles
  for i, part in ipairs(parts) do
    local ok, made = pcall(self.scene.obstacle, self.scene, { name = part[1], shape = "hull",
      points = part[2], friction = self.friction, restitution = self.restitution })
    if not ok then
      for k = i - 1, 1, -1 do list[k]:remove() end
      error(made, 0)
    end
    list[i] = made
    shown[#shown].transparency = transparency
  end
  return list
end

-- --- making --------------------------------------------------------------------------

local function checked(scene, args)
  local what
  args, what = fixing.arguments(scene, new, "channel", args)
  args.points = read_points(what, args.points)
  args.up = unit(args.up)
  if not args.up then error(what .. ": up must not be a zero vector", 0) end
  return args, what
end

--- scene:channel{ points = {{x, y, z}, ...}, width =, depth =, ... }: see help "channel".
fixing.made(Channel, function(scene, given)
  local args, what = checked(scene, given)
  local self = { name = args.name, scene = scene, width = args.width, depth = args.depth,
    thickness = args.thickness, friction = args.friction, restitution = args.restitution }
  self.legs = legs_of(what, args.points, args.up)
  self.mitres = mitres_of(what, self.legs)
  local parts, cover = trough(what, self), lid(what, self)
  self.parts = raise(self, parts)
  self.object = self.parts[1]
  if args.lid then
    local ok, lids = pcall(raise, self, cover, LID)
    if not ok then
      remove(self.parts)
      error(lids, 0)
    end
    self.lids = lids
  end
  return self
end)

local function stands(obstacle) return core.exists(obstacle) and obstacle.present end

function Channel:exists() return stands(self.object) end

local function is_closed(self) return self.lids ~= nil and stands(self.lids[1]) end

function properties.closed(self) return is_closed(self) end

local function all_parts(self)
  local list = table.move(self.parts, 1, #self.parts, 1, {})
  if is_closed(self) then table.move(self.lids, 1, #self.lids, #list + 1, list) end
  return list
end

-- Raises an error if a call that takes nothing got something, such as one of several wires.
local function nothing(verb, given, why)
  if given == nil then return end
  error(("channel:%s takes no argument, got %s; %s"):format(verb, checks.got(given), why), 0)
end

--- Returns the force of all wires on the channel and its lid [N].
function Channel:force(given)
  nothing("force", given, "it is the force of all wires")
  local sum = { 0, 0, 0 }
  for _, part in ipairs(all_parts(self)) do sum = add(sum, (part:force())) end
  return vector.of(sum)
end

local moment = rows.call("channel:moment", "{...}", "of all wires on it", {
  gives = "{x, y, z} [N m]", { "at", "vector", "m", "point about which it is taken",
    usual = "its first one" } })

--- Returns the moment of all wires on the channel about a point.
function Channel:moment(args)
  local at = moment:read(args == nil and {} or args).at or self.legs[1].from
  local sum = { 0, 0, 0 }
  for _, part in ipairs(all_parts(self)) do
    sum = add(sum, part:moment{ at = at })
  end
  return vector.of(sum)
end

-- True if the point is between the mitres of the leg, its walls, the floor and `top`.
local function within(self, i, p, top)
  local leg = self.legs[i]
  if dot(add(p, leg.from, -1), self.mitres[i]) < 0 or dot(add(p, leg.to, -1), self.mitres[i + 1]) > 0 then
    return false
  end
  local d = add(p, leg.from, -1)
  local z = dot(d, leg.up)
  return math.abs(dot(d, leg.side)) <= self.width / 2 and z >= 0 and z <= top
end

local SAMPLES = 200

-- Returns the share of the wire's length whose centre line is inside, up to `top`.
local function share(self, wire, top)
  local inside = 0
  for k = 1, SAMPLES do
    local p = wire:position(wire.length * (k - 0.5) / SAMPLES)
    for i = 1, #self.legs do
      if within(self, i, p, top) then
        inside = inside + 1
        break
      end
    end
  end
  return inside / SAMPLES
end

--- Returns the share of the wire's length whose centre line lies in the channel, in steps of 1/200.
function Channel:contains(wire)
  fixing.wire(self.scene, "channel:contains", "the argument", wire)
  return share(self, wire, self.depth)
end

-- Raises an error if the lid would cut into a wire.
local function check_lid(self)
  for _, entry in ipairs(build.data(self.scene).wires) do
    local wire = entry.object
    for k = 0, SAMPLES do
      local p = wire:position(math.min(wire.length, wire.length * k / SAMPLES))
      for i, leg in ipairs(self.legs) do
        local top = dot(add(p, leg.from, -1), leg.up) + wire.radius
        local low = top - 2 * wire.radius
        if top > self.depth * (1 + 1e-6) + 1e-5 and low < self.depth + self.thickness
          and within(self, i, add(p, leg.up, -(low + wire.radius)), self.depth) then
          error(("channel '%s': wire '%s' stands out by %.3g m at s = %.4g m; press it in before the lid "
            .. "goes on"):format(self.name, entry.name, top - self.depth, wire.length * k / SAMPLES), 0)
        end
      end
    end
  end
end

--- Puts the lid on; raises an error while a wire stands out.
function Channel:close(given)
  nothing("close", given, "it puts the whole lid on")
  build.check(self.scene, "channel:close", 3)
  if is_closed(self) then return self end
  check_lid(self)
  local parts = lid("channel", self)
  local count = (self.count or 0) + 1
  for _, part in ipairs(parts) do
    if count > 1 then part[1] = ("%s (%d)"):format(part[1], count) end
  end
  self.lids, self.count = raise(self, parts, LID), count
  return self
end

--- Takes the lid off.
function Channel:open(given)
  nothing("open", given, "it takes the whole lid off")
  build.check(self.scene, "channel:open", 3)
  remove(is_closed(self) and self.lids or {})
  return self
end

--- Removes the channel.
function Channel:release()
  build.check(self.scene, "channel:release", 3)
  remove(all_parts(self))
end

--- Adds rows to a run's summary.
function Channel:report(add_row)
  for _, entry in ipairs(build.data(self.scene).wires) do
    if core.exists(entry.object) then
      local part = share(self, entry.object, self.depth)
      if part > 0 then
        add_row(("%s: share of '%s' in it"):format(self.name, entry.name), part, "")
      end
    end
  end
end

function Channel:__tostring()
  if not self:exists() then return ("channel '%s' (released)"):format(self.name) end
  return ("channel '%s' of %d legs, %.4g m wide, %.4g m deep%s"):format(self.name, #self.legs, self.width,
    self.depth, is_closed(self) and ", closed" or "")
end

return Channel
