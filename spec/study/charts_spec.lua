-- SPDX-License-Identifier: GPL-3.0-or-later
-- Which parameter matters most, and the charts of a study.
local sw = require "softworld"
local program = require "host.program"
local chart = require "softworld.study.chart"

local function study(parameters, evaluate, constraints)
  return sw.study { name = "shown", parameters = parameters, evaluate = evaluate, constraints = constraints,
    workers = 0 }
end

local function by_name(list)
  local by = {}
  for _, m in ipairs(list) do by[m.name] = m end
  return by
end

local function near(expected, m)
  assert.is_true(math.abs(m.share - expected) < 4 * m.error + 0.003, ("%s: %g +- %g, not %g"):format(m.name,
    m.share, m.error, expected))
end

local function anything() return { any = 1 } end

describe("the influence of parameters", function()
  local ANY = { y = { max = 1e9 } }

  -- 4 a + 2 b - c, uniform over equal ranges: the variances are 16 : 4 : 1.
  it("is found for a sum", function()
    local s = study({ a = { 0, 1 }, b = { 0, 1 }, c = { 0, 1 } }, function(p)
      return { y = 4 * p.a + 2 * p.b - p.c }
    end, ANY)
    local found = s:spread { count = 2000 }
    local list = found.matters.y
    assert.equal("a", list[1].name)
    local by = by_name(list)
    near(16 / 21, by.a)
    near(4 / 21, by.b)
    near(1 / 21, by.c)
    assert.is_true(by.a.rank > 0.8 and by.c.rank < -0.1)
    assert.is_true(by.a.error < 0.05)
    -- the fifths at the ends of a have means of 4 * 0.1 and 4 * 0.9; b and c are 0.5 on average and add 0.5
    assert.is_true(math.abs(by.a.low - 0.9) < 0.12 and math.abs(by.a.high - 4.1) < 0.12)
    assert.truthy(tostring(found):find("y depends on a %(7%d %+%- %d %%, rising%)"), tostring(found))
    assert.is_nil(found.matters.pass) -- it does not vary
  end)

  -- T. Ishigami, T. Homma 1990: sin x + 7 sin^2 y + 0.1 z^4 sin x in +- pi: shares 0.3139, 0.4424 and 0 (z
  -- matters only together with x).
  it("is found for functions that rise and fall", function()
    local pi = math.pi
    local s = study({ x = { -pi, pi }, y = { -pi, pi }, z = { -pi, pi } }, function(p)
      return { f = math.sin(p.x) + 7 * math.sin(p.y) ^ 2 + 0.1 * p.z ^ 4 * math.sin(p.x) }
    end, { f = { max = 1e9 } })
    local by = by_name(s:spread { count = 4000 }.matters.f)
    near(0.3139, by.x)
    near(0.4424, by.y)
    near(0, by.z)
  end)

  -- A choice that shifts by 2 and a uniform variable of width sqrt(12): variances 1 and 1.
  it("is found for choices, and for the share that passes", function()
    local s = study({ c = { choices = { "x", "y" } }, u = { 0, math.sqrt(12) } }, function(p)
      return { y = p.u + (p.c == "x" and 2 or 0), any = p.random() }
    end, { y = { max = 2.5 } })
    local found = s:spread { count = 2000 }
    local by = by_name(found.matters.y)
    near(0.5, by.c)
    near(0.5, by.u)
    assert.is_nil(by.c.rank)
    assert.is_true(found.matters.pass[1].share > 0.2)
    assert.truthy(tostring(found):find("any depends on no parameter alone", 1, true))
  end)

  -- A single parameter has the whole influence, also with few evaluations and with values near the limits of
  -- floating point.
  it("is complete for a single parameter", function()
    for _, size in ipairs { 1, 1e300, 1e-310 } do
      local limit = { y = { max = 1e308 } }
      local s = study({ a = { 0, 4 } }, function(p) return { y = size * p.a ^ 2 } end, limit)
      local m = s:spread { count = 100 }.matters.y[1]
      assert.is_true(m.share > 0.995, m.share)
    end
  end)

  it("is not given for few evaluations, or for a result that does not vary", function()
    local s = study({ a = { 0, 1 } }, function(p) return { y = p.a, still = 3 } end, ANY)
    assert.same({}, s:spread { count = 10 }.matters)
    assert.is_nil(s:spread { count = 30 }.matters.still)
  end)
end)

describe("study:chart", function()
  teardown(program.clean)

  local function made()
    local s = study({ speed = { 0.1, 1, unit = "m/s", log = true }, force = { 1, 9, unit = "N" },
      model = { choices = { "rod", "truss" } } }, function(p)
      if p.number == 7 then error "lost" end
      return { time = 1 / p.speed, peak = 5 * p.speed + p.force + (p.model == "rod" and 1 or 0) }
    end, { peak = { max = 10, unit = "N" } })
    s:spread { count = 60 }
    return s
  end

  local WANTED = {
    points = { { x = "speed", y = "peak" }, "speed [m/s]", "peak [N]", "meets the constraints",
      "breaks constraints" },
    cross = { { y = "peak" }, "speed [m/s]", "force [N]", "truss", "peak [N]" },
    convergence = { { y = "time" }, "evaluation", "best so far", "each evaluation" },
    histogram = { { x = "peak" }, "evaluations", "peak [N]" },
    tornado = { { y = "peak" }, "lowest fifth", "highest fifth", "force (", "share of its variance" },
    front = { { x = "time", y = "peak" }, "front", "peak [N]" },
  }

  for _, kind in ipairs(chart.names) do
    it("draws " .. kind, function()
      local s, folder, wanted = made(), program.folder(), WANTED[kind]
      local args = { kind = kind, x = wanted[1].x, y = wanted[1].y }
      local text = s:chart(args)
      assert.is_true(#text > 500)
      for _, ending in ipairs { "svg", "png", "pdf" } do
        args.path = ("%s/%s.%s"):format(folder, kind, ending)
        assert.equal(args.path, s:chart(args))
        assert.is_true(#program.read(args.path) > 1000)
      end
      local svg = program.read(folder .. "/" .. kind .. ".svg")
      for k = 2, #wanted do assert.truthy(svg:find(wanted[k], 1, true), wanted[k]) end
      assert.equal("string", type(chart.of(kind).doc))
    end)
  end

  -- Freedman and Diaconis: for 1000 values uniform over (0, 1) the width is 2 * 0.5 / 10 = 0.1.
  it("counts each value once in a histogram", function()
    local histogram, values, sum = chart.of "histogram", {}, 0
    for k = 1, 1000 do values[k] = (k * 617 % 1000 + 0.5) / 1000 end
    local counts = histogram.counts(values, histogram.bins(values))
    assert.equal(10, #counts)
    for _, c in ipairs(counts) do
      assert.is_true(math.abs(c - 100) <= 1)
      sum = sum + c
    end
    assert.equal(1000, sum)
    assert.same({ 3 }, histogram.counts({ 7, 7, 7 }, histogram.bins { 7, 7, 7 }))
  end)

  it("reports wrong arguments", function()
    local s = made()
    for words, args in pairs {
      ["did you mean 'tornado'?"] = { kind = "tornato", y = "peak" },
      ["y is required with kind = 'convergence'"] = { kind = "convergence" },
      ["x is required with kind = 'points'"] = { y = "peak" },
      ["x does not go with kind = 'tornado'"] = { kind = "tornado", x = "peak", y = "peak" },
      ["did you mean 'peak'?"] = { kind = "histogram", x = "peek" },
      ["x = 'model' has choices, no numbers"] = { kind = "histogram", x = "model" },
      ["there is no part 3"] = { kind = "histogram", x = "peak", part = 3 } } do
      local fine, why = pcall(s.chart, s, args)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(words, 1, true), tostring(why))
    end
    local few = study({ a = { 0, 1 } }, anything)
    few:sweep { grid = { a = 3 } }
    assert.error_matches(function() few:chart { kind = "tornado", y = "any" } end, "'any' does not vary")
    assert.error_matches(function() study({ a = { 0, 1 } }, anything):chart { kind = "cross", y = "a" } end,
      "there is no evaluation to draw")
  end)
end)
