-- SPDX-License-Identifier: GPL-3.0-or-later
-- Three pegs push a cable with friction, in steps chosen by a tight tolerance. The places where its chords
-- touch move from edge to edge. A chord that began to touch beside a node took the node's force once
-- more, from one moment to the next. The steps fell to 0.5 ns, and those after it were so short that touches,
-- which became softer in each step, lost their force. The cable then stayed behind, or sank in by 1.5 mm.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local tools = require "spec.physics.tools"
local mm = sw.units.mm

-- Returns the run of the pegs, with the cable's tension, the keeper's pull and the first peg's force [N].
local function pushed(args)
  local scene = sw.scene{ name = "pegs" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local pegs = {}
  for i, p in ipairs{ { 100, 15 }, { 200, -15 }, { 300, 15 } } do
    pegs[i] = scene:obstacle{ name = "peg" .. i, shape = "cylinder", radius = mm(10), length = mm(80),
      at = mm{ p[1], p[2], 40 }, friction = 0.2 }
  end
  local path = {}
  for x = 0, 560, 2 do
    local end_ = math.min(1, (x - 50) / 50, (350 - x) / 50)
    local y = end_ > 0 and -end_ ^ 2 * (3 - 2 * end_) * 0.5 * math.cos((x - 100) / 100 * math.pi) or 0
    path[#path + 1] = mm{ x, y, 40 }
  end
  local cable = scene:wire{ name = "cable", cable = "FLRY-B 1.5", path = path, segments = 160 }
  scene:force{ kind = "damping", on = cable, mass = 2, stiffness = 0.002 }
  scene:clamp(cable, { s = 0, name = "base" })
  local keeper = scene:gripper{ name = "keeper", pads = { width = mm(10) },
    rating = { force = 50, moment = 1, stroke = false } }
  scene:process(function(p)
    keeper:grasp(cable, { s = mm(540) })
    p:wait(0.2)
    for i, peg in ipairs(pegs) do
      peg:follow{ points = { { 0, 0, 0 }, mm{ 0, i % 2 == 1 and -17 or 17, 0 } }, relative = true,
        duration = 1 }
    end
    keeper:move{ by = mm{ -18, 0, 0 }, duration = 1 }
    p:wait(0.3)
  end)
  local run = scene:run(args)
  return { run = run, tension = cable:tension(mm(20)), keeper = keeper:force()[1], peg = pegs[1]:force()[2],
    depth = (scene:penetration()) }
end

describe("a cable between moving pegs, in steps by a tight tolerance,", function()
  -- Steps of 5 to 0.02 ms end with 0.137 N, -0.0412 N and 0.3735 N.
  for _, dt in ipairs{ 0.005, 0.0025 } do
    it(("ends as with longer steps: dt = %g s"):format(dt), function()
      local now = pushed{ dt = dt, tolerance = 2.73e-9 }
      assert.is_true(now.run.ok)
      assert.is_near(0.137, now.tension, 0.02 * 0.137)
      assert.is_near(-0.0412, now.keeper, 0.04 * 0.0412)
      assert.is_near(0.3735, now.peg, 0.01 * 0.3735)
      tools.below(10e-6, now.depth, "depth [m]")
      assert.is_true(now.run.steps < 5000, now.run.steps .. " steps")
      for _, e in ipairs(now.run.events) do assert.are_not.equal("energy", e.kind, e.text) end
    end)
  end
end)
