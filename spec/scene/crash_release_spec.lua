-- SPDX-License-Identifier: GPL-3.0-or-later
-- A grip pushes a wire deep into a wall and lets go. The wire comes out as slowly as one that begins inside
-- an obstacle. It was thrown out: steps made 9 to 70 % of the energy in play, the run failed, and its reason
-- advised smaller steps, which made as much.
local sw = require "softworld"
local t = require "physics.tools"

-- Draws a wire into a channel with a bend. The hand keeps its direction, so that beyond the bend the wire's
-- end is in a wall when the hand lets go. o: cable, its edges, both legs, turn of the bend, width, speed.
local function drawn(o, dt)
  local scene = sw.scene{}
  local r = sw.cable(o.cable).outer_diameter.value / 2
  local c, s = math.cos(o.turn), math.sin(o.turn)
  local function at(way, z) return { o.legs[1] + way * o.legs[2] * c, way * o.legs[2] * s, z } end
  scene:obstacle{ name = "table", shape = "plane", friction = 0.4 }
  local first, bend = { 0, 0, 0.004 }, { o.legs[1], 0, 0.004 }
  scene:channel{ points = { first, bend, at(1, 0.004) }, width = o.width, depth = 3 * r, friction = 0.2 }
  local length, high, low = o.legs[1] + o.legs[2], 0.06, 0.005 + r
  local wire = scene:wire{ cable = o.cable, segments = math.floor(length / o.edge), from = { 0.01, 0, high },
    to = { 0.01 - length, 0, high } }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.002 }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.01 })
    hand:move{ speed = o.speed, points = { { 0, 0, high }, { 0.02, 0, low + 0.01 },
      { o.legs[1], 0, low + 0.01 }, at(0.8, low + 0.01), at(0.85, low) } }
    hand:release()
    p:wait(0.3)
  end)
  return scene:run{ dt = dt, frames = false }, scene
end

local cases = {
  { cable = "H07V-K 4", legs = { 0.17, 0.17 }, turn = 0.79, width = 0.0095, speed = 0.21, edge = 0.0094 },
  { cable = "GXL 0.5", legs = { 0.12, 0.16 }, turn = -0.75, width = 0.0076, speed = 0.24, edge = 0.0071 },
  { cable = "GXL 1.5", legs = { 0.18, 0.2 }, turn = 0.98, width = 0.0126, speed = 0.16, edge = 0.0106 },
}

local function crash_of(run)
  for _, e in ipairs(run.events) do
    if e.kind == "crash" then return e end
  end
end

describe("a wire that a grip has pushed into a wall comes out without energy from nowhere", function()
  for _, o in ipairs(cases) do
    it(o.cable, function()
      for _, dt in ipairs{ 0.01, 0.002 } do
        local run = t.fine(drawn(o, dt))
        assert.truthy(crash_of(run))
        local books = run:ledger()
        t.below(0.002, books.gained / books.play, "energy that steps made over that in play")
      end
    end)
  end
end)

describe("the reason of a failed run after a crash", function()
  local advice = require "softworld.run.advice"

  it("names what was driven into what, and since when, instead of smaller steps", function()
    local run, scene = drawn(cases[3], 0.01)
    local crash = crash_of(run)
    local wanted = ("; try another path: that of '%s' leads into '%s' from t = %.3f s on"):format(
      crash.object, crash.text:match "deep into '(.-)'", crash.first)
    local made = "steps made 1 J from nowhere, 50 % of the 2 J in play, most of it at t = 1 s"
    assert.equal(made .. wanted, advice.added(made .. "; take smaller steps", {}, scene))
    assert.equal("no convergence" .. wanted, advice.added("no convergence", {}, scene))
  end)

  it("keeps its advice if nothing was driven into anything", function()
    local scene = sw.scene{}
    local made = "steps made 1 J from nowhere; take smaller steps, or the integrator tr-bdf2"
    assert.equal(made, advice.added(made, {}, scene))
    assert.truthy(advice.added("no convergence", { dt = 0.01 }, scene):find("; try dt = 2.5", 1, true))
  end)
end)
