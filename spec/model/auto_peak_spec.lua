-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto" asked for a peak, such as the smallest bend radius of a run. On coarse edges the peak of a
-- fast motion may be at another place and time than on fine ones, and the same with poses and dynamics. And a
-- bar of poses that comes from edges is not shortened by dynamics, which have the same edges.
local sw = require "softworld"

-- A wire is laid into a loop within 1 s: one end goes beside the other and turns by 270 degrees. On 8 edges
-- poses and dynamics have the same smallest radius, to 0.01 %; from 16 edges on they are 2.4 % apart.
local function looped(model, share, turned)
  local scene, off = sw.scene { name = "looped" }, 0.0055
  local function at(x, y, z) return turned and { -y, x, z } or { x, y, z } end
  local w = scene:wire { name = "w", model = model, E = 50e6, density = 1500, radius = 0.0025, segments = 32,
    from = { 0, 0, 0 }, to = at(0.5, 0, 0) }
  scene:clamp(w, { s = 0 })
  scene:clamp(w, { s = 0.5 }):follow { relative = true, duration = 1,
    points = { { 0, 0, 0 }, at(-0.25, 0.12, off), at(-0.495, 0.02, off) },
    turn = { axis = { 0, 0, 1 }, angle = 1.5 * math.pi } }
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 1, tolerance = { min_bend_radius = { relative = share } } }
end

describe("model = 'auto' asked for the smallest bend radius of a fast motion", function()
  local truth = looped(nil, 0.002).quantities.min_bend_radius -- dynamics, 57.8 mm +- 0.1 mm; poses 59.2 mm

  for _, share in ipairs { 0.01, 0.03 } do
    for _, turned in ipairs { false, true } do
      it(("to %g %%%s has a true bar"):format(100 * share, turned and ", turned," or ""), function()
        local run = looped("auto", share, turned)
        local q = run.quantities.min_bend_radius
        assert.is_true(math.abs(q.value - truth.value) <= q.error + truth.error, tostring(run:why()))
        assert.is_true(run.met, tostring(run:why()))
        if share == 0.01 then assert.equal("dynamic", run.model.motion, tostring(run:why())) end
      end)
    end
  end
end)

-- A cable snaps into a clip, with the radius asked for to 1 %. On all edges poses and dynamics are within 1 %
-- of the tolerance. The radius converges by the second order of the edges; five levels leave a bar of 2 %.
describe("model = 'auto' where the bar of poses is too long because of the edges", function()
  it("does not compute dynamics, whose bar is longer on the same edges", function()
    local scene, span, high, down = sw.scene { name = "clipped" }, 0.1936165, 0.035, 0.0640425
    scene:clip { name = "clip", at = { span / 2, 0, 0 }, width = 0.01, insertion = 2.84743,
      retention = 8.54229, friction = 0.25 }
    local w = scene:wire { name = "w", model = "auto", E = 60e6, density = 1500, radius = 0.0025,
      segments = 32, from = { 0, 0, high }, to = { span, 0, high } }
    for s, name in pairs { [0] = "left", [span] = "right" } do
      scene:clamp(w, { s = s, name = name }):follow { relative = true, duration = 4,
        points = { { 0, 0, 0 }, { 0, 0, -down } } }
    end
    scene:force { kind = "damping", mass = 5 }
    scene:settle()
    local run = scene:run { duration = 4, tolerance = { min_bend_radius = { relative = 0.01 } } }
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_false(run.met)
    local q = run.quantities.min_bend_radius
    assert.is_true(q.error > q.tolerance and q.error < 2 * q.tolerance, tostring(run:why()))
    assert.is_true(math.abs(q.value - 0.017281) <= q.error) -- dynamics on 128 edges
  end)
end)
