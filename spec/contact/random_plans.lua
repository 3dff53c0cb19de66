-- SPDX-License-Identifier: GPL-3.0-or-later
-- Plans of random scenes of contact. A seed gives one plan: a plain table without objects, in its own
-- frame.
local sw = require "softworld"
local vec = require "softworld.vec"
local samples = require "contract.samples"

local random_plans = {}

local add, scale, unit, dot = vec.add, vec.scale, vec.unit, vec.dot

local CABLES = { "GXL 0.5", "GXL 1.5", "FLRY-B 10", "H07V-K 10", "identified white" }
local CLEAR = 5e-4 -- least distance of wires from obstacles at the start [m]

local function dice(seed)
  local number = samples.random(seed)
  local d = { between = number }
  function d.chance(p) return number(0, 1) < p end
  function d.whole(low, high) return low + math.floor(number(0, high + 1 - low - 1e-9)) end
  function d.of(list) return list[d.whole(1, #list)] end
  function d.direction()
    while true do
      local v = { number(-1, 1), number(-1, 1), number(-1, 1) }
      local n = vec.norm(v)
      if n > 0.1 and n < 1 then return scale(v, 1 / n) end
    end
  end
  return d
end

-- Returns places along a wire's path, dense enough to check distances.
local function places(path)
  local list, parts = {}, 72 // (#path - 1)
  for i = 1, #path - 1 do
    local edge = add(path[i + 1], path[i], -1)
    for k = 0, parts - 1 do list[#list + 1] = add(path[i], edge, k / parts) end
  end
  list[#list + 1] = path[#path]
  return list
end

local function wire_plan(d)
  local length = d.between(0.25, 0.6)
  local w = { segments = d.whole(20, 40) }
  if d.chance(0.5) then w.cable = d.of(CABLES)
  else
    local EI = 10 ^ d.between(-4.5, -2)
    w.radius = d.between(1e-3, 3e-3)
    w.EI, w.EA, w.GJ = EI, 4 * EI / w.radius ^ 2, EI
    w.mass_per_length = d.between(0.01, 0.06)
  end
  local turn = d.between(-0.3, 0.3)
  local along = { math.cos(turn), math.sin(turn), d.chance(0.5) and 0 or d.between(-0.3, 0.3) }
  along = unit(along)
  w.path = { scale(along, -length / 2), scale(along, length / 2) }
  if d.chance(0.2) then -- an arc
    local bend, side = d.between(-1, 1), unit(vec.cross(along, { 0, 0, 1 }))
    w.path = {}
    for i = 0, 24 do
      local angle = bend * (i / 24 - 0.5)
      w.path[i + 1] = add(scale(along, length * math.sin(angle) / bend), side,
        length * (1 - math.cos(angle)) / bend)
    end
    w.rest = d.of{ "path", "straight" }
  end
  w.length = length
  return w
end

local function thickness(w) return w.radius or sw.cable(w.cable).outer_diameter.value / 2 end

local function octahedron(size)
  local p = { size[1], 0, 0, -size[1], 0, 0, 0, size[2], 0, 0, -size[2], 0, 0, 0, size[3], 0, 0, -size[3] }
  return p, { 1, 3, 5, 3, 2, 5, 2, 4, 5, 4, 1, 5, 3, 1, 6, 2, 3, 6, 4, 2, 6, 1, 4, 6 }
end

-- A roof over a rectangle: two slopes, two gables, a floor.
local function roof(size)
  local x, y, z = size[1], size[2], size[3]
  local p = { -x, -y, 0, x, -y, 0, x, y, 0, -x, y, 0, 0, -y, z, 0, y, z }
  return p, { 1, 5, 4, 4, 5, 6, 2, 3, 5, 3, 6, 5, 1, 2, 5, 4, 6, 3, 1, 4, 2, 4, 3, 2 }
end

local shapes = {
  box = function(d)
    local thin = d.chance(0.3) and 0.1 or 1
    return { size = { thin * d.between(0.01, 0.06), d.between(0.02, 0.2), d.between(0.01, 0.08) } }
  end,
  sphere = function(d) return { radius = d.between(0.005, 0.05) } end,
  cylinder = function(d) return { radius = d.between(0.003, 0.04), length = d.between(0.02, 0.2) } end,
  capsule = function(d) return { radius = d.between(0.003, 0.03), length = d.between(0.02, 0.2) } end,
  hull = function(d)
    local points = {}
    for i = 1, d.whole(5, 12) do
      local p = scale(d.direction(), d.between(0.02, 0.05))
      points[3 * i - 2], points[3 * i - 1], points[3 * i] = p[1], p[2], p[3]
    end
    return { points = points }
  end,
  mesh = function(d)
    local size = { d.between(0.01, 0.05), d.between(0.01, 0.05), d.between(0.01, 0.05) }
    local points, faces = (d.chance(0.5) and octahedron or roof)(size)
    return { vertices = points, faces = faces }
  end,
}
local kinds = { "box", "box", "sphere", "cylinder", "cylinder", "capsule", "hull", "mesh" }

local function surface(d)
  local s = { friction = d.chance(0.15) and 0 or d.between(0, 1) }
  if d.chance(0.2) then s.kinetic_friction = s.friction * d.between(0.5, 1) end
  if d.chance(0.2) then s.restitution = d.between(0.1, 0.9) end
  return s
end

--- Returns a mesh as the text of a file.
function random_plans.obj_of(vertices, faces)
  local lines = {}
  for i = 1, #vertices, 3 do
    lines[#lines + 1] = ("v %.17g %.17g %.17g"):format(vertices[i], vertices[i + 1], vertices[i + 2])
  end
  for i = 1, #faces, 3 do lines[#lines + 1] = ("f %d %d %d"):format(faces[i], faces[i + 1], faces[i + 2]) end
  return table.concat(lines, "\n") .. "\n"
end

--- Returns the arguments of an obstacle's shape.
function random_plans.shape_args(o)
  return { shape = o.shape, size = o.size, radius = o.radius, length = o.length, points = o.points,
    normal = o.normal, data = o.vertices and random_plans.obj_of(o.vertices, o.faces),
    format = o.vertices and "obj" }
end

-- Returns the distance of an obstacle's surface from the wires' surfaces.
local function room(o, shape, wires)
  local back, least = vec.conjugate(o.rotation), math.huge
  for _, w in ipairs(wires) do
    for _, p in ipairs(w.places) do
      least = math.min(least, shape:distance(vec.rotate(back, add(p, o.at, -1))) - w.thick)
    end
  end
  return least
end

-- Moves an obstacle from far away towards a place of a wire until no more than gap is left. A hull that does
-- not contain its origin may pass by; it stays beyond the wires.
local function bring_near(o, wires, from, towards, gap)
  local shape, way = sw.core.shape(random_plans.shape_args(o)), 1
  repeat
    o.at = add(towards, from, way)
    local left = room(o, shape, wires) - gap
    way = way - left
  until left < CLEAR or way < -1
end

local function obstacle_plan(d, wires, from)
  local kind = d.of(kinds)
  local o = shapes[kind](d)
  for k, v in pairs(surface(d)) do o[k] = v end
  o.shape = kind
  o.rotation = d.chance(0.3) and { 1, 0, 0, 0 } or vec.turn(d.direction(), d.between(-3, 3))
  local w = d.of(wires)
  from = unit(add(from, d.direction(), 0.4))
  bring_near(o, wires, from, d.of(w.places), d.chance(0.3) and 0 or d.between(0, 0.02))
  if d.chance(0.25) then
    o.move = { by = scale(unit(add(scale(from, -1), d.direction(), 0.6)), d.between(0.01, 0.1)),
      time = d.between(0.1, 0.4) }
    if d.chance(0.4) then o.move.axis, o.move.angle = d.direction(), d.between(-1.5, 1.5) end
  end
  return o
end

local function plane_plan(d, wires)
  local o = surface(d)
  o.shape, o.rotation = "plane", { 1, 0, 0, 0 }
  o.normal = d.chance(0.5) and { 0, 0, 1 } or unit{ d.between(-0.4, 0.4), d.between(-0.4, 0.4), 1 }
  bring_near(o, wires, { 0, 0, -1 }, wires[1].places[1], d.chance(0.4) and -CLEAR or d.between(0.01, 0.06))
  return o
end

-- A random motion, upwards and to a side; if `towards` is given, also that way.
local function motion(d, most, towards)
  local way = d.direction()
  way[3] = math.abs(way[3])
  if towards and dot(way, towards) < 0 then way = add(way, towards, -2 * dot(way, towards)) end
  local m = { by = scale(way, d.between(0.01, most)), time = d.between(0.1, 0.4) }
  if d.chance(0.3) then m.axis, m.angle = d.direction(), d.between(-1, 1) end
  return m
end

-- What holds a wire; at shares of its length.
local function holds_plan(d, w, still)
  local kind = d.of{ "none", "clamp", "clamp", "pin", "two", "grip", "gripper", "feed", "tie", "clip" }
  if still and (kind == "none" or kind == "tie") then kind = "clamp" end
  local first, last = w.path[1], w.path[#w.path]
  local function moves(towards) return d.chance(0.7) and motion(d, 0.25 * w.length, towards) or nil end
  local at = d.of{ 0, 1, d.between(0.2, 0.8) }
  if kind == "none" then return {} end
  if kind == "two" then
    return { { kind = d.of{ "clamp", "pin" }, share = 0 }, { kind = "clamp", share = 1,
      move = moves(unit(add(first, last, -1))) } }
  elseif kind == "grip" or kind == "gripper" then
    return { { kind = kind, share = d.between(0.05, 0.95), width = d.between(0.005, 0.02),
      move = motion(d, 0.25 * w.length) } }
  elseif kind == "feed" then
    return { { kind = "feed", share = d.of{ 0, 1 }, speed = d.between(-0.1, 0.4) } }
  elseif kind == "tie" then
    return { { kind = "tie", share = at, to = scale(d.direction(), 0.05),
      slack = d.chance(0.5) and 0.06 or nil, -- not shorter than the tie: it would yank
      stiffness = 10 ^ d.between(2, 5) } }
  elseif kind == "clip" then
    return { { kind = "clip", share = 0.5, width = d.between(0.005, 0.01), insertion = d.between(2, 10),
      retention = d.between(5, 30), friction = d.between(0, 0.4) },
      { kind = "clamp", share = d.of{ 0, 1 }, move = motion(d, 0.1 * w.length) } }
  end
  return { { kind = kind, share = at, move = moves() } }
end

local function wires_plan(d)
  local wires = { wire_plan(d) }
  if d.chance(0.15) then
    wires[2] = wire_plan(d)
    local up = { 0, 0, d.between(0.15, 0.25) * math.max(wires[1].length, wires[2].length) }
    for i, p in ipairs(wires[2].path) do wires[2].path[i] = add(p, up) end
  end
  for _, w in ipairs(wires) do w.thick, w.places = thickness(w), places(w.path) end
  return wires
end

-- Returns where a moving thing is after a share of its way.
local function brought(at, move, share) return move and add(at, move.by, share) or at end

-- Returns true if an obstacle comes so near to a hold that both might squeeze the wire.
local function squeezes(o, w, h)
  local shape = sw.core.shape(random_plans.shape_args(o))
  local at = w.places[1 + math.floor(h.share * (#w.places - 1) + 0.5)]
  for share = 0.1, 1, 0.1 do
    local turn = o.rotation
    if o.move and o.move.axis then turn = vec.multiply(vec.turn(o.move.axis, share * o.move.angle), turn) end
    local p = add(brought(at, h.move, share), brought(o.at, o.move, share), -1)
    if shape:distance(vec.rotate(vec.conjugate(turn), p)) < w.thick + 0.01 then return true end
  end
  return false
end

-- Stops each hold or obstacle whose motion would squeeze a wire between both: rigid things squeeze without
-- limit.
local function keep_apart(plan)
  for _, w in ipairs(plan.wires) do
    for _, h in ipairs(w.holds) do
      for _, o in ipairs(plan.obstacles) do
        if (o.move or h.move) and squeezes(o, w, h) then o.move = nil end
        if h.move and squeezes(o, w, h) then h.move = nil end
      end
    end
  end
end

local function times_plan(d, plan)
  plan.quasistatic = d.chance(0.15)
  plan.duration = plan.quasistatic and 0.4 or d.between(0.3, 0.5)
  plan.dt = plan.quasistatic and d.of{ 0.05, 0.02, 0.01 } or d.of{ 0.01, 0.01, 0.01, 0.005, 0.002, 0.001 }
  if not plan.quasistatic then
    plan.integrator = d.chance(0.1) and d.of{ "implicit-euler", "sdirk2", "bdf2" } or nil
    if d.chance(0.1) and not plan.integrator then plan.tolerance = 10 ^ d.between(-5, -4) end
  end
end

--- Returns the plan of a seed.
function random_plans.plan(seed)
  local d = dice(seed)
  local plan = { seed = seed, wires = wires_plan(d), obstacles = {}, gravity = { 0, 0, -9.81 } }
  times_plan(d, plan)
  local from = { 0, 0, -1 }
  for i, w in ipairs(plan.wires) do
    w.holds = holds_plan(d, w, plan.quasistatic)
    if not plan.quasistatic and d.chance(0.5) and #w.holds == 0 then
      w.velocity = scale(d.direction(), 10 ^ d.between(-1, 0.7))
      if i == 1 then from = unit(w.velocity) end
    end
  end
  if dot(from, { 0, 0, 1 }) < 0.3 and d.chance(0.7) then
    plan.obstacles[1] = plane_plan(d, plan.wires)
  end
  for _ = 1, d.whole(#plan.obstacles == 0 and 1 or 0, 4) do
    plan.obstacles[#plan.obstacles + 1] = obstacle_plan(d, plan.wires, from)
  end
  keep_apart(plan)
  if #plan.wires > 1 or d.chance(0.1) then plan.touching = { friction = d.between(0, 0.6) } end
  if d.chance(0.5) then plan.damping = { mass = d.between(0, 3), stiffness = d.between(0, 0.01) } end
  return plan
end

return random_plans
