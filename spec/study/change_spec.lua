-- SPDX-License-Identifier: GPL-3.0-or-later
-- study:change: sensitivities are derivatives; a proposed change makes its row pass; parameters without
-- effect are named. The rows are the script's own checks, known functions of the parameters.
local sw = require "softworld"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/study"
local program = dofile(here .. "/../host/program.lua")

local scene = sw.scene{ name = "still" }
scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 4 }
local run = scene:run{ duration = 0.01, dt = 0.01 }

local function own(name, value, limits)
  local one = { name = name, unit = "m", sure = true, of = function() return value end }
  for side, limit in pairs(limits) do one[side] = limit end
  return one
end

-- A study with the rows of f(p), for parameters a and b from 0 to 10.
local function study_of(f, more)
  local options = { name = "rows", workers = 0,
    parameters = { a = { 0, 10, start = 4, unit = "m" }, b = { 0, 10, start = 5 } },
    evaluate = function(p) return run:check{ checks = f(p) } end }
  for key, value in pairs(more or {}) do options[key] = value end
  return sw.study(options)
end

local function found_of(change, row, name)
  for _, one in ipairs(change.rows) do
    if one.name == row then
      for _, found in ipairs(one.parameters) do
        if found.name == name then return found, one end
      end
    end
  end
end

local function fails(words, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine)
  assert.truthy(why:find(words, 1, true), why)
end

describe("study:change", function()
  teardown(program.clean)

  -- v = a^2 <= 9 fails at a = 4 by 7. The slope of the margin is -2 a = -8. With 5 % of 9 in reserve a has
  -- to be <= sqrt(8.55) = 2.924; this value is found to 1 % of the range, 0.1, on the side that passes.
  it("gives the slope of the margin, and the least change that passes with the reserve", function()
    local study = study_of(function(p) return { own("v", p.a ^ 2, { max = 9 }) } end)
    local change = study:change()
    local found, row = found_of(change, "v", "a")
    assert.same({ "mends", 4, true }, { found.status, found.from, found.all_pass })
    assert.is_near(-8, found.slope, 1e-9)
    assert.is_true(found.to <= math.sqrt(8.55) and found.to > math.sqrt(8.55) - 0.11, found.to)
    assert.equal(found.to, tonumber(("%.2g"):format(found.to)), "a round value")
    assert.equal(9 - found.to ^ 2, found.margin)
    assert.same({ true, true, found.to, 5 },
      { row.mended, change.ok, change.parameters.a, change.parameters.b })
    assert.equal(found.value, study:again(found.evaluation, found.part):row "v".value)
    local again = study:change{ at = change.parameters }
    assert.same({ true, 0 }, { again.ok, #again.rows })
    assert.truthy(tostring(change):find("lower a from 4.000 m to 2.9%d0 m.*all rows pass"), tostring(change))
  end)

  it("says which parameters do not help, and which help but not enough", function()
    local change = study_of(function(p)
      return { own("v", 20 - p.a + 1e-6 * p.b, { max = 9 }) }
    end):change()
    local a, b = found_of(change, "v", "a"), found_of(change, "v", "b")
    assert.same({ "helps", 10, "does not help" }, { a.status, a.to, b.status })
    assert.is_near(-1, a.margin, 1e-3)
    assert.is_false(change.ok)
    local text = tostring(change)
    assert.truthy(text:find("a helps, but not enough: 10.00 m at best, with 10.00 m", 1, true), text)
    assert.truthy(text:find("b does not help", 1, true), text)
    assert.truthy(text:find("no single parameter repairs it with that reserve, of 9 values", 1, true), text)
    assert.is_nil(change.parameters)
  end)

  -- Lowering a mends one row, raising a the other, with 5 % of the limit in reserve; neither mends both, and
  -- b mends nothing.
  it("says which rows a change breaks, and looks for a change that mends all", function()
    local change = study_of(function(p)
      return { own("low", p.a, { max = 3 }), own("high", p.a, { min = 5 }) }
    end):change()
    for row, least in pairs{ low = 1.15, high = 1.25 } do -- 2.85 and 5.25, found to 0.1
      local a = found_of(change, row, "a")
      local far = row == "low" and 4 - a.to or a.to - 4
      assert.is_true(far >= least and far <= least + 0.1, a.to)
      assert.same({ "mends", false, {} }, { a.status, a.all_pass, a.breaks }, row) -- the other failed before
      assert.equal("does not help", found_of(change, row, "b").status, row)
    end
    assert.is_false(change.ok)
    assert.equal("no single parameter repairs all rows", change.reason)
    local other = study_of(function(p)
      return { own("low", p.a, { max = 3 }), own("kept", p.a, { min = 3.8 }), own("b", p.b, { max = 4 }) }
    end):change()
    assert.same({ "kept" }, found_of(other, "low", "a").breaks)
    assert.truthy(tostring(other):find("but then kept would not pass", 1, true), tostring(other))
    assert.is_true(other.rows[#other.rows].all)
  end)

  it("tries changes that each mend one row together, and says when all rows pass then", function()
    local change = study_of(function(p)
      return { own("low", p.a, { max = 3 }), own("high", p.b, { min = 6 }) }
    end):change()
    assert.same({ true, "lower a from 4.000 m to 2.800 m and raise b from 5 to 6.400" },
      { change.ok, change.reason })
    assert.same({ a = 2.8, b = 6.4 }, change.parameters)
    assert.truthy(tostring(change):find("together: " .. change.reason .. "; all rows pass", 1, true))
    -- b raises the first row by 0.14; with changes 1.25 times as large both rows pass with the reserve
    local farther = study_of(function(p)
      return { own("low", p.a + 0.1 * (p.b - 5), { max = 3 }), own("high", p.b, { min = 6 }) }
    end):change()
    assert.same({ a = 2.5, b = 6.8 }, { a = farther.parameters.a, b = farther.parameters.b })
    -- b mends the second row, but not while a is low
    local apart = study_of(function(p)
      return { own("low", p.a, { max = 3 }), own("high", p.a < 3.5 and 0 or p.b, { min = 6 }) }
    end):change()
    assert.same({ false, "no single parameter repairs all rows" }, { apart.ok, apart.reason })
    assert.is_nil(apart.parameters)
  end)

  -- A row that passes only between 6 and 7: found by scanning the range, not by a slope.
  it("scans the whole range, up and down", function()
    local change = study_of(function(p)
      return { own("hole", math.abs(p.a - 6.5), { max = 0.5 }) }
    end, { parameters = { a = { 0, 10, start = 9.5 } } }):change{ values = 21 }
    local found = found_of(change, "hole", "a")
    assert.is_true(found.status == "mends" and found.to > 6.8 and found.to <= 7, found.to)
  end)

  it("includes rows that fail only for the reserve, and no others", function()
    local study = study_of(function(p)
      return { own("v", p.a, { max = 4.1 }), own("w", p.b, { max = 9 }) }
    end)
    local change = study:change()
    assert.same({ 1, "v", "PASS" }, { #change.rows, change.rows[1].name, change.rows[1].verdict })
    assert.is_true(found_of(change, "v", "a").to <= 0.95 * 4.1)
    assert.same({ true, 0 }, { study:change{ reserve = 0 }.ok, #study:change{ reserve = 0 }.rows })
    local asked = study:change "w"
    assert.same({ true, "no need" }, { asked.ok, found_of(asked, "w", "b").status })
    assert.is_near(-1, found_of(asked, "w", "b").slope, 1e-9)
  end)

  -- d(-ln x)/dx at 5 is -0.2, exact for a parabola in ln x. The limit is reached at x = 1, with nothing in
  -- reserve.
  it("treats a logarithmic range as such, and reports a change that passes with less than the "
    .. "reserve", function()
    local change = study_of(function(p) return { own("v", 1 + math.log(p.x), { max = 1 }) } end,
      { parameters = { x = { 1, 1000, start = 5, log = true } } }):change()
    local found = found_of(change, "v", "x")
    assert.same({ "passes", 1, 0 }, { found.status, found.to, found.margin })
    assert.is_near(-0.2, found.slope, 1e-9)
    assert.truthy(tostring(change):find("x makes it pass, with a smaller reserve than wanted", 1, true))
  end)

  it("distinguishes the two limits of a row", function()
    local change = study_of(function(p) return { own("v", p.a, { max = 3, min = 2.9 }) } end):change()
    assert.same({ "v min" }, found_of(change, "v", "a").breaks)
  end)

  it("keeps integers whole and takes choices", function()
    local change = study_of(function(p)
      return { own("v", p.n + ({ rod = 0, tube = -3 })[p.kind], { max = 4.5 }) }
    end, { parameters = { n = { 0, 20, start = 7, integer = true },
      kind = { choices = { "rod", "tube" } } } }):change()
    assert.same({ "mends", 4 }, { found_of(change, "v", "n").status, found_of(change, "v", "n").to })
    assert.is_near(-1, found_of(change, "v", "n").slope, 1e-9)
    local kind = found_of(change, "v", "kind")
    assert.same({ "mends", "rod", "tube" }, { kind.status, kind.from, kind.to })
    assert.truthy(tostring(change):find("take kind = tube instead of rod", 1, true))
  end)

  -- Noise of 1 with a slope of 0: neither a slope nor a change is reported. With a slope of 10 both are.
  it("does not mistake noise for an effect", function()
    local function study(slope)
      return study_of(function(p)
        return { own("v", 12 + slope * (p.a - 4) + p.random(), { max = 9 }) }
      end)
    end
    local change = study(0):change()
    assert.is_true(change.noisy)
    for _, name in ipairs{ "a", "b" } do
      local found = found_of(change, "v", name)
      assert.equal("does not help", found.status)
      assert.is_true(math.abs(found.slope) <= found.slope_error)
    end
    local found = found_of(study(10):change(), "v", "a")
    assert.equal("mends", found.status)
    assert.is_true(math.abs(found.slope + 10) <= found.slope_error)
  end)

  it("treats failed evaluations as not passing", function()
    local change = study_of(function(p)
      if p.a < 3.5 then p.give_up "too low" end
      return { own("v", p.a, { max = 3 }) }
    end):change()
    assert.is_true(change.failed > 0)
    assert.same({ false, "helps", 3.5 },
      { change.ok, found_of(change, "v", "a").status, found_of(change, "v", "a").to })
  end)

  it("finds the same with workers, and computes nothing twice with a journal", function()
    local function f(p) return { own("v", p.a ^ 2 + p.b, { max = 9 }) } end
    local file = program.folder() .. "/change.study"
    local first = study_of(f, { workers = 2, file = file })
    local text = tostring(first:change())
    assert.equal(text, tostring(study_of(f):change()))
    assert.is_true(first.computed > 20)
    local second = study_of(f, { file = file })
    assert.equal(text, tostring(second:change()))
    assert.equal(0, second.computed)
  end)

  it("leaves out rows without a limit, and says so when asked for one", function()
    local study = study_of(function(p) return { own("v", p.a, {}) } end)
    assert.truthy(study:change().reason:find("rows are open because a limit is missing", 1, true))
    fails("study:change: row 'v' has no limit", study.change, study, "v")
  end)

  it("refuses wrong arguments by name", function()
    local study = study_of(function(p) return { own("value", p.a, { max = 3 }) } end)
    fails("there is no row 'valu'; did you mean 'value'?", study.change, study, "valu")
    fails("there is no parameter 'reserv'; did you mean 'reserve'?", study.change, study, { reserv = 1 })
    fails("study:change: at: a = 11 m is not allowed", study.change, study, { at = { a = 11 } })
    fails("study:change: at = 'c' is not one of", study.change, study, { at = { c = 1 } })
    local none = study_of(nil, { parameters = { a = { 0, 1 } } })
    fails("parameter 'a' has no start", none.change, none)
    local numbers = study_of(nil, { evaluate = function(p) return { y = p.a } end })
    fails("evaluate must return a check, run:check {...}, got a table", numbers.change, numbers)
    local raises = study_of(nil, { evaluate = function() error "no such file" end })
    fails("evaluate fails with the parameters as they are: ", raises.change, raises)
    local failing = study_of(nil, { evaluate = function()
      local falling = sw.scene{ name = "falling" }
      falling:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 4 }
      return falling:run{ duration = 1, dt = 0.1, max_steps = 1 }:check()
    end })
    fails("the run was cut short", failing.change, failing)
  end)
end)

describe("an evaluation that returns a check", function()
  it("has its values, margins, errors and verdicts as results", function()
    local study = study_of(function(p)
      return { own("a b.c", p.a, { max = 3 }), own("far", math.huge, { min = 1 }) }
    end)
    local row = study:sweep{ grid = { a = 2, b = 2 } }[4]
    assert.same({ 10, -7, -1, 1 }, { row.a_b_c, row.a_b_c_margin, row.a_b_c_verdict, row.kinks_verdict })
    assert.is_nil(row.a_b_c_error) -- the error is unknown
    assert.same({ 1 }, { row.far_verdict, row.far, row.far_margin }) -- results are finite
  end)

  it("renames rows that have the same name or a parameter's name", function()
    local study = study_of(function(p)
      return { own("a", p.a, { max = 3 }), own("x.y", 1, { max = 3 }), own("x y", 2, { max = 3, min = 0 }),
        own(("long "):rep(30), 3, { max = 4 }), own("1st", 4, { max = 5 }) }
    end)
    local row = study:sweep{ grid = 1 }[1]
    assert.same({ 4, 1, 2, 2, 4 }, { row.a_max, row.x_y, row.x_y_min, row.x_y_max, row.row_1st })
  end)
end)
