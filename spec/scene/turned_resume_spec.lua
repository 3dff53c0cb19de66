-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that turn a rod are watched by looks between steps, which must not change bits, also after a resume.
local sw = require "softworld"

-- A hand carries and turns a cable; the run stops in step number `stop`. Returns positions as text, or nil.
local function carried(file, stop)
  local scene = sw.scene{ name = "turned" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.0015 },
    to = { 0.4, 0, 0.0015 },
    segments = 40 }
  scene:force{ kind = "damping", mass = 3, stiffness = 0.001 }
  local clamp = scene:clamp(wire, { s = 0.35 })
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.6 } }
  scene:process(function(p)
    p:step("grasp", function() hand:grasp(wire, { s = 0.1, approach = "plates", force = 15 }) end)
    for k = 1, 4 do
      p:step("move" .. k, function()
        if k == stop then error "stop" end
        local sign = k % 2 == 1 and 1 or -1
        hand:move{ by = { 0.02 * sign, -0.03 * sign, 0.05 * sign }, duration = 0.9,
          turn = { axis = { 0, 0, 1 }, angle = 0.3 * sign } }
      end)
    end
  end)
  local fine, run = pcall(scene.run, scene, { dt = 0.01, save = file, resume = file })
  if not fine or not run.ok then return nil end
  local words = {}
  for i, x in ipairs((wire:positions())) do words[i] = ("%a"):format(x) end
  return table.concat(words, " ") .. (" %a"):format(clamp:over().peak_force)
end

describe("a run with pads that turn", function()
  it("has the same bits after a resume", function()
    local file = os.tmpname()
    os.remove(file)
    local whole = carried(nil)
    assert.is_string(whole)
    for stop = 2, 4 do
      assert.is_nil(carried(file, stop))
      assert.equal(whole, carried(file))
      os.remove(file)
    end
  end)
end)
