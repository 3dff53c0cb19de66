-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that turn about the axis of a rod do not twist it. An event says so where another hold would resist.
local sw = require "softworld"
local t = require "spec.physics.tools"

local AT, FORCE, MU = { 0.05, 0.25 }, 20, 0.5 -- [m], [N], [-]

-- Two hands hold a cable; the second one moves by o.move. Returns the run, the second hand and the wire.
local function moved(o)
  local scene = sw.scene{ name = "axis", gravity = { 0, 0, 0 } }
  local path = {}
  for i = 0, 30 do
    local a = (o.bent or 0) * (i / 30 - 0.5)
    path[#path + 1] = { 0.3 * (i / 30), 0, 0.1 + 0.05 * (o.bent or 0) * math.cos(math.pi * a) }
  end
  local wire = scene:wire{ name = "wire", cable = o.cable or "GXL 1.5", segments = 60, path = path,
    rolls = o.rolls, rest = o.bent and "path" or nil }
  scene:force{ kind = "damping", on = wire, mass = 10, stiffness = 0.001 }
  local force = o.force or FORCE
  local pads = { width = 0.02, friction = MU }
  local one, two = scene:gripper{ name = "one", pads = pads }, scene:gripper{ name = "two", pads = pads }
  scene:process(function(p)
    local first = o.first or "plates"
    if first == "clamp" then
      scene:clamp(wire, { s = AT[1], name = "clamp" })
    elseif first ~= "none" then
      one:grasp(wire, { s = AT[1], approach = first, force = first == "plates" and force or nil })
    end
    two:grasp(wire, { s = AT[2], approach = "plates", force = force })
    if o.both then
      scene:process(function() one:move(o.both) end)
    end
    two:move(o.move)
    p:wait(0.1)
  end)
  return t.fine(scene:run{ dt = o.dt or 0.01 }), two, wire
end

local function told_of(run) return t.events(run, "untwisted") end

-- Pads lift a cable that is curved at rest by its middle off a table. Returns the run and the end's height
-- above the middle [m].
local function lifted(o)
  local scene = sw.scene{ name = "spooled" }
  local path, R = {}, 0.15
  for k = 0, 40 do
    local a = (k / 40 - 0.5) * 0.3 / R
    path[k + 1] = { R * math.sin(a), R * (1 - math.cos(a)), 0.1 }
  end
  local wire = scene:wire{ name = "wire", cable = "FLRY-B 2.5", path = path, rest = "path", segments = 40,
    rolls = o.rolls }
  scene:force{ kind = "damping", on = wire, mass = 8, stiffness = 0.001 }
  scene:obstacle{ name = "table", shape = "plane", at = { 0, 0, 0.1 - wire.radius }, friction = 0.3 }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = MU } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.15, approach = o.approach, force = o.approach == "plates" and FORCE or nil })
    hand:move{ by = { 0, 0, 0.2 }, duration = 1 }
    p:wait(0.7)
  end)
  return t.fine(scene:run{ dt = o.dt or 0.01 }), wire:position(0).z - wire:position(0.15).z
end

-- Returns a scene with a cable of 0.4 m, turned by an angle about z, on a table.
local function lying(angle, cable)
  local scene = sw.scene{ name = "lying" }
  local r = sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ name = "table", shape = "plane", at = { 0, 0, -r }, friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = cable, from = { 0, 0, 0 },
    to = { 0.4 * math.cos(angle), 0.4 * math.sin(angle), 0 }, segments = 40 }
  scene:force{ kind = "damping", on = wire, mass = 10, stiffness = 0.001 }
  return scene, wire
end

-- Narrow pads lift the end of a cable over its clamp; the cable swings between them, in one plane.
local function swung(angle)
  local scene, wire = lying(angle, "GXL 1.5")
  local hand = scene:gripper{ name = "hand", pads = { width = 0.003, friction = 0.6 } }
  scene:clamp(wire, { s = 0.4 })
  scene:process(function(p)
    hand:grasp(wire, { s = 0.02, approach = "plates", force = 3 })
    for _, by in ipairs{ { 0.1, 0.2 }, { 0.3, 0.05 } } do
      hand:move{ by = { by[1] * math.cos(angle), by[1] * math.sin(angle), by[2] }, duration = 0.5 }
    end
    p:wait(0.2)
  end)
  local run = t.fine(scene:run{ dt = 0.005 })
  local along = wire:tangent(0.02)
  t.below(-0.5, along.x * math.cos(angle) + along.y * math.sin(angle), "the wire at the pads runs back")
  return run
end

-- One hand takes the cable from another, turns about the vertical, and the other one takes hold anew.
local function handed(angle)
  local scene, wire = lying(0, "GXL 1.5")
  local pads = { width = 0.02, friction = 0.6 }
  local one, two = scene:gripper{ name = "one", pads = pads }, scene:gripper{ name = "two", pads = pads }
  scene:process(function(p)
    one:grasp(wire, { s = 0.1, approach = "plates", force = 15 })
    one:move{ by = { 0, 0, 0.1 }, duration = 0.5 }
    two:grasp(wire, { s = 0.2, approach = "plates", force = 15 })
    one:release()
    two:move{ by = { 0, 0, 0.1 }, duration = 0.5, turn = { axis = { 0, 0, 1 }, angle = angle } }
    one:grasp(wire, { s = 0.1, approach = "plates", force = 15 })
    p:wait(0.1)
  end)
  return t.fine(scene:run{ dt = 0.01 })
end

local function about(axis, angle)
  return { turn = { axis = axis, angle = angle }, duration = 0.5 }
end

describe("pads that turn about the axis of a rod", function()
  it("do not twist it, which is told", function()
    for _, o in ipairs{ { move = about({ 1, 0, 0 }, 1) }, { move = about({ 1, 0, 0 }, 2 * math.pi) },
      { move = about({ 1, 0, 0 }, -0.5), first = "clamp" }, { move = about({ 1, 0, 0 }, 1), dt = 0.02 },
      { move = about({ 1, 0, 0 }, 1), first = "imposed", cable = "H07V-K 4" } } do
      local run, two = moved(o)
      local told = told_of(run)
      assert.equal(1, #told)
      assert.near(0, two:moment().x, 1e-6)
      assert.matches("pads of '%a+' and '%a+' turn against each other about the axis of wire 'wire'",
        told[1].text)
      local check = run:check{ limits = { max_torsion = 20, ["two.peak_moment"] = 1, max_tension = 100 } }
      assert.equal("OPEN", check:row "wire.max_torsion".verdict)
      assert.equal("OPEN", check:row "two.peak_moment".verdict)
      assert.equal("PASS", check:row "wire.max_tension".verdict)
    end
  end)

  it("twist a rod that rolls", function()
    local run, two, wire = moved{ rolls = true, move = about({ 1, 0, 0 }, 1) }
    assert.equal(0, #told_of(run))
    t.near(wire.beam.GJ / (AT[2] - AT[1] - 0.02), two:moment().x, 0.05 * two:moment().x, "moment")
    run, two, wire = moved{ rolls = true, force = 2, move = about({ 1, 0, 0 }, 3) }
    assert.equal(0, #told_of(run))
    t.near(2 * MU * 2 * wire.radius, two:moment().x, 1e-3 * two:moment().x, "moment of slipping")
  end)

  it("let a rod roll that is curved at rest, which is told", function()
    local run, sag = lifted{ approach = "imposed" }
    assert.equal(0, #told_of(run))
    t.near(-0.0086, sag, 2e-4, "sag in an imposed grip")
    run, sag = lifted{ approach = "plates", rolls = true }
    assert.equal(0, #told_of(run))
    t.near(-0.0086, sag, 2e-4, "sag of a rod that rolls")
    run, sag = lifted{ approach = "plates" }
    t.near(-0.072, sag, 2e-3, "sag of a rod that does not")
    assert.equal(1, #told_of(run))
    assert.matches("^wire 'wire' has rolled in the pads of 'hand' by [%d.]+ degrees", told_of(run)[1].text)
    local check = run:check{ checks = { { name = "sag", unit = "m", max = 0.1,
      of = function() return -sag end } } }
    assert.equal("OPEN", check:row "sag".verdict)
    assert.equal("OPEN", check:row "wire.min_bend_radius".verdict)
  end)

  -- The angle was that of the first look beyond 0.2 rad: 20 degrees of 102 at 2 ms.
  it("tell the angle that such a rod has rolled in the end", function()
    for _, dt in ipairs{ 0.01, 0.002 } do
      local told = told_of((lifted{ approach = "plates", dt = dt }))
      assert.equal(1, #told)
      assert.equal(1, told[1].count)
      t.share(1.78, told[1].value, 0.05, ("angle at %g s [rad]"):format(dt))
    end
  end)

  it("say nothing if nothing resists, or if both turn together", function()
    local around = { turn = { axis = { 1, 0, 0 }, angle = 1 }, about = { 0, 0, 0.1 }, duration = 0.5 }
    local up = { turn = { axis = { 0, 0, 1 }, angle = 1 }, about = { 0, 0, 0 }, duration = 0.5 }
    for _, o in ipairs{ { first = "none", move = about({ 1, 0, 0 }, 1) }, { move = around, both = around },
      { move = around, both = around, bent = 1 }, { move = up, both = up, bent = 1 },
      { move = { by = { 0, 0.05, 0.02 }, duration = 0.5 } }, { move = about({ 0, 0, 1 }, 0.5) } } do
      assert.equal(0, #told_of((moved(o))))
    end
  end)

  it("say nothing if the wire swings between the pads, or a hand takes hold anew", function()
    for _, angle in ipairs{ 0, 0.7 } do assert.equal(0, #told_of(swung(angle))) end
    for _, angle in ipairs{ 1, 1.4 } do assert.equal(0, #told_of(handed(angle))) end
  end)
end)
