-- SPDX-License-Identifier: GPL-3.0-or-later
-- Grasp, then move: the same task is simulated twice. "plates": contact with the pads during the whole
-- task. "mixed": a mesh near the pads computes the squeeze; after that the wire is carried as a rod in a
-- rigid grip. Force and moment on the gripper are nearly the same, but the computing time is much shorter.
local sw = require "softworld"
local mm = sw.units.mm

local radius, L = mm(3), mm(200)

local function task(freeze)
  local scene = sw.scene { name = freeze and "mixed" or "plates" }
  scene:obstacle { name = "table", shape = "plane", friction = 0 }
  scene:force { kind = "damping", mass = 8 }
  local wire = scene:wire { E = sw.units.MPa(10), nu = 0.4, density = 1200, radius = radius,
    from = { 0, 0, radius }, to = { L, 0, radius } }
  local hand = scene:gripper { name = "hand", pads = { width = mm(20), friction = 0.6, opening = mm(9) } }
  local seen = { phases = {} }
  local clock, began = os.clock(), 0
  local function phase(name)
    local now = os.clock()
    seen.phases[name] = { cpu = now - clock, time = scene.time - began }
    clock, began = now, scene.time
  end
  scene:process(function(p)
    hand:grasp(wire, { s = L / 2, approach = "mixed", force = 20, freeze = freeze })
    phase "grasp"
    hand:move { by = { 0, 0, mm(120) }, duration = 1 }
    p:wait(1.5)
    seen.force, seen.moment = hand:force()[3], hand:moment { at = wire:position(L / 4) }[2]
    seen.height = hand:squeeze().height
    hand:move { by = { 0, mm(300), 0 }, duration = 2 }
    p:wait(0.5)
    phase "carry"
    hand:move { by = { 0, 0, -mm(115) }, duration = 1 }
    hand:release()
    phase "lay"
  end)
  local run = scene:run { dt = 0.01 }
  assert(run.ok, run.reason)
  for _, e in ipairs(run.events) do print(e.kind, e.text) end -- no peak is read here
  seen.events = hand.events
  return seen
end

local mixed, plates = task(true), task(false)
for _, e in ipairs(mixed.events) do
  print(("%-7s at t = %.2f s: energy of section and pads %+.3g mJ"):format(e.kind, e.time, 1e3 * e.energy))
end
print "             plates      mixed"
for _, row in ipairs { { "force", "force", 1, "N" }, { "moment", "moment", 1e3, "mN m" },
  { "height", "height", 1e3, "mm" } } do
  local a, b = plates[row[2]] * row[3], mixed[row[2]] * row[3]
  print(("%-8s %10.4f %10.4f %s (%+.2f %%)"):format(row[1], a, b, row[4], 100 * (b / a - 1)))
end
for _, name in ipairs { "grasp", "carry", "lay" } do
  local a, b = plates.phases[name], mixed.phases[name]
  print(("%-8s %9.3f s %9.3f s of computing per second"):format(name, a.cpu / a.time, b.cpu / b.time))
end
local a, b = plates.phases.carry, mixed.phases.carry
print(("carrying is %.0f times cheaper"):format(a.cpu / a.time / (b.cpu / b.time)))
