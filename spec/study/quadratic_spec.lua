-- SPDX-License-Identifier: GPL-3.0-or-later
-- Polynomials of degree 2 fitted to values.
local quadratic = require "softworld.study.quadratic"

-- (x - 1)^2 + 2 (y + 2)^2 + (x - 1) (y + 2) + 5 on a grid: reproduced exactly, smallest at (1, -2).
local function bowl(x, y) return (x - 1) ^ 2 + 2 * (y + 2) ^ 2 + (x - 1) * (y + 2) + 5 end

local function grid(f)
  local places, values = {}, {}
  for x = -2, 2 do
    for y = -2, 2 do places[#places + 1], values[#values + 1] = { x, y }, f(x, y) end
  end
  return places, values
end

describe("a quadratic polynomial", function()
  it("reproduces the values of one, with its minimum in the same place", function()
    local fit = quadratic.fit(grid(bowl))
    assert.equal(6, #fit)
    assert.equal(6, quadratic.count(2))
    assert.is_true(math.abs(quadratic.at(fit, { 0.3, 7 }) - bowl(0.3, 7)) < 1e-6)
    local lowest = quadratic.lowest(fit, 2)
    assert.is_true(math.abs(lowest[1] - 1) < 1e-6 and math.abs(lowest[2] + 2) < 1e-6)
  end)

  it("has no minimum where it falls along a direction, or is flat", function()
    local saddle, trough = function(x, y) return x * x - y * y end, function(x) return x * x end
    assert.is_nil(quadratic.lowest(quadratic.fit(grid(saddle)), 2))
    assert.is_nil(quadratic.lowest(quadratic.fit(grid(trough)), 2))
  end)

  -- The mean of 1, 1, 1 and 5 at the same place is 2; so is that of 1 with weight 3 and 5 with weight 1.
  it("counts a weight as that number of values", function()
    local fit = quadratic.fit({ { 0 }, { 0 }, { 1 }, { -1 } }, { 1, 5, 9, 9 }, { 3, 1, 1, 1 })
    assert.is_true(math.abs(quadratic.at(fit, { 0 }) - 2) < 1e-6)
  end)
end)
