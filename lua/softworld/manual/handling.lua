-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
A gripper over a sequence: several grasps, several wires, moves while it is empty
  local hand = scene:gripper{ name = "hand", at = {0.1, 0, 0.3} }   where it is before the first grasp
  hand:move{ to = {0.1, 0, 0.2}, speed = 0.2 }    empty or not; takes its time in a process
  hand:wait(0.5)                                  stays, in a process [s]
  hand:approach(wire, { s = [m] }) or (point)     in a process: to distance before the place, then on
    distance = 0.05 [m], direction = {0, 0, -1}, speed = 0.2, slow = 0.05 [m/s]
    a gripper without at begins there; s = the place nearest to it
  hand:retreat{ distance = 0.05, direction = {0, 0, 1}, speed = 0.2 }
An empty gripper goes through things, unless it has real pads (pads with more than a width, arm,
on_crash), which then are there from its first move.
Several wires
  hand:grasp({ a, b }, { s = 0.1 | {0.1, 0.2} })  at once, imposed or approach = "plates"
  hand:grasp(a) hand:grasp(b)                     one after another, imposed only, while it rests
  hand:force() :moment()                          on all of them, about the tool's centre
  hand:force{ wire = a } :moment{ wire = a }      on one
  hand.wires                                      what it holds; hand.wire is the first
  hand:release{ wire = a } :release()             one (imposed only), or all
  hand:handover(other)                            all
In series, charts, CSV and pictures a gripper is one over all grasps: hand.force and so on, nan where
an imposed grip holds nothing. Means (mean_force, ...) are over the time in which it holds.]]
