-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables that strike each other have the same results at all steps. When steps with touching wires were
-- taken whole, no blow was followed: tensions were up to 44 % off at 20 ms, bend radii 2.8 times too large,
-- without a report. More than six touching wires are a bundle: its steps are taken whole, which is
-- reported.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A hanging cable is swept by one that is carried by both ends.
local function swept(s, one, two)
  local a = t.damped(s, one, { 0, 0, 0.5 }, { 0, 0, 0.1 }, { segments = 41 })
  local b = t.damped(s, two, { -0.1, -0.15, 0.27 }, { -0.1, 0.15, 0.31 }, { segments = 36 })
  s:clamp(a, { s = 0 })
  for _, place in ipairs{ 0, b.length } do
    s:clamp(b, { s = place }):follow{ points = { { 0, 0, 0 }, { 0.2, 0, 0.03 } }, duration = 0.4,
      relative = true }
  end
  return { a, b }, 0.7
end

-- A cable that lies on a table is lifted by its end from under another one.
local function lifted(s, one, two)
  s:obstacle{ shape = "plane", friction = 0.3 }
  local a = t.damped(s, one, { 0, 0, 0.004 }, { 0.5, 0, 0.004 }, { segments = 50 })
  local b = t.damped(s, two, { 0.2, -0.2, 0.012 }, { 0.23, 0.2, 0.012 }, { segments = 43 })
  s:clamp(a, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0.05, 0, 0.2 } }, duration = 0.6, relative = true }
  return { a, b }, 1
end

-- Three cables fall across each other on a table.
local function dropped(s, one, two)
  s:obstacle{ shape = "plane", friction = 0.3 }
  local wires = {}
  for k, name in ipairs{ one, two, one } do
    local c, d, z = 0.18 * math.cos(1.1 * k), 0.18 * math.sin(1.1 * k), 0.02 + 0.03 * k
    wires[k] = t.damped(s, name, { -c + 0.03 * k, -d, z }, { c, d, z + 0.012 }, { segments = 37 + 4 * k })
  end
  return wires, 0.5
end

local function outcome(build, one, two, options)
  local scene = sw.scene{}
  local wires, duration = build(scene, one, two)
  scene:wire_contact{ friction = 0.3 }
  options.duration = duration
  local run, out = t.fine(scene:run(options)), {}
  for k, wire in ipairs(wires) do
    local got = wire:get()
    -- half the weight and a radius of 300 wire radii are added: smaller loads do not count
    out["tension" .. k] = wire:max_tension() + 0.5 * 9.81 * got.mass_per_length * got.length
    out["bend" .. k] = 1 / wire:min_bend_radius() + 1 / (300 * got.radius)
  end
  scene:close()
  return out, run
end

local PAIRS = { { "GXL 1.5", "H07V-K 10" }, { "GXL 0.5", "GXL 1.5" }, { "FLRY-B 10", "soft" },
  { "soft", "GXL 1.5" } }

-- Limits, as shares of the fine value [-]. Cables that fall roll off each other: even the finest steps
-- differ by 10 % in tension, and in the bend of the first cable, which lies below. The other bends agree.
local BOTH = { tension1 = 0.1, tension2 = 0.1, bend1 = 0.1, bend2 = 0.1 }
local cases = { { "one is swept by the other", swept, BOTH },
  { "one is lifted from under the other", lifted, BOTH },
  { "they fall across each other", dropped, { bend2 = 0.1, bend3 = 0.1 } } }

describe("two cables:", function()
  for _, case in ipairs(cases) do
    for _, pair in ipairs(PAIRS) do
      it(("%s, %s and %s"):format(case[1], pair[1], pair[2]), function()
        t.same_at({ 0.01, 0.005, 0.002 }, function(dt)
          return (outcome(case[2], pair[1], pair[2], { dt = dt }))
        end, 2.5e-4, case[3])
      end)
    end
  end
end)

-- Cables crosswise over each other fall on a table. Returns the reports of coarse steps.
local function told(count, dt)
  local s = sw.scene{}
  s:obstacle{ shape = "plane", friction = 0.3 }
  for k = 1, count do
    local a, z = 0.4 * k, 0.004 + 0.0035 * k
    t.damped(s, "GXL 1.5", { -0.1 * math.cos(a), -0.1 * math.sin(a), z },
      { 0.1 * math.cos(a), 0.1 * math.sin(a), z + 0.001 }, { segments = 20 + k % 3 })
  end
  s:wire_contact{ friction = 0.3 }
  local run, found = t.fine(s:run{ dt = dt, duration = 0.06 }), {}
  for _, event in ipairs(run.events) do
    if event.kind == "coarse" then found[#found + 1] = event.text end
  end
  s:close()
  return found
end

describe("a bundle", function()
  it("of more than six wires reports that its steps are coarse", function()
    local found = told(8, 0.01)
    assert.is_true(#found >= 1)
    assert.is_truthy(found[1]:find("for a bundle of 7 or more wires that touch", 1, true), found[1])
    assert.is_truthy(found[1]:find "run again with dt = [%d.e-]+ s and compare the peaks$", found[1])
  end)

  it("reports nothing with fine steps, or of six wires", function()
    assert.same({}, told(8, 2.5e-4))
    assert.same({}, told(6, 0.01))
  end)
end)
