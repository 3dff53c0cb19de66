-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fits: least squares with known results and errors, bounds, failures, parameters that the data do not
-- determine, identical bits.
local straight = require "spec.study.lines"
local fitlinear = require "softworld.study.fitlinear"

local study, near, X, Y, line, RANGES, data = straight.study, straight.near, straight.X, straight.Y,
  straight.line, straight.RANGES, straight.data

-- Formulas of linear regression: b = Sxy / Sxx, a = mean y - b mean x, var b = s^2 / Sxx, var a = s^2 (1 / n
-- + mean x^2 / Sxx).
local function regression()
  local n, mx, my, sxx, sxy = #X, 0, 0, 0, 0
  for k = 1, n do mx, my = mx + X[k] / n, my + Y[k] / n end
  for k = 1, n do sxx, sxy = sxx + (X[k] - mx) ^ 2, sxy + (X[k] - mx) * (Y[k] - my) end
  local b, squares = sxy / sxx, 0
  local a = my - b * mx
  for k = 1, n do squares = squares + (Y[k] - a - b * X[k]) ^ 2 end
  return { a = a, b = b, s = math.sqrt(squares / (n - 2)), va = 1 / n + mx ^ 2 / sxx, vb = 1 / sxx,
    cab = -mx / sxx, squares = squares }
end

describe("study:fit of a line", function()
  local r = regression()

  -- Student's t with 8 degrees of freedom, 97.5 %: 2.306004135 (tables).
  it("estimates sigma from the residuals, with Student's t", function()
    local fit = study(RANGES, line):fit { data = { y = Y } }
    assert.is_true(fit.ok, fit.reason)
    local a, b = fit.parameters.a, fit.parameters.b
    near(r.a, a.value, 1e-8)
    near(r.b, b.value, 1e-8)
    near(r.s, fit.scatter, 1e-7)
    near(r.s * math.sqrt(r.va), a.error, 1e-6)
    near(r.s * math.sqrt(r.vb), b.error, 1e-6)
    near(r.b + 2.306004135 * r.s * math.sqrt(r.vb), b.high, 1e-6)
    near(r.b - 2.306004135 * r.s * math.sqrt(r.vb), b.low, 1e-6)
    near(r.cab / math.sqrt(r.va * r.vb), fit.correlation.a.b, 1e-6)
    assert.equal("estimated", fit.sigma)
    assert.equal(8, fit.freedom)
    assert.is_nil(fit.chance)
    assert.same({}, fit.remarks)
    near(Y[3] - a.value - b.value * X[3], fit.residuals.y[3], 1e-9)
  end)

  -- The normal distribution's 97.5 %: 1.959963985. chi^2 is the sum of squares over sigma^2.
  it("uses a given sigma as it is", function()
    local fit = study(RANGES, line):fit { data = { y = data(Y, 0.1) } }
    near(0.1 * math.sqrt(r.vb), fit.parameters.b.error, 1e-6)
    near(fit.parameters.b.value + 1.959963985 * 0.1 * math.sqrt(r.vb), fit.parameters.b.high, 1e-6)
    near(r.squares / 0.01, fit.chi2, 1e-6)
    assert.equal("given", fit.sigma)
    assert.is_true(fit.chance > 0.01 and fit.chance < 0.99)
  end)

  -- A datum with half the sigma counts as four.
  it("weights each datum by its sigma, or by a weight", function()
    local sigma, weight = {}, {}
    for k = 1, #Y do sigma[k], weight[k] = k <= 3 and 0.05 or 0.1, k <= 3 and 4 or 1 end
    local one = study(RANGES, line):fit { data = { y = data(Y, sigma) } }
    local four = data(Y)
    four.weight = weight
    local two = study(RANGES, line):fit { data = { y = four } }
    near(one.parameters.b.value, two.parameters.b.value, 1e-8)
    assert.is_true(math.abs(one.parameters.b.value / r.b - 1) > 1e-3)
    assert.equal("estimated", two.sigma)
  end)

  it("with as many data as parameters has no error without sigma, and says so", function()
    local three = study({ a = { 0, 1 } }, function(p) return { y = 2 * p.a } end)
    local fit = three:fit { data = { y = 0.6 } }
    near(0.3, fit.parameters.a.value, 1e-9)
    assert.is_nil(fit.parameters.a.low)
    assert.equal("unknown", fit.sigma)
    assert.truthy(fit.remarks[1]:find("leave no residuals to estimate sigma from", 1, true))
    fit = three:fit { data = { y = { 0.6, sigma = 0.02 } } }
    near(0.01, fit.parameters.a.error, 1e-6)
  end)
end)

-- Statistical Reference Datasets of the NIST, Misra1a: certified values and standard deviations.
it("study:fit agrees with certified results of a nonlinear model", function()
  local x = { 77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
    760.0 }
  local y = { 10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
    81.78 }
  local fit = study({ b1 = { 10, 5000, log = true }, b2 = { 1e-6, 1e-1, log = true } }, function(p)
    local out = {}
    for k = 1, #x do out[k] = p.b1 * (1 - math.exp(-p.b2 * x[k])) end
    return { y = out }
  end):fit { data = { y = y }, tolerance = 1e-9 }
  assert.is_true(fit.ok, fit.reason)
  near(2.3894212918e+02, fit.parameters.b1.value, 1e-7)
  near(5.5015643181e-04, fit.parameters.b2.value, 1e-7)
  near(2.7070075241e+00, fit.parameters.b1.error, 1e-5)
  near(7.2668688436e-06, fit.parameters.b2.error, 1e-5)
  near(1.0187876330e-01, fit.scatter, 1e-7)
  assert.is_true(fit.parameters.b1.value - fit.parameters.b1.low
    < fit.parameters.b1.high - fit.parameters.b1.value) -- a factor on a log range, so never below 0
end)

describe("study:fit within ranges", function()
  -- The sum of squares (a + b - 3)^2 + (a - b + 1)^2 is smallest at 1, 2. With b <= 1.5:
  -- d/da [(a - 1.5)^2 + (a - 0.5)^2] = 0 at a = 1.
  it("keeps a parameter at the end of its range, says so, and fits the others", function()
    local fit = study({ a = { 0, 5 }, b = { 0, 1.5 } },
      function(p) return { u = p.a + p.b, v = p.a - p.b } end)
      :fit { data = { u = { 3, sigma = 1 }, v = { -1, sigma = 1 } } }
    assert.is_true(fit.ok, fit.reason)
    assert.equal(1.5, fit.parameters.b.value)
    near(1, fit.parameters.a.value, 1e-7)
    assert.same({ "b" }, fit.at_bound)
    assert.is_nil(fit.parameters.b.low)
    near(math.sqrt(0.5), fit.parameters.a.error, 1e-6)
    assert.truthy(table.concat(fit.remarks, "\n"):find("b is at the end of its range", 1, true))
  end)

  -- It starts at an end beyond which the sum falls at first, but no longer once a has moved.
  it("leaves an end of a range again", function()
    local fit = study({ a = { 0, 5, start = 5 }, b = { 0, 4, start = 0 } },
      function(p) return { u = p.a + p.b, v = p.a - p.b } end)
      :fit { data = { u = { 3, sigma = 1 }, v = { -1, sigma = 1 } } }
    near(1, fit.parameters.a.value, 1e-7)
    near(2, fit.parameters.b.value, 1e-7)
    assert.same({}, fit.at_bound)
  end)

  it("ends where all parameters are at their ends", function()
    local fit = study({ a = { 0, 1 } }, function(p) return { y = p.a } end)
      :fit { data = { y = { 2, sigma = 1 } } }
    assert.same({ "a" }, fit.at_bound)
    assert.equal(1.0, fit.parameters.a.value)
    assert.equal("all parameters are at the ends of their ranges", fit.reason)
  end)

  it("cuts an interval at the end of the range", function()
    local fit = study({ a = { 0, 1 } }, function(p) return { y = p.a } end)
      :fit { data = { y = { 0.9, sigma = 0.1 } } }
    assert.equal(1.0, fit.parameters.a.high)
    near(0.9 - 0.1959963985, fit.parameters.a.low, 1e-6)
    assert.truthy(fit.remarks[1]:find "interval of a reaches an end")
  end)
end)

describe("study:fit with evaluations that fail", function()
  -- exp(3 x) fails from x = 1.9 on; the solution is 1.85. Steps across the border are taken back.
  local function model(p)
    if p.x > 1.9 then error("too much", 0) end
    return { y = { math.exp(3 * p.x), p.x } }
  end

  it("takes failed steps back, and counts them", function()
    local fit = study({ x = { 0, 3, start = 0.2 } }, model):fit {
      data = { y = { math.exp(3 * 1.85), 1.85, sigma = { 1, 0.01 } } } }
    assert.is_true(fit.ok, fit.reason)
    near(1.85, fit.parameters.x.value, 1e-8)
    assert.is_true(fit.failed > 0)
  end)

  it("takes differences on the side that does not fail", function()
    local fit = study({ x = { 0, 3, start = 1.8999 } }, model):fit {
      data = { y = { math.exp(3 * 1.85), 1.85, sigma = { 1, 0.01 } } } }
    near(1.85, fit.parameters.x.value, 1e-8)
    assert.equal(1, fit.failed) -- of the first differences
  end)

  it("says when it cannot continue, with the best result so far", function()
    local only
    local fit = study({ x = { 0, 3, start = 1 } }, function(p)
      if p.x ~= 1 then error("no", 0) end
      return { y = 5 }
    end):fit { data = { y = { 4, sigma = 1 } } }
    only = fit.parameters.x
    assert.is_false(fit.ok)
    assert.equal("all evaluations near the best place failed: no", fit.reason)
    assert.equal(1.0, only.value)
    assert.is_nil(only.low)
  end)

  it("is an error with the first reason when every evaluation fails", function()
    assert.error_matches(function()
      study({ x = { 0, 1 } }, function() error("no luck", 0) end):fit { data = { y = 1 } }
    end, "none of 1 evaluation succeeded; the first: no luck")
  end)

  it("uses another start when the first one fails", function()
    local fit = study({ x = { 0, 3, start = 2.5 } }, model):fit { starts = 3,
      data = { y = { math.exp(3 * 1.85), 1.85, sigma = { 1, 0.01 } } } }
    near(1.85, fit.parameters.x.value, 1e-6)
    assert.equal("its first evaluation failed", fit.starts[1].reason)
  end)
end)

describe("parameters that the data do not determine", function()
  local function found(parameters, model, count)
    local y = { sigma = 0.01 }
    for k = 1, count or 6 do y[k] = 1 + 0.1 * k end
    return study(parameters, function(p)
      local out = {}
      for k = 1, count or 6 do out[k] = model(p, k) end
      return { y = out }
    end):fit { data = { y = y } }
  end
  local EI, weight = { 0.1, 10, log = true }, { 0.5, 5 }

  -- The line 1 + 0.1 k: EI / weight is the slope, known to sigma / sqrt(Sxx) = 0.01 / sqrt(17.5).
  it("are named with the combination that the data determine, and its interval", function()
    local fit = found({ EI = EI, weight = weight, c = { 0, 2 } },
      function(p, k) return p.c + p.EI / p.weight * k end)
    assert.is_true(fit.ok, fit.reason)
    assert.equal(1, #fit.unresolved)
    local told = fit.unresolved[1]
    assert.equal("the data depend on EI and weight only through EI / weight", told.text)
    assert.same({ "EI", "weight" }, told.parameters)
    near(0.1, told.value, 1e-6)
    near(math.exp(1.959963985 * 0.01 / math.sqrt(17.5) / 0.1), told.high / told.value, 1e-4)
    assert.equal(math.huge, fit.parameters.EI.error)
    assert.is_false(fit.parameters.EI.told)
    assert.same({ 0.1, 10.0 }, { fit.parameters.EI.low, fit.parameters.EI.high })
    near(1, fit.parameters.c.value, 1e-6)
    assert.is_nil(fit.correlation.EI.c)
    assert.truthy(tostring(fit):find("EI: not determined by the data", 1, true))
  end)

  it("enter as a product, a power ratio or a difference", function()
    local a, b = { 0.2, 5 }, { 0.5, 2, log = true }
    for text, model in pairs {
      ["the data depend on a and b only through a * b"] = function(p, k) return p.a * p.b * k end,
      ["the data depend on a and b only through a / b^3"] = function(p, k) return p.a / p.b ^ 3 * k end,
      ["the data depend on a and b only through b / a^2"] = function(p, k) return p.b / p.a ^ 2 * k end,
    } do
      assert.equal(text, found({ a = a, b = b }, model).unresolved[1].text)
    end
    local fit = found({ a = { -2, 2 }, b = { -5, 5 } }, function(p, k) return (p.a - 2 * p.b) * k end)
    assert.equal("the data depend on a and b only through a - 2 b", fit.unresolved[1].text)
    near(fit.parameters.a.value - 2 * fit.parameters.b.value, fit.unresolved[1].value, 1e-6)
  end)

  it("include a parameter without effect, and several pairs", function()
    local fit = found({ a = { 0, 2 }, idle = { 1, 2 } }, function(p, k) return p.a * k end)
    assert.equal("the data do not depend on idle", fit.unresolved[1].text)
    assert.equal(1, #fit.unresolved)
    near((21 + 0.1 * 91) / 91, fit.parameters.a.value, 1e-6) -- sum k y / sum k^2
    assert.is_true(fit.parameters.a.error < 0.01)
    fit = found({ a = EI, b = weight, c = { 0.01, 1 }, d = { 0.1, 5 } }, function(p, k)
      return p.a / p.b + p.c * p.d * k
    end)
    local texts = { fit.unresolved[1].text, fit.unresolved[2].text }
    table.sort(texts)
    assert.same({ "the data depend on a and b only through a / b",
      "the data depend on c and d only through c * d" }, texts)
  end)

  it("may be three together, with the way they change", function()
    local fit = found({ a = EI, b = weight, c = { 0.5, 2 } },
      function(p, k) return p.a / (p.b * p.c) * k end)
    assert.equal(2, #fit.unresolved)
    fit = found({ a = { 0.01, 1 }, b = weight, c = { 0.1, 10 } }, function(p, k)
      return p.a * p.b * k + p.b * p.c
    end)
    local text = fit.unresolved[1].text
    local sign = { ["+"] = text:find "a by %+" and "+" or "-", ["-"] = text:find "a by %+" and "-" or "+" }
    assert.equal("the data do not distinguish a, b, c: changing a by +1 %, b by -1 %, c by +1 % together "
      .. "changes no result", (text:gsub("[+-]", sign)))
  end)

  it("do not include those that are only poorly known", function()
    local fit = found({ a = { -20, 20 }, b = { 0, 20 } },
      function(p, k) return p.a + p.b * (1 + 0.01 * k) end)
    assert.same({}, fit.unresolved)
    assert.truthy(table.concat(fit.remarks, "\n"):find("the data hardly distinguish a and b", 1, true))
  end)

  -- Columns (1, 1, 0) and (1, 1, 1e-2), scaled to unit length: one minus their cosine is 2.5e-5.
  it("are found from the singular values: the covariance is that of the inverse", function()
    local C, lost = fitlinear.covariance { { 1, 1, 0 }, { 1, 1, 1e-2 } }
    assert.same({}, lost)
    near((2 + 1e-4) / 2e-4, C[1][1], 1e-8) -- det of J'J = 2 * 1e-4
    near(1e4, C[2][2], 1e-8)
    C, lost = fitlinear.covariance { { 1, 1, 0 }, { 1, 1, 1e-5 } }
    assert.equal(1, #lost)
    near(0.125, C[1][1], 1e-4) -- J'J has the eigenvalue 4 along (1, 1): (1 / 2) / 4
  end)
end)

-- Two data are off by 50 sigma: least squares follow them, the soft loss does not.
it("study:fit with a soft loss leaves outliers alone", function()
  local y = { sigma = 0.05 }
  for k, x in ipairs(X) do y[k] = 1 + 1.5 * x + 0.05 * ((k % 3) - 1) end
  y[4], y[9] = y[4] + 2.5, y[9] - 2.5
  local hard = study(RANGES, line):fit { data = { y = y } }
  local soft = study(RANGES, line):fit { data = { y = y }, loss = "soft" }
  assert.is_true(math.abs(hard.parameters.b.value - 1.5) > 0.2)
  assert.is_true(soft.ok, soft.reason)
  assert.is_true(math.abs(soft.parameters.b.value - 1.5) < 0.05, soft.parameters.b.value)
  assert.is_true(soft.parameters.b.low < 1.5 and soft.parameters.b.high > 1.5)
  assert.truthy(table.concat(soft.remarks, "\n"):find "2 of 10 data are more than 3 sigma from the model")
end)

-- One datum in ten is off by eight times the sigma. The intervals of the soft loss should contain the slope
-- in 190 +- 3.1 of 200 cases; fewer than 178 have a chance of 3e-4.
it("intervals with a soft loss contain the true value despite outliers", function()
  math.randomseed(9)
  local held = 0
  for _ = 1, 200 do
    local y = { sigma = 0.1 }
    for k = 1, 20 do
      local normal = math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
      y[k] = 1 + 0.3 * k + 0.1 * normal * (math.random() < 0.1 and 8 or 1)
    end
    local b = study({ a = { -5, 5 }, b = { -2, 2 } }, function(p)
      local out = {}
      for k = 1, 20 do out[k] = p.a + p.b * k end
      return { y = out }
    end):fit { data = { y = y }, loss = "soft" }.parameters.b
    if b.low <= 0.3 and 0.3 <= b.high then held = held + 1 end
  end
  assert.is_true(held >= 178, held)
end)

-- sin(w t) has many local minima along w; only a start near the right one finds it.
it("study:fit from several starts finds the lowest minimum", function()
  local y = { sigma = 0.01 }
  for k = 1, 30 do y[k] = math.sin(7.3 * k / 10) end
  local waves = study({ w = { 0.5, 15, start = 1 } }, function(p)
    local out = {}
    for k = 1, 30 do out[k] = math.sin(p.w * k / 10) end
    return { y = out }
  end)
  local one, many = waves:fit { data = { y = y } }, waves:fit { data = { y = y }, starts = 12 }
  assert.is_true(math.abs(one.parameters.w.value - 7.3) > 0.1)
  near(7.3, many.parameters.w.value, 1e-6)
  assert.equal(12, #many.starts)
end)

-- 300 noisy lines: the 95 % interval of each parameter should contain the true value in 285 +- 3.8 of them.
-- Fewer than 270 or more than 298 have a chance of 2e-4 (binomial).
it("95 % intervals contain the true value in 95 % of cases", function()
  math.randomseed(5)
  local function normal()
    return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
  end
  for _, known in ipairs { true, false } do
    local held = { a = 0, k = 0 }
    for _ = 1, 300 do
      local y = { sigma = known and 0.05 or nil }
      for i = 1, 8 do y[i] = 2 * math.exp(-0.5 * i / 2) + 0.05 * normal() end
      local fit = study({ a = { 0.1, 20, log = true, start = 1 }, k = { 0.05, 5, log = true } }, function(p)
        local out = {}
        for i = 1, 8 do out[i] = p.a * math.exp(-p.k * i / 2) end
        return { y = out }
      end):fit { data = { y = y } }
      for name, truth in pairs { a = 2, k = 0.5 } do
        local q = fit.parameters[name]
        if q.low <= truth and truth <= q.high then held[name] = held[name] + 1 end
      end
    end
    for name, count in pairs(held) do
      assert.is_true(count >= 270 and count <= 298, ("%s: %d of 300"):format(name, count))
    end
  end
end)
