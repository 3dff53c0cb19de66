-- SPDX-License-Identifier: GPL-3.0-or-later
-- study:fit: residuals that are not noise, its evaluations, refused arguments.
local straight = require "spec.study.lines"
local program = require "host.program"
local fitnoise = require "softworld.study.fitnoise"

local study, near, Y, line, RANGES, data = straight.study, straight.near, straight.Y, straight.line,
  straight.RANGES, straight.data

describe("residuals that are not noise", function()
  it("are reported from their sum when sigma is given", function()
    local few = study(RANGES, line):fit { data = { y = data(Y, 0.01) } }
    assert.truthy(few.remarks[1]:find("times as large as sigma", 1, true), few.remarks[1])
    assert.is_true(few.chance < 1e-6)
    local many = study(RANGES, line):fit { data = { y = data(Y, 1) } }
    assert.truthy(many.remarks[1]:find("sigma is too large", 1, true), many.remarks[1])
  end)

  -- A parabola fitted by a line: signs + - +, two changes in 20.
  it("are reported from their signs", function()
    local y = {}
    for k = 1, 20 do y[k] = k + 0.01 * (k - 10) ^ 2 end
    local fit = study(RANGES, function(p)
      local out = {}
      for k = 1, 20 do out[k] = p.a + p.b * k end
      return { y = out }
    end):fit { data = { y = y } }
    assert.truthy(fit.remarks[1]:find("residuals of y are not random: they change sign 2 times in 20", 1,
      true))
  end)

  -- All orders of 3 and 4 signs, counted.
  it("have a chance that equals the share of all orders of signs", function()
    local counts, all = {}, 0
    for bits = 0, 127 do
      local ones, runs, last = 0, 0, nil
      for k = 0, 6 do
        local bit = bits >> k & 1
        ones, runs, last = ones + bit, runs + (bit ~= last and 1 or 0), bit
      end
      if ones == 3 then counts[runs], all = (counts[runs] or 0) + 1, all + 1 end
    end
    local sum = 0
    for runs = 2, 7 do
      sum = sum + counts[runs] / all
      near(sum, fitnoise.runs_chance(3, 4, runs), 1e-12)
      near(sum, fitnoise.runs_chance(4, 3, runs), 1e-12)
    end
  end)
end)

describe("a fit's evaluations", function()
  teardown(program.clean)
  local function decay(p)
    if p.a + p.k > 3.6 then error("beyond", 0) end
    local out = {}
    for i = 1, 6 do out[i] = p.a * math.exp(-p.k * i) end
    return { y = out }
  end
  local DATA = { y = { 1.5, 1.1, 0.85, 0.6, 0.47, 0.33, sigma = 0.02 } }
  local function text(s, fit)
    local lines = { ("%a %a %a"):format(fit.parameters.a.value, fit.parameters.k.low, fit.chi2) }
    for _, row in ipairs(s:table()) do
      lines[#lines + 1] = ("%d %a %a %s %s"):format(row.number, row.a, row.k, row.failed or "",
        row.y_6 and ("%a"):format(row.y_6) or "")
    end
    return table.concat(lines, "\n")
  end
  local function make(more)
    return study({ a = { 0.1, 5, start = 3 }, k = { 0.01, 3, start = 0.5 } }, decay, more)
  end

  it("give the same bits for any number of workers", function()
    local first
    for _, workers in ipairs { 0, 1, 2, 7 } do
      local s = make { workers = workers }
      local fit = s:fit { data = DATA, starts = 3 }
      assert.is_true(fit.failed > 0 and fit.ok)
      first = first or text(s, fit)
      assert.equal(first, text(s, fit))
    end
  end)

  it("are taken from the journal, complete or cut off", function()
    local path = program.folder() .. "/fit.study"
    local s = make { file = path, workers = 2 }
    local whole = text(s, s:fit { data = DATA, starts = 2 })
    local all = s.computed
    local file = assert(io.open(path, "rb"))
    local content = file:read "a"
    file:close()
    s = make { file = path }
    assert.equal(whole, text(s, s:fit { data = DATA, starts = 2 }))
    assert.equal(0, s.computed)
    for _, share in ipairs { 0.3, 0.77 } do
      file = assert(io.open(path, "wb"))
      file:write(content:sub(1, #content * share // 1))
      file:close()
      s = make { file = path, workers = 2 }
      assert.equal(whole, text(s, s:fit { data = DATA, starts = 2 }))
      assert.is_true(s.computed > 0 and s.computed < all)
    end
  end)

  -- Without workers Ctrl-C interrupts an evaluation: this ends the fit and is not a failure of the model.
  it("end with Ctrl-C, also in this process", function()
    local _, err, code = program.script([[
local sw = require "softworld"
sw.study { name = "slow", workers = 0, parameters = { a = { 0, 1 } }, evaluate = function(p)
  local clock = os.clock()
  while os.clock() - clock < 0.1 do end
  return { y = { p.a, p.a ^ 2 } }
end }:fit { data = { y = { 0.3, 0.2 } }, starts = 1000 }]], {},
      { before = "env --default-signal=INT", signals = { 0.7 } })
    assert.equal(130, code, err)
    assert.truthy(err:find("study 'slow' was interrupted; so far:", 1, true), err)
  end)

  it("are at most as many as allowed, and the fit says so", function()
    local s = make()
    local fit = s:fit { data = DATA, evaluations = 9 }
    assert.is_false(fit.ok)
    assert.equal("evaluations used up", fit.reason)
    assert.is_true(fit.evaluations <= 9)
    assert.truthy(tostring(fit):find("the search did not converge: these are the best values so far", 1,
      true))
  end)
end)

describe("study:fit refuses", function()
  local function of(d, more)
    return function()
      local args = { data = d }
      for key, value in pairs(more or {}) do args[key] = value end
      study(RANGES, line):fit(args)
    end
  end
  local NAN = 0 / 0
  for text, case in pairs {
    ["data is required"] = of(nil),
    ["data is empty"] = of {},
    ["data.y must be a number, or a list of numbers with sigma = and unit =, got 'x'"] = of { y = "x" },
    ["data.y has no number"] = of { y = {} },
    ["data.y[2]"] = of { y = { 1, NAN } },
    ["data.y: there is no sigm; did you mean 'sigma'?"] = of { y = { 1, 2, sigm = 1 } },
    ["data.y: sigma = 0 is not allowed"] = of { y = { 1, 2, sigma = 0 } },
    ["data.y: sigma = 1e-160 N is not allowed; it must be at least 1e-60 N and at most 1e+60 N"]
      = of { y = { 1, 2, sigma = 1e-160, unit = "N" } },
    ["data.y: sigma = 1e+160 is not allowed; it must be at least 1e-60 and at most 1e+60"]
      = of { y = { 1, 2, sigma = { 1, 1e160 } } },
    ["data.y[2] = 1e+160 N is too large; at most 1e+140 times its sigma of 2 N"]
      = of { y = { 1, 1e160, sigma = 2, unit = "N" } },
    ["data.y[1] = -1e+200 is too large; at most 1e+140"] = of { y = -1e200 },
    ["data.y: weight = 1e-200 is not allowed; it must be 0, or a number from 1e-120 to 1e+120"]
      = of { y = { 1, 2, weight = 1e-200 } },
    ["data.y: sigma must have one number per datum, 2 in all, got 1"] = of { y = { 1, 2, sigma = { 1 } } },
    ["data.y: give sigma or weight, not both"] = of { y = { 1, 2, sigma = 1, weight = 1 } },
    ["data.y: unit = 'mm' is none of the SI"] = of { y = { 1, 2, unit = "mm" } },
    ["data.a is a parameter"] = of { a = 1 },
    ["data.y has a sigma and data.z has none"] = of { y = { 1, sigma = 1 }, z = 2 },
    ["data.y and data.z need a sigma each"] = of { y = 1, z = 2 },
    ["1 datum cannot determine 2 parameters"] = of { y = 1 },
    ["evaluate returns no 'force'; it returns: y"] = of { force = { 1, 2 } },
    ["data.y has 3 numbers, and evaluate returned 10"] = of { y = { 1, 2, 3 } },
    ["data.y has 11 numbers, and evaluate returned 10"] = of { y = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 } },
    ["loss = 'soft' needs the sigma"] = of({ y = Y }, { loss = "soft" }),
    ["starts = 0 is not allowed"] = of({ y = Y }, { starts = 0 }),
    ["step = 0 is not allowed"] = of({ y = Y }, { step = 0 }),
    ["did you mean 'data'?"] = of(nil, { dta = 1 }),
  } do
    it(text, function()
      local fine, why = pcall(case)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(text, 1, true), why)
      assert.truthy(tostring(why):find("fit_told_spec.lua:", 1, true), "no line: " .. tostring(why))
    end)
  end

  it("no small sigma of the range: errors are in proportion to it, the correlation stays", function()
    local function fitted(sigma) return study(RANGES, line):fit { data = { y = data(Y, sigma) } } end
    local usual = fitted(0.1)
    for _, sigma in ipairs { 1e-60, 1e-30 } do
      local fit = fitted(sigma)
      near(usual.best.a, fit.best.a, 1e-6)
      near(usual.parameters.a.error * 10, fit.parameters.a.error / sigma, 1e-4)
      near(usual.chi2 / 100, fit.chi2 * sigma ^ 2, 1e-6)
      near(usual.correlation.a.b, fit.correlation.a.b, 1e-4)
    end
  end)

  it("no data that dwarf the model, but tells of them", function()
    local s = study({ x = { 1, 2 } }, function(p) return { y = p.x, z = 1 } end)
    local fit = s:fit { data = { y = { 1e20, sigma = 1 }, z = { 1, sigma = 0.1 } } }
    local told = "data.y has 1e+20 where evaluate gives 1.5, which is lost in rounding; is its unit right?"
    assert.truthy(table.concat(fit.remarks, "\n"):find(told, 1, true), table.concat(fit.remarks, "\n"))
    fit = s:fit { data = { y = { 1.25, sigma = 1e-3 }, z = { 1.1, sigma = 0.1 } } }
    assert.same({}, fit.remarks)
  end)

  it("integers and choices", function()
    for _, p in ipairs { { 1, 5, integer = true }, { choices = { "a", "b" } } } do
      assert.error_matches(function()
        study({ n = p }, function() return { y = 1 } end):fit { data = { y = 1 } }
      end, "least squares need numbers")
    end
  end)

  it("results that are not lists of numbers", function()
    for _, case in ipairs { { {}, "an empty table" }, { { a = 1 }, "a table that is not a list" },
      { { 1, "x" }, "returned y_2 = 'x'" }, { { 1, { 2 } }, "returned y_2 = a table" } } do
      local fine, why = pcall(function()
        study(RANGES, function() return { y = case[1] } end):fit { data = { y = { 1, 2 } } }
      end)
      assert.is_false(fine)
      assert.truthy(why:find(case[2], 1, true), why)
    end
    assert.error_matches(function()
      study(RANGES, function() return { y = { 1, 2 }, y_2 = 5 } end):fit { data = { y = { 1, 2 } } }
    end, "returned 'y_2' twice")
  end)
end)
