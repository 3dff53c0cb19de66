-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that turn between pads, about the pads' common normal. Flat pads of width w, each pressed on by F
-- with even pressure p = F/w, resist up to the moment 2 (integral of mu p |x|) = 2 mu F w/4.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local vec = require "softworld.vec"
local t = require "spec.physics.tools"

local ARM, STEPS = 0.05, 20 -- lever of each force of the couple [m]; number of forces [-]

-- Loads a weightless wire between pads with `share` of that moment, and a pull along and across the wire.
local function load(p)
  local way, width, mu, force = vec.unit(p.way or { 1, 0, 0 }), p.width, p.mu, p.force
  local scene, length = sw.scene{ gravity = { 0, 0, 0 } }, 0.2
  local wire = scene:wire{ cable = p.cable, from = { 0, 0, 0 }, to = vec.scale(way, length),
    segments = math.floor(length / p.edge + 0.5) }
  scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
  local hand = scene:gripper{ pads = p.pads or { width = width, friction = mu } }
  local s, couple = 0.1 + (p.shift or 0), p.share * 2 * mu * force * (p.lever or width / 4) / (2 * ARM)
  local out = { hand = hand, EI = wire.beam.EI }
  scene:process(function(process)
    hand:grasp(wire, { s = s, approach = "plates", force = force })
    process:wait(0.3)
    local _, q = hand.tool:pose()
    local x, z = vec.rotate(q, { 1, 0, 0 }), vec.rotate(q, { 0, 0, 1 })
    for _ = 1, STEPS do
      scene:force{ kind = "point", on = wire, s = s + ARM, force = vec.scale(z, couple / STEPS) }
      scene:force{ kind = "point", on = wire, s = s - ARM, force = vec.scale(z, -couple / STEPS) }
      local pull = vec.add(vec.scale(x, p.along or 0), vec.scale(z, p.across or 0))
      scene:force{ kind = "point", on = wire, s = s,
        force = vec.scale(pull, 2 * mu * force / STEPS) }
      process:wait(0.02)
    end
    process:wait(0.5)
    local a, b = wire:position(s - width / 2), wire:position(s + width / 2)
    local chord = vec.sub(b, a)
    out.state, out.touches = hand:state(), hand.tool:touches()
    out.angle = math.atan(vec.dot(chord, z), vec.dot(chord, way))
  end)
  out.run = t.fine(scene:run{ dt = p.dt or 0.01 })
  return out
end

-- Returns the largest ratio, over all motions (x, z, turn) in the pads' plane, of the power of the touches'
-- own friction to sum mu N |velocity|. Found by trying.
local function in_plane(touches, mu)
  local f, m, list, sum, middle, size = { 0, 0 }, 0, {}, 0, { 0, 0 }, 0
  for i, touch in ipairs(touches) do
    list[i] = { touch.acts[1], touch.acts[3], N = touch.normal, touch.force[1], touch.force[3] }
    sum = sum + touch.normal
    for k = 1, 2 do middle[k] = middle[k] + touch.normal * list[i][k] end
  end
  for k = 1, 2 do middle[k] = middle[k] / sum end
  for _, one in ipairs(list) do
    one[1], one[2] = one[1] - middle[1], one[2] - middle[2]
    size = size + one.N * (one[1] ^ 2 + one[2] ^ 2) / sum
    f[1], f[2], m = f[1] + one[3], f[2] + one[4], m + one[2] * one[3] - one[1] * one[4]
  end
  size = size ^ 0.5
  local function ratio(a, b)
    local x, z, w = math.cos(a) * math.cos(b), math.cos(a) * math.sin(b), math.sin(a) / size
    local resisted = 0
    for _, one in ipairs(list) do
      resisted = resisted + mu * one.N * ((x + w * one[2]) ^ 2 + (z - w * one[1]) ^ 2) ^ 0.5
    end
    return (f[1] * x + f[2] * z + m * w) / resisted
  end
  local best, a, b, step = -math.huge, 0, 0, math.pi / 30
  for i = -15, 15 do
    for k = -30, 30 do
      local now = ratio(i * step, k * step)
      if now > best then best, a, b = now, i * step, k * step end
    end
  end
  while step > 1e-5 do
    local better = false
    for _, d in ipairs{ { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } } do
      local now = ratio(a + d[1] * step, b + d[2] * step)
      if now > best then best, a, b, better = now, a + d[1] * step, b + d[2] * step, true end
    end
    if not better then step = step / 2 end
  end
  return best
end

local CASES = {
  { cable = "GXL 10", width = 0.012, edge = 0.02, mu = 0.6, force = 8 },
  { cable = "GXL 10", width = 0.012, edge = 0.0025, mu = 0.6, force = 8, way = { 0.3, 0.5, -0.7 } },
  { cable = "GXL 10", width = 0.03, edge = 0.01, shift = 0.004, mu = 0.3, force = 20, way = { 0, 0, 1 } },
  { cable = "GXL 10", width = 0.02, edge = 0.004, mu = 0.6, force = 8, dt = 0.004 },
  { cable = "FLRY-B 2.5", width = 0.012, edge = 0.005, mu = 0.4, force = 12, way = { -1, 0.2, 0 } },
  { cable = "GXL 0.5", width = 0.012, edge = 0.02, mu = 0.6, force = 8, way = { 0.4, 0.9, 0 } },
}
local function case(n, more)
  local p = {}
  for key, value in pairs(CASES[n]) do p[key] = value end
  for key, value in pairs(more) do p[key] = value end
  return p
end

describe("pads", function()
  -- Samples lie w/12 apart or closer. Where they lie changes the pressed length by up to that, and the
  -- moment that a given force resists by as much: 8.4 %. The largest margin has the swing after the last of
  -- 20 loads in it, which is no larger than that load: 5 %.
  it("have a margin that is the moment over the largest one that they resist", function()
    for n = 1, #CASES do
      for _, share in ipairs{ 0.3, 0.6, 0.9 } do
        local out = load(case(n, { share = share }))
        t.share(share, out.state.margin, 0.084, ("margin of case %d at %g"):format(n, share))
        t.share(out.state.margin, out.hand:over().raw_peak_margin, 0.05, "the largest margin")
        assert.equals(#out.hand.events, 0, "events while they hold")
      end
    end
  end)

  -- The search for the worst motion ends within 1e-4 of growth; 0.5 % leaves it twenty such rounds.
  it("have a margin on the limit surface of their touches, for force and moment together", function()
    for n = 1, #CASES do
      for _, by in ipairs{ { 0.4, 0.4, 0 }, { 0.4, 0, 0.4 }, { -0.3, 0.2, -0.6 }, { 0, 0.7, 0 } } do
        local p = case(n, { share = by[1], along = by[2], across = by[3] })
        local out = load(p)
        local exact = in_plane(out.touches, p.mu)
        t.share(exact, out.state.margin, 0.005, ("margin of case %d"):format(n))
        t.above(math.abs(by[3]) + 0.05, exact + (by[1] == 0 and 1 or 0), "a margin above that of force alone")
      end
    end
  end)

  -- A cable lies askew in its pads: they bend it by nanometres, so its touches, on its axis, are nearly one
  -- line. Regression: turning about this line moved one touch more than the others, and its own friction over
  -- mu N counted as the margin: 0.28 instead of 0.03, the peak of the run; 1e7 and more as pads opened.
  it("have no margin of the wire's turn about its own axis", function()
    local mu = 0.5
    for _, segments in ipairs{ 64, 90 } do
      local scene, off, seen = sw.scene{}, 0, 0
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local wire = scene:wire{ cable = "GXL 1.5", segments = segments, from = { 0, 0, 0.0015 },
        to = { 0.49, 0, 0.0015 } }
      scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
      local hand = scene:gripper{ at = { 0.25, 0, 0.0015 }, rotation = { axis = { 0, 0, 1 }, angle = 0.07 },
        pads = { width = 0.009, friction = mu, opening = 0.0067 } }
      local holds = false
      scene:observe{ every = 0.01, call = function()
        if not holds then return end
        local exact, margin = in_plane(hand.tool:touches(), mu), hand:state().margin
        off, seen = math.max(off, margin - exact), seen + 1
      end }
      scene:process(function(p)
        hand:grasp(wire, { s = 0.25, approach = "plates", force = 4.4 })
        holds = true
        hand:move{ by = { 0, 0, 0.05 }, speed = 0.1 }
        p:wait(0.1)
      end)
      local run = t.fine(scene:run{ dt = 0.002 })
      t.above(50, seen, "margins")
      t.below(0.005, off, "margin above that of motions in the pads' plane")
      t.below(0.06, hand.peak_margin, "largest margin")
      assert.equals(#run.events, 0)
    end
  end)

  -- 1.3 of the moment is beyond the places of samples (8.4 %) and the step. The wire turns until the pads
  -- and the levers balance. Turn and angle may differ by the wire's own bend between the pads, M w/(4 EI) at
  -- most: one half of the pad's width under the moment M.
  it("tell that a wire turns: angle, slip and event", function()
    for n = 1, #CASES do
      local p = case(n, { share = 1.3 })
      local out = load(p)
      local what = ("case %d"):format(n)
      t.above(0.15, math.abs(out.angle), what .. ": angle [rad]")
      local moment = 1.3 * 2 * p.mu * p.force * p.width / 4
      t.near(out.angle, -out.state.turned[2], moment * p.width / (4 * out.EI), what .. ": turn [rad]")
      local far = 0 -- distance of the outermost touches from their middle [m]
      for _, one in ipairs(out.touches) do
        for _, two in ipairs(out.touches) do
          far = math.max(far, vec.norm(vec.sub(one.acts, two.acts)) / 2)
        end
      end
      t.above(0.95 * math.abs(out.angle) * far, out.state.slip, what .. ": slip [m]")
      local event = out.hand.events[1]
      assert.equals(event and event.kind, "slip", what)
      t.above(0.9 * event.distance, event.turned * p.width / 2, what .. ": turn of the event")
      local row = out.run:check{}:row(out.hand.name .. ".peak_margin")
      assert.equals(row.verdict, "FAIL", what)
    end
  end)

  -- Beside a wire that bears no load. The pads press on each with F/2.
  it("have the margin of the wire that is nearest to slip", function()
    for _, pull in ipairs{ 0.3, 0.6 } do
      local scene, mu, force = sw.scene{ gravity = { 0, 0, 0 } }, 0.5, 20
      scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
      local wires, state = {}, nil
      for i = 1, 2 do
        wires[i] = scene:wire{ cable = "GXL 10", from = { 0, 0, 0.01 * i }, to = { 0.2, 0, 0.01 * i },
          segments = 40 }
      end
      local hand = scene:gripper{ pads = { width = 0.012, height = 0.04, friction = mu } }
      scene:process(function(p)
        hand:grasp(wires, { s = 0.1, approach = "plates", force = force })
        p:wait(0.3)
        scene:force{ kind = "point", on = wires[1], s = 0.1, force = { pull * mu * force, 0, 0 } }
        p:wait(0.3)
        state = hand:state()
      end)
      t.fine(scene:run{ dt = 0.01 })
      t.share(pull, state.margin, 1e-3, "margin") -- the force of pads is kept to 0.1 %
    end
  end)

  -- A mesh has a ring each 2.5 mm: its outer rings may lie half of that, an eighth of half the width, inside
  -- the pads or at their edges, where the wire is pressed less. Between 1 and 1 - 1/8 of the moment.
  it("count the moment of meshes too", function()
    local r, mu, force, width = 0.003, 0.3, 20, 0.02
    for _, share in ipairs{ 0.3, 0.6 } do
      local scene, state = sw.scene{ gravity = { 0, 0, 0 } }, nil
      local wire = scene:wire{ E = 1e9, nu = 0.3, density = 1200, radius = r, from = { 0, 0, 0 },
        to = { 0.12, 0, 0 }, segments = 48 }
      scene:force{ kind = "damping", mass = 20, stiffness = 1e-3 }
      local hand = scene:gripper{ pads = { width = width, friction = mu, opening = 3 * r } }
      scene:process(function(p)
        hand:grasp(wire, { s = 0.06, approach = "mixed", force = force, freeze = false })
        p:wait(0.2)
        for side = -1, 1, 2 do
          local push = side * share * 2 * mu * force * width / 4 / 0.08
          scene:force{ kind = "point", on = wire, s = 0.06 + 0.04 * side, force = { 0, 0, push } }
        end
        p:wait(0.5)
        state = hand:state()
      end)
      t.fine(scene:run{ dt = 0.01 })
      t.share(share, state.margin, 0.125, "margin of a mesh")
    end
  end)
end)
