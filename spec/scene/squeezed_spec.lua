-- SPDX-License-Identifier: GPL-3.0-or-later
-- Obstacles that squeeze a rod between them: the force is no property of the wire, and an event says so.
local sw = require "softworld"

describe("a rod between two obstacles", function()
  local r = sw.cable "GXL 1.5".outer_diameter.value / 2

  --- A jaw comes down on a wire on a table until `gap` [m] is left.
  local function pressed(gap, o)
    local scene = sw.scene{ name = "press" }
    scene:obstacle{ name = "table", shape = "plane" }
    local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, r }, to = { 0.4, 0, r },
      model = o.model, segments = o.segments or 40 }
    scene:force{ kind = "damping", on = wire, mass = 0.5, stiffness = 0.0005 }
    local at, size = { o.x or 0.2, 0, 0 }, 0.02
    local shape = o.roller
      and { name = "jaw", shape = "cylinder", radius = size / 2, length = 0.05,
        rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
      or { name = "jaw", shape = "box", size = { size, 0.05, size } }
    at[3] = 2 * r + size / 2 + 0.005
    shape.at = at
    local jaw = scene:obstacle(shape)
    jaw:follow{ points = { { 0, 0, 0 }, { 0, 0, gap - 2 * r - 0.005 } }, relative = true, duration = 0.2 }
    local run = scene:run{ duration = 0.3, dt = o.dt or 0.01, quasistatic = o.quasistatic }
    local crash
    for _, e in ipairs(run.events) do if e.kind == "crash" then crash = e end end
    return crash, run, jaw
  end

  it("gives an event when it is squeezed, with the amount and the place", function()
    for _, o in ipairs{ {}, { dt = 0.002 }, { x = 0.2034 }, { segments = 53 }, { model = "string" },
      { roller = true }, { roller = true, x = 0.2034, dt = 0.002 } } do
      local crash, run = pressed(2 * r - 2e-4, o)
      assert.truthy(crash)
      assert.equal("wire", crash.object)
      assert.near(2e-4, crash.value, 2e-5)
      assert.near(0.2, crash.s, 0.02)
      for _, word in ipairs{ "'jaw'", "'table'", "pads" } do assert.truthy(crash.text:find(word, 1, true)) end
      assert.equal("FAIL", run:check{}:row "events".verdict)
    end
  end)

  it("gives none where the gap is as wide as the wire", function()
    for _, gap in ipairs{ 2 * r, 2 * r + 1e-4 } do
      for _, roller in ipairs{ false, true } do
        assert.falsy((pressed(gap, { roller = roller })))
      end
    end
  end)

  it("gives none where the pads of a gripper give way with the section", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, r }, to = { 0.4, 0, r }, segments = 40 }
    local hand = scene:gripper{ pads = { opening = 4 * r } }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.2, approach = "plates", force = 20 })
      p:wait(0.1)
    end)
    for _, e in ipairs(scene:run{ dt = 0.01 }.events) do assert.not_equal("crash", e.kind) end
  end)
end)
