-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable that is poked at a tilted wall sticks or slips. Near the angle of friction a little decides which,
-- and the peak force differs by up to 13 times: an event says so, and how near.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local CABLES = { "GXL 1.5", "FLRY-B 2.5", "H07V-K 4", "FLRY-B 0.5" }

local function told_of(run, also)
  local told
  for _, e in ipairs(run.events) do
    if e.kind == "threshold" or e.kind == also then told = e end
  end
  return told
end

-- A straight cable without gravity is pushed along itself. Its force on the wall is along it, so it slips if
-- the tangent of the wall's tilt is above the friction. need: this tangent over the friction. angle: by which
-- the whole scene is turned [rad], or nil; swapped: the cable's other end pokes.
local function straight(cable, need, dt, angle, swapped)
  local scene, free, tilt = sw.scene{ gravity = { 0, 0, 0 } }, 0.07, 0.25
  local a, b = { 0, 0, 0 }, t.turned({ free, 0, 0 }, angle)
  local wire = scene:wire{ cable = cable, from = swapped and b or a, to = swapped and a or b, segments = 14 }
  scene:force{ kind = "damping", mass = 2, stiffness = 0.002 }
  local corners = {}
  for _, x in ipairs{ 0, 0.04 } do
    for _, y in ipairs{ -0.05, 0.05 } do
      for _, z in ipairs{ -0.1, 0.1 } do
        local c = math.cos(tilt) * x + math.sin(tilt) * z
        local p = t.turned({ free + 0.01 + c, y, math.cos(tilt) * z - math.sin(tilt) * x }, angle)
        for k = 1, 3 do corners[#corners + 1] = p[k] end
      end
    end
  end
  scene:obstacle{ name = "wall", shape = "hull", points = corners, friction = math.tan(tilt) / need }
  local to = t.turned({ 0.014, 0, 0 }, angle)
  scene:clamp(wire, { s = swapped and free or 0 }):follow{ relative = true, points = { { 0, 0, 0 }, to },
    duration = 0.14, law = "linear" }
  return told_of(t.fine(scene:run{ duration = 0.14, dt = dt }))
end

describe("a straight cable poked at a wall near the angle of friction", function()
  -- value: the smaller one of need and 1/need. It may come nearer to 1 in the motion that follows, so it is
  -- at least that; 0.01 for the steps in which the cable bends before it is pushed.
  it("is told, with the share of friction, at any step, turn and end", function()
    for k, need in ipairs{ 0.93, 0.98, 1.02, 1.07 } do
      for _, dt in ipairs{ 0.01, 0.001 } do
        local told = straight(CABLES[k], need, dt, k % 2 == 0 and 1 or nil, dt == 0.01)
        assert.is_truthy(told, ("%s %g"):format(CABLES[k], need))
        t.below(1, told.value, "value")
        t.above(math.min(need, 1 / need) - 0.01, told.value, "value")
      end
    end
  end)

  it("is not told where friction is far from it", function()
    for k, cable in ipairs(CABLES) do
      for _, need in ipairs{ 0.4, 1.8 } do
        assert.is_nil(straight(cable, need, 0.005, k % 2 == 0 and 1 or nil, k > 2))
      end
    end
  end)
end)

-- Random cables that hang a little are pushed at walls near the angle of friction.
local function poked(seed, dt)
  local random, pick = t.choices(seed)
  local cable, free, mu = pick(CABLES), 0.03 + 0.12 * random(), pick{ 0.1, 0.2, 0.3, 0.5 }
  local tilt = math.atan(mu) * (1 + 0.6 * (2 * random() - 1)) * (random() < 0.5 and -1 or 1)
  local scene, R = sw.scene{}, 0.02
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { free, 0, 0 },
    segments = 8 + math.floor(16 * random()) }
  scene:settle()
  scene:force{ kind = "damping", mass = 2, stiffness = 0.002 }
  local z = wire:position(free)[3]
  local wall = scene:obstacle{ shape = "box", size = { 2 * R, 0.1, 0.2 }, at = { free + 0.02 + R, 0, z },
    friction = mu, rotation = { axis = { 0, 1, 0 }, angle = tilt } }
  local way = 0.03 + 0.3 * free
  scene:clamp(wire, { s = 0 }):follow{ relative = true, points = { { 0, 0, 0 }, { way, 0, 0 } },
    duration = way / 0.1, law = "linear" }
  local run = t.fine(scene:run{ duration = way / 0.1 + 0.1, dt = dt })
  return wall:over().peak_force, wire:position(free)[3], told_of(run, "rebound")
end

describe("random cables poked at walls near the angle of friction", function()
  -- Of seeds 1 to 400, 6 have peaks that differ by more than 15 %, or ends by more than 5 mm, between 10, 2
  -- and 0.2 ms; all 6 are told at 10 ms. Of all, 114 are told: tilts are drawn evenly from 0.4 to 1.6 of the
  -- angle.
  it("are told where peaks or ends depend on the step", function()
    local untold, told, scenes = 0, 0, 0
    for seed = 41, 140 do
      local force, place, event = poked(seed, 0.01)
      local off = false
      for _, dt in ipairs{ 0.002, 0.0005 } do
        local other, there = poked(seed, dt)
        off = off or math.abs(other / force - 1) > 0.15 or math.abs(there - place) > 0.005
      end
      scenes, told = scenes + 1, told + (event and 1 or 0)
      if off then
        print(("measured: seed %d depends on the step%s"):format(seed, event and ", told" or ""))
      end
      if off and not event then untold = untold + 1 end
    end
    t.below(0.009, untold / scenes, "share of pokes that depend on the step, untold")
    t.below(0.4, told / scenes, "share of pokes that are told")
  end)
end)
