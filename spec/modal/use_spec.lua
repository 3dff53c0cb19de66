-- SPDX-License-Identifier: GPL-3.0-or-later
-- wire:frequencies: refusals, several wires, unstable states, functions as forces.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local modal = require "spec.modal.tools"

local function refused(text, f, ...)
  local ok, err = pcall(f, ...)
  assert.is_false(ok)
  assert.truthy(tostring(err):find(text, 1, true), "'" .. text .. "' is not in: " .. tostring(err))
end

local function cable(scene, o)
  o = o or {}
  return scene:wire{ name = o.name, EA = 1e4, EI = o.EI or 1e-3, mass_per_length = 0.03, radius = 0.002,
    from = { 0, o.y or 0, 0 }, to = { o.length or 1, o.y or 0, 0 }, segments = o.segments or 40 }
end

describe("wire:frequencies", function()
  it("gives six by default and refuses wrong arguments", function()
    local wire = modal.wire "clamp"
    assert.are.equal(6, #wire:frequencies())
    assert.are.equal(6, #wire:frequencies{})
    assert.is_nil(wire:frequencies().shapes)
    refused("in [1, 200]", wire.frequencies, wire, { modes = 0 })
    refused("whole", wire.frequencies, wire, { modes = 1.5 })
    refused("in [1, 200]", wire.frequencies, wire, { modes = 1000 })
    refused("modes = ", wire.frequencies, wire, { modes = 0 / 0 })
    refused("modes must be a number", wire.frequencies, wire, { modes = "6" })
    refused("shapes must be true or false", wire.frequencies, wire, { shapes = 1 })
    refused("did you mean 'modes'", wire.frequencies, wire, { mode = 6 })
    refused("one table of parameters", wire.frequencies, wire, 6)
  end)

  it("gives at most one mode for each free unknown", function()
    local wire = modal.wire("clamps", { segments = 5 })
    local f = wire:frequencies{ modes = 12 }
    assert.are.equal(12, #f)
    for i = 2, 12 do assert.is_true(f[i] >= f[i - 1] and f[i] < math.huge) end
    refused("13 modes are more than the 12 free unknowns", wire.frequencies, wire, { modes = 13 })
    for segments = 2, 7 do
      local w = modal.wire("clamp", { segments = segments })
      assert.are.equal(3 * segments, #w:frequencies{ modes = 3 * segments })
    end
  end)

  it("refuses a wire that is not at rest", function()
    local scene = sw.scene{}
    local wire = cable(scene)
    scene:clamp(wire, { s = 0 })
    refused("not at rest", wire.frequencies, wire)
    refused("scene:settle() first", wire.frequencies, wire)
    t.fine(scene:settle())
    assert.are.equal(6, #wire:frequencies())
    wire:set_velocity{ 0, 0.1, 0 }
    refused("moves at up to 0.1 m/s", wire.frequencies, wire)
    assert.are.equal(6, #wire:frequencies{ tolerance = 1 })
    t.fine(scene:settle())
    scene:gravity{ 0, 0, -5 }
    refused("not at rest", wire.frequencies, wire)
    t.fine(scene:settle())
    scene:clamp(wire, { s = 1 }):pose{ 0, 0, 0.5 }
    refused("a hold of it has moved", wire.frequencies, wire)
  end)

  -- The wire stands on its clamp, not yet compressed by its weight: it looks straight and still.
  it("refuses a straight wire whose tension is not that of its load", function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e6, EI = 0.05, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, 1 } }
    scene:clamp(wire, { s = 0 })
    refused("tension will still change by a share of", wire.frequencies, wire)
    t.fine(scene:settle())
    assert.are.equal(0, wire:frequencies().unstable)
  end)

  it("refuses a falling wire, and a scene that diverged or is in a step", function()
    local scene = sw.scene{}
    local wire = cable(scene)
    refused("not at rest", wire.frequencies, wire)
    scene:force{ kind = function() refused("from inside", wire.frequencies, wire) end }
    t.fine(scene:run{ duration = 0.02, dt = 0.01 })
    local bad = sw.scene{}
    local w = cable(bad)
    bad:clamp(w, { s = 0 })
    local run = bad:run{ duration = 1, dt = 0.01, integrator = "rk4", unstable = true }
    assert.is_false(run.ok)
    refused("diverged", w.frequencies, w)
  end)

  it("treats every wire by itself", function()
    local scene = sw.scene{}
    local one, two = cable(scene), cable(scene, { y = 1, length = 0.5, EI = 2e-3, segments = 25 })
    for _, wire in ipairs{ one, two } do
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = wire.length })
    end
    t.fine(scene:settle())
    local f, g = one:frequencies(), two:frequencies()
    local alone = sw.scene{}
    local same = cable(alone, { length = 0.5, EI = 2e-3, segments = 25 })
    alone:clamp(same, { s = 0 })
    alone:clamp(same, { s = 0.5 })
    t.fine(alone:settle())
    local h = same:frequencies()
    for i = 1, 6 do t.share(h[i], g[i], 1e-6, "mode " .. i) end
    assert.is_true(f[1] < g[1])
    assert.are.same(f, one:frequencies())
  end)

  it("of a wire held in between are those of both parts", function()
    local wire, scene, unit = modal.wire("clamps", { segments = 60 })
    scene:clamp(wire, { s = 1 / 3 })
    t.fine(scene:settle())
    local f = modal.pairs(wire, 3, unit)
    t.share(22.37328545 / (2 / 3) ^ 2, f[1], 0.005, "long part")
    t.share(22.37328545 / (1 / 3) ^ 2, f[3], 0.005, "short part")
  end)

  -- A function has no stiffness: its force counts, the change of its force does not.
  it("takes the force of a function, without a stiffness", function()
    local wire, scene = modal.wire("clamp", { gravity = { 0, 0, -1 }, segments = 20 })
    local before = wire:frequencies()
    local calls = 0
    local push = scene:force{ on = wire, kind = function(_, _, _, f)
      calls, f[6] = calls + 1, f[6] + 1
    end }
    refused("not at rest", wire.frequencies, wire)
    assert.is_true(calls > 0)
    push:release()
    scene:force{ on = wire, kind = function() end }
    local after = wire:frequencies()
    for i = 1, 6 do t.share(before[i], after[i], 1e-9, "mode " .. i) end
    scene:force{ on = wire, kind = function() error{ "mine" } end }
    local ok, err = pcall(wire.frequencies, wire)
    assert.is_false(ok)
    assert.are.same({ "mine" }, err)
  end)

  it("ignores damping", function()
    local wire, scene = modal.wire("clamp", { gravity = { 0, 0, -1 } })
    local before = wire:frequencies()
    scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.01 }
    scene:force{ kind = "drag", on = wire }
    local after = wire:frequencies()
    for i = 1, 6 do t.share(before[i], after[i], 1e-9, "mode " .. i) end
  end)
end)

describe("an equilibrium that is not stable", function()
  -- A column of weight w L^3 / EI = 12 stands straight although it would buckle from 7.8373 on: nothing
  -- pushes it aside. Damped steps compress it to its length.
  local function column(load)
    local EI = 0.03 * 9.81 / load
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e5, EI = EI, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, 1 } }
    scene:clamp(wire, { s = 0 })
    t.fine(scene:run{ duration = 0.5, dt = 0.01, integrator = "implicit-euler" })
    return wire, (EI / 0.03) ^ 0.5
  end

  it("is reported, with its rate of growth", function()
    local wire = column(12)
    local f = wire:frequencies{ modes = 4 }
    assert.are.equal(2, f.unstable)
    assert.is_true(f.growth > 1 and f.growth < 10)
    assert.are.equal(4, #f)
    for i = 1, 4 do assert.is_true(f[i] > 0 and f[i] < math.huge) end
  end)

  it("grows at that rate", function()
    local wire = column(12)
    local f = wire:frequencies{ modes = 2 }
    local scene = sw.scene{}
    local EI = 0.03 * 9.81 / 12
    local same = scene:wire{ EA = 1e5, EI = EI, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, 1 } }
    scene:clamp(same, { s = 0 })
    t.fine(scene:run{ duration = 0.5, dt = 0.01, integrator = "implicit-euler" })
    same:set_velocity({ 0, 0, 0 }, { 0, 1e-6, 0 }, { 0, 0, 0 })
    local function aside(time)
      t.fine(scene:run{ duration = time, dt = 0.002 })
      return same:position(1)[1]
    end
    local first = aside(3 / f.growth)
    t.share(f.growth, math.log(aside(1 / f.growth) / first) * f.growth, 0.02, "growth")
  end)

  it("is reported as stable below the buckling load", function()
    local wire, unit = column(4)
    local f = wire:frequencies{ modes = 2 }
    assert.are.equal(0, f.unstable)
    assert.is_nil(f.growth)
    t.share(2.462967202, 2 * math.pi * f[1] / unit, 1e-3, "first")
  end)

  it("is refused where too many directions are unstable", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ model = "string", EA = 1e4, EI = 0, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 200 }
    scene:pin(wire, { s = 0 })
    local far = scene:pin(wire, { s = 1 })
    far:pose{ 0.999, 0, 0 }
    t.fine(scene:run{ duration = 0.5, dt = 0.01, integrator = "implicit-euler" })
    refused("unstable in", wire.frequencies, wire)
  end)
end)
