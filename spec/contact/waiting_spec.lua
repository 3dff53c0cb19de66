-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires at rest wait: they are not solved until something disturbs them, and then go on as if they had been
-- solved all the time. A wind keeps a wire from waiting: with a wind of almost no density the same scene is
-- the reference.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local tools = require "spec.physics.tools"
local waiting = require "spec.contact.waiting"
local steps, places, DT = waiting.steps, waiting.places, waiting.DT
local function lever(point) return waiting.lever(point, 0.4) end

local SEGMENTS, LENGTH, APART = 25, 0.3, 0.03
local CABLES = { "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" }

local function radius(cable) return sw.cable(cable).outer_diameter.value / 2 end

-- Cables lie on a table; never: they never wait.
local function table_with(count, never, friction)
  local scene, wires = sw.scene{}, {}
  local table_ = scene:obstacle{ shape = "plane", friction = friction or 0.3 }
  for i = 1, count do
    local cable = CABLES[1 + i % #CABLES]
    local r = radius(cable)
    wires[i] = scene:wire{ cable = cable, from = { 0, APART * i, r + 0.001 },
      to = { LENGTH, APART * i, r + 0.002 }, segments = SEGMENTS }
    if never then
      scene:force{ kind = "wind", on = wires[i], velocity = { 0, 1, 0 }, density = 1e-30 }
    end
  end
  return scene, wires, table_
end

local function rest(scene) assert.is_true(scene:advance({ dt = DT }, scene.time + 0.8).ok) end

-- Places after a run of what `disturb` does to wires that rest, and how far they moved.
local function moved(disturb, never, time)
  local scene, wires, table_ = table_with(3, never)
  rest(scene)
  local before = places(wires)
  disturb(scene, wires, table_)
  steps(scene, math.ceil((time or 0.4) / DT))
  local after = places(wires)
  scene:close()
  return after, tools.largest_difference(before, after)
end

-- Each moves some wire by more than 1 mm.
local disturbances = {
  ["the table is tilted"] = function(scene) scene:set{ gravity = { 3, 4, -9 } } end,
  ["the table becomes slippery"] = function(scene, _, table_)
    scene:set{ gravity = { 1, 0, -9.81 } } -- friction holds this
    steps(scene, 10)
    table_:set{ friction = 0.05 }
  end,
  ["a wire gets a speed"] = function(_, wires) wires[2]:set_velocity{ 0, 0.3, 0 } end,
  ["wind blows"] = function(scene, wires)
    scene:force{ kind = "wind", on = wires[2], velocity = { 0, 30, 0 } }
  end,
  ["an obstacle comes and pushes it"] = function(scene, wires)
    local y = wires[1]:positions()[2]
    scene:obstacle{ shape = "box", size = { 0.02, 0.02, 0.02 }, friction = 0.3,
      at = { LENGTH / 2, y - 0.04, 0.0101 } }:follow(lever{ 0, 0.06, 0 })
  end,
  ["the table moves"] = function(_, _, table_) table_:follow(lever{ 0, 0, 0.05 }) end,
  ["it is clamped and lifted"] = function(scene, wires)
    scene:clamp(wires[3], { s = 0 }):follow(lever{ 0, 0, 0.05 })
  end,
  ["a gripper lifts it"] = function(scene, wires)
    local gripper = scene:gripper{}
    scene:process(function()
      gripper:grasp(wires[3], { s = 0.02 })
      gripper:move{ by = { 0, 0, 0.05 }, duration = 0.4 }
    end)
    assert.is_true(scene:run{ dt = DT }.ok)
  end,
}

describe("wires at rest", function()
  -- A step solves a wire in two stages, so a wire that is solved takes at least two iterations a step.
  it("are not solved", function()
    for _, count in ipairs{ 1, 2, 6 } do
      local scene = table_with(count)
      rest(scene)
      assert.are.equal(0, steps(scene, 20).iterations)
      local solved = table_with(count, true)
      rest(solved)
      assert.is_true(steps(solved, 20).iterations >= 40)
      scene:close()
      solved:close()
    end
  end)

  it("wait beside a wire that moves", function()
    local scene, wires = table_with(4)
    rest(scene)
    scene:pin(wires[2], { s = 0 }):follow(lever{ 0, 0, 0.1 })
    steps(scene, 2)
    local before = places{ wires[1], wires[3], wires[4] }
    assert.is_true(steps(scene, 20).iterations >= 40)
    assert.are.same(before, places{ wires[1], wires[3], wires[4] }) -- the same bits
    scene:close()
  end)

  -- Both go through the same states but for rounding, which a wire that slips enlarges: up to
  -- 2e-9 m were measured.
  for name, disturb in pairs(disturbances) do
    it("move as if they had not waited when " .. name, function()
      local waited, way = moved(disturb)
      local never = moved(disturb, true)
      tools.above(1e-3, way, "moved [m]")
      tools.below(1e-7, tools.largest_difference(waited, never), "difference [m]")
    end)
  end

  -- The blow comes 0.50 s after the fall began. Then the wires bounce, and the difference grows tenfold
  -- in each 10 ms.
  it("are woken by a wire that falls on them", function()
    local ends = {}
    for k, never in ipairs{ false, true } do
      local scene, wires = table_with(2, never)
      scene:wire_contact{ friction = 0.3 }
      local falls = scene:wire{ cable = CABLES[1], from = { LENGTH / 2, 0, 1.23 },
        to = { LENGTH / 2, 3 * APART, 1.24 }, segments = SEGMENTS }
      assert.is_true(scene:advance({ dt = DT }, 0.51).ok)
      ends[k] = places{ wires[1], wires[2], falls }
      tools.above(1e-6, math.max(table.unpack(wires[1]:velocities())), "its speed [m/s]")
      scene:close()
    end
    tools.below(1e-7, tools.largest_difference(ends[1], ends[2]), "difference [m]")
  end)

  -- Nine cables in three layers.
  local function bundle(never)
    local scene, wires = sw.scene{}, {}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    for i = 0, 8 do
      local y, z = i % 3 * 0.0034 + i // 3 * 0.0017, 0.0017 + 0.0032 * (i // 3)
      wires[i + 1] = scene:wire{ cable = "GXL 1.5", from = { 0, y, z }, to = { LENGTH, y, z },
        segments = SEGMENTS }
      if never then
        scene:force{ kind = "wind", on = wires[i + 1], velocity = { 0, 1, 0 }, density = 1e-30 }
      end
    end
    scene:wire_contact{ friction = 0.3 }
    assert.is_true(scene:advance({ dt = DT }, 1.5).ok)
    return scene, wires
  end

  it("are not solved in a bundle, and press each other", function()
    local scene = bundle()
    local places_, lowest = scene:contacts(), scene:penetration()
    assert.are.equal(0, steps(scene, 20).iterations)
    assert.are.equal(places_, scene:contacts())
    assert.are.equal(lowest, scene:penetration())
    assert.is_true(places_ > 9 * SEGMENTS)
    local before = scene:snapshot()
    local energy = scene:energy().total
    steps(scene, 10)
    scene:restore(before)
    assert.are.equal(places_, scene:contacts())
    assert.are.equal(energy, scene:energy().total)
    scene:close()
  end)

  -- Of the bundle only one cable is touched.
  for name, disturb in pairs{
    ["one is lifted"] = function(scene, wires)
      scene:clamp(wires[9], { s = 0 }):follow(lever{ 0, 0, 0.02 })
    end,
    ["the table is tilted"] = function(scene) scene:set{ gravity = { 0, 7, -7 } } end,
  } do
    it("move in a bundle as if they had not waited when " .. name, function()
      local ends, way = {}, 0
      for k, never in ipairs{ false, true } do
        local scene, wires = bundle(never)
        local before = places(wires)
        disturb(scene, wires)
        steps(scene, 10)
        ends[k] = places(wires)
        way = tools.largest_difference(before, ends[k])
        scene:close()
      end
      tools.above(1e-3, way, "moved [m]")
      tools.below(1e-7, tools.largest_difference(ends[1], ends[2]), "difference [m]")
    end)
  end

  it("load the table with their weight, and show where", function()
    local scene, wires, table_ = table_with(5)
    rest(scene)
    steps(scene, 5)
    local weight = 0
    for _, wire in ipairs(wires) do
      local p = wire:get()
      weight = weight + 9.80665 * p.mass_per_length * p.length
    end
    local force = table_:force()
    assert.is_true(math.abs(force[3] + weight) < 1e-3 * weight)
    assert.are.equal(5 * (SEGMENTS + 1), scene:contacts())
    assert.is_true(scene:penetration() > 0)
    scene:close()
  end)

  it("go on from a snapshot and a file with the same bits", function()
    local scene, wires = table_with(3)
    rest(scene)
    steps(scene, 5)
    local snapshot = scene:snapshot()
    local function go_on()
      wires[2]:set_velocity{ 0.1, 0.2, 0 }
      steps(scene, 30)
      steps(scene, 30)
      return places(wires), scene:energy().total
    end
    local first, energy = go_on()
    scene:restore(snapshot)
    local second, same = go_on()
    assert.are.same(first, second)
    assert.are.equal(energy, same)
    scene:close()
  end)

  -- The energy referee knows what waits: the sum is that of a scene that solves all.
  it("keep their energy", function()
    local sums = {}
    for k, never in ipairs{ false, true } do
      local scene = table_with(3, never)
      rest(scene)
      steps(scene, 20)
      sums[k] = scene:energy()
      scene:close()
    end
    for _, kind in ipairs{ "total", "gravity", "contact" } do
      assert.is_true(math.abs(sums[1][kind] - sums[2][kind]) < 1e-9 * math.abs(sums[2].total))
    end
  end)

  -- A step that ends where a run ends may be short. The next ones double: 15 of them from 1 us to 20 ms.
  it("let steps of a run by tolerance grow", function()
    for _, count in ipairs{ 1, 3 } do
      local scene = table_with(count)
      rest(scene)
      local args = { dt = 0.02, tolerance = 1e-5 }
      assert.is_true(scene:advance(args, scene.time + 1e-6).ok)
      local row = scene:advance(args, scene.time + 1)
      assert.is_true(row.ok, row.reason)
      tools.below(1 / args.dt + 15, row.steps, "steps")
      scene:close()
    end
  end)

  -- An obstacle is placed once at a step's start and once in each stage, whether wires wait or not. So its
  -- function of time is called as often in a step as in that of a wire which falls freely, in one solve.
  it("costs no further call of an obstacle's function of time", function()
    local function calls_per_step(height, dt)
      local scene, calls = sw.scene{}, 0
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local moved_away = scene:obstacle{ shape = "sphere", radius = 0.02, at = { 0, 2, 0.5 } }
      scene:wire{ cable = CABLES[1], from = { 0, 0, height }, to = { LENGTH, 0, height },
        segments = SEGMENTS }
      moved_away:follow(function(time)
        calls = calls + 1
        return { 0, 2, 0.5 + 0.1 * math.sin(time) }
      end)
      assert(scene:advance({ dt = dt }, 0.4).ok)
      calls = 0
      local row = scene:advance({ dt = dt }, scene.time + 20 * dt)
      scene:close()
      return calls / row.steps, row.iterations
    end
    for _, dt in ipairs{ 0.01, 0.004 } do
      local waits, iterations = calls_per_step(radius(CABLES[1]), dt)
      assert.equal(0, iterations) -- it waits
      assert.equal(calls_per_step(10, dt), waits)
    end
  end)
end)
