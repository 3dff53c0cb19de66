-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable harness: two branches are tied to the end of a trunk. Two grippers move the branches to their
-- plugs. Which forces act in the joint, and what is the smallest bend radius of each wire?
local sw = require "softworld"
local mm, deg = sw.units.mm, sw.units.deg

local scene = sw.scene { name = "harness" }
scene:obstacle { shape = "plane", name = "table", friction = 0.3 }
scene:force { kind = "damping", mass = 2, stiffness = sw.units.ms(5) }
local height = mm(4)

local trunk = scene:wire { name = "trunk", cable = "GXL 6", from = { 0, 0, height },
  to = { mm(500), 0, height }, segments = 50 }
local function branch(name, angle)
  return scene:wire { name = name, cable = "GXL 1.5", from = { mm(500), 0, height },
    to = { mm(500) + mm(300) * math.cos(angle), mm(300) * math.sin(angle), height }, segments = 40 }
end
local left, right = branch("left", deg(35)), branch("right", deg(-35))

local joint = scene:join { name = "joint",
  ends = { { trunk, s = trunk.length }, { left, s = 0 }, { right, s = 0 } } }
scene:clamp(trunk, { s = 0 })
scene:wire_contact { friction = 0.3 }
assert(scene:settle().ok)

for _, side in ipairs { { left, "left hand", 1 }, { right, "right hand", -1 } } do
  local wire, name, way = table.unpack(side)
  local hand = scene:gripper { name = name, pads = { width = mm(15) } }
  scene:process(function(p)
    hand:grasp(wire, { s = wire.length })
    hand:move { by = mm { -20, 0, 120 }, duration = 1 }
    hand:move { by = mm { -40, way * 40, 0 }, duration = 1 }
    p:wait(1)
  end)
end

local run = scene:run { dt = 5e-3, frame = 0.02 }
assert(run.ok, run.reason)

for k, wire in ipairs { trunk, left, right } do
  local f = joint:force(k)
  print(("joint on %-5s  %8.4f %8.4f %8.4f N   tightest bend of the run %.1f mm (limit %.1f mm)"):format(
    wire.name, f[1], f[2], f[3], wire:min_bend_radius() * 1e3, wire:bend_limit().limit * 1e3))
end
for _, event in ipairs(run.events) do print(event.text) end
print(("the joint is %.1f mm above the table"):format(left:position(0).z * 1e3))
