-- SPDX-License-Identifier: GPL-3.0-or-later
-- Three wires whose stiffness was identified from their hanging shape and from the
-- twist at which a straight wire buckles, project adapteddlo_muj (qj25, GitHub). Mass
-- is weighed; the project gives neither diameters nor constructions.
local rows = {
  -- name, mass [g/m] and its highest reading, EI [N m2], GJ/EI (mean, lowest, highest), OD [mm]
  { "white", 17.4, 17.5, 1.22e-4, 0.82, 0.82, 0.83, 2.8 },
  { "black", 26.8, 27.2, 1.20e-3, 1.46, 1.38, 1.53, 3.5 },
  { "red", 21.5, 21.6, 9.30e-4, 1.64, 1.52, 1.78, 3.1 },
}

local project = "identified rods of the project adapteddlo_muj"
local list = {}
for i, row in ipairs(rows) do
  local colour, mass, most, EI, ratio, low, high, od = table.unpack(row)
  local EA = 115e9 * mass / 2000 / 8930
  list[i] = {
    name = "identified " .. colour,
    description = ("a %s wire, unknown make"):format(colour),
    outer_diameter = { value = od / 1000, low = 0.75 * od / 1000, high = 1.4 * od / 1000,
      flag = "guessed", source = "that of a GXL of this mass" },
    mass_per_length = { value = mass / 1000, low = mass / 1010, high = most / 1000, flag = "measured",
      source = project .. ", weighed" },
    EA = { value = EA, low = EA / 10, high = 2 * EA, flag = "guessed",
      source = "as if half of the mass were copper" },
    EI = { value = EI, low = 0.9 * EI, high = 1.1 * EI, flag = "measured",
      source = project .. ", hanging shapes; spread assumed" },
    GJ = { value = ratio * EI, low = 0.9 * low * EI, high = 1.1 * high * EI, flag = "measured",
      source = project .. (": GJ/EI = %g from twist that buckles it"):format(ratio) },
    friction = { value = 0.4, low = 0.15, high = 0.8, flag = "guessed",
      source = "range of polymers on steel" },
    temperature = { low = 0, high = 60, flag = "guessed", source = "any insulation of wires" },
    bend = { rule = "IEC 62440", use = "fixed", flag = "guessed",
      source = "IEC 62440:2008, of a guessed diameter" },
  }
end
return list
