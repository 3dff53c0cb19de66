-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
Forces of blows, and peaks as means over a window of time
  obstacle:force()      force of wires on it [N]: the mean over the last step, blows included; so are
                        the series "NAME.contact_force" and what pads add to a gripper's series. Over any
                        time it adds up to weight times time plus the change of momentum. After settle,
                        and in quasi-static runs, it is the force of that equilibrium
  obstacle:over(t1, t2, { window = [s] })      between two times (default: all):
    .peak_force .peak_force_time               [N], [s]; see below
    .raw_peak_force .raw_peak_force_time .raw_peak_force_span   of a single step, when, how long it was
    .mean_force .duration                      of its size over time [N], [s]
    .impulse .impulse_size                     vector, its size [N s]
    .peak_force_text                           "12.3 N (10 ms mean; raw 41 N in 0.4 ms)"
  gripper:over(t1, t2, { window = [s], at = point })   the same, and of moments; gripper.peak_force and
                        the like are those of all the time
  wire:max_tension()    -> [N], s [m], t [s]: of means, edge by edge; the summary tells the raw one too
  wire:max_tension{ raw = true }    -> of single steps, and as a fourth value how long that step was [s]
  wire:max_tension{ now = true }    -> of the present state

The force of a blow grows without end as steps and edges get shorter: a wave runs along the wire, and
what is near the blow bears density times speed of sound times area times speed. What a gripper, a
table or a conductor gets from it is the impulse. So peaks are the largest mean over a window of
10 ms that moves along:
  scene:run{ window = 0.01 }    [s]; 0: raw, the largest of single steps
It counts for max_tension of that run, and wherever no window is given until the next run; error bars
(tolerance = { ["left.peak_force"] = ..., max_tension = ... }) are of these means. What is averaged is the
force as a vector, and each edge's tension.
  A window is always whole: it begins and ends within what was recorded, and t is its end. A record
  shorter than that has one mean, of all of it, and says so.
  A constant force is exact. A force that rises evenly and stays for one window loses nothing; one
  that rises for a time T and ends there, with the run, loses window/(2 T): under 2 % from 25 windows
  (0.25 s) on. A peak that falls as fast as it rose loses half of that.
  A blow of impulse J that is shorter than the window counts as J/window, however short its steps.
  A step as long as the window or longer counts as it is, and this is said: "raw, in a step of 20 ms,
  longer than the window of 10 ms". So do equilibria: "at rest".
  Hard blows are followed in parts of a step, of 0.1 ms at the shortest: where an obstacle gets more in
  a step than the weight of the wire (or the force that bends it), and than ever before, and it comes or
  goes within the step. Lighter ones are smeared over two steps; with steps as long as the window that may
  be half of the peak. So are the forces of grippers and clamps that start or stop with a jerk: they are
  those at the step's end, and too large by up to 3.4 where the step is long. "make stability" lists what
  depends on the step.
  Of a step of 10 ms or more a tension counts with its mean over the step.
  Steps may be uneven. max_tension looks at windows that end with a step, at least 1/16 of the window
  apart; the others at all windows that begin or end with a step.
]]
