-- SPDX-License-Identifier: GPL-3.0-or-later
-- An evaluation computed again has the same bits, whoever computed it first, and returns its run for
-- inspection.
local sw = require "softworld"
local program = require "host.program"

local wire, hand

local function setup_scene()
  local scene = sw.scene { name = "lift" }
  scene:obstacle { shape = "plane", friction = 0.3 }
  wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 10, from = { 0, 0, 0.002 },
    to = { 0.3, 0, 0.002 } }
  hand = scene:gripper { name = "hand" }
  return scene
end

local function evaluate(p, scene)
  local push = 0.1 * p.random()
  if p.height < 0.05 then error("too low", 0) end
  scene:process(function()
    hand:grasp(wire, { s = 0.15 })
    hand:move { by = { push, 0, p.height }, speed = 0.5 }
  end)
  local run = scene:run { dt = 0.01, duration = 0.1 }
  return { force = hand.peak_force, luck = math.random(), time = run.time }
end

local function study(changes)
  local args = { name = "lift", workers = 2, parameters = { height = { 0.02, 0.2, unit = "m" } },
    setup = setup_scene, evaluate = evaluate, constraints = { force = { max = 1e3 } } }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

describe("study:again", function()
  teardown(program.clean)

  it("gives the same bits as a worker, the results of evaluate, and the run", function()
    local s = study()
    local rows = s:sweep { kind = "latin", count = 12 }
    for _, row in ipairs(rows) do
      if not row.failed then
        local found, run = s:again(row.number)
        for _, name in ipairs { "force", "luck", "time" } do assert.is_true(found[name] == row[name]) end
        assert.is_true(run.ok and run.time == row.time)
      end
    end
    local _, run = s:again(rows[12])
    local path = program.folder() .. "/again.html"
    run:report(path)
    assert.truthy(program.read(path):find("<html", 1, true))
    -- and the script's own random numbers do not depend on the chosen evaluation
    math.randomseed(5)
    s:again(12)
    local expected = math.random()
    math.randomseed(5)
    s:again(11)
    assert.equal(expected, math.random())
  end)

  it("finds parts that only the journal has", function()
    local path = program.folder() .. "/s.study"
    local s = study { file = path }
    s:sweep { count = 4 }
    s:spread { count = 4 }
    local rows = s:table()
    s = study { file = path }
    for _, row in ipairs(rows) do
      if not row.failed then assert.is_true(s:again(row.number, row.part).luck == row.luck) end
    end
    assert.equal(0, s.computed)
    assert.error_matches(function() s:again(2) end,
      "study 'lift': evaluation 2 is in the parts 1 2; give the part: study:again%(2, 1%)")
  end)

  it("gives the reason of a failed evaluation", function()
    local s = study()
    local failed
    for _, row in ipairs(s:sweep { count = 16 }) do failed = failed or row.failed and row end
    assert.equal("too low", failed.failed)
    local real, said = io.stderr, ""
    io.stderr = { write = function(_, text) said = said .. text end } -- luacheck: ignore
    local found = s:again(failed)
    io.stderr = real -- luacheck: ignore
    assert.is_nil(found)
    assert.equal(("study 'lift': evaluation 1.%d failed: too low\n"):format(failed.number), said)
  end)

  it("says when the result differs", function()
    local count = 0
    local s = study { workers = 0, setup = nil, evaluate = function(p)
      count = count + 1
      return { force = p.height, calls = count }
    end }
    s:sweep { count = 3 }
    assert.error_matches(function() s:again(2) end, "evaluation 1.2 gives another result: calls is 4 and was "
      .. "2; evaluate depends on more than its parameters and the seed")
  end)

  it("reports wrong arguments", function()
    local s = study()
    assert.error_matches(function() s:again(1) end, "study 'lift': there is no evaluation 1")
    s:sweep { count = 3 }
    assert.error_matches(function() s:again(4, 1) end, "there is no evaluation 1.4")
    for _, wrong in ipairs { 0, 1.5, "1", {}, false } do
      assert.error_matches(function() s:again(wrong) end, "study:again: number = .* is not allowed; it must")
    end
    assert.error_matches(function() s:again(1, "x") end, "study:again: part = 'x' is not allowed")
    assert.error_matches(function() s:again() end, "study:again: number = ")
  end)
end)
