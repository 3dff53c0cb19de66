-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two grippers lift a wire off the table. Each has its own process. Then the right gripper releases
-- the wire, and the left one carries the whole load.
local sw = require "softworld"
local mm = sw.units.mm

local scene = sw.scene { name = "two grippers" }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
local wire = scene:wire { name = "wire", E = sw.units.MPa(200), density = 1500, radius = mm(2.5),
  from = mm { 0, 0, 2.5 }, to = mm { 800, 0, 2.5 }, segments = 80 }
scene:force { kind = "damping", on = wire, mass = 2, stiffness = sw.units.ms(5) }
local left = scene:gripper { name = "left", pads = { width = mm(20) } }
local right = scene:gripper { name = "right", pads = { width = mm(20) } }

-- Variables by which the processes wait for each other. Both grippers must hold before either one lifts.
local holding, lifted, alone = 0, 0, false

scene:process(function(p)
  left:grasp(wire, { s = mm(250) })
  holding = holding + 1
  p:wait_until(function() return holding == 2 end)
  left:move { by = mm { 0, 0, 600 }, duration = 2 }
  lifted = lifted + 1
  p:wait_until(function() return alone end)
  p:wait(5)
end)

scene:process(function(p)
  p:wait(0.3) -- the right gripper starts later
  right:grasp(wire, { s = mm(550) })
  holding = holding + 1
  right:move { by = mm { -40, 0, 600 }, duration = 2 } -- also towards the left one, so that the wire sags
  lifted = lifted + 1
  p:wait_until(function() return lifted == 2 end)
  p:wait(4)
  local l, r = left:force(), right:force()
  print(("both hold: left %.4f N, right %.4f N, together %.4f N up"):format(l.z, r.z, l.z + r.z))
  right:release()
  alone = true
end)

local run = scene:run { tolerance = 1e-5 }
assert(run.ok, run.reason)
print(("left alone: %.4f N up; weight %.4f N"):format(left:force().z,
  wire.beam.mass_per_length * 9.81 * wire.length))
print(("largest moment: left %.4f N m, right %.4f N m"):format(left.peak_moment, right.peak_moment))
