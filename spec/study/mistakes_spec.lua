-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mistakes in a study are reported with the script's line, the name, the value and the allowed values; no
-- result is lost.
local sw = require "softworld"
local program = require "host.program"

local function evaluate(p) return { y = p.x, z = 2 * p.x } end

local function study(changes)
  local args = { name = "s", parameters = { x = { 0, 1 } }, evaluate = evaluate, workers = 0 }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

-- Returns n parameters.
local function numbers(n)
  local list = {}
  for i = 1, n do list["p" .. i] = { 0, 1 } end
  return list
end

local function check(cases)
  for name, case in pairs(cases) do
    it(name, function()
      local fine, why = pcall(case[1])
      assert.is_false(fine)
      assert.truthy(tostring(why):find(case[2], 1, true), why)
      assert.truthy(tostring(why):find("mistakes_spec.lua:", 1, true), "no line: " .. tostring(why))
    end)
  end
end

local function with(range) return function() study { parameters = { force = range } } end end

describe("a parameter of a study", function()
  check {
    ["beyond what its row allows"] = { with { -1, 2, of = "obstacle.friction" },
      "-1 is not allowed; obstacle.friction is in [0, 100] -" },
    ["of a row that ends nowhere"] = { with { of = "wire.EI" }, "which is not a range to search in; give {" },
    ["at an end that its row leaves out"] = { with { 0, 1, of = "wire.breaking_load" },
      "0 is not allowed; wire.breaking_load is in (0, inf] N" },
    ["of a row that does not exist"] = { with { 0, 1, of = "obstacle.fricton" }, "did you mean 'friction'?" },
    ["of nothing that takes rows"] = { with { 0, 1, of = "obstcle.friction" }, "did you mean 'obstacle'?" },
    ["of a row that is no number"] = { with { 0, 1, of = "obstacle.name" }, "'obstacle.name' is a text" },
    ["of a row with another unit"] = { with { 0, 1, unit = "N", of = "wire.EI" },
      "unit = 'N', and wire.EI is in N m2" },
    ["of a row that is no name"] = { with { 0, 1, of = 5 }, "of = 5; it must be the name of a row" },
    ["without a range"] = { with {}, "parameter 'force': it needs a range { lowest, highest }" },
    ["with half a range"] = { with { 1 }, "the highest is missing" },
    ["with a reversed range"] = { with { 2, 1, unit = "N" }, "the range 2 to 1 N is reversed" },
    ["of one value"] = { with { 2, 2 }, "the range 2 to 2 is one value" },
    ["with an endless range"] = { with { 0, math.huge, unit = "N" }, "the highest is inf N" },
    ["with NaN"] = { with { 0 / 0, 1 }, "the lowest is" },
    ["that is a number"] = { with(5), "it needs a range { lowest, highest }, or choices = {...}, got 5" },
    ["with a word that does not exist"] = { with { 0, 1, unti = "N" }, "did you mean 'unit'?" },
    ["with a unit that is none"] = { with { 0, 1, unit = "mm" }, "unit = 'mm' is none of the SI" },
    ["with a unit that is no text"] = { with { 0, 1, unit = 5 }, "unit = 5 is none of the SI" },
    ["with log from 0"] = { with { 0, 1, log = true }, "log needs a range above 0, and it begins at 0" },
    ["with a wrong log"] = { with { 1, 2, log = "yes" }, "log must be true or false, got 'yes'" },
    ["of too large integers"] = {
      with { math.mininteger, math.maxinteger, integer = true }, "is too wide; integers are within +-1e+15" },
    ["of broken integers"] = { with { 0.5, 3, integer = true }, "must be of integers" },
    ["with a start outside"] = { with { 0, 1, start = 2 }, "start = 2 is not in the range 0 to 1" },
    ["with sigma 0"] = { with { 0, 1, sigma = 0 }, "sigma = 0 is not allowed" },
    ["with no choices"] = { with { choices = {} }, "choices must be a list of values" },
    ["with a choice twice"] = { with { choices = { "a", "a" } }, "choices[2] is there twice" },
    ["with choices and a range"] = { with { 0, 1, choices = { 1 } }, "choices go without a range" },
    ["named as what is taken"] = { function() study { parameters = { random = { 0, 1 } } } end,
      "parameter 'random': the name is taken" },
    ["with a strange name"] = { function() study { parameters = { ["a b"] = { 0, 1 } } } end,
      "a name begins with a letter" },
    ["of the catalogue without bounds"] = { with { value = 3, flag = "measured" },
      "the catalogue has no spread for this value" },
    ["not there at all"] = { function() study { parameters = {} } end, "parameters is empty" },
  }

  it("takes range and unit from the row that it names", function()
    local text = tostring(study { parameters = { mu = { of = "obstacle.restitution" },
      EI = { 1e-3, 1e-2, log = true, of = "wire.EI" }, n = { 5, 9, of = "wire.segments" } } })
    assert.truthy(text:find("mu: 0 to 1\n", 1, true), text)
    assert.truthy(text:find("EI: 0.001 to 0.01 N m2, log", 1, true), text)
    assert.truthy(text:find("n: 5 to 9, integer", 1, true), text)
  end)
end)

describe("a study", function()
  check {
    ["without evaluate"] = { function() sw.study { name = "s", parameters = { x = { 0, 1 } } } end,
      "evaluate is required" },
    ["with a word that does not exist"] = { function() study { evalute = 1 } end,
      "did you mean 'evaluate'?" },
    ["with a broken seed"] = { function() study { seed = 1.5 } end, "sw.study: seed = 1.5 is not allowed" },
    ["with too many workers"] = { function() study { workers = 1000 } end, "workers = 1000 is not allowed" },
    ["with a constraint of nothing"] = { function() study { constraints = { y = {} } } end,
      "constraint 'y' has neither min nor max" },
    ["with a constraint that nothing can meet"] = {
      function() study { constraints = { y = { min = 2, max = 1 } } } end, "min = 2 is above max = 1" },
    ["with a constraint of a parameter"] = { function() study { constraints = { x = { max = 1 } } } end,
      "is a limit of a parameter" },
    ["with a wrong unit of a constraint"] = {
      function() study { constraints = { y = { max = 1, unit = "lbf" } } } end, "unit = 'lbf'" },
    ["asked for a result that is not there"] = { function() study():minimise "zz" end,
      "evaluate returns no 'zz'" },
    ["with a constraint on a result that is not there"] = {
      function() study { constraints = { Y = { max = 1 } } }:sweep { count = 3 } end,
      "evaluate returns no 'Y'" },
    ["asked for no result"] = { function() study():minimise {} end, "the name of a result is wanted" },
    ["swept without a count"] = { function() study():sweep {} end, "count is required" },
    ["swept by another kind"] = { function() study():sweep { kind = "halten", count = 3 } end,
      "did you mean 'halton'?" },
    ["swept on a grid of another parameter"] = { function() study():sweep { grid = { y = 3 } } end,
      "there is no parameter 'y'" },
    ["swept on an endless grid"] = { function() study():sweep { grid = 1e8 } end,
      "grid: x = 100000000 is not allowed; it must be an integer from 1 to 1000000" },
    ["swept on a grid with too many places"] = {
      function() study { parameters = { x = { 0, 1 }, y = { 0, 1 }, n = { 1, 9, integer = true } } }:sweep {
        grid = 1000 } end,
      "the grid has 9 x 1000 x 1000 = 9e+06 evaluations, of 3 parameters; at most 1000000 are allowed" },
    ["swept on a grid of very many parameters"] = {
      function() study { parameters = numbers(40) }:sweep { grid = 3 } end,
      "the grid has 3 x 3 x 3 x 3 x 3 x 3 x ... = 1.21577e+19 evaluations, of 40 parameters; at most" },
    ["swept on a grid that is a list"] = { function() study():sweep { grid = { 3 } } end,
      "grid: there is no parameter '1'" },
    ["swept on a grid of no numbers"] = { function() study():sweep { grid = { x = true } } end,
      "grid: x = a boolean is not allowed; it must be an integer from 1 to 1000000" },
    ["swept at too many points"] = { function() study():sweep { count = 1e7 } end,
      "count = 10000000 is not allowed; it must be an integer from 1 to 1000000" },
    ["swept with more parameters than Sobol's sequence has"] = {
      function() study { parameters = numbers(200) }:sweep { count = 3 } end,
      "study:sweep: kind = 'sobol' is for 1 to 40 parameters, not 200; take kind = 'latin'" },
    ["spread without constraints"] = { function() study():spread { count = 3 } end, "has no constraints" },
    ["with choices to a simplex"] = { function()
      study { parameters = { m = { choices = { "a", "b" } } } }:minimise("y", { method = "simplex" })
    end, "method = 'simplex' cannot choose 'm' among choices; take 'cma-es'" },
    ["with an integer to a smooth model"] = { function()
      study { parameters = { m = { 1, 9, integer = true } } }:minimise("y", { method = "bobyqa" })
    end, "method = 'bobyqa' cannot vary 'm', which is an integer; take 'cma-es'" },
    ["searched by a misspelt method"] = { function() study():minimise("y", { method = "cmaes" }) end,
      "did you mean 'cma-es'?" },
    ["searched from many places by a method that has one"] = { function()
      study():minimise("y", { method = "direct", starts = 3 })
    end, "starts does not go with method = 'direct'" },
    ["told to be noisy to a simplex"] = { function()
      study():minimise("y", { method = "simplex", noise = true })
    end, "noise = true does not go with method = 'simplex'; take 'cma-es'" },
    ["searched with a step of nothing"] = { function() study():minimise("y", { step = 0 }) end,
      "study:minimise: step = 0 is not allowed" },
    ["called with a dot"] = { function() study().sweep { count = 3 } end, "call it with a colon" },
    ["asked for what it has not"] = { function() return study().tabel end, "did you mean 'table'?" },
    ["written to"] = { function() study().name = "t" end, "cannot be written to" },
    ["drawn over what is not there"] = { function()
      local s = study()
      s:sweep { count = 3 }
      s:chart { x = "x", y = "yy" }
    end, "there is no parameter or result 'yy'" },
  }

  it("whose setup fails raises its error, with its line", function()
    for workers = 0, 1 do
      local s = study { setup = function() error "no table" end }
      local fine, why = pcall(s.sweep, s, { count = 3, workers = workers })
      assert.is_false(fine)
      assert.truthy(why:find("mistakes_spec.lua:%d+: no table"), why)
    end
  end)

  it("whose constraints no evaluation meets says which, and what came nearest", function()
    local s = study { constraints = { y = { min = 2 }, z = { max = 5 } } }
    local fine, why = pcall(s.minimise, s, "z")
    assert.is_false(fine)
    assert.truthy(why:find("meets the constraints (y is 1 at best, allowed is at least 2)", 1, true), why)
    assert.truthy(why:find("the nearest is evaluation %d+ with x = 1"), why)
    assert.is_true(#s:table() > 10) -- and no result is lost
  end)
end)

describe("an evaluation", function()
  -- the body of evaluate and the message: the study ends when the first evaluation does this; later ones
  -- fail
  local cases = {
    ["returns nothing"] = { function() end, "returned nothing; it must return a table of results" },
    ["returns a number"] = { function() return 5 end, "returned 5; it must return a table of results" },
    ["returns two values"] = { function() return {}, 5 end, "returned more than one value" },
    ["returns an empty table"] = { function() return {} end, "returned 0 results" },
    ["returns a text"] = { function() return { y = "1" } end, "returned y = '1'" },
    ["returns a list"] = { function() return { 1, 2 } end, "a name begins with a letter" },
    ["returns a parameter"] = { function() return { x = 1 } end, "returned 'x', which is a parameter" },
    ["asks for another parameter"] = { function(p) return { y = p.xx } end, "evaluation has no 'xx'" },
    ["makes a mistake"] = { function(p) return { y = p.x.b.c } end, "attempt to index a n" },
  }
  for name, case in pairs(cases) do
    it("that " .. name .. " says so", function()
      for workers = 0, 1 do
        local s = study { evaluate = case[1] }
        local fine, why = pcall(s.sweep, s, { count = 3, workers = workers })
        assert.is_false(fine)
        assert.truthy(tostring(why):find(case[2], 1, true), why)
        assert.truthy(tostring(why):find("mistakes_spec.lua:", 1, true), why)
        s = study { evaluate = function(p)
          if p.number == 2 then return case[1](p) end
          return { y = 1 }
        end }
        local rows = s:sweep { count = 3, workers = workers }
        assert.equal(1, rows[3].y)
        assert.truthy(rows[2].failed:find(case[2], 1, true), rows[2].failed)
        assert.is_nil(rows[2].pass)
      end
    end)
  end

  it("that raises an error, gives up or is not finite has failed, and its reason is kept", function()
    local s = study { evaluate = function(p)
      if p.number == 2 then error "lost the wire" end
      if p.number == 3 then p.give_up "margin broken" end
      if p.number == 4 then return { y = 0 / 0 } end
      if p.number == 5 then return { y = -math.huge } end
      if p.number == 6 then return { other = 1 } end
      if p.number == 7 then error({}) end
      return { y = 1 }
    end }
    local rows = s:sweep { count = 8 }
    assert.truthy(rows[2].failed:find "mistakes_spec.lua:%d+: lost the wire")
    assert.equal("margin broken", rows[3].failed)
    assert.equal("y is nan", rows[4].failed)
    assert.equal("y is infinite", rows[5].failed)
    assert.equal("evaluate returned other, and y before (evaluation 1)", rows[6].failed)
    assert.truthy(rows[7].failed:find "^table: ")
    assert.equal(1, rows[8].y)
    assert.truthy(tostring(s):find("8 evaluations, 6 failed", 1, true))
  end)

  it("that closes the shared scene says so", function()
    for workers = 0, 1 do
      local s = study { setup = function() return sw.scene {} end, evaluate = function(_, scene)
        scene:close()
        return { y = 1 }
      end }
      assert.error_matches(function() s:sweep { count = 3, workers = workers } end,
        "evaluate closed the scene that setup had built")
    end
  end)

  it("of which all fail is an error with the first reason", function()
    local s = study { evaluate = function() error("no luck", 0) end }
    assert.error_matches(function() s:sweep { count = 4 } end,
      "none of 4 evaluations succeeded; the first: no luck")
  end)

  it("cannot ask its study for more evaluations", function()
    local s
    s = study { evaluate = function() return { y = #s:sweep { count = 2 } } end }
    assert.error_matches(function() s:sweep { count = 2 } end, "evaluate cannot start other evaluations")
  end)
end)

describe("a study while a live view is open", function()
  it("starts no worker process, and says what to do", function()
    local scene = sw.scene {}
    local view = scene:view { open = false }
    local s = study()
    local fine, why = pcall(s.sweep, s, { count = 3, workers = 2 })
    assert.is_false(fine)
    assert.truthy(why:find("while a live view is open", 1, true), why)
    assert.truthy(why:find("workers = 0", 1, true), why)
    assert.truthy(why:find("mistakes_spec.lua:", 1, true), why)
    assert.equal(3, #s:sweep { count = 3, workers = 0 })
    view:close()
    assert.equal(3, #s:sweep { count = 3, workers = 2 })
  end)
end)

describe("errors of a script's study", function()
  teardown(program.clean)
  it("name the script's line", function()
    local _, err, code = program.script [[
local sw = require "softworld"
local study = sw.study { name = "s", parameters = { x = { 0, 1 } },
  evaluate = function(p) return { y = p.x } end }
study:minimise "z"
]]
    assert.equal(1, code)
    assert.truthy(err:find("script.lua:4: study:minimise: evaluate returns no 'z'; did you mean 'y'?", 1,
      true), err)
  end)
end)
