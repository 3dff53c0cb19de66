-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses that fail on the way on coarse edges only, as those of a harness do whose edges are as long as its
-- bends: finer edges are looked at before dynamics are taken.
local hung = require "spec.model.hung"

-- Runs, and says that the run failed after its iterations, or after `most`.
local function failing(most)
  return function(run_once, scene, options, name)
    local run = run_once(scene, options, name)
    return { ok = false, reason = "stuck, as this spec has it", steps = run.steps, start = run.start,
      iterations = most or run.iterations, time = run.time, jumps = run.jumps, events = {}, wall = run.wall,
      cpu = run.cpu }
  end
end

-- True for poses on fewer segments.
local function poses_below(count)
  return function(options, segments) return options.quasistatic and segments < count end
end

-- The wire has 6 segments on the coarsest level, then 12, 24 and so on.
describe("model = 'auto' where poses fail on the way on coarse edges", function()
  for _, first in ipairs { 12, 24 } do
    it(("begins with poses of %d segments"):format(first), function()
      local usual, run = hung.run(), hung.run(failing(), nil, poses_below(first))
      local why = tostring(run:why())
      assert.equal("poses", run.model.motion, why)
      assert.is_true(run.met, why)
      assert.equal(first, run.levels[1].segments[1])
      local away, bars = hung.apart(usual, run)
      assert.is_true(away <= bars, ("%.3g N apart"):format(away))
    end)
  end

  it("takes dynamics on all levels if poses fail on each coarse level", function()
    local run = hung.run(failing(), nil, poses_below(48))
    local why = tostring(run:why())
    assert.equal("dynamic", run.model.motion, why)
    assert.truthy(why:find("poses cannot be computed: stuck", 1, true), why)
    assert.equal(6, run.levels[1].segments[1])
  end)

  it("takes dynamics at once if failing again would cost more than dynamics", function()
    local poses = 0
    local run = hung.run(function(...)
      poses = poses + 1
      return failing(1e7)(...)
    end, nil, poses_below(12))
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
    assert.equal(1, poses)
  end)

  it("takes dynamics on all levels if poses of the first good level do not suffice", function()
    local run = hung.run(failing(), { duration = 0.5 }, poses_below(12))
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
    assert.equal(6, run.levels[1].segments[1])
  end)

  it("computes no level beyond the script's finest one", function()
    local run = hung.run(failing(), { levels = 3 }, poses_below(12))
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
    assert.is_true(#run.levels <= 3)
  end)
end)
