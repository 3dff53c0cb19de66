-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes for bench.auto with snapping, springing and coiling: a cable is pressed into a clip; a wire has the
-- curvature of its spool; a cable is twisted and given slack until it may form a loop.
-- @module bench.autohandled
local draw = require "bench.autodraw"
local sw = require "softworld"

local autohandled = {}

local HIGH = 0.035   -- height of the cable above the clip at the start [m]
local POINTS = 40    -- intervals of an arc

-- Both ends are pushed down past the clip by a share of a deflection: the one at which the cable, as a beam
-- clamped at both ends, presses on the clip with the insertion force.
local function clipped(random)
  local section = { E = draw.pick(random, { 20e6, 60e6 }), density = 1500,
    radius = draw.pick(random, { 0.0025, 0.004 }) }
  local span, duration = draw.between(random, 0.12, 0.2), draw.pick(random, { 1, 4 })
  local insertion, share = draw.between(random, 1, 4), draw.pick(random, { 0.5, 1.6 })
  local EI = section.E * math.pi / 4 * section.radius ^ 4
  local down = HIGH + math.min(0.15 * span, share * insertion * span ^ 3 / (192 * EI))
  return function(options)
    local scene = sw.scene { name = "clipped" }
    scene:clip { name = "clip", at = { span / 2, 0, 0 }, width = 0.01, insertion = insertion,
      retention = 3 * insertion, friction = 0.25 }
    local w = draw.made(scene, section, options, { name = "w", from = { 0, 0, HIGH }, to = { span, 0, HIGH },
      segments = 32 })
    for s, name in pairs { [0] = "left", [span] = "right" } do
      scene:clamp(w, { s = s, name = name }):follow { relative = true, duration = duration,
        points = { { 0, 0, 0 }, { 0, 0, -down } } }
    end
    return draw.finish(scene, options), { "left.force", "min_bend_radius" }, duration
  end
end

-- The wire lies on a table with the curvature of its spool. Its start is lifted and drawn along.
local function spooled(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 2, 10 })
  local bend, mu = draw.between(random, 0.12, 0.4), draw.between(random, 0.05, 0.4)
  local pull, lift = draw.between(random, 0.03, 0.12), draw.between(random, 0.03, 0.1)
  return function(options)
    local scene, r, length = sw.scene { name = "spooled" }, section.radius, 0.4
    scene:obstacle { name = "table", shape = "plane", friction = mu }
    local path = {}
    for i = 0, POINTS do
      local a = length / bend * i / POINTS
      path[#path + 1] = { bend * math.sin(a), bend * (1 - math.cos(a)), r }
    end
    local w = draw.made(scene, section, options, { name = "w", path = path, rest = "path" })
    scene:clamp(w, { s = 0, name = "hand" }):follow { relative = true, duration = duration,
      points = { { 0, 0, 0 }, { -pull, 0, lift } } }
    return draw.finish(scene, options), { "hand.force", "tip" }, duration
  end
end

-- A twisted cable. Straight cables between clamps buckle sideways at a turn of 8.99 EI/GJ.
local function kinked(random)
  local section, duration = draw.wire_of(random), draw.pick(random, { 2, 8 })
  local turn, slack = draw.between(random, 2, 14), draw.between(random, 0, 0.12)
  return function(options)
    local scene, length = sw.scene { name = "kinked" }, 0.5
    local w = draw.made(scene, section, options, { name = "w", from = { 0, 0, 0 }, to = { length, 0, 0 },
      segments = 40 })
    scene:clamp(w, { s = 0, name = "left" })
    scene:clamp(w, { s = length, name = "right" }):follow { relative = true, duration = duration,
      points = { { 0, 0, 0 }, { -slack * length, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = turn } }
    return draw.finish(scene, options), { "right.force", "right.moment" }, duration
  end
end

autohandled.scenes = { { name = "clipped", of = clipped }, { name = "spooled", of = spooled },
  { name = "kinked", of = kinked } }

return autohandled
