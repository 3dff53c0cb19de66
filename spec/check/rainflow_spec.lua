-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rainflow count against the example of ASTM E1049-85 (figure 6) and sequences counted by hand.
local rainflow = require "softworld.check.rainflow"

-- Range -> number of cycles.
local function counted(history)
  local sums = {}
  for _, cycle in ipairs(rainflow.count(history)) do
    sums[cycle.range] = (sums[cycle.range] or 0) + cycle.count
  end
  return sums
end

describe("a rainflow count", function()
  for name, case in pairs{
    ["of the standard's example"] = { { -2, 1, -3, 5, -1, 3, -4, 4, -2 },
      { [3] = 0.5, [4] = 1.5, [6] = 0.5, [8] = 1, [9] = 0.5 } },
    ["of one rise"] = { { 0, 2 }, { [2] = 0.5 } },
    ["of one cycle"] = { { 0, 2, 0 }, { [2] = 1 } },
    ["of three equal cycles"] = { { 0, 2, 0, 2, 0, 2, 0 }, { [2] = 3 } },
    ["of a small cycle within a large one"] = { { 0, 5, 3, 4, 0 }, { [5] = 1, [1] = 1 } },
    ["of growing swings"] = { { 0, 1, -1, 2, -2 }, { [1] = 0.5, [2] = 0.5, [3] = 0.5, [4] = 0.5 } },
    ["of falling swings"] = { { 3, -3, 2, -2, 1 }, { [6] = 0.5, [5] = 0.5, [4] = 0.5, [3] = 0.5 } },
    ["of what never turns"] = { { 0, 1, 2, 2, 3 }, { [3] = 0.5 } },
    ["with plateaus and steps on the way"] = { { 0, 1, 2, 2, 2, 1, 0, 0 }, { [2] = 1 } },
    ["of nothing"] = { {}, {} },
    ["of one value"] = { { 7 }, {} },
    ["of a constant"] = { { 7, 7, 7 }, {} },
  } do
    it(name, function() assert.same(case[2], counted(case[1])) end)
  end

  -- Each reversal except the first ends half a cycle.
  it("loses no half cycle of a random history", function()
    local state = 12345
    for _ = 1, 200 do
      local history = {}
      for i = 1, 30 do
        state = (state * 1103515245 + 12345) % 2 ^ 31
        history[i] = state // 65536 % 20
      end
      local sum = 0
      for _, cycle in ipairs(rainflow.count(history)) do sum = sum + 2 * cycle.count end
      assert.equal(#rainflow.reversals(history) - 1, sum)
    end
  end)
end)

describe("Miner's sum", function()
  local curve = { { 1, 1e6 }, { 10, 1e3 }, { 100, 10 } } -- slopes -3, -2

  it("reads the curve at its points, between them and beyond them", function()
    for range, life in pairs{ [1] = 1e6, [10] = 1e3, [100] = 10, [2] = 1e6 / 8, [20] = 1e3 / 4, [0.1] = 1e9,
      [1000] = 0.1 } do
      assert.is_near(life, rainflow.life(curve, range), 1e-9 * life)
    end
  end)

  it("adds the shares of life", function()
    local sum, most = rainflow.damage({ 0, 10, 8, 9, 0 }, curve)
    assert.is_near(1e-3 + 1e-6, sum, 1e-15)
    assert.equal(10, most)
    assert.equal(0, (rainflow.damage({ 3, 3 }, curve)))
  end)
end)
