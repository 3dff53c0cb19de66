-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction work that runs record for wires meshed by particles, section by section. It is compared with
-- weight, capstan and pads, with the rod, and with the ledger; also after snapshots, files and a change of
-- model.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"

local MU, G = 0.3, 9.81

-- The record of a wire along its length, and its sums: work of friction [J], normal force times way [N m].
local function kept(wire)
  local nodes, work, slid = {}, 0, 0
  for _, place in ipairs(core.worn(wire)) do
    if place.side == 0 then nodes[#nodes + 1] = place end
  end
  for k, place in ipairs(nodes) do
    local share = (nodes[math.min(k + 1, #nodes)].s - nodes[math.max(k - 1, 1)].s) / 2
    work, slid = work + place.rubbed * share, slid + place.slid * share
  end
  return nodes, work, slid
end

local function is_share(wanted, value, share, what)
  print(("measured: %s %.3g %% (demanded %.3g %%)"):format(what, 100 * (value / wanted - 1), 100 * share))
  assert.is_near(wanted, value, share * math.abs(wanted), what)
end

local L, RADIUS, DENSITY = 0.2, 0.004, 1200
local MASS = DENSITY * math.pi * RADIUS ^ 2 * L

-- A wire at rest on a table, along the direction a [rad].
local function laid(model, a)
  local scene = sw.scene{}
  local floor = scene:obstacle{ name = "table", shape = "plane", friction = MU }
  local args = { name = "w", E = 5e6, density = DENSITY, radius = RADIUS, from = { 0, 0, RADIUS },
    to = { L * math.cos(a or 0), L * math.sin(a or 0), RADIUS } }
  for key, value in pairs(model) do args[key] = value end
  local wire = scene:wire(args)
  local damping = scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.003 }
  assert(scene:settle().ok)
  return scene, wire, floor, damping
end

local MODELS = { ["a rod"] = { segments = 40 }, ["a tube"] = { model = "tube", segments = 80 },
  ["layers of springs"] = { model = "radial", segments = 80 },
  ["layers of elements"] = { model = "radial", section = "solid", segments = 80 },
  ["small cubes"] = { model = "cubic", segments = 80 },
  ["a sheath and its core"] = { model = "composite", segments = 100 } }

local HALVED = { ["a rod"] = true, ["a tube"] = true, ["layers of elements"] = true }

describe("wear of a wire on a table", function()
  for name, model in pairs(MODELS) do
    -- It slides to rest: all of m v^2 / 2 becomes friction work, mu m g for each metre.
    it("is its kinetic energy: " .. name, function()
      local scene, wire, _, damping = laid(model)
      scene:remove(damping)
      wire:set_velocity{ 0.4, 0, 0 }
      local run = scene:run{ duration = 0.25, dt = 0.01, wear = true }
      local _, work, slid = kept(wire)
      -- corners of a tube's section jump a little, which adds 0.6 % of sliding on them
      is_share(MASS * 0.4 ^ 2 / 2, work, 0.01, "of m v^2/2")
      -- friction is below mu times normal force in the step in which the wire stops
      is_share(work, MU * slid, 0.005, "mu times normal force times way")
      is_share(run:ledger().lost.friction, work, 1e-3, "over the ledger's friction")
    end)

    -- Drawn by an end that a clamp keeps at its height; the clamp bears some of the weight.
    it("is the work that the table feels when the wire is drawn by its end: " .. name, function()
      local works = {}
      for k, dt in ipairs(HALVED[name] and { 0.01, 0.005 } or { 0.01 }) do
        local scene, wire, floor = laid(model)
        scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 }, { -0.05, 0, 0 } }, relative = true,
          speed = 0.05, law = "linear" }
        scene:run{ duration = 0.5, dt = dt, parts = false }
        local run = scene:run{ duration = 0.4, dt = dt, wear = true }
        local nodes, work = kept(wire)
        works[k] = work
        is_share(run:ledger().lost.friction, work, 1e-4, "over the ledger's friction")
        local felt = math.abs(floor:over(0.5, 0.9).impulse[1])
        is_share(felt * 0.05, work, 1e-3, "over the table's friction x speed")
        is_share(MU * MASS * G * 0.02, work, 0.04, "of mu m g v t")
        local row = run:check{ abrasion = { coefficient = 1e-12, width = 1e-3, source = "this spec" },
          limits = { friction_work = { max = 10, sure = true } } }:row "friction_work"
        local most = 0
        for _, place in ipairs(nodes) do most = math.max(most, place.rubbed) end
        assert.same({ most / 1e-3, "PASS" }, { row.value, row.verdict })
      end
      if works[2] then is_share(works[1], works[2], 1e-4, "with steps halved") end
    end)
  end

  it("does not depend on direction, and is the same for a rod and its meshes", function()
    local works = {}
    for k, case in ipairs{ { MODELS["a rod"], 0 }, { MODELS["layers of springs"], 0 },
      { MODELS["layers of springs"], 0.7 }, { MODELS["a tube"], -2.2 } } do
      local scene, wire = laid(case[1], case[2])
      local c, s = math.cos(case[2]), math.sin(case[2])
      scene:clamp(wire, { s = L }):follow{ points = { { 0, 0, 0 }, { 0.05 * c, 0.05 * s, 0 } },
        relative = true, speed = 0.05, law = "linear" }
      scene:run{ duration = 0.5, dt = 0.01 }
      scene:run{ duration = 0.4, dt = 0.01, wear = true }
      works[k] = select(2, kept(wire))
    end
    is_share(works[1], works[2], 0.005, "of the rod's")
    is_share(works[2], works[3], 0.002, "turned")
    is_share(works[1], works[4], 0.005, "of the rod's, a tube")
  end)
end)

describe("wear of a mesh round a peg", function()
  -- Friction acts at the surface, at a radius r less from the peg's axis than the wire's centreline. The
  -- moment about the peg's axis gives dT (R + r) = mu T R dphi, and the power is that of the pull, (T2 - T1)
  -- v.
  local R, r, mu, angle, v = 0.1, 0.002, 0.4, 2 * math.pi / 3, 0.05
  local function drawn(model, dt)
    local Rw, half, path = R + r, angle / 2, {}
    local c, s = math.cos(half), math.sin(half)
    local function at(a) return { -Rw * math.cos(a), 0, Rw * math.sin(a) } end
    local from, to = at(math.pi / 2 - half), at(math.pi / 2 + half)
    for i = 4, 1, -1 do path[#path + 1] = { from[1] - 0.01 * i * c, 0, from[3] - 0.01 * i * s } end
    for i = 0, 60 do path[#path + 1] = at(math.pi / 2 - half + angle * i / 60) end
    for i = 1, 4 do path[#path + 1] = { to[1] + 0.01 * i * c, 0, to[3] - 0.01 * i * s } end
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local args = { name = "w", E = 8e6, density = 8000, radius = r, path = path }
    for key, value in pairs(model) do args[key] = value end
    local wire = scene:wire(args)
    scene:obstacle{ shape = "cylinder", radius = R, length = 1, friction = mu,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    scene:force{ kind = "point", on = wire, s = 0, force = { -c, 0, -s } } -- T1 = 1 N
    scene:force{ kind = "damping", mass = 20, stiffness = 1e-3, on = wire }
    scene:clamp(wire, { s = wire.length }):follow{ points = { { 0, 0, 0 }, { 0.04 * c, 0, -0.04 * s } },
      relative = true, speed = v, law = "linear" }
    scene:run{ duration = 0.4, dt = dt }
    local run = scene:run{ duration = 0.4, dt = dt, wear = true, frames = false }
    local _, work = kept(wire)
    is_share(run:ledger().lost.friction, work, 1e-4, "over the ledger's friction")
    local pressure = run:check{ limits = { max_sidewall = 1e3 } }:row "max_sidewall"
    assert.equal("PASS", pressure.verdict)
    return work / 0.4, pressure.value
  end

  it("is that of the capstan, T1 (exp(mu phi) - 1) v", function()
    local tube = { model = "tube", spacing = 0.0015 }
    local wanted = (math.exp(mu * angle * R / (R + r)) - 1) * v
    is_share((math.exp(mu * angle) - 1) * v, (drawn({ segments = 140 }, 0.005)), 0.005,
      "of a rod, on its axis")
    local coarse, pressure = drawn(tube, 0.01)
    is_share(wanted, coarse, 0.01, "of a tube, at its surface")
    is_share(coarse, (drawn(tube, 0.005)), 0.005, "with steps halved")
    is_share(math.exp(mu * angle * R / (R + r)) / (R + r), pressure, 0.03, "of its sidewall pressure T/R")
  end)
end)

describe("wear of a mesh between pads", function()
  it("is 2 mu F for each metre that the pads slide, and only where they slide", function()
    local F, way = 2, 0.03
    for _, model in ipairs{ { model = "radial", segments = 60 }, { model = "tube", segments = 60 } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local args = { name = "w", E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 },
        to = { 0.12, 0, 0 } }
      for key, value in pairs(model) do args[key] = value end
      local wire = scene:wire(args)
      scene:force{ kind = "damping", on = wire, mass = 30, stiffness = 1e-3 }
      scene:clamp(wire, { s = 0 })
      local hand = scene:gripper{ name = "hand", pads = { width = 0.01, friction = MU, opening = 0.009 } }
      scene:process(function()
        hand:grasp(wire, { s = 0.05, approach = "plates", force = F })
        hand:move{ by = { way, 0, 0 }, speed = 0.1, law = "linear" }
      end)
      scene:run{ dt = 0.005, wear = true }
      local nodes, work = kept(wire)
      local stretch = 2 * MU * F * 0.05 / wire.beam.EA -- of the wire beyond its clamp: 0.7 % of the way
      is_share(2 * MU * F * (way - stretch), work, 0.01, "of 2 mu F x way")
      for _, place in ipairs(nodes) do -- here the full width of the pads passed, or the pads never came
        if place.s > 0.06 and place.s < 0.07 then assert.is_near(2 * MU * F, place.rubbed, 0.1 * MU * F) end
        if place.s < 0.04 or place.s > 0.09 then assert.is_near(0, place.rubbed, 1e-3) end
      end
    end
  end)
end)

describe("the wear record of a mesh", function()
  local path = os.tmpname()
  teardown(function() os.remove(path) end)

  local function dragged()
    local scene, wire = laid{ model = "radial", segments = 80 }
    local hand = scene:gripper{ name = "hand" }
    scene:process(function(p)
      p:step("grasp", function() hand:grasp(wire, { s = 0.01 }) end)
      p:step("draw", function() hand:move{ by = { -0.02, 0, 0.002 }, duration = 0.2 } end)
      p:step("back", function() hand:move{ by = { 0.02, 0, -0.002 }, duration = 0.2 } end)
    end)
    return scene, wire
  end

  local function same(one, other)
    local a, b = core.worn(one), core.worn(other)
    assert.equal(#a, #b)
    for k in ipairs(a) do
      assert.same(a[k], b[k])
      for signal = 0, 12 do
        assert.same({ core.worn_cycles(one, k, signal) }, { core.worn_cycles(other, k, signal) })
      end
    end
    assert.same({ core.worn_sidewall(one) }, { core.worn_sidewall(other) })
  end

  it("continues from a file and from a snapshot, to the last bit", function()
    local scene, wire = dragged()
    scene:run{ dt = 0.01, wear = true }
    assert.is_true(select(2, kept(wire)) > 0)
    os.remove(path)
    local cut = dragged()
    cut:observe{ every = 0.05, call = function(o) if cut.time > 0.24 then o:stop "enough" end end }
    cut:run{ dt = 0.01, wear = true, save = path }
    local rest, again = dragged()
    rest:run{ dt = 0.01, wear = true, resume = path }
    same(wire, again)

    local before = again:position(0.1)
    local now = rest:snapshot()
    rest:run{ duration = 0.05, dt = 0.01 }
    assert.is_nil((core.worn(again))) -- the last run did not ask for wear
    rest:restore(now)
    same(wire, again)
    assert.same(before, again:position(0.1))
  end)

  it("changes no bit of the run", function()
    local one, wire = dragged()
    one:run{ dt = 0.01 }
    assert.is_nil((core.worn(wire)))
    local other, worn = dragged()
    other:run{ dt = 0.01, wear = true }
    assert.same(wire:position(0.15), worn:position(0.15))
  end)

  it("stays with the wire when its model changes", function()
    local scene, wire = laid{ segments = 50 }
    local works = {}
    local function note() works[#works + 1] = select(2, kept(wire)) end
    scene:process(function(p)
      wire:set_velocity{ 0.2, 0, 0 }
      p:wait(0.05)
      note()
      wire:remodel{ model = "radial", region = { 0.06, 0.14 } }
      p:wait(0.01)
      note()
      wire:remodel{ model = "rod", segments = 37 }
      p:wait(0.01)
      note()
    end)
    local run = scene:run{ dt = 0.005, wear = true }
    is_share(run:ledger().lost.friction, works[3], 1e-3, "over the ledger's friction")
    assert.is_true(works[1] < works[2] and works[2] < works[3])
    local check = run:check{ fatigue = { bending = { { 1, 1e6 }, { 100, 1 } } },
      limits = { friction_work = { max = 1e3, sure = true } } }
    assert.equal("PASS", check:row "friction_work".verdict)
    assert.equal("PASS", check:row "fatigue".verdict)
  end)

  it("leaves checks open where it was not recorded, and says how to record it", function()
    local scene, wire = laid(MODELS["a tube"])
    local check = scene:run{ duration = 0.02, dt = 0.01 }:check{ limits = { friction_work = 1 },
      fatigue = { bending = { { 1, 1e6 }, { 100, 1 } } } }
    for _, name in ipairs{ "friction_work", "fatigue" } do
      local row = check:row(name)
      assert.equal("OPEN", row.verdict)
      assert.truthy(row.note:find("wear = true", 1, true), row.note)
    end
    assert.has_error(function() core.worn_cycles(wire, 1, 0) end)
  end)

  it("stops the run with an error when memory runs out, and does no other harm", function()
    local failed = 0
    for n = 1, 400, 13 do
      local scene = laid(MODELS["a tube"])
      core.fail_allocation(n)
      local fine, why = pcall(scene.run, scene, { dt = 0.01, duration = 0.01, wear = true, frames = false })
      core.fail_allocation(0)
      if not fine then
        failed = failed + 1
        assert.truthy(tostring(why):find("memory", 1, true), why)
      end
    end
    assert.is_true(failed > 0)
  end)
end)
