-- SPDX-License-Identifier: GPL-3.0-or-later
-- Processes that wait for each other go on at the same time, whatever the step and the order in which they
-- were made. The one made first went on a step later: a gripper that waits for another one was late by dt.
local sw = require "softworld"

-- Returns when the waiting process went on; first: it is made before the other one.
local function times(first, dt)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0.3 }, to = { 0.4, 0, 0.3 } }
  scene:clamp(wire, { s = 0 })
  local go, list = false, {}
  local function waits(p)
    p:wait_until(function() return go end)
    list[1] = p.time
    go = false
    p:wait_until(function() return go end)
    list[2] = p.time
  end
  local function sets(p)
    p:wait(0.037)
    go = true
    p:wait_until(function() return not go end)
    list[3] = p.time
    p:wait(0.02)
    go = true
  end
  if first then scene:process(waits) end
  scene:process(sets)
  if not first then scene:process(waits) end
  assert.is_true(scene:run{ dt = dt }.ok)
  return list
end

-- A scene with a wire that hangs from a clamp.
local function hanging()
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0.3 }, to = { 0.4, 0, 0.3 } }
  scene:clamp(wire, { s = 0 })
  return scene
end

describe("processes that wait for each other", function()
  it("go on at the same time", function()
    for _, dt in ipairs{ 0.01, 0.0025 } do
      for _, first in ipairs{ true, false } do
        local list = times(first, dt)
        assert.near(0.037, list[1], 1e-12)
        assert.near(0.037, list[3], 1e-12)
        assert.near(0.057, list[2], 1e-12)
      end
    end
  end)

  -- Conditions are asked again at one time only if another process has gone on.
  it("are asked once per step if nothing else goes on", function()
    local scene = hanging()
    local asked = 0
    for _ = 1, 2 do
      scene:process(function(p)
        p:wait_until(function()
          asked = asked + 1
          return false
        end, { timeout = 0.1 })
      end)
    end
    assert.is_true(scene:run{ dt = 0.01, parts = false }.ok)
    assert.is_true(asked <= 2 * 12, asked)
  end)

  -- Two that pass a flag to and fro without end let time pass all the same.
  it("do not stop the time", function()
    local scene = hanging()
    local turn = 1
    for k = 1, 2 do
      scene:process(function(p)
        while p.time < 0.05 do
          p:wait_until(function() return turn == k end, { timeout = 0.02 })
          turn = 3 - k
        end
      end)
    end
    assert.is_true(scene:run{ dt = 0.01 }.ok)
    assert.is_true(scene.time >= 0.05)
  end)
end)
