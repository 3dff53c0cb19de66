-- SPDX-License-Identifier: GPL-3.0-or-later
-- What the contract specs share: arguments made from parameter rows, random shapes with fixed seeds, small
-- vector tools.
local sw = require "softworld"
local core = sw.core

local samples = {}

-- A random generator that gives the same numbers whatever ran before (Park and Miller).
function samples.random(seed)
  local state = seed * 7919 % 2147483647 + 1
  return function(low, high)
    state = state * 48271 % 2147483647
    return low + (high - low) * state / 2147483647
  end
end

-- Returns a value that the row allows, away from its limits where possible.
local function value_of(row, random)
  if row.type == "vector" then return { random(-1, 1), random(-1, 1), random(-1, 1) } end
  if row.type == "boolean" then return true end
  if row.type == "choice" then return row.choices[1] end
  if row.type == "number" or row.type == "integer" then
    local low, high = row.min or -1, row.max or (row.min and row.min + 1) or 1
    if high - low > 100 then high = low + 1 end -- everyday sizes, not those of the limit
    local value = low + (high - low) * random(0.3, 0.7)
    if row.type == "integer" then return math.ceil(value) end
    return value
  end
end

--- Returns arguments for every row with a plain value (not texts and what the binding reads itself).
function samples.arguments(rows, random)
  local args = {}
  for _, row in ipairs(rows) do args[row.name] = value_of(row, random) end
  return args
end

--- Arguments of a hold at s [m]; a slider also needs its rail.
function samples.hold(hold, s)
  return { s = s or 0.5, direction = hold.name == "slider" and { 1, 0, 0 } or nil }
end

--- Arguments of a force as scene:force takes them.
function samples.force(force, index)
  local args = samples.arguments(force.params, samples.random(index))
  args.kind = force.name
  if force.on_some then args.particles = { 3, 1, 7 } end
  if args.yield then args.yield = 0.02 end -- so small that the shapes tested go beyond it
  if force.name == "moment" then -- so small that it does not whirl the wire while this is used
    for k = 1, 3 do args.moment[k] = 0.1 * args.moment[k] end
  end
  if force.name == "clip" or force.name == "snap" then -- around the whole wire, at a slant
    args.at, args.direction, args.axis, args.width = { 0.45, 0, -0.2 }, { 0.1, 0.2, 1 }, { 1, 0, 0 }, 3
    args.insertion, args.retention, args.way, args.radius = 3, 5, 1.5, 0.05
    if force.name == "clip" then args.stiffness = 40 else args.way, args.radius = 8, 3 end
  end
  return args
end

--- Returns the arguments of an obstacle from its kind's sample, or from text.
function samples.obstacle(shape, text)
  local args = assert(load(("return { %s }"):format(text or shape.sample)))()
  args.shape = shape.name
  return args
end

--- Iterates over the names and Lua texts of the values in a shape's sample, in order.
function samples.written(shape)
  local text, at = shape.sample .. ", ", 1
  return function()
    local name, value, after = text:match("^(%w+) = (%b{}), ()", at)
    if not name then name, value, after = text:match("^(%w+) = (%b''), ()", at) end
    if not name then name, value, after = text:match("^(%w+) = (.-), ()", at) end
    at = after or at
    return name, value
  end
end

--- Seven particles in a row along x that springs and a fold hold together.
function samples.sheet(scene)
  return scene:particles{ positions = { 0, 0, 1, 0.1, 0, 1, 0.2, 0, 1, 0.3, 0, 1, 0.4, 0, 1, 0.5, 0, 1,
    0.6, 0, 1 }, masses = 0.01, links = { { pairs = { 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7 }, k = 100 } },
    folds = { { 1, 2, 3, stiffness = 0.01 } } }
end

--- Models that are meshes of particles, by name.
samples.meshes = {}

--- Values of the sample wire. A mesh needs a section as thick as EI/EA demands, and chooses its own slices.
function samples.values(model)
  local mesh = samples.meshes[model]
  return { EA = 60, EI = 0.02, mass_per_length = 0.1, radius = mesh and 0.05 or 0.005,
    model = model }
end

--- A wire of 1 m along x in a scene, soft enough for differences of its energy.
function samples.wire(options)
  local scene = sw.scene{ gravity = options.gravity or { 0, 0, 0 } }
  local args = samples.values(options.model)
  args.from, args.to = { 0, 0, 0 }, { 1, 0, 0 }
  if not samples.meshes[options.model] then args.segments = options.segments end
  args.bend = options.bend
  for key, value in pairs(options.more or {}) do args[key] = value end
  return scene, scene:wire(args)
end

--- Positions of a mesh's particles, stretched and shaken by up to `shake` [m].
function samples.shaken(wire, stretch, shake, random)
  local x = core.type(wire) == "particles" and wire:positions() or wire:particles()
  for i = 1, #x do x[i] = stretch * x[i] + random(-shake, shake) end
  return x
end

--- Node positions along edges of a given stretch; the direction turns by up to `turn` [rad] at every node.
function samples.shape(segments, stretch, turn, random)
  local x, d = { 0.1, -0.2, 0.3 }, { 1, 0, 0 }
  for _ = 1, segments do
    local axis = { random(-1, 1), random(-1, 1), random(-1, 1) }
    local along = axis[1] * d[1] + axis[2] * d[2] + axis[3] * d[3]
    local across, size = {}, 0
    for k = 1, 3 do
      across[k] = axis[k] - along * d[k]
      size = size + across[k] ^ 2
    end
    local angle = turn * random(0.9, 1)
    local norm = 0
    for k = 1, 3 do
      d[k] = math.cos(angle) * d[k] + math.sin(angle) * across[k] / size ^ 0.5
      norm = norm + d[k] ^ 2
    end
    local l = stretch * random(0.95, 1.05) / segments / norm ^ 0.5
    for k = 1, 3 do
      d[k] = d[k] / norm ^ 0.5
      x[#x + 1] = x[#x - 2] + l * d[k]
    end
  end
  return x
end

function samples.flat(n, size, random)
  local list = {}
  for i = 1, n do list[i] = random(-size, size) end
  return list
end

function samples.along(x, d, h)
  local y = {}
  for i = 1, #x do y[i] = x[i] + h * d[i] end
  return y
end

function samples.dot(a, b)
  local sum = 0
  for i = 1, #a do sum = sum + a[i] * b[i] end
  return sum
end

function samples.norm(a) return samples.dot(a, a) ^ 0.5 end

--- Largest difference of two arrays over the larger of their norms (at least floor).
function samples.apart(a, b, floor)
  local largest = 0
  for i = 1, #a do largest = math.max(largest, math.abs(a[i] - b[i])) end
  return largest / math.max(samples.norm(a), samples.norm(b), floor)
end

--- Total force and moment about the origin of flat forces at flat positions.
function samples.resultant(x, f)
  local force, moment = { 0, 0, 0 }, { 0, 0, 0 }
  for i = 1, #x, 3 do
    for k = 1, 3 do
      local j, l = k % 3 + 1, (k + 1) % 3 + 1
      force[k] = force[k] + f[i + k - 1]
      moment[k] = moment[k] + x[i + j - 1] * f[i + l - 1] - x[i + l - 1] * f[i + j - 1]
    end
  end
  return force, moment
end

--- Every vector turned by a fixed rotation, then shifted.
function samples.turned(x, shift)
  local c, s, c2, s2 = math.cos(1.1), math.sin(1.1), math.cos(-0.6), math.sin(-0.6)
  local y = {}
  for i = 1, #x, 3 do
    local a, b, z = c * x[i] - s * x[i + 1], s * x[i] + c * x[i + 1], x[i + 2]
    y[i], y[i + 1], y[i + 2] = a + shift, c2 * b - s2 * z + shift, s2 * b + c2 * z - shift
  end
  return y
end

function samples.zeros(n)
  local list = {}
  for i = 1, n do list[i] = 0 end
  return list
end

samples.type = core.type
samples.registry = core.registry()
for _, model in ipairs(samples.registry.models) do samples.meshes[model.name] = model.mesh end

return samples
