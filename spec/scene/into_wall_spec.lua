-- SPDX-License-Identifier: GPL-3.0-or-later
-- A run that fails because a hold drives its wire into a wall says so, and from when on.
local sw = require "softworld"

local RADIUS = 0.004 -- of the wire [m]
local FACE = 0.05 -- from the wire's end to the wall [m]

-- Moves a wire along itself into a wall at constant speed v; the hold is at s. turn: of all, about z.
local function drive(o)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local c, n = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local function at(x) return { c * x, n * x, 0 } end
  scene:obstacle{ name = "the wall", shape = "box", size = { 0.02, 1, 0.4 }, at = at(FACE + 0.01),
    rotation = { axis = { 0, 0, 1 }, angle = o.turn or 0 }, friction = 0.3 }
  local wire = scene:wire{ name = "w", E = o.E, density = 1500, radius = RADIUS, from = at(0), to = at(-0.4) }
  local clamp = scene:clamp(wire, { s = o.s, name = "hand" })
  clamp:follow{ points = { at(0), at(0.3) }, relative = true, speed = o.v, law = "linear" }
  local run = scene:run{ tolerance = 1e-4, duration = 0.3 / o.v, progress = false }
  return run
end

describe("a wire driven into a wall", function()
  for what, o in pairs{
    ["by a hold that enters it"] = { s = 0, E = 1e9, v = 0.25 },
    ["by a hold that enters it, softer, turned"] = { s = 0, E = 1e8, v = 0.25, turn = 0.7 },
    ["by a hold that enters it, faster"] = { s = 0, E = 1e9, v = 0.5 },
  } do
    it(what .. ": the reason names the hold, the wall and the time", function()
      local run = drive(o)
      assert.is_false(run.ok)
      local t = run.reason:match "; try another path: that of 'hand' leads into 'the wall' from t = (%S+) s"
      assert.is_truthy(t, run.reason)
      -- The held end touches at (FACE - RADIUS)/v. A crash counts from a depth of RADIUS/4 on, and is seen at
      -- the end of a step, which is 10 ms at most.
      local touch = (FACE - RADIUS) / o.v
      local last = touch + 0.25 * RADIUS / o.v + 0.01
      assert.is_true(tonumber(t) >= touch - 1e-3 and tonumber(t) <= last, ("%s [%g, %g]"):format(t, touch,
        last))
    end)
  end

  it("with its end first: the reason names the hold that points it there, and when they touched", function()
    for _, v in ipairs{ 0.25, 0.5 } do
      local run = drive{ s = 0.01, E = 1e9, v = v }
      assert.is_false(run.ok)
      local t = run.reason:match "another path: that of 'hand' leads into 'the wall' from t = ([%d.]+) s on"
      assert.is_truthy(t, run.reason)
      -- The end's cap is a half sphere: it touches at (FACE - RADIUS)/v. A row of the log is the mean over a
      -- window of 10 ms at most, so it may be that much later.
      local touch = (FACE - RADIUS) / v
      assert.is_true(tonumber(t) >= touch - 1e-3 and tonumber(t) <= touch + 0.01, t .. " " .. touch)
    end
  end)

  -- The held place of a clamp that only turns stays out of the table: its event `pressed` has other words
  -- than those of holds that go deep.
  it("by a hold that only points it there: the reason names hold and time, whatever the names", function()
    local advice = require "softworld.run.advice"
    for _, names in ipairs{ { "hand", "table" }, { "a 'b' c", "10 % (of) it" } } do
      local scene, r = sw.scene{}, sw.cable "GXL 1.5".outer_diameter.value / 2
      scene:obstacle{ name = names[2], shape = "plane", friction = 0.3 }
      scene:obstacle{ name = "other", shape = "plane", at = { 0, 0, -1 } }
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, r }, to = { 0.3, 0, r },
        segments = 30 }
      scene:force{ kind = "damping", mass = 5, stiffness = 1e-3 }
      scene:clamp(wire, { name = names[1], s = 0 }):follow{ relative = true, duration = 0.2,
        points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 0, 1, 0 }, angle = 0.02 } }
      assert.is_true(scene:run{ dt = 0.01, duration = 0.4 }.ok)
      local pressed = {}
      for _, e in ipairs(scene:events()) do if e.kind == "pressed" then pressed[#pressed + 1] = e end end
      assert.equal(1, #pressed)
      assert.truthy(pressed[1].text:find("by its direction", 1, true))
      local function advised(obstacle)
        return advice.of(("no convergence; obstacle '%s' presses 'w' with 9 N"):format(obstacle), {}, scene)
      end
      local wanted = "another path: that of '%s' leads into '%s' from t = %.3f s on"
      assert.equal(wanted:format(names[1], names[2], pressed[1].first), advised(names[2]))
      assert.is_nil(advised "other":find("path", 1, true))
    end
  end)

  it("is no reason where the wire is pressed by something that no hold enters", function()
    local advice = require "softworld.run.advice"
    -- a crushed wire that no event explains: both are named, and when they touched
    local crushed = "wire 'w' is crushed near s = 0 m; obstacle 'table' presses 'w' with 9 kN near s = 0 m, "
      .. "after touching since t = 0.184 s"
    assert.matches("'w' and 'table' are pressed into each other from t = 0.184 s on",
      advice.of(crushed, { dt = 0.02 }, sw.scene{}))
    local text = advice.of("no convergence in 30 iterations", { dt = 0.02 }, sw.scene{})
    assert.is_nil(text:find("path", 1, true))
  end)
end)
