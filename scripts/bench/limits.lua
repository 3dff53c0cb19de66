-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes in which methods are known to fail. A row reports the result: the run succeeds, it fails and
-- reports this, or it gains spurious energy.
-- @module bench.limits
local core = require "softworld.core"

local limits = {}

local looks = 50 -- checks of the energy in one run [-]

-- Runs a scene; returns a row with its energy changes since the start, in shares of `unit`.
local function follow(scene, options, duration, unit)
  local start, row = scene:energy().total, { gain = 0, loss = 0, rejected = 0, steps = 0 }
  local began = core.clock()
  for k = 1, looks do
    local r = scene:advance(options, scene.time + duration / looks)
    row.rejected, row.steps = row.rejected + r.rejected, row.steps + r.steps
    if not r.ok then
      row.status, row.reason = "failed", r.reason
      break
    end
    local change = (scene:energy().total - start) / unit
    row.gain = math.max(row.gain, change)
    if k == looks then row.status, row.change = "ok", change end
  end
  row.wall = core.clock() - began
  if row.status == "ok" and (row.gain >= 0.02 or row.gain ~= row.gain) then row.status = "gains" end
  return row
end

-- The released cantilever, with stiffnesses as factors on the usual ones; the unit of energy is m g L / 2.
local function cantilever(o)
  local sw = require "softworld"
  local A, r = math.pi * 0.0025 ^ 2, 0.0025
  local EA, EI = 9.4176e8 * A, 9.4176e8 * A * r * r / 4
  local scene = sw.scene{ name = "cantilever" }
  local wire = scene:wire{ model = o.model, segments = o.segments, EA = EA * (o.EA or 1),
    EI = EI * (o.EI or 1), GJ = EI, mass_per_length = 1500 * A, radius = r,
    from = { 0, 0, o.height or 0 }, to = { 1, 0, o.height or 0 } }
  scene:clamp(wire, { s = 0 })
  if o.floor then scene:obstacle{ shape = "plane", friction = 0.3 } end
  return scene, 1500 * A * 9.81 / 2, wire
end

local function release(o)
  local scene, unit = cantilever(o)
  local row = follow(scene, { dt = o.dt, integrator = o.integrator }, o.duration or 1, unit)
  scene:close()
  return row
end

-- A wire of two halves that nearly lie on each other; no other loads.
local function folded(o)
  local sw = require "softworld"
  local half = 0.5 * (math.pi - o.angle)
  local c, s = 0.5 * math.cos(half), 0.5 * math.sin(half)
  local scene = sw.scene{ name = "folded", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ E = 9.4176e8, density = 1500, radius = 0.0025, segments = 20,
    path = { { c, 0, s }, { 0, 0, 0 }, { c, 0, -s } } }
  local stored = scene:energy().total
  wire:set_velocity({ 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0, 0 })
  local row = follow(scene, { dt = o.dt, integrator = o.integrator }, 0.2, math.max(stored, 1e-6))
  row.note = ("%.3g J stored"):format(stored)
  scene:close()
  return row
end

-- A wire flies against a wall of 10 mm thickness and must not pass through it.
local function flung(o)
  local sw = require "softworld"
  local scene = sw.scene{ name = "flung" }
  local a = o.along
  local wire = scene:wire{ E = 9.4176e8, density = 1500, radius = 0.0025, segments = o.segments,
    from = { 0, -a[2] / 2, -a[3] / 2 }, to = { a[1], a[2] / 2, a[3] / 2 } }
  local wall = a[1] + 0.3
  scene:obstacle{ shape = "box", size = { 0.01, 4, 4 }, at = { wall, 0, 0 }, friction = 0.3 }
  wire:set_velocity{ 30, 0, 0 }
  local mass = 1500 * math.pi * 0.0025 ^ 2 * wire.length
  local row = follow(scene, { dt = o.dt, integrator = o.integrator }, 0.1, 0.5 * mass * 900)
  if row.status ~= "failed" then
    local p, behind = wire:positions(), 0
    for i = 1, #p, 3 do
      if p[i] > wall then behind = behind + 1 end
    end
    row.note = ("%d of %d nodes behind the wall, %.2f mm deep"):format(behind, #p // 3,
      1e3 * scene:penetration())
    if behind > 0 then row.status = "through" end
  end
  scene:close()
  return row
end

local list = {}
local function add(item, run, o)
  o.segments, o.model, o.integrator = o.segments or 20, o.model or "rod", o.integrator or "tr-bdf2"
  list[#list + 1] = { item = item, run = run, o = o }
end

local function add_all(implicit)
  for _, name in ipairs(implicit) do
    for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001 } do
      add("release 1 s", release, { integrator = name, dt = dt })
    end
    for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.001 } do
      add("falls on a floor", release, { integrator = name, dt = dt, floor = true, height = 0.3 })
    end
  end
  for _, degrees in ipairs{ 90, 150, 179, 179.99 } do
    for _, dt in ipairs{ 0.01, 0.001 } do
      add(("one hinge of %g degrees opens"):format(degrees), folded, { angle = math.rad(degrees), dt = dt })
    end
  end
  local ways = { { "flat", { 0, 1, 0 } }, { "endwise", { 1, 0, 0 } }, { "slanted", { 0.6, 0.8, 0 } } }
  for _, way in ipairs(ways) do
    for _, dt in ipairs{ 0.01, 0.002 } do
      add("30 m/s " .. way[1] .. " on a thin wall", flung, { along = way[2], dt = dt })
    end
  end
  for _, model in ipairs{ "rod", "string" } do
    for _, EA in ipairs{ 1e-3, 1e3, 1e6 } do
      add(("EA x %g"):format(EA), release, { EA = EA, dt = 0.005, model = model })
    end
    for _, EI in ipairs{ 1e-6, 1e-3, 1e3, 1e6 } do
      add(("EI x %g"):format(EI), release, { EI = EI, dt = 0.005, model = model })
    end
    add("EA and EI x 1e4", release, { EI = 1e4, EA = 1e4, dt = 0.01, model = model })
    add("EA and EI x 1e-3", release, { EI = 1e-3, EA = 1e-3, dt = 0.005, model = model })
    add("N = 900", release, { segments = 900, dt = 0.01, model = model })
    add("edges of 1 mm", release, { segments = 1000, dt = 0.005, model = model })
  end
  add("N = 900", release, { segments = 900, dt = 0.01, integrator = "implicit-midpoint" })
  require("bench.twists").add_all(add)
  require("bench.squeeze").add_all(add)
  require("bench.grip").add_all(add)
end

--- Returns all rows, in order. Calls progress(k, count, item) before each.
function limits.run(implicit, progress)
  list = {}
  add_all(implicit)
  local rows = {}
  for k, entry in ipairs(list) do
    progress(k, #list, entry.item)
    local o = entry.o
    local done, row = pcall(entry.run, o)
    if not done then
      if core.interrupted() then error(row, 0) end
      row = { status = "refused", reason = tostring(row):match "[^\n]*" }
    end
    row.group, row.item, row.model, row.segments = "limits", entry.item, o.model, o.segments
    row.integrator, row.dt = o.integrator, o.dt
    rows[k] = row
  end
  return rows
end

return limits
