-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto": the finest run may ask for a comparison on finer edges. If its model stays, the scene is in
-- the state in which that run ended, not in that of the comparison.
local change = require "softworld.model.change"
local probe = require "softworld.model.probe"
local rod = require "spec.model.rod"
local sw = require "softworld"

describe("a run that is compared once more after its end", function()
  local elsewhere, of = change.is_elsewhere, probe.of
  local after -- computations after the run
  before_each(function()
    after = 0
    function change.is_elsewhere(_, state) return state.by == "compared" and state.compared.k == 1 end
  end)
  after_each(function() change.is_elsewhere, probe.of = elsewhere, of end)

  -- A wire that hangs between two clamps; one of them comes nearer, in a motion for which poses are compared
  -- with dynamics.
  local function drawn()
    local scene = sw.scene { name = "hung" }
    scene:force { kind = "damping", mass = 5 }
    local w = rod.wire(scene)
    scene:clamp(w, { s = 0, name = "left" })
    local right = scene:clamp(w, { s = 0.6, name = "right" })
    scene:settle()
    right:follow { relative = true, duration = 2, points = { { 0, 0, 0 }, { -0.2, 0.05, 0 } } }
    return scene, w, right
  end

  local function chosen(scene)
    return scene:run { duration = 2, model = "auto", tolerance = {
      ["right.force"] = { relative = 0.05 }, min_bend_radius = { relative = 0.05 } } }
  end

  local function hung(process)
    local scene, w, right = drawn()
    if process then scene:process(process(w)) end
    function probe.of(context, ...)
      after = after + (context.ended and 1 or 0)
      return of(context, ...)
    end
    local run = chosen(scene)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.truthy(after > 0, tostring(run:why()))
    return scene, w, right, run
  end

  local function is_in_its_state(scene, w, right, run)
    assert.equal(run.levels[#run.levels].segments[1], sw.core.segments(w))
    assert.equal(run.quantities.min_bend_radius.value, (w:min_bend_radius()))
    assert.same(run.quantities["right.force"].value, right:force())
    assert.equal(run.time, scene.time)
    for _, v in ipairs(w:velocities()) do assert.equal(0, v) end
    local last = scene:frame(scene:frame_count())
    assert.equal(3 * (sw.core.segments(w) + 1), #last.wires[1])
    assert.is_near(2, last.t, 1e-9)
  end

  it("leaves the scene, its frames, peaks and reports as that run left them", function()
    local scene, w, right, run = hung()
    is_in_its_state(scene, w, right, run)
    assert.equal(run.steps + 1, scene:frame_count()) -- one frame for each pose
    local check = run:check { limits = { ["w.min_bend_radius"] = 1e-3 } }
    assert.equal("PASS", check:row "w.min_bend_radius".verdict)
    local series = run:series()
    assert.is_near(2, series.time[#series.time], 1e-9)
    for _, column in ipairs(series.columns) do assert.equal(#series.time, #column.values, column.name) end
    assert.is_true(scene:settle().ok) -- it goes on from there
  end)

  it("does so where processes have run, by computing it again", function()
    local begun, seen = 0, nil
    local scene, w, right, run = hung(function(w)
      return function(p)
        begun = begun + 1
        p:wait(1)
        seen = sw.core.segments(w)
      end
    end)
    is_in_its_state(scene, w, right, run)
    assert.equal(sw.core.segments(w), seen)
    assert.is_true(begun > #run.levels)
  end)

  it("gives the same bits as without that comparison", function()
    local _, w, right, run = hung()
    local x, f = w:positions(), right:force()
    change.is_elsewhere = function() return false end
    local before = after
    local scene, other, hold = drawn()
    local plain = chosen(scene)
    assert.equal(before, after)
    assert.equal(#plain.levels, #run.levels)
    assert.same(other:positions(), x)
    assert.same(hold:force(), f)
  end)
end)
