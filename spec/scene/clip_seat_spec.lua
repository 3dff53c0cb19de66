-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that rest in their clips: the search for rest neither takes them through walls, floor and lips, nor
-- lets them slide away along clips that alone hold them.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local vec = require "softworld.vec"

-- Comes to rest by scene:settle or in a quasi-static pose; returns its result.
local function rest(scene, how)
  if how == "settle" then return scene:settle() end
  return scene:run{ duration = 0.02, dt = 0.02, quasistatic = true }
end

-- Checks that all clips hold the wire, and that they and the hold bear its weight. A pose leaves forces
-- unbalanced by 1e-5 of the weight where nothing but friction holds along the wire; here 1e-3.
local function holds(scene, wire, clips, hold, what)
  local sum = hold and hold:force() or { 0, 0, 0 }
  for _, clip in ipairs(clips) do
    assert.is_true(clip:seated(wire), what .. ": seated in " .. clip.name)
    sum = vec.add(sum, clip:force())
  end
  local weight = wire.beam.mass_per_length * wire.length * 9.81
  local total = vec.add(sum, vec.scale(scene:get().gravity, weight / 9.81))
  t.below(1e-3 * weight, vec.norm(total), what .. ": imbalance [N]")
end

-- Regression: with 20, 40 and 60 segments and a side wall that bears 500 N, the cable of 0.046 N hung
-- straight down from its pin, "at rest", without an event; quasi-static runs too.
describe("a cable pinned at one end, in a clip", function()
  it("stays in the clip, whichever way its weight acts", function()
    for _, segments in ipairs{ 20, 40, 60, 90 } do
      for _, g in ipairs{ { 0, -9.81, 0 }, { 0, 9.81, 0 }, { 0, 0, -9.81 }, { 0, 0, 9.81 },
        { 0, -6.94, 6.94 } } do
        for _, how in ipairs{ "settle", "poses" } do
          local scene = sw.scene{ gravity = g }
          local wire = scene:wire{ cable = "GXL 1.5", segments = segments, from = { -0.15, 0, 0 },
            to = { 0.15, 0, 0 } }
          local clip = scene:clip{ name = "c", at = { 0, 0, 0 }, width = 0.01, insertion = 8, retention = 25,
            friction = 0.25 }
          local pin = scene:pin(wire, { s = 0 })
          t.fine(rest(scene, how))
          local what = ("%d segments, gravity (%g, %g), %s"):format(segments, g[2], g[3], how)
          holds(scene, wire, { clip }, pin, what)
          t.below(0.2 * wire.radius, vec.norm(wire:position(0.15)), what .. ": place in the clip [m]")
        end
      end
    end
  end)
end)

local function draws(seed)
  return function(a, b)
    seed = seed * 48271 % 2147483647
    return a + (b - a) * seed / 2147483647
  end
end

-- Draws a cable in one to three clips, with a pin, a clamp or no hold. Without a hold its weight acts across
-- the clips: along them friction of at least 0.1 has to bear 0.02 of it. Seats are up to 30 % too wide.
local function drawn(seed)
  local r = draws(seed)
  local names = { "GXL 1.5", "H07V-K 4", "FLRY-B 0.5", "FLRY-B 2.5" }
  local kind, a = math.floor(r(0, 3)), r(0, 2 * math.pi)
  local along = kind == 0 and 0.2 or r(-9, 9)
  local across = math.sqrt(9.81 ^ 2 - along ^ 2)
  local scene = sw.scene{ gravity = { along, across * math.cos(a), across * math.sin(a) } }
  local L, count = r(0.15, 0.4), math.floor(r(kind == 0 and 2 or 1, 4))
  local wire = scene:wire{ cable = names[math.floor(r(1, 5))], from = { 0, 0, 0 }, to = { L, 0, 0 },
    segments = math.floor(r(15, 90)) }
  local clips = {}
  for i = 1, count do
    clips[i] = scene:clip{ name = "c" .. i, at = { L * (i - 0.5 + r(-0.2, 0.2)) / count, 0, 0 },
      width = r(0.006, 0.02), insertion = r(4, 15), retention = r(15, 40), friction = r(0.1, 0.6),
      radius = r(0, 1) < 0.5 and wire.radius * r(1, 1.3) or nil }
  end
  local hold = kind == 1 and scene:pin(wire, { s = 0 }) or kind == 2 and scene:clamp(wire, { s = L }) or nil
  return scene, wire, clips, hold
end

-- Regression: of 120 such scenes a cable left its clips without an event in 12, and 19 searches failed after
-- 4,000 iterations. Of the 40 scenes here one still fails in this way, with a message: its friction holds it
-- barely, and it creeps along its clips. In poses it moves on, which an event tells. Of 100 such scenes it is
-- three.
describe("a cable in clips", function()
  for _, how in ipairs{ "settle", "poses" } do
    it("rests in them, with friction alone along them, by " .. how, function()
      local lost = 0
      for seed = 1, 40 do
        local scene, wire, clips, hold = drawn(1000 + seed)
        local result = rest(scene, how)
        local moves = #t.events(result, "unsettled") > 0
        if result.ok and not moves then
          holds(scene, wire, clips, hold, ("seed %d, %s"):format(seed, how))
        else
          lost = lost + 1
          assert.truthy(moves or result.reason:find("not at rest after", 1, true), result.reason)
        end
      end
      t.below(1, lost, "searches without a result")
    end)
  end
end)
