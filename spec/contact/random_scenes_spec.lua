-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two hundred random scenes of contact, seeds 1 to 200. Each is run as planned, turned with gravity by a
-- random rotation, mirrored, with its wires' ends swapped, with inner nodes shifted by a third of an edge,
-- and with twice the segments. End states, filtered peaks and energies agree. The wires are from the
-- catalogue or soft, free, thrown, clamped, pinned, gripped, fed, tied and in clips. They lie on boxes,
-- round shapes, hulls, meshes and planes that stand or move, with friction 0 to 1 and with restitution, in
-- motion and quasi-static, in steps of 50 to 1 ms. Seeds are never exchanged.
package.path = "./?.lua;" .. package.path
local random_scenes = require "contact.random_scenes"
local samples = require "contract.samples"
local vec = require "softworld.vec"

local COUNT = 200

-- Bounds for turned, mirrored and swapped scenes, which are the same for the continuum and for the mesh.
-- They differ by rounding of 1e-16; an iteration that stops at a tolerance may make that 1e-9. Relative to
-- the shortest wire's length, the largest peak, and the energy in play.
local SAME = { place = 1e-4, peak = 0.01, energy = 0.01 }
-- Bounds for scenes in which a tolerance or an order decides about more than its own size: hulls (their
-- distances are found by iteration), friction at quasi-static poses, and, with swapped ends, simultaneous
-- blows, which are treated one after another along the wire.
local NEAR = { place = 0.05, peak = 0.2, energy = 0.5 }
-- Allowed numbers of such scenes. Measured: 5, 1, 14.
local DIFFERENT = { turned = 8, mirrored = 1, swapped = 20 }

-- A scene is branching if a wire that begins 1e-9 m beside its place ends further away than SAME.place.
-- Then only the energy books and finite numbers are checked.
local NUDGE, MOST_BRANCHING = 1e-9, 0.15

local function view_turned(seed)
  local random = samples.random(seed + 5000)
  local axis = vec.unit{ random(-1, 1), random(-1, 1), random(-1, 1) }
  return { turn = vec.turn(axis, random(-3, 3)) }
end

local exact = { turned = view_turned, mirrored = function() return { mirror = true } end,
  swapped = function() return { swap = true } end }
local meshes = { shifted = { shift = 1 / 3 }, fine = { segments = function(n) return 2 * n end } }

local function beyond(difference, bounds)
  for name, bound in pairs(bounds) do
    local d = difference[name]
    if d > bound or d ~= d then return true end
  end
  return false
end

-- Unit vectors to the faces, edges and corners of a cube.
local ways = {}
for k = 0, 26 do
  local way = { k % 3 - 1, k // 3 % 3 - 1, k // 9 - 1 }
  if vec.norm(way) > 0 then ways[#ways + 1] = vec.unit(way) end
end
table.sort(ways, function(a, b) -- along the axes first
  local p, q = math.max(a[1] ^ 2, a[2] ^ 2, a[3] ^ 2), math.max(b[1] ^ 2, b[2] ^ 2, b[3] ^ 2)
  if p ~= q then return p > q end
  for i = 1, 3 do if a[i] ~= b[i] then return a[i] < b[i] end end
  return false
end)

local function branches(plan, base)
  for _, way in ipairs(ways) do
    local nudge = { NUDGE * way[1], NUDGE * way[2], NUDGE * way[3] }
    local other = random_scenes.outcome(plan, { nudge = nudge })
    if not other.ok or random_scenes.difference(plan, base, other).place > SAME.place then return true end
  end
  return false
end

-- Runs one scene in all views. failed: reasons of failed views.
local function judged(seed)
  local plan = random_scenes.plan(seed)
  local base = random_scenes.outcome(plan)
  local scene = { seed = seed, base = base, plan = plan, differences = {}, failed = {} }
  if not base.ok then return scene end
  local function compare(name, view)
    local other = random_scenes.outcome(plan, view)
    if not other.ok then scene.failed[name] = other.reason return end
    scene.differences[name] = random_scenes.difference(plan, base, other)
  end
  for name, view in pairs(meshes) do compare(name, view) end
  for name, view in pairs(exact) do
    compare(name, view(seed))
    local d = scene.differences[name]
    if scene.branching == nil and (not d or beyond(d, SAME)) then scene.branching = branches(plan, base) end
  end
  return scene
end

describe("two hundred random scenes", function()
  local scenes = {}

  setup(function()
    for seed = 1, COUNT do scenes[seed] = judged(seed) end
  end)

  -- Returns the differences in a view, of the scenes that have them and do not branch.
  local function each(name)
    local list = {}
    for _, scene in ipairs(scenes) do
      local d = scene.differences[name]
      if d and not scene.branching then list[#list + 1] = { d = d, seed = scene.seed } end
    end
    return list
  end

  local function share(list, part)
    table.sort(list)
    return list[math.ceil(part * #list)]
  end

  it("end, or fail with a reason", function()
    local failed = {}
    for _, scene in ipairs(scenes) do
      if not scene.base.ok then
        assert.is_true(#scene.base.reason > 20)
        failed[#failed + 1] = scene.seed
      end
    end
    -- measured: one, a bent wire that is let go at once in a step too long for it
    assert.is_true(#failed <= 2, "failed: " .. table.concat(failed, ", "))
  end)

  it("keep energy books that balance, and finite numbers", function()
    for _, scene in ipairs(scenes) do
      local l = scene.base.run:ledger()
      local sum, size = l.at_start + l.gap, math.abs(l.at_start) + l.gap + math.abs(l.total)
      for _, w in pairs(l.work) do sum, size = sum + w, size + math.abs(w) end
      for _, w in pairs(l.lost) do sum, size = sum - w, size + math.abs(w) end
      assert.is_true(math.abs(l.total - sum) <= 1e-11 * size + 1e-15, "books of " .. scene.seed)
      for _, p in ipairs(scene.base.places) do
        assert.is_true(vec.norm(p) < 10, "place of " .. scene.seed) -- all are within half a metre
      end
      for name, peak in pairs(scene.base.peaks) do
        assert.is_true(math.abs(peak) < math.huge, name .. " of " .. scene.seed) -- pressed wires: negative
      end
    end
  end)

  it("branch in at most 15 % of all cases", function()
    local branching = {}
    for _, scene in ipairs(scenes) do
      if scene.branching then branching[#branching + 1] = scene.seed end
    end
    -- measured: 6 %
    assert.is_true(#branching <= MOST_BRANCHING * COUNT, "branching: " .. table.concat(branching, ", "))
  end)

  for name in pairs(exact) do
    it("end the same when " .. name, function()
      local different = {}
      for _, scene in ipairs(scenes) do
        assert.is_true(scene.branching or not scene.failed[name], scene.failed[name])
      end
      for _, e in ipairs(each(name)) do
        local text = ("seed %d: place %.1e, peak %.1e (%s), energy %.1e (%s)"):format(e.seed, e.d.place,
          e.d.peak, e.d.which, e.d.energy, e.d.what)
        if beyond(e.d, SAME) then different[#different + 1] = text end
        assert.is_false(beyond(e.d, NEAR), text)
      end
      assert.is_true(#different <= DIFFERENT[name], ("%d: %s"):format(#different,
        table.concat(different, "\n")))
    end)
  end

  -- The positions and the number of nodes are both choices. A shift by a third of an edge gives an error of
  -- the mesh; twice the segments remove most of that error. Measured ratios of both: the median is 1.0 for
  -- end states, 0.9 for peaks and 0.7 for energies; nine in ten are below 3.0, 3.8 and 2.7.
  it("change with shifted nodes about as much as with finer ones", function()
    local floors = { place = 5e-5, peak = 1e-3, energy = 1e-3 }
    for name, floor in pairs(floors) do
      local list = {}
      for _, e in ipairs(each "shifted") do
        local fine = scenes[e.seed].differences.fine
        if fine then list[#list + 1] = e.d[name] / (fine[name] + floor) end
      end
      assert.is_true(#list > 0.75 * COUNT, #list .. " scenes")
      assert.is_true(share(list, 0.5) < 1.5, ("%s: median %.2f"):format(name, share(list, 0.5)))
      assert.is_true(share(list, 0.9) < 5, ("%s: nine in ten below %.2f"):format(name, share(list, 0.9)))
    end
  end)

  it("do not stall", function()
    local rates, stalled = {}, {}
    for i, scene in ipairs(scenes) do rates[i] = scene.base.rate end
    local median = share(rates, 0.5)
    for _, scene in ipairs(scenes) do
      if scene.base.rate > 50 * median then
        stalled[#stalled + 1] = ("seed %d: %.0f solves per second"):format(scene.seed, scene.base.rate)
      end
    end
    -- measured: one, quasi-static with a clip, 58 times the median of 1390
    assert.is_true(#stalled <= 1, table.concat(stalled, "\n"))
  end)
end)
