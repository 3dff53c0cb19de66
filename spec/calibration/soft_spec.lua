-- SPDX-License-Identifier: GPL-3.0-or-later
-- Calibration of long or soft cables, gamma = weight L^3 / EI up to 1e5: almost all of the bend is within a
-- few (EI / weight)^(1/3) of the clamp, which is shorter than an edge of a coarse mesh. The data are those
-- of the heavy inextensible elastica, integrated here.
local sw = require "softworld"

local G, MASS = 9.81, 0.02
local STEPS, POINTS = 4000, 20

-- Angle phi from the vertical, places x, z, over the distance t from the free end, all over L:
-- phi'' = gamma t sin(phi), x' = sin(phi), z' = cos(phi). Runge-Kutta of fourth order; phi(0) is tip. Returns
-- phi(1) and every STEPS / POINTS-th place, or early when phi is above a right angle.
local function shoot(gamma, tip)
  local h, y, list = 1 / STEPS, { tip, 0, 0, 0 }, { { 0, 0 } }
  local function rates(t, phi, turn) return turn, gamma * t * math.sin(phi), math.sin(phi), math.cos(phi) end
  for i = 0, STEPS - 1 do
    local t, phi, turn = i * h, y[1], y[2]
    local a1, a2, a3, a4 = rates(t, phi, turn)
    local b1, b2, b3, b4 = rates(t + h / 2, phi + h / 2 * a1, turn + h / 2 * a2)
    local c1, c2, c3, c4 = rates(t + h / 2, phi + h / 2 * b1, turn + h / 2 * b2)
    local d1, d2, d3, d4 = rates(t + h, phi + h * c1, turn + h * c2)
    y = { phi + h / 6 * (a1 + 2 * b1 + 2 * c1 + d1), turn + h / 6 * (a2 + 2 * b2 + 2 * c2 + d2),
      y[3] + h / 6 * (a3 + 2 * b3 + 2 * c3 + d3), y[4] + h / 6 * (a4 + 2 * b4 + 2 * c4 + d4) }
    if y[1] > math.pi / 2 + 0.1 then return y[1] end
    if (i + 1) % (STEPS / POINTS) == 0 then list[#list + 1] = { y[3], y[4] } end
  end
  return y[1], list
end

-- Returns points { x, z } of a level cantilever of 1 m, from its clamp. The angle at the tip falls as
-- exp(-2/3 sqrt(gamma)), so its logarithm is sought.
local function cantilever(gamma)
  local low, high = -2 * math.sqrt(gamma) - 5, math.log(math.pi / 2)
  for _ = 1, 45 do
    local middle = 0.5 * (low + high)
    if shoot(gamma, math.exp(middle)) < math.pi / 2 then low = middle else high = middle end
  end
  local _, list = shoot(gamma, math.exp(low))
  local last, points = list[#list], {}
  for k = #list - 1, 1, -1 do points[#points + 1] = { last[1] - list[k][1], list[k][2] - last[2] } end
  return points
end

describe("sw.calibration of a soft cable", function()
  -- The place of a cantilever's end at gamma = 1000 by another solver, error 2e-12: x / L, z / L.
  it("has data of the exact elastica", function()
    local points = cantilever(1000)
    local tip = points[#points]
    assert.is_true(math.abs(tip[1] - 0.04598645476) < 1e-9, tip[1])
    assert.is_true(math.abs(tip[2] + 0.9811412693) < 1e-9, tip[2])
  end)

  -- The rest of the meshes' error is to stay below the error of usual data: 0.2 % of EI.
  for _, gamma in ipairs { 1000, 5000, 10000, 50000 } do
    it(("finds EI from a cantilever, gamma = %g"):format(gamma), function()
      local EI = MASS * G / gamma
      local found = sw.calibration { mass_per_length = MASS, outer_diameter = 0.001,
        sag = { ends = "cantilever", points = cantilever(gamma), length = 1, sigma = 5e-4 } }
      assert.is_true(found.fit.ok, found.fit.reason)
      assert.is_true(math.abs(found.EI.value / EI - 1) < 2e-3, found.EI.value / EI)
      assert.is_true(found.EI.low < EI and EI < found.EI.high)
    end)
  end
end)
