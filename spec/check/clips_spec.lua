-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of clips: their largest load in the run, and whether the wire is seated at the end.
local sw = require "softworld"

-- A hand presses a cable into a clip (into) and pulls it out again (out).
local function pressed(into, out)
  local scene = sw.scene{ name = "clip" }
  local wire = scene:wire{ name = "cable", E = 60e6, density = 1500, radius = 0.004, segments = 30,
    from = { 0, 0, 0.045 }, to = { 0.2, 0, 0.045 } }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.003 }
  scene:clip{ name = "clip", at = { 0.1, 0, 0.014 }, width = 0.01, insertion = 8, retention = 25,
    friction = 0.25 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.008 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.115 })
    if into then hand:clip{ into = scene:find "clip", speed = 0.1, max_force = 40 } end
    if out then hand:move{ by = { 0, 0, 0.05 }, duration = 0.5 } end
    p:wait(0.1)
  end)
  return scene:run{ dt = 0.005 }, scene
end

local function verdicts(check)
  local list = {}
  for _, row in ipairs(check.rows) do
    local name = row.name:match "^clip%.(.+)$"
    if name then list[name] = row.verdict end
  end
  return list
end

describe("run:check of a clip", function()
  it("gives the insertion force, and passes when the wire is seated", function()
    local run, scene = pressed(true)
    local check = run:check{ limits = { insertion_force = 10, ["clip.retention_used"] = 0.9 } }
    assert.same({ insertion_force = "PASS", retention_used = "PASS", seated = "PASS" }, verdicts(check))
    local row = check:row "insertion_force"
    local into = scene:find "clip".inserted
    assert.same({ into.peak_force, into.time, into.s }, { row.value, row.time, row.s })
    assert.is_near(8, row.value, 0.2)
    assert.equal("FAIL", run:check{ limits = { insertion_force = 7 } }:row "insertion_force".verdict)
    -- insertion forces of an earlier run do not count in this one
    check = scene:run{ duration = 0.02, dt = 0.005 }:check{ limits = { insertion_force = 7 } }
    assert.equal("OPEN", check:row "insertion_force".verdict)
    assert.equal("PASS", check:row "clip.seated".verdict)
  end)

  -- The hand of the second run pulls the seated wire with less force than the one of the first. A run that
  -- only waits has the pull that the wire bears at its start. ratio() is that of all runs.
  it("has the largest pull of its own run, also after an edit", function()
    local _, scene = pressed(true)
    local clip, hand = scene:find "clip", scene:find "hand"
    local function used(height, edit)
      if edit then scene:obstacle{ shape = "plane", at = { 0, 0, -0.5 } } end
      scene:process(function(p)
        if height ~= 0 then hand:move{ by = { 0, 0, height }, duration = 0.2 } end
        p:wait(0.1)
      end)
      local run = scene:run{ dt = 0.005 }
      return run:check():row "retention_used".value, math.abs(clip:force()[3]) / 25
    end
    local high, held = used(0.0004)
    assert.is_near(held, high, 0.02 * held)
    for _, edit in ipairs{ false, true } do
      local waits, now = used(0, edit)
      assert.is_near(now, waits, 0.02 * now)
      local less, at_end = used(-0.0004, edit)
      assert.is_near(waits, less, 0.02 * waits) -- its pull at the start
      assert.is_true(at_end < 0.8 * waits)
      less = used(0, edit)
      assert.is_near(at_end, less, 0.02 * waits)
      assert.is_near(high, clip:ratio(), 0.02 * high)
      used(0.0004, edit)
    end
  end)

  it("counts its rows in good English", function()
    local limits = { min_bend_radius = false, max_sidewall = false, max_tension = 1e3,
      peak_force = 1e3 }
    local run = pressed(true)
    assert.equal("6 of 7 rows pass, 0 fail, 1 is open", run:check{ limits = limits }.reason)
    limits.peak_force, limits.peak_moment = 1, 1
    assert.equal("6 of 7 rows pass, 1 fails, 0 are open", run:check{ limits = limits }.reason)
  end)

  it("fails where the wire is not seated at the end", function()
    local check = pressed(false):check{}
    assert.same({ seated = "FAIL" }, verdicts(check))
    assert.truthy(check:row "seated".note:find("it is empty", 1, true))
    assert.same({ "clip.seated" }, pressed(false):check{ limits = { ["clip.seated"] = false } }.skipped)
  end)

  it("fails where the wire came out again", function()
    local check = pressed(true, true):check{}
    assert.same({ retention_used = "FAIL", seated = "FAIL" }, verdicts(check))
    local row = check:row "retention_used"
    assert.is_near(1, row.value, 0.05)
    assert.truthy(row.note:find("'cable' came out", 1, true), row.note)
  end)
end)
