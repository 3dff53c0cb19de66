-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
Tubes that kink: scene:wire{ model = "tube", core = false, wall_bending = E t^3/12 }

A tube that is bent flattens, and its moment grows ever less. With a = curvature * R^2 / t (R: radius
of the wall's middle, t: its thickness)
  flattening, of the radius        about a^2
  moment, of EI * curvature        about 1 - 1.5 a^2 (Brazier); at a = 0.47 it would be largest
  wall buckles in short waves at   a = 0.38 (elastic walls): at 95 % of that moment
Beyond the tube folds at one place, its moment drops, and the rest of it springs back. Settling and
runs go through that: the event of kind "kink" tells where, how far it is bent there, what moment it
bears there, and at what curvature and moment its wall was due to buckle; scene:settle() has kinked,
the same text. Walls of a fold do not touch each other, so that the moment of a sharp fold is too low.
Slices (spacing) of up to about 1.5 sqrt(R t) can follow these waves; with longer ones the wall holds
longer. At R/t = 10 slices of R/2 and R/4 buckle at a = 0.39 and 0.38.
wire:calibration() is that of the springs; the wall by itself adds EI = 2 pi R wall_bending, at most
2 %, which they have less.
]]
