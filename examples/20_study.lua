-- SPDX-License-Identifier: GPL-3.0-or-later
-- What is the smallest force with which a gripper can lift a wire, and how often is twice this force enough
-- if the friction is uncertain? Two studies answer this on all processors. With the name of a journal file,
-- an interrupted first study continues where it stopped:
--
--   softworld examples/20_study.lua [least.study]
local sw = require "softworld"
local mm = sw.units.mm

local function build(friction)
  local scene = sw.scene { name = "lift" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:force { kind = "damping", mass = 8 }
  local wire = scene:wire { cable = "GXL 1.5", from = mm { 0, 0, 1.5 }, to = mm { 300, 0, 1.5 } }
  local hand = scene:gripper { name = "hand", slip_tolerance = mm(0.2),
    pads = { width = mm(15), friction = friction, opening = mm(4) } }
  return scene, wire, hand
end

local function lift(force, scene, wire, hand)
  scene:process(function(p)
    hand:grasp(wire, { s = mm(150), approach = "plates", force = force, on_slip = "stop" })
    hand:move { by = mm { 0, 0, 250 }, duration = 0.5 }
    p:wait(0.3)
  end)
  local run = scene:run { dt = 0.005 }
  assert(run.ok, run.reason)
  return { margin = hand:over().peak_margin, slips = hand.slip_event ~= nil }
end

local least = sw.study { name = "least force", file = arg[1],
  parameters = { force = { 0.01, 1, unit = "N", log = true } },
  setup = function() return build(0.4) end, -- called once; the scene is restored before each evaluation
  evaluate = function(p, ...) return lift(p.force, ...) end,
  constraints = { slips = { max = 0 } } }
local found = least:minimise("force", { starts = 2, tolerance = 1e-3 })
print(least)

local doubt = sw.study { name = "friction", constraints = { slips = { max = 0 } },
  parameters = { friction = { 0.15, 0.8, start = 0.4, sigma = 0.1 } },
  evaluate = function(p) return lift(2 * found.value, build(p.friction)) end }
local spread = doubt:spread { count = 200 }

print(("least force %.4f N per finger"):format(found.value))
print(("twice that holds in %.1f %% of all cases (95 %% interval %.1f to %.1f %%)"):format(
  100 * spread.probability, 100 * spread.low, 100 * spread.high))
