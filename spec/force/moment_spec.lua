-- SPDX-License-Identifier: GPL-3.0-or-later
-- A couple at the end of a cantilever bends it to a circular arc: with
-- M = k EI/L the tip is at (L sin k/k, L (1 - cos k)/k).
local core = require "softworld.core"

local function rolled(k, n, options)
  local o = options or {}
  local axis, along = o.axis or { 0, 0, 1 }, o.along or { 1, 0, 0 }
  local EI, L = o.EI or 1, o.L or 1
  local s = core.scene{ gravity = { 0, 0, 0 } }
  local w = s:wire{ EA = 1e6 * EI / L ^ 2, EI = EI, mass_per_length = 1, radius = 0.001,
    from = { 0, 0, 0 }, to = { along[1] * L, along[2] * L, along[3] * L }, segments = n }
  local c = s:clamp(w, { s = 0 })
  local force
  for i = 1, 8 do
    if force then force:release() end
    local M = k * EI / L * i / 8
    force = s:force{ kind = "moment", on = w, s = L, moment = { axis[1] * M, axis[2] * M, axis[3] * M } }
    local r = s:settle()
    assert.is_true(r.ok, r.reason)
  end
  return w:position(L), c
end

local function off(p, x, y) return math.sqrt((p[1] - x) ^ 2 + (p[2] - y) ^ 2 + p[3] ^ 2) end

describe("an end moment", function()
  it("rolls a cantilever up to a circle, to second order", function()
    for _, k in ipairs{ 1, math.pi, 2 * math.pi } do
      local errors = {}
      for i, n in ipairs{ 25, 50, 100 } do
        local p = rolled(k, n)
        errors[i] = off(p, math.sin(k) / k, (1 - math.cos(k)) / k)
        assert.is_true(errors[i] < k / n ^ 2, ("k = %g, n = %d: %g"):format(k, n, errors[i]))
      end
      -- where the error is far below its bound from the start, it may be of higher order or rounding
      if errors[3] > 1e-6 then
        assert.is_true(math.log(errors[1] / errors[3]) / math.log(4) > 1.8)
      end
    end
  end)

  it("is borne by the clamp", function()
    local _, c = rolled(2, 40, { EI = 0.3, L = 2 })
    local m = c:moment()
    assert.is_true(math.abs(m[3] + 2 * 0.3 / 2) < 1e-6)
    assert.is_true(math.abs(m[1]) + math.abs(m[2]) < 1e-9)
  end)

  it("bends about any axis", function()
    local p = rolled(2, 50, { axis = { 0, -1, 0 } })
    assert.is_true(math.abs(p[1] - math.sin(2) / 2) < 1e-3)
    assert.is_true(math.abs(p[3] - (1 - math.cos(2)) / 2) < 1e-3)
  end)
end)

-- A pinned rod of inertia m L^2 / 3 that a couple M turns for a time t: w = M t / I, and the couple's
-- work is M w t / 2, whole turns included.
describe("a couple that turns a wire round and round", function()
  local sw = require "softworld"
  local M, t, L, m = 2e-3, 2, 0.2, 0.02 -- [N m], [s], [m], [kg/m]

  local function turned(dt)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e4, EI = 0.05, mass_per_length = m, radius = 1e-3, segments = 10,
      from = { 0, 0, 0 }, to = { L, 0, 0 } }
    scene:pin(wire, { s = 0 })
    scene:force{ kind = "moment", on = wire, s = L / 2, moment = { 0, 0, M } }
    local run = scene:run{ duration = t, dt = dt }
    assert.is_true(run.ok, run.reason)
    return scene, run
  end

  it("does the work M times the angle, at any step", function()
    for _, dt in ipairs{ 1e-2, 1e-3 } do
      local scene, run = turned(dt)
      assert.equal(0, #run.events)
      local I = m * L ^ 3 / 3
      local work = (M * t) ^ 2 / (2 * I) -- 12 turns
      assert.is_true(work / M > 20 * math.pi)
      local e = scene:energy()
      assert.is_true(math.abs(e.kinetic / work - 1) < 0.01, e.kinetic .. " " .. work)
    end
  end)

  it("does so about an axis that the wire is not across, without energy from nowhere", function()
    for _, name in ipairs{ "GXL 1.5", "H07V-K 4", "FLRY-B 2.5" } do
      for _, dt in ipairs{ 1e-2, 2e-3 } do
        local scene = sw.scene{}
        local wire = scene:wire{ cable = name, segments = 40, from = { 0, 0, 0.05 }, to = { 0.4, 0, 0.05 } }
        local EI = wire.beam.EI
        scene:clamp(wire, { s = 0 })
        scene:force{ kind = "damping", mass = 1, stiffness = 0.003 }
        scene:force{ kind = "moment", on = wire, s = 0.2, moment = { 0, EI * 3, -EI * 4 } }
        local run = scene:run{ duration = 0.8, dt = dt }
        assert.is_true(run.ok, run.reason)
        for _, e in ipairs(run.events) do assert.equal("couple", e.kind) end
      end
    end
  end)

  it("bends by M / sin a at an angle a to its axis, and an event tells of small angles", function()
    for _, degrees in ipairs{ 90, 60, 30, 10, 0 } do
      local a, size = math.rad(degrees), 1e-5
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e4, EI = 0.05, mass_per_length = m, radius = 1e-3, segments = 10,
        from = { 0, 0, 0 }, to = { L, 0, 0 } }
      local clamp = scene:clamp(wire, { s = 0 })
      scene:force{ kind = "moment", on = wire, s = L,
        moment = { size * math.cos(a), size * math.sin(a), 0 } }
      local result = scene:settle()
      assert.is_true(result.ok)
      local found = clamp:moment()
      local of = math.sqrt(found[1] ^ 2 + found[2] ^ 2 + found[3] ^ 2)
      local wanted = degrees > 0 and size / math.sin(a) or 0
      assert.is_true(math.abs(of - wanted) < 2e-3 * size, degrees .. ": " .. of)
      local told = {}
      for _, e in ipairs(result.events) do told[#told + 1] = e.kind end
      assert.same(degrees < 45 and { "couple" } or {}, told)
      if degrees == 0 then assert.matches("does nothing", result.events[1].text) end
      if degrees == 10 then assert.is_true(math.abs(result.events[1].value * math.sin(a) - 1) < 1e-2) end
    end
  end)
end)
