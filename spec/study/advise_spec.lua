-- SPDX-License-Identifier: GPL-3.0-or-later
-- The advised method, given the evaluations so far.
local sw = require "softworld"

local TWO = { a = { -2, 2 }, b = { -1, 3 } }

local function advice(parameters, evaluate, constraints, count)
  local s = sw.study { name = "s", parameters = parameters, evaluate = evaluate, constraints = constraints,
    workers = 0 }
  s:sweep { kind = "latin", count = count or 60 }
  return s:advise "y", s
end

describe("study:advise", function()
  -- A quadratic polynomial reproduces (a - 1)^2 + a b + b^2 exactly.
  it("advises a model method where a polynomial fits, and this finds the minimum", function()
    local told, s = advice(TWO, function(p) return { y = (p.a - 1) ^ 2 + p.a * p.b + p.b ^ 2 } end)
    assert.equal("bobyqa", told.method)
    assert.truthy(told.why:find "it is smooth")
    local found = s:minimise("y", { method = told.method, evaluations = told.evaluations })
    assert.is_true(found.ok)
    assert.is_true(math.abs(found.best.a - 4 / 3) < 0.01 and math.abs(found.best.b + 2 / 3) < 0.01)
  end)

  it("advises COBYLA for smooth constraints", function()
    local told = advice(TWO, function(p)
      return { y = p.a ^ 2 + p.b ^ 2, sum = p.a + p.b }
    end, { sum = { min = 0.5 } })
    assert.equal("cobyla", told.method)
  end)

  it("advises CMA-ES where constraints have steps, many evaluations fail, or no polynomial fits", function()
    local told = advice(TWO, function(p) return { y = p.a, held = p.a + p.b > 0 } end, { held = { min = 1 } })
    assert.same({ "cma-es", "'held' has steps, which it bears" }, { told.method, told.why })
    assert.truthy(tostring(told):find "such as a margin")
    told = advice(TWO, function(p)
      if p.number % 5 == 0 then error "lost" end
      return { y = p.a ^ 2 }
    end)
    assert.same({ "cma-es", "20 % of the evaluations failed, which it bears" }, { told.method, told.why })
    told = advice(TWO, function(p) return { y = math.sin(9 * p.a) * math.cos(7 * p.b) } end)
    assert.equal("cma-es", told.method)
    assert.truthy(told.why:find "a quadratic polynomial leaves %d+ %% of the variance unexplained")
  end)

  it("detects noise where the same place gave different values", function()
    local told, s = advice({ n = { 1, 5, integer = true } }, function(p) return { y = p.n + p.random() } end)
    assert.same({ "cma-es", "values are noisy" }, { told.method, told.why })
    assert.truthy(tostring(told):find("noise = true", 1, true))
    assert.equal("study:minimise", tostring(told):match "^study:minimise")
    s:minimise("y", { method = told.method, noise = true, evaluations = 60 })
  end)

  it("points out ranges that should be logarithmic, and that no evaluation passes", function()
    local told = advice({ a = { 0.01, 10 }, b = { 0, 1 } }, function(p)
      return { y = p.a + p.b }
    end, { y = { max = -1 } })
    assert.truthy(tostring(told):find("'a' goes up to 1000 times its lowest value: log = true", 1, true))
    assert.truthy(tostring(told):find("no evaluation meets the constraints so far", 1, true))
  end)

  it("says how many evaluations it needs to see more", function()
    local told, s = advice(TWO, function(p) return { y = p.a } end, nil, 5)
    assert.truthy(tostring(told):find("run study:sweep { count = 24 }", 1, true))
    assert.error_matches(function() s:advise "z" end, "there is no parameter or result 'z'")
    assert.error_matches(function() s:advise(3) end, "the name of a result is wanted")
    local fresh = sw.study { name = "s", parameters = TWO, evaluate = function() return { y = 1 } end }
    assert.error_matches(function() fresh:advise "y" end,
      "there are no evaluations; study:sweep { count = 24 }")
  end)
end)
