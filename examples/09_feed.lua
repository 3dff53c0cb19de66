-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feeder pushes a wire from a spool horizontally across a gap. How far does the wire reach before it
-- droops too much, and which force must the feeder's drive bear? Then the feeder pays out more wire
-- onto a table below, while a gripper moves the wire's end away.
local sw = require "softworld"
local mm = sw.units.mm

local scene = sw.scene { name = "feed" }
local floor = scene:obstacle { name = "table", shape = "plane", at = mm { 0, 0, -250 }, friction = 0.3 }
local wire = scene:wire { EA = 2e4, EI = 2.943e-3, mass_per_length = 0.03, radius = mm(2),
  from = { 0, 0, 0 }, to = mm { 60, 0, 0 }, segments = 6 }
scene:force { kind = "damping", on = wire, mass = 2, stiffness = sw.units.ms(2) }
local feeder = scene:feed(wire, { s = 0, name = "feeder" })
local gripper = scene:gripper { name = "gripper", pads = { width = mm(20) } }

scene:process(function(p)
  for _, reach in ipairs(mm { 150, 250, 359.38 }) do
    p:feed(feeder, { length = reach - wire.length, speed = 0.1 })
    p:wait(3) -- until the wire is at rest
    print(("reach %6.2f mm: droop %6.2f mm, drive %7.4f N, walls and drive %7.4f N along"):format(
      1e3 * wire.length, -1e3 * wire:position(wire.length).z, feeder:drive_force(),
      feeder:force().x))
  end
  gripper:grasp(wire, { s = wire.length - mm(10) })
  feeder:feed { length = mm(900), duration = 4 }
  gripper:move { by = mm { 500, 40, -70 }, duration = 4 }
  p:wait(2)
end)

local run = scene:run { dt = 0.005 }
assert(run.ok, run.reason)
print(("fed %.1f mm; feeder %.4f N, gripper %.4f N, table %.4f N: together %.4f N; weight %.4f N"):format(
  1e3 * feeder:fed(), feeder:force().z, gripper:force().z, -floor:force().z,
  feeder:force()[3] + gripper:force()[3] - floor:force()[3], 0.03 * 9.81 * wire.length))
