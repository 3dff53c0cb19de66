-- SPDX-License-Identifier: GPL-3.0-or-later
-- A peak that an event of the run doubts does not pass: it may be larger in truth.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local doubted = require "softworld.check.doubted"

-- So many cables land a little aslant on a table, 0.1 m apart. While more than 32 move, their blows are
-- spread over whole steps: the bend radius is some times too large.
local function landed(count)
  local scene, r = sw.scene{}, sw.cable "GXL 1.5".outer_diameter.value / 2
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 1, count do
    scene:wire{ cable = "GXL 1.5", from = { 0, 0.1 * i, r + 6e-3 }, to = { 0.3, 0.1 * i, r + 2e-3 },
      segments = 30 }
  end
  return scene:run{ dt = 0.005, duration = 0.2 }
end

describe("run:check", function()
  it("leaves peaks open where a blow is spread over a step, and names the step that would tell", function()
    local row = landed(33):check{ limits = { min_bend_radius = { min = 0.02, sure = true } } }
      :row "wire1.min_bend_radius"
    assert.are.equal("OPEN", row.verdict)
    assert.truthy(row.margin > 0)
    assert.truthy(row.note:find("a step was too long for peaks (event 'coarse'): dt = ", 1, true), row.note)
    row = landed(20):check{ limits = { min_bend_radius = { min = 0.02, sure = true } } }
      :row "wire1.min_bend_radius"
    assert.are.equal("PASS", row.verdict)
  end)

  it("does not pass what breaks its limit", function()
    local check = landed(33):check{ limits = { min_bend_radius = { min = 10, sure = true } } }
    assert.are.equal("FAIL", check:row "wire1.min_bend_radius".verdict)
  end)
end)

describe("an event doubts", function()
  local function why(event, member, value, name)
    return doubted.why(member or { peaks = true }, value or { value = 1 }, { name = name or "a" },
      { events = { event } })
  end

  it("peaks without an error bar only", function()
    local coarse = { kind = "coarse", object = "", text = "too long; again with dt = 0.0012 s and" }
    assert.truthy(why(coarse):find("dt = 0.0012 s", 1, true))
    assert.is_nil(why(coarse, {}))
    assert.is_nil(why(coarse, nil, { value = 1, error = 0.1 }))
    assert.is_nil(why{ kind = "kink", object = "a", text = "" })
  end)

  it("those of the wire whose end it names", function()
    for _, kind in ipairs{ "threshold", "rebound" } do
      local event = { kind = kind, object = "a", text = "an end of wire 'a'" }
      assert.truthy(why(event):find(kind, 1, true))
      assert.is_nil(why(event, nil, nil, "b"))
    end
  end)
end)
