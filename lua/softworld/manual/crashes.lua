-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
Grips, clamps, pins, feeds and the parts of grippers go where they are told: nothing stops them.
What they are driven into is told instead, in run.events and at the end of the summary:
  crash      a wire that a hold holds rigidly is in an obstacle, deeper by a quarter of its radius than
             where it was taken hold of; or a pad or arm is. value: the depth [m]
  overload   a hold drives a wire with more force than any wire like it bears: EA, or 4 GPa over its
             section. value: the force [N]
Forces of a run are wrong from its first crash on.
clamp:crash()      { time = [s], depth = [m], obstacle = } of the last one, nil = none
gripper.events     the same as { kind = "crash", part =, obstacle =, depth =, time = }
scene:gripper{ on_crash = "record" | "warn" | "stop" | function(gripper, event) }   = "record";
                   for imposed grips as for pads]]
