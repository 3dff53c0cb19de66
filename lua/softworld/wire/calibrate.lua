-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds the springs with which a mesh of particles has the stiffness of a given wire.
--
--     local c = sw.calibrate { mesh = "tube", EA = 5000, EI = 0.05, GJ = 0.04, radius = 0.005 }
--     print(c)                       -- springs, residuals
--     print(c.springs.diagonal)      -- [N/m]
--     for _, l in ipairs(c.links) do -- one slice; slice n is n * c.spacing further along z
--       build(l.from, l.to, l.slices, l.weight * c.springs[l.group])
--     end
--
-- EA, EI and GJ of an endless mesh of springs are computed exactly (softworld.wire.calibrate.cell): a slice
-- that repeats is strained, bent and twisted while its particles find their places, and its resistance is
-- measured. The springs are varied until EA, EI and GJ are those of the wire. body = "solid" fills the mesh
-- with solid elements of one modulus instead, and adds springs only for the rest of EA, EI and GJ. help
-- "calibrate" lists the parameters.
--
-- A composite is a tube of rings as shell around cores, each a line of particles, layers or
-- voxels. Bonded: springs (group "bond") hold its parts together, and the whole has EA, EI and GJ.
-- Sliding (`bonded = false`): EA, EI and GJ are the sums over the parts, each core bending about
-- its own axis, as stranded wires do. Links with `slide` then name the particles that face each
-- other, for a law of contact; they have no stiffness. With one core the same values hold for the
-- cell of the whole mesh. With cores off the axis the cell, whose sections stay plane, has a higher
-- EI, by EA times distance^2 of the cores.
--
-- With body = "solid" a composite is one core bonded to the shell, in one mesh of layers with the face at
-- the core's radius. E, nu and density are the shell's, core_E, core_nu and core_density the core's, and
-- EA = sum of E_i A_i, EI = sum of E_i I_i, GJ = sum of G_i J_i. All three and the ratio of the moduli are
-- exact, although the mesh has corners and parts with different nu press on one another and add stiffness:
-- the section is scaled (`scale`, with the face in it), both moduli by one factor, and both nu are shifted
-- alike. From EA, EI and GJ: the moduli follow from EA and EI, and nu from GJ, unless core_E, core_EA or
-- nu are given. If that is not possible, springs are added, the moduli are varied too, and EA, EI and GJ
-- are exact.
--
--     local c = sw.calibrate { mesh = "composite", core = "radial", cores = 3, bonded = false,
--       EA = 5000, EI = 0.02, GJ = 0.015, radius = 0.005 }
--     for _, l in ipairs(c.links) do
--       if l.slide then touch(l.from, l.to, l.gap, l.direction) end
--     end
-- @module softworld.wire.calibrate
local checks = require "softworld.checks"
local core = require "softworld.core"
local cable = require "softworld.cable"
local with_body = require "softworld.wire.body"
local inherited = require "softworld.inherited"

local calibrate = {}

local order = { "longitudinal", "inner", "core", "diagonal", "hoop", "brace", "spoke", "inclined",
  "edge", "cross", "bend", "bond" }
for i = 1, #order - 1 do
  order[#order + 1] = "core_" .. (order[i] == "core" and "line" or order[i])
end
local targets = { { "EA", "N" }, { "EI", "N m2" }, { "EI2", "N m2" }, { "GJ", "N m2" },
  { "squeeze", "Pa" } }

local Calibration = { __name = "calibration" }

function Calibration.__tostring(c)
  local lines = { ("calibration: %s of %d particles and %d links every %.6g m"):format(c.mesh,
    #c.particles, #c.links, c.spacing) }
  for _, t in ipairs(targets) do
    local off = c.residuals[t[1]]
    if off then
      lines[#lines + 1] = ("  %-17s %12.6g %-5s relative error %+.1e"):format(t[1], c[t[1]], t[2], off)
    end
  end
  if c.elements then
    lines[#lines + 1] = ("  %-13s %12.6g %-5s %d elements, nu = %.4g, section times %.4g"):format("modulus",
      c.modulus, "Pa", c.count.solid, c.nu, c.scale)
  end
  if c.core_modulus then
    lines[#lines + 1] = ("  %-13s %12.6g %-5s %d elements, nu = %.4g"):format("core_modulus",
      c.core_modulus, "Pa", c.count.core_solid, c.core_nu)
  end
  for _, group in ipairs(order) do
    if c.springs[group] then
      lines[#lines + 1] = ("  %-17s %12.6g %-5s %d links"):format(group, c.springs[group],
        group:find "bend" and "N m" or "N/m", c.count[group])
    end
  end
  return table.concat(lines, "\n")
end

--- Returns the core's calibration with the mesh's name; it prints as a table.
function calibrate.named(c, mesh)
  if type(c) ~= "table" then error("calibrate.named: a calibration is wanted, got " .. type(c), 2) end
  c.mesh = mesh
  return setmetatable(c, Calibration)
end

-- Returns a copy of the arguments, completed by the cable's values.
local function with_cable(args)
  local entry = cable.get(args.cable)
  for _, key in ipairs { "E", "nu", "density" } do
    if args[key] ~= nil and not (key == "nu" and args.body == "solid") then
      error(("calibrate: %s describes a solid round wire and does not go with cable = '%s'"):format(key,
        entry.name), 0)
    end
  end
  local all = inherited.copy(args)
  for key, value in pairs(cable.section(entry, args.stiffness)) do
    if all[key] == nil then all[key] = value end
  end
  all.cable, all.stiffness = nil, nil
  return all
end

--- Returns the springs of a mesh whose EA, EI and GJ, and squeeze stiffness if asked for, are
-- those of a wire; with body = "solid" elements and springs. If the mesh has no such springs, the
-- error tells what to change.
-- @tparam table args `mesh` = "tube", "radial", "cubic" or "composite", EA, EI, GJ (or E, nu), radius, or
-- `cable` = "name" for them, and what help "calibrate" lists
-- @treturn table `springs` by group [N/m], which `weight` of a link multiplies; `links` {from,
-- to, slices, group, weight, bend} and `particles` {x, y, z} [m] of one slice, `spacing` [m];
-- `count` of links by group; `shares` of the slice's mass, and `mass` [kg] if a mass per length
-- or density was given; EA, EI, EI2, GJ and `squeeze` reached, `residuals` (reached/wanted - 1),
-- `matrix`, the stiffness against stretch, curvatures about x and y, and twist. With body =
-- "solid" (or section = "solid") also `elements` {particles, slices (0 or 1)} of one slice, their
-- `modulus` [Pa] and `nu`, and `scale`, the factor by which particles lie farther out than in the
-- wire's section, so that EA and EI are exact in spite of corners; GJ of elements alone is then
-- within 2 %. For a solid composite `modulus` and `nu` are the shell's, `core_modulus` and `core_nu`
-- the core's, and each of `elements` has its own. For a composite also `part` of each particle (0: the
-- shell, else the core's number), `shell` and `core`, each { EA, EI, GJ } of that part alone, core
-- that of each core; `centres` {x, y, z} of the cores, `bore`, `core_radius` and `ring_radius` of the
-- shell's particles [m]; without bonds, links with `slide` = true, `gap` between the bodies [m] and
-- `direction`, a unit vector. Two bonded cores lie along x: EI is that of their plane, EI2 is less.
-- Bending is equal in all planes if ring and cores look the same after a third of a turn or less;
-- EI2 shows it
local function run(args)
  args = with_body(args)
  if type(args) == "table" and args.cable ~= nil then args = with_cable(args) end
  local c = core.calibrate(args)
  c.mesh = args.mesh
  return setmetatable(c, Calibration)
end

-- Calls f; errors name the line of the script.
local function call(f, ...)
  local result = table.pack(pcall(f, ...))
  if result[1] then return table.unpack(result, 2, result.n) end
  local text = result[2]
  error(type(text) == "string" and text:gsub("^[^%s:]+%.lua:%d+: ", "") or text, 3)
end

local function number(what, value)
  if type(value) == "number" then return value end
  error(("cell: %s must be a number, got %s"):format(what, type(value)), 0)
end

local function sorted_groups(stiffness)
  local names = {}
  for name in pairs(stiffness) do
    if type(name) ~= "string" then
      error(("cell: groups of stiffness have names; [%s] is not one"):format(checks.shown(name)), 0)
    end
    names[#names + 1] = name
  end
  table.sort(names)
  return names
end

-- Keys of a link and of an element: those that are read, and those that only sw.calibrate gives.
local link_keys = { "from", "to", "slices", "group", "weight", "bend", "slide", "gap", "direction" }
local element_keys = { "particles", "modulus", "nu", "slices" }

local function flat_links(links, names)
  local flat, index = {}, {}
  for i, name in ipairs(names) do index[name] = i end
  for i, l in ipairs(links) do
    if type(l) ~= "table" then error(("cell: link %d must be a table"):format(i), 0) end
    checks.only(("cell: link %d"):format(i), l, link_keys, 0)
    local group = index[l.group]
    if not group then
      local near = type(l.group) == "string" and core.nearest(l.group, names)
      error(("cell: link %d: stiffness has no group '%s'%s"):format(i, checks.shown(l.group),
        near and ("; did you mean '%s'?"):format(near) or ""), 0)
    end
    for k, value in ipairs { number("from of link " .. i, l.from), number("to of link " .. i, l.to),
      number("slices of link " .. i, l.slices or 0), group,
      number("weight of link " .. i, l.weight or 1), l.bend and 1 or 0 } do
      flat[6 * (i - 1) + k] = value
    end
  end
  return flat
end

-- Raises an error for a group of stiffness that no link uses: its name is misspelt, or links are missing.
-- Groups of a calibration may be left over: a part of its mesh does not have them all.
local function check_used(links, names)
  local used, list = {}, {}
  for _, name in ipairs(order) do used[name] = true end
  for _, l in ipairs(links) do
    if not list[l.group] then list[l.group], list[#list + 1] = true, l.group end
  end
  for _, name in ipairs(names) do
    if not (used[name] or list[name]) then
      local near = #name > 1 and core.nearest(name, list) -- any letter is near to x
      error(("cell: stiffness has a group '%s', which no link uses; %s"):format(name, near
        and ("did you mean '%s'?"):format(near) or #list == 0 and "there are no links"
        or "links use: " .. table.concat(list, " ")), 0)
    end
  end
end

-- Returns for each element 6 or 8, its particles, its group and nu, in one list. Moduli become further groups
-- of stiffness.
local function flat_elements(args, stiffness)
  local flat, groups = {}, {}
  for i, e in ipairs(args.elements or {}) do
    local list = type(e) == "table" and e.particles
    if type(list) ~= "table" or #list ~= 6 and #list ~= 8 then
      error(("cell: element %d must have a list of 6 or 8 particles"):format(i), 0)
    end
    checks.only(("cell: element %d"):format(i), e, element_keys, 0)
    flat[#flat + 1] = #list
    for k = 1, 8 do
      flat[#flat + 1] = k <= #list and number(("particle %d of element %d"):format(k, i), list[k]) or 0
    end
    local modulus = number("modulus", args.modulus or e.modulus)
    local group = groups[modulus]
    if not group then
      stiffness[#stiffness + 1] = modulus
      group = #stiffness
      if modulus == modulus then groups[modulus] = group end -- the core reports a NaN
    end
    flat[#flat + 1] = group
    flat[#flat + 1] = number("nu", args.nu or e.nu)
  end
  return flat
end

local cell_keys = { "spacing", "particles", "links", "stiffness", "elements", "modulus", "nu" }

local function check_cell(args)
  if checks.kind(args) ~= "table" then
    error("cell takes one table of parameters, got " .. checks.kind(args), 0)
  end
  for key in pairs(args) do
    local known = false
    for _, name in ipairs(cell_keys) do known = known or key == name end
    if not known then
      local near = type(key) == "string" and core.nearest(key, cell_keys)
      error(("cell: there is no parameter '%s'; %s"):format(checks.shown(key), near
        and ("did you mean '%s'?"):format(near) or "known are: " .. table.concat(cell_keys, " ")), 0)
    end
  end
  for _, key in ipairs { "particles", "links", "stiffness" } do
    if type(args[key]) ~= "table" then
      error(("cell: %s must be a table, got %s"):format(key, type(args[key])), 0)
    end
    if key ~= "stiffness" then checks.only("cell: " .. key, args[key], nil, 0) end
  end
end

local function cell(args)
  check_cell(args)
  local names, places, stiffness = sorted_groups(args.stiffness), {}, {}
  for i, p in ipairs(args.particles) do
    if type(p) ~= "table" then error(("cell: particle %d must be {x, y, z} [m]"):format(i), 0) end
    checks.only(("cell: particle %d"):format(i), p, nil, 0)
    for k = 1, 3 do places[3 * (i - 1) + k] = number(("particle %d, item %d,"):format(i, k), p[k]) end
  end
  for i, name in ipairs(names) do
    stiffness[i] = number("stiffness of " .. name, args.stiffness[name])
  end
  local links = flat_links(args.links, names)
  check_used(args.links, names)
  local elements = flat_elements(args, stiffness)
  return core.cell(number("spacing", args.spacing), places, links, stiffness, elements)
end

--- Returns the beam that an endless mesh of springs is, exactly: any mesh whose slices repeat along z.
-- @tparam table args `spacing` of slices [m]; `particles`, a list of {x, y, z} [m]; `links`, a
-- list of { from =, to = particles' numbers, slices = how many slices further `to` is, group =,
-- weight = 1 }, or { from = i, to = i, slices = 1, bend = true, group = } for a spring against the
-- angle between slices; `stiffness` by group [N/m; bend N m]; `elements`, a list of { particles =
-- 6 or 8 numbers }, the first half of this slice, anticlockwise seen from the next one, the second
-- half the same of the next slice, with their `modulus` [Pa] and `nu`, or each with its own
-- @treturn table EA [N], EI (plane of x and z), EI2 (y and z), GJ [N m2], squeeze [Pa], and
-- `matrix`, 4 x 4: stretch, curvature about x, about y, twist
function calibrate.cell(args) return call(cell, args) end

return setmetatable(calibrate, { __call = function(_, args) return call(run, args) end })
