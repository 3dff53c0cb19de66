-- SPDX-License-Identifier: GPL-3.0-or-later
-- Thin-wall automotive wire, ISO 6722 temperature class B, as FLRY-B (many thin
-- strands, PVC). ISO 6722 gives the largest outer diameter; the strands are assumed
-- to be the thickest that IEC 60228 class 5 allows.
local rows = {
  -- mm2, largest OD [mm], strands, strand [mm]
  { 0.5, 1.7, 16, 0.21 },
  { 0.75, 1.9, 24, 0.21 },
  { 1, 2.1, 32, 0.21 },
  { 1.5, 2.4, 30, 0.26 },
  { 2.5, 3.0, 50, 0.26 },
  { 4, 3.7, 56, 0.31 },
  { 6, 4.3, 84, 0.31 },
  { 10, 6.0, 80, 0.41 },
}

local list = {}
for i, row in ipairs(rows) do
  local size, od, strands, strand = table.unpack(row)
  list[i] = {
    name = ("FLRY-B %g"):format(size),
    description = ("thin-wall automotive wire ISO 6722 class B, %g mm2"):format(size),
    outer_diameter = { value = od / 1000, low = 0.9 * od / 1000, high = od / 1000, flag = "measured",
      source = "ISO 6722 thin wall, the largest allowed; 10 % below it assumed possible" },
    construction = { strands = strands, strand_diameter = strand / 1000, conductor = "copper",
      insulation = "PVC", source = "strands by IEC 60228 class 5, assumed" },
    temperature = { low = -40, high = 100, flag = "measured", source = "ISO 6722 class B" },
    bend = { rule = "IEC 62440", use = "fixed", flag = "guessed",
      source = "IEC 62440:2008 is for cables up to 450/750 V; borrowed" },
  }
end
return list
