-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
Remarks: what is allowed but hardly meant is told on stderr by the program softworld, once for a line
of the script: a radius of 2.5 m (of 2.5 mm?), E = 50 Pa, density = 1500000 kg/m3, friction = 30, a
speed of 200 m/s, a wire that begins inside of an obstacle. Nothing else changes.
  sw.remarks = false     no remarks from here on]]
