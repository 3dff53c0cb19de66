-- SPDX-License-Identifier: GPL-3.0-or-later
-- What are the stiffnesses of a cable? Three measurements (a photograph of 1 m between two clamps, the twist
-- at which a piece buckles, a pull test) give EI, GJ, EA with 95 % intervals, as an entry for the catalogue.
--
--   softworld examples/22_calibration.lua [sag.svg]
local sw = require "softworld"
local here = arg[0]:match "^(.*/)" or ""
local mm = sw.units.mm

local found = sw.calibration { name = "cable of the bench", source = "bench, photograph 14",
  outer_diameter = mm(4.2), mass_per_length = { 0.0268, sigma = 0.0001 },
  sag = { file = here .. "data/sag.csv", length = 1, to = { 1 / 1.05, 0 },
    -- four marks on the board behind the cable: position in the picture [px], true position [m]
    pixels = { { 313, 161, 0, 0.05 }, { 1729, 122, 1, 0.05 }, { 1696, 539, 1, -0.25 },
      { 298, 627, 0, -0.25 } },
    pixel_sigma = 1 },
  twist = { file = here .. "data/twist.csv", length = 0.3, sigma = 0.2 },
  pull = { file = here .. "data/pull.csv", length = 0.5 } }

print(found)
print(found.cable)
if arg[1] then found:chart { of = "sag", path = arg[1] } end
