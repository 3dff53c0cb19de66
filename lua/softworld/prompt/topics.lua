-- SPDX-License-Identifier: GPL-3.0-or-later
--- Topics of help: pages of the manual, and the members of the core's registries with their parameter rows.
-- The same rows check arguments.
-- @module softworld.prompt.topics
require "softworld" -- its modules register their rows
local checks = require "softworld.checks"
local core = require "softworld.core"
local manual = require "softworld.manual"
local rows = require "softworld.rows"
local text_of = require "softworld.manual.text"

rows.load()

local topics = {}

-- The call that each table of rows belongs to.
local uses = {
  scene = "sw.scene{...}",
  wire = "scene:wire{...} (and a section, see help 'section', or a cable, see help 'cable')",
  section = "scene:wire{...}: the section of the wire", obstacle = "scene:obstacle{ shape =, ... }",
  run = "scene:run{...}", settle = "scene:settle{...}",
  frequencies = "wire:frequencies{...}: natural frequencies [Hz] about the present equilibrium",
  wire_mesh = "scene:wire{ model = 'tube' | 'radial' | 'cubic' | 'composite' }: further parameters of meshes",
  remodel = "wire:remodel{ model =, ... }: another model for a wire in mid-run",
  wire_contact = "scene:wire_contact{...}: wires and objects of particles that touch, see help 'touches'",
  particles = "scene:particles{...}: any object of particles: fabric, foam, nets, chains",
  repel = "repel = {...} of scene:particles",
  join = "scene:join{...}: wires fixed to each other at a point, as in a harness",
  calibrate = "sw.calibrate{ mesh =, ... }: springs of a mesh of particles with the stiffnesses of the given "
    .. "wire",
  calibrate_tube = "sw.calibrate{ mesh = 'tube', ... }: rings, with or without a central line",
  calibrate_radial = "sw.calibrate{ mesh = 'radial', ... }: layers and sectors around a line",
  calibrate_cubic = "sw.calibrate{ mesh = 'cubic', ... }: voxels of a section",
  calibrate_composite = "sw.calibrate{ mesh = 'composite', ... }: a shell around cores, bonded or not",
  trajectory = "sw.trajectory{...}; clamps, obstacles and grippers take the table itself",
  minimise = "sw.tune.minimise{ f =, ... }: where f is smallest, see help 'tuning'",
}

local registry
local function registered()
  if not registry then
    registry = core.registry()
    registry.params.trajectory = core.trajectory_parameters()
  end
  return registry
end

local function outer(forces)
  local list = {}
  for _, f in ipairs(forces) do
    if not f.inner then list[#list + 1] = f end
  end
  return list
end

-- Returns the families in the order of help: title, list, use.
local function families()
  local r = registered()
  return {
    { "model", r.models, "scene:wire{ model = '%s', ... }" },
    { "hold", r.holds, "scene:%s(wire, {...})" },
    { "obstacle", r.shapes, "scene:obstacle{ shape = '%s', ... }" },
    { "force", r.forces, "scene:force{ kind = '%s', on = wire, ... }" },
    { "integrator", r.integrators, "scene:run{ integrator = '%s', ... }" },
    { "readout", r.readouts, "wire:%s" },
  }
end

local plural = { models = "model", holds = "hold", obstacles = "obstacle", forces = "force", force = "force",
  shapes = "obstacle", shape = "obstacle", readouts = "readout" } -- integrators has a manual page

local function named(list, name)
  for _, entry in ipairs(list) do
    if entry.name == name then return entry end
  end
end

local function names_of(list)
  local names = {}
  for i, entry in ipairs(list) do names[i] = entry.name end
  return names
end

local HUGE = 1e300 -- limits beyond it count as no limit [-]

--- Returns the range that a row allows, as text.
function topics.range(row)
  if row.choices then return "one of " .. table.concat(row.choices, ", ") end
  local low, high = row.min and row.min > -HUGE and row.min, row.max and row.max < HUGE and row.max
  if low and high then
    return ("%s%g, %g%s"):format(row.above and "(" or "[", low, high, row.below and ")" or "]")
  end
  if low then return (row.above and "> %g" or ">= %g"):format(low) end
  if high then return (row.below and "< %g" or "<= %g"):format(high) end
  return ""
end

--- Returns a row's default, as text.
function topics.default(row)
  if row.doc and row.doc:find("(default", 1, true) then return "" end -- 0 stands for what the text says
  if row.required then return "required" end
  local usual = row.usual or type(row.default) ~= "number" and row.default
  if type(usual) == "string" then return "= " .. usual end
  if type(usual) == "table" then return ("= {%g, %g, %g}"):format(table.unpack(usual)) end
  if row.usual then return ("= %.6g"):format(row.usual) end
  if row.type == "choice" and row.choices then
    local name = row.choices[(row.default or -1) + 1]
    return name and "= " .. name or ""
  end
  local plain = row.type == "number" or row.type == "integer" or row.type == "numbers"
  return plain and row.default and ("= %.6g"):format(row.default) or ""
end

local function how_it_steps(entry)
  local lines = { ("order %d, %s%s"):format(entry.order, entry.implicit and "implicit" or "explicit",
    entry.adaptive and ", steps by tolerance" or "") }
  if entry.implicit then
    lines[2] = ("each step leaves %g of a motion that is too fast for the step"):format(entry.at_infinity)
  elseif entry.leapfrog_limit > 0 then
    lines[2] = ("stable up to %.3g times scene:stable_dt()"):format(entry.leapfrog_limit / 2)
  end
  return lines
end

local function member(family, entry)
  local summary = entry.summary and ": " .. entry.summary or ""
  local part = { title = ("%s %s%s"):format(family[1], entry.name, summary),
    lines = { family[3]:format(entry.name) } }
  if entry.inner then part.lines = { "part of the wire models that need it" }
  elseif family[1] == "integrator" then
    table.move(how_it_steps(entry), 1, 2, 2, part.lines)
  elseif family[1] == "readout" then
    part.lines[1] = ("wire:%s(%s)   [%s]"):format(entry.name, entry.at_place and "s" or "", entry.unit)
  elseif family[1] == "model" then
    local own = registered().params["calibrate_" .. entry.name] -- of a mesh
    part.rows = own
    part.after = own and "and those of help 'wire_mesh', 'wire' and 'section' (or 'cable')"
      or "its parameters: help 'wire' and 'section' (or 'cable')"
  else
    part.rows = entry.params or {}
    part.after = entry.sample and not entry.listed and "such as " .. entry.sample
      or family[1] == "hold" and entry.name ~= "clamp" and "its methods: help 'clamp'" or nil
  end
  return part
end

local function family_list(family)
  local part = { title = family[3]:format "...", lines = {} }
  for i, entry in ipairs(family[1] == "force" and outer(family[2]) or family[2]) do
    part.lines[i] = ("%-18s %s"):format(entry.name, entry.summary or "")
  end
  return part
end

-- Returns rows together with those of tables within them, under names like pads.width.
local function flat(list, prefix, into)
  for _, row in ipairs(list) do
    local shown = setmetatable({ name = prefix .. row.name }, { __index = row })
    into[#into + 1] = shown
    if row.rows then flat(row.rows.rows, shown.name .. ".", into) end
  end
  return into
end

local function signature(call)
  if not call.arguments then return call.name end
  local braces = call.arguments:find "^{"
  return (braces and "%s%s" or "%s(%s)"):format(call.name, call.arguments)
end

local function call_part(call)
  local part = { title = ("%s: %s"):format(signature(call), call.doc), lines = {},
    rows = flat(call.rows, "", {}) }
  if call.gives then part.lines[1] = (call.arguments and "returns " or "") .. call.gives end
  if call.example then part.lines[#part.lines + 1] = "such as " .. call.example end
  for _, row in ipairs(call.also and registered().params[call.also] or {}) do
    if not call.known[row.name] then part.rows[#part.rows + 1] = row end
  end
  if #part.rows == 0 then part.rows = nil end
  return part
end

local WIDE = 110 -- longest line about a call made in Lua [characters]

-- Returns the width of a column: the longest of these texts, between two bounds.
local function column(list, least, most, of)
  local wide = least
  for _, entry in ipairs(list) do wide = math.max(wide, math.min(#of(entry), most)) end
  return wide
end

-- Returns the part about a class: a line for each method and field.
local function class_part(class)
  local title = ("methods and fields of %s %s"):format(class:find "^[aeiou]" and "an" or "a", class)
  if class == "sw" then title = "functions of sw; sw.units: see help 'units'" end
  local part = { title = title, lines = {} }
  local function short(call)
    return class == "sw" and signature(call) or (signature(call):gsub("^%w+", "", 1))
  end
  local shape = ("%%-%ds %%s%%s"):format(column(rows.classes[class], 20, 32, short))
  for i, call in ipairs(rows.classes[class]) do
    local gives = call.gives and not call.gives:find "^the " and " -> " .. call.gives or ""
    local line = shape:format(short(call), call.doc, gives)
    part.lines[i] = #line <= WIDE and line or shape:format(short(call), call.doc, "")
  end
  return part
end

-- Adds the calls made in Lua under a name: the call with this full name; for a class how its objects are made
-- and their methods; else all methods with this name, unless the name is a topic already.
local function add_calls(topic, parts)
  local made = rows.all["scene:" .. topic]
  if rows.all[topic] then parts[#parts + 1] = call_part(rows.all[topic]) end
  if made and not (parts[1] and #made.rows == 0) then parts[#parts + 1] = call_part(made) end
  local is_class = rows.classes[topic]
  if is_class then parts[#parts + 1] = class_part(topic) end
  if not is_class and (parts[1] or manual.has(topic) or plural[topic]) then return end
  for _, class in ipairs(checks.sorted(rows.classes)) do
    for _, call in ipairs(rows.classes[class]) do
      if call ~= made and call.name:match "[:.](.*)$" == topic and (not is_class or call.rows[1]) then
        parts[#parts + 1] = call_part(call)
      end
    end
  end
end

-- Returns the classes of objects that no other part of help describes.
local function object_names()
  local names = checks.sorted(rows.classes)
  for i = #names, 1, -1 do
    if registered().params[names[i]] or named(registered().holds, names[i]) then table.remove(names, i) end
  end
  return names
end

--- Returns the members and tables of rows under a name: a list of { title =, lines = texts, rows = parameter
-- rows }.
function topics.parts(topic)
  local parts, r = {}, registered()
  if r.params[topic] then
    parts[1] = { title = uses[topic] or topic, lines = {}, rows = r.params[topic],
      after = topic == "obstacle" and "shapes: " .. table.concat(names_of(r.shapes), " ") or nil }
  end
  for _, family in ipairs(families()) do
    for _, entry in ipairs(family[2]) do
      if entry.name == topic then parts[#parts + 1] = member(family, entry) end
    end
  end
  add_calls(topic, parts)
  for _, family in ipairs(families()) do
    if not parts[1] and not manual.has(topic) and family[1] == (plural[topic] or topic) then
      parts[1] = family_list(family)
    end
  end
  return parts
end

local function unit_of(row) return row.unit == "-" and "" or "[" .. row.unit .. "]" end

-- Adds the choices of a row that has a line about each.
local function add_choices(lines, row, indent)
  for _, choice in ipairs(row.about and row.choices or {}) do
    lines[#lines + 1] = ("%s%-12s %s"):format((" "):rep(indent), choice, row.about(choice))
  end
end

local function part_text(part)
  local lines = { part.title }
  local name_column = column(part.rows or {}, 16, 28, function(row) return row.name end)
  local unit_column = column(part.rows or {}, 9, 12, unit_of)
  local shape = ("  %%-%ds %%-%ds %%-12s %%s%%s%%s"):format(name_column, unit_column)
  for _, line in ipairs(part.lines) do lines[#lines + 1] = "  " .. line end
  for _, row in ipairs(part.rows or {}) do
    local range, default = topics.range(row), topics.default(row)
    local long = #default > 12 -- does not fit into its column
    lines[#lines + 1] = shape:format(row.name, unit_of(row), long and "" or default, row.doc,
      range ~= "" and "; " .. range or "", long and default:gsub("^=", "; default:") or "")
    add_choices(lines, row, 4)
  end
  if part.rows and #part.rows == 0 then lines[#lines + 1] = "  takes no parameters" end
  if part.after then lines[#lines + 1] = "  " .. part.after end
  return table.concat(lines, "\n")
end

--- Returns the methods and fields of a class, as text; nil for classes without rows.
function topics.object(class)
  return rows.classes[class] and part_text(class_part(class)) or nil
end

--- Returns the names of all members and tables of rows, in groups: a title and a list.
function topics.reference()
  local r = registered()
  return { { "make", checks.sorted(r.params) }, { "models", names_of(r.models) },
    { "holds", names_of(r.holds) }, { "obstacles", names_of(r.shapes) },
    { "forces", names_of(outer(r.forces)) }, { "integrators", names_of(r.integrators) },
    { "readouts", names_of(r.readouts) }, { "objects", object_names() } }
end

--- Returns all topics, as text.
function topics.overview()
  local lines = { 'SoftWorld: help "name" (or `softworld doc name`) shows a page or parameters, '
    .. "help(object) its methods." }
  for _, group in ipairs(manual.groups) do
    lines[#lines + 1] = group[1]
    for _, name in ipairs(group[2]) do
      lines[#lines + 1] = ("  %-15s %s"):format(name, manual.title(name))
    end
  end
  lines[#lines + 1] = "Parameters"
  for _, group in ipairs(topics.reference()) do
    lines[#lines + 1] = ("  %-12s %s"):format(group[1], table.concat(group[2], " "))
  end
  return table.concat(lines, "\n")
end

-- Returns the texts of the manual's rows about a kind of event: what it means, and where more is.
local function events_of(kind)
  local texts = {}
  for kinds, means, more in manual.page "events":gmatch "\n| ([^|]+) | ([^|]+) | ([^|\n]+) |" do
    if kinds:find("`" .. kind .. "`", 1, true) then
      texts[#texts + 1] = text_of(("event `%s`: %s; see %s"):format(kind, means, more))
    end
  end
  return texts
end

--- Returns the text under a name, or nil: the page of the manual first, then parameters; else the events.
function topics.text(topic)
  local texts, parts = {}, topics.parts(topic)
  local page = manual.has(topic) and topic or #parts == 0 and manual.also[topic]
  if page then texts[1] = text_of(manual.page(page)) end
  for _, part in ipairs(parts) do texts[#texts + 1] = part_text(part) end
  if #texts == 0 then texts = events_of(topic) end
  return #texts > 0 and table.concat(texts, "\n\n") or nil
end

-- Returns the names of all calls and fields: of their owners too if the topic has one.
local function call_names(topic)
  local names = checks.sorted(rows.all)
  if topic:find "[.:]" then return names end
  for i, name in ipairs(names) do names[i] = name:match "[.:]([%w_]+)$" or name end
  return names
end

--- Returns the message for a name without a topic, with the nearest topic.
function topics.unknown(topic)
  local names = checks.sorted(manual.also)
  local function add(list) table.move(list, 1, #list, #names + 1, names) end
  for _, group in ipairs(manual.groups) do add(group[2]) end
  for _, group in ipairs(topics.reference()) do add(group[2]) end
  local near = core.nearest(topic, names) or core.nearest(topic, call_names(topic))
  return ("no help on '%s'; %s"):format(topic, near and ("did you mean '%s'?"):format(near)
    or "help() lists the topics")
end

return topics
