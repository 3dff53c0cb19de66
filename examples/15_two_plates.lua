-- SPDX-License-Identifier: GPL-3.0-or-later
-- A soft wire lies on a table. Two rough plates close on it, lift it, carry it sideways and lay it down.
-- The script prints force, moment and the squeezed section. The whole wire is a mesh of particles.
--   15_two_plates.lua [picture.png [sections.svg]]
local sw = require "softworld"
local mm = sw.units.mm

local radius, L = mm(3), mm(200)
local scene = sw.scene { name = "two plates" }
scene:obstacle { name = "table", shape = "plane", friction = 0.4 }
scene:force { kind = "damping", mass = 8 }
local wire = scene:wire { name = "wire", model = "radial", section = "solid", E = sw.units.MPa(10), nu = 0.4,
  density = 1200, radius = radius, from = { 0, 0, radius }, to = { L, 0, radius } }
local hand = scene:gripper { name = "hand",
  pads = { width = mm(20), height = mm(16), thickness = mm(4), friction = 0.6, opening = mm(9) } }

print "              force up   moment      squeeze      height     width     margin"
local function tell(what)
  local now, section = hand:state(), hand:squeeze()
  print(("%-10s %9.4f N %7.2f mN m %7.2f N %8.3f mm %7.3f mm %8.3f"):format(what, hand:force()[3],
    1e3 * hand:moment { at = wire:position(L / 4) }[2], now.squeeze, 1e3 * section.height,
    1e3 * section.width, now.margin))
end

local free, squeezed = wire:section(L / 2), nil
scene:process(function(p)
  hand:grasp(wire, { s = L / 2, approach = "plates", force = 20 })
  tell "closed"
  hand:move { by = { 0, 0, mm(100) }, duration = 1 }
  p:wait(0.5)
  tell "lifted"
  squeezed = wire:section(L / 2)
  hand:move { by = { 0, mm(80), 0 }, duration = 0.8 }
  p:wait(0.2)
  tell "carried"
  hand:move { by = { 0, 0, -mm(98) }, duration = 1 }
  tell "laid down"
  hand:release()
  p:wait(0.3)
end)

local run = scene:run { dt = 0.0025, progress = true }
assert(run.ok, run.reason)
print(("peak force %.4f N, peak moment %.3g N m about the tool centre; %s"):format(hand.peak_force,
  hand.peak_moment, hand.slip_event and "it slipped" or "no slip"))
print(("%.1f s of motion took %.1f s of computing"):format(run.time, run.cpu))
if arg[1] then
  run:pictures { path = arg[1], count = 4, camera = { direction = { 1, 0.25, -0.35 } } }
end
if arg[2] then
  free:chart { path = arg[2], name = "free", with = { { "between the plates", squeezed } } }
end
