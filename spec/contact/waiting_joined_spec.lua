-- SPDX-License-Identifier: GPL-3.0-or-later
-- Joined and tied wires at rest wait together (waiting_spec): none of them is solved until something disturbs
-- one of them, and then they go on as if they had been solved all the time. A wind of almost no density keeps
-- wires from waiting: that scene is the reference.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local tools = require "spec.physics.tools"
local waiting = require "spec.contact.waiting"
local steps, places, DT = waiting.steps, waiting.places, waiting.DT
local function lever(point) return waiting.lever(point, 0.3) end

local SEGMENTS, LENGTH, REST = 25, 0.3, 3
local CABLE = "GXL 1.5"
local r = sw.cable(CABLE).outer_diameter.value / 2

local function cable(scene, from, to)
  return scene:wire{ cable = CABLE, from = from, to = to, segments = SEGMENTS }
end

-- Each returns wires on a table, and what joins them.
local harnesses = {
  ["a trunk with two branches"] = function(scene)
    local trunk = cable(scene, { -LENGTH, 0, r }, { 0, 0, r })
    local left = cable(scene, { 0, 0, r }, { 0.25, 0.15, r })
    local right = cable(scene, { 0, 0, r }, { 0.25, -0.15, r })
    scene:clamp(trunk, { s = 0 })
    return { trunk, left, right },
      { scene:join{ ends = { { trunk, s = LENGTH }, { left, s = 0 }, { right, s = 0 } } } }
  end,
  ["four wires, each tied to the next"] = function(scene)
    local wires, ties = {}, {}
    for i = 1, 4 do wires[i] = cable(scene, { 0, 0.02 * i, r }, { LENGTH, 0.02 * i, r }) end
    for i = 1, 3 do
      ties[i] = scene:tie(wires[i], { s = 0.12, to = { wires[i + 1], s = 0.12 }, slack = 0.021 })
    end
    return wires, ties
  end,
  ["a bundle of five under two ties"] = function(scene)
    local wires, ties = {}, {}
    for i = 0, 4 do
      local y, z = i % 3 * 0.0034 + i // 3 * 0.0017, r + 0.0002 + 0.0031 * (i // 3)
      wires[i + 1] = cable(scene, { 0, y, z }, { LENGTH, y, z })
    end
    for k, s in ipairs{ 0.06, 0.24 } do
      ties[2 * k - 1] = scene:tie(wires[1], { s = s, to = { wires[3], s = s }, slack = 0.0072 })
      ties[2 * k] = scene:tie(wires[4], { s = s, to = { wires[5], s = s }, slack = 0.0036 })
    end
    scene:wire_contact{ friction = 0.3 }
    return wires, ties
  end,
}

local function made(harness, never)
  local scene = sw.scene{}
  local table_ = scene:obstacle{ shape = "plane", friction = 0.3 }
  local wires, joins = harness(scene)
  scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
  for _, wire in ipairs(never and wires or {}) do
    scene:force{ kind = "wind", on = wire, velocity = { 0, 1, 0 }, density = 1e-30 }
  end
  assert.is_true(scene:advance({ dt = DT }, REST).ok)
  return scene, wires, joins, table_
end

local disturbances = {
  ["one of them is lifted"] = function(scene, wires)
    scene:clamp(wires[2], { s = wires[2].length }):follow(lever{ 0, 0, 0.05 })
  end,
  ["an obstacle pushes one"] = function(scene, wires)
    local p = wires[#wires]:position(0.8 * wires[#wires].length)
    scene:obstacle{ shape = "box", size = { 0.02, 0.02, 0.02 }, friction = 0.3,
      at = { p[1], p[2] + 0.03, 0.0101 } }:follow(lever{ 0, -0.05, 0 })
  end,
  ["the table is tilted"] = function(scene) scene:set{ gravity = { 0, 6, -6 } } end,
}

for name, harness in pairs(harnesses) do
  describe(name .. " at rest", function()
    it("are not solved", function()
      local scene, _, joins = made(harness)
      local from = name:find "tie" and {} or { 1 } -- of a join: on its first end
      local function pull() return joins[1]:force(table.unpack(from)) end
      local before = { pull()[1], pull()[3] }
      assert.are.equal(0, steps(scene, 20).iterations)
      assert.are.same(before, { pull()[1], pull()[3] })
      scene:close()
    end)

    -- Both go through the same states but for rounding, which sliding and blows enlarge.
    for what, disturb in pairs(disturbances) do
      it("move as if they had not waited when " .. what, function()
        local ends, way = {}, 0
        for k, never in ipairs{ false, true } do
          local scene, wires = made(harness, never)
          local before = places(wires)
          disturb(scene, wires)
          steps(scene, 15)
          ends[k] = places(wires)
          way = tools.largest_difference(before, ends[k])
          scene:close()
        end
        tools.above(1e-3, way, "moved [m]")
        tools.below(1e-6, tools.largest_difference(ends[1], ends[2]), "difference [m]")
      end)
    end

    it("go on from a snapshot with the same bits", function()
      local scene, wires = made(harness)
      steps(scene, 5)
      local snapshot = scene:snapshot()
      local function go_on()
        steps(scene, 5)
        scene:set{ gravity = { 2, 1, -8 } }
        steps(scene, 20)
        return { places(wires), scene:energy().total }
      end
      local first = go_on()
      scene:restore(snapshot)
      assert.are.same(first, go_on())
      scene:close()
    end)
  end)
end
