-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two joined halves between clamps twist like one wire. A joint of wires with material frames passes no
-- twist: there they are softer where they leave a plane, and an event says so.
local sw = require "softworld"
local t = require "physics.tools"

local L, SHARE = 0.4, 0.425

-- Draws the ends of an arch together. Returns its smallest bend radius, the moment of a clamp and the angle
-- of the event, or nil [m], [N m], [rad]. o: turn of the far clamp, or free = true: a pin there; rolls: the
-- wires have material frames; back: the second half is drawn from its end.
local function arch(joined, closed, aside, o)
  o = o or {}
  local turn, free = o.turn, o.free
  local scene = sw.scene{}
  local a, b
  local function wire(from, to, segments)
    return scene:wire{ cable = "GXL 1.5", from = { from, 0, 0 }, to = { to, 0, 0 }, segments = segments,
      rolls = o.rolls }
  end
  if joined then
    a, b = wire(0, SHARE * L, 17), wire(o.back and L or SHARE * L, o.back and SHARE * L or L, 23)
    scene:join{ name = "j", ends = { { a, s = SHARE * L }, { b, s = o.back and b.length or 0 } } }
  else
    a = wire(0, L, 40)
    b = a
  end
  scene:force{ kind = "damping", mass = 2, stiffness = 2e-3 }
  local clamp = scene:clamp(a, { s = 0 })
  local s = o.back and 0 or b.length
  local far = free and scene:pin(b, { s = s }) or scene:clamp(b, { s = s })
  far:follow{ relative = true, duration = 0.6, points = { { 0, 0, 0 }, { -closed, aside, -0.01 } },
    turn = turn and { axis = { 1, 0, 0 }, angle = turn } or nil }
  local run, angle = scene:run{ duration = 3 }, nil
  t.fine(run)
  for _, e in ipairs(run.events) do
    if e.kind == "joint" then
      angle = e.value
      assert.equal("j", e.object)
    end
  end
  return math.min((a:min_bend_radius{ now = true }), (b:min_bend_radius{ now = true })),
    t.norm(clamp:moment()), angle, a:twist_moment(0.05), b:twist_moment(0.1)
end

describe("a joint between two holds", function()
  it("passes twist", function()
    for _, way in ipairs{ { 0.1, 0.04 }, { 0.2, 0.005 }, { 0.2, 0.03 }, { 0.1, 0, turn = 0.3 },
      { 0.1, 0.04, turn = 6 }, { 0.02, 0, turn = 12 } } do
      local one, moment, _, torque = arch(false, way[1], way[2], { turn = way.turn })
      for _, back in ipairs{ false, true } do
        local two, same, angle, before, behind = arch(true, way[1], way[2], { turn = way.turn, back = back })
        assert.is_nil(angle)
        t.share(one, two, 2e-4, "bend radius of two halves")
        t.share(moment, same, 2e-4, "moment of two halves")
        t.share(torque, before, 2e-4, "twisting moment before the joint")
        t.share(before, behind, 1e-5, "twisting moment behind the joint")
      end
    end
  end)

  it("is told of where twist counts and is not passed", function()
    for _, way in ipairs{ { 0.1, 0.04 }, { 0.2, 0.005 }, { 0.2, 0.03 } } do
      local one, moment = arch(false, way[1], way[2], { rolls = true })
      local two, softer, angle = arch(true, way[1], way[2], { rolls = true })
      t.above(0.15, angle or 0, "angle told [rad]")
      -- The reason for the event: more than 2 % in both.
      t.above(1.02 * one, two, "bend radius of two halves [m]")
      t.below(0.98 * moment, softer, "moment of two halves [N m]")
    end
    local _, _, angle = arch(true, 0.1, 0, { turn = 0.3, rolls = true })
    t.near(0.3, angle or 0, 1e-9, "turn of the holds, told [rad]")
  end)

  it("is not told of where it does not", function()
    for _, way in ipairs{ { 0.02, 0 }, { 0.1, 0.005 }, { 0.1, 0.01 } } do
      local one, moment = arch(false, way[1], way[2], { rolls = true })
      local two, softer, angle = arch(true, way[1], way[2], { rolls = true })
      assert.is_nil(angle)
      t.share(one, two, 0.01, "bend radius of two halves")
      t.share(moment, softer, 0.01, "moment of two halves")
    end
    local _, _, angle = arch(true, 0.1, 0.04, { free = true, rolls = true }) -- a pin lets the wire turn
    assert.is_nil(angle)
  end)

  it("is looked for after a run that takes no step", function()
    local scene = sw.scene{}
    local one = scene:wire{ E = 3e7, density = 1400, radius = 0.003, from = { 0, 0, 0 }, to = { 0.3, 0, 0 },
      segments = 9 }
    local two = scene:wire{ E = 3e7, density = 1400, radius = 0.003, from = { 0.3, 0, 0 }, to = { 0.6, 0, 0 },
      segments = 9 }
    scene:clamp(one, { s = 0 })
    scene:join{ ends = { { one, s = 0.3 }, { two, s = 0 } } }
    assert.equal(0, scene:run{ duration = 1e-300 }.steps)
    scene:clamp(two, { s = 0.3 }) -- the next run has no system yet either
    assert.equal(0, scene:run{ duration = 1e-300 }.steps)
  end)
end)
