-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable sticks out of a fixture. How often does its end hang too low for a gripper, if stiffness and free
-- length are uncertain? The study runs on this machine, or as tasks of a Slurm cluster in a folder that
-- the cluster's nodes can access. Both ways use the same script and give the same numbers:
--
--   softworld examples/23_cluster.lua
--   SOFTWORLD_ON=slurm softworld examples/23_cluster.lua plug.study
local sw = require "softworld"
local mm = sw.units.mm

local study = sw.study { name = "plug", file = arg[1], seed = 3,
  parameters = { EI = { 0.002, 0.02, unit = "N m2", log = true }, free = { 0.1, 0.2, unit = "m" } },
  evaluate = function(p)
    local scene = sw.scene {}
    local cable = scene:wire { EI = p.EI, EA = 1e4, mass_per_length = 0.02, radius = mm(2), segments = 20,
      from = { 0, 0, 0 }, to = { p.free, 0, 0 } }
    scene:clamp(cable, { s = 0 })
    assert(scene:settle().ok)
    return { droop = -cable:position(p.free)[3] }
  end,
  constraints = { droop = { max = mm(3), unit = "m" } } }

-- On a cluster: four tasks. For a large study leave tasks out; each task then takes about 30 s.
study:run { tasks = 4 }
local spread = study:spread { count = 400 }

print(("within reach in %.1f %% of all cases (95 %% interval %.1f to %.1f %%)"):format(
  100 * spread.probability, 100 * spread.low, 100 * spread.high))
local worst = spread.worst[1]
print(("worst: %.1f mm at EI = %.4f N m2 with %.0f mm free"):format(1e3 * worst.droop, worst.EI,
  1e3 * worst.free))
