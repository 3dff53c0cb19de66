-- SPDX-License-Identifier: GPL-3.0-or-later
-- Searches: the report on a minimum, how they end, refused arguments.
local core = require "softworld.core"
local search = require "softworld.study.search"
local bowls = require "spec.study.bowls"

local RANGES, study, bowl, search_by = bowls.RANGES, bowls.study, bowls.bowl, bowls.search_by

describe("the report on a minimum", function()
  it("has the error bar of the result, where evaluate returns one", function()
    local found = study(RANGES, function(p)
      return { y = bowl(p).y, y_error = 0.01 + p.a ^ 2 }
    end):minimise "y"
    assert.equal(0.01 + found.best.a ^ 2, found.error)
    local place = ("y = 2 +- 0.26 at a = %.6g, b = %.6g ("):format(found.best.a, found.best.b)
    assert.truthy(tostring(found):find(place, 1, true), tostring(found))
    assert.is_nil(study(RANGES, bowl):minimise "y".error)
  end)

  it("names no noise where there is none, and no flat direction", function()
    local found = study(RANGES, bowl):minimise "y"
    assert.is_nil(found.noise)
    assert.same({}, found.flat)
  end)

  -- y depends only on a + b: it is flat along (1, -1) / sqrt(2) of equal ranges; c has no effect.
  it("names flat directions", function()
    local found = study({ a = { 0, 1 }, b = { 0, 1 }, c = { 0, 1 } }, function(p)
      return { y = (p.a + p.b - 0.9) ^ 2 }
    end):minimise("y", { method = "cma-es" })
    assert.same({ { c = 1.0 } }, { found.flat[1] })
    assert.equal(2, #found.flat)
    assert.is_true(math.abs(math.abs(found.flat[2].a) - math.sqrt(0.5)) < 1e-3)
    assert.is_true(math.abs(found.flat[2].a + found.flat[2].b) < 1e-3)
    local text = tostring(found)
    assert.truthy(text:find("c has no influence near it", 1, true), text)
    assert.truthy(text:find("flat along [+-]0.71 a [+-]0.71 b"), text)
  end)

  it("names constraints that are reached, and failures", function()
    local found = study(RANGES, function(p)
      if p.b > 1 then error("too far", 0) end
      return { y = -p.a, a2 = p.a }
    end, { a2 = { max = 0.8 } }):minimise "y"
    assert.same({ "a2" }, found.at_limit)
    assert.equal("too far", found.failures[1].reason)
    assert.is_true(found.failures[1].where.b[1] > 1 and found.failures[1].where.b[2] <= 2)
    assert.truthy(tostring(found):find("%d+ failed, the first %d+ %(a .* b 1"))
  end)

  it("leaves out the surroundings on request, or when the evaluations do not suffice", function()
    local s = study(RANGES, bowl)
    local all = s:minimise "y"
    local bare = s:minimise("y", { around = false })
    assert.equal(all.evaluations - 6, bare.evaluations) -- 2 * 2 + 1 differences, and the place again
    assert.is_nil(bare.flat)
    assert.is_nil(s:minimise("y", { evaluations = 20 }).flat)
  end)
end)

describe("a search", function()
  it("says when its evaluations are fewer than a generation", function()
    assert.error_matches(function()
      study(RANGES, bowl):minimise("y", { method = "cma-es", evaluations = 5 })
    end, "study:minimise: evaluations = 5 are fewer than one generation of 6")
  end)

  -- Only the first values are left for a model to compare with; NLopt moves a start that is near a bound.
  it("continues when all but the first evaluations fail", function()
    for _, name in ipairs(search.names) do
      local s = study({ a = { -2, 2, start = -1.99 }, b = { -2, 2 } }, function(p)
        if p.number > 5 then return { z = 1 } end
        return bowl(p)
      end)
      assert.is_true(search_by(name, { study = s, evaluations = 80 }).failed > 5)
    end
  end)
end)

describe("core.search", function()
  it("can be freed in any state", function()
    for _, name in ipairs { "simplex", "bobyqa", "cobyla", "direct", "crs2" } do
      for _, told in ipairs { -1, 0, 1, 30 } do
        local s = core.search(name, { 0.3, 0.4 }, 0, 0.2, 1e-9, 1)
        for k = 0, told do
          local x = s:ask()
          if x and k < told then s:tell((x[1] - 0.5) ^ 2 + x[2]) end
        end
        if told == 1 then s:tell(1) end
        s:close()
        assert.error_matches(function() s:ask() end, "closed")
      end
    end
  end)

  it("allows one crs2 at a time, since NLopt has one stream of random numbers", function()
    local one = core.search("crs2", { 0.5, 0.5 }, 0, 0.2, 1e-3, 1)
    assert.error_matches(function() core.search("crs2", { 0.5, 0.5 }, 0, 0.2, 1e-3, 1) end, "under way")
    one:close()
    core.search("crs2", { 0.5, 0.5 }, 0, 0.2, 1e-3, 1):close()
  end)

  it("accepts only finite numbers", function()
    local s = core.search("bobyqa", { 0.3, 0.4 }, 0, 0.2, 1e-9, 1)
    s:ask()
    assert.error_matches(function() s:tell(0 / 0) end, "a finite number is wanted")
    assert.error_matches(function() core.search("bobyqa", { 0 / 0 }, 0, 0.2, 1e-9, 1) end, "finite number")
    s:close()
  end)
end)
