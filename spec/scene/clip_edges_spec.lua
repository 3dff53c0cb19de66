-- SPDX-License-Identifier: GPL-3.0-or-later
-- The bend radius beside a clip depends on where nodes lie in it. With edges as long as the clip is wide the
-- radius was up to 24 % off, and nothing said so. The event `edges` does, and gives a bound.
local sw = require "softworld"

local LENGTH, WIDTH = 0.24, 0.008
local TOLD = 0.6 -- edges over the width from which the event tells
-- With shorter edges the error is below OFF = 0.25 times that squared: 9 %.
local UNTOLD = 0.25 * TOLD ^ 2

-- Returns the smallest bend radius of a wire whose clamp was moved aside, and the text of its event.
local function bent(cable, o, segments, shift)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { LENGTH, 0, 0 }, segments = segments }
  local clamp = scene:clamp(wire, { s = 0 })
  scene:clip{ at = { o.gap + WIDTH / 2 + shift, 0, 0 }, width = WIDTH, insertion = 400, retention = 600 }
  clamp:follow{ points = { { 0, 0, 0 }, { 0.1 * o.aside, 0, o.aside } }, duration = 1, law = "linear",
    relative = true }
  local run = scene:run{ dt = 0.1, duration = 1, quasistatic = true }
  assert.is_true(run.ok)
  local radius, text = wire:min_bend_radius(), nil
  for _, event in ipairs(scene:events()) do
    if event.kind == "edges" then text = event.text end
  end
  scene:close()
  return radius, text
end

describe("the bend radius beside a clip", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10", "H07V-K 6" } do
    for _, o in ipairs{ { gap = 0.012, aside = 0.003 }, { gap = 0.02, aside = 0.006 },
      { gap = 0.04, aside = 0.015 } } do
      it(("is right or told, at all places of nodes: %s, %g mm"):format(cable, 1e3 * o.gap), function()
        for third = 0, 2 do
          for _, segments in ipairs{ 30, 45, 60, 120 } do
            -- a third of this mesh's edge; the reference has the same way from clamp to clip
            local edge = LENGTH / segments
            local shift = third * edge / 3
            local exact = bent(cable, o, 480, shift)
            local radius, text = bent(cable, o, segments, shift)
            local off = math.abs(radius / exact - 1)
            local what = ("%d segments, third %d: %.3g %% off"):format(segments, third, 100 * off)
            if edge > TOLD * WIDTH then
              assert.is_true(text ~= nil, what .. ", no event")
              local bound = tonumber(text:match("may be (%d+) %%"))
              assert.is_true(off <= (bound + 0.5) / 100, what .. ", told " .. bound)
            else
              assert.is_true(off < UNTOLD, what)
              assert.is_nil(text, what)
            end
          end
        end
      end)
    end
  end
end)
