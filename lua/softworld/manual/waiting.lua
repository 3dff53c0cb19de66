-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
p:wait_until(condition)      inside of a process; condition: a function, or a table:
  { force = [N], on = gripper, hold or obstacle }   { slip = [m], on = gripper }
  { contact = obstacle }                            { distance = [m], between = { a, b } }
p:wait_until(condition, { timeout = [s] })          returns false when the time has passed

Without a timeout a run that only its processes end may go on for ever. It tells who waits, at
which line and since when: as an event ("waiting") after 10, 100, ... s of simulated time and at
the end of a run, and on stderr after 10, 20, ... s of real time (not with progress = false).
What nothing can make true is an error at that line: contact with an obstacle that was removed, a
force on a hold that was released, or on a gripper that holds nothing when no other process is
there to let it grasp, objects of another scene, the distance of two fixed points.]]
