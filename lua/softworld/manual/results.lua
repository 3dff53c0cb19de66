-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
What a run gives: columns of run:series(), run:save "x.csv" and run:chart
  gripper.force .moment, _x _y _z       [N], [N m]; with pads .opening .squeeze .margin .slip
  clamp.force .moment                   also of pins and feeds
  obstacle.contact_force                of wires on it [N]
  clip.force, tie.force, _x _y _z       on the wire [N] (of a tie between two: the first)
  wire.tension .bend_radius             largest tension [N], smallest radius [m] of the whole wire
  a value is nan while the thing is not there, the radius inf while the wire is straight
run:chart{ path = "x.svg", columns = { names }, energy = true, mean = [s], title =, size = }
  without columns: all, but components of vectors only where there are up to 8 curves of a unit
  radii of bends have a panel of their own, up to 100 times the smallest
run:vtk "x.pvd" (ParaView)              at nodes: radius, s, tension, bend_radius, contact_force
                                        (of obstacles, across the wire); the columns as field data
run:pictures{ path = "x.png", count = 6, times = { [s] }, captions =, columns = 3, camera = {...} }
  camera: from, to or direction {x, y, z}; or turn, elevation; angle [deg]
  clamps are blocks, pins balls, feeds tubes

A run that failed
  run.ok is false, run.reason tells why and what to try next; there are no numbers
  run:frames(), run:vtk and run:pictures show how far it came; pictures the last frames, marked
  a script that never looks at run.ok, run.reason, the summary or a print of the run is told so at its
  end, on stderr, and exits with 1. Runs within sw.tune.minimise and error bars need no look.]]
