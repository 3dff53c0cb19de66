-- SPDX-License-Identifier: GPL-3.0-or-later
-- Each call of a method is known by its arguments, not by its place in the script: calls may be added and
-- removed.
local sw = require "softworld"
local program = require "host.program"
local parts = require "softworld.study.parts"

local function study(path, changes)
  local args = { name = "s", file = path, workers = 0, parameters = { x = { 0, 1 } },
    evaluate = function(p) return { y = (p.x - 0.3) ^ 2, luck = p.random() } end,
    constraints = { y = { max = 0.2 } } }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

local function luck_of(rows)
  local list = {}
  for i, row in ipairs(rows) do list[i] = row.luck end
  return list
end

-- The results of a spread of 20, after the calls of before.
local function spread_after(path, before)
  local s = study(path)
  if before then before(s) end
  local at = s.computed
  s:spread { count = 20 }
  local rows = s:table()
  return luck_of(table.move(rows, #rows - 19, #rows, 1, {})), s.computed - at
end

describe("a part of a study", function()
  teardown(program.clean)

  it("stays the same when another method is called before it", function()
    local path = program.folder() .. "/s.study"
    local expected, computed = spread_after(path)
    assert.equal(20, computed)
    local function before(s)
      s:sweep { count = 5 }
      s:minimise("y", { evaluations = 10 })
    end
    -- with the journal nothing is computed again; without it the random numbers are the same
    local s = study(path)
    before(s)
    assert.equal(13, s.computed) -- two evaluations for each of the search's four starts
    s:spread { count = 20 }
    assert.equal(13, s.computed)
    assert.same(expected, luck_of(table.move(s:table(), 1, 20, 1, {}))) -- it came first into the journal
    local other = spread_after(nil, before)
    assert.same(expected, other)
    assert.equal(0, select(2, spread_after(path)))
    assert.equal(0, select(2, spread_after(path, before)))
  end)

  it("stays the same when a part before it is removed", function()
    local path = program.folder() .. "/s.study"
    local s = study(path)
    s:sweep { grid = 3 }
    s:sweep { kind = "halton", count = 8 }
    assert.equal(11, s.computed)
    s = study(path)
    assert.equal(8, #s:sweep { kind = "halton", count = 8 })
    assert.equal(0, s.computed)
  end)

  it("is separate when the same call occurs twice, and continues when it is made longer", function()
    local path = program.folder() .. "/s.study"
    local s = study(path)
    local first, second = s:sweep { count = 4 }, s:sweep { count = 4 }
    assert.same({ 1, 2 }, { first[1].part, second[1].part })
    assert.is_true(first[1].luck ~= second[1].luck)
    s = study(path)
    s:sweep { count = 6 }
    assert.equal(2, s.computed)
    assert.same(luck_of(second), luck_of(s:sweep { count = 4 }))
    assert.equal(2, s.computed)
  end)

  it("keeps its number when the line that names it is damaged, and is computed again", function()
    local path = program.folder() .. "/s.study"
    study(path):sweep { count = 4 }
    local text = program.read(path)
    program.write(path, (text:gsub('p 1 "sweep', 'p 1 "swoop')))
    local real = io.stderr
    io.stderr = { write = function() end } -- luacheck: ignore
    local s = study(path)
    local rows = s:sweep { count = 4 }
    io.stderr = real -- luacheck: ignore
    assert.equal(4, s.computed)
    assert.equal(2, rows[1].part) -- 1 is the part of the lines without a name
    assert.equal(8, #s:table())
  end)

  it("is named by its options, except the count and the workers", function()
    assert.equal("sweep grid={a=2 b=3} kind=grid", parts.text("sweep", { kind = "grid", workers = 3,
      grid = { b = 3, a = 2 }, count = 7 }))
    assert.equal("spread", parts.text("spread", { count = 10 }))
    assert.equal("fit f=function", parts.text("fit", { f = print }))
    local long = parts.text("fit", { data = ("x"):rep(200) })
    assert.truthy(long:find "^fit %x+$")
    assert.is_false(long == parts.text("fit", { data = ("x"):rep(201) }))
    local endless = {}
    endless.endless = endless
    assert.truthy(parts.text("m", endless):find "^m ")
  end)
end)
