-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:describe: the parts of a scene as a plain table.
-- @module softworld.scene.describe
local core = require "softworld.core"
local build = require "softworld.scene.build"
local fixing = require "softworld.link.fixing"
local record = require "softworld.scene.record"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local vector = require "softworld.vector"

local describe = {}

rows.calls{
  { "scene:describe", "", "the parts of the scene, as a plain table without objects and functions",
    "name, time [s], gravity [m/s2], and lists: wires, particles, obstacles, holds, forces, joins, fixings, "
      .. "grippers; each item has name or kind, given (values of the script) and now (present values); "
      .. "lacks: what a file that the scene was read from does not tell",
    example = "for _, w in ipairs(scene:describe().wires) do print(w.name, w.now.length) end" },
}

local function name_of(value)
  local fine, name = pcall(function()
    return type(value) == "table" and rawget(sealed.fields(value), "name") or value.name
  end)
  return fine and name or nil
end

-- Replaces objects by their names and functions by the word "function". above: tables that contain the value.
local function plain(value, above)
  local kind = type(value)
  if kind == "number" or kind == "string" or kind == "boolean" then return value end
  if value == record.a_function then return "function" end
  above = above or {}
  local of = record.trajectory(value)
  if of then return plain(of.args[1], above) end
  if not vector.is_plain(value) or above[value] then
    return name_of(value) or tostring(value)
  end
  local copy = {}
  above[value] = true
  for key, item in next, value do
    copy[type(key) == "userdata" and tostring(key) or key] = plain(item, above)
  end
  above[value] = nil
  return copy
end

-- Returns the tables of parameters by the object that a call of the scene made.
local function given_of(scene)
  local given = {}
  for _, call in ipairs(record.of(scene)) do
    local object = call.results[1]
    local args = call.args[call.args.n]
    if rawequal(call.self, scene) and object ~= nil then
      given[object] = { kind = call.method, args = type(args) == "table" and args or {},
        wire = call.args.n > 1 and call.args[1] or nil }
    end
  end
  return given
end

local function of_wire(w)
  return { model = w.model, length = w.length, radius = w.radius, segments = w.segments,
    cable = w:cable() and w:cable().name or nil }
end

local function of_particles(p) return { count = p.count, mass = p.mass, radius = p.radius } end

local function of_hold(hold) return { kind = hold.kind, held = hold.held } end

local function item(object, name, given, now)
  local made = given[object]
  local one = { name = name, given = made and plain(made.args) or nil,
    wire = made and made.wire and plain(made.wire) or nil }
  one.now = now(object)
  return one
end

local function list_of(entries, given, now)
  local list = {}
  for _, entry in ipairs(entries) do
    if core.exists(entry.object) then list[#list + 1] = item(entry.object, entry.name, given, now) end
  end
  return list
end

local function obstacles_of(data, given)
  local list = list_of(data.obstacles, given, function(o)
    return o.present and plain(o:get()) or {}
  end)
  local at = 0
  for _, entry in ipairs(data.obstacles) do
    if core.exists(entry.object) then
      at = at + 1
      list[at].shape, list[at].now.present = entry.shape, entry.object.present
    end
  end
  return list
end

-- Returns the forces of the script: those that it made, and of a file all but those of clips and ties.
local function forces_of(scene, given)
  local list, inner, from_file = {}, {}, record.made_as(scene) == nil
  for _, it in ipairs(fixing.all(scene)) do
    local own = sealed.fields(it)
    inner[rawget(own, "object") or false], inner[rawget(own, "damper") or false] = true, true
  end
  for _, force in ipairs(scene:forces()) do
    if core.exists(force) and (given[force] or from_file and not inner[force]) then
      local one = item(force, nil, given, function(f) return plain(f:get()) end)
      one.kind, one.now.held = force.kind, force.held
      list[#list + 1] = one
    end
  end
  return list
end

local function fixings_of(scene, given)
  local list = {}
  for _, it in ipairs(fixing.all(scene)) do
    local one = item(it, it.name, given, function() return {} end)
    one.kind = getmetatable(it).__name
    list[#list + 1] = one
  end
  return list
end

local function grippers_of(data, given)
  local list = {}
  for _, gripper in ipairs(data.grippers) do
    if not gripper.left then
      list[#list + 1] = item(gripper, gripper.name, given, function(g) return plain(g:get()) end)
    end
  end
  return list
end

local LACKS = "given and wire of all that was read from a file, which does not keep them"

-- Returns what is not known of a scene whose objects are from a file.
local function lacking(data, given)
  for _, list in ipairs{ data.wires, data.particles } do
    for _, entry in ipairs(list) do
      if core.exists(entry.object) and not given[entry.object] then return LACKS end
    end
  end
end

local function of_scene(scene)
  if core.type(scene) ~= "scene" then error("scene:describe is a method: call it with a colon", 0) end
  local data = build.data(scene)
  local given = given_of(scene)
  return { name = scene.name, time = scene.time, gravity = plain(scene:gravity()),
    wires = list_of(data.wires, given, of_wire),
    particles = list_of(data.particles, given, of_particles),
    obstacles = obstacles_of(data, given), holds = list_of(data.holds, given, of_hold),
    forces = forces_of(scene, given), joins = list_of(data.joins, given, function() return {} end),
    fixings = fixings_of(scene, given), grippers = grippers_of(data, given), lacks = lacking(data, given) }
end

--- scene:describe(): see help "scene:describe".
describe.describe = build.placed(of_scene)

return describe
