-- SPDX-License-Identifier: GPL-3.0-or-later
--- Chooses the view: a perspective camera that just holds a whole run.
-- @module softworld.output.view

local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local vec = require "softworld.vec"

local view = {}

local dot, cross = vec.dot, vec.cross

local function unit(a, what)
  local length = math.sqrt(dot(a, a))
  if length == 0 or length ~= length then sink.fail("camera: %s has no direction", what) end
  return { a[1] / length, a[2] / length, a[3] / length }
end

local function combine(a, x, b, y, c, z)
  local out = {}
  for i = 1, 3 do out[i] = a * x[i] + b * y[i] + c * z[i] end
  return out
end

--- Returns the upward direction: against gravity, or z without gravity.
-- @tparam table run
-- @treturn {x,y,z} of unit length
function view.up(run)
  local g = run.gravity
  if not g or dot(g, g) == 0 then return { 0, 0, 1 } end
  return unit({ -g[1], -g[2], -g[3] }, "gravity")
end

-- Returns the horizontal direction in which the points reach furthest, pointing to
-- the side of +x (or of +y if there is no x), by trial every 7.5 degrees.
local function longest(points, up)
  local seed = math.abs(up[1]) < 0.9 and { 1, 0, 0 } or { 0, 1, 0 }
  local e1 = unit(combine(1, seed, -dot(seed, up), up, 0, up))
  local e2 = cross(up, e1)
  local best, best_reach = e1, -1
  for k = 0, 23 do
    local angle = math.rad(7.5 * k)
    local e = combine(math.cos(angle), e1, math.sin(angle), e2, 0, up)
    local low, high = math.huge, -math.huge
    for i = 1, #points do
      local x = dot(points[i], e)
      low, high = math.min(low, x), math.max(high, x)
    end
    if high - low > 1.02 * best_reach then best, best_reach = e, high - low end
  end
  return dot(best, e1) < -1e-9 and combine(-1, best, 0, best, 0, best) or best
end

-- Directions in which outermost points are searched: along the axes and between them.
local outward = {}
for x = -1, 1 do
  for y = -1, 1 do
    for z = -1, 1 do
      if x ~= 0 or y ~= 0 or z ~= 0 then outward[#outward + 1] = { x, y, z } end
    end
  end
end

-- Adds about 50 points of a list, and its outermost points.
local function sample(flat, points)
  local function put(i) points[#points + 1] = { flat[i], flat[i + 1], flat[i + 2] } end
  for i = 1, #flat, 3 * math.max(1, #flat // 150) do put(i) end
  if #flat <= 150 then return end -- all points are in
  for _, d in ipairs(outward) do
    local best, most = 1, -math.huge
    for i = 1, #flat, 3 do
      local x = d[1] * flat[i] + d[2] * flat[i + 1] + d[3] * flat[i + 2]
      if x > most then best, most = i, x end
    end
    put(best)
  end
end

-- Returns one point of each cell of a grid, 64 cells along the longest side, and the outermost points along
-- each axis. Wires pass the same places in many frames.
local function fewer(points)
  local low, high, all = { table.unpack(points[1]) }, { table.unpack(points[1]) }, {}
  local first, last = {}, {}
  for _, p in ipairs(points) do
    for c = 1, 3 do
      if p[c] <= low[c] then low[c], first[c] = p[c], p end
      if p[c] >= high[c] then high[c], last[c] = p[c], p end
    end
  end
  local cell = math.max(high[1] - low[1], high[2] - low[2], high[3] - low[3]) / 64 + 1e-12
  for _, p in ipairs(points) do
    local key = ("%d %d %d"):format((p[1] - low[1]) // cell, (p[2] - low[2]) // cell, (p[3] - low[3]) // cell)
    all[key] = all[key] or p
  end
  local kept = {}
  for _, p in pairs(all) do kept[#kept + 1] = p end
  for c = 1, 3 do table.move({ first[c], last[c] }, 1, 2, #kept + 1, kept) end
  table.sort(kept, function(p, q) -- the same order in each process
    for c = 1, 3 do if p[c] ~= q[c] then return p[c] < q[c] end end
    return false
  end)
  return kept
end

-- Returns points of about 60 frames; a camera needs no more.
local function points_of(run)
  local frames, points = {}, {}
  local total = #run.frames
  local count = math.min(total, 60)
  for k = 0, count - 1 do
    frames[k + 1] = run.frames[count > 1 and 1 + k * (total - 1) // (count - 1) or total]
  end
  solid.bounds(setmetatable({ frames = frames }, { __index = run }), function(flat)
    if #flat >= 3 then sample(flat, points) end
  end)
  if #points == 0 then points[1] = { 0, 0, 0 } end
  return points
end

-- Returns the points to show. run.seen: a table in which they are kept, if the run does not change any more.
local function fit_points(run, extra)
  local seen = run.seen
  local points = seen and seen.points or points_of(run)
  if seen and not seen.points then
    points = fewer(points)
    seen.points = points
  end
  points = table.move(points, 1, #points, 1, {})
  return extra and table.move(extra, 1, #extra, #points + 1, points) or points
end

-- Returns the nearest camera that sees every point within +-tx, +-ty (tangents of the
-- half angles): each bound is linear in the camera's coordinates.
local function fit(points, right, up, forward, tx, ty)
  local ax, bx, ay, by = -math.huge, math.huge, -math.huge, math.huge
  for _, p in ipairs(points) do
    local x, y, z = dot(p, right), dot(p, up), dot(p, forward)
    ax, bx = math.max(ax, x - z * tx), math.min(bx, x + z * tx)
    ay, by = math.max(ay, y - z * ty), math.min(by, y + z * ty)
  end
  local z = math.min((bx - ax) / (2 * tx), (by - ay) / (2 * ty))
  return combine((ax + bx) / 2, right, (ay + by) / 2, up, z, forward)
end

-- Shifts the camera sideways until the scene is in the middle.
local function centre(camera, points)
  for _ = 1, 6 do
    local low, high, depth = { 1, 1 }, { -1, -1 }, 0
    for _, p in ipairs(points) do
      local x, y, z = view.project(camera, p)
      low[1], high[1] = math.min(low[1], x), math.max(high[1], x)
      low[2], high[2] = math.min(low[2], y), math.max(high[2], y)
      depth = depth + z / #points
    end
    camera.filled = (high[2] - low[2]) / 2
    camera.at = combine(1, camera.at, (low[1] + high[1]) / 2 * camera.tx * depth, camera.right,
      (low[2] + high[2]) / 2 * camera.ty * depth, camera.up)
  end
end

local function mean(points)
  local sum = { 0, 0, 0 }
  for _, p in ipairs(points) do sum = combine(1, sum, 1, p, 0, p) end
  return combine(1 / #points, sum, 0, sum, 0, sum)
end

-- Returns the axes of the camera; looking straight up or down keeps the old right.
local function axes(forward, up, side)
  local right = cross(forward, up)
  if dot(right, right) < 1e-8 then right = side end
  right = unit(right, "camera")
  return right, cross(right, forward)
end

local function direction(turn, elevation, side, up)
  turn, elevation = math.rad(turn), math.rad(elevation)
  local ahead = cross(up, side)
  local level = combine(math.cos(turn), ahead, -math.sin(turn), side, 0, up)
  return combine(math.cos(elevation), level, -math.sin(elevation), up, 0, up)
end

local margin = 0.94

local function aim(camera, forward, up, side, points)
  camera.forward = unit(forward, "the view")
  camera.right, camera.up = axes(camera.forward, up, side)
  camera.at = fit(points, camera.right, camera.up, camera.forward, camera.tx * margin, camera.ty * margin)
end

-- True if the points have little extent across a direction. A view turned or
-- raised much would only distort them.
local function thin(points, side, up)
  local ahead = cross(up, side)
  local low, high, near, far = math.huge, -math.huge, math.huge, -math.huge
  for _, p in ipairs(points) do
    local x, y = dot(p, side), dot(p, ahead)
    low, high, near, far = math.min(low, x), math.max(high, x), math.min(near, y), math.max(far, y)
  end
  return far - near < 0.2 * (high - low)
end

-- Returns the direction, among views across the longest side turned and raised a little,
-- that shows the run largest.
local function best_direction(camera, options, up, side, points)
  local flat = thin(points, side, up)
  local turns = options.turn and { options.turn } or flat and { 12 } or { 15, 22, 29, 36, 43, 50 }
  local rises = options.elevation and { options.elevation } or flat and { 14 } or { 24, 28, 32, 36 }
  local best, best_scale
  for _, turn in ipairs(turns) do
    for _, rise in ipairs(rises) do
      local forward = direction(turn, rise, side, up)
      aim(camera, forward, up, side, points)
      local scale = view.scale(camera, 1)
      if not best or scale > 1.01 * best_scale then best, best_scale = forward, scale end
    end
  end
  return best
end

--- Returns a camera for a run, the same for all its frames.
-- @tparam table run
-- @tparam number aspect width over height of the picture
-- @tparam[opt] table options `from` and `to` (points [m]: a fixed camera), or
-- `direction` (looking along it), or `turn` and `elevation` [deg] off the
-- level view across the longest side; `angle` of the picture's width [deg]
-- @tparam[opt] {{x,y,z},...} extra further points to show [m]
-- @treturn table `at [m], forward, right, up` (unit vectors), `tx, ty`
-- (tangents of the half angles), `middle` (mean of what is seen [m]), `filled`
-- (the share of the picture's height that the run takes)
function view.camera(run, aspect, options, extra)
  options = options or {}
  local up = view.up(run)
  local points = fit_points(run, extra)
  local side = longest(points, up)
  local tx = math.tan(math.rad((options.angle or 30) / 2))
  local camera = { tx = tx, ty = tx / aspect, middle = mean(points) }
  if options.from then
    aim(camera, combine(1, options.to or camera.middle, -1, options.from, 0, up), up, side, points)
    camera.at = options.from
    return camera
  end
  aim(camera, options.direction or best_direction(camera, options, up, side, points), up, side, points)
  centre(camera, points)
  return camera
end

--- Returns the number of pixels per metre in the middle of the picture.
-- @tparam table camera
-- @tparam number width of the picture [px]
-- @treturn number [px/m]
function view.scale(camera, width)
  local away = dot(combine(1, camera.middle, -1, camera.at, 0, camera.at), camera.forward)
  return width / (2 * camera.tx * math.max(away, 1e-9))
end

--- Returns where a point falls in the picture.
-- @tparam table camera
-- @tparam {x,y,z} point [m]
-- @treturn number -1 left edge to 1 right edge
-- @treturn number -1 lower edge to 1 upper edge
-- @treturn number distance ahead of the camera [m]
function view.project(camera, point)
  local d = combine(1, point, -1, camera.at, 0, point)
  local z = dot(d, camera.forward)
  return dot(d, camera.right) / (z * camera.tx), dot(d, camera.up) / (z * camera.ty), z
end

return view
