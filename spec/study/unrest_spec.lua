-- SPDX-License-Identifier: GPL-3.0-or-later
-- How much noise changes the order of values.
local unrest = require "softworld.study.unrest"

describe("unrest", function()
  local function values(count)
    local list = {}
    for k = 1, count do list[k] = k end
    return list
  end

  it("is below 0 where the same values come again", function()
    assert.is_true(unrest(values(10), { 1, 2 }) < 0)
    assert.is_true(unrest(values(10), { 1.1, 1.9 }) < 0)
  end)

  -- The best of 10 becomes the worst of all, 18 ranks away; 10 % of the changes that chance makes are 1 or 2.
  it("is above 0 where the best becomes the worst", function()
    assert.is_true(unrest(values(10), { 99 }) > 0)
  end)

  -- Of values that are nothing but noise the order changes more than is borne in most draws.
  it("is above 0 for noise alone, mostly", function()
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
