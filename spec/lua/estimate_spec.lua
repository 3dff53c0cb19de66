-- SPDX-License-Identifier: GPL-3.0-or-later
-- The error bar computed from the values on the levels.
package.path = "./?.lua;" .. package.path
local estimate = require "softworld.run.estimate"
local t = require "spec.physics.tools"

describe("the estimate", function()
  local plain, smooth = { plain = true }, {}

  it("is 1.5 times the true error, for second and for first order", function()
    for _, order in ipairs{ 1, 2 } do
      for n = 3, 6 do
        local values = {}
        for k = 1, n do values[k] = 5 + 2 ^ (-order * k) end
        local bar = estimate.bar(smooth, values, false)
        t.near(1.5, bar / (values[n] - 5), 0.01, "bar over error")
      end
    end
    t.near(1.5, estimate.bar(smooth, { 5.25, 5.0625 }, false) / 0.0625, 0.01, "two levels")
    t.near(1.5, estimate.bar(plain, { 5.25, 5.125 }, false) / 0.125, 0.01, "two levels, first order")
  end)

  it("is at least the whole value of a quantity that vanishes", function()
    local depth = { plain = true, row = true, vanishes = true }
    assert.equal(2e-6, estimate.bar(depth, { 3e-6, 2.1e-6, 2e-6 }, true))
    assert.equal(2e-6, estimate.bar(depth, { 2e-6, 2e-6 }, true))
    assert.is_near(6e-5, estimate.bar(depth, { 1e-6, 2e-6, 12e-6 }, true), 1e-12) -- its change is larger
    assert.equal(0, estimate.bar(depth, { 0, 0, 0 }, true))
  end)

  it("does not trust a small last change", function()
    for _, last in ipairs{ 0, 1e-9, -1e-9 } do
      assert.is_true(estimate.bar(smooth, { 5, 6, 6 + last }, false) > 0.1)
      assert.is_true(estimate.bar(smooth, { 5, 6, 6 + last }, true) > 0.15)
    end
  end)

  -- Bend radius at the clamp of a hung wire, levels 1 to 7: its changes of first and second order cancelled
  -- once. The true value goes on by 1/3 of the last change. A bar is of use up to ten times the error.
  it("does not trust a change that shrank faster than any order", function()
    local radii = { 62.55025, 62.167817, 62.130235, 62.041089, 62.004116, 61.992798, 61.989697 }
    local exact = radii[7] + (radii[7] - radii[6]) / 3
    for k = 3, 6 do
      local bar = estimate.bar(plain, table.move(radii, 1, k, 1, {}), false)
      assert.is_true(bar >= math.abs(radii[k] - exact), ("level %d: %g"):format(k, bar))
      assert.is_true(bar <= 10 * math.abs(radii[k] - exact), ("level %d: %g"):format(k, bar))
    end
  end)

  it("is wide for values that jump", function()
    local values = { 1, 1.1, 1.6, 1.65 }
    assert.is_true(estimate.bar(plain, values, true) >= 0.5)
    assert.is_true(estimate.bar(smooth, { 1, 1.2, 1.1 }, false) >= 0.1)
    assert.is_true(estimate.bar(smooth, { { 1, 0 }, { 1, 1 }, { 0, 1 } }, false) >= 1)
  end)

  -- Changes between the levels that a bar uses, over the true error of the last level, which finer levels
  -- gave.
  it("of a motion covers the error where three coarse levels, or four by chance, look convergent", function()
    for _, moves in ipairs{ true, false } do -- a change that shrank faster than any order, at rest too
      local bar = estimate.bar(smooth, { 5, 8.8, 8.828 }, false, moves)
      assert.is_true(bar >= 1 and bar < 15, ("%g"):format(bar))
    end
    for _, case in ipairs{ { smooth, false, 1.1, -0.49 },
      { plain, false, 2.2, 0.46 }, { plain, false, 27, 4.1, 1.1 }, { plain, true, 1.4, 0.32 },
      { plain, true, 7.7, 1.3, 0.48 },
      { smooth, true, 7.5, 3.7, 0.15 }, { smooth, true, 6.9, 0.93, 0.06 } } do
      local values = { 5 }
      for i = 3, #case do values[i - 1] = values[i - 2] + case[i] end
      local still = estimate.bar(case[1], values, case[2])
      local bar = estimate.bar(case[1], values, case[2], true)
      assert.is_true(still < 1 and bar >= 1, ("%g, was %g"):format(bar, still))
      assert.is_true(bar < 15, ("%g"):format(bar))
    end
    local orderly = { 5, 5.25, 5.3125, 5.328125 }
    assert.are.equal(estimate.bar(plain, orderly, false), estimate.bar(plain, orderly, false, true))
  end)

  -- Sidewall pressure of a blow in a first pass of levels; on finer levels it rose to 8 and 12.
  it("leaves room where the changes over three levels grow or hardly shrink", function()
    for _, values in ipairs{ { 1.346, 1.476, 1.968 }, { 3.365, 5.241, 7.042 } } do
      local last = values[3] - values[2]
      for _, contact in ipairs{ false, true } do
        assert.is_near(6 * last, estimate.bar({ row = true, plain = true }, values, contact), 1e-12)
      end
    end
    local halved = { 1, 1.5, 1.75 } -- as much again is to come
    assert.is_near(1.5 * 0.25, estimate.bar({ row = true, plain = true }, halved, true), 1e-12)
  end)

  it("is infinite for a single level, positive for equal values, zero for infinite ones", function()
    assert.are.equal(math.huge, (estimate.bar(smooth, { 1 }, false)))
    assert.is_true(estimate.bar(smooth, { 1, 1, 1 }, false) > 0)
    local straight = { math.huge, math.huge, math.huge } -- its bend radius
    assert.are.equal(0, (estimate.bar(smooth, straight, false)))
    assert.are.equal(math.huge, (estimate.bar(smooth, { 1, 2, math.huge }, false)))
  end)
end)
