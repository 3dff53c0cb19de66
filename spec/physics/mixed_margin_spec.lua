-- SPDX-License-Identifier: GPL-3.0-or-later
-- The margin of a frozen grip: the load on the rigid grip over the most that the pads could bear, forces
-- and moments together.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r, mu, force, width, s = 0.003, 0.3, 20, 0.02, 0.03

-- A weightless wire is held near its end, by pads or by a frozen grip. Each step adds a dead force at a
-- distance `arm` from the pads and calls look(gripper, wire, step) when the wire rests again; look returns
-- true to stop.
local function load(frozen, by, arm, steps, look)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 1e9, nu = 0.3, density = 1200, radius = r, from = { 0, 0, 0 },
    to = { 0.12, 0, 0 }, segments = 48 }
  scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
  local g = scene:gripper{ name = "hand", pads = { width = width, friction = mu, opening = 3 * r } }
  local touches
  scene:process(function(p)
    g:grasp(wire, { s = s, approach = "mixed", force = force, freeze = false, margin = 0.9 })
    p:wait(0.2)
    touches = g.tool:touches()
    if frozen then
      g:freeze()
      if frozen == "for good" then g.tool:limit(1e3) end
    end
    for k = 1, steps do
      scene:force{ kind = "point", on = wire, s = s + arm, force = by }
      p:wait(0.3)
      if look(g, wire, k) then return end
    end
  end)
  t.fine(scene:run{ dt = 0.01 })
  return g, wire, touches
end

-- Returns a load in the pads' plane over the largest that the touches can resist (limit surface): the
-- largest ratio of the load's power to that of friction over all motions (x, z, turn), found by trying.
local function in_plane(touches, f, m)
  local sum, cx, cz, size = 0, 0, 0, 0
  for _, touch in ipairs(touches) do
    sum, cx, cz = sum + touch.normal, cx + touch.normal * touch.at[1], cz + touch.normal * touch.at[3]
  end
  cx, cz = cx / sum, cz / sum
  for _, touch in ipairs(touches) do
    size = size + touch.normal * ((touch.at[1] - cx) ^ 2 + (touch.at[3] - cz) ^ 2) / sum
  end
  size = size ^ 0.5
  local moment = m[2] - (cz * f[1] - cx * f[3]) -- about y, the pads' normal
  local function value(a, b)
    local vx, vz, w = math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), math.sin(a) / size
    local resisted = 0
    for _, touch in ipairs(touches) do
      local x, z = touch.at[1] - cx, touch.at[3] - cz
      resisted = resisted + mu * touch.normal * ((vx + w * z) ^ 2 + (vz - w * x) ^ 2) ^ 0.5
    end
    return (f[1] * vx + f[3] * vz + moment * w) / resisted
  end
  local best, a, b, step = -math.huge, 0, 0, math.pi / 30
  for i = -15, 15 do
    for j = -30, 29 do
      local v = value(i * step, j * step)
      if v > best then best, a, b = v, i * step, j * step end
    end
  end
  while step > 1e-6 do
    local better = false
    for _, d in ipairs{ { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 }, { 1, 1 }, { -1, -1 }, { 1, -1 },
      { -1, 1 } } do
      local v = value(a + d[1] * step, b + d[2] * step)
      if v > best then best, a, b, better = v, a + d[1] * step, b + d[2] * step, true end
    end
    if not better then step = step / 2 end
  end
  return best
end

describe("the margin of a frozen grip", function()
  it("equals the force along the pads over friction where there is no moment", function()
    load("for good", { 2, 0, 0 }, 0.06, 3, function(g, _, k)
      local state = g:state()
      t.share(2 * mu * force, state.most, 5e-3, "friction of both pads") -- jaws meet it to 0.1 %
      -- the forces of both pads differ a little: 6e-4 without any load
      t.near(2 * k / state.most, state.margin, 1e-3, ("at %d N"):format(2 * k))
    end)
  end)

  it("is that of the limit surface for force and moment together", function()
    for _, row in ipairs{ { 0, 0.3, 0.06 }, { 2, 0.3, 0.06 }, { 3, 3, 0.015 }, { 0, 5, -0.005 } } do
      local seen
      local _, _, touches = load("for good", { row[1], 0, row[2] }, row[3], 1, function(g)
        seen = { g:force{ axes = "gripper" }, g:moment{ axes = "gripper" }, g:state().margin }
      end)
      local wanted = in_plane(touches, seen[1], seen[2])
      t.above(0.1, wanted, "the load counts")
      -- both searches end at 1e-4 of the largest value
      t.share(wanted, seen[3], 2e-3, ("by %g, %g N at %g m"):format(row[1], row[2], row[3]))
    end
  end)

  it("exceeds 1 where the pads lose the wire, which the force alone does not show", function()
    -- held by pads, a wire turned by more than 3 degrees is lost
    local lost
    load(false, { 0, 0, 0.1 }, 0.06, 13, function(_, wire, k)
      local angle = (wire:position(s + width / 2)[3] - wire:position(s - width / 2)[3]) / width
      lost = angle > 0.05 and 0.1 * k or nil
      return lost
    end)
    local at, margin, friction
    local g = load("for good", { 0, 0, 0.1 }, 0.06, 12, function(g, _, k)
      local state = g:state()
      if state.margin > 1 and not at then
        at, margin, friction = 0.1 * k, state.margin, math.abs(g:force()[3]) / state.most
      end
    end)
    assert.is_truthy(g.frozen)
    assert.is_truthy(lost and at)
    -- 1.1 N in both cases: within one step of the load
    t.near(lost, at, 0.1001, "force at which the pads lose it")
    t.below(1.1, margin, "margin then")
    t.below(0.1, friction, "the force over friction then")
  end)

  it("gives the wire back to the pads before they slip", function()
    local g, wire = load(true, { 0, 0, 0.1 }, 0.06, 10, function(g) return not g.frozen end)
    assert.is_nil(g.frozen)
    local e = g.events[#g.events]
    assert.equal("thawed", e.kind)
    t.above(0.9, e.margin, "margin")
    t.below(1, e.margin, "margin")
    t.below(0.02, math.abs(wire:position(s + width / 2)[3]), "place of the wire between the pads")
    t.below(1e-4, g:state().slip, "slip")
  end)

  it("is 1 at the moment that lifts one edge of the pads", function()
    -- For pads that press evenly sum N_i |x_i| is N width/4. Friction helps at the lever of the height, by
    -- mu N height/2, an eighth of it. Pads that press more at their edges bear more.
    local most
    load("for good", { 0, 1, 0 }, 0.06, 3, function(g, _, k) most = k * 1 * 0.06 / g:state().margin end)
    t.above(2 * force * width / 4, most, "moment at a margin of 1")
    t.below(2 * force * width / 3, most, "moment at a margin of 1")
  end)
end)
