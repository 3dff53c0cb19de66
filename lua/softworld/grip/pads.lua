-- SPDX-License-Identifier: GPL-3.0-or-later
--- Pads of grippers: rigid fingers in the tool's axes. x is along the wire, fingers close along
-- y (more than two: around x), z is up; the opening is between the faces of facing fingers.
-- @module softworld.grip.pads
local checks = require "softworld.checks"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local meshfile = require "softworld.meshfile"
local counted = require "softworld.output.number".count
local rows = require "softworld.rows"
local vec = require "softworld.vec"

local pads = {}
local turn = vec.turn
local X = { 1, 0, 0 }

-- Functions that return the parts of one finger that opens towards +y: shape, and its place at opening zero.
local makers = {}

--- A plate: width along the wire, height, thickness.
function makers.flat(p)
  return { { shape = "box", size = { p.width, p.thickness, p.height },
    at = { 0, p.thickness / 2, p.height / 2 - p.below } } }
end

--- A groove along the wire between two plates at an angle; the opening is measured between the bottoms.
function makers.v(p)
  local parts, lean = {}, math.pi / 2 - p.angle / 2
  for _, side in ipairs{ -1, 1 } do
    local q = turn(X, side * lean) -- the plate's outward normal is -y turned by this
    local along, out = vec.rotate(q, { 0, 0, side }), vec.rotate(q, { 0, 1, 0 })
    local at = vec.add(vec.scale(along, p.height / 2), out, p.thickness / 2)
    parts[#parts + 1] = { shape = "box", size = { p.width, p.thickness, p.height }, at = at,
      rotation = q }
  end
  return parts
end

--- A pin across the wire.
function makers.round(p)
  return { { shape = "cylinder", radius = p.radius, length = p.height,
    at = { 0, p.radius, p.height / 2 - p.below } } }
end

--- A finger from a mesh file; the mesh's axes are the tool's, for the finger at +y.
function makers.mesh(p)
  local mesh = meshfile.read(p.file)
  return { { shape = "mesh", data = mesh.data, format = mesh.format, scale = p.scale,
    at = { 0, 0, 0 } } }
end

pads.kinds = makers

local USUAL_RADIUS = 0.005 -- of wires, for fingers that are made without one [m]
local MOST = 1e3 -- longest size; the core makes no longer obstacles [m]

--- Parameters of pads.
pads.rows = rows.list{
  { "shape", "choice", "-", "of a finger", choices = { "flat", "mesh", "round", "v" }, default = "flat" },
  { "fingers", "integer", "-", "how many close on the wire", min = 1, max = 6, default = 2 },
  { "width", "number", "m", "along the wire", min = 0, max = MOST, default = 0.02 },
  { "height", "number", "m", "across the wire", min = 0, max = MOST, above = true,
    usual = "0.02; of v twice the wire's radius" },
  { "thickness", "number", "m", "of flat and v", min = 0, max = MOST, above = true, default = 0.008 },
  { "below", "number", "m", "how far fingers reach below the tool's centre", min = 0, max = MOST,
    usual = "half of height, or 0.9 of the wire's radius" },
  { "opening", "number", "m", "between facing fingers while open", min = 0, max = MOST, above = true,
    usual = "4 times the wire's radius" },
  { "radius", "number", "m", "of round ones", min = 0, max = MOST, above = true, default = 0.004 },
  { "angle", "number", "rad", "of v, between its sides", min = 0, max = math.pi, above = true,
    default = 2 * math.pi / 3 },
  { "file", "text", "-", "mesh file of the finger at +y, in the tool's axes" },
  { "scale", "number", "-", "metres per unit of the mesh file", min = 0, above = true, default = 1 },
  { "friction", "numbers", "-", "friction coefficient on the wire; a list has one for each finger", min = 0,
    max = 100,
    default = 0.5 },
  { "kinetic_friction", "numbers", "-", "friction coefficient while the wire slides; a list has one for each "
    .. "finger", min = 0,
    max = 100, usual = "friction" },
  { "restitution", "number", "-", "share of the approach speed kept in an impact", min = 0, max = 1,
    default = 0 },
}

--- Parameters of an arm.
pads.arm_rows = rows.list{
  { "radius", "number", "m", "of the capsule", min = 0, max = MOST, above = true, required = true },
  { "length", "number", "m", "upwards from the fingers", min = 0, max = MOST, above = true, required = true },
}

--- Returns the description of pads with defaults; raises an error for impossible ones. Errors have no place.
function pads.check(args, what)
  local p = pads.rows:read(args, what, what .. ".")
  for _, key in ipairs{ "friction", "kinetic_friction" } do -- may be lists, one value per finger
    if type(p[key]) == "table" and #p[key] ~= p.fingers then
      error(("%s.%s has %s; it must have one, or one for each of %s"):format(what, key,
        counted(#p[key], "value"), counted(p.fingers, "finger")), 0)
    end
  end
  if (p.shape == "mesh") ~= (args.file ~= nil) then
    error(("%s: file goes with shape = 'mesh'"):format(what), 0)
  end
  if p.file ~= nil then -- reports a wrong file at once, not when the pads are made
    local fine, why = pcall(function()
      local mesh = meshfile.read(p.file)
      core.shape{ shape = "mesh", data = mesh.data, format = mesh.format, scale = p.scale }
    end)
    if not fine then error(("%s: %s"):format(what, meshfile.named(build.plain(why), p.file)), 0) end
  end
  return p
end

-- Returns a capsule that goes up from the fingers: an obstacle's description.
local function arm_part(name, arm, at, q, base)
  local middle = { 0, 0, base + arm.radius + arm.length / 2 }
  return { name = checks.part_name(name, ".arm"), shape = "capsule", radius = arm.radius,
    length = arm.length, at = vec.add(at, vec.rotate(q, middle)), rotation = q, friction = 0.3 }
end

-- Adds the parts of a finger to a list: obstacles' descriptions, how far each moves per opening, its finger.
local function add_finger(list, name, p, given, finger, at, q, opening)
  local around = turn(X, 2 * math.pi * (finger - 1) / p.fingers)
  local opens = vec.rotate(around, { 0, 0.5, 0 })
  local mirrored = p.fingers == 2 and finger == 2 and p.shape ~= "mesh"
  local function of_finger(value) return type(value) == "table" and value[finger] or value end
  for number, part in ipairs(makers[p.shape](given)) do
    local place = mirrored and { part.at[1], -part.at[2], part.at[3] } or vec.rotate(around, part.at)
    local facing = part.rotation or { 1, 0, 0, 0 }
    if mirrored then facing = { facing[1], -facing[2], facing[3], -facing[4] }
    else facing = vec.multiply(around, facing) end
    part.at = vec.add(at, vec.rotate(q, vec.add(place, opens, opening)))
    part.rotation = vec.multiply(q, facing)
    part.friction, part.kinetic_friction = of_finger(p.friction), of_finger(p.kinetic_friction)
    part.restitution = p.restitution
    part.name = checks.part_name(name, (".finger%d%s"):format(finger, number > 1 and "." .. number or ""))
    list[#list + 1] = { part = part, finger = finger, opens = opens }
  end
end

local function check_width(gripper)
  local p = gripper.pads
  if (p.shape == "flat" or p.shape == "v") and p.width <= 0 then
    error(("gripper '%s': pads.width = %g m is that of an imposed grip; fingers need a width above 0 m")
      :format(gripper.name, p.width), 0)
  end
end

-- Returns the distance of the faces while open [m].
local function opening_of(gripper, radius) return gripper.pads.opening or 4 * (radius or USUAL_RADIUS) end

-- Returns what open pads at a pose are made of: a list of { part, finger, opens }, the opening, and from
-- where to where along the tool's z the fingers reach (nil: they are a mesh) [m].
local function draft(gripper, at, q, radius)
  local name, p = gripper.name, gripper.pads
  local opening = opening_of(gripper, radius)
  radius = radius or USUAL_RADIUS
  local height = p.height or (p.shape == "v" and 2 * radius or 0.02)
  local given = { width = p.width, height = height, thickness = p.thickness, radius = p.radius,
    angle = p.angle, file = p.file, scale = p.scale,
    below = p.below or math.min(height / 2, 0.9 * radius) }
  local list = {}
  for finger = 1, p.fingers do add_finger(list, name, p, given, finger, at, q, opening) end
  if gripper.arm then
    list[#list + 1] = { part = arm_part(name, gripper.arm, at, q, height - given.below), finger = 0,
      opens = { 0, 0, 0 } }
  end
  return list, opening, p.shape ~= "mesh" and { -given.below, height - given.below } or nil
end

-- Returns the components of a list, which may have names instead of numbers.
local function components(list, names)
  local out = {}
  for i, name in ipairs(names) do out[i] = list[i] or list[name] end
  return out
end

--- Returns a rotation as a unit quaternion.
function pads.quaternion(rotation)
  if not rotation then return { 1, 0, 0, 0 } end
  if rotation.axis then
    return turn(vec.unit(components(rotation.axis, { "x", "y", "z" })), rotation.angle)
  end
  local q, square = components(rotation, { "w", "x", "y", "z" }), 0
  for i = 1, 4 do square = square + q[i] ^ 2 end
  for i = 1, 4 do q[i] = q[i] / square ^ 0.5 end
  return q
end

local not_of_shape = { at = true, rotation = true, friction = true, kinetic_friction = true,
  restitution = true, name = true }

--- Returns the solids of open pads at a pose, without making them: a list of { name, shape, at, q }, the
-- opening [m], and the rotation as a quaternion.
function pads.solids(gripper, at, rotation, radius)
  check_width(gripper)
  local q, solids = pads.quaternion(rotation), {}
  local list, opening = draft(gripper, at, q, radius)
  for i, entry in ipairs(list) do
    local sizes = {}
    for key, value in pairs(entry.part) do
      if not not_of_shape[key] then sizes[key] = value end
    end
    solids[i] = { name = entry.part.name, shape = core.shape(sizes), at = entry.part.at,
      q = entry.part.rotation }
  end
  return solids, opening, q
end

--- Makes a gripper's tool and fingers in the scene, open, at a pose. Returns the tool, its obstacles, the
-- opening, and from where to where along the tool's z its fingers reach (nil: they are a mesh) [m].
function pads.make(scene, gripper, at, rotation, radius)
  check_width(gripper)
  local tool = scene:tool{ name = gripper.name, at = at, rotation = rotation,
    opening = opening_of(gripper, radius) }
  local obstacles, _, q = {}, tool:pose()
  local list, opening, span = draft(gripper, at, q, radius)
  for i, entry in ipairs(list) do
    obstacles[i] = scene:obstacle(entry.part)
    tool:pad(obstacles[i], entry.finger, entry.opens)
  end
  return tool, obstacles, opening, span
end

return pads
