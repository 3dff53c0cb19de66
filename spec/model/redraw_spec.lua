-- SPDX-License-Identifier: GPL-3.0-or-later
-- Parts of choosing a model: relative tolerances, and core.redraw, which draws a wire again with or without
-- rolling.
local sw = require "softworld"

local core = sw.core

local rod = require "spec.model.rod"

local R = rod.radius

local function fails(f, ...)
  local fine, why = pcall(f)
  assert.is_false(fine)
  for _, words in ipairs { ... } do assert.truthy(tostring(why):find(words, 1, true), tostring(why)) end
end

describe("tolerance = { relative = share }", function()
  it("is a share of the value", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { model = "rod" })
    scene:clamp(w, { s = 0 })
    local rest = scene:settle { tolerance = { min_bend_radius = { relative = 0.02 },
      { name = "sag", relative = 0.05, unit = "m", of = function() return -w:position(0.6)[3] end } } }
    local q = rest.quantities.min_bend_radius
    assert.is_near(0.02 * q.value, q.tolerance, 1e-15)
    assert.is_true(q.met and q.error <= q.tolerance)
    assert.is_near(0.05 * rest.quantities.sag.value, rest.quantities.sag.tolerance, 1e-15)
    fails(function()
      scene:settle { tolerance = { { name = "x", relative = 0.1, value = 1, of = function() return 1 end } } }
    end, "not both")
  end)
end)

-- core.redraw must give the wire that scene:wire would have made.
describe("core.redraw", function()
  local function swing(rolls, change)
    local scene = sw.scene()
    scene:obstacle { shape = "plane", friction = 0.3 }
    local w = rod.wire(scene, { model = "rod", rolls = rolls, from = { 0, 0, R }, to = { 0.4, 0, R } })
    local hand = scene:clamp(w, { s = 0 })
    if change then change(scene, w) end
    hand:follow { points = { { 0, 0, 0 }, { 0, 0.05, 0.05 } }, relative = true, duration = 0.3 }
    scene:run { duration = 0.3 }
    return w:positions(), w
  end

  it("gives the same bits as a wire made that way", function()
    assert.same(swing(true), (swing(nil, function(_, w) core.redraw(w, true) end)))
    assert.same(swing(nil), (swing(true, function(_, w) core.redraw(w, false) end)))
  end)

  it("leaves a settled wire at rest, with the same forces of its holds", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { model = "rod", EA = 1e5, EI = 1.3e-3, GJ = 1.6e-3 })
    local left = scene:clamp(w, { s = 0 })
    scene:clamp(w, { s = 0.6 })
    scene:settle()
    local x, force = w:positions(), left:force()
    core.redraw(w, true)
    scene:settle()
    for k, value in ipairs(w:positions()) do assert.is_near(x[k], value, 1e-9) end
    assert.is_near(force[1], left:force()[1], 1e-6 * math.abs(force[1]))
  end)

  -- A wire bent at rest and one with two stiffnesses move like one that rolls from the start.
  it("keeps the frames of a settled wire", function()
    local arc = {}
    for i = 0, 20 do arc[#arc + 1] = { 0.2 * math.sin(i / 10), 0.2 * (1 - math.cos(i / 10)), 0 } end
    for _, args in ipairs { { path = arc, rest = "path" },
      { from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, EI = { 1e-3, 4e-3 }, normal = { 0, 1, 1 } } } do
      local ends = {}
      for k, rolls in ipairs { true, false } do
        local scene, all = sw.scene(), { EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03,
          radius = 0.0018, segments = 16, rolls = rolls }
        for key, value in pairs(args) do all[key] = value end
        local w = scene:wire(all)
        local hand = scene:clamp(w, { s = 0 })
        scene:force { kind = "damping", mass = 5 }
        scene:settle()
        if not rolls then core.redraw(w, true) end
        hand:follow { relative = true, duration = 0.4, points = { { 0, 0, 0 }, { 0, 0, 0.05 } },
          turn = { axis = { 1, 0, 0 }, angle = 1 } }
        assert.is_true(scene:run { duration = 0.4, dt = 0.01 }.ok)
        ends[k] = w:position(w.length)
      end
      for k = 1, 3 do assert.is_near(ends[1][k], ends[2][k], 1e-6) end
    end
  end)

  it("refuses twisted wires and meshes", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { model = "rod" })
    scene:clamp(w, { s = 0 })
    local right = scene:clamp(w, { s = 0.6 })
    right:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true, duration = 0.1,
      turn = { axis = { 1, 0, 0 }, angle = 0.5 } }
    scene:run { duration = 0.1 }
    fails(function() core.redraw(w, true) end, "has moved and is twisted by")
    local tube = scene:wire { name = "tube", model = "tube", E = 5e6, density = 1200, radius = 0.01,
      from = { 0, 1, 0 }, to = { 0.1, 1, 0 } }
    fails(function() core.redraw(tube, true) end, "wire 'tube' is a tube, not a rod")
  end)
end)
