-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that leaves its clip is told: a script that reads nothing of the clip would take the run for a
-- success.
local sw = require "softworld"

-- Presses a wire into a clip at x = 0.15 m and moves it away by these vectors. Returns run, clip.
local function away(options, ...)
  local scene = sw.scene{ gravity = options.gravity }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", segments = 80, from = { 0, 0, 0.05 },
    to = { 0.3, 0, 0.05 } }
  scene:force{ kind = "damping", mass = 2, stiffness = 2e-3 }
  local clip = scene:clip{ name = "c", at = { 0.15, 0, 0.02 }, width = 0.01, insertion = 2, retention = 4 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.006 } }
  local moves = { ... }
  scene:process(function(p)
    hand:grasp(wire, { s = options.s or 0.15 })
    hand:clip{ into = clip }
    p:wait(0.1)
    for _, by in ipairs(moves) do hand:move{ by = by, speed = 0.05 } end
    p:wait(0.1)
  end)
  local run = scene:run{}
  assert.is_true(run.ok)
  local out = {}
  for _, e in ipairs(run.events) do if e.kind == "out" then out[#out + 1] = e end end
  return out, clip
end

describe("a wire that leaves its clip", function()
  -- 5e-3: steps follow the lips' peak within 2 % (clip_steps_spec); a wire that is pulled straight out,
  -- slowly, meets it more closely.
  it("is told with its force when it is pulled out", function()
    local out, clip = away({}, { 0, 0, 0.03 })
    assert.are.equal(1, #out)
    assert.are.equal("c", out[1].object)
    assert.near(4, out[1].value, 5e-3 * 4)
    assert.are.equal(clip.pulled_out.peak_force, out[1].value)
    assert.near(clip.pulled_out.time, out[1].time, 1e-12)
    assert.is_truthy(out[1].text:find("the wire comes out, at [%d.]+ N; its retention is 4 N"))
  end)

  it("is told when it slides out along the axis", function()
    local out, clip = away({ gravity = { 0, 0, 0 }, s = 0.13 }, { -0.16, 0, 0 })
    assert.are.equal(1, #out)
    assert.are.equal("clip 'c', wire 'w': the wire slides out along the clip's axis", out[1].text)
    assert.is_false(clip:seated())
  end)

  it("is not told while it stays", function()
    local out, clip = away({}, { 0, 0, 0.0002 })
    assert.are.equal(0, #out)
    assert.is_true(clip:seated())
  end)
end)
