-- SPDX-License-Identifier: GPL-3.0-or-later
-- Random bent wires at rest on which a hold comes or goes, or that get other edges: the sharpest bend one
-- step later must be that before. Holds that do not move change nothing of a wire at rest, and a hold that
-- goes only lets it straighten. With --measured this prints the figures of limits_holds.md.
local sw = require "softworld"
local core = require "softworld.core"
local t = require "physics.tools"

local SOFT = { E = 1e6, density = 1200, radius = 0.003 }

-- Numbers from 0 to 1, and members of lists, by a seed.
local function random(seed)
  local x = (seed * 2654435761 + 12345) % 4294967296
  local function number()
    x = (x * 1664525 + 1013904223) % 4294967296
    return x / 4294967296
  end
  for _ = 1, 5 do number() end
  return number, function(list) return list[1 + math.floor(number() * #list)] end
end

local function choose(seed, shapes)
  local r, pick = random(seed)
  local function gap() return 0.05 * 80 ^ r() end -- 0.05 to 4 edges
  local function hold()
    local kind = pick{ "clamp", "clamp", "grip", "grip", "grip", "pin", "slider" }
    return { kind = kind, width = kind == "grip" and 0.003 + 0.012 * r() or 0 }
  end
  return { shape = pick(shapes), segments = 25 + math.floor(45 * r()), turn = 6.28 * r(),
    swapped = r() < 0.5, cable = pick{ "GXL 0.5", "GXL 1.5", "FLRY-B 0.5", "FLRY-B 10", "H07V-K 10", "soft" },
    gravity = { 0, 0, r() < 0.6 and -9.81 or -1 }, way = 0.25 + 0.05 * r(),
    side = r() < 0.3 and 0.05 * r() or 0,
    dt = pick{ 0.02, 0.01, 0.005, 0.002, 0.0005 }, at = 0.25 + 0.5 * r(), gap = { gap(), gap() },
    hold = { hold(), hold(), hold() }, other = { 0.6 + 1.6 * r(), 0.6 + 2 * r() }, first = r() < 0.5 }
end

local function path(c, s)
  local points = {}
  for k = 0, 60 do
    local way, height = 0.06 * math.sin(k / 20), 0.06 * (1 - math.cos(k / 20))
    points[k + 1] = { way * c, way * s, height }
  end
  return points
end

-- Makes the wire, bent between two clamps, at rest.
local function make(o)
  local scene, c, s = sw.scene{ gravity = o.gravity }, math.cos(o.turn), math.sin(o.turn)
  local ends, curved = { { 0, 0, 0 }, { 0.4 * c, 0.4 * s, 0 } }, o.shape == "curved"
  local p = { segments = o.segments, rolls = o.shape == "rolls" }
  if o.cable ~= "soft" then p.cable = o.cable end
  if o.cable == "soft" then for k, v in pairs(SOFT) do p[k] = v end end
  if curved then p.rest, p.path = "path", path(c, s)
  else p.from, p.to = ends[o.swapped and 2 or 1], ends[o.swapped and 1 or 2] end
  local wire = scene:wire(p)
  scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
  scene:clamp(wire, { s = o.swapped and wire.length or 0 })
  local to = curved and { 0.02 * c, 0.02 * s, o.side - 0.03 }
    or { -o.way * c - o.side * s, -o.way * s + o.side * c, 1e-3 }
  scene:clamp(wire, { s = o.swapped and 0 or wire.length }):follow{ duration = 1, relative = true,
    points = { { 0, 0, 0 }, to } }
  t.fine(scene:run{ duration = 3 })
  return scene, wire
end

local function hold(scene, wire, h, s)
  if h.kind == "slider" then return scene:slider(wire, { s = s, direction = wire:tangent(s) }) end
  return scene[h.kind](scene, wire, { s = s, width = h.width > 0 and h.width or nil })
end

-- Makes a change and a step; notes how much sharper the sharpest bend is.
local function change(o, scene, wire, list, act)
  t.fine(scene:run{ duration = 0.3, dt = 0.01 })
  local before = wire:min_bend_radius{ now = true }
  act()
  local now = wire:min_bend_radius{ now = true }
  local run = t.fine(scene:run{ duration = o.dt, dt = o.dt })
  for _, event in ipairs(run.events) do
    assert(event.kind == "edges", ("%s, %g s: %s"):format(o.cable, o.dt, event.kind))
  end
  list[#list + 1] = { before / wire:min_bend_radius{ now = true }, o }
  list.now[#list.now + 1] = { before / now, o }
end

-- Where three holds are, the third one in between [m].
local function places(o, wire)
  local edge, w = wire.length / o.segments, { o.hold[1].width, o.hold[2].width, o.hold[3].width }
  local one = o.at * wire.length
  local third = one + 0.5 * (w[1] + w[3]) + o.gap[1] * edge
  return one, third + 0.5 * (w[3] + w[2]) + o.gap[2] * edge, third
end

local acts = {
  ["gets a hold near another, then one between both"] = function(o, scene, wire, list)
    local one, two, third = places(o, wire)
    hold(scene, wire, o.hold[1], one)
    change(o, scene, wire, list, function() hold(scene, wire, o.hold[2], two) end)
    change(o, scene, wire, list, function() hold(scene, wire, o.hold[3], third) end)
  end,
  ["is let go by one of three holds"] = function(o, scene, wire, list)
    local one, two, third = places(o, wire)
    local holds = { hold(scene, wire, o.hold[1], one), hold(scene, wire, o.hold[2], two) }
    hold(scene, wire, o.hold[3], third)
    change(o, scene, wire, list, function() holds[o.first and 1 or 2]:release() end)
  end,
  ["gets other segments with its scene, twice"] = function(o, scene, wire, list)
    local one, two = places(o, wire)
    hold(scene, wire, o.hold[1], one)
    hold(scene, wire, o.hold[2], two)
    for _, share in ipairs(o.other) do
      change(o, scene, wire, list, function() core.remesh(scene, { math.floor(share * o.segments) }) end)
    end
  end,
  ["is remodelled with other segments, twice"] = function(o, scene, wire, list)
    local one, two = places(o, wire)
    if o.shape ~= "arch" then return end
    for k, s in ipairs{ one, two } do
      if o.hold[k].kind ~= "slider" then hold(scene, wire, o.hold[k], s) end
    end
    for _, share in ipairs(o.other) do
      change(o, scene, wire, list, function()
        wire:remodel{ model = "rod", segments = math.floor(share * o.segments) }
      end)
    end
  end,
}

-- Bends are read at nodes and taken between them on straight lines, which are h^2 k''/8 off. Where a bend k
-- changes along the way 1/k this is k (k h)^2/8: 0.03 k with edges as long as half the bend radius. Between
-- two holds within an edge, what does not fit adds as much again: h^2/L^2 of k over a gap L of four edges h.
local LIMIT = 0.10

describe("a bent wire at rest keeps its sharpest bend if it", function()
  for what, act in pairs(acts) do
    for _, shapes in ipairs{ { "arch", "arch", "arch", "rolls" }, { "curved" } } do
      if shapes[1] == "arch" or not what:find "remodelled" then
        it(("%s: %s"):format(what, table.concat(shapes, " ")), function()
          local list = { now = {} }
          for seed = 1, 40 do
            local o = choose(seed, shapes)
            local scene, wire = make(o)
            act(o, scene, wire, list)
          end
          for name, all in pairs{ ["after a step"] = list, ["at once"] = list.now } do
            table.sort(all, function(a, b) return a[1] < b[1] end)
            local worst = all[#all]
            t.below(1.01, all[#all // 2][1], name .. ", median, bend over that before")
            t.below(1 + LIMIT, worst[1], ("%s, worst of %d (%s, %d segments, %g and %g edges, %g s)"):format(
              name, #all, worst[2].cable, worst[2].segments, worst[2].gap[1], worst[2].gap[2], worst[2].dt))
          end
        end)
      end
    end
  end

  -- A wave on 100 pins. The wire is bent everywhere; such a stretch is eased in parts.
  it("is remodelled on many pins", function()
    local scene, points, n = sw.scene{}, {}, 100
    for i = 0, 20 * n do
      local x = 0.0025 * i
      points[i + 1] = { x, 0.01 * math.sin(25 * x), 0.004 * math.cos(13 * x) }
    end
    local wire = scene:wire{ EI = 1e-3, EA = 1e3, GJ = 1e-3, mass_per_length = 0.03, radius = 0.002,
      path = points, segments = 5 * n }
    for k = 0, n do scene:pin(wire, { s = k * wire.length / n }) end
    assert.is_true(scene:settle().ok)
    local before = wire:min_bend_radius()
    wire:remodel{ model = "rod", segments = 7 * n }
    t.near(before, wire:min_bend_radius(), LIMIT * before, "bend radius at once")
    t.fine(scene:run{ dt = 0.01, duration = 0.01 })
    t.near(before, wire:min_bend_radius(), LIMIT * before, "bend radius after a step")
  end)
end)
