-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto", a cable that snaps into a clip: coarse edges snap more softly, and do not show how far the
-- cable swings. On 8, 16 and 32 edges dynamics change its sharpest bend by 0.02, 0.13 and 1.9 mm of 139 mm.
-- Poses alone gave 139.0 mm with a bar of 0.6 mm.
local sw = require "softworld"

-- flip: the same seen from the other side, with swapped ends.
local function snapped(flip)
  local scene, span, insertion = sw.scene { name = "snapped" }, 0.14845403479552, 1.2159151079656
  scene:clip { name = "clip", at = { flip and 0 or span / 2, flip and span / 2 or 0, 0 }, width = 0.01,
    insertion = insertion, retention = 3 * insertion, friction = 0.25, axis = flip and { 0, 1, 0 } or nil }
  local from, to = { 0, 0, 0.035 }, flip and { 0, span, 0.035 } or { span, 0, 0.035 }
  if flip then from, to = to, from end
  local wire = scene:wire { name = "w", E = 60e6, density = 1500, radius = 0.0025, segments = 32, from = from,
    to = to }
  for s, name in pairs { [0] = "left", [span] = "right" } do
    scene:clamp(wire, { s = s, name = name }):follow { relative = true, duration = 4,
      points = { { 0, 0, 0 }, { 0, 0, -0.040627906594472 } } }
  end
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 4, model = "auto", tolerance = { min_bend_radius = { relative = 0.01 } } }
end

describe("choosing a model for a cable that snaps into a clip,", function()
  for _, flip in ipairs { false, true } do
    it("takes dynamics if 1 % of its sharpest bend is asked for" .. (flip and ", turned, ends swapped" or ""),
      function()
        local run = snapped(flip)
        assert.equal("dynamic", run.model.motion, tostring(run:why()))
        local q = run.quantities.min_bend_radius
        -- in steps of 0.1 ms: 136.7 mm on 32 edges; in steps of 10 and 1 ms 138.6 and 138.3 mm
        assert.is_true(math.abs(q.value - 0.1366) <= q.error + 1e-4, tostring(q))
        assert.is_true(q.error <= 0.01 * q.value)
      end)
  end
end)
