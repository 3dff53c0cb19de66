-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads let go a wire that is a mesh of solid elements, in the air. Its section recovers, and the wire falls
-- without tension. In the step in which the pads let go it had up to 210 times its weight: the springs beside
-- the elements were read between both stages, the elements at the step's end, and their forces nearly cancel.
-- One step later it had 19 weights of push and 1.5 of tension, at all steps: the error of the last update of
-- Newton's iteration, with which that step began.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.03 -- [m]

-- Writes a scene in which pads hold a wire in the air by its middle. Returns the file.
local function hold(case)
  local radius = sw.cable(case.cable).outer_diameter.value / 2
  local half, file = case.turn / 2, os.tmpname()
  local scene = sw.scene{}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 8, stiffness = case.stiffness }
  local wire = scene:wire{ name = "wire", cable = case.cable, model = "radial", body = "solid",
    from = { 0, 0, radius }, to = { LENGTH * math.cos(case.turn), LENGTH * math.sin(case.turn), radius } }
  local hand = scene:gripper{ name = "hand", pads = { width = case.width },
    rotation = { math.cos(half), 0, 0, math.sin(half) } }
  scene:process(function()
    hand:grasp(wire, { s = LENGTH / 2, force = case.force, approach = "plates" })
    hand:move{ by = { 0, 0, 0.03 }, duration = 0.2 }
  end)
  t.fine(scene:run{ dt = 0.02, duration = 0.7 })
  scene:save(file)
  return file
end

-- Lets the wire go; calls each(wire, hand) after each step. Returns its weight [N].
local function let_go(file, speed, dt, steps, each)
  local scene = sw.load(file)
  local wire, hand = scene:find "wire", scene:find "hand"
  scene:process(function() hand:release{ speed = speed } end)
  scene:process(function(p)
    for _ = 1, steps do p:wait(dt) each(wire, hand) end
  end)
  t.fine(scene:run{ dt = dt, duration = steps * dt })
  return 9.81 * wire.beam.mass_per_length * LENGTH
end

local cases = {
  { cable = "GXL 0.5", width = 0.006, force = 10, turn = 0, stiffness = 0 },
  { cable = "GXL 0.5", width = 0.006, force = 10, turn = 0.7, stiffness = 1e-3 },
  { cable = "FLRY-B 0.5", width = 0.008, force = 3, turn = 0, stiffness = 0 },
}

describe("a wire of solid elements that pads let go", function()
  for _, case in ipairs(cases) do
    local name = ("%s, turned by %g"):format(case.cable, case.turn)
    local file
    before_each(function() file = file or hold(case) end)
    teardown(function() os.remove(file) end)

    it("has no tension afterwards: " .. name, function()
      for _, dt in ipairs{ 0.02, 0.01, 0.0025 } do
        local most, push = 0, 0
        local weight = let_go(file, 0.1, dt, 4, function(wire)
          most = math.max(most, (wire:max_tension{ now = true }))
          push = math.max(push, -wire:tension(0.51 * LENGTH))
        end)
        -- its halves come to rest from 5 mm/s at most in a step: m/2 5 mm/s / 2.5 ms = 0.1 m g
        t.below(0.1, most / weight, ("tension over the weight, %g ms"):format(1e3 * dt))
        t.below(0.1, push / weight, ("push over the weight, %g ms"):format(1e3 * dt))
      end
    end)

    -- As long as the section does not slide on the pads, its push is elastic: it falls as their force does.
    -- Half the mass is moved by the section's way, micrometres: 3 % of the push in a step of 0.4 ms.
    if case.stiffness > 0 then goto continue end -- dashpots push too
    it("has a push that falls with the pads' force: " .. name, function()
      for _, dt in ipairs{ 4e-4, 2e-4, 1e-4 } do
        local scene = sw.load(file)
        local at, whole = 0.51 * LENGTH, scene:find "hand":state().squeeze
        local before = -scene:find "wire":tension(at)
        let_go(file, 0.02, dt, 3, function(wire, hand)
          local share = -wire:tension(at) / before
          t.near(hand:state().squeeze / whole, share, 0.05, ("push over that held, %g ms"):format(1e3 * dt))
        end)
      end
    end)
    ::continue::
  end
end)
