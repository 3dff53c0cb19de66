-- SPDX-License-Identifier: GPL-3.0-or-later
-- Vectors of read-outs in a study: as results, among the values that evaluate uses, among options of a call.
local sw = require "softworld"
local parts = require "softworld.study.parts"
local program = require "host.program"

local function place(x)
  local wire = sw.scene{}:wire{ E = 1e7, density = 1200, radius = 0.003, from = { x, 0, 1 }, to = { x, 1, 1 },
    segments = 4 }
  return wire:position(0)
end

describe("vectors in a study", function()
  teardown(program.clean)

  for _, workers in ipairs{ 0, 2 } do
    it(("are results with numbers, as any list, of %d workers"):format(workers), function()
      local study = sw.study{ name = "s", workers = workers, parameters = { x = { 1, 2 } },
        evaluate = function(p) return { where = place(p.x) } end }
      study:sweep{ grid = { x = 2 } }
      local row = study:table()[2]
      assert.same({ 2, 0, 1 }, { row.where_1, row.where_2, row.where_3 })
    end)
  end

  it("make it another definition when they change", function()
    local path = program.folder() .. "/s.study"
    local function results(goal)
      local study = sw.study{ name = "s", file = path, workers = 0, parameters = { x = { 1, 2 } },
        evaluate = function(p) return { y = goal[1] * p.x } end }
      study:sweep{ grid = { x = 2 } }
      return study.computed, study:table()[1].y
    end
    local stderr = io.stderr
    io.stderr = { write = function() end } -- luacheck: ignore
    local fine, why = pcall(function()
      assert.same({ 2, 1.0 }, { results(place(1)) })
      assert.same({ 2, 3.0 }, { results(place(3)) })
      assert.same({ 0, 1.0 }, { results(place(1)) })
      assert.same({ 0, 1.0 }, { results{ 1.0, 0.0, 1.0 } })
    end)
    io.stderr = stderr -- luacheck: ignore
    assert(fine, why)
  end)

  it("name a call as lists do", function()
    assert.equal(parts.text("m", { start = { 1.0, 0.0, 1.0 } }), parts.text("m", { start = place(1) }))
  end)
end)
