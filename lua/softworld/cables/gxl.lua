-- SPDX-License-Identifier: GPL-3.0-or-later
-- GXL, SAE J1128: automotive wire, cross-linked polyethylene, general wall.
-- Sizes are trade sizes: the masses fit SAE strandings of the AWG size named within
-- 6 %, not the full number of mm2 (GXL 4 with 4 mm2 would weigh a fifth more).
local rows = {
  -- mm2, OD [mm], mass [g/m], AWG, strands, strand [mm] (AWG 28, 30, 29, 27, 25, 23, 21)
  { 0.5, 2.4, 10.4, 20, 7, 0.321 },
  { 1, 2.6, 13.4, 18, 16, 0.255 },
  { 1.5, 3.0, 19.3, 16, 19, 0.286 },
  { 2.5, 3.5, 28.3, 14, 19, 0.361 },
  { 4, 4.1, 38.7, 12, 19, 0.455 },
  { 6, 4.8, 59.5, 10, 19, 0.573 },
  { 10, 5.9, 95.2, 8, 19, 0.723 },
}

local list = {}
for i, row in ipairs(rows) do
  local size, od, mass, awg, strands, strand = table.unpack(row)
  list[i] = {
    name = ("GXL %g"):format(size),
    description = ("automotive wire SAE J1128 GXL, %g mm2 (%d AWG)"):format(size, awg),
    outer_diameter = { value = od / 1000, low = od / 1050, high = od / 950, flag = "measured",
      source = "makers' tables of GXL, nominal; spread 5 % assumed" },
    mass_per_length = { value = mass / 1000, low = mass / 1080, high = mass / 920, flag = "measured",
      source = "makers' tables of GXL, approximate; spread 8 % assumed" },
    construction = { strands = strands, strand_diameter = strand / 1000, conductor = "copper",
      insulation = "XLPE", source = ("usual SAE J1128 stranding of %d AWG"):format(awg) },
    temperature = { low = -40, high = 125, flag = "measured",
      source = "usual rating of GXL; some makers give -51 degC" },
    bend = { rule = "IEC 62440", use = "fixed", flag = "guessed",
      source = "IEC 62440:2008 is for cables up to 450/750 V; borrowed" },
  }
end
return list
