-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:zone{ shape =, at =, ... }: a part of space in which wires are watched. See help "zones".
-- @module softworld.scene.zone
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"
local meshfile = require "softworld.meshfile"
local rows = require "softworld.rows"
local solid = require "softworld.output.solid"

rows.calls{
  { "scene:zone", "{ shape =, at =, temperature =, on = }", "a part of space that does not touch wires: they "
    .. "must keep out of it, or it has a temperature [degC]; see help 'check'", "its name",
    example = 'scene:zone { name = "oven", shape = "box", size = { 1, 1, 1 }, temperature = 90 }' },
}

local AROUND = 24     -- points around a drawn round zone
local PIECE = 0.5     -- half the side of the square that is drawn of a half space [m]

-- Returns what is drawn of a zone: its surface in its own axes, and its place. on: { slot = of the obstacle
-- that the zone moves with, position =, rotation = in that obstacle's axes }.
local function look_of(args, name, shape, position, rotation, on)
  local surface
  if solid.flat(args) then
    local normal = checks.vector("zone: normal", args.normal or { 0, 0, 1 }, "-", 0)
    surface = solid.plane_piece({ normal = normal }, nil, { 0, 0, 0 }, PIECE)
  else
    surface = solid.of_shape(shape, AROUND)
  end
  shape:close()
  return { name = name, shape = "mesh", kind = args.shape, temperature = args.temperature, on = on,
    position = position, rotation = rotation, vertices = surface.vertices, indices = surface.indices }
end

local function make(scene, args)
  if checks.kind(args) ~= "table" then
    error("scene:zone takes one table of parameters, got " .. checks.kind(args), 0)
  end
  local own = inherited.copy(args)
  if own.name ~= nil then checks.name("scene:zone: name", own.name, 0) end
  local name, shape, position, rotation, slot, within, turned = meshfile.make("zone", own.name, own,
    function(all) return core.zone(scene, all) end)
  local data = build.data(scene)
  data.zones = data.zones or {}
  data.zones[#data.zones + 1] = look_of(own, name, shape, position, rotation,
    slot and { slot = slot, position = within, rotation = turned })
  return name
end

--- Adds a part of space that nothing touches; run:check reports how near wires came to it.
function core.class.scene.zone(scene, args)
  build.check(scene, "scene:zone", 3)
  return build.call(3, make, scene, args)
end
