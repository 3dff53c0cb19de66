-- SPDX-License-Identifier: GPL-3.0-or-later
-- Twisted wires are drawn taut by 2 % of their length. They press each other all along, and the more the
-- tauter they are. The pull follows from the stretch: it must not depend on the step or the mesh, no step
-- may be redone for energy, and the wires must not sink into each other.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, PULL = 0.2, 0.02 -- over the radius in mm [m]; of the length [-]

-- Returns the mean pull over EA times the stretch, the run's ledger, and the distance of the first two axes
-- in the middle over the radius.
local function drawn(r, strands, turns, segments, dt)
  local scene, k = sw.scene{}, r / 1e-3
  local L, wires, ends = LENGTH * k, {}, {}
  local around = 1.02 * r / math.sin(math.pi / strands) -- radius of the helices [m]
  for one = 0, strands - 1 do
    local path = {}
    for i = 0, 400 do
      local a = 2 * math.pi * (turns * i / 400 + one / strands)
      path[#path + 1] = { L * i / 400, around * math.cos(a), around * math.sin(a) }
    end
    local w = scene:wire{ E = 1e9, density = 3000, radius = r, path = path, segments = segments }
    scene:clamp(w, { s = 0 })
    wires[#wires + 1], ends[#ends + 1] = w, scene:clamp(w, { s = w.length })
  end
  scene:wire_contact{ friction = 0.2 }
  assert.truthy(scene:settle().ok)
  for _, clamp in ipairs(ends) do
    clamp:follow{ points = { { 0, 0, 0 }, { PULL * L, 0, 0 } }, duration = 0.5, relative = true }
  end
  local run = t.fine(scene:run{ dt = dt * math.sqrt(k), duration = 0.6 })
  local a, b = wires[1]:position(wires[1].length / 2), wires[2]:position(wires[2].length / 2)
  local pull = 0
  for _, clamp in ipairs(ends) do pull = pull + clamp:force()[1] / strands end
  local apart = ((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2) ^ 0.5
  return pull / (PULL * 1e9 * math.pi * r ^ 2), run:ledger(), apart / r
end

describe("twisted wires that are drawn taut", function()
  for _, case in ipairs{ { 1.2e-3, 2, 3 }, { 1.2e-3, 2, 5 }, { 1.2e-3, 2, 8 }, { 1e-4, 2, 4 },
    { 1e-3, 3, 3 } } do
    local r, strands, turns = table.unpack(case)
    it(("need one pull at all steps and meshes: %d of %g mm, %d turns"):format(strands, r * 1e3, turns),
      function()
        local fine = drawn(r, strands, turns, 160, 0.002)
        for _, how in ipairs{ { 80, 0.01 }, { 120, 0.01 }, { 120, 0.002 }, { 80, 0.0005 } } do
          local pull, ledger, apart = drawn(r, strands, turns, how[1], how[2])
          local what = (", %d segments, %g ms"):format(how[1], how[2] * 1e3)
          t.share(fine, pull, 0.015, "pull over EA times the stretch" .. what)
          t.below(0.01, ledger.redone.count / ledger.steps, "redone steps" .. what)
          t.below(1e-4, ledger.gained / ledger.play, "energy from nowhere" .. what)
          t.above(1.94, apart, "distance of the axes over the radius" .. what)
        end
      end)
  end
end)

-- The pull of stiff cables shows how deep touches are: 4 % of the radius, which was allowed, took 5 % of it.
-- Fine steps: 332 N.
describe("a twisted pair of cables that is drawn taut", function()
  local function pull_of(segments, dt)
    local scene, ends = sw.scene{}, {}
    local r = sw.cable "GXL 1.5".outer_diameter.value / 2
    local L = 60 * r
    for one = 0, 1 do
      local path = {}
      for i = 0, 400 do
        local a = 2 * math.pi * (1.5 * i / 400 + one / 2)
        path[#path + 1] = { L * i / 400, 1.02 * r * math.cos(a), 1.02 * r * math.sin(a) }
      end
      local w = scene:wire{ cable = "GXL 1.5", path = path, segments = segments }
      scene:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 }
      scene:clamp(w, { s = 0 })
      ends[#ends + 1] = scene:clamp(w, { s = w.length })
    end
    scene:wire_contact{ friction = 0.3 }
    assert.truthy(scene:settle().ok)
    for _, clamp in ipairs(ends) do
      clamp:follow{ points = { { 0, 0, 0 }, { 0.003 * L, 0, 0 } }, duration = 0.5, relative = true }
    end
    t.fine(scene:run{ dt = dt, duration = 0.6 })
    return (ends[1]:force()[1] + ends[2]:force()[1]) / 2
  end

  it("needs the same pull at all steps", function()
    local fine = pull_of(60, 0.0003)
    for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
      t.share(fine, pull_of(60, dt), 0.015, ("pull at %g ms [N]"):format(dt * 1e3))
    end
  end)
end)
