-- SPDX-License-Identifier: GPL-3.0-or-later
--- Makes objects on the Lua side: names, mesh files, descriptions for pictures and series, and the Lua
-- state that snapshots keep.
-- @module softworld.scene.build
local blame = require "softworld.scene.blame"
local core = require "softworld.core"
local cable = require "softworld.cable"
local checks = require "softworld.checks"
local inherited = require "softworld.inherited"
local keep = require "softworld.scene.keep"
local meshfile = require "softworld.meshfile"
local remarks = require "softworld.remarks"
local solid = require "softworld.output.solid"
local with_body = require "softworld.wire.body"

local build = { call = blame.call, through = blame.through, placed = blame.placed, plain = blame.plain }
local class = core.class

--- Lists of build.data that only grow: { object =, name =, ... } of each object made.
build.lists = { "wires", "particles", "obstacles", "holds", "grippers", "joins", "fixings" }
--- Fields of build.data that belong to the process, not to the scene.
build.passing = { processes = true, process_count = true, running = true, saving = true, going = true,
  restores = true, from_file = true, read = true }
-- How snapshots keep these fields, see keep.image.
local imaged = { lists = build.lists, things = { "grippers", "fixings" }, whole = { "origin" },
  passing = { origin = true } }
for name in pairs(build.passing) do imaged.passing[name] = true end
for _, name in ipairs(build.lists) do imaged.passing[name] = true end

--- Returns the Lua side's data of a scene: lists of { object =, name =, ... }.
function build.data(scene)
  local data = core.data(scene)
  if not data.wires then
    for _, name in ipairs(build.lists) do data[name] = {} end
    data.processes = {}
    data.restores = 0 -- how often a snapshot was restored
  end
  return data
end

-- Raises an error in a function that reads a run which has ended, see softworld.run.reading.
local function check_reading(scene, what)
  local read = build.data(scene).read
  if read then read.refuse(what) end
end

local function check_scene(scene, what)
  if core.type(scene) ~= "scene" then
    error(("%s is a method: call it with a colon, scene:%s"):format(what, what:match ":(.*)"), 0)
  end
  local busy, observed = core.busy(scene)
  if busy then
    error(("%s: scene '%s' cannot be changed %s"):format(what, scene.name, observed
      and "inside an observer's function; use observer:change(function() ... end)"
      or "from inside a step or a function of time"), 0)
  end
  if what ~= "scene:save" then check_reading(scene, what) end
  if build.guard then build.guard(what) end -- set by softworld.run.process, which may keep steps
end

--- Raises an error unless scene may be changed at this moment.
function build.check(scene, what) build.call(3, check_scene, scene, what) end

--- Raises an error if the wire has left its scene; for a removed wire the error says when.
function build.present(wire)
  if not wire.present then wire:positions() end
end

--- Raises an error unless the wire is in the scene. what: how the error begins.
function build.own(scene, what, wire)
  if not rawequal((select(4, core.number(wire))), scene) then error(what .. " another scene", 0) end
  build.present(wire)
end

local function copy(t)
  local c = {}
  for k, v in pairs(t) do c[k] = v end
  return c
end

local function table_of(args, what)
  if args == nil then return {} end
  if type(args) == "table" then return build.call(4, inherited.copy, args, nil, what) end
  error(("%s takes one table of parameters, got %s"):format(what, type(args)), 3)
end

-- Lists only grow, or are replaced by new ones.
local listed = setmetatable({}, { __mode = "k" }) -- list -> { count = entries read, names = set }

local function is_in(list, name)
  local known = listed[list]
  if not known then
    known = { count = 0, names = {} }
    listed[list] = known
  end
  for i = known.count + 1, #list do known.names[list[i].name or false] = true end
  known.count = #list
  return known.names[name] or false
end

local function is_taken(data, name)
  return is_in(data.wires, name) or is_in(data.particles, name) or is_in(data.obstacles, name)
    or is_in(data.holds, name) or is_in(data.grippers, name) or is_in(data.fixings, name)
end

--- Returns the name to use: the given one, which must be new, or kind and a number.
-- Names distinguish objects in series and messages.
function build.name(scene, given, kind, count, level)
  local data = build.data(scene)
  if given == nil then
    repeat count = count + 1 until not is_taken(data, kind .. count)
    return kind .. count
  end
  if type(given) ~= "string" then return given end -- refused by the reader of the arguments
  checks.name(kind .. ": name", given, level > 0 and level + 1 or 0)
  if is_taken(data, given) then
    error(("scene '%s' already has something named '%s'"):format(scene.name, given), level)
  end
  return given
end

local cable_words, wire_words = { "cable", "stiffness", "use" }, nil

-- Proposes a cable word for a misspelt key. The core reports unknown keys but does not know these Lua words.
local function check_cable_words(args)
  if not wire_words then
    wire_words = { from = true, to = true, path = true }
    local rows = core.registry().params
    for _, list in ipairs{ rows.wire, rows.section, rows.wire_mesh, rows.calibrate_tube,
      rows.calibrate_radial, rows.calibrate_cubic, rows.calibrate_composite } do
      for _, row in ipairs(list) do wire_words[row.name] = true end
    end
    for _, word in ipairs(cable_words) do wire_words[word] = true end
  end
  for key in pairs(args) do
    local near = type(key) == "string" and not wire_words[key] and core.nearest(key, cable_words)
    if near then error(("wire: there is no parameter '%s'; did you mean '%s'?"):format(key, near), 0) end
  end
end

-- Replaces cable, stiffness and use by the section they stand for; other given values
-- stay. Returns the entry and the use.
local function take_cable(args)
  check_cable_words(args)
  local entry = args.cable
  if entry == nil then
    for _, key in ipairs{ "stiffness", "use" } do
      if args[key] ~= nil then error(("wire: %s goes with cable = 'name'"):format(key), 0) end
    end
    return nil
  end
  entry = cable.get(entry)
  for _, key in ipairs{ "E", "nu", "density" } do
    if args[key] ~= nil and not (key == "nu" and args.body == "solid") then
      error(("wire: %s describes a solid round wire and does not go with cable = '%s'; to override values of "
        .. "the cable give EA, EI, GJ or mass_per_length"):format(key, entry.name), 0)
    end
  end
  local _, _, use = cable.bend_limit(entry, args.use)
  for key, value in pairs(cable.section(entry, args.stiffness)) do
    if args[key] == nil then args[key] = value end
  end
  if args.breaking_load == nil and args.breaking_flag == nil and entry.breaking_load then
    args.breaking_load, args.breaking_flag = entry.breaking_load.value, entry.breaking_load.flag
  end
  args.cable, args.stiffness, args.use = nil, nil, nil
  return entry, use
end

local new_wire = class.scene.wire
--- scene:wire{...}: see help "wire" for the parameters. `cable`, a name or entry of
-- the catalogue, gives those of EA, EI, GJ, mass_per_length and radius that are not given;
-- `stiffness` = "default", "slip" or "stick" chooses its EI and GJ; `use` selects the
-- limit for its bend radius. See help "cable".
function class.scene.wire(scene, args)
  build.check(scene, "scene:wire", 3)
  args = table_of(args, "scene:wire")
  local data = build.data(scene)
  args = with_body(args)
  local entry, use = build.call(3, take_cable, args)
  args.name = build.name(scene, args.name, "wire", #data.wires, 3)
  local auto = args.model == "auto" -- a rod, until a run needs another model
  if auto then args.model = nil end
  local wire = build.call(3, new_wire, scene, args)
  data.wires[#data.wires + 1] = { object = wire, name = args.name }
  local kept = core.data(wire)
  kept.auto, kept.curved = auto or nil, args.rest == "path" or nil
  if entry then kept.cable, kept.use = entry, use end
  if args.breaking_load then
    kept.breaking = { value = args.breaking_load, flag = args.breaking_flag or "given" }
  end
  remarks.wire(data, wire, args)
  remarks.mesh(wire)
  return wire
end

local remodel, remodels = class.wire.remodel, setmetatable({}, { __mode = "k" })

--- Returns how often a wire was remodelled; snapshots do not keep it.
function build.remodels(wire) return remodels[wire] or 0 end

--- wire:remodel{ model =, ... }: see help "remodel".
function class.wire.remodel(wire, args)
  build.call(3, check_reading, select(4, core.number(wire)), "wire:remodel")
  local result = build.call(3, remodel, wire, with_body(args))
  remodels[wire] = build.remodels(wire) + 1
  remarks.mesh(wire)
  return result
end

local function name_of(wire) return wire.name end
local function bend_of(wire, options) return wire:min_bend_radius(options) end

--- Returns the catalogue entry the wire was made from, or nil.
function class.wire.cable(wire)
  if core.type(wire) ~= "wire" then error("wire:cable is a method: call it with a colon", 2) end
  build.call(3, name_of, wire) -- raises if the scene is closed
  return core.data(wire).cable
end

local Limit = { __name = "bend limit" }
Limit.__index = checks.fields("bend limit", "name ok radius s t limit inside use")

function Limit.__tostring(l)
  local text = "%s: smallest bend radius of the centre line %.4g m, limit %.4g m (%s): %s"
  return text:format(l.name, l.radius, l.limit, l.use, l.ok and "kept" or "NOT kept")
end

--- Checks whether the wire is bent more tightly than its cable allows.
-- @tparam[opt] table options `use` (default: that of the wire), `now` = true for the
-- present shape instead of the tightest of the run
-- @treturn table `ok`, `radius` (smallest radius of the centre line [m]) at `s` [m]
-- and `t` [s], `limit` (of the centre line [m]), `inside` (the rule's own radius, at
-- the inside of the bend [m]), `use`
function class.wire.bend_limit(wire, options)
  if core.type(wire) ~= "wire" then error("wire:bend_limit is a method: call it with a colon", 2) end
  build.call(3, name_of, wire)
  options = table_of(options, "wire:bend_limit")
  checks.keys("wire:bend_limit", options, { use = true, now = true }, 3)
  local kept = core.data(wire)
  if not kept.cable then
    error(("wire '%s' was not made from a cable of the catalogue: it has no bend limit"):format(wire.name), 2)
  end
  local inside, limit, use = build.call(3, cable.bend_limit, kept.cable, options.use or kept.use,
    2 * wire.radius)
  local radius, s, t = build.call(3, bend_of, wire, { now = options.now })
  return setmetatable({ name = wire.name, ok = radius >= limit, radius = radius, s = s, t = t,
    limit = limit, inside = inside, use = use }, Limit)
end

local new_particles = class.scene.particles
--- scene:particles{ positions =, masses =, links =, ... }: any object of particles; see help
-- "particles".
function class.scene.particles(scene, args)
  build.check(scene, "scene:particles", 3)
  args = table_of(args, "scene:particles")
  local data = build.data(scene)
  args.name = build.name(scene, args.name, "particles", #data.particles, 3)
  local object = build.call(3, new_particles, scene, args)
  data.particles[#data.particles + 1] = { object = object, name = args.name }
  return object
end

local new_obstacle = class.scene.obstacle
local bores = checks.set "tube pipe bore hole ring"

--- scene:obstacle{ shape =, ... }: see help "obstacle". `file` reads a mesh.
function class.scene.obstacle(scene, args)
  build.check(scene, "scene:obstacle", 3)
  args = table_of(args, "scene:obstacle")
  local data = build.data(scene)
  local kind = type(args.shape) == "string" and args.shape or "obstacle"
  if bores[kind] then
    error(("scene:obstacle: there is no shape '%s'; for a bore take a channel with a lid, a torus or a mesh, "
      .. "see help 'insert'"):format(kind), 2)
  end
  local given = args.name
  args.name = build.name(scene, given, kind, #data.obstacles, 3)
  local obstacle = build.call(3, meshfile.make, "obstacle", given, args, function(all)
    return new_obstacle(scene, all)
  end)
  local entry = copy(args)
  entry.object, entry.data = obstacle, nil
  data.obstacles[#data.obstacles + 1] = entry -- keeps the core's order, even if something below fails
  solid.keep(entry, obstacle.shape)
  remarks.obstacle(data, entry, scene.time)
  return obstacle
end

-- clamp, pin, ... take a wire; hold takes particles
local hold_kinds = { "hold" }
for _, hold in ipairs(core.registry().holds) do hold_kinds[#hold_kinds + 1] = hold.name end
for _, kind in ipairs(hold_kinds) do
  local new_hold = class.scene[kind]
  class.scene[kind] = function(scene, wire, args)
    build.check(scene, "scene:" .. kind, 3)
    args = table_of(args, "scene:" .. kind)
    local data = build.data(scene)
    if kind ~= "grip" or args.name == nil then -- a gripper's holds share its name
      args.name = build.name(scene, args.name, kind == "hold" and "clamp" or kind, #data.holds, 3)
    end
    local hold = build.call(3, new_hold, scene, wire, args)
    if kind == "feed" then remarks.on(kind, ("feed '%s'"):format(args.name), args) end
    data.holds[#data.holds + 1] =
      { object = hold, name = args.name, kind = kind, width = args.width }
    return hold
  end
end

local new_contact = class.scene.wire_contact
--- scene:wire_contact{ between = wires, friction =, ... }: lets wires touch each other and
-- themselves from then on; see help "wire_contact".
function class.scene.wire_contact(scene, args)
  build.check(scene, "scene:wire_contact", 3)
  remarks.on("wire_contact", "wire_contact", args)
  build.call(3, new_contact, scene, args)
  build.data(scene).touching = true
end

local new_join = class.scene.join
--- scene:join{ ends = { { wire, s = }, ... }, rigid =, name = }: fixes wires to each other
-- where they meet; see help "join".
function class.scene.join(scene, args)
  build.check(scene, "scene:join", 3)
  local join, data, wires = build.call(3, new_join, scene, args), build.data(scene), {}
  for i, e in ipairs(args.ends) do wires[i] = e[1] end
  data.joins[#data.joins + 1] =
    { object = join, name = join.name, wires = wires, rigid = args.rigid ~= false }
  return join
end

local new_force = class.scene.force
--- scene:force{ kind =, on =, ... }: see help "force".
function class.scene.force(scene, args)
  build.check(scene, "scene:force", 3)
  local force, data = build.call(3, new_force, scene, args), build.data(scene)
  data.forces = data.forces or {}
  data.forces[#data.forces + 1] = { object = force }
  return force
end

--- Returns all forces in the order they were made, including those of clips and ties and released ones.
function class.scene.forces(scene)
  if core.type(scene) ~= "scene" then error("scene:forces is a method: call it with a colon", 2) end
  build.call(3, name_of, scene) -- raises if the scene is closed
  local list = {}
  for i, entry in ipairs(build.data(scene).forces or {}) do list[i] = entry.object end
  return list
end

-- --- snapshots ------------------------------------------------------------------

local close = class.scene.close
--- Frees the scene. The variables of a process that runs would be left without it, so a run must have ended.
function class.scene.close(scene)
  local open, name = core.type(scene) == "scene", nil
  if open then open, name = pcall(name_of, scene) end
  if open and not core.busy(scene) and build.data(scene).running then -- else the core says why not
    error(("scene:close: a run of scene '%s' is under way; close it after the run"):format(name), 2)
  end
  return build.call(3, close, scene)
end

local new_snapshot = class.scene.snapshot
--- Returns a snapshot of the scene that can be restored any number of times. Processes are not
-- part of it: restoring ends them.
function class.scene.snapshot(scene)
  local snapshot = build.call(3, new_snapshot, scene)
  core.data(snapshot).image = keep.image(build.data(scene), imaged)
  return snapshot
end

local restore = class.scene.restore
--- Restores the snapshot bit for bit. Objects made after it disappear.
function class.scene.restore(scene, snapshot)
  build.check(scene, "scene:restore", 3)
  local data = build.data(scene)
  if data.running then
    error(("scene:restore: a run of scene '%s' is under way"):format(scene.name), 2)
  end
  if core.type(snapshot) ~= "snapshot" then
    error("scene:restore expects a snapshot, got " .. (core.type(snapshot) or type(snapshot)), 2)
  end
  build.back(scene, snapshot)
end

--- Restores a snapshot between two steps of a run and ends its processes. With same = true the processes
-- have not run since the snapshot, and they go on.
function build.back(scene, snapshot, same)
  local data = build.data(scene)
  build.call(3, restore, scene, snapshot)
  local raise = blame.each(same and {} or data.processes, "finish")
  data.restores, data.going, data.processes = data.restores + 1, nil, same and data.processes or {}
  for _, gripper in ipairs(data.grippers) do gripper:leave() end
  keep.back(data, core.data(snapshot).image, imaged)
  raise()
end

return build
