-- SPDX-License-Identifier: GPL-3.0-or-later
-- Searches over integers and choices: values that are known are not computed again, and a search that knows
-- all values has found the smallest.
local sw = require "softworld"

-- Returns a study, and a table that counts how often each value was computed.
local function counted(parameters, evaluate)
  local counts = {}
  local study = sw.study{ name = "known", workers = 0, seed = 3, parameters = parameters,
    evaluate = function(p)
      counts[p.k] = (counts[p.k] or 0) + 1
      return evaluate(p)
    end }
  return study, counts
end

local function sums(counts)
  local places, most, all = 0, 0, 0
  for _, n in pairs(counts) do places, most, all = places + 1, math.max(most, n), all + n end
  return places, most, all
end

describe("study:minimise", function()
  for _, last in ipairs{ 1, 3, 100 } do
    it(("computes no value twice, and knows all of 0 to %d in the end"):format(last), function()
      local study, counts = counted({ k = { 0, last, integer = true } }, function(p)
        return { y = (p.k - 2.2) ^ 2 }
      end)
      local found = study:minimise("y", { evaluations = 400 })
      local places, most, all = sums(counts)
      assert.equal(math.min(last, 2), found.best.k)
      assert.is_true(found.ok, found.reason)
      assert.same({ last + 1, 2, last + 2 }, { places, most, all }) -- the best one once more, for its noise
      assert.equal(("all %d values are known"):format(last + 1), found.reason)
      assert.is_nil(found.noise)
    end)
  end

  it("ends before that where the method has found the end", function()
    local study, counts = counted({ k = { 0, 9, integer = true } }, function(p)
      return { y = (p.k - 2.2) ^ 2 }
    end)
    local found = study:minimise("y", { evaluations = 400 })
    local _, most, all = sums(counts)
    assert.same({ true, 2, 2 }, { found.ok, found.best.k, most })
    assert.is_true(all <= 11)
  end)

  it("does so for choices and integers together, with workers too", function()
    for _, workers in ipairs{ 0, 2 } do
      local study = sw.study{ name = "known", workers = workers, parameters = {
        c = { choices = { "a", "b", "c" } }, k = { 1, 2, integer = true } },
        evaluate = function(p) return { y = p.c == "b" and p.k or 5 } end }
      local found = study:minimise "y"
      assert.same({ true, 7, "b", 1 }, { found.ok, found.evaluations, found.best.c, found.best.k })
    end
  end)

  it("says that it came back to known places where the evaluations do not suffice for all", function()
    local study, counts = counted({ k = { 0, 100, integer = true } }, function(p)
      return { y = (p.k - 2.2) ^ 2 }
    end)
    local found = study:minimise("y", { evaluations = 50 })
    assert.same({ false, 2 }, { found.ok, found.best.k })
    assert.equal("it came back to places that are known", found.reason)
    local _, most = sums(counts)
    assert.equal(2, most)
  end)

  it("computes places again where values are noisy", function()
    local study, counts = counted({ k = { 0, 3, integer = true } }, function(p)
      return { y = p.k + 0.1 * p.random() }
    end)
    study:minimise("y", { noise = true, evaluations = 200 })
    local _, most = sums(counts)
    assert.is_true(most > 10)
  end)

  it("says that noise was not checked, where no evaluation is left for that", function()
    local function search(options)
      return sw.study{ name = "nz", workers = 0, seed = 3, parameters = { x = { -1, 2 }, l = { 0, 1 } },
        evaluate = function(p) return { y = (p.x - 0.5) ^ 2 + (p.l - 0.3) ^ 2 + 0.2 * p.random() } end }
        :minimise("y", options)
    end
    local found = search{ method = "bobyqa", evaluations = 60 }
    assert.same({ false, 0 }, { found.noise.checked, found.noise.repeats })
    assert.truthy(tostring(found):find("noise: not checked, because no evaluation was left for it", 1, true))
    found = search{ method = "bobyqa", evaluations = 60, around = false }
    assert.truthy(tostring(found):find("noise: not checked, because around = false", 1, true))
    found = search{ method = "simplex", evaluations = 2000 }
    assert.is_true(found.noise == nil or found.noise.checked)
  end)
end)
