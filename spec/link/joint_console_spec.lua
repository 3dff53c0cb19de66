-- SPDX-License-Identifier: GPL-3.0-or-later
-- A rigid joint passes twist: a trunk carries a branch that leaves it sideways, and a hand that turns the
-- trunk takes the branch along.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "physics.tools"

local LONG, ASIDE = 0.1, 0.08

-- Returns a scene with a trunk along x, clamped at its start, and a branch along y (or at o.angle from x) at
-- its end or middle. The tip is read whatever the ends' order is. o.turned: the whole scene is turned.
local function console(o)
  local angle = o.angle or math.pi / 2
  local n, at = o.segments or 20, o.middle and LONG / 2 or LONG
  local function place(x, y, z) return o.turned and { z, x, y } or { x, y, z } end
  local scene = sw.scene{ gravity = o.weightless and { 0, 0, 0 } or place(0, 0, -9.81) }
  local function wire(name, from, to, back)
    if back then from, to = to, from end
    return scene:wire{ name = name, cable = o.cable or "GXL 1.5", segments = n,
      from = place(table.unpack(from)), to = place(table.unpack(to)) }
  end
  local trunk = wire("trunk", { 0, 0, 0 }, { LONG, 0, 0 }, o.trunk_back)
  local branch = wire("branch", { at, 0, 0 }, { at + ASIDE * math.cos(angle), ASIDE * math.sin(angle), 0 },
    o.branch_back)
  local ends = { { trunk, s = o.trunk_back and LONG - at or at },
    { branch, s = o.branch_back and ASIDE or 0 } }
  if o.ends_back then ends[1], ends[2] = ends[2], ends[1] end
  local c = { scene = scene, trunk = trunk, branch = branch, place = place,
    joint = scene:join{ name = "j", ends = ends }, number = o.ends_back and 2 or 1,
    hand = scene:clamp(trunk, { name = "hand", s = o.trunk_back and LONG or 0 }) }
  c.far = o.both and scene:clamp(trunk, { name = "far", s = o.trunk_back and 0 or LONG })
  function c.tip()
    local p = branch:position(o.branch_back and 0 or ASIDE)
    return o.turned and { p[2], p[3], p[1] } or p
  end
  function c.damp() scene:force{ kind = "damping", mass = 5, stiffness = 2e-3 } end
  function c.turn(by, duration)
    c.hand:follow{ relative = true, duration = duration, points = { { 0, 0, 0 }, place(1e-9, 0, 0) },
      turn = { axis = place(1, 0, 0), angle = by } }
  end
  return c
end

local function silent(result)
  t.fine(result)
  assert.equal(0, #result.events, result.events[1] and result.events[1].text)
  return result
end

local VARIANTS = { { "as drawn", {} }, { "trunk backwards", { trunk_back = true } },
  { "branch backwards", { branch_back = true } }, { "ends swapped", { ends_back = true } },
  { "turned", { turned = true } },
  { "all of them", { trunk_back = true, branch_back = true, ends_back = true, turned = true } } }

describe("a branch at the side of a clamped trunk", function()
  -- Small deflections of beams: the tip sinks by the bending of branch and trunk, and by the angle F a L/GJ
  -- times a. Edges err by 0.092 % at 10 of them, of second order; the rest is the deflection's square.
  it("sinks by bending and by the trunk's twist", function()
    for _, cable in ipairs{ "GXL 1.5", "H07V-K 4", "FLRY-B 0.5" } do
      for n, off in pairs{ [10] = 9.3e-4, [20] = 2.3e-4, [40] = 5.5e-5, [80] = 1.4e-5 } do
        local c, F = console{ cable = cable, segments = n, weightless = true }, 1e-4
        c.scene:force{ kind = "point", on = c.branch, s = ASIDE, force = { 0, 0, -F } }
        silent(c.scene:settle())
        local EI, GJ = c.trunk.beam.EI, c.trunk.beam.GJ
        local sinks = F * ((ASIDE ^ 3 + LONG ^ 3) / (3 * EI) + ASIDE ^ 2 * LONG / GJ)
        t.share(sinks, -c.tip()[3], off, ("deflection of %s, %d segments"):format(cable, n))
        t.share(F * ASIDE, -c.trunk:twist_moment(LONG / 2), 2e-5, "twisting moment of the trunk")
      end
    end
  end)

  it("hangs the same however the scene is drawn", function()
    for _, middle in ipairs{ false, true } do
      local tip
      for _, v in ipairs(VARIANTS) do
        local o = { middle = middle }
        for k, x in pairs(v[2]) do o[k] = x end
        local c = console(o)
        silent(c.scene:settle())
        local z = c.tip()[3]
        tip = tip or z
        t.near(tip, z, 1e-11, "tip, " .. v[1])
        -- The joint twists the trunk by the branch's weight; what bends the branch is the same moment.
        local m = c.joint:moment(c.number)
        local axial = o.turned and m[2] or m[1]
        local weight = c.branch.beam.mass_per_length * 9.81 * ASIDE ^ 2 / 2
        t.share(weight, -axial, 5e-3, "moment of the joint on the trunk, " .. v[1])
        t.share(-axial, math.abs(c.trunk:twist_moment(LONG / 4 + (o.trunk_back and LONG / 2 or 0))), 5e-3,
          "twisting moment")
        local held = c.hand:moment()
        t.share(-axial, o.turned and held[2] or held[1], 5e-3, "moment of the hand, " .. v[1])
      end
    end
  end)

  it("shares its moment between two clamps of the trunk", function()
    local c = console{ middle = true, both = true }
    silent(c.scene:settle())
    t.near(c.far:moment()[1], c.hand:moment()[1], 1e-9, "moments of both clamps [N m]")
    t.share(-c.joint:moment(1)[1], c.hand:moment()[1] + c.far:moment()[1], 1e-4, "their sum")
  end)

  it("moves as at short steps, and swings without gain", function()
    t.same_at({ 0.02, 0.01, 0.005, 0.002 }, function(dt)
      local c = console{}
      c.damp()
      local run = silent(c.scene:run{ duration = 0.5, dt = dt })
      t.below(0.005, math.abs(run:ledger().gap) / run:ledger().play, "energy from nowhere")
      return { tip = c.tip()[3], moment = c.hand:moment()[1] }
    end, 0.001, { tip = 5e-3, moment = 1e-2 })
    for _, dt in ipairs{ 0.02, 0.005, 0.001 } do
      for _, o in ipairs{ {}, { middle = true, both = true }, { cable = "FLRY-B 0.5" } } do
        local c = console(o)
        local run = silent(c.scene:run{ duration = 1, dt = dt })
        t.below(1e-3, math.abs(run:ledger().gap) / run:ledger().play, "energy from nowhere")
      end
    end
  end)
end)

describe("a hand that turns the trunk", function()
  it("takes the branch along", function()
    local variants = { { "at 0.2 rad", { angle = 0.2 } }, table.unpack(VARIANTS) }
    for _, how in ipairs{ { duration = 2, dt = 0.01 }, { duration = 1, dt = 0.05, quasistatic = true } } do
      for _, v in ipairs(variants) do
        local o = { weightless = true }
        for k, x in pairs(v[2]) do o[k] = x end
        local c = console(o)
        c.damp()
        c.turn(math.pi / 2, 1)
        silent(c.scene:run(how))
        local tip, angle = c.tip(), o.angle or math.pi / 2
        local along, up = LONG + ASIDE * math.cos(angle), ASIDE * math.sin(angle)
        local off = math.sqrt((tip[1] - along) ^ 2 + tip[2] ^ 2 + (tip[3] - up) ^ 2)
        t.near(0, off, 3e-6, "tip off, " .. v[1])
      end
    end
  end)

  -- Between two clamps the joint lies half way: the branch turns by half the angle, the trunk is twisted as
  -- a whole, and the hand's work is the twist's energy.
  it("twists a trunk that is clamped at both ends as without the joint", function()
    for _, quasistatic in ipairs{ false, true } do
      local c = console{ weightless = true, middle = true, both = true }
      c.damp()
      c.turn(math.pi / 2, 1)
      local how = { duration = quasistatic and 1 or 2, dt = 0.02, quasistatic = quasistatic }
      local run = silent(c.scene:run(how))
      local torque = c.trunk.beam.GJ / LONG * math.pi / 2
      t.share(torque, c.hand:moment()[1], 1e-5, "moment of the hand")
      t.share(-torque, c.trunk:twist_moment(0.02), 1e-5, "twisting moment before the joint")
      t.share(-torque, c.trunk:twist_moment(0.08), 1e-5, "twisting moment behind the joint")
      t.share(ASIDE / math.sqrt(2), c.tip()[3], 1e-5, "height of the tip")
      t.share(torque * math.pi / 4, run:ledger().work.holds, 2e-3, "work of the hand")
      t.share(torque * math.pi / 4, c.scene:energy().twist, 1e-4, "energy of the twist")
    end
  end)

  it("feels a branch that is held", function()
    local c = console{ weightless = true }
    c.damp()
    c.scene:clamp(c.branch, { name = "plug", s = ASIDE })
    c.turn(0.3, 0.5)
    local run = silent(c.scene:run{ duration = 1, dt = 0.01 })
    t.share(-c.trunk:twist_moment(LONG / 2), c.hand:moment()[1], 1e-4, "moment of the hand")
    t.below(1e-3, math.abs(run:ledger().gap) / run:ledger().play, "energy from nowhere")
  end)
end)

describe("a console of three wires", function()
  -- Two joints: between them the middle wire is twisted by the third one.
  it("is carried by the twist of two of them", function()
    local last
    for _, n in ipairs{ 10, 20, 40 } do
      local scene = sw.scene{}
      local function wire(name, from, to)
        return scene:wire{ name = name, cable = "GXL 1.5", from = from, to = to, segments = n }
      end
      local a = wire("a", { 0, 0, 0 }, { 0.1, 0, 0 })
      local b = wire("b", { 0.1, 0, 0 }, { 0.1, 0.08, 0 })
      local c = wire("c", { 0.1, 0.08, 0 }, { 0.04, 0.08, 0 })
      scene:join{ ends = { { a, s = 0.1 }, { b, s = 0 } } }
      scene:join{ ends = { { b, s = 0.08 }, { c, s = 0 } } }
      local hand = scene:clamp(a, { s = 0 })
      silent(scene:settle())
      local w = a.beam.mass_per_length * 9.81
      -- at small angles: the weights of b and c at their levers
      t.share(w * (0.08 ^ 2 / 2 + 0.06 * 0.08), -a:twist_moment(0.05), 0.02, "twisting moment of a")
      t.share(w * 0.06 ^ 2 / 2, -b:twist_moment(0.04), 0.02, "twisting moment of b")
      t.near(0, c:twist_moment(0.03), 1e-12, "twisting moment of c [N m]")
      t.share(-a:twist_moment(0.05), hand:moment()[1], 1e-5, "moment of the hand")
      local z = c:position(0.06)[3]
      if last then t.near(last, z, n == 20 and 3e-5 or 8e-6, "end of c [m]") end
      last = z
    end
  end)
end)

describe("a joint that passes twist", function()
  it("keeps its state in snapshots, files and other meshes", function()
    local c = console{}
    t.fine(c.scene:run{ duration = 0.05, dt = 0.005 })
    local snapshot, file = c.scene:snapshot(), os.tmpname()
    c.scene:save(file)
    local function go(scene, trunk, branch)
      t.fine(scene:run{ duration = 0.05, dt = 0.005 })
      local p = branch:position(ASIDE)
      return { p[1], p[2], p[3], trunk:twist_moment(0.05) }
    end
    local first = go(c.scene, c.trunk, c.branch)
    c.scene:restore(snapshot)
    assert.same(first, go(c.scene, c.trunk, c.branch))
    local again = sw.load(file)
    os.remove(file)
    assert.same(first, go(again, again:find "trunk", again:find "branch"))
  end)

  it("keeps its twist when the wires get other edges, holds come and go", function()
    local c = console{}
    silent(c.scene:settle())
    local z, torque = c.tip()[3], c.trunk:twist_moment(0.05)
    sw.core.remesh(c.scene, { 33, 27 })
    t.share(torque, c.trunk:twist_moment(0.05), 1e-4, "twisting moment with other edges")
    silent(c.scene:settle())
    t.near(z, c.tip()[3], 3e-6, "tip with other edges [m]")
    local second = c.scene:clamp(c.trunk, { name = "second", s = 0.04 })
    t.share(torque, c.trunk:twist_moment(0.02), 1e-4, "twisting moment before a second clamp")
    t.share(torque, c.trunk:twist_moment(0.07), 1e-4, "twisting moment behind it")
    silent(c.scene:settle())
    t.near(z, c.tip()[3], 2e-5, "tip with a second clamp [m]")
    second:release()
    silent(c.scene:settle())
    t.near(z, c.tip()[3], 3e-6, "tip after its release [m]")
    c.joint:release()
    t.near(0, c.trunk:twist_moment(0.05), 1e-12, "twisting moment of a free trunk [N m]")
  end)

  it("has error bars", function()
    local c = console{ segments = 10 }
    local tip = { name = "tip", value = 1e-4, unit = "m", of = function() return c.tip()[3] end }
    local settled = silent(c.scene:settle{ tolerance = { tip, ["hand.moment"] = 1e-5 } })
    t.near(-9.530e-3, settled.quantities.tip.value, 5e-6, "tip [m]")
  end)
end)
