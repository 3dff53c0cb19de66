-- SPDX-License-Identifier: GPL-3.0-or-later
-- The limit of an evaluation that is the same on every machine: the number of steps of its runs.
local sw = require "softworld"

local function build()
  local scene = sw.scene { name = "steps" }
  local wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 8, from = { 0, 0, 0 },
    to = { 0.3, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  return scene
end

-- Steps of 1 ms; their number follows from duration.
local function study(steps, workers, evaluate, file)
  return sw.study { name = "s", parameters = { duration = { 0.01, 0.1, unit = "s" } }, setup = build,
    workers = workers, steps = steps, file = file,
    evaluate = evaluate or function(p, scene)
      local run = scene:run { dt = 0.001, duration = p.duration }
      return { ok = run.ok, time = scene.time, steps = run.steps }
    end }
end

describe("steps of a study", function()
  -- 10, 40, 70 and 100 steps.
  it("ends evaluations that take more, with any number of workers", function()
    for _, workers in ipairs { 0, 2 } do
      local rows = study(60, workers):sweep { grid = 4 }
      assert.same({ 1.0, 1.0 }, { rows[1].ok, rows[2].ok })
      for k = 3, 4 do
        assert.equal("took more than 60 steps", rows[k].failed)
        assert.is_nil(rows[k].machine)
      end
    end
    assert.is_nil(study(100, 0):sweep { grid = 4 }[4].failed)
    assert.is_nil(study(nil, 0):sweep { grid = 4 }[4].failed)
  end)

  it("counts all runs of an evaluation, also quasistatic ones, and starts at 0 for each "
    .. "evaluation", function()
    local rows = study(30, 0, function(p, scene)
      scene:run { dt = 0.001, duration = 0.02 }
      local run = scene:run { dt = 0.001, duration = p.duration, quasistatic = true }
      return { ok = run.ok }
    end):sweep { grid = 4 } -- 20 and 10, 40, 70, 100
    assert.is_nil(rows[1].failed)
    for k = 2, 4 do assert.equal("took more than 30 steps", rows[k].failed) end
  end)

  it("is the reason of the run that it ends", function()
    local why
    study(30, 0, function(p, scene)
      local run = scene:run { dt = 0.001, duration = p.duration }
      why = run.reason
      return { any = 1 }
    end):sweep { grid = 2 } -- 10 and 100
    assert.truthy(why:find("at t = 0.03 s: took more than 30 steps", 1, true), why)
  end)

  it("does not limit runs after the study", function()
    study(15, 0):sweep { grid = 2 }
    assert.is_true(build():run { dt = 0.001, duration = 0.1 }.ok)
  end)

  it("does not reuse results of another limit", function()
    local path = os.tmpname()
    os.remove(path)
    local s = study(60, 0, nil, path)
    s:sweep { grid = 4 }
    s = study(60, 0, nil, path)
    s:sweep { grid = 4 }
    assert.equal(0, s.computed)
    s = study(80, 0, nil, path)
    local stderr = io.stderr
    io.stderr = io.tmpfile() -- luacheck: ignore
    s:sweep { grid = 4 }
    io.stderr = stderr -- luacheck: ignore
    assert.equal(4, s.computed)
    os.remove(path)
  end)

  it("reports wrong values", function()
    assert.error_matches(function() study(0, 0) end, "steps = 0 is not allowed")
    assert.error_matches(function() study(1.5, 0) end, "steps = 1.5 is not allowed")
  end)
end)

describe("p.broken", function()
  local function asked(evaluate)
    local s = sw.study { name = "s", parameters = { x = { 0, 4 } }, workers = 0, evaluate = evaluate,
      constraints = { peak = { max = 2 }, margin = { min = 1 } } }
    return s:sweep { grid = 3 }
  end

  it("names the first constraint that the results break", function()
    local got = {}
    asked(function(p)
      got[#got + 1] = { p.broken { peak = p.x }, p.broken { margin = p.x }, p:broken {} }
      return { peak = p.x, margin = 1 }
    end)
    assert.same({ nil, "margin" }, got[1])
    assert.same({}, got[2])
    assert.same({ "peak" }, got[3])
  end)

  -- Lifted by 0.3 m at 1 m/s, the hand bears more than 0.1 N within the first steps.
  it("ends a run early, and the results say by how much a constraint is broken", function()
    local hand, wire
    local s = sw.study { name = "s", parameters = { speed = { 0.01, 1, unit = "m/s" } }, workers = 0,
      setup = function()
        local scene = build()
        wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 8, from = { 1, 0, 0.3 },
          to = { 1, 0, 0 } }
        hand = scene:gripper { name = "hand" }
        return scene
      end,
      evaluate = function(p, scene)
        scene:process(function()
          hand:grasp(wire, { s = 0 })
          hand:move { by = { 0, 0, 0.3 }, speed = p.speed }
        end)
        scene:observe { every = 0.01, call = function(observer)
          if p.broken { peak = hand.peak_force } then observer:stop "too hard" end
        end }
        local run = scene:run { dt = 0.005, duration = 0.3 }
        assert(run.ok, run.reason)
        return { peak = hand.peak_force, time = scene.time }
      end, constraints = { peak = { max = 0.07, unit = "N" } } }
    local rows = s:sweep { grid = 2 }
    assert.is_true(rows[1].pass and math.abs(rows[1].time - 0.3) < 1e-9, rows[1].peak)
    assert.is_true(not rows[2].pass and rows[2].time < 0.2 and rows[2].peak > 0.07, rows[2].peak)
  end)

  it("reports wrong arguments", function()
    for words, results in pairs { ["did you mean 'peak'?"] = { peek = 1 }, ["p.broken takes results"] = 3,
      ["p.broken: peak"] = { peak = "x" } } do
      local fine, why = pcall(asked, function(p)
        assert(p.broken(results))
        return { peak = 1, margin = 1 }
      end)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(words, 1, true), why)
    end
  end)
end)
