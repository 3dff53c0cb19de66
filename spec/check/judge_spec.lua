-- SPDX-License-Identifier: GPL-3.0-or-later
-- Verdicts of run:check by hand: value and limit are each known to lie between low and high. A value that
-- equals its limit passes.
local judge = require "softworld.check.judge"

local nan = 0 / 0

-- side, value {low, value, high}, limit {low, value, high}, verdict.
local cases = {
  { "max", { 1, 1, 1 }, { 2, 2, 2 }, "PASS" },
  { "max", { 2, 2, 2 }, { 2, 2, 2 }, "PASS" }, -- equal to the limit
  { "max", { 2.1, 2.1, 2.1 }, { 2, 2, 2 }, "FAIL" },
  { "max", { 1.8, 1.9, 2 }, { 2, 2, 2 }, "PASS" }, -- the bar ends at the limit
  { "max", { 1.8, 1.9, 2.1 }, { 2, 2, 2 }, "OPEN" }, -- the bar covers the limit
  { "max", { 1.9, 2.1, 2.3 }, { 2, 2, 2 }, "OPEN" },
  { "max", { 2.1, 2.2, 2.3 }, { 2, 2, 2 }, "FAIL" },
  { "max", { 1, 1, 1 }, { 1.5, 2, 3 }, "PASS" }, -- below the whole range of the limit
  { "max", { 1.7, 1.7, 1.7 }, { 1.5, 2, 3 }, "OPEN" },
  { "max", { 4, 4, 4 }, { 1.5, 2, 3 }, "FAIL" },
  { "min", { 2, 2, 2 }, { 2, 2, 2 }, "PASS" },
  { "min", { 1.9, 1.9, 1.9 }, { 2, 2, 2 }, "FAIL" },
  { "min", { 1.9, 2.1, 2.3 }, { 2, 2, 2 }, "OPEN" },
  { "min", { 2.5, 2.5, 2.5 }, { 1.5, 2, 3 }, "OPEN" },
  { "min", { 3, 3, 3 }, { 1.5, 2, 3 }, "PASS" },
  { "min", { math.huge, math.huge, math.huge }, { 2, 2, 2 }, "PASS" }, -- straight
  { "max", { 1, 1, math.huge }, { 2, 2, 2 }, "OPEN" }, -- no upper bound is known
  { "max", { nan, nan, nan }, { 2, 2, 2 }, "FAIL" },
  { "min", { nan, nan, nan }, { 2, 2, 2 }, "FAIL" },
  { "max", { 1, 1, nan }, { 2, 2, 2 }, "FAIL" },
  { "min", { 0.15 - 0.1, 0.15 - 0.1, 0.15 - 0.1 }, { 0.05, 0.05, 0.05 }, "PASS" }, -- 7e-18 below
  { "max", { 0.1 + 0.2, 0.1 + 0.2, 0.1 + 0.2 }, { 0.3, 0.3, 0.3 }, "PASS" }, -- 6e-17 above
  { "max", { 2 + 4e-12, 2 + 4e-12, 2 + 4e-12 }, { 2, 2, 2 }, "FAIL" },
  { "min", { -2 - 4e-12, -2, -2 }, { -2, -2, -2 }, "OPEN" },
  { "min", { -2 - 1e-12, -2, -2 }, { -2, -2, -2 }, "PASS" },
  { "max", { 1e-300, 1e-300, 1e-300 }, { 0, 0, 0 }, "FAIL" },
  { "max", { math.huge, math.huge, math.huge }, { 2, 2, 2 }, "FAIL" },
}

local function range(x) return { low = x[1], value = x[2], high = x[3] } end

describe("a verdict", function()
  for i, case in ipairs(cases) do
    it(("number %d is %s"):format(i, case[4]), function()
      assert.equal(case[4], judge.verdict(range(case[2]), range(case[3]), case[1]))
    end)
  end

  -- A limit of 0: the value may be beyond it by the rounding of the terms that it is the difference of.
  local zero = { value = 0 }
  for _, terms in ipairs{ 1e-3, 1, 2.5e4 } do
    it(("at a limit of 0 knows the rounding of terms of %g"):format(terms), function()
      for _, side in ipairs{ "max", "min" } do
        local sign = side == "max" and 1 or -1
        local noise = { value = sign * terms * 2 ^ -52, terms = terms }
        assert.equal("PASS", judge.verdict(noise, zero, side))
        assert.equal(0, judge.margin(noise, zero, side))
        local beyond = { value = sign * terms * 1e-12, terms = terms }
        assert.equal("FAIL", judge.verdict(beyond, zero, side))
        assert.is_near(-terms * 1e-12, judge.margin(beyond, zero, side), 1e-24 * terms)
        assert.equal("FAIL", judge.verdict({ value = noise.value }, zero, side)) -- of unknown terms
        assert.equal("OPEN", judge.verdict({ value = 0, low = -1e-12 * terms, high = 1e-12 * terms,
          terms = terms }, zero, side))
      end
    end)
  end

  it("does not use that rounding at other limits", function()
    assert.equal("FAIL", judge.verdict({ value = 2e-15, terms = 1 }, { value = 1e-15 }, "max"))
  end)

  it("has a margin above 0 where the limit is kept", function()
    assert.equal(0.5, judge.margin({ value = 1.5 }, { value = 2 }, "max"))
    assert.equal(-0.5, judge.margin({ value = 1.5 }, { value = 2 }, "min"))
    assert.equal(0, judge.margin({ value = 2 }, { value = 2 }, "min"))
    assert.equal(0, judge.margin({ value = 0.1 + 0.2 }, { value = 0.3 }, "max")) -- not -6e-17
    assert.is_near(-4e-12, judge.margin({ value = 2 + 4e-12 }, { value = 2 }, "max"), 1e-15)
  end)
end)

describe("a limit that is probably a mistake", function()
  -- value, limit, side, known, reference -> reported?, kept from passing?
  for i, case in ipairs{
    { 50, 80, "max", nil, 100, false },
    { 50, 80e3, "max", { value = 268, from = "catalogue" }, nil, true, true }, -- mN for N
    { 50, 0.08, "max", { value = 268, from = "catalogue" }, nil, true, false }, -- fails anyway
    { 0.04, 30, "min", { value = 0.0135, from = "standard" }, nil, true, false }, -- mm for m: fails
    { 0.04, 0.000030, "min", { value = 0.0135, from = "standard" }, nil, true, true },
    { 0.01, 20, "max", nil, nil, true, true }, -- only the value is known
    { 0.01, 2, "max", nil, nil, false },
    { 0, 2, "max", nil, nil, false },
    { 50, 400, "max", { value = 268, from = "catalogue" }, nil, true, false }, -- laxer, reported
    { 0.04, 0, "min", { value = 0.0135, from = "standard" }, nil, true, true }, -- lets everything pass
    { 0.04, -0.03, "min", nil, 0.01, true, true },
    { 0.3, 0.8, "max", { value = 1, from = "definition" }, 1, false },
  } do
    it("is reported, number " .. i, function()
      local text, suspicious = judge.suspicion(case[1], { value = case[2] }, case[3], "N", case[4], case[5])
      assert.equal(case[6], text ~= nil, text)
      if case[6] then assert.equal(case[7], suspicious, text) end
    end)
  end

  it("has no unit where the value has none", function()
    local text = judge.suspicion(0.03, { value = 5 }, "max", "-", nil, 0.01)
    local words = "the limit of 5 differs by a factor of 500 from what is usual, 0.01000; is it right?"
    assert.truthy(text:find(words, 1, true), text)
  end)
end)
