-- SPDX-License-Identifier: GPL-3.0-or-later
-- Holds that were made and taken away cost little memory, however many there were.
local sw = require "softworld"

-- Memory of this process that is in use [MB].
local function resident()
  collectgarbage()
  collectgarbage()
  local file <close> = assert(io.open "/proc/self/statm")
  return select(2, file:read("n", "n")) * 4096 / 1e6
end

describe("memory of holds that are gone", function()
  it("grows with their number, not with its square", function()
    local scene <close> = sw.scene{}
    local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025, from = { 0, 0, 0 },
      to = { -1, 0, 0 }, segments = 20 }
    local before = resident()
    local first
    for _ = 1, 4000 do
      local hold = scene:clamp(wire, { s = 0 })
      first = first or hold
      scene:remove(hold)
    end
    local grown = resident() - before -- 13 MB; 315 MB when each made the heap larger [MB]
    assert.is_true(grown < 50, ("%.1f MB"):format(grown))
    assert.is_false(first.held)
    assert.is_true(scene:clamp(wire, { s = 0 }).held)
  end)
end)

describe("a gripper's release", function()
  it("does not look through all earlier grasps", function()
    local scene <close> = sw.scene{}
    local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025, from = { 0, 0, 0 },
      to = { -1, 0, 0 }, segments = 20 }
    local hand = scene:gripper{ name = "hand" }
    local function instructions()
      local count = 0
      hand:grasp(wire, { s = 0.1 })
      debug.sethook(function() count = count + 1 end, "", 1)
      hand:release()
      debug.sethook()
      return count
    end
    for _ = 1, 5 do instructions() end
    local few = instructions()
    for _ = 1, 200 do
      hand:grasp(wire, { s = 0.1 })
      hand:release()
    end
    assert.is_true(instructions() < few + 100) -- 5 more per grasp when it looked through all
  end)
end)
