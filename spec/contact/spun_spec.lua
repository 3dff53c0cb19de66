-- SPDX-License-Identifier: GPL-3.0-or-later
-- A rod that does not roll turns freely about its axis where it presses on obstacles: their friction acts at
-- the axis. An event says so where friction at the surface would change its torsion.
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, LEG = 0.05, 0.2 -- [m]

local function told_of(run) return t.events(run, "spun") end

-- Returns the path of a wire over a peg with an axis at this distance [m].
local function over(a, mirrored)
  local path, way = { { -a, 0, -LEG } }, mirrored and -1 or 1
  for k = 0, 48 do
    local p = math.pi * (1 - k / 48)
    path[#path + 1] = { a * math.cos(p), 0, a * math.sin(p) }
  end
  path[#path + 1] = { a, 0, -LEG }
  for _, p in ipairs(path) do p[1] = way * p[1] end
  return path
end

-- A hand twists a taut cable over a peg against a clamp. o: cable, rolls, friction, angle [rad], dt [s],
-- edges, mirrored, poses. Returns the run, the wire, the hand and the scene.
local function pegged(o)
  local scene = sw.scene{ name = "peg", gravity = { 0, 0, 0 } }
  scene:obstacle{ name = "peg", shape = "cylinder", radius = R, length = 1, friction = o.friction or 0.3,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  local r = sw.cable(o.cable).outer_diameter.value / 2
  local wire = scene:wire{ name = "wire", cable = o.cable, path = over(R + r, o.mirrored),
    segments = o.edges or 140, rolls = o.rolls }
  scene:clamp(wire, { s = wire.length })
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0 })
    hand:move{ by = { 0, 0, -1e-5 }, duration = 1 }
    hand:move{ turn = { axis = { 0, 0, 1 }, angle = o.angle or 2 }, duration = 2 }
    p:wait(0.3)
  end)
  local run = t.fine(scene:run{ dt = o.dt or 0.02, quasistatic = o.poses })
  return run, wire, hand, scene
end

-- A cable in a groove of two planes; a hand turns its end. The whole scene is turned by `around` about z.
local function grooved(o)
  local scene = sw.scene{ name = "groove" }
  for side, sign in ipairs{ 1, -1 } do
    scene:obstacle{ name = "side " .. side, shape = "plane", friction = 0.3,
      rotation = { axis = { 1, 0, 0 }, angle = sign * math.pi / 4 } }
  end
  local h = sw.cable(o.cable).outer_diameter.value / 2 * 2 ^ 0.5
  local wire = scene:wire{ name = "wire", cable = o.cable, from = { 0, 0, h }, to = { 1, 0, h },
    segments = o.edges or 100, rolls = o.rolls }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function()
    hand:grasp(wire, { s = 0 })
    hand:move{ turn = { axis = { 1, 0, 0 }, angle = 1 }, duration = 2 }
  end)
  return t.fine(scene:run{ dt = o.dt or 0.05, quasistatic = true }), hand
end

-- Returns places at a distance under the wire's axis, turned about it from 0 to 1 rad.
local function round(depth)
  local points = {}
  for k = 0, 40 do points[k + 1] = { 0.25, depth * math.sin(k / 40), -depth * math.cos(k / 40) } end
  return points
end

describe("a rod that is turned about its axis on an obstacle", function()
  -- On a peg both sides of the wire differ by friction's moment if the wire rolls. The event reckons with a
  -- wire that rolls aside as one piece from the middle of the arc: within a factor of two.
  for _, cable in ipairs{ "H07V-K 4", "GXL 1.5", "FLRY-B 0.5" } do
    it("is told with about the moment of friction on a peg: " .. cable, function()
      local rolling, wire = pegged{ cable = cable, rolls = true, dt = 5e-3 }
      t.near(0, #told_of(rolling), 0, "events with rolling")
      local right = math.abs(wire:twist_moment(0.02) - wire:twist_moment(wire.length - 0.02))
      for _, o in ipairs{ { dt = 5e-3 }, { dt = 0.02 }, { poses = true }, { edges = 89, mirrored = true } } do
        o.cable = cable
        local run, rod = pegged(o)
        local events = told_of(run)
        t.near(1, #events, 0, "events")
        t.near(0, rod:twist_moment(0.02) - rod:twist_moment(rod.length - 0.02), 1e-9, "friction's moment")
        t.above(right / 2, events[1].value, "value")
        t.below(right * 2, events[1].value, "value")
        local check = run:check{ limits = { max_torsion = 1e3, ["hand.peak_moment"] = 1e3 } }
        assert.equal("OPEN", check:row "wire.max_torsion".verdict)
        assert.equal("OPEN", check:row "hand.peak_moment".verdict)
      end
    end)
  end

  -- A cable that lies loose in a groove bears mu N r along its whole length.
  it("is told in a groove with a free end", function()
    for _, cable in ipairs{ "H07V-K 4", "GXL 1.5" } do
      local _, hand = grooved{ cable = cable, rolls = true }
      for _, o in ipairs{ {}, { edges = 67 }, { dt = 0.02 } } do
        o.cable = cable
        local run, other = grooved(o)
        t.below(0.35 * hand.peak_moment, other.peak_moment, "moment without friction")
        t.near(1, #told_of(run), 0, "events")
        t.share(hand.peak_moment, told_of(run)[1].value, 0.25, "value")
      end
    end
  end)

  -- How far the wire has turned is in files: a half of 0.15 rad each adds up to 0.3 rad.
  it("is told the same after a resume from a file", function()
    local function half(scene) return t.fine(scene:run{ duration = 1, dt = 0.05, quasistatic = true }) end
    local function begun()
      local scene = sw.scene{ name = "groove" }
      for side, sign in ipairs{ 1, -1 } do
        scene:obstacle{ name = "side " .. side, shape = "plane", friction = 0.3,
          rotation = { axis = { 1, 0, 0 }, angle = sign * math.pi / 4 } }
      end
      local h = sw.cable("H07V-K 4").outer_diameter.value / 2 * 2 ^ 0.5
      local wire = scene:wire{ cable = "H07V-K 4", from = { 0, 0, h }, to = { 1, 0, h }, segments = 50 }
      scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 } }, relative = true, duration = 2,
        turn = { axis = { 1, 0, 0 }, angle = 0.3 } }
      t.near(0, #told_of(half(scene)), 0, "events of the first half")
      return scene
    end
    local whole, saved, path = begun(), begun(), os.tmpname()
    saved:save(path)
    local resumed = sw.load(path)
    os.remove(path)
    local one, two = told_of(half(whole)), told_of(half(resumed))
    t.near(1, #one, 0, "events of the second half")
    assert.equal(one[1].value, two[1].value)
    assert.equal(one[1].text, two[1].text)
  end)

  it("is not told without friction, or for small turns", function()
    t.near(0, #told_of((pegged{ cable = "H07V-K 4", friction = 0 })), 0, "without friction")
    t.near(0, #told_of((pegged{ cable = "H07V-K 4", angle = 0.2 })), 0, "0.2 rad")
  end)

  -- Twist that comes before the touch, and turns of wire and table together, turn nothing at the touch.
  it("is not told if it is laid down twisted, or if the obstacle turns with it", function()
    for _, o in ipairs{ { lowered = true }, { together = true } } do
      local scene = sw.scene{ name = "laid" }
      local r = sw.cable("H07V-K 4").outer_diameter.value / 2
      local bench = scene:obstacle{ name = "bench", shape = "box", size = { 0.2, 0.2, 0.1 }, friction = 0.5,
        at = { 0.25, 0, -0.05 - r - (o.lowered and 0.02 or -1e-4) } }
      local wire = scene:wire{ name = "wire", cable = "H07V-K 4", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
        segments = 50 }
      local one, two = scene:gripper{ name = "one" }, scene:gripper{ name = "two" }
      local move = o.lowered and { by = { 0, 0, -0.021 }, duration = 0.5 }
        or { turn = { axis = { 1, 0, 0 }, angle = 1 }, law = "linear", duration = 1 }
      scene:process(function(p)
        one:grasp(wire, { s = 0 })
        two:grasp(wire, { s = 0.5 })
        if o.lowered then one:move{ turn = { axis = { 1, 0, 0 }, angle = 2 }, duration = 1 } end
        if o.together then
          bench:follow{ points = round(0.05 + r - 1e-4), law = "linear", duration = 1,
            turn = { axis = { 1, 0, 0 }, angle = 1 } }
        end
        scene:process(function() one:move(move) end)
        two:move(move)
        p:wait(0.2)
      end)
      local run = t.fine(scene:run{ dt = 0.01 })
      t.above(0.1, bench:over().peak_force, "pressed")
      t.near(0, #told_of(run), 0, "events")
    end
  end)
end)
