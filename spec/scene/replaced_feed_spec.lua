-- SPDX-License-Identifier: GPL-3.0-or-later
-- A feed pays out wire while its guide follows a motion. Regression: one counted as replacing the other, and
-- a second feed was told with the end of the motion.
local sw = require "softworld"

-- Returns the texts of events `replaced` of orders(feed, motion), what was fed [m] and how far the guide went
-- [m].
local function told(orders)
  local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.1, 0, 0 }, segments = 10 }
  local feed = scene:feed(wire, { name = "feed", s = 0 })
  orders(feed, { points = { { 0, 0, 0 }, { 0, 0, 0.02 } }, relative = true, duration = 0.2 })
  local run = scene:run{ duration = 0.4, dt = 0.01, frames = false }
  assert.is_true(run.ok, run.reason)
  local texts = {}
  for _, e in ipairs(run.events) do
    if e.kind == "replaced" then texts[#texts + 1] = e.text end
  end
  return texts, feed:fed(), feed:pose().z
end

describe("a feed whose guide moves", function()
  for _, first in ipairs{ "feed", "follow" } do
    it("replaces nothing: first its " .. first, function()
      local texts, fed, up = told(function(feed, motion)
        if first == "follow" then feed:follow(motion) end
        feed:feed{ length = 0.03, duration = 0.3 }
        if first == "feed" then feed:follow(motion) end
      end)
      assert.equal(0, #texts)
      assert.near(0.03, fed, 1e-9) -- both were made
      assert.near(0.02, up, 1e-9)
    end)
  end

  it("tells of two feeds with the end of the first one", function()
    local texts = told(function(feed, motion)
      feed:feed{ length = 0.03, duration = 0.3 }
      feed:follow(motion)
      feed:feed{ length = 0.01, duration = 0.1 }
    end)
    assert.equal(1, #texts)
    assert.truthy(texts[1]:find("the feed at ", 1, true), texts[1])
    assert.truthy(texts[1]:find("was to end at t = 0.3 s", 1, true), texts[1])
  end)
end)
