-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a tie has measured stays after its release.
local sw = require "softworld"
local t = require "spec.physics.tools"

describe("a tie", function()
  it("answers how it broke, and its peaks, after its release", function()
    local scene = sw.scene{ name = "cut" }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 },
      segments = 20 }
    local weak = scene:tie(wire, { name = "weak", s = 0.01, strength = 0.002 })
    local whole = scene:tie(wire, { name = "whole", s = 0.15, strength = 80 })
    local before, peaks
    scene:process(function(p)
      p:wait(0.3)
      before, peaks = weak.broken, { whole.peak_force, whole.raw_peak_force }
      weak:release()
      whole:release()
      p:wait(0.1)
    end)
    t.fine(scene:run{ dt = 0.01 })
    assert.same(before, weak.broken)
    assert.is_nil(whole.broken)
    t.above(0.09, peaks[1], "peak")
    assert.same(peaks, { whole.peak_force, whole.raw_peak_force })
    assert.has_error(function() whole:tension() end,
      "tie 'whole' was released, or taken back when a snapshot was restored")
  end)

  it("has no distance once a wire of it is removed", function()
    local scene = sw.scene{ name = "parted" }
    local wires = {}
    for k = 1, 2 do
      wires[k] = scene:wire{ cable = "GXL 1.5", from = { 0, 0.1 * k, 0.1 }, to = { 0.3, 0.1 * k, 0.1 },
        segments = 10 }
    end
    local tie = scene:join{ ends = { { wires[1], s = 0.1 }, { wires[2], s = 0.1 } }, slack = 0.2 }
    t.near(0.1, tie:read().distance, 1e-12)
    scene:remove(wires[2])
    assert.same({ tension = 0, peak = 0, broken = 0, broken_time = 0, broken_force = 0 }, tie:read())
    t.fine(scene:run{ duration = 0.02 })
    assert.is_nil(tie:read().distance)
  end)
end)
