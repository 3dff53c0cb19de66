-- SPDX-License-Identifier: GPL-3.0-or-later
-- Torsion of a rod that nothing keeps: a hold lets go and pads stay, a frozen grip is thawed. Events tell it.
-- Whole turns of another hand, and turns before a resume, count.
local sw = require "softworld"
local t = require "spec.physics.tools"

local LONG, FIRST, SECOND = 0.3, 0.28, 0.22 -- [m]

-- A cable along a direction, clamped at its start. Returns the scene, the cable, the clamp, and two hands.
local function held(o)
  local scene = sw.scene{ name = "handed", gravity = { 0, 0, 0 } }
  local along = { math.cos(o.turned or 0), math.sin(o.turned or 0), 0 }
  local wire = scene:wire{ name = "wire", cable = o.cable or "GXL 1.5", segments = 60, rolls = o.rolls,
    from = { 0, 0, 0.1 }, to = { LONG * along[1], LONG * along[2], 0.1 } }
  scene:force{ kind = "damping", on = wire, mass = 10, stiffness = not o.mixed and 0.001 or nil }
  local clamp = not o.free and scene:clamp(wire, { s = 0, name = "clamp" }) or nil
  local pads = { width = 0.02, friction = 0.5 }
  local one = scene:gripper{ name = "one", pads = o.mixed and pads or nil }
  local two = scene:gripper{ name = "two", pads = not o.mixed and pads or nil }
  return scene, wire, clamp, one, two, along
end

local function told_of(run) return t.events(run, "untwisted") end

-- The first hand twists the cable, the second one takes hold, and the first one (or the clamp) lets go, or
-- thaws.
-- Returns the run, its events `untwisted`, the second hand, and the moment before, about the axis [N m].
local function handed(o)
  local scene, wire, clamp, one, two, along = held(o)
  local moment
  scene:process(function(p)
    one:grasp(wire, { s = FIRST, approach = o.mixed and "mixed", force = o.mixed and 20 or nil })
    one:rotate{ axis = along, angle = o.angle or 1, duration = 0.5 }
    moment = one:moment().x
    two:grasp(wire, { s = SECOND, approach = not o.mixed and "plates" or nil,
      force = not o.mixed and (o.force or 20) or nil })
    local hold = o.clamp and clamp or one
    if o.thaw then one:thaw() else hold:release() end
    p:wait(0.2)
  end)
  local run = t.fine(scene:run{ dt = o.dt or 0.01 })
  return run, told_of(run), two, moment, wire
end

-- The second hand holds by pads while the first one, imposed, turns. cut: the power is cut after this turn,
-- and the run is resumed. Returns the number of events.
local function turned(angles, cut)
  local file = os.tmpname()
  local function made(last)
    local scene, wire, _, one, two = held{}
    scene:process(function(p)
      p:step("grasp", function()
        one:grasp(wire, { s = FIRST })
        two:grasp(wire, { s = SECOND, approach = "plates", force = 20 })
      end)
      for k, angle in ipairs(angles) do
        p:step("turn " .. k, function()
          if k == last then error("power cut", 0) end
          one:rotate{ axis = { 1, 0, 0 }, angle = angle, duration = 0.5 }
          p:wait(0.1)
        end)
      end
    end)
    return scene
  end
  if cut then
    local fine, why = pcall(function() made(cut + 1):run{ dt = 0.01, save = file } end)
    assert.is_false(fine)
    assert.matches("power cut", why)
  end
  local run = t.fine(made():run{ dt = 0.01, resume = cut and file or nil })
  os.remove(file)
  return #told_of(run)
end

describe("torsion of a rod whose hold lets go", function()
  it("is lost where only pads stay, which is told with its moment", function()
    for _, o in ipairs{ {}, { dt = 0.02 }, { dt = 0.002, cable = "H07V-K 4", force = 100 },
      { turned = 2 }, { angle = -1 }, { clamp = true } } do
      local run, told, two, moment, wire = handed(o)
      assert.equal(1, #told)
      local along = math.cos(o.turned or 0)
      t.near(math.abs(moment / along), told[1].value, 1e-3 * told[1].value, "moment that was let go")
      t.near(0, two:moment().x, 1e-6, "moment of the pads")
      assert.matches("^'%a+' has let go of wire 'wire', and the pads of 'two' keep nothing", told[1].text)
      local check = run:check{ limits = { max_torsion = 20, max_tension = 100 } }
      assert.equal("OPEN", check:row "wire.max_torsion".verdict)
      assert.equal("PASS", check:row "wire.max_tension".verdict)
      assert.near(0, wire:twist_moment(0.1), 1e-9)
    end
  end)

  it("stays in a rod that rolls", function()
    local _, told, two, moment = handed{ rolls = true }
    assert.equal(0, #told)
    t.near(moment, two:moment().x, 0.01 * moment, "moment of the pads")
  end)

  it("is no news where pads would slip, or nothing else keeps it", function()
    for _, o in ipairs{ { force = 0.5 }, { angle = 0.2 }, { free = true } } do
      assert.equal(0, #select(2, handed(o)))
    end
  end)

  it("is lost where a frozen grip is thawed, if others would keep it", function()
    local _, told = handed{ mixed = true, thaw = true }
    assert.equal(1, #told)
    assert.matches("^the thaw of 'one' takes the torsion of", told[1].text)
  end)

  -- Twisted by an angle over the free length l between clamp and grip, it has the torque GJ angle / l. Both
  -- holds that stay are rigid, so all of it stays.
  it("stays between others where a frozen grip lets go", function()
    for _, o in ipairs{ {}, { dt = 0.02, turned = 2 }, { cable = "H07V-K 4" }, { cable = "FLRY-B 0.5" } } do
      o.mixed = true
      local _, told, two, moment, wire = handed(o)
      assert.equal(0, #told)
      t.share(moment, two:moment().x, 0.01, "moment of the other hand")
      t.share(math.abs(moment / math.cos(o.turned or 0)), math.abs(wire:twist_moment(0.1)), 0.01, "torsion")
    end
  end)

  -- A hold that only takes the twisted wire changes nothing: the same torque on both sides, and none on it.
  it("does not jump over another hold that takes a frozen grip's wire", function()
    for _, o in ipairs{ {}, { cable = "FLRY-B 0.5" }, { cable = "H07V-K 4", clamp = true },
      { segments = 45 } } do
      o.mixed = true
      local scene, wire, _, one, two = held(o)
      local before, on_two, on_one
      scene:process(function(p)
        one:grasp(wire, { s = FIRST, approach = "mixed", force = 20 })
        one:rotate{ axis = { 1, 0, 0 }, angle = 1, duration = 0.5 }
        before = one:moment().x
        if o.clamp then two = scene:clamp(wire, { s = SECOND }) else two:grasp(wire, { s = SECOND }) end
        p:wait(0.1)
        if o.segments then -- other edges change nothing either
          wire:remodel{ model = "rod", segments = o.segments }
          p:wait(0.1)
        end
        on_two, on_one = two:moment().x, one:moment().x
      end)
      t.fine(scene:run{ dt = 0.01 })
      t.near(0, on_two, 1e-3 * before, "moment of the new hold")
      t.share(before, on_one, 1e-3, "moment of the frozen grip")
    end
  end)

  it("is no news if nothing else would keep it", function()
    local scene, wire, _, one, _ = held{ mixed = true }
    scene:process(function()
      one:grasp(wire, { s = FIRST, approach = "mixed", force = 20 })
      one:rotate{ axis = { 1, 0, 0 }, angle = 1, duration = 0.5 }
      one:release()
    end)
    assert.equal(0, #told_of(t.fine(scene:run{ dt = 0.01 })))
  end)

  it("refuses a mixed grasp, with the way out", function()
    local scene, wire, _, _, two = held{ mixed = true }
    local three = scene:gripper{ name = "three", pads = { width = 0.02, friction = 0.5 } }
    local why, kept
    scene:process(function(p)
      two:grasp(wire, { s = FIRST })
      two:rotate{ axis = { 1, 0, 0 }, angle = 1, duration = 0.5 }
      local fine
      fine, why = pcall(three.grasp, three, wire, { s = SECOND, approach = "mixed", force = 20 })
      assert.is_false(fine)
      assert.is_nil(three.wire)
      wire:remodel{ model = "radial" }
      three:grasp(wire, { s = SECOND, approach = "mixed", force = 20 })
      two:release()
      p:wait(0.1)
      kept = three:moment().x
    end)
    t.fine(scene:run{ dt = 0.01 })
    assert.matches("gripper 'three': wire 'wire' is twisted by 1 rad.*wire:remodel{ model = 'radial' }", why)
    t.near(wire.beam.GJ / (FIRST - 0.01), kept, 0.02 * kept, "moment that the grip keeps")
  end)
end)

describe("pads beside a hand that turns", function()
  it("notice its whole turns", function()
    assert.equal(1, turned{ 2 * math.pi })
    assert.equal(0, turned{ 0.1 })
    assert.equal(1, turned{ 1, -1, 0.1 })
  end)

  it("forget it once they have let go, also when the wire is removed", function()
    local scene, wire, _, one, two = held{}
    scene:process(function()
      one:grasp(wire, { s = FIRST })
      two:grasp(wire, { s = SECOND, approach = "plates", force = 20 })
      one:rotate{ axis = { 1, 0, 0 }, angle = 0.1, duration = 0.2 }
      two:release()
      one:rotate{ axis = { 1, 0, 0 }, angle = 2 * math.pi, duration = 0.2 }
      two:grasp(wire, { s = SECOND, approach = "plates", force = 20 })
      scene:remove(wire)
    end)
    assert.equal(0, #told_of(t.fine(scene:run{ dt = 0.01 })))
    local file = os.tmpname()
    scene:save(file)
    os.remove(file)
  end)

  it("count turns before a resume", function()
    assert.equal(1, turned{ 0.15, 0.15 })
    assert.equal(1, turned({ 0.15, 0.15 }, 1))
    assert.equal(0, turned({ 0.15, -0.15 }, 1))
  end)
end)
