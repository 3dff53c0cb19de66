-- SPDX-License-Identifier: GPL-3.0-or-later
-- The limit of an evaluation that is the same on every machine: so many steps of its runs.
local sw = require "softworld"

local function build()
  local scene = sw.scene { name = "steps" }
  local wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 8, from = { 0, 0, 0 },
    to = { 0.3, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  return scene
end

-- Steps of 1 ms: as many as duration tells.
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
  it("ends evaluations that try more, with any number of workers", function()
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

  it("counts all runs of an evaluation, slow handling too, and each evaluation anew", function()
    local rows = study(30, 0, function(p, scene)
      scene:run { dt = 0.001, duration = 0.02 }
      local run = scene:run { dt = 0.001, duration = p.duration, quasistatic = true }
      return { ok = run.ok }
    end):sweep { grid = 4 } -- 20 and 10, 40, 70, 100
    assert.is_nil(rows[1].failed)
    for k = 2, 4 do assert.equal("took more than 30 steps", rows[k].failed) end
  end)

  it("tells a run why it ended", function()
    local why
    study(30, 0, function(p, scene)
      local run = scene:run { dt = 0.001, duration = p.duration }
      why = run.reason
      return { any = 1 }
    end):sweep { grid = 2 } -- 10 and 100
    assert.truthy(why:find("at t = 0.03 s: took more than 30 steps", 1, true), why)
  end)

  it("is no limit for what comes after the study", function()
    study(15, 0):sweep { grid = 2 }
    assert.is_true(build():run { dt = 0.001, duration = 0.1 }.ok)
  end)

  it("keeps what another limit gave apart", function()
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

  it("says what is wrong", function()
    assert.error_matches(function() study(0, 0) end, "steps = 0 is not allowed")
    assert.error_matches(function() study(1.5, 0) end, "steps = 1.5 is not allowed")
  end)
end)
