-- SPDX-License-Identifier: GPL-3.0-or-later
--- Chooses the mesh that replaces a pressed wire on each level of edges and steps, and estimates its cost.
-- @module softworld.model.mesh
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local flat = require "softworld.model.flat"
local number = require "softworld.output.number"
local record = require "softworld.scene.record"

local mesh = {}

mesh.springs, mesh.elements = 2, 3 -- rungs

local MARGIN = 6       -- length of a mesh beyond the pressed place, in radii [-]
local MOST = 0.6       -- share of a wire's length above which the whole wire becomes the mesh [-]
local COST = 1.2e-7    -- time of an iteration over slices and squared particles of a slice [s]
local ITERATIONS = 300 -- assumed for a run whose rods failed [-]
local BESIDE = 6       -- extra slices, beside clamps [-]
local SPRINGS = 0.35   -- spacing of a solid wire's springs [radii]
local ACROSS = 16      -- most cubes across a section [-]
local OUTERMOST = 0.9 -- largest radius of the particles of a wall, over the wire's radius [-]
local VOXELS = 2       -- cubes across a wall on the coarsest level [-]

-- Per level: particles round a slice, layers of them (grains only), spacing of slices [radii].
local rings = { { 8, 0.5 }, { 12, 0.35 }, { 16, 0.25 }, { 24, 0.18 }, { 32, 0.13 } }
local grains = { { 12, 2, 1 }, { 24, 4, 0.7 }, { 32, 5, 0.5 }, { 48, 6, 0.35 } } -- at most 6 layers

local function of_level(list, k) return list[math.min(k, #list)] end

-- Returns the arguments of wire:remodel, particles of a slice, and spacing [m].
local function solid(body, rung, k, share)
  if rung == mesh.springs then
    local K = body.known and flat.stiffness(body, share) or nil
    return { model = "radial", squeeze = K, spacing = SPRINGS * body.radius }, 17, SPRINGS * body.radius
  end
  local n, layers, spacing = table.unpack(of_level(grains, k))
  spacing = spacing * body.radius
  return { model = "radial", body = "solid", particles = n, layers = layers, spacing = spacing },
    1 + n * layers, spacing
end

local function hollow(body, rung, k)
  if rung == mesh.springs then
    local n, spacing = table.unpack(of_level(rings, k))
    spacing = spacing * body.radius
    return { model = "tube", core = false, particles = n, spacing = spacing,
      wall_bending = flat.wall_bending(body) }, n, spacing
  end
  local across = 2 * math.ceil(VOXELS * 2 ^ ((k - 1) / 2) * body.radius / body.wall - 1e-6)
  local size = 2 * body.radius / across
  local area = math.pi * (body.radius ^ 2 - body.inner ^ 2)
  return { model = "cubic", section = "annulus", inner = body.inner, body = "solid", across = across },
    math.ceil(1.5 * area / size ^ 2), size
end

local function plan(body, rung, k, share)
  return (body.inner and hollow or solid)(body, rung, k, share)
end

--- Returns where a wire pressed from s1 to s2 becomes a mesh: { from, to } [m]; nil: everywhere.
function mesh.region(wire, s1, s2)
  local margin = MARGIN * wire.radius
  local from, to = math.max(0, s1 - margin), math.min(wire.length, s2 + margin)
  if to - from > MOST * wire.length then return nil end
  return { from, to }
end

--- Returns the expected time of a run on level k with a wire that becomes a mesh [s]. iterations: of the
-- first level of an earlier run, or nil. Infinite: there is no such mesh.
function mesh.time(w, rung, k, iterations)
  local args, particles, spacing = plan(w.body, rung, k, w.share)
  local none = rung == mesh.elements and not w.body.inner and k > #grains
  if none or (args.across or 0) > ACROSS then return math.huge end
  local length = w.region and w.region[2] - w.region[1] or w.length
  local slices = math.max(2, length / spacing) + BESIDE
  return (iterations or ITERATIONS) * 2 ^ (k - 1) * COST * slices * particles ^ 2
end

-- Returns the message without the script's line, which asked for something else.
local function plain(message) return (tostring(message):gsub("^[^\n]-:%d+: ", "")) end

-- True if the region must be left out: lines beside a region carry no twist, and a clamp may be too near.
local function takes_all(reason) return tostring(reason):find("leave region out", 1, true) end

-- Returns why a tube's wall cannot be meshed, or nil: the radius with the tube's EI and EA may be too far
-- out.
local function too_thin(w)
  local r, inner = w.body.radius, w.body.inner
  local middle = inner and ((r ^ 2 + inner ^ 2) / 2) ^ 0.5 or 0
  if middle <= OUTERMOST * r then return nil end
  return ("the wall of '%s', %s thick, is too thin for a mesh: its middle is at a radius of %s, and a mesh "
    .. "has particles up to radius = %s only"):format(w.object.name, number.text(r - inner, "m"),
    number.text(middle, "m"), number.text(OUTERMOST * r, "m"))
end

--- Makes the mesh; w = { object, body, share, region }. Returns why it cannot be made, or nil.
function mesh.make(w, rung, k, whole)
  if rung == mesh.elements and w.body.cable then
    return ("no two materials have the EA and EI of '%s', because its strands slide"):format(w.object.name)
  end
  local thin = too_thin(w)
  if thin then return thin end
  local args, _, spacing = plan(w.body, rung, k, w.share)
  local was = { model = w.object.model, segments = core.segments(w.object) }
  local slices = math.max(2, math.ceil(w.object.length / spacing - 1e-6))
  args.region = not whole and w.region or nil
  args.segments = args.region and was.segments or slices
  local fine, why = pcall(record.quietly, w.object.remodel, w.object, args)
  if not fine and args.region and takes_all(why) then
    args.region, args.segments = nil, slices
    fine, why = pcall(record.quietly, w.object.remodel, w.object, args)
  end
  if not fine and checks.is_interrupt(why) then error(why, 0) end
  if not fine then return plain(why) end
  was.mesh = w.object.model
  core.data(w.object).line = was
end

--- Turns wires that an earlier run left as a mesh back into lines, for a run that chooses again.
function mesh.undo(scene)
  for _, w in ipairs(build.data(scene).wires) do
    local kept = core.exists(w.object) and core.data(w.object)
    local was = kept and kept.line
    if was and was.mesh == w.object.model then
      record.quietly(w.object.remodel, w.object, { model = was.model, segments = was.segments })
    end
    if kept then kept.line = nil end
  end
end

return mesh
