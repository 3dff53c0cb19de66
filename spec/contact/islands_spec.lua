-- SPDX-License-Identifier: GPL-3.0-or-later
-- In each step, wires that touch and join nothing are solved one after another, each as if it were alone, and
-- only those that may touch or are joined together. So a pair that needs many iterations costs the others
-- nothing, and changes no bit of them.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local SEGMENTS, LENGTH, SINGLE, LYING = 30, 0.3, 4, 20
local CABLES = { "GXL 1.5", "H07V-K 4" }

local function radius(cable) return sw.cable(cable).outer_diameter.value / 2 end

-- Two cables that cross on a table; the upper one is rubbed over the lower one by its ends. It is so light
-- that the lower one does not strike the table.
local function crossing(scene)
  local under, over, half = radius "H07V-K 4", radius "FLRY-B 0.5", LENGTH / 2
  local height = 2 * under + over
  scene:wire{ cable = "H07V-K 4", from = { 0, -1.5, under }, to = { LENGTH, -1.5, under },
    segments = SEGMENTS }
  local upper = scene:wire{ cable = "FLRY-B 0.5", from = { half, -1.5 - half, height },
    to = { half, -1.5 + half, height }, segments = SEGMENTS }
  for _, s in ipairs{ 0, LENGTH } do
    scene:pin(upper, { s = s }):follow(function(t)
      return { half + 0.02 * (1 - math.cos(3 * t)), -1.5 - half + s, height - 0.002 * math.sin(3 * t) }
    end)
  end
  scene:wire_contact{ friction = 0.3 }
end

-- Two cables in the air that are joined.
local function joined(scene)
  local trunk = scene:wire{ cable = CABLES[1], from = { 0, -1, 0.5 }, to = { LENGTH, -1, 0.5 },
    segments = SEGMENTS }
  local branch = scene:wire{ cable = CABLES[2], from = { LENGTH / 2, -1, 0.5 },
    to = { LENGTH / 2, -1, 0.5 - LENGTH }, segments = SEGMENTS }
  scene:pin(trunk, { s = 0 })
  scene:join{ ends = { { trunk, s = LENGTH / 2 }, { branch, s = 0 } } }
end

-- Cables that swing from a pin and cables that lie on a table; pair: is added to them, first or last.
local function scene_of(pair, first)
  local scene, wires = sw.scene{}, {}
  scene:obstacle{ shape = "plane", friction = 0.3 }
  if pair and first then pair(scene) end
  for i = 1, SINGLE do
    wires[i] = scene:wire{ cable = CABLES[1 + i % 2], from = { 0, 0.1 * i, 0.5 },
      to = { LENGTH, 0.1 * i, 0.5 + 0.01 * i }, segments = SEGMENTS }
    scene:pin(wires[i], { s = 0 })
  end
  for i = SINGLE + 1, SINGLE + LYING do
    local r = radius(CABLES[2])
    wires[i] = scene:wire{ cable = CABLES[2], from = { 0, 0.1 * i, r }, to = { LENGTH, 0.1 * i, r },
      segments = SEGMENTS }
  end
  if pair and not first then pair(scene) end
  return scene, wires
end

-- Steps before the crossing cables strike for the first time: a step with a strike is another one for all.
local STEPS, DT = 8, 0.01

local function run(pair, first)
  local scene, wires = scene_of(pair, first)
  local row = scene:advance({ dt = DT, parts = false }, STEPS * DT)
  assert.is_true(row.ok)
  assert.are.equal(STEPS, row.steps)
  local places = {}
  for i, wire in ipairs(wires) do places[i] = table.concat(wire:positions(), " ") end
  local load = {}
  for i, wire in ipairs(wires) do load[i] = ("%.17g"):format((wire:max_tension())) end
  return row, places, load
end

describe("wires that touch nothing", function()
  for name, pair in pairs{ ["cables that rub on each other"] = crossing, ["joined cables"] = joined } do
    for _, first in ipairs{ true, false } do
      it(("have the same bits beside %s, made %s"):format(name, first and "first" or "last"), function()
        local alone, places, tensions = run()
        local beside, same_places, same_tensions = run(pair, first)
        assert.are.same(places, same_places)
        assert.are.same(tensions, same_tensions)
        -- matrices of single wires: the pair's own iterations are not theirs
        local own = 2 * beside.iterations -- at most, for two wires that at times are not coupled
        assert.truthy(beside.solves <= alone.solves + own,
          ("%d solves, alone %d"):format(beside.solves, alone.solves))
      end)
    end
  end
end)
