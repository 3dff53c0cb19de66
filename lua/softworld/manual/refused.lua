-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
What runs refuse, and what they tell by themselves (see help "events").

explicit steps   dt above the stable one of an explicit integrator is refused: leapfrog_limit / 2
                 times scene:stable_dt(), 1 for velocity-verlet, 1.41 for rk4 (help "rk4" tells
                 it). unstable = true takes such steps all the same.
diverged         a state with a velocity that is no number, or with an edge, spring or solid
                 element 11 times its length, is refused; after the smallest step the run fails.
buckling         a perfectly straight wire stays so under any push. The event tells the push; draw
                 the wire bent by a thousandth of its length, or add a small force across.
                 wire:frequencies() has unstable, growth [1/s] and note when the rest is unstable.
grasp            pads press on another wire than the one that was to be grasped, or on one more.
                 In a process the first is an error of gripper:grasp.
breaking         a wire is pulled beyond its breaking load: see help "breaking".
kink             a tube with wall_bending is folded at one place: see help "kinks".
tie              a tie breaks, within 1 % of what it bears: steps and poses are cut there.
integrator       implicit-midpoint in contact: it gains energy there; take tr-bdf2.
tolerances       run.met is false when one of the tolerances asked for was not met; the summary and
                 print(run) name them, run.advice tells what would help.
plane_strain     holds a wire where it lies when the force is made; at [m] moves it elsewhere.
pose(position)   keeps the rotation of an obstacle or a hold; pose(position, rotation) sets both.]]
