-- SPDX-License-Identifier: GPL-3.0-or-later
--- Topics of help: pages of the manual, and the members of the core's registries with their parameter rows,
-- the same rows that check arguments.
-- @module softworld.topics
local core = require "softworld.core"
local manual = require "softworld.manual"
local text_of = require "softworld.manual.text"

local topics = {}

-- The call that each table of rows belongs to.
local uses = {
  scene = "sw.scene{...}",
  wire = "scene:wire{...} (and a section, see help 'section', or a cable, see help 'cable')",
  section = "scene:wire{...}: what the wire is made of", obstacle = "scene:obstacle{ shape =, ... }",
  run = "scene:run{...}", settle = "scene:settle{...}",
  frequencies = "wire:frequencies{...}: natural frequencies [Hz] about the present equilibrium",
  wire_mesh = "scene:wire{ model = 'tube' | 'radial' | 'cubic' | 'composite' }: what meshes take besides",
  remodel = "wire:remodel{ model =, ... }: another model for a wire in mid-run",
  wire_contact = "scene:wire_contact{...}: wires and objects of particles that touch, see help 'touches'",
  particles = "scene:particles{...}: any object of particles: fabric, foam, nets, chains",
  repel = "repel = {...} of scene:particles",
  join = "scene:join{...}: wires fixed to each other at a point, as in a harness",
  calibrate = "sw.calibrate{ mesh =, ... }: springs of a mesh of particles that is the given wire",
  calibrate_tube = "sw.calibrate{ mesh = 'tube', ... }: rings, with or without a central line",
  calibrate_radial = "sw.calibrate{ mesh = 'radial', ... }: layers and sectors around a line",
  calibrate_cubic = "sw.calibrate{ mesh = 'cubic', ... }: voxels of a section",
  calibrate_composite = "sw.calibrate{ mesh = 'composite', ... }: a shell around cores, bonded or not",
  trajectory = "sw.trajectory{...}; clamps, obstacles and grippers take the table itself",
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

-- Families in the order in which they are shown: what one is called, its list, how it is used.
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

local plural = { models = "model", holds = "hold", obstacles = "obstacle", forces = "force",
  shapes = "obstacle", shape = "obstacle", readouts = "readout" } -- integrators has a page

local function sorted_names(set)
  local list = {}
  for name in pairs(set) do list[#list + 1] = name end
  table.sort(list)
  return list
end

local function names_of(list)
  local names = {}
  for i, entry in ipairs(list) do names[i] = entry.name end
  return names
end

--- The range that a row allows, as text.
function topics.range(row)
  if row.choices then return "one of " .. table.concat(row.choices, ", ") end
  if row.min and row.max then
    return ("%s%g, %g%s"):format(row.above and "(" or "[", row.min, row.max, row.below and ")" or "]")
  end
  if row.min then return (row.above and "> %g" or ">= %g"):format(row.min) end
  if row.max then return (row.below and "< %g" or "<= %g"):format(row.max) end
  return ""
end

--- A row's default, as text.
function topics.default(row)
  if row.required then return "required" end
  if row.type == "choice" and row.choices then
    local name = row.choices[(row.default or -1) + 1]
    return name and "= " .. name or ""
  end
  if row.default and (row.type == "number" or row.type == "integer") then
    return ("= %.6g"):format(row.default)
  end
  return ""
end

local function how_it_steps(entry)
  local lines = { ("order %d, %s%s"):format(entry.order, entry.implicit and "implicit" or "explicit",
    entry.adaptive and ", steps by tolerance" or "") }
  if entry.implicit then
    lines[2] = ("of what is too fast for its steps each leaves %g"):format(entry.at_infinity)
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
  elseif family[1] ~= "model" then
    part.rows = entry.params or {}
    part.after = entry.sample and not entry.listed and "such as " .. entry.sample or nil
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

--- Members and tables of rows under a name: a list of { title =, lines = texts, rows = parameter rows }.
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
  for _, family in ipairs(families()) do
    if not parts[1] and not manual.has(topic) and family[1] == (plural[topic] or topic) then
      parts[1] = family_list(family)
    end
  end
  return parts
end

local function part_text(part)
  local lines = { part.title }
  for _, line in ipairs(part.lines) do lines[#lines + 1] = "  " .. line end
  for _, row in ipairs(part.rows or {}) do
    local range = topics.range(row)
    lines[#lines + 1] = ("  %-16s %-9s %-12s %s%s"):format(row.name, row.unit == "-" and ""
      or "[" .. row.unit .. "]", topics.default(row), row.doc, range ~= "" and "; " .. range or "")
  end
  if part.rows and #part.rows == 0 then lines[#lines + 1] = "  takes no parameters" end
  if part.after then lines[#lines + 1] = "  " .. part.after end
  return table.concat(lines, "\n")
end

--- Names of all members and tables of rows, in groups: a title and a list.
function topics.reference()
  local r = registered()
  return { { "make", sorted_names(r.params) }, { "models", names_of(r.models) },
    { "holds", names_of(r.holds) }, { "obstacles", names_of(r.shapes) },
    { "forces", names_of(outer(r.forces)) }, { "integrators", names_of(r.integrators) },
    { "readouts", names_of(r.readouts) } }
end

--- All topics, as text.
function topics.overview()
  local lines = { 'SoftWorld: help "name" (or `softworld doc name`) shows a page or parameters, '
    .. "help(object) its methods." }
  for _, group in ipairs(manual.groups) do
    lines[#lines + 1] = group[1]
    for _, name in ipairs(group[2]) do
      lines[#lines + 1] = ("  %-12s %s"):format(name, manual.title(name))
    end
  end
  lines[#lines + 1] = "Parameters"
  for _, group in ipairs(topics.reference()) do
    lines[#lines + 1] = ("  %-12s %s"):format(group[1], table.concat(group[2], " "))
  end
  return table.concat(lines, "\n")
end

--- The text under a name: the page of the manual first, then parameters; or nil.
function topics.text(topic)
  local texts, parts = {}, topics.parts(topic)
  local page = manual.has(topic) and topic or #parts == 0 and manual.also[topic]
  if page then texts[1] = text_of(manual.read(page)) end
  for _, part in ipairs(parts) do texts[#texts + 1] = part_text(part) end
  return #texts > 0 and table.concat(texts, "\n\n") or nil
end

--- Message for a name without a topic, with the nearest one that has.
function topics.unknown(topic)
  local names = sorted_names(manual.also)
  local function add(list) table.move(list, 1, #list, #names + 1, names) end
  for _, group in ipairs(manual.groups) do add(group[2]) end
  for _, group in ipairs(topics.reference()) do add(group[2]) end
  local near = core.nearest(topic, names)
  return ("no help on '%s'; %s"):format(topic, near and ("did you mean '%s'?"):format(near)
    or "help() lists the topics")
end

return topics
