-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tolerances that were asked for and are not met: a script that prints the value alone is told at its end.
require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- A cantilever under its weight. Its droop has an error of about 1e-4 of its length on few edges.
local hung = [[
local sw = require "softworld"
local scene = sw.scene{ name = "hung" }
local wire = scene:wire{ E = 1e8, density = 1e3, radius = 1e-3, segments = 16, from = {0, 0, 0},
  to = {0.3, 0, 0} }
scene:clamp(wire, { s = 0 })
scene:force{ kind = "damping", mass = 5 }
local tolerance = { ["clamp1.force"] = 1 }
local function run(share)
  tolerance.tip = share
  local result = scene:run{ dt = 0.01, duration = 0.2, levels = 3, tolerance = tolerance }
  return result
end
local function settle(share)
  local result = scene:settle{ levels = 3, tolerance = { tip = share } }
  return result
end
]]

describe("a tolerance that is not met", function()
  after_each(program.clean)

  for what, text in pairs{ run = "the run of 'hung'", settle = "scene:settle of 'hung'" } do
    it("is told after a " .. what .. " at which the script does not look", function()
      local out, err, code = script(hung
        .. ("local r = %s(1e-9)\nprint(#r.quantities.tip.value)"):format(what))
      assert.equal("3\n", out)
      assert.truthy(err:find(("softworld: note: %s at script.lua:%d is ok, but 1 of %d tolerances NOT met: "
        .. "tip; see .met of its result: "):format(text, what == "run" and 10 or 14,
        what == "run" and 2 or 1), 1, true), err)
      assert.equal(0, code)
    end)

    for _, look in ipairs{ "print(r.met)", "print(r.quantities.tip.error)", "print(r.quantities.tip.met)",
      "print(r.advice)", "print(r)", "print(r:error_bars())" } do
      it(("is not told after a %s at which it looks: %s"):format(what, look), function()
        local out, err, code = script(hung .. ("local r = %s(1e-9)\n%s"):format(what, look))
        assert.equal("", err)
        assert.equal(0, code)
        assert.is_true(#out > 1)
      end)
    end

    it("is not told if it is met: " .. what, function()
      local _, err = script(hung .. ("local r = %s(0.1)\nprint(r.quantities.tip.value)"):format(what))
      assert.equal("", err)
    end)
  end

  it("keeps its numbers", function()
    local out = script(hung .. [[
      local r = run(1e-9)
      local q = r.quantities.tip
      print(r.met, q.met, r.quantities["clamp1.force"].met, q.error > 1e-9, q.error < 1e-3, q.tolerance)
      print(#r:error_bars(), r:error_bars()[2].error == q.error)]])
    assert.equal("false\tfalse\ttrue\ttrue\ttrue\t1e-09\n2\ttrue\n", out)
  end)

  it("is an event of a study's evaluation", function()
    local out = script(hung .. [[
      local study = sw.study{ name = "s", workers = 0, parameters = { share = { 1e-9, 0.1 } },
        evaluate = function(p) return { z = run(p.share).quantities.tip.value[3] } end }
      local rows = study:sweep{ grid = 2 }
      print(rows[1].events, rows[2].events)]])
    assert.equal("tolerance: 1 of 2 tolerances NOT met: tip\tnil\n", out)
  end)
end)
