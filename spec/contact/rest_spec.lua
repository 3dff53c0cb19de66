-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire on a table keeps still, gains no energy and presses with its weight. Obstacles of every shape
-- carry one.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local WEIGHT = 0.03 * 9.81 -- of 1 m [N]

describe("a wire on a table", function()
  it("keeps still for 20 s with every implicit integrator", function()
    for _, m in ipairs(core.registry().integrators) do
      if m.implicit and m.contact then -- undamped integrators report that they are not for contact
        local s, w, plate = scenes.lying()
        s:advance({ dt = 0.01, integrator = m.name }, 1)
        local x0 = w:position(1)
        s:advance({ dt = 0.01, integrator = m.name }, 21)
        local x1 = w:position(1)
        for k = 1, 3 do assert.is_true(math.abs(x1[k] - x0[k]) < 1e-7, m.name) end
        assert.is_true(s:energy().kinetic < 1e-10, m.name .. " moves")
        assert.is_true(math.abs(plate:force()[3] + WEIGHT) < 1e-6 * WEIGHT, m.name)
      end
    end
  end)

  it("never has more energy than before while it falls and comes to rest", function()
    for _, integrator in ipairs{ "tr-bdf2", "sdirk2", "implicit-euler", "bdf2" } do
      local s = core.scene{}
      local w = scenes.add_wire(s, { 0, 0, 0.05 }, { 1, 0, 0.06 }, 50)
      local plate = s:obstacle{ shape = "plane", friction = 0.3 }
      local last = s:energy().total
      for i = 1, 200 do
        assert.is_true(s:advance({ dt = 0.01, integrator = integrator }, i * 0.01).ok)
        local total = s:energy().total
        -- 0.3 % of the 16 mJ it falls through: the integrators' own error
        assert.is_true(total - last < 5e-5, ("%s gained %g J at %g s"):format(integrator,
          total - last, s.time))
        last = total
      end
      assert.is_true(s:energy().kinetic < 1e-5)
      assert.is_true(math.abs(plate:force()[3] + WEIGHT) < 1e-3 * WEIGHT)
      assert.is_true(s:penetration() < 1e-4)
      assert.is_true(math.abs(w:position(0.5)[3] - 0.0025) < 1e-4)
    end
  end)

  it("bounces to the height that the restitution gives", function()
    for _, e in ipairs{ 0, 0.5, 0.9 } do
      local s = core.scene{}
      local w = scenes.add_wire(s, { 0, 0, 0.2025 }, { 0.1, 0, 0.2025 }, 4, { EI = 1 })
      s:obstacle{ shape = "plane", restitution = e }
      local highest, hit = 0, false
      for i = 1, 400 do
        s:advance({ dt = 0.002 }, i * 0.002)
        hit = hit or w:velocity(0.05)[3] > 0
        if hit then highest = math.max(highest, w:position(0.05)[3] - 0.0025) end
      end
      -- the impact is placed at the start of the step that meets it: an error of v dt in height
      local slack = 2 * 0.002 * 2.0 * (e > 0 and 1 or 0.1)
      assert.is_true(math.abs(highest - 0.2 * e * e) < slack,
        ("e = %g: %g m instead of %g"):format(e, highest, 0.2 * e * e))
    end
  end)
end)

describe("every shape", function()
  local cube = {}
  for _, x in ipairs{ -1, 1 } do for _, y in ipairs{ -1, 1 } do for _, z in ipairs{ -1, 1 } do
    cube[#cube + 1], cube[#cube + 2], cube[#cube + 3] = 0.1 * x, 0.1 * y, 0.1 * z
  end end end
  local carriers = {
    plane = { shape = "plane" },
    sphere = { shape = "sphere", radius = 0.1, at = { 0, 0, -0.1 } },
    capsule = { shape = "capsule", radius = 0.05, length = 0.3, at = { 0, 0, -0.05 },
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } },
    box = { shape = "box", size = { 0.2, 0.2, 0.2 }, at = { 0, 0, -0.1 } },
    cylinder = { shape = "cylinder", radius = 0.05, length = 0.4, at = { 0, 0, -0.05 },
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } },
    hull = { shape = "hull", points = cube, at = { 0, 0, -0.1 } },
  }
  for name, shape in pairs(carriers) do
    it("carries a wire that hangs over it: " .. name, function()
      local s = core.scene{}
      shape.friction = 0.5
      local o = s:obstacle(shape)
    -- stiff, so it does not bow up between the edges of a flat top
      local w = scenes.add_wire(s, { -0.25, 0, 0.004 }, { 0.25, 0, 0.004 }, 24, { EI = 0.1 })
      s:force{ kind = "damping", mass = 4 }
      local r = s:advance({ dt = 0.005 }, 3)
      assert.is_true(r.ok, r.reason)
      local f = o:force()
      assert.is_true(math.abs(f[3] + 0.5 * WEIGHT) < 0.02 * WEIGHT, "carries " .. f[3])
      -- straight segments of 21 mm stand off a radius of 0.1 m by l^2/(8 R) = 0.5 mm
      assert.is_true(math.abs(w:position(0.25)[3] - 0.0025) < 6e-4,
        "lies at " .. w:position(0.25)[3])
      assert.is_true(s:penetration() < 1e-4)
    end)
  end
end)

describe("settle with obstacles", function()
  it("lays a wire over a thin wall without letting it through", function()
    local s = core.scene{}
    s:obstacle{ shape = "box", size = { 0.01, 1, 0.5 }, at = { 0, 0, 0.25 }, friction = 0.3 }
    local w = scenes.add_wire(s, { -0.4, 0, 0.6 }, { 0.4, 0, 0.6 }, 40)
    local r = s:settle()
    assert.is_true(r.ok, r.reason)
    -- the wire bends over two edges 10 mm apart and bows up between them
    assert.is_true(math.abs(w:position(0.4)[3] - 0.5025) < 1.5e-3)
    assert.is_true(w:position(0)[3] < 0.3)
  end)
end)
