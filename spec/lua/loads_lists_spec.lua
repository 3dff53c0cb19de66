-- SPDX-License-Identifier: GPL-3.0-or-later
-- Flat lists of recorded loads with holes, or with other things than numbers, are refused.
local core = require "softworld.core"

-- Returns a list with holes whose length, by Lua's rules, is n: 40 bytes for each five of its items are more
-- than memory can count.
local function holed(n)
  local keys, t = {}, {}
  local low, high = 1, 1
  while high <= n do keys[#keys + 1], low, high = high, high, 2 * high end
  while high - low > 1 do
    local middle = low + (high - low) // 2
    if middle <= n then keys[#keys + 1], low = middle, middle else high = middle end
  end
  for i = #keys, 1, -1 do t[keys[i]] = 1 end
  return t
end

describe("flat lists of recorded loads", function()
  it("may not have holes", function()
    local n = 5 * 461168601842738791
    local t = holed(n)
    assert.equal(n, #t)
    assert.matches("too long", select(2, pcall(function() core.peak(t, 0.1) end)))
    assert.matches("too long", select(2, pcall(function() core.longest_span(t, 0, 0.1) end)))
    assert.matches("too long", select(2, pcall(function() core.is_coarse(t, 0.1, 1, 1, 1) end)))
    assert.is_false((pcall(core.loads, t, nil, 0, 1, 0.1)))
    assert.is_false((pcall(core.loads, t, t, 0, 1, 0.1)))
  end)

  it("have numbers only", function()
    assert.error_matches(function() core.peak({ 0, 1, "x", 0, 0 }, 0.1) end,
      "list 1: item 3 must be a number, got string")
    assert.error_matches(function() core.loads({ 0, 1, 0, 0, 0, 0, 0, 0, 0, 0 }, { {} }, 0, 1, 0.1) end,
      "list 2: item 1 must be a number, got table")
  end)
end)
