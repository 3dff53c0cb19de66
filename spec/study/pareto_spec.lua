-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fronts of several results: those known in closed form, and the front of any table by comparing each pair.
local sw = require "softworld"

local study = require "spec.study.bowls".study

-- E. Zitzler, K. Deb, L. Thiele 2000: the front is x2 to xn = 0, with g over f as below.
local SHAPES = {}
function SHAPES.ZDT1(f, g) return 1 - math.sqrt(f / g) end
function SHAPES.ZDT2(f, g) return 1 - (f / g) ^ 2 end
function SHAPES.ZDT3(f, g) return 1 - math.sqrt(f / g) - f / g * math.sin(10 * math.pi * f) end

local function zdt(shape)
  local ranges = {}
  for i = 1, 5 do ranges["x" .. i] = { 0, 1 } end
  return study(ranges, function(p)
    local g = 1 + 9 / 4 * (p.x2 + p.x3 + p.x4 + p.x5)
    return { f = p.x1, g = g * shape(p.x1, g) }
  end)
end

describe("study:pareto", function()
  for name, shape in pairs(SHAPES) do
    -- Everything found lies within 0.03 of the curve, and each of 50 points of the curve has a result within
    -- 0.03. The dominated stretches of ZDT3's curve are not part of the front.
    it("finds the front of " .. name, function()
      local found = zdt(shape):pareto { "f", "g", evaluations = 6000, population = 60 }
      for _, row in ipairs(found.rows) do assert.is_true(row.g - shape(row.f, 1) < 0.03) end
      local least = math.huge
      for k = 0, 50 do
        local f = k / 50
        local g, nearest = shape(f, 1), math.huge
        for _, row in ipairs(found.rows) do
          nearest = math.min(nearest, math.sqrt((row.f - f) ^ 2 + (row.g - g) ^ 2))
        end
        if g < least then assert.is_true(nearest < 0.03, ("%g at f = %g"):format(nearest, f)) end
        least = math.min(least, g)
      end
    end)
  end

  -- Three distances to the corners of a triangle: the front is the triangle itself.
  it("finds the front of three results", function()
    local corners = { { 0.2, 0.2 }, { 0.8, 0.2 }, { 0.2, 0.8 } }
    local found = study({ x = { 0, 1 }, y = { 0, 1 } }, function(p)
      local r = {}
      for k, c in ipairs(corners) do r["d" .. k] = math.sqrt((p.x - c[1]) ^ 2 + (p.y - c[2]) ^ 2) end
      return r
    end):pareto { "d1", "d2", "d3", evaluations = 1800 }
    assert.is_true(#found.rows > 100)
    local outside = 0 -- by more than 0.02: dominated by places that were not evaluated
    for _, row in ipairs(found.rows) do
      if row.x < 0.18 or row.y < 0.18 or row.x + row.y > 1.02 then outside = outside + 1 end
    end
    assert.is_true(outside < 0.1 * #found.rows, outside .. " of " .. #found.rows)
    for _, wanted in ipairs { { 0.25, 0.25 }, { 0.7, 0.25 }, { 0.25, 0.7 }, { 0.4, 0.4 } } do
      local nearest = math.huge
      for _, row in ipairs(found.rows) do
        nearest = math.min(nearest, math.max(math.abs(row.x - wanted[1]), math.abs(row.y - wanted[2])))
      end
      assert.is_true(nearest < 0.07, tostring(nearest))
    end
  end)

  -- x^2 and (x - 2)^2 with x >= 0.5: the front has x from 0.5 to 2. The knee is where the slopes, as shares
  -- of the extents, are equal. x^2 goes from 0.25 to 4, the other from 0 to 2.25: x / 3.75 = (2 - x) / 2.25,
  -- x = 1.25.
  it("meets constraints, survives failures, and names the knee", function()
    local s = study({ x = { -5, 5 } }, function(p)
      if p.random() < 0.1 then return { a = 0 / 0, b = 1, x1 = 1 } end
      return { a = p.x ^ 2, b = (p.x - 2) ^ 2, x1 = p.x }
    end, { x1 = { min = 0.5 } })
    local found = s:pareto { "a", "b", evaluations = 800 }
    assert.is_true(found.failed > 20)
    assert.is_true(found.rows[1].x >= 0.5 and found.rows[1].x < 0.52)
    assert.is_true(math.abs(found.rows[#found.rows].x - 2) < 0.02, found.rows[#found.rows].x)
    for _, row in ipairs(found.rows) do assert.is_true(row.x >= 0.5 and row.x <= 2.02 and row.pass) end
    assert.is_true(math.abs(found.knee.x - 1.25) < 0.05, found.knee.x)
    assert.truthy(tostring(found):find("front of a, b: %d+ of 800 evaluations, %d+ failed"))
    assert.truthy(tostring(found):find("knee: evaluation %d+%.%d+: a = 1%."))
  end)

  it("accepts parameters as results, integers and choices", function()
    local s = study({ n = { 1, 12, integer = true }, c = { choices = { "a", "b" } } }, function(p)
      return { cost = (12 - p.n) * (p.c == "a" and 1 or 2) }
    end)
    local found = s:pareto { "n", "cost", evaluations = 400, population = 20 }
    assert.equal(12, #found.rows)
    for i, row in ipairs(found.rows) do
      assert.equal(i, row.n)
      assert.equal(12.0 - i, row.cost)
    end
  end)

  it("gives the same bits for any number of workers, and continues when given more evaluations", function()
    local path, texts = os.tmpname(), {}
    os.remove(path)
    for i, workers in ipairs { 0, 1, 3 } do
      local s = sw.study { name = "s", parameters = { x = { -5, 5 }, y = { 0, 1 } }, workers = workers,
        file = i == 3 and path or nil, evaluate = function(p)
          if p.random() < 0.1 then error("by chance", 0) end
          return { a = p.x ^ 2 + p.y, b = (p.x - 2) ^ 2 + p.random() }
        end }
      if i == 3 then
        s:pareto { "a", "b", evaluations = 80, population = 20 }
        s = sw.study { name = "s", parameters = { x = { -5, 5 }, y = { 0, 1 } }, workers = workers,
          file = path, evaluate = function(p)
            if p.random() < 0.1 then error("by chance", 0) end
            return { a = p.x ^ 2 + p.y, b = (p.x - 2) ^ 2 + p.random() }
          end }
      end
      s:pareto { "a", "b", evaluations = 200, population = 20 }
      if i == 3 then assert.equal(120, s.computed) end
      local lines = {}
      for k, row in ipairs(s:table()) do
        lines[k] = ("%d %a %a %s"):format(row.number, row.x, row.y,
          row.b and ("%a"):format(row.b) or row.failed)
      end
      texts[i] = table.concat(lines, "\n")
    end
    os.remove(path)
    assert.equal(texts[1], texts[2])
    assert.equal(texts[1], texts[3])
  end)

  it("reports wrong arguments", function()
    local s = study({ x = { 0, 1 } }, function(p) return { time = p.x, peak = 1 - p.x } end)
    for words, args in pairs {
      ["two or three results are wanted, such as study:pareto { 'time', 'peak' }, got 1"] = { "time" },
      ["'time' is there twice"] = { "time", "time" },
      ["result 2 must be a name, got 3"] = { "time", 3 },
      ["there is no parameter 'evaluation'; did you mean 'evaluations'?"] = { "time", "peak",
        evaluation = 3 },
      ["evaluations = 10 are fewer than one generation of 40"] = { "time", "peak", evaluations = 10 },
      ["evaluate returns no 'peek'; did you mean 'peak'?"] = { "time", "peek" } } do
      local fine, why = pcall(s.pareto, s, args)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(words, 1, true), tostring(why))
    end
    assert.error_matches(function() s:pareto "time" end, "results are wanted, such as .*got 'time'")
    s:sweep { grid = 3 }
    assert.error_matches(function() s:front { "time", "pek" } end, "did you mean 'peak'?")
    assert.error_matches(function() s:front { "time", "peak", count = 3 } end, "'count'")
  end)

  it("says which constraint no evaluation meets", function()
    local s = study({ x = { 0, 1 } }, function(p) return { a = p.x, b = -p.x } end, { b = { min = 1 } })
    assert.error_matches(function() s:pareto { "a", "b", evaluations = 80 } end,
      "no evaluation meets the constraints %(b is %-%S+ at best, allowed is at least 1%)")
  end)
end)

describe("study:front", function()
  -- By definition: a row is in the front if no other row is at least as good in all results and better in
  -- one.
  for _, names in ipairs { { "a", "b" }, { "a", "b", "c" } } do
    it(("has the rows of %d results that no other one beats"):format(#names), function()
      local s = study({ x = { 0, 1 } }, function(p)
        return { a = math.floor(9 * p.random()), b = math.floor(9 * p.random()), c = p.random(),
          d = p.random() }
      end, { d = { max = 0.7 } })
      s:sweep { count = 150 }
      local rows, wanted, seen = {}, {}, {}
      for _, row in ipairs(s:table()) do
        if row.pass then rows[#rows + 1] = row end
      end
      for _, row in ipairs(rows) do
        local beaten = false
        for _, other in ipairs(rows) do
          local worse, better = false, false
          for _, name in ipairs(names) do
            worse, better = worse or other[name] > row[name], better or other[name] < row[name]
          end
          beaten = beaten or better and not worse
        end
        local key = ("%g %g %s"):format(row.a, row.b, #names == 3 and row.c or "")
        if not beaten and not seen[key] then wanted[row.number], seen[key] = true, true end
      end
      local got = {}
      for _, row in ipairs(s:front(names).rows) do got[row.number] = true end
      assert.same(wanted, got)
    end)
  end

  it("is empty where no row passes", function()
    local s = study({ x = { 0, 1 } }, function(p) return { a = p.x, b = 1 } end, { b = { max = 0 } })
    s:sweep { count = 3 }
    local front = s:front { "a", "b" }
    assert.same({}, front.rows)
    assert.is_nil(front.knee)
  end)
end)
