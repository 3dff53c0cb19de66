-- SPDX-License-Identifier: GPL-3.0-or-later
-- wire:remodel of a wire between two grips: they go on holding it where they held it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L, WIDTH = 0.2, 0.01

-- A rod between two grips, stretched, twisted and bent.
local function gripped(segments)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 2e7, nu = 0.3, density = 1200, radius = 0.003, from = { 0, 0, 0 },
    to = { L, 0, 0 }, segments = segments }
  scene:grip(wire, { s = WIDTH, width = WIDTH })
  local far = scene:grip(wire, { s = L - WIDTH, width = WIDTH })
  local at = far:pose()
  far:pose({ at[1] + 0.004, at[2], at[3] + 0.01 }, { axis = { 1, 0, 0 }, angle = 0.5 })
  assert.is_true(scene:settle().ok)
  return scene, wire, far
end

local function check(expected, hold, force, moment)
  local F, M = hold:force(), hold:moment()
  t.near(0, t.distance(expected:force(), F) / t.norm(F), force, "force")
  t.near(0, t.distance(expected:moment(), M) / t.norm(M), moment, "moment")
end

describe("wire:remodel of a wire between grips", function()
  -- The same equilibrium as that of a wire with these segments from the start: the nodes at the grips' ends
  -- stay where they were. They lay up to 0.5 mm beside: the moment was up to 25 % off.
  for _, segments in ipairs{ 30, 31, 60 } do
    it("has the loads of a new wire: " .. segments .. " segments", function()
      local scene, wire, far = gripped(30)
      wire:remodel{ model = "rod", segments = segments }
      assert.is_true(scene:settle().ok)
      local _, _, fresh = gripped(segments)
      check(fresh, far, 1e-4, 1e-3)
    end)
  end

  -- The joined place is a node of the new rod too. The branch was joined to the nearest node, 3.7 mm beside
  -- it: 25 J came from nowhere, and the branch moved there. The gravity energy of the curve through the nodes
  -- changes by some uJ.
  it("keeps a branch where it is joined", function()
    local function harness(segments)
      local scene = sw.scene{}
      local function wire(from, to, n)
        return scene:wire{ E = 2e7, density = 1200, radius = 0.002, from = from, to = to, segments = n }
      end
      local trunk = wire({ 0, 0, 0 }, { 0.3, 0, 0 }, segments)
      local branch = wire({ 0.15, 0, 0 }, { 0.15, 0.1, 0 }, 15)
      scene:clamp(trunk, { s = 0 })
      scene:clamp(trunk, { s = 0.3 })
      scene:join{ ends = { { trunk, s = 0.15 }, { branch, s = 0 } } }
      assert.is_true(scene:settle().ok)
      return scene, trunk, branch
    end
    local scene, trunk, branch = harness(30)
    t.below(1e-5, math.abs(trunk:remodel{ model = "rod", segments = 41 }.energy_change), "energy change")
    assert.is_true(scene:settle().ok)
    local _, _, fresh = harness(41)
    t.near(0, t.distance(fresh:position(0.1), branch:position(0.1)), 1e-7, "end of the branch")
  end)

  -- Rings of the mesh are 1.3 mm apart, and the grips hold whole rings: that shifts them by up to 0.1 mm, a
  -- thousandth of the free length, which the force follows, and the moment with its square. The moment was
  -- 17 % off.
  it("comes back from a mesh", function()
    local scene, wire, far = gripped(60)
    wire:remodel{ model = "radial" }
    assert.is_true(scene:settle().ok)
    wire:remodel{ model = "rod", segments = 60 }
    assert.is_true(scene:settle().ok)
    local _, _, fresh = gripped(60)
    check(fresh, far, 4e-3, 2e-2)
  end)

  -- A grip keeps a bent wire straight between its nodes. More nodes on the wire's curve would need edges that
  -- are longer by k^2 w^2/24, which the grip does not let them be: 308 and 640 N in place of 0.02 N.
  it("does not stretch a bent wire in a grip", function()
    for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5" } do
      for _, segments in ipairs{ 30, 86, 172 } do
        local scene = sw.scene{}
        local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = 43 }
        scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
        scene:clamp(wire, { s = 0 })
        scene:clamp(wire, { s = 0.4 }):follow{ relative = true, duration = 1,
          points = { { 0, 0, 0 }, { -0.2, 0.03, 0.01 } } }
        t.fine(scene:run{ duration = 2.5 })
        scene:grip(wire, { s = 0.2017, width = 0.01 })
        t.fine(scene:run{ duration = 0.2 })
        local tension, weight = wire:max_tension(), wire.beam.mass_per_length * 9.81 * wire.length
        wire:remodel{ model = "rod", segments = segments }
        t.fine(scene:run{ duration = 0.1 })
        -- Some of the weight: a stretch by 1e-6 is more.
        t.near(tension, wire:max_tension(), weight, ("largest tension, %d segments [N]"):format(segments))
      end
    end
  end)

  -- The lowest corners of a section of solid elements lie 0.08 mm outside of the circle, as contact feels
  -- them (their spheres reach 0.24 mm). The clamp holds them in the table, which presses with ten times the
  -- wire's weight. If the wire was remodelled before the first step, nothing said so.
  it("tells that a clamp pushes the new section into a table", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 1e7, nu = 0.4, density = 1200, radius = 0.003, from = { 0, 0, 0.003 },
      to = { L, 0, 0.003 }, segments = 20 }
    scene:obstacle{ name = "table", shape = "plane" }
    local clamp = scene:clamp(wire, { s = 0, name = "clamp" })
    wire:remodel{ model = "radial", body = "solid" }
    local depth = 0.5 * wire:width(L / 2, { 0, 0, 1 }) - 0.003 -- of the section without load
    assert.is_true(scene:settle().ok)
    local run = scene:run{ duration = 0.02, dt = 0.01 }
    local text = run.events[1] and run.events[1].text or "no event"
    assert.truthy(text:find("clamp 'clamp' pushes wire 'wire1' 0.0", 1, true), text)
    t.near(depth, run.events[1].value, 1e-3 * depth, "depth [m]") -- two ways to the same corners
    assert.equal("table", clamp:crash().obstacle)
  end)
end)
