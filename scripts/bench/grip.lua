-- SPDX-License-Identifier: GPL-3.0-or-later
--- Measures grippers: the two-plate test (a wire on a table is gripped, lifted, carried, laid down) with each
-- way of handling, and grips under extreme conditions.
-- @module bench.grip
local core = require "softworld.core"

local benchgrip = {}

local radius, length, width, force = 0.003, 0.2, 0.02, 20 -- [m], [N]
local table_friction = 0.4 -- friction of a rough table [-]

--- Ways of handling, by their names in rows; with the friction of the table (default 0).
benchgrip.ways = { { "imposed", "rod", "imposed" }, { "plates, rod", "rod", "plates" },
  { "mixed", "rod", "mixed" }, { "plates, mesh near pads", "rod", "mixed", freeze = false },
  { "plates, radial", "radial", "plates" },
  { "plates, radial, rough table", "radial", "plates", friction = table_friction } }

local function scene_of(o)
  local sw = require "softworld"
  local scene = sw.scene{ name = "two plates", gravity = o.gravity }
  scene:obstacle{ name = "table", shape = "plane", friction = o.friction or 0 }
  scene:force{ kind = "damping", mass = 8 }
  local wire = scene:wire{ model = o.model, section = o.model == "radial" and "solid" or nil, E = o.E or 1e7,
    particles = o.particles, nu = 0.4, density = 1200, radius = o.radius or radius,
    from = { 0, 0, o.radius or radius },
    to = { length, 0, o.radius or radius } }
  local pads = { width = width, friction = 0.6, opening = 0.009 }
  for k, v in pairs(o.pads or {}) do pads[k] = v end
  return scene, wire, scene:gripper{ name = "hand", pads = pads }
end

--- The reference for the others: a finer mesh between plates, with small steps.
benchgrip.reference = { "reference", "radial", "plates", particles = 12 }

--- Runs the two-plate test with one of the ways. Returns { name, phases = { { name, wall, time } }, force,
-- moment, height, droop }: computing time and simulated time of each phase (grasp, lift, carry, lay) [s];
-- and, while lifted, force [N] and moment [N m] of the gripper, height of the section [m], droop of the
-- wire's end [m].
function benchgrip.two_plates(way, dt)
  local scene, wire, hand = scene_of{ model = way[2], particles = way.particles,
    friction = way.friction }
  local row, clock, began = { name = way[1], phases = {} }, core.clock(), 0
  local function phase(name)
    local now = core.clock()
    row.phases[#row.phases + 1] = { name = name, wall = now - clock, time = scene.time - began }
    clock, began = now, scene.time
  end
  local args = { s = length / 2, approach = way[3], freeze = way.freeze }
  if way[3] ~= "imposed" then args.force = force end
  scene:process(function(p)
    hand:grasp(wire, args)
    phase "grasp"
    hand:move{ by = { 0, 0, 0.12 }, duration = 1 }
    phase "lift"
    p:wait(1.5)
    row.force, row.moment = hand:force()[3], hand:moment{ at = wire:position(length / 4) }[2]
    row.droop = hand:position()[3] - wire:position(0)[3]
    row.height = way[3] ~= "imposed" and hand:squeeze().height or nil
    hand:move{ by = { 0, 0.3, 0 }, duration = 2 }
    p:wait(0.5)
    phase "carry"
    hand:move{ by = { 0, 0, -0.115 }, duration = 1 }
    hand:release()
    phase "lay"
  end)
  local run = scene:run{ dt = dt or 0.01 }
  row.ok, row.reason, row.time, row.wall = run.ok, run.reason, run.time, run.wall
  row.rejected, row.steps = run.rejected, run.steps
  scene:close()
  return row
end

--- Compares ways and steps with the reference. Returns rows with dt and error (of the end's droop over the
-- wire's length [%]). Calls each(row) for every row.
function benchgrip.compare(each)
  local reference = benchgrip.two_plates(benchgrip.reference, 0.005)
  each(reference)
  for _, way in ipairs(benchgrip.ways) do
    for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
      local row = benchgrip.two_plates(way, dt)
      row.dt, row.rough = dt, way.friction
      row.error = row.ok and 100 * math.abs(row.droop - reference.droop) / length or 0 / 0
      each(row)
    end
  end
end

-- --- difficult grips -------------------------------------------------------------------

local function grip(o, body, check)
  local scene, wire, hand = scene_of(o)
  local began, row = core.clock(), { status = "ok" }
  scene:process(function(p) body(p, hand, wire, scene) end)
  local fine, run = pcall(scene.run, scene, { dt = o.dt, integrator = o.integrator })
  row.wall = core.clock() - began
  if not fine then
    row.status, row.reason, row.note = "refused", tostring(run), tostring(run):match "[^\n]*"
  else
    row.steps, row.rejected = run.steps, run.rejected
    if not run.ok then row.status, row.reason = "failed", run.reason
    else row.note = check(hand, wire, row) end
  end
  scene:close()
  return row
end

local function hold(p, hand, wire, o)
  hand:grasp(wire, { s = length / 2, approach = "plates", force = o.force or force })
  p:wait(0.1)
end

local function held(hand, _, row)
  if hand.slip_event then row.status = "slips" end
  for _, e in ipairs(hand.events) do
    if e.kind == "lost" then row.status = "lost" end
  end
  return ("%.2f N per finger, slip %.2g mm"):format(hand:state().squeeze, 1e3 * hand:state().slip)
end

-- The gripper moves to and fro at a high speed.
local function fast(o)
  return grip(o, function(p, hand, wire)
    hold(p, hand, wire, o)
    for k = 1, 4 do hand:move{ by = { 0, 0, k % 2 == 1 and 0.3 or -0.2 }, speed = o.speed } end
  end, held)
end

-- The wire is lifted with different friction of the pads, also without friction.
local function rough(o)
  return grip(o, function(p, hand, wire)
    hold(p, hand, wire, o)
    hand:move{ by = { 0, 0, 0.1 }, duration = 0.5 }
    p:wait(0.2)
  end, held)
end

-- The jaws meet the wire at an angle.
local function slanted(o)
  return grip(o, function(p, hand, wire, scene)
    local half = o.angle / 2
    hand.rotation = { math.cos(half), 0, 0, math.sin(half) } -- about z, relative to the wire
    hold(p, hand, wire, o)
    hand:move{ by = { 0, 0, 0.1 }, duration = 0.5 }
    p:wait(scene.time > 0 and 0.2 or 0)
  end, held)
end

--- Calls add(item, run, options) for every row of the stability map.
function benchgrip.add_all(add)
  for _, model in ipairs{ "rod", "radial" } do
    local function put(item, run, o)
      o.model, o.dt = model, o.dt or 0.005
      add(item, run, o)
    end
    for _, speed in ipairs{ 1, 5 } do
      put(("grip thrown at %g m/s"):format(speed), fast, { speed = speed, pads = { friction = 0.8 } })
    end
    for _, friction in ipairs{ 0, 0.05, 5 } do
      put(("lifted with friction %g"):format(friction), rough, { pads = { friction = friction } })
    end
    put("pads askew by 30 degrees", slanted, { angle = math.rad(30), pads = { opening = 0.03 } })
    put("pads narrower than the mesh", rough, { pads = { width = 0.001 } })
    put("a pin for a pad", rough, { pads = { shape = "round", radius = 0.001 } })
    put("a force of 100 kN", rough, { force = 1e5 })
  end
end

return benchgrip
