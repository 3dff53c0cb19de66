-- SPDX-License-Identifier: GPL-3.0-or-later
-- A run that fails because two obstacles squeeze a rod asks for other paths, not for a shorter dt.
local sw = require "softworld"

describe("a rod that a ram squeezes against a wall", function()
  it("fails with the names of both", function()
    for _, dt in ipairs{ 0.02, 0.005 } do
      local scene = sw.scene{ name = "squeezed" }
      scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
      scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.0015 }, to = { 0.3, 0, 0.0015 },
        segments = 30 }
      scene:force{ kind = "damping", mass = 3, stiffness = 0.001 }
      scene:obstacle{ name = "wall", shape = "box", size = { 1, 0.02, 0.1 }, at = { 0.15, 0.02, 0.05 } }
      local ram = scene:obstacle{ name = "ram", shape = "box", size = { 0.05, 0.02, 0.1 },
        at = { 0.15, -0.03, 0.05 } }
      ram:follow{ points = { { 0, 0, 0 }, { 0, 0.03, 0 } }, relative = true, duration = 0.5 }
      local run = scene:run{ dt = dt, duration = 0.8 }
      assert.is_false(run.ok)
      assert.matches("; try other paths: '%a+' and '%a+' squeeze 'wire' from t = 0%.%d+ s on, and its "
        .. "section does not yield; or pads, or a mesh as the wire's model", run.reason)
      assert.is_nil(run.reason:find("dt =", 1, true))
    end
  end)
end)
