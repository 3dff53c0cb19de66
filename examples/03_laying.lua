-- SPDX-License-Identifier: GPL-3.0-or-later
-- Laying: a wire lies on a table. A gripper draws it over three thin walls and into the groove of a
-- guide block, then releases it. Which loads act on the gripper and on the wire?
--
--   softworld examples/03_laying.lua                all files, into out/laying
--   softworld examples/03_laying.lua quick folder   numbers and series only, into folder
local sw = require "softworld"
local mm = sw.units.mm

local here = arg[0]:match "^.*/" or "./"
local quick, out = arg[1] == "quick", arg[2] or "out/laying"
assert(os.execute("mkdir -p '" .. out .. "'"))
loadfile(here .. "data/make_guide.lua")(out .. "/guide.stl")

-- The workplace: table, walls and guide.
local scene = sw.scene { name = "laying" }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
for i, x in ipairs(mm { 150, 450, 750 }) do
  scene:obstacle { name = "wall " .. i, shape = "box", size = mm { 10, 1000, 100 },
    at = { x, 0, mm(50) }, friction = 0.3 }
end
scene:obstacle { name = "guide", shape = "mesh", file = out .. "/guide.stl", scale = mm(1),
  at = mm { 1000, 60, 0 }, friction = 0.3 }

-- A soft cable of 5 mm diameter lies straight on the table. Its sheath damps it.
local wire = scene:wire { name = "wire", E = sw.units.MPa(50), density = 1500, radius = mm(2.5),
  from = mm { 0, 0, 2.5 }, to = mm { -1250, 0, 2.5 }, segments = 125 }
scene:force { kind = "damping", on = wire, stiffness = sw.units.ms(5) }

-- The task of the gripper.
local gripper = scene:gripper { name = "gripper", pads = { width = mm(20) } }
scene:process(function(p)
  gripper:grasp(wire, { s = mm(30) })
  gripper:move { path = here .. "data/lay.csv", speed = 0.25 }
  p:wait(0.5)
  gripper:release()
  p:wait(1)
end)

local run = scene:run { tolerance = 1e-5, dt = 0.002, progress = true }
run:summary()
run:save(out .. "/laying.csv")

if quick then
  print(("peak force %.4g N, mean moment %.4g N m"):format(gripper.peak_force, gripper.mean_moment))
  print(("smallest bend radius %.4g m, largest tension %.4g N, deepest penetration %.2g m"):format(
    (wire:min_bend_radius()), (wire:max_tension()), (scene:penetration())))
  return
end

run:report(out .. "/laying.html") -- open this file in a browser to play the run
run:chart { path = out .. "/gripper.svg", title = "What the gripper bears",
  columns = { "gripper.force", "gripper.force_x", "gripper.force_z", "gripper.moment" } }
run:chart { path = out .. "/contacts.svg", title = "What table, walls and guide bear", mean = 0.05,
  columns = { "table.contact_force", "wall 1.contact_force", "wall 2.contact_force",
    "wall 3.contact_force", "guide.contact_force" } }
run:chart { path = out .. "/energy.svg", title = "Energy of the wire", energy = true }
run:vtk(out .. "/laying.pvd")
print "tracing six pictures ..."
run:pictures { path = out .. "/laying.png", columns = 2, times = { 0, 2.5, 4.7, 6.5, 7.8, run.time },
  captions = { "grasped", "lifted", "drawn over the first wall", "over all three",
    "down to the guide", "released" }, camera = { turn = 27, elevation = 17, angle = 20 } }
