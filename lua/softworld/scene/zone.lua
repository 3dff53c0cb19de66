-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:zone{ shape =, at =, ... }: a part of space in which wires are watched. See help "check".
-- @module softworld.scene.zone
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local meshfile = require "softworld.meshfile"
local rows = require "softworld.rows"
local solid = require "softworld.output.solid"
local vec = require "softworld.vec"

rows.calls{
  { "scene:zone", "{ shape =, at =, temperature = }", "a part of space that nothing touches: wires are to "
    .. "keep out of it, or have its temperature [degC]; see help 'check'", "its name",
    example = 'scene:zone { name = "oven", shape = "box", size = { 1, 1, 1 }, temperature = 90 }' },
}

local AROUND = 24     -- points around a round zone that is drawn
local PIECE = 0.5     -- half of the square that is drawn of a half space [m]

local NOT_OF_SHAPE = { name = true, at = true, rotation = true, temperature = true }

-- What is drawn of a zone: its surface in its own axes, and where it is.
local function look_of(args, name)
  local shape, q = {}, args.rotation or { 1, 0, 0, 0 }
  for key, value in pairs(args) do
    if not NOT_OF_SHAPE[key] then shape[key] = value end
  end
  if q.axis then q = vec.turn(vec.unit(q.axis), q.angle) end
  q = { q[1] or q.w, q[2] or q.x, q[3] or q.y, q[4] or q.z }
  local entry = { name = name, shape = "mesh", kind = shape.shape, temperature = args.temperature }
  local at = args.at or { 0, 0, 0 }
  entry.position, entry.rotation = { at[1] or at.x, at[2] or at.y, at[3] or at.z }, q
  local surface = entry
  if solid.flat(shape) then
    surface = solid.plane_piece({ normal = shape.normal }, nil, { 0, 0, 0 }, PIECE)
  elseif shape.data then
    local mesh <close> = core.shape(shape)
    solid.keep(entry, mesh)
  else
    surface = solid.triangles(shape, AROUND)
  end
  entry.vertices, entry.indices = surface.vertices, surface.indices
  return entry
end

local function make(scene, args)
  if checks.kind(args) ~= "table" then
    error("scene:zone takes one table of parameters, got " .. checks.kind(args), 0)
  end
  local own = {}
  for key, value in pairs(args) do own[key] = value end
  if own.file ~= nil then
    local mesh = meshfile.read(own.file)
    own.data, own.format, own.file = mesh.data, own.format or mesh.format, nil
  end
  local fine, result = pcall(core.zone, scene, own)
  if not fine then error((build.plain(result):gsub("^obstacle", "zone", 1)), 0) end
  local data = build.data(scene)
  data.zones = data.zones or {}
  data.zones[#data.zones + 1] = look_of(own, result)
  return result
end

--- A part of space that nothing touches: run:check tells how near wires came to it.
function core.class.scene.zone(scene, args)
  build.check(scene, "scene:zone", 3)
  return build.call(3, make, scene, args)
end
