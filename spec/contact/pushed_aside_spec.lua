-- SPDX-License-Identifier: GPL-3.0-or-later
-- A blade that goes and turns pushes a loose cable over a table, in poses. Slow motion takes it to the same
-- place, also in a scene that is turned with gravity. Single poses threw the cable 250 mm away, while the
-- blade went 0.15 mm: Newton's iteration had lost the way.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local vec = require "softworld.vec"
local t = require "spec.physics.tools"

local MU, LENGTH, THICK = 0.3, 0.2, 0.02
local TURNED = {
  { cable = "H07V-K 4", segments = 80, dt = 0.01, q = { 0.40466, 0.27047, -0.24523, 0.18408 } },
  { cable = "H07V-K 4", segments = 80, dt = 0.01, q = { 0.04059, 0.48478, -0.17990, 0.18200 } },
  { cable = "H07V-K 4", segments = 80, dt = 0.01, q = { 0.14348, -0.21887, 0.20916, 0.05550 } },
  { cable = "GXL 1.5", segments = 40, dt = 0.005, q = { -0.25448, -0.14852, -0.33105, -0.08145 } },
  { cable = "GXL 1.5", segments = 40, dt = 0.005, q = { -0.46207, 0.00599, -0.13976, -0.01092 } },
  { cable = "FLRY-B 0.5", segments = 40, dt = 0.01, q = { 0.6, 0.3, -0.5, 0.4 } },
}

-- Returns both ends and the blade's force over the friction mu W in the axes of the scene that is not turned.
local function pushed(case, q, how)
  local size = vec.norm({ vec.norm({ q[1], q[2], q[3] }), q[4], 0 })
  local turn = { q[1] / size, q[2] / size, q[3] / size, q[4] / size }
  local back = { turn[1], -turn[2], -turn[3], -turn[4] }
  local scene = sw.scene{ gravity = vec.rotate(turn, { 0, 0, -9.81 }) }
  scene:obstacle{ shape = "plane", friction = MU, rotation = turn }
  local r = sw.cable(case.cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = case.cable, segments = case.segments,
    from = vec.rotate(turn, { -LENGTH / 2, 0, r }), to = vec.rotate(turn, { LENGTH / 2, 0, r }) }
  local blade = scene:obstacle{ shape = "box", size = { 0.3, THICK, THICK }, friction = 0.1, rotation = turn,
    at = vec.rotate(turn, { 0, -THICK / 2 - r - 0.001, THICK / 2 + 0.0005 }) }
  blade:follow{ points = { { 0, 0, 0 }, vec.rotate(turn, { 0.01, 0.03, 0 }) },
    turn = { axis = vec.rotate(turn, { 0, 0, 1 }), angle = 0.6 }, duration = how.duration, relative = true }
  local run = t.fine(scene:run{ duration = how.duration, dt = how.dt, quasistatic = how.quasistatic })
  assert.are.equal(0, #run.events)
  local friction = MU * wire.beam.mass_per_length * LENGTH * 9.81
  local function here(v) return vec.rotate(back, v) end
  return here(wire:position(0)), here(wire:position(LENGTH)), vec.scale(here(blade:force()), 1 / friction)
end

local slow = {}
-- Returns the same of slow motion, in the scene that is not turned.
local function wanted(case)
  local key = case.cable .. case.segments
  if not slow[key] then slow[key] = { pushed(case, { 1, 0, 0, 0 }, { duration = 10, dt = 0.02 }) } end
  return table.unpack(slow[key])
end

describe("a loose cable that a blade pushes over a table in poses lies as after slow motion:", function()
  for k, case in ipairs(TURNED) do
    for turned, q in pairs{ straight = { 1, 0, 0, 0 }, turned = case.q } do
      it(("%s, %d, %s"):format(case.cable, k, turned), function()
        local a1, b1, f1 = wanted(case)
        local a, b, f = pushed(case, q, { duration = 2, dt = case.dt, quasistatic = true })
        t.near(0, t.distance(a1, a), 5e-4, "end [m]")
        t.near(0, t.distance(b1, b), 5e-4, "other end [m]")
        t.near(0, t.distance(f1, f), 0.002, "force over friction")
      end)
    end
  end
end)
