-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes for bench.auto with harnesses: a trunk and two branches that are joined to its end, which are
-- brought together or apart and lifted; with a tie that keeps the trunk from following, or without.
-- @module bench.autoharness
local draw = require "bench.autodraw"
local sw = require "softworld"

local autoharness = {}

local TRUNK, BRANCH = 0.3, 0.2 -- lengths [m]

-- The branches leave the trunk at different angles: of a harness that is the same on both sides chance tells
-- to which one a trunk goes that is pushed, and nobody knows what is true.
local function branched(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 1, 4, 16 })
  local angle, mu = draw.between(random, 0.3, 0.9), draw.pick(random, { 0, 0.3 })
  local lift, apart = draw.between(random, 0.03, 0.09), draw.between(random, -0.05, 0.01)
  local slack = draw.pick(random, { false, 0.02 })
  local angles = { angle, angle * draw.between(random, 0.3, 0.7) }
  return function(options)
    local scene, r = sw.scene { name = "harness" }, section.radius
    scene:obstacle { name = "table", shape = "plane", friction = mu }
    local trunk = draw.made(scene, section, options, { name = "trunk", from = { 0, 0, r },
      to = { TRUNK, 0, r }, segments = 16 })
    local ends = { { trunk, s = TRUNK } }
    scene:clamp(trunk, { s = 0, name = "root" })
    for k, name in ipairs { "left", "right" } do
      local way, a = 3 - 2 * k, angles[k]
      local w = draw.made(scene, section, options, { name = name, from = { TRUNK, 0, r }, segments = 12,
        to = { TRUNK + BRANCH * math.cos(a), way * BRANCH * math.sin(a), r } })
      ends[k + 1] = { w, s = 0 }
      scene:clamp(w, { s = BRANCH, name = name .. " hand" }):follow { relative = true, duration = duration,
        points = { { 0, 0, 0 }, { -0.04, way * apart, lift } } }
    end
    scene:join { name = "joint", ends = ends }
    if slack then scene:tie(trunk, { s = TRUNK / 2, to = { TRUNK / 2, 0, 0 }, slack = slack + r }) end
    return draw.finish(scene, options), { "root.force", "left hand.force" }, duration
  end
end

autoharness.scenes = { { name = "harness", of = branched } }

return autoharness
