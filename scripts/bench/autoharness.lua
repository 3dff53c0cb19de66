-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes for bench.auto with several wires: a trunk with two branches joined to its end, on a table or in
-- the air; cables side by side that are tied to each other.
-- @module bench.autoharness
local draw = require "bench.autodraw"
local sw = require "softworld"

local autoharness = {}

local TRUNK, BRANCH = 0.3, 0.2 -- lengths [m]
local HANDS = 0.05 -- smallest distance between the hands: they must not pass through each other [m]
local SPAN = 0.5   -- length of tied cables [m]

-- Adds a trunk, branches at angles to it at the height z, and the joint; way_of(side): the hand's motion.
local function branched(scene, section, options, angles, z, way_of)
  local trunk = draw.made(scene, section, options, { name = "trunk", from = { 0, 0, z },
    to = { TRUNK, 0, z }, segments = 16 })
  local ends = { { trunk, s = TRUNK } }
  scene:clamp(trunk, { s = 0, name = "root" })
  for k, name in ipairs { "left", "right" } do
    local side, a = 3 - 2 * k, angles[k]
    local w = draw.made(scene, section, options, { name = name, from = { TRUNK, 0, z }, segments = 12,
      to = { TRUNK + BRANCH * math.cos(a), side * BRANCH * math.sin(a), z } })
    ends[k + 1] = { w, s = 0 }
    scene:clamp(w, { s = BRANCH, name = name .. " hand" }):follow(way_of(side))
  end
  scene:join { name = "joint", ends = ends }
  return trunk
end

-- Returns different angles for the two branches. In a symmetric harness a pushed trunk would buckle to a
-- random side, and there would be no true value.
local function angles_of(random)
  local angle = draw.between(random, 0.3, 0.9)
  return { angle, angle * draw.between(random, 0.3, 0.7) }
end

-- Returns how far each hand moves away from the other one, at random [m].
local function apart_of(random, angles)
  local room = BRANCH * (math.sin(angles[1]) + math.sin(angles[2])) - HANDS
  return draw.between(random, -math.min(0.05, room / 2), 0.01)
end

local function harness(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 1, 4, 16 })
  local angles, mu = angles_of(random), draw.pick(random, { 0, 0.3 })
  local lift, apart = draw.between(random, 0.03, 0.09), apart_of(random, angles)
  local slack = draw.pick(random, { false, 0.02 })
  return function(options)
    local scene, r = sw.scene { name = "harness" }, section.radius
    scene:obstacle { name = "table", shape = "plane", friction = mu }
    local trunk = branched(scene, section, options, angles, r, function(side)
      return { relative = true, duration = duration, points = { { 0, 0, 0 }, { -0.04, side * apart, lift } } }
    end)
    if slack then scene:tie(trunk, { s = TRUNK / 2, to = { TRUNK / 2, 0, 0 }, slack = slack + r }) end
    return draw.finish(scene, options), { "right hand.force", "left hand.force" }, duration
  end
end

-- A harness in the air: it sags; its hands turn and raise it.
local function hanging(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 1, 4, 16 })
  local angles = angles_of(random)
  local apart, nearer = apart_of(random, angles), draw.between(random, 0.02, 0.1)
  local lift, turn = draw.between(random, -0.1, 0.1), draw.between(random, -1, 1)
  return function(options)
    local scene = sw.scene { name = "hanging" }
    branched(scene, section, options, angles, 0, function(side)
      return { relative = true, duration = duration, turn = { axis = { 1, 0, 0 }, angle = turn },
        points = { { 0, 0, 0 }, { -nearer, side * apart, lift } } }
    end)
    return draw.finish(scene, options), { "root.force", "left hand.force" }, duration
  end
end

-- Cables side by side; each is tied to the next one at some places. One is drawn away and pulls the others.
local function tied(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 1, 4, 16 })
  local count, ties = draw.pick(random, { 2, 3 }), draw.pick(random, { 1, 2 })
  local nearer, away = draw.between(random, 0.02, 0.06), draw.between(random, 0.03, 0.1)
  local lift = draw.between(random, -0.05, 0.05)
  local wide = draw.pick(random, { 2.5 * section.radius, 0.03 })
  return function(options)
    local scene, before = sw.scene { name = "tied" }, nil
    for k = 1, count do
      local y = (k - 1) * wide
      local w = draw.made(scene, section, options, { name = "w" .. k, from = { 0, y, 0 },
        to = { SPAN, y, 0 } })
      scene:clamp(w, { s = 0, name = "near" .. k })
      scene:clamp(w, { s = SPAN, name = "far" .. k }):follow { relative = true, duration = duration,
        points = { { 0, 0, 0 }, { -nearer, k == count and away or 0, k == count and lift or 0 } } }
      for i = 1, before and ties or 0 do
        local s = SPAN * i / (ties + 1)
        scene:tie(w, { s = s, to = { before, s = s }, slack = wide })
      end
      before = w
    end
    return draw.finish(scene, options), { "near1.force", "far" .. count .. ".force" }, duration
  end
end

-- Error of the true values over the tolerance [-]. The usual eighth would take several minutes a scene.
local TRUTH = 1 / 4

-- joined: wires that roll pass no twist at a joint, so a harness is known without them.
autoharness.scenes = { { name = "harness", of = harness, truth = TRUTH, joined = true },
  { name = "hanging", of = hanging, joined = true }, { name = "tied", of = tied, truth = TRUTH } }

return autoharness
