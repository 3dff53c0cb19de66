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
