-- SPDX-License-Identifier: GPL-3.0-or-later
--- Wires that lie in each other at the end of a run, because nothing lets them touch: a remark says so.
-- @module softworld.run.passing
local build = require "softworld.scene.build"
local core = require "softworld.core"
local remarks = require "softworld.remarks"

local passing = {}

local DEEP = 0.8 -- axes nearer than this share of both radii: wires side by side are farther apart [-]
local MOST = 1e6 -- pairs of edges that are compared at most

-- Returns the wires: nodes as a flat list, radius, and the box round them.
local function wires_of(data)
  local list = {}
  for _, entry in ipairs(data.wires) do
    local wire = entry.object
    if core.exists(wire) and wire.present then
      local x = wire:positions()
      local w = { name = wire.name, x = x, radius = wire.radius, low = {}, high = {} }
      for k = 1, 3 do
        local low, high = math.huge, -math.huge
        for i = k, #x, 3 do low, high = math.min(low, x[i]), math.max(high, x[i]) end
        w.low[k], w.high[k] = low, high
      end
      list[#list + 1] = w
    end
  end
  return list
end

-- Returns the indices of the edges of a wire that reach into the box of the other within a distance.
local function edges_in(w, other, reach)
  local list, x = {}, w.x
  for i = 1, #x - 5, 3 do
    local near = true
    for k = 0, 2 do
      local a, b = x[i + k], x[i + 3 + k]
      near = near and math.max(a, b) >= other.low[k + 1] - reach
        and math.min(a, b) <= other.high[k + 1] + reach
    end
    if near then list[#list + 1] = i end
  end
  return list
end

local function clamped(v) return math.max(0, math.min(1, v)) end

-- Returns the square of the distance of the edges that begin at i of x and at j of y [m2].
local function distance2(x, i, y, j)
  local ux, uy, uz = x[i + 3] - x[i], x[i + 4] - x[i + 1], x[i + 5] - x[i + 2]
  local vx, vy, vz = y[j + 3] - y[j], y[j + 4] - y[j + 1], y[j + 5] - y[j + 2]
  local wx, wy, wz = x[i] - y[j], x[i + 1] - y[j + 1], x[i + 2] - y[j + 2]
  local a, b, c = ux * ux + uy * uy + uz * uz, ux * vx + uy * vy + uz * vz, vx * vx + vy * vy + vz * vz
  local d, e = ux * wx + uy * wy + uz * wz, vx * wx + vy * wy + vz * wz
  if a == 0 or c == 0 then return math.huge end
  local det = a * c - b * b
  local s = det > 1e-12 * a * c and clamped((b * e - c * d) / det) or 0
  local t = clamped((b * s + e) / c)
  s = clamped((b * t - d) / a)
  local px, py, pz = wx + s * ux - t * vx, wy + s * uy - t * vy, wz + s * uz - t * vz
  return px * px + py * py + pz * pz
end

-- Returns where two wires lie in each other, {x, y, z} [m], or nil; and how many pairs of edges were
-- compared. left: how many may be.
local function place(a, b, left)
  local reach = DEEP * (a.radius + b.radius)
  for k = 1, 3 do
    if a.low[k] > b.high[k] + reach or b.low[k] > a.high[k] + reach then return nil, 0 end
  end
  local first = edges_in(a, b, reach)
  local second = #first > 0 and edges_in(b, a, reach) or {}
  if #first * #second > left then return nil, left end
  for _, i in ipairs(first) do
    for _, j in ipairs(second) do
      if distance2(a.x, i, b.x, j) < reach * reach then return { a.x[i], a.x[i + 1], a.x[i + 2] }, 0 end
    end
  end
  return nil, #first * #second
end

-- Sorts the wires along the axis on which they are spread most. Returns this axis, 1 to 3.
local function sort(list)
  local axis, most = 1, -1
  for k = 1, 3 do
    local low, high = math.huge, -math.huge
    for _, w in ipairs(list) do low, high = math.min(low, w.low[k]), math.max(high, w.low[k]) end
    if high - low > most then axis, most = k, high - low end
  end
  table.sort(list, function(a, b) return a.low[axis] < b.low[axis] end)
  return axis
end

-- Calls a function with each pair of wires that may meet, until it returns true.
local function each_pair(list, call)
  local axis, thickest = sort(list), 0
  for _, w in ipairs(list) do thickest = math.max(thickest, w.radius) end
  for k, a in ipairs(list) do
    local last = a.high[axis] + 2 * DEEP * thickest
    for m = k + 1, #list do
      if list[m].low[axis] > last then break end
      if call(a, list[m]) then return end
    end
  end
end

--- Called at the end of a run. Joined wires meet, so scenes with joins get no remark.
function passing.look(scene)
  local data = build.data(scene)
  if data.touching or #data.wires < 2 or #data.joins > 0 or not remarks.wanted() then return end
  local left = MOST
  each_pair(wires_of(data), function(a, b)
    local at, used = place(a, b, left)
    left = left - used
    if at then remarks.passing(a.name, b.name, at, scene.time) end
    return at or left <= 0
  end)
end

return passing
