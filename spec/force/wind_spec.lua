-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wind on wires: force against its formula, slope of a hanging wire at rest, gusts, work in the ledger,
-- every wire model.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local RHO, CN, CT, R, M, G = 1.2, 1.2, 0.02, 0.002, 0.01, 9.80665

local function wire(scene, more)
  local args = { EA = 1e4, EI = 1e-9, mass_per_length = M, radius = R, model = "string", segments = 40,
    from = { 0, 0, 0 }, to = { 0, 0, -1 } }
  for k, v in pairs(more or {}) do args[k] = v end
  return scene:wire(args)
end

-- Returns the slope from the vertical at which the weight across the wire equals the wind's force across
-- it: m g sin a = 1/2 rho d Cn (U cos a)^2. It is the same everywhere, so the wire is straight.
local function slope(U, weight, d)
  local k = 0.5 * RHO * d * CN * U * U / weight
  return math.asin((-1 + (1 + 4 * k * k) ^ 0.5) / (2 * k))
end

describe("wind", function()
  it("has the drag of its coefficients across and along the wire, for the relative speed", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local w = wire(scene, { to = { 0.6, 0, 0.8 } })
    scene:force{ kind = "wind", on = w, velocity = { 3, 4, -2 }, normal = 1.1, tangential = 0.03,
      density = 2, diameter = 0.006 }
    local x, v = w:positions(), {}
    for i = 1, #x, 3 do v[i], v[i + 1], v[i + 2] = 1, -1, 0.5 end
    local f, sum = scene:evaluate(w, { positions = x, velocities = v }).wind.force, { 0, 0, 0 }
    for i = 1, #f do sum[(i - 1) % 3 + 1] = sum[(i - 1) % 3 + 1] + f[i] end
    local u, tangent = { 2, 5, -2.5 }, { 0.6, 0, 0.8 }
    local along = u[1] * 0.6 - 2.5 * 0.8
    local across, size = {}, 0
    for k = 1, 3 do
      across[k] = u[k] - along * tangent[k]
      size = size + across[k] ^ 2
    end
    for k = 1, 3 do
      local want = 0.5 * 2 * 0.006 * (1.1 * size ^ 0.5 * across[k]
        + math.pi * 0.03 * math.abs(along) * along * tangent[k])
      t.near(want, sum[k], 1e-14, "component " .. k)
    end
  end)

  -- The wire is straight on any mesh: only the accuracy of the iterations limits the slope.
  for _, U in ipairs{ 2, 4, 6 } do
    for _, segments in ipairs{ 7, 40 } do
      local name = ("blows a hanging wire to the formula's slope: %g m/s, %d segments"):format(U, segments)
      it(name, function()
        local scene = sw.scene{ gravity = { 0, 0, -G } }
        local w = wire(scene, { segments = segments })
        local pin = scene:pin(w, { s = 0 })
        scene:force{ kind = "wind", velocity = { U * 0.6, U * 0.8, 0 } }
        t.fine(scene:settle())
        local a, tip = slope(U, M * G, 2 * R), w:position(1)
        t.near(a, math.atan((tip[1] ^ 2 + tip[2] ^ 2) ^ 0.5, -tip[3]), 1e-5, "slope at rest")
        t.near(math.atan(0.8, 0.6), math.atan(tip[2], tip[1]), 1e-6, "where it blows to")
        local f, along = pin:force(), math.pi * RHO * R * CT * (U * math.sin(a)) ^ 2
        t.share(M * G * math.cos(a) + along, (f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2) ^ 0.5, 1e-5, "pull at the top")
      end)
    end
  end

  it("gives the same slope in motion, with steps of 20 ms and 1 ms, beyond 45 degrees too", function()
    for _, case in ipairs{ { 6, 0.02 }, { 6, 0.001 }, { 8, 0.005 } } do
      local U, dt = case[1], case[2]
      local scene = sw.scene{ gravity = { 0, 0, -G } }
      local w = wire(scene, { segments = 20 })
      scene:pin(w, { s = 0 })
      scene:force{ kind = "wind", velocity = { U, 0, 0 } }
      scene:force{ kind = "damping", mass = 3 }
      t.fine(scene:run{ duration = 8, dt = dt })
      local tip = w:position(1)
      t.near(slope(U, M * G, 2 * R), math.atan(tip[1], -tip[3]), 1e-3, "slope after 8 s")
    end
  end)

  -- A free rod in a steady wind across it: v' = c (U - v)^2, so v = U c U t / (1 + c U t).
  it("takes a free rod along, at second order in the step", function()
    local function speed(dt)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local w = wire(scene, { model = "rod", EI = 1e-3, segments = 8 })
      scene:force{ kind = "wind", velocity = { 20, 0, 0 } }
      t.fine(scene:run{ duration = 0.4, dt = dt, parts = false })
      return w:velocity(0.5)[1]
    end
    local c = 0.5 * RHO * 2 * R * CN / M
    local want = 20 * c * 20 * 0.4 / (1 + c * 20 * 0.4)
    local coarse, fine = math.abs(speed(0.04) - want), math.abs(speed(0.02) - want)
    t.below(5e-4 * want, fine, "error at 20 ms")
    t.above(3.3, coarse / fine, "error by halving the step")
  end)

  it("has in gusts the mean force of the mean square", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local w = wire(scene, { model = "rod", EI = 100, EA = 1e6, segments = 4 })
    local clamp = scene:clamp(w, { s = 0 })
    scene:force{ kind = "wind", velocity = { 5, 0, 0 }, gust = { 3, 0, 0 }, frequency = 4 }
    scene:force{ kind = "damping", stiffness = 1e-2 }
    t.fine(scene:run{ duration = 1, dt = 2e-3 })
    local sum, n = 0, 0
    for _ = 1, 250 do
      t.fine(scene:run{ duration = 2e-3, dt = 2e-3 })
      sum, n = sum - clamp:force()[1], n + 1
    end
    t.share(RHO * R * CN * (25 + 4.5), sum / n, 5e-3, "mean force") -- (U + u sin)^2 means U^2 + u^2/2
  end)

  it("does the work in the ledger, which goes into motion, height and damping", function()
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    local w = wire(scene, { segments = 20 })
    scene:pin(w, { s = 0 })
    scene:force{ kind = "wind", velocity = { 8, 0, 0 }, gust = { 2, 0, 0 }, frequency = 2 }
    scene:force{ kind = "damping", mass = 2 }
    local run = t.fine(scene:run{ duration = 1, dt = 2e-3 })
    local books = run:ledger()
    t.above(1e-3, books.work.forces, "work of the wind")
    local explained = books.total - books.at_start + books.lost.damping
    t.share(books.work.forces, explained, 5e-3, "energy and damping for work")
  end)

  it("acts the same on every wire model", function()
    local lengths = {}
    for _, model in ipairs(sw.core.registry().models) do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local w = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.05, model = model.name,
        from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      local left, right = scene:clamp(w, { s = 0 }), scene:clamp(w, { s = w.length })
      scene:force{ kind = "wind", on = w, velocity = { 0.25, 0.5, 0 } }
      t.fine(scene:settle())
      local across = left:force()[2] + right:force()[2]
      t.near(RHO * 0.05 * CN * 0.25, -across, 0.01 * RHO * 0.05 * CN * 0.25, model.name .. " across")
      lengths[#lengths + 1] = model.name
    end
    assert.is_true(#lengths > 3)
  end)

  it("needs a wire", function()
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    local web = scene:particles{ positions = { 0, 0, 1, 0.1, 0, 1 }, masses = 0.1, radius = 0.01 }
    assert.error_matches(function() scene:force{ kind = "wind", on = web, velocity = { 1, 0, 0 } } end,
      "object of particles")
    scene:force{ kind = "wind", velocity = { 1, 0, 0 } } -- a wind on the whole scene passes it by
    t.fine(scene:run{ duration = 0.01 })
    for _, v in ipairs(scene:evaluate(web).wind.force) do t.near(0, v, 0, "force") end
  end)
end)
