-- SPDX-License-Identifier: GPL-3.0-or-later
-- H07V-K (EN 50525-2-31, IEC 60227-3 type 02): single cores of switch cabinets, PVC.
local rows = {
  -- mm2, smallest and largest mean OD [mm], strands, strand [mm] (usual class 5)
  { 1.5, 2.8, 3.4, 30, 0.25 },
  { 2.5, 3.4, 4.1, 50, 0.25 },
  { 4, 3.9, 4.8, 56, 0.30 },
  { 6, 4.4, 5.3, 84, 0.30 },
  { 10, 5.7, 6.8, 80, 0.40 },
}

local list = {}
for i, row in ipairs(rows) do
  local size, least, most, strands, strand = table.unpack(row)
  list[i] = {
    name = ("H07V-K %g"):format(size),
    description = ("single core for cabinets EN 50525-2-31 H07V-K, %g mm2"):format(size),
    outer_diameter = { value = (least + most) / 2000, low = least / 1000, high = most / 1000,
      flag = "computed", source = "middle of the range of IEC 60227-3 for type 02" },
    construction = { strands = strands, strand_diameter = strand / 1000, conductor = "copper",
      insulation = "PVC", source = "usual stranding of IEC 60228 class 5, assumed" },
    temperature = { low = -30, high = 70, flag = "measured",
      source = "usual rating of H07V-K, laid fixed; not below +5 degC while it is bent" },
    bend = { rule = "IEC 62440", use = "fixed", flag = "measured", source = "IEC 62440:2008" },
  }
end
return list
