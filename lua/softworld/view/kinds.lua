-- SPDX-License-Identifier: GPL-3.0-or-later
--- What forms can make: every kind of object, and every step of a process, with the fields of its form. They
-- come from the rows that check and describe the same calls in a script. Only what rows cannot tell is
-- written here, such as which list of numbers is a list of points.
--
-- A kind: class, kind, doc, method, fields; `on`: class of the object that is the first argument of its call;
-- `set`: further fields of its table. A field is a row with the type that a form shows: number, integer,
-- boolean, text, file, choice, vector, rotation, points, numbers, object (of = class or kind), table (rows).
-- @module softworld.view.kinds
local core = require "softworld.core"
local cable = require "softworld.cable"
local rows = require "softworld.rows"
local bendrule = require "softworld.wire.bendrule"
local functions = require "softworld.view.functions"
local special = require "softworld.view.special"

local kinds = {}

local MESH_FILE = "a mesh file in the folder where the program runs"

-- Types of rows that the core calls "other", or that the Lua side reads; false: not shown in a form.
local told = {
  wire = { path = { type = "points" }, model = false },
  hull = { points = { type = "points", flat = true } },
  mesh = { data = false, format = false },
  slider = { path = { type = "points" } },
  channel = { points = { type = "points" } }, tie = { to = { type = "vector" } },
  move = { points = { type = "points" }, path = false, scale = false, func = false, times = false,
    start = false, relative = false, step = false },
  run = { progress = false, save = false, resume = false, frames = false },
}

-- Fields shown first, by class, because they are used most; the others are folded away.
local first = {
  wire = "name cable from to radius E density",
  obstacle = "name at friction", force = "", gripper = "name at", hold = "s name",
  step = "s to by approach force speed distance axis angle into", run = "duration dt tolerance",
  scene = "name gravity",
  fixing = "name at s to to_wire to_s points", contact = "friction",
}

-- Initial values of a new form, so that something is visible at once.
local starts = {
  wire = { cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 } },
  sphere = { radius = 0.05, at = { 0.25, 0, 0 } },
  capsule = { radius = 0.02, length = 0.2, at = { 0.25, 0, 0 } },
  box = { size = { 0.05, 0.2, 0.05 }, at = { 0.25, 0, 0.025 } },
  cylinder = { radius = 0.03, length = 0.2, at = { 0.25, 0, 0 } },
  torus = { radius = 0.03, tube = 0.005, at = { 0.25, 0, 0.1 } }, gripper = { at = { 0.5, 0, 0.2 } },
  wait = { seconds = 0.2 }, move = { by = { 0, 0, 0.1 }, speed = 0.2 }, run = { duration = 1, dt = 0.01 },
}

-- --- fields --------------------------------------------------------------------------------------

local simple = { number = "number", integer = "integer", boolean = "boolean", text = "text",
  choice = "choice", vector = "vector", rotation = "rotation", reaction = "choice", ["arc length"] = "number",
  numbers = "number", points = "points", ["function"] = "function",
  ["list of numbers"] = "numbers" }
local objects = { wire = "wire", clip = "clip", gripper = "gripper" }
local bodies = "wire particles"

local function finite(x) return x and x > -1e300 and x < 1e300 and x or nil end

-- Returns a default to show; not a number that stands for "none was given".
local function shown_default(row)
  local value = row.default
  if row.type == "number" or row.type == "numbers" then return finite(value) end
  if row.type == "integer" and value ~= 0 then return finite(value) end
  if row.type == "vector" and type(value) == "table" then return { value[1], value[2], value[3] } end
  return nil
end

local fields_of

local function field_of(row, own)
  local more = own[row.name]
  if more == false then return nil end
  local object = objects[row.type]
  local field = { name = row.name, unit = row.unit, doc = row.doc, required = row.required or nil,
    min = finite(row.min), max = finite(row.max), above = row.above or nil, below = row.below or nil,
    choices = row.choices, default = shown_default(row), usual = row.usual and tostring(row.usual) or nil,
    type = object and "object" or simple[row.type], of = object, args = row.args }
  if row.name == "file" and row.type == "text" then field.type, field.doc = "file", MESH_FILE end
  if row.type == "table" and row.rows then
    field.type, field.rows = "table", fields_of({ row.rows.rows }, {}, "")
  end
  for key, value in pairs(more or {}) do field[key] = value end
  return field.type and field or nil
end

-- Returns the fields of lists of rows, each name once; those in `words` first.
function fields_of(lists, own, words)
  local list, known, place = {}, {}, {}
  for _, given in ipairs(lists) do
    for _, row in ipairs(given) do
      local field = not known[row.name] and field_of(row, own) or nil
      if field then list[#list + 1], known[row.name], place[row.name] = field, true, #list + 1001 end
    end
  end
  local count = 0
  for word in words:gmatch "%S+" do
    count = count + 1
    if known[word] then place[word] = count end
  end
  for _, field in ipairs(list) do
    if field.required and place[field.name] > 1000 then place[field.name] = place[field.name] / 1e4 + 1 end
    field.more = place[field.name] > 1000 or nil
  end
  table.sort(list, function(a, b) return place[a.name] < place[b.name] end)
  return list
end

-- --- the kinds -----------------------------------------------------------------------------------

local list, by_name

local function add(kind, lists, own, words)
  kind.fields = fields_of(lists, own or told[kind.kind] or {}, words or first[kind.class] or "")
  kind.known = {}
  for _, field in ipairs(kind.fields) do kind.known[field.name] = field end
  list[#list + 1] = kind
  by_name[kind.class .. " " .. kind.kind] = kind
end

local function wires(r)
  local in_lua = {
    { name = "cable", type = "choice", unit = "-", doc = "cable of the catalogue, instead of radius, E and "
      .. "density",
      choices = table.move(cable.list(), 1, #cable.list(), 1, {}) },
    { name = "stiffness", type = "choice", unit = "-", doc = "which of the cable's EI and GJ",
      choices = cable.stiffnesses },
    { name = "use", type = "choice", unit = "-", doc = "use of the cable, which sets the allowed bend radius",
      choices = bendrule.uses } }
  local models = table.move(r.models, 1, #r.models, 1, {})
  table.sort(models, function(a, b) return a.name == "rod" and b.name ~= "rod" end) -- the usual one first
  for _, model in ipairs(models) do
    local lists = { in_lua, r.params.wire, r.params.section }
    if model.mesh then
      lists[#lists + 1] = r.params.wire_mesh
      lists[#lists + 1] = r.params["calibrate_" .. model.name]
    end
    add({ class = "wire", kind = model.name, doc = model.summary, method = "wire",
      set = { model = model.name } }, lists, told.wire)
  end
end

local function obstacles(r)
  for _, shape in ipairs(r.shapes) do
    local file = {}
    if shape.name == "mesh" then file[1] = { name = "file", type = "text", unit = "-", required = true } end
    add({ class = "obstacle", kind = shape.name, doc = shape.summary, method = "obstacle",
      set = { shape = shape.name } }, { file, shape.params, r.params.obstacle })
  end
end

local function holds(r)
  for _, hold in ipairs(r.holds) do
    add({ class = "hold", kind = hold.name, doc = hold.summary, method = hold.name, on = "wire" },
      { hold.params })
  end
end

-- Forces that forms do not make, because scene:clip and scene:tie make them.
local made_by_others = { clip = true, snap = true, tether = true }

local function forces(r)
  local on = { { name = "on", type = "wire", unit = "-", required = true,
    doc = "the wire or object of particles that it acts on" } }
  for _, force in ipairs(r.forces) do
    if not force.inner and not made_by_others[force.name] then
      add({ class = "force", kind = force.name, doc = force.summary, method = "force",
        set = { kind = force.name } }, { on, force.params },
        { on = { of = bodies }, particles = { type = "numbers" } })
    end
  end
end

local function from_call(class, name, kind, more)
  local call = rows.all[name]
  local it = { class = class, kind = kind, doc = call.doc, method = name:match "[:.](.*)$" }
  local before = (call.arguments or ""):match "^(%a+), {"
  it.on = before == "wire" and "wire" or before == "place" and "wire" or before
  for key, value in pairs(more or {}) do it[key] = value end
  local lists = { call.rows }
  if call.also then lists[2] = core.trajectory_parameters() end
  lists[#lists + 1] = it.rows
  add(it, lists, told[kind])
end

local steps = { "grasp", "move", "rotate", "approach", "retreat", "press", "clip", "close_jaws", "open_jaws",
  "release", "freeze", "thaw" }

local function all_steps()
  for _, name in ipairs(steps) do from_call("step", "gripper:" .. name, name, { self = "gripper" }) end
  from_call("step", "p:feed", "feed", { self = "p" })
  add({ class = "step", kind = "wait", doc = rows.all["p:wait"].doc, method = "wait", self = "p",
    bare = "seconds" }, { { { name = "seconds", type = "number", unit = "s", min = 0, required = true,
    doc = "to wait" } } })
end

local function load_all()
  if list then return end
  list, by_name = {}, {}
  require "softworld" -- loads all rows
  rows.load()
  local r = core.registry()
  wires(r)
  obstacles(r)
  holds(r)
  from_call("gripper", "scene:gripper", "gripper")
  forces(r)
  for _, name in ipairs{ "clip", "channel" } do from_call("fixing", "scene:" .. name, name) end
  from_call("fixing", "scene:tie", "tie", { write = special.tie.write, rows = special.tie.rows })
  for _, kind in ipairs(special.kinds) do add(kind, { kind.rows }, kind.own or {}, kind.first) end
  for _, kind in ipairs(functions.kinds) do add(kind, { kind.rows }, kind.own or {}, kind.first) end
  add({ class = "contact", kind = "wire_contact", method = "wire_contact",
    doc = "wires touch each other and themselves" }, { r.params.wire_contact })
  all_steps()
  add({ class = "run", kind = "run", doc = "advances the scene", method = "run" }, { r.params.run })
  add({ class = "scene", kind = "scene", doc = "the scene itself", method = "scene" }, { r.params.scene })
end

--- Returns a kind, or nil.
function kinds.of(class, kind)
  load_all()
  return type(class) == "string" and type(kind) == "string" and by_name[class .. " " .. kind] or nil
end

-- Returns the entries of the catalogue with the values of their sheets and their sources.
local function cables()
  local all = {}
  for _, name in ipairs(cable.list()) do
    local entry, sheet = cable.get(name), {}
    for _, spec in ipairs(cable.quantities) do
      local q = entry[spec.key]
      if q then
        sheet[#sheet + 1] = { name = spec.key, value = q.value, low = q.low, high = q.high, unit = spec.unit,
          flag = q.flag, source = q.source }
      end
    end
    all[#all + 1] = { name = name, doc = entry.description, rows = sheet }
  end
  return all
end

--- Returns all kinds, and the catalogue of cables, as plain tables for pages; may: with Lua functions.
function kinds.all(may)
  load_all()
  local all = {}
  for _, kind in ipairs(list) do
    if may or not kind.lua then
      all[#all + 1] = { class = kind.class, kind = kind.kind, doc = kind.doc, on = kind.on, self = kind.self,
        fields = kind.fields, start = functions.starts[kind.class .. " " .. kind.kind] or starts[kind.kind]
          or special.starts[kind.kind] or starts[kind.class] }
    end
  end
  return { kinds = all, cables = cables() }
end

return kinds
