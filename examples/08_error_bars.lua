-- SPDX-License-Identifier: GPL-3.0-or-later
-- How accurate are the results? Give a tolerance for each quantity instead of segments and time steps.
-- The result then has an error bound for each quantity.
local sw = require "softworld"
local mm = sw.units.mm

-- A gripper lifts the end of a cable from a table and keeps it horizontal. Its force [N] and moment [N m]:
local scene = sw.scene { name = "lift" }
scene:obstacle { shape = "plane", friction = 0 }
local cable = scene:wire { EA = 1e4, EI = 2.943e-4, mass_per_length = 0.03, radius = mm(1),
  from = mm { -800, 0, 1 }, to = mm { 0, 0, 1 } }
local gripper = scene:clamp(cable, { name = "gripper", s = cable.length })
for k = 1, 4 do
  gripper:pose(mm { 0, 0, 1 + 50 * k / 4 })
  assert(scene:settle().ok)
end

local settled = scene:settle { tolerance = {
  ["gripper.force"] = 0.5e-3, ["gripper.moment"] = 0.02e-3, -- quantities of objects, by name
  { name = "height at 0.7 m", value = mm(1), unit = "m", -- and your own quantities
    of = function() return cable:position(0.7)[3] end } } }
assert(settled.ok, settled.reason)
print(settled:error_bars())
local force, moment = settled.quantities["gripper.force"], settled.quantities["gripper.moment"]
print(("force %.3f +- %.3f mN, moment %.4f +- %.4f mN m"):format(1e3 * force.value[3], 1e3 * force.error,
  1e3 * moment.value[2], 1e3 * moment.error))

-- A wire falls and swings from a clamp at one end. The position of its free end after half a second [m]:
scene = sw.scene { name = "swing" }
local wire = scene:wire { E = 9.4176e8, density = 1500, radius = mm(2.5), from = { 0, 0, 0 },
  to = { 1, 0, 0 }, segments = 20 }
scene:clamp(wire, { s = 0 })
local run = scene:run { duration = 0.5, tolerance = { tip = mm(0.5) } }
assert(run.ok, run.reason)
local tip = run.quantities.tip
print(("end at x = %.4f, z = %.4f +- %.4f m, from %d levels"):format(tip.value[1], tip.value[3], tip.error,
  #run.levels))
