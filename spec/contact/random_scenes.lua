-- SPDX-License-Identifier: GPL-3.0-or-later
-- Random scenes of contact and views of them: turned, mirrored, with the wires' ends swapped, with other
-- nodes. A plan and a view give a scene.
local sw = require "softworld"
local random_plans = require "contact.random_plans"
local vec = require "softworld.vec"

local random_scenes = { plan = random_plans.plan }

local add, scale = vec.add, vec.scale

-- view: turn (quaternion), mirror (true: y becomes -y, before the turn), swap (true: s counts from the
-- other end), segments (function of the planned number), shift (of inner nodes, in edges), nudge (offset of
-- the wires at the start [m]).
local function seer(view)
  local turn, see = view.turn or { 1, 0, 0, 0 }, {}
  local function mirrored(v) return view.mirror and { v[1], -v[2], v[3] } or v end
  see.mirrored = mirrored
  function see.vector(v) return v and vec.rotate(turn, mirrored(v)) end
  function see.spin(axis) return scale(see.vector(axis), view.mirror and -1 or 1) end -- an axial vector
  function see.rotation(q)
    local m = view.mirror and { q[1], -q[2], q[3], -q[4] } or q
    return vec.multiply(turn, m)
  end
  function see.s(w, share) return w.length * (view.swap and 1 - share or share) end
  return see
end

local function local_shape(o, see, mirror)
  local args = random_plans.shape_args(o)
  if not mirror then return args end
  local function flat(list)
    local out = {}
    for i = 1, #list, 3 do out[i], out[i + 1], out[i + 2] = list[i], -list[i + 1], list[i + 2] end
    return out
  end
  if o.points then args.points = flat(o.points) end
  if o.vertices then
    local faces = {}
    for i = 1, #o.faces, 3 do
      faces[i], faces[i + 1], faces[i + 2] = o.faces[i], o.faces[i + 2], o.faces[i + 1]
    end
    args.data = random_plans.obj_of(flat(o.vertices), faces)
  end
  if o.normal then args.normal = see.mirrored(o.normal) end
  return args
end

local function path_of(move, see)
  local by = see.vector(move.by)
  local path = { points = { { 0, 0, 0 }, by }, relative = true, duration = move.time }
  if move.axis then path.turn = { axis = see.spin(move.axis), angle = move.angle } end
  return path
end

local function put_obstacle(scene, o, see, view)
  local args = local_shape(o, see, view.mirror)
  args.at, args.rotation = see.vector(o.at), see.rotation(o.rotation)
  args.friction, args.kinetic_friction, args.restitution = o.friction, o.kinetic_friction, o.restitution
  local obstacle = scene:obstacle(args)
  if o.move then obstacle:follow(path_of(o.move, see)) end
  return obstacle
end

-- Moves inner nodes along the wire by a share of an edge: a pin takes each node and lets go at once.
local function shift_nodes(scene, wire, segments, share)
  for i = 1, segments - 1 do scene:pin(wire, { s = (i + share) * wire.length / segments }):release() end
end

local function put_wire(scene, w, see, view)
  local path, beside = {}, see.vector(view.nudge or { 0, 0, 0 })
  for i, p in ipairs(w.path) do
    path[view.swap and #w.path + 1 - i or i] = add(see.vector(p), beside)
  end
  local args = { cable = w.cable, EI = w.EI, EA = w.EA, GJ = w.GJ, radius = w.radius,
    mass_per_length = w.mass_per_length, path = path, rest = w.rest,
    segments = view.segments and view.segments(w.segments) or w.segments }
  local wire = scene:wire(args)
  if view.shift then shift_nodes(scene, wire, args.segments, view.shift) end
  if w.velocity then wire:set_velocity(see.vector(w.velocity)) end
  return wire
end

local put = {}
local function held(kind, with)
  put[kind] = function(scene, wire, h, see)
    local args = { s = see.s(wire, h.share) }
    if with then args[with] = h[with] end
    local hold = scene[kind](scene, wire, args)
    if h.move and kind ~= "pin" then hold:follow(path_of(h.move, see))
    elseif h.move then hold:follow(path_of({ by = h.move.by, time = h.move.time }, see)) end
    return hold
  end
end
held "clamp"
held "pin"
held("grip", "width")
held("feed", "speed")

function put.gripper(scene, wire, h, see)
  local gripper = scene:gripper{ pads = { width = h.width } }
  scene:process(function(p)
    gripper:grasp(wire, { s = see.s(wire, h.share) })
    if not h.move then return p:wait(1) end
    local path = path_of(h.move, see)
    gripper:move{ by = path.points[2], duration = h.move.time, turn = path.turn }
  end)
end

function put.tie(scene, wire, h, see)
  return scene:tie(wire, { s = see.s(wire, h.share), slack = h.slack, stiffness = h.stiffness,
    to = add(wire:position(see.s(wire, h.share)), see.vector(h.to)) })
end

-- The wire is already in the clip's seat.
function put.clip(scene, wire, h, see)
  local s = see.s(wire, h.share)
  local along = add(wire:position(s + 1e-3), wire:position(s - 1e-3), -1)
  return scene:clip{ at = wire:position(s), axis = along, direction = see.vector{ 0, 0, 1 }, width = h.width,
    insertion = h.insertion, retention = h.retention, friction = h.friction }
end

--- The scene of a plan and a view, its wires, obstacles and holds (ties and clips too, no grippers).
function random_scenes.scene(plan, view)
  view = view or {}
  local see = seer(view)
  local scene = sw.scene{ gravity = see.vector(plan.gravity) }
  local wires, obstacles, holds = {}, {}, {}
  for i, o in ipairs(plan.obstacles) do obstacles[i] = put_obstacle(scene, o, see, view) end
  for i, w in ipairs(plan.wires) do
    wires[i] = put_wire(scene, w, see, view)
    for _, h in ipairs(w.holds) do holds[#holds + 1] = put[h.kind](scene, wires[i], h, see) end
  end
  if plan.touching then scene:wire_contact(plan.touching) end
  if plan.damping then
    scene:force{ kind = "damping", mass = plan.damping.mass, stiffness = plan.damping.stiffness }
  end
  return scene, wires, obstacles, holds
end

-- --- outcomes of runs ---------------------------------------------------------------------------

local PLACES = 20 -- places of a wire that are compared, besides its start

local function places_of(wire, view)
  local back, list = vec.conjugate(view.turn or { 1, 0, 0, 0 }), {}
  for i = 0, PLACES do
    local p = vec.rotate(back, wire:position(wire.length * (view.swap and PLACES - i or i) / PLACES))
    list[i + 1] = view.mirror and { p[1], -p[2], p[3] } or p
  end
  return list
end

-- Returns the energies [J]: the present ones by kind, the losses, and the sum of energy from nowhere and
-- work of the scene's changes, which cannot be told apart for a wire that is let out of an obstacle it
-- began in.
local function energies_of(run)
  local l, lost = run:ledger(), 0
  for _, w in pairs(l.lost) do lost = lost + w end
  return { kinetic = l.kinetic, stored = l.stored, gravity = l.gravity, lost = lost,
    gap = l.gap + l.work.changes }, l.play
end

--- Runs a plan in a view. Returns ok and reason; places of all wires, in the plan's frame [m]; peaks of
-- means over 10 ms: tension of each wire, force on each obstacle [N]; energies and the energy in play [J];
-- solves per simulated second; the run.
function random_scenes.outcome(plan, view)
  view = view or {}
  local scene <close>, wires, obstacles = random_scenes.scene(plan, view)
  local run = scene:run{ duration = plan.duration, dt = plan.dt, integrator = plan.integrator,
    tolerance = plan.tolerance, quasistatic = plan.quasistatic or nil }
  local out = { ok = run.ok, reason = run.reason, rate = run.iterations / run.time, run = run,
    places = {}, peaks = {} }
  if not run.ok then return out end
  for i, w in ipairs(wires) do
    table.move(places_of(w, view), 1, PLACES + 1, #out.places + 1, out.places)
    out.peaks["tension of wire " .. i] = w:max_tension()
  end
  for i, o in ipairs(obstacles) do out.peaks["force on obstacle " .. i] = o:over().peak_force end
  out.energies, out.play = energies_of(run)
  return out
end

--- Returns the differences of two outcomes: the largest distance of places over the shortest wire's length;
-- of peaks, over the largest peak; of energies, over the energy in play. which and what name the peak and
-- the energy meant.
function random_scenes.difference(plan, a, b)
  local length, d = math.huge, { place = 0, peak = 0, energy = 0 }
  for _, w in ipairs(plan.wires) do length = math.min(length, w.length) end
  for i, p in ipairs(a.places) do d.place = math.max(d.place, vec.norm(add(p, b.places[i], -1)) / length) end
  local largest = 0
  for name, peak in pairs(a.peaks) do largest = math.max(largest, peak, b.peaks[name]) end
  for name, peak in pairs(a.peaks) do
    local off = math.abs(peak - b.peaks[name])
    if off > d.peak * largest then d.peak, d.which = off / largest, name end
  end
  for name, energy in pairs(a.energies) do
    local off = math.abs(energy - b.energies[name]) / a.play
    if off > d.energy then d.energy, d.what = off, name end
  end
  return d
end

return random_scenes
