-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
run:ledger()     where the energy of a run came from and went [J]; print it for a table
  .at_start .total .kinetic .stored .gravity          then; and now
  .work   { holds, obstacles, feeds, forces, changes }
          changes: of the scene itself, as a new velocity; letting a wire out of what it began in
  .lost   { damping, friction, plasticity, impact, contact, integrator, jumps }
          contact: in steps in which touches began or ended; jumps: of quasi-static equilibria
  .gap    from nowhere; .gained the part of it beyond all work
  .play   what was in play: largest kinetic energy, work, energy released
          at_start + work - lost + gap = total, each step booked by itself
  .redone .halved .accepted    { count, largest [J], time [s], object, s [m] }, see below
wire:bend_energy()   stored in bending now, of any model [J]; in scene:energy() that of meshes is
                 part of what their springs (stretch) or elements (solid) store
scene:energy()   kinetic, gravity, stored by kind, and their total, now [J]
Series have the columns energy.kinetic, .stored, .gravity, .gap, .lost.

The referee: a step of an implicit method that makes more energy than its errors may is done again.
Where something touches, first by the method's start, then with implicit Euler, then in halves; where
nothing touches, in halves. The smallest step, 1/4096, is taken all the same and counted in accepted.
Explicit methods and implicit-midpoint are not judged, for their energy goes to and fro.
Gains of 2 % of what was in play are an event of the run; with 5 % it has ok = false. Smaller steps
help. More than 1 % of steps redone is an event too: peaks and fast motion are then less exact.
Quasi-static runs: work = change of potential + friction + jumps; nothing is judged.]]
