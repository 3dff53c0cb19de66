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
end)
