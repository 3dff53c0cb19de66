-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
scene:force{ kind = "damping", on = wire, mass = [1/s], stiffness = [s] }   Rayleigh's
  mass         alpha: force -alpha m v; damps slow swings, and a fall
  stiffness    beta: axial force beta EA per rate of strain, bending moment beta EI per rate of
               curvature, clamps' hinges included; of meshes their springs, not their solid elements
  A mode of angular frequency omega has the damping ratio alpha/(2 omega) + beta omega/2.
  A wire that turns as a whole is not damped by stiffness, bent or not, at any step.
scene:force{ kind = "viscous_bend", on = wire, eta = [N m2 s] }   the bending part alone
wire:tension(s), max_tension() are axial forces with what the dashpots add; wire:strain(s), stress(s)
  and theirs are those of the strain. Clamps' moments have the dashpots' too.
Of sdirk2 alone the axial force counts what turns several times over (its last stage's
  acceleration is not that of the end of the step); positions are right.]]
