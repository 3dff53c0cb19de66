-- SPDX-License-Identifier: GPL-3.0-or-later
-- Twisted wires are drawn taut by 2 % of their length, cables by 0.3 %. They press each other all along, and
-- the more the tauter they are. The pull follows from the stretch: it must not depend on the step or the
-- mesh, no step may be redone for energy, and the wires must not sink into each other.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local vec = require "softworld.vec"

local SOFT = { E = 1e9, density = 3000 }

-- Twists strands of a wire on a length, settles them, and draws them by a share of it in 0.5 s. Returns the
-- run of 0.6 s, the mean pull [N], and the distance of the first two axes in the middle over the radius.
local function drawn(kind, r, length, strands, turns, share, segments, dt)
  local scene, wires, ends = sw.scene{}, {}, {}
  local around = 1.02 * r / math.sin(math.pi / strands) -- radius of the helices [m]
  for one = 0, strands - 1 do
    local path = {}
    for i = 0, 400 do
      local a = 2 * math.pi * (turns * i / 400 + one / strands)
      path[#path + 1] = { length * i / 400, around * math.cos(a), around * math.sin(a) }
    end
    local w = scene:wire{ cable = kind.cable, E = kind.E, density = kind.density,
      radius = not kind.cable and r or nil, path = path, segments = segments }
    if kind.cable then scene:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 } end
    scene:clamp(w, { s = 0 })
    wires[#wires + 1], ends[#ends + 1] = w, scene:clamp(w, { s = w.length })
  end
  scene:wire_contact{ friction = 0.2 }
  assert.truthy(scene:settle().ok)
  for _, clamp in ipairs(ends) do
    clamp:follow{ points = { { 0, 0, 0 }, { share * length, 0, 0 } }, duration = 0.5, relative = true }
  end
  local run, pull = t.fine(scene:run{ dt = dt, duration = 0.6 }), 0
  for _, clamp in ipairs(ends) do pull = pull + clamp:force()[1] / strands end
  local a, b = wires[1]:position(wires[1].length / 2), wires[2]:position(wires[2].length / 2)
  return run, pull, vec.norm(vec.sub(a, b)) / r
end

describe("twisted wires that are drawn taut", function()
  for _, case in ipairs{ { 1.2e-3, 2, 3 }, { 1.2e-3, 2, 5 }, { 1.2e-3, 2, 8 }, { 1e-4, 2, 4 },
    { 1e-3, 3, 3 } } do
    local r, strands, turns = table.unpack(case)
    it(("need one pull at all steps and meshes: %d of %g mm, %d turns"):format(strands, r * 1e3, turns),
      function()
        local k, share = r / 1e-3, 0.02
        local scale = share * SOFT.E * math.pi * r ^ 2 -- EA times the stretch [N]
        local function at(segments, dt)
          local run, pull, apart = drawn(SOFT, r, 0.2 * k, strands, turns, share, segments, dt * math.sqrt(k))
          return pull / scale, run:ledger(), apart
        end
        local fine = at(160, 0.002)
        for _, how in ipairs{ { 80, 0.01 }, { 120, 0.01 }, { 120, 0.002 }, { 80, 0.0005 } } do
          local pull, ledger, apart = at(how[1], how[2])
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
describe("a twisted pair of cables that is drawn taut", function()
  for _, name in ipairs{ "GXL 1.5", "FLRY-B 2.5", "H07V-K 4" } do
    it("needs the same pull at all steps: " .. name, function()
      local r = sw.cable(name).outer_diameter.value / 2
      local function at(dt)
        return select(2, drawn({ cable = name }, r, 60 * r, 2, 1.5, 0.003, 60, dt))
      end
      local fine = at(0.0005)
      for _, dt in ipairs{ 0.02, 0.01, 0.005, 0.002 } do
        t.share(fine, at(dt), 0.015, ("pull at %g ms [N]"):format(dt * 1e3))
      end
    end)
  end
end)
