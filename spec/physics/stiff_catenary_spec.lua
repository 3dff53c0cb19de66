-- SPDX-License-Identifier: GPL-3.0-or-later
-- A heavy wire between two clamps at equal height, both level: sag, pull and end
-- moment. Independent solution of the boundary value problem, error 1e-9; lengths
-- in L, forces in w L, moments in EI/L.
local core = require "softworld.core"

local rows = {
  { ratio = 1.05, gamma = 10, sag = 0.137197352, H = -3.348485861, M0 = -3.128883177 },
  { ratio = 1.05, gamma = 100, sag = 0.1376655073, H = 0.30120686, M0 = -5.631296552 },
  { ratio = 1.05, gamma = 1000, sag = 0.134729842, H = 0.7361901663, M0 = -16.47078916 },
  { ratio = 1.5, gamma = 10, sag = 0.327511754, H = -4.578828787, M0 = -8.120543683 },
  { ratio = 1.5, gamma = 100, sag = 0.3304012418, H = -0.2989278312, M0 = -10.84165933 },
  { ratio = 1.5, gamma = 1000, sag = 0.334817289, H = 0.1291847389, M0 = -26.52393217 },
}

local function hang(row, n)
  local EI = 1 / row.gamma
  local s = core.scene{ gravity = { 0, 0, -1 } }
  local w = s:wire{ EA = 1e8 * EI, EI = EI, mass_per_length = 1, radius = 0.001, from = { 0, 0, 0 },
    to = { 1, 0, 0 }, segments = n }
  local a, b = s:clamp(w, { s = 0 }), s:clamp(w, { s = 1 })
  for i = 1, 10 do
    b:pose{ 1 + (1 / row.ratio - 1) * i / 10, 0, 0 }
    local r = s:settle()
    assert.is_true(r.ok, r.reason)
  end
  return { sag = -w:position(0.5)[3], H = -a:force()[1], M0 = a:moment()[2] / EI }
end

-- The reference's own tolerances at N = 50.
local SAG, PULL = 2e-3, 0.01
local MOMENT = { [10] = 0.003, [100] = 0.01, [1000] = 0.08 }

describe("a stiff catenary", function()
  for _, row in ipairs(rows) do
    it(("L/span = %g, Gamma = %g"):format(row.ratio, row.gamma), function()
      local got = hang(row, 50)
      assert.is_true(math.abs(got.sag - row.sag) < SAG, "sag " .. got.sag)
      assert.is_true(math.abs(got.H - row.H) < PULL, "pull " .. got.H)
      assert.is_true(math.abs(got.M0 / row.M0 - 1) < MOMENT[row.gamma], "moment " .. got.M0)
    end)
  end

  it("is second order in the number of segments", function()
    local row, errors = rows[5], {}
    for i, n in ipairs{ 25, 50, 100 } do
      local got = hang(row, n)
      errors[i] = math.max(math.abs(got.sag - row.sag), math.abs(got.H - row.H))
    end
    local order = math.log(errors[1] / errors[3]) / math.log(4)
    assert.is_true(order > 1.8, "order " .. order)
  end)
end)
