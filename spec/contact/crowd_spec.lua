-- SPDX-License-Identifier: GPL-3.0-or-later
-- Many obstacles, nodes and wires: counts the work of finding touches, and compares results to those of
-- few.
local sw = require "softworld"
local build = require "softworld.scene.build"

local function wire(scene, o)
  return scene:wire{ E = 5e6, density = 1500, radius = 0.0025, from = o.from, to = o.to,
    segments = o.segments or 40 }
end

-- Returns the exact coordinates of wires at 21 places each, as text.
local function bits(...)
  local list = {}
  for _, w in ipairs{ ... } do
    for i = 0, 20 do
      local p = w:position(w.length * i / 20)
      list[#list + 1] = ("%a %a %a"):format(p[1], p[2], p[3])
    end
  end
  return table.concat(list, "\n")
end

describe("many obstacles", function()
  -- A square of `count` small boxes on a table, and a wire that comes down on some of them.
  local function bed(count)
    local s = sw.scene{}
    s:obstacle{ shape = "plane", friction = 0.3 }
    local side = math.ceil(math.sqrt(count))
    for i = 0, count - 1 do
      s:obstacle{ shape = "box", size = { 0.01, 0.01, 0.02 }, friction = 0.3,
        at = { i % side * 0.03, i // side * 0.03, 0.01 } }
    end
    return s, wire(s, { from = { 0, 0.045, 0.03 }, to = { 0.3, 0.045, 0.03 }, segments = 60 })
  end

  it("are not checked one by one", function()
    local function looks(count)
      local s = bed(count)
      local run = s:advance({ dt = 0.01 }, 0.1)
      return run.looks, run.steps
    end
    local few, many, steps = looks(100), looks(1600)
    assert.is_true(few > 0)
    assert.is_true(many < 3 * few, ("%d looks with 1600 boxes, %d with 100"):format(many, few))
    assert.is_true(many < 0.1 * 1601 * 61 * steps, ("%d looks"):format(many))
  end)

  it("are added without reading the whole list for each", function()
    local s, list, reads = sw.scene{}, {}, 0
    build.data(s).obstacles = setmetatable({}, { __newindex = list, __len = function() return #list end,
      __index = function(_, k)
        reads = reads + 1
        return list[k]
      end })
    for i = 1, 300 do s:obstacle{ shape = "sphere", radius = 0.01, at = { i, 0, 0 } } end
    assert.equal(300, #list)
    assert.is_true(reads < 5 * 300, reads .. " reads")
    assert.has_error(function() s:obstacle{ shape = "plane", name = "sphere7" } end,
      "scene '" .. s.name .. "' already has something named 'sphere7'")
  end)

  -- The same obstacles, alone or among others that nothing comes near.
  local near = {
    { shape = "plane" },
    { shape = "box", size = { 0.02, 0.2, 0.03 }, at = { 0.15, 0, 0.015 } },
    { shape = "sphere", radius = 0.02, at = { 0.32, 0.005, 0.01 } },
    { shape = "cylinder", radius = 0.01, length = 0.2, at = { 0.45, 0, 0.03 },
      rotation = { axis = { 1, 0, 0 }, angle = 1.5 } },
  }
  local function among(others, o)
    local s, list, at = sw.scene{}, {}, 0
    local function far(count)
      for _ = 1, count do
        at = at + 1
        local other = s:obstacle{ shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 5 + at, 3, 0.05 } }
        if o.far and at % 2 == 0 then other:follow(o.far) end
      end
    end
    for i, args in ipairs(near) do
      far(others)
      local copy = { friction = 0.3 }
      for k, v in pairs(args) do copy[k] = v end
      list[i] = s:obstacle(copy)
      if o.near and i > 1 then list[i]:follow(o.near) end
    end
    far(others)
    local w = wire(s, { from = { 0, 0, o.height or 0.08 }, to = { 0.6, 0.01, o.height or 0.08 } })
    w:set_velocity{ 0.1, 0, -1 }
    local r = s:run(o.run or { duration = 0.2, dt = 0.005 })
    assert.is_true(r.ok, r.reason)
    local text, pressed = { bits(w), tostring(r.steps), tostring(r.iterations) }, 0
    for i, obstacle in ipairs(list) do
      local log = obstacle:log() -- rows of time, force, span
      for k = 1, #log do
        pressed = pressed + (i > 1 and k % 5 ~= 1 and k % 5 ~= 0 and log[k] ~= 0 and 1 or 0)
        log[k] = ("%a"):format(log[k])
      end
      text[3 + i] = table.concat(log, " ")
    end
    assert.is_true(pressed > 0, "nothing was touched")
    return table.concat(text, "\n")
  end
  local cases = {
    ["that stand"] = {},
    ["that are carried and turned"] = {
      near = { points = { { 0, 0, 0 }, { 0.03, 0.02, 0.02 } }, duration = 0.2, relative = true,
        turn = { axis = { 0.2, 0.1, 1 }, angle = 1 } },
      far = { points = { { 0, 0, 0 }, { 0, 0.5, 0.3 } }, duration = 0.2, relative = true } },
    ["that spin within the step"] = {
      near = { points = { { 0, 0, 0 }, { 0.01, 0, 0 } }, duration = 0.2, relative = true,
        turn = { axis = { 0, 0, 1 }, angle = 30 } },
      far = { points = { { 0, 0, 0 }, { 0.01, 0, 0 } }, duration = 0.2, relative = true,
        turn = { axis = { 0, 0, 1 }, angle = 100 } } },
    ["in explicit steps"] = { height = 0.06,
      run = { duration = 0.04, dt = 2e-5, integrator = "velocity-verlet", unstable = true } },
    ["at poses"] = { height = 0.05, run = { duration = 0.06, dt = 0.02, quasistatic = true } },
  }
  for what, o in pairs(cases) do
    it(what .. " act as they do alone", function()
      assert.equal(among(0, o), among(9, o))
    end)
  end

  it("have a row in their series for every step, touched or not", function()
    local s = sw.scene{}
    local plate = s:obstacle{ shape = "plane" }
    local far = s:obstacle{ shape = "sphere", radius = 0.01, at = { 3, 0, 0 } }
    wire(s, { from = { 0, 0, 0.02 }, to = { 0.3, 0, 0.02 } })
    local function rows(obstacle)
      local log, n = obstacle:log()
      local times, force = {}, 0
      for k = 1, n do
        times[k] = log[5 * k - 4] .. " " .. log[5 * k]
        force = force + math.abs(log[5 * k - 1])
      end
      return table.concat(times, "\n"), n, force
    end
    s:run{ duration = 0.1, dt = 0.01 }
    local snapshot = s:snapshot()
    local late = s:obstacle{ shape = "sphere", radius = 0.01, at = { 4, 0, 0 } }
    s:run{ duration = 0.1, dt = 0.01 }
    local times, count, force = rows(plate)
    local far_times, _, far_force = rows(far)
    assert.is_true(count >= 20 and force > 0)
    assert.equal(times, far_times)
    assert.equal(0, far_force)
    local late_times = rows(late)
    assert.equal(late_times, times:sub(-#late_times))
    assert.is_true(#late_times < #times)
    s:restore(snapshot)
    local before, kept = rows(far)
    assert.equal(before, times:sub(1, #before))
    assert.is_true(kept < count and kept >= 10)
    s:run{ duration = 0.1, dt = 0.01 }
    times, count = rows(plate)
    assert.equal(times, (rows(far)))
    assert.is_true(count > kept)
  end)

  it("are met where pose() puts them, and after a snapshot", function()
    local function run(others)
      local s = sw.scene{}
      local stop = s:obstacle{ shape = "box", size = { 0.2, 0.2, 0.02 }, at = { 3, 0, 0 } }
      for i = 1, others do
        s:obstacle{ shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 5 + i, 3, 0.05 } }
      end
      local w = wire(s, { from = { 0, 0, 0.1 }, to = { 0.4, 0, 0.1 } })
      s:run{ duration = 0.05, dt = 0.005 }
      local snapshot = s:snapshot()
      stop:pose{ 0.2, 0, 0 }
      s:run{ duration = 0.2, dt = 0.005 }
      local met = bits(w)
      s:restore(snapshot)
      s:run{ duration = 0.2, dt = 0.005 }
      return met, bits(w)
    end
    local met, missed = run(0)
    local also_met, also_missed = run(20)
    assert.are_not.equal(met, missed)
    assert.equal(met, also_met)
    assert.equal(missed, also_missed)
  end)
end)

describe("many nodes that land at once", function()
  local grounds = {
    plane = { shape = "plane" },
    box = { shape = "box", size = { 100, 1, 0.1 }, at = { 30, 0, -0.05 } },
  }
  for what, ground in pairs(grounds) do
    it("on a " .. what .. " cost in proportion to their number", function()
      local function looks(nodes)
        local s = sw.scene{}
        s:obstacle(ground)
        local L = 0.01 * nodes
        wire(s, { from = { 0, 0, 0.05 }, to = { L, 0, 0.05 }, segments = nodes })
        local r = s:advance({ dt = 0.01 }, 0.13)
        assert.is_true(r.ok, r.reason)
        assert.is_true(r.iterations > 2 * 13, "no impact")
        assert.is_true(s:contacts() > 0.9 * nodes, "it does not lie there")
        return r.looks
      end
      local few, many = looks(400), looks(1600)
      assert.is_true(many < 6 * few, ("%d looks with 1600 nodes, %d with 400"):format(many, few))
    end)
  end
end)

describe("wires that nothing couples", function()
  -- One wire is lifted off the table, one swings, one is thrown; nothing strikes.
  local function three(s, k)
    local w
    if k == 1 then
      w = wire(s, { from = { 0, 0, 0.0025 }, to = { 0.4, 0, 0.0025 } })
      s:clamp(w, { s = 0 }):follow{ points = { { 0, 0, 0.0025 }, { 0, 0, 0.0225 } }, duration = 0.4 }
    elseif k == 2 then
      w = wire(s, { from = { 0, 1, 1 }, to = { 0.5, 1, 1 }, segments = 30 })
      s:clamp(w, { s = 0 })
    else
      w = wire(s, { from = { 0, 2, 2 }, to = { 0.3, 2, 2.2 }, segments = 20 })
      w:set_velocity{ 1, 0, 1 }
    end
    return w
  end
  local contact
  local function run(...)
    local s, list = sw.scene{}, {}
    s:obstacle{ shape = "plane", friction = 0.3 }
    for _, k in ipairs{ ... } do list[#list + 1] = three(s, k) end
    if contact then s:wire_contact{ friction = 0.3 } end
    local r = s:advance({ dt = 0.005 }, 0.2)
    assert.is_true(r.ok, r.reason)
    assert.equal(40, r.steps)
    return list, r
  end

  it("move as they would alone, bit for bit", function()
    local together = run(1, 2, 3)
    for k = 1, 3 do assert.equal(bits(run(k)[1]), bits(together[k])) end
  end)

  it("move the same where they may touch each other but do not", function()
    contact = true
    local together, all = run(1, 2, 3)
    contact = false
    local without, apart = run(1, 2, 3)
    assert.equal(bits(table.unpack(without)), bits(table.unpack(together)))
    assert.equal(apart.solves, all.solves)
  end)

  it("iterate no longer than they would alone", function()
    local _, all = run(1, 2, 3)
    local sum, most = 0, 0
    for k = 1, 3 do
      local _, alone = run(k)
      sum, most = sum + alone.solves, math.max(most, alone.iterations)
      assert.equal(alone.solves, alone.iterations)
    end
    assert.equal(sum, all.solves)
    assert.is_true(all.solves < 3 * all.iterations, "none waited")
    assert.is_true(all.iterations >= most)
  end)

  it("keep their touches while another wire iterates longer", function()
    local s, low = sw.scene{}, {}
    local plate = s:obstacle{ shape = "plane", friction = 0.3 }
    for k = 1, 5 do
      low[k] = wire(s, { from = { 0, 0.05 * k, 0.01 * k }, to = { 0.3, 0.05 * k, 0.008 * k } })
    end
    assert.is_true(s:run{ duration = 1.5, dt = 0.01 }.ok)
    local weight = 5 * 0.3 * 1500 * math.pi * 0.0025 ^ 2 * 9.81
    assert.is_true(math.abs(plate:force()[3] + weight) < 2e-3 * weight)
    for k = 1, 5 do
      assert.is_true(math.abs(low[k]:position(0.15)[3] - 0.0025) < 1e-4)
    end
  end)

  -- Twelve wires fall aslant and strike in the same steps. A trial in which a wire strikes is redone, so
  -- its friction need not agree there. A trial that takes long must not halve the step of all wires (that
  -- rejected five steps). The strike of one wire makes all start anew, which is an error of time: 15 um.
  it("strike a table as they would alone", function()
    local draw, z = 1, {} -- heights of their ends [m]
    for i = 1, 24 do
      draw = draw * 16807 % 2147483647
      z[i] = 0.01 + 0.01 * draw / 2147483647
    end
    local function fall(first, last)
      local s, list = sw.scene{}, {}
      s:obstacle{ shape = "plane", friction = 0.3 }
      for k = first, last do
        list[#list + 1] = wire(s, { from = { 0, 0.02 * k, z[2 * k - 1] }, to = { 0.5, 0.02 * k, z[2 * k] },
          segments = 50 })
      end
      local r = s:advance({ dt = 0.005 }, 0.3)
      assert.is_true(r.ok, r.reason)
      return list, r
    end
    local together, all = fall(1, 12)
    assert.is_true(all.rejected < 3, all.rejected .. " steps were rejected")
    for k = 1, 12 do
      local there, alone = together[k]:positions(), fall(k, k)[1]:positions()
      for i = 1, #there do assert.is_true(math.abs(there[i] - alone[i]) < 1e-4, "wire " .. k) end
    end
  end)

  it("are all checked for buckling with one linearisation", function()
    local s = sw.scene{}
    for k = 1, 6 do
      s:clamp(wire(s, { from = { 0, k, 0 }, to = { 0, k, 0.5 }, segments = 10 }), { s = 0 })
    end
    local r = s:run{ duration = 0.05, dt = 0.01 }
    local found = 0
    for _, event in ipairs(r.events) do found = found + (event.kind == "buckling" and 1 or 0) end
    assert.equal(6, found)
    assert.equal(r.iterations + 1, r.evaluations)
  end)
end)
