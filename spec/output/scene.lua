-- SPDX-License-Identifier: GPL-3.0-or-later
-- An invented laying for the specs of the writers: a gripper drags a wire by its first end in arches over
-- thin walls on a table. Kinematics only.

local scene = {}

local walls = { 0.4, 0.9, 1.4 }
local wall_height, clearance = 0.1, 0.04

-- Position of the gripper at the share u of the laying, 0..1.
local function tip(u)
  local x = 0.05 + 1.75 * u
  local z = 0.004
  for _, wall in ipairs(walls) do
    local away = (x - wall) / 0.16
    if math.abs(away) < 1 then
      z = math.max(z, 0.004 + (wall_height + clearance) * math.cos(away * math.pi / 2) ^ 0.8)
    end
  end
  return x, 0.03 * math.sin(6 * u), z
end

-- The wire follows the gripper and lies over the walls that it has passed.
local function rest_height(x, radius)
  local z = radius
  for _, wall in ipairs(walls) do
    local away = math.abs(x - wall)
    z = math.max(z, wall_height + radius - 1.1 * math.max(0, away - 0.012) ^ 1.0)
  end
  return z
end

local function wire_points(u, length, segments, radius)
  local points, tx, ty, tz = {}, tip(u)
  for i = 0, segments do
    local s = length * i / segments
    local share = math.exp(-(s / 0.12) ^ 2)
    local x = tx - 0.965 * s
    local floor = x < walls[1] - 0.2 and radius or rest_height(x, radius)
    local wave = 0.05 * math.sin(5 * x) * (1 - math.exp(-(s / 0.3) ^ 2))
    local z = math.max(floor, share * tz + (1 - share) * floor)
    points[3 * i + 1], points[3 * i + 2], points[3 * i + 3] = x, ty * share + wave, z
  end
  return points
end

local function series(frames, duration)
  local time, force, energy = {}, {}, {}
  for i = 0, 200 do
    local t = duration * i / 200
    time[i + 1] = t
    force[i + 1] = 0.8 + 0.3 * math.sin(9 * t) ^ 2 + 0.05 * t
    energy[i + 1] = 0.002 * math.sin(3 * t) ^ 2 + frames * 1e-6
  end
  return {
    time = time,
    columns = {
      { name = "left.force", unit = "N", values = force },
      { name = "energy.kinetic", unit = "J", values = energy },
    },
  }
end

--- options: frames (default 31), segments (100), length (1.6).
function scene.run(options)
  options = options or {}
  local count, duration = options.frames or 31, 5.0
  local length, segments, radius = options.length or 1.6, options.segments or 100, options.radius or 0.0025
  local run = {
    name = "laying", ok = true, reason = "end of the processes", time = duration, steps = 500, wall = 0.03,
    cpu = 0.03, gravity = { 0, 0, -9.81 },
    wires = { { name = "wire", radius = radius, length = length, segments = segments } },
    obstacles = { { name = "table", shape = "plane", normal = { 0, 0, 1 } } },
    grips = { { name = "left", width = 0.02 } }, frames = {},
    summary = { { label = "left: peak force", value = 1.234, unit = "N", where = "s = 0.2 m", when = 1.25 } },
  }
  local poses = { { position = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 } } }
  for i, x in ipairs(walls) do
    run.obstacles[i + 1] = { name = "wall" .. i, shape = "box", size = { 0.01, 1, wall_height } }
    poses[i + 1] = { position = { x, 0, wall_height / 2 }, rotation = { 1, 0, 0, 0 } }
  end
  for f = 0, count - 1 do
    local u = count > 1 and f / (count - 1) or 0
    local x, y, z = tip(u)
    run.frames[f + 1] = {
      t = duration * u, wires = { wire_points(u, length, segments, radius) }, obstacles = poses,
      grips = { { position = { x, y, z }, rotation = { 1, 0, 0, 0 }, held = true } },
    }
  end
  run.series = series(count, duration)
  return run
end

--- The surface of a wire that is a mesh: a tube along x with `around` points in each of `sections`.
function scene.surface(around, sections, radius)
  local surface, line = { around = around, points = {}, force = {} }, {}
  for i = 0, sections - 1 do
    for _, x in ipairs { 0.1 * i, 0, 0.05 } do line[#line + 1] = x end
    for k = 0, around - 1 do
      local a = 2 * math.pi * k / around
      for _, x in ipairs { 0.1 * i, radius * math.cos(a), 0.05 + radius * math.sin(a) } do
        surface.points[#surface.points + 1] = x
      end
      surface.force[#surface.force + 1] = i + k / 10
    end
  end
  return surface, line
end

return scene
