-- SPDX-License-Identifier: GPL-3.0-or-later
-- A tie that begins far shorter than the distance of its places pulls at rest as hard at any step, as its
-- remark says. The same in poses, which have no motion.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Returns the pull at rest between two clamped cables.
local function pull(o, args)
  local scene, wires = sw.scene{ gravity = { 0, 0, 0 } }, {}
  scene:force{ kind = "damping", mass = 8, stiffness = 1e-3 }
  for k = 1, 2 do
    local y = k == 1 and 0 or o.apart
    wires[k] = scene:wire{ cable = o.cable, from = { 0, y, 0 }, to = { 0.2, y, 0 }, segments = 20 }
    scene:clamp(wires[k], { s = 0 })
  end
  local tie = scene:tie(wires[1], { s = 0.1, to = { wires[2], s = 0.1 }, slack = o.slack })
  args.duration = 4
  assert.is_true(scene:run(args).ok)
  local got = tie:tension()
  scene:close()
  return got
end

describe("a tie that begins far too short", function()
  for _, o in ipairs{ { cable = "GXL 1.5", apart = 0.04, slack = 0.005 },
    { cable = "FLRY-B 0.5", apart = 0.03, slack = 0.01 } } do
    it("pulls as hard at rest at all steps: " .. o.cable, function()
      local poses = pull(o, { dt = 0.02, quasistatic = true })
      -- after 4 s a swing has fallen to exp(-8/2 4) = 1e-7 of its size
      for _, dt in ipairs{ 0.02, 0.005 } do t.share(poses, pull(o, { dt = dt }), 1e-4, "pull") end
    end)
  end
end)
