-- SPDX-License-Identifier: GPL-3.0-or-later
-- How far noise changes the order of values.
local unrest = require "softworld.study.unrest"

describe("unrest", function()
  local function values(count)
    local list = {}
    for k = 1, count do list[k] = k end
    return list
  end

  it("is below 0 when the same values return", function()
    assert.is_true(unrest(values(10), { 1, 2 }) < 0)
    assert.is_true(unrest(values(10), { 1.1, 1.9 }) < 0)
  end)

  -- The best of 10 becomes the worst, 18 ranks away; the change allowed, 10 % of the changes by chance, is 1
  -- or 2.
  it("is above 0 when the best becomes the worst", function()
    assert.is_true(unrest(values(10), { 99 }) > 0)
  end)

  -- When values are only noise, their order changes by more than the allowed amount in most draws.
  it("is above 0 in most draws of pure noise", function()
    math.randomseed(5)
    local above = 0
    for _ = 1, 200 do
      local list = {}
      for k = 1, 10 do list[k] = math.random() end
      if unrest(list, { math.random(), math.random(), math.random() }) > 0 then above = above + 1 end
    end
    assert.is_true(above > 150, above)
  end)
end)
