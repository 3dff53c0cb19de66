-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
Wires pulled harder than they bear
An event of kind "breaking" tells the largest pull (a mean over the run's window, see help "peaks"),
where, when, and since when (first). Nothing breaks: the wire is simulated on. A load comes from
  scene:wire{ breaking_load = 250, breaking_flag = "measured" }   flags: given measured computed guessed
  sw.cable.define{ breaking_load = 250, ... }                     of one's own cable, with its spread
  the catalogue: area of the strands times 220 MPa (copper) or 75 MPa (aluminium), annealed: computed;
                 print(sw.cable "GXL 1.5") shows it
Wires without any of these are never told of. Runs that fail say by what a wire was pulled beyond its
load, and which obstacle presses one hardest. A run stops when 20000 parts of its steps were shorter
than dt/512 in the mean (at a tolerance: dt * 2e-5), and says why larger ones fail.
]]
