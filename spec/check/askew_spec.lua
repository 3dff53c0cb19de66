-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rows of the check that depend on a wire which lies askew in a clip. Lips that yield place by place take
-- less than the given force; lips that yield only as one are those of a clip much narrower than its lips
-- are long, so a narrow clip tells what the rows of a wide one may be.
local sw = require "softworld"
local t = require "spec.physics.tools"

local INSERTION, RETENTION = 8, 25 -- [N]

-- A hand holds a cable `beside` a clip of this width, presses it in and lifts it by `lift`.
local function handled(case, width, lift)
  local scene, dt = sw.scene{}, case.dt or 0.002
  local shift = case.shift or 0
  local wire = scene:wire{ name = "cable", cable = case.cable or "GXL 1.5", segments = case.segments or 80,
    from = { shift, 0, 0.03 }, to = { 0.2 + shift, 0, 0.03 } }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.003 }
  local clip = scene:clip{ name = "c", at = { 0.1, 0, 0.014 }, width = width, insertion = INSERTION,
    retention = RETENTION, friction = 0.25 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.008 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.1 + case.beside - shift })
    hand:clip{ into = clip, speed = 0.05, max_force = 80 }
    p:wait(0.05)
    if lift then hand:move{ by = { 0, 0, lift }, speed = 0.02 } end
  end)
  local run = t.fine(scene:run{ dt = dt })
  return run, clip
end

-- Returns the row of this name, or nil.
local function row(run, name, limits)
  for _, one in ipairs(run:check{ limits = limits, trial = true }.rows) do
    if one.name == name then return one end
  end
end

describe("a wire that goes in askew", function()
  -- In the narrow clip the wire rises by up to 15 degrees at the lips' top. The clip's force is summed along
  -- the wire, which is longer by 1/cos(15 degrees) than its way along the axis.
  it("has ranges that hold what lips that yield as one take", function()
    for _, case in ipairs{ { beside = 0.013 }, { beside = 0.013, dt = 0.001, shift = 0.0008 },
      { beside = 0.013, segments = 120 } } do
      local run = handled(case, 0.01)
      local narrow = handled(case, 0.001)
      local limits = { ["c.insertion_force"] = { max = 7.5, sure = true }, min_bend_radius =
        { min = 0.001, sure = true }, peak_force = { max = 1e3, sure = true } }
      local force, as_one = row(run, "c.insertion_force", limits), row(narrow, "c.insertion_force", limits)
      t.below(7.2, force.value, "peeled")
      assert.equal(INSERTION, force.high)
      t.above(force.low, as_one.value, "as one")
      t.below(force.high / math.cos(math.rad(15)), as_one.value, "as one")
      assert.equal("OPEN", force.verdict) -- 7.5 N lies between 6.6 and 8 N
      assert.truthy(force.note:find("event 'askew'", 1, true), force.note)
      local bend, bend_one = row(run, "cable.min_bend_radius", limits), row(narrow, "cable.min_bend_radius",
        limits)
      t.below(bend.value, bend_one.value, "bend") -- without the range the row would be wrong
      t.below(bend_one.value, bend.low, "range of the bend")
      t.below(bend_one.value / 0.6, bend.value, "range of use")
    end
  end)

  it("is not sure to be seated, and passes beyond the given force", function()
    local run = handled({ beside = 0.013 }, 0.01)
    local seated = row(run, "c.seated")
    assert.equal("OPEN", seated.verdict)
    assert.truthy(seated.note:find("8 N on the way in", 1, true), seated.note)
    assert.equal("PASS", row(run, "c.insertion_force", { insertion_force = 10 }).verdict)
    assert.equal("FAIL", row(run, "c.insertion_force", { insertion_force = 6 }).verdict)
  end)

  it("is open no more if it is straight", function()
    local run = handled({ beside = 0 }, 0.01)
    local force = row(run, "c.insertion_force", { insertion_force = 9 })
    assert.equal("PASS", force.verdict)
    assert.is_nil(force.high)
    assert.equal("PASS", row(run, "c.seated").verdict)
  end)
end)

-- Share of the force at which the wire comes out: its pull over the largest one with which it comes out if it
-- is lifted on. The range must hold it, but for 0.05: the hand has pressed the wire in askew, so it is first
-- turned back, and at a small pull it passes the tilt 0, which tells nothing of the moment.
describe("a wire that is pulled askew", function()
  it("has the share of the pull that peels it out in the range of its retention used", function()
    for _, case in ipairs{ { beside = 0.013 }, { beside = 0.008 }, { beside = 0.013, cable = "H07V-K 4" },
      { beside = 0.011, shift = 0.001, dt = 0.001 } } do
      local seen, most = {}, 0
      for _, lift in ipairs{ 0.0001, 0.0002, 0.0004, 0.0008, 0.0012, 0.0016, 0.002, 0.03 } do
        local run, clip = handled(case, 0.01, lift)
        local used = row(run, "c.retention_used")
        if clip.pulled_out then
          most = math.max(most, clip.pulled_out.peak_force / RETENTION)
          assert.equal("FAIL", used.verdict)
        elseif used and used.value > 0 then
          seen[#seen + 1], most = used, math.max(most, used.value)
        end
      end
      assert.is_true(#seen > 1 and most < 0.9) -- peeled out
      for _, used in ipairs(seen) do
        t.above(used.value / most - 0.05, used.high or used.value, "share")
      end
    end
  end)

  it("is open where it is nearly peeled out and the limit is above its value", function()
    local run = handled({ beside = 0.013 }, 0.01, 0.0015)
    local used = row(run, "c.retention_used", { retention_used = 0.5 })
    t.below(0.4, used.value, "share")
    assert.equal("OPEN", used.verdict)
    assert.truthy(used.note:find("pulled askew", 1, true), used.note)
  end)
end)
