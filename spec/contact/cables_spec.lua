-- SPDX-License-Identifier: GPL-3.0-or-later
-- Contact of real cables, which are a hundred times stiffer along their length than the soft wire of the
-- other contact specs. They meet the same bounds, at large and at small steps.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local G, MU = 9.81, 0.3
local STEPS = { 0.01, 0.001 }

local function lying(wire, segments, L)
  local s, r = core.scene{}, wire.radius
  local w = s:wire{ EA = wire.EA, EI = wire.EI, GJ = wire.GJ, mass_per_length = wire.mass_per_length,
    radius = r, from = { 0, 0, r }, to = { L or 1, 0, r }, segments = segments or 50 }
  return s, w, s:obstacle{ shape = "plane", friction = MU }
end

local function near(expected, value, slack, what)
  assert.is_true(math.abs(value - expected) <= slack,
    ("%s: %.6g instead of %.6g, within %.2g"):format(what, value, expected, slack))
end

local function advance(s, dt, until_, integrator)
  local r = s:advance({ dt = dt, integrator = integrator }, until_)
  assert.is_true(r.ok, r.reason)
  return r
end

for _, name in ipairs(scenes.cables) do
  local wire = scenes.cable(name)
  local weight = wire.mass_per_length * G -- of a metre [N]

  describe("a cable on a table, " .. name, function()
    for _, dt in ipairs(STEPS) do
      it(("holds below mu N and slides above: dt %g s"):format(dt), function()
        for _, share in ipairs{ 0.9, 1.2 } do
          local s, w = lying(wire)
          advance(s, dt, 0.1)
          s:force{ kind = "point", on = w, s = 1, force = { share * MU * weight, 0, 0 } }
          advance(s, dt, 0.6)
          local x0, v0 = w:position(1)[1], w:velocity(0.5)[1]
          advance(s, dt, 1.6)
          if share < 1 then
            near(x0, w:position(1)[1], 1e-5, "creep")
          else -- 1 %, as for the soft wire
            local a = (share - 1) * MU * G
            near(a, w:velocity(0.5)[1] - v0, 0.01 * a, "acceleration")
          end
        end
      end)

      it(("comes to rest after v^2/(2 mu g): dt %g s"):format(dt), function()
        local s, w = lying(wire)
        advance(s, dt, 0.1)
        w:set_velocity{ 0.5, 0, 0 }
        advance(s, dt, 0.6)
        local expected = 0.5 ^ 2 / (2 * MU * G)
        near(0.5 + expected, w:position(0.5)[1], 0.01 * expected, "way")
        near(0, w:velocity(0.5)[1], 1e-6, "speed")
      end)

      it(("bounces as high as the restitution says: dt %g s"):format(dt), function()
        for _, e in ipairs{ 0, 0.5 } do
          local s, r = core.scene{}, wire.radius
          -- short, so that it bounces as a whole
          local w = s:wire{ EA = wire.EA, EI = 1, mass_per_length = wire.mass_per_length, radius = r,
            from = { 0, 0, 0.2 + r }, to = { 0.1, 0, 0.2 + r }, segments = 4 }
          s:obstacle{ shape = "plane", restitution = e }
          local highest, hit = 0, false
          for i = 1, math.ceil(0.5 / dt) do
            advance(s, dt, i * dt)
            hit = hit or w:velocity(0.05)[3] > 0
            if hit then highest = math.max(highest, w:position(0.05)[3] - r) end
          end
          -- the impact is placed at the start of the step that meets it: an error of v dt in height
          near(0.2 * e * e, highest, 2 * dt * 2 * (e > 0 and 1 or 0.1), "height")
        end
      end)

      it(("falls, comes to rest and weighs what it weighs: dt %g s"):format(dt), function()
        local s, r = core.scene{}, wire.radius
        local w = s:wire{ EA = wire.EA, EI = wire.EI, mass_per_length = wire.mass_per_length,
          radius = r, from = { 0, 0, 0.05 }, to = { 1, 0, 0.06 }, segments = 50 }
        local plate = s:obstacle{ shape = "plane", friction = MU }
        s:force{ kind = "damping", on = w, mass = 4 }
        local first, last = s:energy().total, s:energy().total
        local play = first - weight * r
        for i = 1, 15 do
          advance(s, dt, 0.1 * i)
          local total = s:energy().total
          assert.is_true(total - last < 0.003 * play, ("gained %.3g of %.3g J"):format(total - last, play))
          last = total
        end
        near(weight, -plate:force()[3], 1e-3 * weight, "weight")
        near(r, w:position(0.5)[3], 1e-4, "height")
        assert.is_true(s:penetration() < 1e-4)
      end)

      it(("is pushed by a wall with m (a + mu g): dt %g s"):format(dt), function()
        local a, L, r = 0.1, 0.5, wire.radius
        local s = core.scene{}
        s:obstacle{ shape = "plane", friction = MU }
        local w = s:wire{ EA = wire.EA, EI = wire.EI, mass_per_length = wire.mass_per_length,
          radius = r, from = { 0, -L / 2, r }, to = { 0, L / 2, r }, segments = 20 }
        local wall = s:obstacle{ shape = "box", size = { 0.02, 1, 0.1 }, at = { -0.011 - r, 0, 0.05 } }
        advance(s, dt, 0.1)
        wall:follow{ func = function(t) return { 0.5 * a * t * t, 0, 0 } end, relative = true }
        advance(s, dt, 0.1 + (2 * 0.001 / a) ^ 0.5 + 10 * dt)
        local exact = L * wire.mass_per_length * (a + MU * G)
        for _ = 1, 40 do
          advance(s, dt, s.time + dt)
          near(exact, -wall:force()[1], 0.01 * exact, "force")
          near(a * (s.time - 0.1), w:velocity(L / 2)[1], 0.05 * a * dt + 1e-5, "speed")
        end
      end)
    end

    it("keeps still with every implicit integrator", function()
      for _, m in ipairs(core.registry().integrators) do
        if m.implicit and m.contact then
          local s, w, plate = lying(wire)
          advance(s, 0.01, 1, m.name)
          local x0 = w:position(1)
          advance(s, 0.01, 6, m.name)
          local x1 = w:position(1)
          for k = 1, 3 do near(x0[k], x1[k], 1e-7, m.name) end
          near(weight, -plate:force()[3], 1e-6 * weight, m.name)
        end
      end
    end)

    it("stays on its side of a wall at 30 m/s", function()
      for i, n in ipairs{ 5, 20, 60 } do
        for _, a in ipairs{ { 0, 0 }, { 0.5, 0.5 }, { 1.2, 0.3 }, { 0.7, -0.6 } } do
          local s, w = scenes.flung{ turn = a[1], tilt = a[2], at = { -0.1, 0, 0.3 }, segments = n,
            wire = wire }
          for k = 1, 15 do
            advance(s, ({ 0.01, 0.002, 0.005 })[i], k * 0.01)
            assert.is_false((scenes.pierces(w, 0.005)), ("passed: n %d, %g, %g"):format(n, a[1], a[2]))
          end
        end
      end
    end)

    it("lies in a bundle between rails", function()
      local s, r = core.scene{}, wire.radius
      local plane, rails = scenes.railed(s, r, MU)
      for i, p in ipairs{ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0.5, 1 }, { 1.5, 1 }, { 1, 2 } } do
        local y, z = 2 * r * p[1], r * (1 + 1.7322 * p[2]) + 1e-5 * i
        scenes.add_wire(s, { 0, y, z }, { 0.4, y, z }, 20, wire)
      end
      s:wire_contact{ friction = MU }
      local result = s:settle()
      assert.is_true(result.ok, result.reason)
      local carried = -plane:force()[3] - rails[1]:force()[3] - rails[2]:force()[3]
      near(6 * 0.4 * weight, carried, 0.01 * 6 * 0.4 * weight, "carried")
      assert.is_true(s:penetration() < 1e-4)
    end)
  end)
end
