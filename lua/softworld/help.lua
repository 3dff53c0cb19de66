-- SPDX-License-Identifier: GPL-3.0-or-later
--- Help at the prompt, made from the same parameter rows that check arguments.
--
--     help()            -- what there is
--     help "wire"       -- parameters of scene:wire
--     help "box"        -- parameters of an obstacle, a force, a clamp, ...
--     help(scene)       -- methods of an object
-- @module softworld.help
local core = require "softworld.core"

local notes = {
  scene = "sw.scene{...}", wire = "scene:wire{...} (and a section, see help 'section')",
  section = "scene:wire{...}: what the wire is made of", obstacle = "scene:obstacle{ shape =, ... }",
  run = "scene:run{...}", settle = "scene:settle{...}",
}

local function range_of(row)
  if row.choices then return "one of " .. table.concat(row.choices, ", ") end
  if row.min and row.max then return ("%g .. %g"):format(row.min, row.max) end
  if row.min then return (">= %g"):format(row.min) end
  if row.max then return ("<= %g"):format(row.max) end
  return ""
end

local function default_of(row)
  if row.required then return "required" end
  if row.default and (row.type == "number" or row.type == "integer") then
    return ("= %.6g"):format(row.default)
  end
  return ""
end

local function show_rows(title, rows)
  print(title)
  for _, row in ipairs(rows) do
    print(("  %-16s %-9s %-12s %s%s"):format(row.name, row.unit == "-" and "" or "[" .. row.unit .. "]",
      default_of(row), row.doc, range_of(row) ~= "" and " (" .. range_of(row) .. ")" or ""))
  end
end

local function named(list, name)
  for _, entry in ipairs(list) do
    if entry.name == name then return entry end
  end
end

local function overview(r)
  print "SoftWorld: help 'name' shows parameters, help(object) its methods."
  local function line(title, list)
    local names = {}
    for _, e in ipairs(list) do names[#names + 1] = e.name end
    print(("  %-12s %s"):format(title, table.concat(names, " ")))
  end
  local params = {}
  for name in pairs(r.params) do params[#params + 1] = { name = name } end
  table.sort(params, function(a, b) return a.name < b.name end)
  line("make", params)
  line("wires", r.models)
  line("holds", r.holds)
  line("obstacles", r.shapes)
  local forces = {}
  for _, f in ipairs(r.forces) do if not f.inner then forces[#forces + 1] = f end end
  line("forces", forces)
  line("integrators", r.integrators)
end

local function show_object(object)
  local meta = getmetatable(object)
  local names = meta and meta.__names and meta.__names(object) or {}
  if #names == 0 then
    for name, value in pairs(type(object) == "table" and object or {}) do
      if type(name) == "string" and type(value) == "function" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  print(tostring(object))
  print("  " .. table.concat(names, " "))
end

return function(topic)
  local r = core.registry()
  if topic == nil then return overview(r) end
  if type(topic) ~= "string" then return show_object(topic) end
  if r.params[topic] then return show_rows(notes[topic] or topic, r.params[topic]) end
  for kind, list in pairs{ hold = r.holds, obstacle = r.shapes, force = r.forces,
    integrator = r.integrators, model = r.models } do
    local entry = named(list, topic)
    if entry then
      local title = ("%s %s%s"):format(kind, topic, entry.summary and ": " .. entry.summary or "")
      return show_rows(title, entry.params or {})
    end
  end
  print(("no help on '%s'; help() lists the topics"):format(topic))
end
