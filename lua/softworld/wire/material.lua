-- SPDX-License-Identifier: GPL-3.0-or-later
--- Materials of cables, with the range over which materials of that name vary.
--
--     local copper = sw.material "copper"
--     print(copper.E.value, copper.E.low, copper.E.high)   -- [Pa]
--
-- E: Young's modulus [Pa], G: shear modulus [Pa], density [kg/m3], friction:
-- sliding on steel or hard plastic [-]. Polymers: E is that at small strain and
-- 20 degC, and G = E/3, as for a material that keeps its volume.
-- @module softworld.wire.material
local core = require "softworld.core"
local checks = require "softworld.checks"

local GPa, MPa = 1e9, 1e6

local function quantity(unit, flag, source, scale, value, low, high)
  return { value = value * scale, low = low * scale, high = high * scale, unit = unit,
    flag = flag, source = source }
end

local function metal(name, E, G, density)
  local source = "handbook values of " .. name
  return { name = name, kind = "metal",
    E = quantity("Pa", "measured", source, GPa, table.unpack(E)),
    G = quantity("Pa", "measured", source, GPa, table.unpack(G)),
    density = quantity("kg/m3", "measured", source, 1, table.unpack(density)) }
end

local function polymer(name, E, density, friction)
  local source = "usual range of data sheets of " .. name .. "; compounds differ widely"
  return { name = name, kind = "polymer",
    E = quantity("Pa", "guessed", source, MPa, table.unpack(E)),
    G = quantity("Pa", "computed", "E/3 (a material that keeps its volume)", MPa / 3, table.unpack(E)),
    density = quantity("kg/m3", "guessed", source, 1, table.unpack(density)),
    friction = quantity("-", "guessed", "usual range on steel and hard plastic, dry", 1,
      table.unpack(friction)) }
end

-- { value, low, high }
local known = {
  metal("copper", { 115, 105, 130 }, { 43, 39, 48 }, { 8930, 8890, 8960 }),
  metal("aluminium", { 69, 65, 72 }, { 26, 24, 27 }, { 2700, 2680, 2720 }),
  polymer("XLPE", { 150, 80, 300 }, { 1350, 930, 1450 }, { 0.25, 0.15, 0.4 }),
  polymer("PVC", { 60, 15, 200 }, { 1400, 1250, 1550 }, { 0.4, 0.25, 0.6 }),
  polymer("PUR", { 30, 10, 80 }, { 1150, 1100, 1250 }, { 0.5, 0.3, 0.8 }),
  polymer("silicone", { 5, 2, 10 }, { 1250, 1100, 1400 }, { 0.7, 0.4, 1.0 }),
}

local by_name, names = {}, {}
for i, entry in ipairs(known) do by_name[entry.name], names[i] = entry, entry.name end

local material = { names = names }

--- Returns the material by its name, or nil and a message.
function material.find(name)
  local entry = by_name[name]
  if entry then return entry end
  local near = type(name) == "string" and core.nearest(name, names)
  return nil, ("there is no material '%s'; %s"):format(checks.shown(name),
    near and ("did you mean '%s'?"):format(near) or "known are " .. table.concat(names, " "))
end

return setmetatable(material, { __call = function(_, name)
  local entry, why = material.find(name)
  if not entry then error(why, 2) end
  return entry
end })
