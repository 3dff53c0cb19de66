-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sweeps, searches and spreads: known points, known minima, known probabilities.
local sw = require "softworld"
local core = require "softworld.core"
local program = require "host.program"
local csv = require "softworld.csv"
local jsonread = require "softworld.output.jsonread"
local spread = require "softworld.study.spread"

local function study(parameters, evaluate, constraints)
  return sw.study { name = "s", parameters = parameters, evaluate = evaluate, constraints = constraints,
    workers = 2 }
end

local function column(rows, name)
  local list = {}
  for i, row in ipairs(rows) do list[i] = row[name] end
  return list
end

local function nothing() return { y = 1 } end

describe("study:sweep", function()
  it("covers a grid with both ends, the last parameter first", function()
    local s = study({ a = { 1, 100, log = true }, b = { 0, 1 } }, nothing)
    local rows = s:sweep { grid = { a = 3, b = 2 } }
    assert.same({ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }, column(rows, "b"))
    for i, a in ipairs { 1, 1, 10, 10, 100, 100 } do assert.is_true(math.abs(rows[i].a / a - 1) < 1e-14) end
    assert.equal(100.0, rows[6].a) -- exactly the end, without the rounding of exp and log
    assert.equal(25, #s:sweep { kind = "grid", count = 30 })
    assert.equal(0.5, s:sweep { grid = { a = 1, b = 1 } }[1].b)
  end)

  it("takes its kind as method too, for the same points", function()
    local s = study({ a = { 0, 1 }, b = { 0, 1 } }, nothing)
    local rows, others = s:sweep { kind = "halton", count = 5 }, s:sweep { method = "halton", count = 5 }
    assert.same(column(rows, "a"), column(others, "a"))
    assert.error_matches(function() s:sweep { kind = "halton", method = "latin", count = 5 } end,
      "give kind = 'halton' or method = 'latin', not both")
  end)

  it("gives rows whose print is a table", function()
    local s = study({ a = { 1, 3, integer = true } }, function(p)
      if p.a == 2 then error "no two" end
      return { y = p.a / 3 }
    end)
    local text = tostring(s:sweep { grid = 3 })
    assert.matches("^number  a  y         failed\n1       1  0.333333\n2       2 .*no two\n3       3  1$",
      text)
    s = study({ a = { 0, 1 } }, nothing)
    text = tostring(s:sweep { count = 30 })
    assert.matches("\n... 30 rows; study:csv%(path%) writes all$", text)
    assert.equal(21, select(2, text:gsub("\n", "")))
    assert.is_nil(text:find "failed")
  end)

  it("takes all choices and integers on a grid, each once", function()
    local s = study({ n = { 2, 5, integer = true }, c = { choices = { "x", true, 3 } } }, nothing)
    local rows = s:sweep { grid = 10 }
    assert.equal(12, #rows)
    assert.same({ 2, 3, 4, 5, 2, 3, 4, 5, 2, 3, 4, 5 }, column(rows, "n"))
    assert.equal("integer", math.type(rows[1].n))
    assert.same({ "x", true, 3 }, { rows[1].c, rows[5].c, rows[9].c })
    assert.same({ 2, 4, 5 }, column(s:sweep { grid = { n = 3, c = 1 } }, "n")) -- 2, 3.5 rounded up, 5
  end)

  it("gives evaluate values of the parameter's type", function()
    local ranges = { n = { 2, 5, integer = true }, c = { choices = { "x", true, 3 } }, a = { 1, 2 } }
    local s = study(ranges, function(p)
      return { whole = math.type(p.n) == "integer", float = math.type(p.a) == "float",
        fine = p.c == "x" or p.c == true or p.c == 3 }
    end)
    for _, row in ipairs(s:sweep { count = 30 }) do
      assert.same({ 1.0, 1.0, 1.0 }, { row.whole, row.float, row.fine })
    end
  end)

  -- If each range is cut into count equal parts, each part has one point.
  it("fills the ranges by a Latin hypercube", function()
    local rows = study({ a = { 0, 1 }, b = { 5, 10 } }, nothing):sweep { kind = "latin", count = 40 }
    for name, range in pairs { a = { 0, 1 }, b = { 5, 5 } } do
      local met = {}
      for _, row in ipairs(rows) do
        local k = math.floor((row[name] - range[1]) / range[2] * 40)
        assert.is_nil(met[k])
        met[k] = true
      end
    end
  end)

  -- Halton: the digits of the number in bases 2 and 3, mirrored at the point. Sobol: any 2^k consecutive
  -- points put one into each of 2^k equal parts (except the first point, which GSL leaves out).
  it("fills the ranges by the sequences of Halton and Sobol", function()
    local s = study({ a = { 0, 1 }, b = { 0, 1 } }, nothing)
    local rows = s:sweep { kind = "halton", count = 6 }
    for i, a in ipairs { 1 / 2, 1 / 4, 3 / 4, 1 / 8, 5 / 8, 3 / 8 } do
      assert.is_true(math.abs(rows[i].a - a) < 1e-15)
    end
    for i, b in ipairs { 1 / 3, 2 / 3, 1 / 9, 4 / 9, 7 / 9, 2 / 9 } do
      assert.is_true(math.abs(rows[i].b - b) < 1e-15)
    end
    rows = s:sweep { kind = "sobol", count = 63 }
    for _, name in ipairs { "a", "b" } do
      local met = { [0] = true } -- the point at 0
      for _, row in ipairs(rows) do
        local k = math.floor(row[name] * 64)
        assert.is_nil(met[k])
        met[k] = true
      end
    end
  end)

  it("says how many parameters a sequence can have", function()
    local many = {}
    for i = 1, 41 do many["p" .. i] = { 0, 1 } end
    local s = study(many, nothing)
    assert.error_matches(function() s:sweep { count = 3 } end,
      "kind = 'sobol' is for 1 to 40 parameters, not 41")
    assert.equal(3, #s:sweep { kind = "halton", count = 3 })
  end)
end)

describe("study:minimise", function()
  local function rosenbrock(p) return { y = 100 * (p.b - p.a ^ 2) ^ 2 + (1 - p.a) ^ 2, a2 = p.a } end
  local RANGES = { a = { -2, 2 }, b = { -1, 3 } }

  it("finds a known minimum", function()
    local found = study(RANGES, rosenbrock):minimise("y", { tolerance = 1e-6, evaluations = 2000 })
    assert.is_true(found.ok, found.reason)
    assert.is_true(math.abs(found.best.a - 1) < 1e-4 and math.abs(found.best.b - 1) < 2e-4)
    assert.equal(found.best.y, found.value)
    assert.equal(4, #found.starts)
    assert.same({}, found.at_bound)
  end)

  -- (a - 1)^2 with the constraint a <= 0.8 and b = a^2: 0.04.
  it("finds the minimum on a constraint", function()
    local s = study(RANGES, rosenbrock, { a2 = { max = 0.8 } })
    local found = s:minimise("y", { tolerance = 1e-6, evaluations = 4000 })
    assert.is_true(found.best.a <= 0.8 and math.abs(found.value - 0.04) < 2e-3, found.value)
    assert.equal(found.value, s:best "y".y)
    assert.is_true(found.best.pass)
  end)

  it("finds the minimum at the end of a range, and says so", function()
    local found = study({ x = { 1, 3 }, y = { 0.1, 10, log = true } }, function(p)
      return { v = p.x + math.log(p.y / 2) ^ 2 }
    end):minimise "v"
    assert.is_true(found.best.x < 1.002 and math.abs(found.best.y - 2) < 0.02)
    assert.same({ "x" }, found.at_bound)
  end)

  -- One of 10 evaluations fails, and all in one corner. A search that took them for numbers would get lost.
  it("finds the minimum although evaluations fail", function()
    local s = study({ a = { -2, 2 }, b = { -2, 2 } }, function(p)
      if p.random() < 0.1 then return { y = 0 / 0 } end
      if p.a < 0 and p.b < 0 then error "corner" end
      return { y = (p.a - 0.5) ^ 2 + (p.b + 0.25) ^ 2 }
    end)
    local found = s:minimise("y", { evaluations = 600 })
    assert.is_true(found.failed > 10)
    assert.is_true(math.abs(found.best.a - 0.5) < 0.02 and math.abs(found.best.b + 0.25) < 0.02,
      tostring(found))
  end)

  it("finds the lower of two valleys by several starts", function()
    local s = study({ x = { -3, 3, start = 1.2 } },
      function(p) return { y = (p.x ^ 2 - 1) ^ 2 + p.x / 5 } end)
    assert.is_true(s:minimise("y", { starts = 1 }).best.x > 0)
    assert.is_true(s:minimise("y", { starts = 4 }).best.x < 0)
  end)

  it("can minimise a parameter", function()
    local s = study({ x = { 0, 1 } }, function(p) return { held = p.x > 0.25 } end, { held = { min = 1 } })
    local found = s:minimise("x", { tolerance = 1e-4 })
    -- the last simplex is as small as the tolerance; its other end may be a few times as far
    assert.is_true(found.value > 0.25 and found.value < 0.251, found.value)
    assert.equal(found.best.x, found.value)
  end)

  it("keeps integers whole, and ends when its evaluations are used up", function()
    local s = study({ n = { 1, 50, integer = true } }, function(p) return { y = (p.n - 17) ^ 2 } end)
    assert.equal(17, s:minimise "y".best.n)
    local found = s:minimise("y", { evaluations = 8 })
    assert.equal("evaluations used up", found.reason)
    assert.is_false(found.ok)
    assert.equal(8, found.evaluations)
  end)
end)

describe("study:spread", function()
  -- x is uniform in (0, 1): 30 % are below 0.3.
  it("gives a known probability, with an interval that contains it", function()
    local s = study({ x = { 0, 1 } }, function(p) return { y = p.x } end, { y = { max = 0.3 } })
    local found = s:spread { count = 2000 }
    assert.is_true(found.low < 0.3 and 0.3 < found.high, tostring(found))
    assert.is_true(found.high - found.low < 0.05)
    assert.equal(found.passed / 2000, found.probability)
    assert.equal(5, #found.worst)
    assert.is_true(found.worst[1].y > 0.99 and found.worst[1].y >= found.worst[5].y)
    assert.is_false(found.worst[1].pass)
  end)

  -- Normal about 2 with sigma 0.5, cut at 4 sigma: 84.13 % are below 2.5.
  it("draws from a normal distribution where sigma is given, and uniformly in the logarithm of a log "
    .. "range", function()
    local s = study({ x = { 0, 4, start = 2, sigma = 0.5 }, z = { 1, 100, log = true } },
      function(p) return { x1 = p.x, z1 = p.z } end, { x1 = { max = 2.5 } })
    local found = s:spread { count = 2000 }
    assert.is_true(found.low < 0.8413 and 0.8413 < found.high, tostring(found))
    local below = 0
    for _, row in ipairs(s:table()) do below = below + (row.z < 10 and 1 or 0) end
    local low, high = spread.wilson(below, 2000)
    assert.is_true(low < 0.5 and 0.5 < high)
  end)

  -- Wilson 1927, the formula evaluated by hand: 8 of 10 pass.
  it("gives Wilson's interval", function()
    local low, high = spread.wilson(8, 10)
    assert.is_true(math.abs(low - 0.490162) < 1e-6 and math.abs(high - 0.943318) < 1e-6)
    low, high = spread.wilson(0, 10)
    assert.is_true(low == 0 and math.abs(high - 0.2775328) < 1e-6)
    low, high = spread.wilson(10, 10)
    assert.is_true(high == 1 and math.abs(low - 0.7224672) < 1e-6)
  end)

  -- Normal about 2 with sigma 0.5, cut at 4 sigma, plus a uniform variable: P(x + y <= 3) = P((x - 2) + y <=
  -- 1), the mean of Phi((1 - y) / 0.5) over y: the integral of Phi(2 t) from 0 to 1 = Phi(2) - (phi(0) -
  -- phi(2)) / 2.
  it("fills the ranges by Sobol's sequence, with a narrower interval that contains the "
    .. "probability", function()
    local phi = function(t) return math.exp(-t * t / 2) / math.sqrt(2 * math.pi) end
    local expected, held, width = core.normal_below(2) - (phi(0) - phi(2)) / 2, 0, { random = 0, sobol = 0 }
    for seed = 1, 20 do
      for kind in pairs(width) do
        local s = sw.study { name = "s", seed = seed, workers = 0, constraints = { v = { max = 3 } },
          parameters = { x = { 0, 4, start = 2, sigma = 0.5 }, y = { 0, 1 } },
          evaluate = function(p) return { v = p.x + p.y } end }
        local found = s:spread { count = 512, kind = kind }
        width[kind] = width[kind] + found.high - found.low
        if kind == "sobol" and found.low <= expected and expected <= found.high then held = held + 1 end
      end
    end
    assert.is_true(held >= 16, held) -- of 20 at 95 %: fewer than 16 have a chance of 1 in 3000
    assert.is_true(width.sobol < 0.75 * width.random, width.sobol / width.random)
  end)

  it("repeats Sobol's points when more are wanted, and gives Wilson's interval where all pass", function()
    local function rows(count)
      local s = study({ x = { 0, 1 }, n = { 1, 3, integer = true } }, nothing, { y = { max = 2 } })
      return s:spread { count = count, kind = "sobol" }, s:table()
    end
    local _, few = rows(20)
    local found, many = rows(50)
    for k, row in ipairs(few) do assert.same({ row.x, row.n }, { many[k].x, many[k].n }) end
    local low, high = spread.wilson(50, 50)
    assert.same({ low, high }, { found.low, found.high })
    assert.error_matches(function()
      study({ x = { 0, 1 } }, nothing, { y = { max = 2 } }):spread { kind = "sobl" }
    end, "did you mean 'sobol'?")
  end)

  -- Tables: 97.5 % lie below 1.959963984540054.
  it("uses the normal distribution", function()
    assert.is_true(math.abs(core.normal_below(1.959963984540054) - 0.975) < 1e-14)
    assert.is_true(math.abs(core.normal_at(0.025) + 1.959963984540054) < 1e-13)
    assert.error_matches(function() core.normal_at(1) end, "between 0 and 1")
  end)

  it("counts failed evaluations as not passed", function()
    local s = study({ x = { 0, 1 } }, function(p)
      if p.number % 4 == 0 then error "lost" end
      return { y = p.x }
    end, { y = { max = 2 } })
    local found = s:spread { count = 100 }
    assert.same({ 75, 25, 0, 0.75 }, { found.passed, found.failed, found.broken, found.probability })
  end)
end)

describe("the output of a study", function()
  teardown(program.clean)

  local function made()
    local s = sw.study { name = "shown", workers = 2, seed = 4,
      parameters = { force = { 1, 10, unit = "N", log = true }, model = { choices = { "a", "b, c" } } },
      evaluate = function(p)
        if p.number == 3 then error("lost, \"again\"", 0) end
        return { time = 1 / p.force, ok = p.force < 5 }
      end, constraints = { ok = { min = 1 }, time = { max = 0.9, unit = "s" } } }
    s:sweep { count = 12 }
    return s
  end

  it("is written as CSV and JSON, with all bits", function()
    local s, folder = made(), program.folder()
    local rows = s:table()
    assert.equal(folder .. "/t.csv", s:csv(folder .. "/t.csv"))
    local data = csv.parse(program.read(folder .. "/t.csv"):gsub(",,", ",0,"):gsub(",,", ",0,"), "t",
      { text = { model = true, failed = true } })
    assert.same({ "part", "number", "force", "model", "ok", "time", "pass", "failed" }, data.names)
    assert.equal(12, data.count)
    for i, row in ipairs(rows) do
      assert.equal(row.force, data.columns.force[i])
      assert.equal(row.model, data.columns.model[i])
      if not row.failed then
        assert.equal(row.time, data.columns.time[i])
        assert.equal(row.pass and 1 or 0, data.columns.pass[i])
      end
    end
    assert.equal('lost, "again"', data.columns.failed[3])
    s:json(folder .. "/t.json")
    local read = jsonread.decode(program.read(folder .. "/t.json"))
    assert.equal("shown", read.name)
    assert.equal(4, read.seed)
    assert.equal("N", read.parameters[1].unit)
    assert.equal(rows[2].time, read.rows[2].time)
    assert.equal('lost, "again"', read.rows[3].failed)
  end)

  it("is printed with parameters, evaluations and failures", function()
    local text = tostring(made())
    for _, words in ipairs { "study 'shown': 12 evaluations", "force: 1 to 10 N, log", 'model: "a" | "b, c"',
      "1. sweep: 12 evaluations, 1 failed", '1 failed (first 1.3): lost, "again"' } do
      assert.truthy(text:find(words, 1, true), text)
    end
  end)

  it("is drawn with different marks for rows that meet the constraints", function()
    local s, folder = made(), program.folder()
    assert.equal(folder .. "/c.svg", s:chart { x = "force", y = "time", path = folder .. "/c.svg" })
    local svg = program.read(folder .. "/c.svg")
    for _, words in ipairs { "force [N]", "time [s]", "meets the constraints", "breaks constraints",
      "shown" } do
      assert.truthy(svg:find(words, 1, true), words)
    end
    assert.error_matches(function() s:chart { x = "model", y = "time" } end, "x = 'model' has choices")
  end)

  it("accepts a value of the catalogue with its bounds", function()
    local friction = { value = 0.4, low = 0.15, high = 0.8, flag = "guessed" }
    local s = study({ friction = friction }, nothing)
    assert.truthy(tostring(s):find("friction: 0.15 to 0.8, start 0.4", 1, true))
  end)
end)
