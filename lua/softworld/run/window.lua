-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peaks of forces as means over a moving window of time, from the forces of single steps.
-- See help "peaks".
-- @module softworld.run.window
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local kept = require "softworld.run.kept"
local number = require "softworld.output.number"
local remarks = require "softworld.remarks"

local window = {}

local SLACK = 1e-9 -- relative rounding of times [-]

-- Remarks on loads that are read although the scene was never run or settled: they are 0.
local function remark_early(object, what)
  if not remarks.wanted() then return end
  local scene = core.type(object) == "scene" and object or select(4, core.number(object))
  local data = scene and build.data(scene)
  if not data or data.running or data.runs or scene.time > 0 or kept.ran(scene) then return end
  remarks.early(what)
end

--- Returns the window given, or that of the last run of the scene (or obstacle's scene) [s]. what: the method
-- that reads loads.
function window.of(scene, asked, what, level)
  remark_early(scene, what)
  if asked == nil then return core.window(scene) end
  return checks.number(what .. ": window", asked, 0, " s", level + 1)
end

-- Returns the time `t` [s], or `usual` if it is nil.
local function time_of(what, t, usual, level)
  if t == nil then return usual end
  local readable = type(t) == "number" or type(t) == "string"
  if readable then return checks.number(what, t, -math.huge, " s", level) end
  error(("%s must be a time [s], got %s"):format(what, type(t)), level)
end

--- Returns the ends of an interval of the record of an object, or of a scene [s]; nil: without end. what: the
-- method that reads loads. An interval that lies ahead, or ends before it begins, has no loads: zeros would
-- be taken for loads that were measured.
function window.interval(object, t1, t2, what, level)
  t1 = time_of(what .. ": t1", t1, -math.huge, level + 1)
  t2 = time_of(what .. ": t2", t2, math.huge, level + 1)
  local scene = core.type(object) == "scene" and object or select(4, core.number(object))
  if t2 < t1 then
    error(("%s: t2 = %.9g s is before t1 = %.9g s"):format(what, t2, t1), level)
  elseif t1 > scene.time * (1 + 1e-12) then
    error(("%s: t1 = %.9g s is not recorded yet; the scene is at t = %.9g s"):format(what, t1, scene.time),
      level)
  end
  return t1, t2
end

local function size(x, y, z) return (x * x + y * y + z * z) ^ 0.5 end

local NEAR = 3 -- a blow starts at most this many windows before its peak [-]

-- 0.01 -> 10 ms. Rounded first: 999.7 us are 1 ms, not 1e+03 us.
local function short(x, unit)
  local digits, scaled = number.engineering(tonumber(("%.3g"):format(x)) or x, unit)
  return ("%.3g %s"):format(tonumber(digits), scaled)
end

-- Returns how a peak was measured, with the raw one: "10 ms mean; raw 41 N in 0.4 ms".
local function note(p, unit)
  if p.raw_span == 0 then return "at rest" end
  if p.width == 0 then return ("raw, in %s"):format(short(p.raw_span, "s")) end
  if p.raw_span >= p.width * (1 - SLACK) then
    return ("raw, in one step of %s; the window is %s"):format(short(p.raw_span, "s"),
      short(p.width, "s"))
  end
  local mean = p.whole and ("mean of all %s"):format(short(p.whole, "s"))
    or ("%s mean"):format(short(p.width, "s"))
  return ("%s; raw %s in %s"):format(mean, short(p.raw, unit), short(p.raw_span, "s"))
end

--- Returns how a peak was measured, and whether the steps are short enough for it.
function window.note(p, unit)
  if not p.coarse then return note(p, unit) end
  return ("%s; the blow lasts few steps: a smaller dt may give another peak"):format(note(p, unit))
end

--- Same with the value in front: "12.3 N (10 ms mean; raw 41 N in 0.4 ms)".
function window.text(p, unit) return ("%s (%s)"):format(short(p.value, unit), window.note(p, unit)) end

-- Returns the wire's largest tension in each step between two times [s]: a flat list for core.peak.
local function tension_steps(wire, from, to)
  local rows, count = wire:log(from, to)
  local steps, n, before = {}, 0, nil
  for i = 0, count - 1 do
    local t = rows[3 * i + 1]
    if before and t > before then
      steps[n + 1], steps[n + 2], steps[n + 3], steps[n + 4], steps[n + 5] = before, t, rows[3 * i + 2], 0, 0
      n = n + 5
    end
    before = t
  end
  return steps
end

--- Returns a wire's largest tension [N], where [m], when [s], and its note.
function window.tension(scene, wire)
  local value, s, t = wire:max_tension()
  local raw, _, _, span = wire:max_tension{ raw = true }
  local p = { value = value, time = t, raw = raw, raw_span = span, width = core.window(scene) }
  if p.width > 0 and value > 0 and span > 0 then
    local longest = core.longest_span(tension_steps(wire, t - p.width, t), t, p.width)
    local steps = tension_steps(wire, t - NEAR * math.max(p.width, longest), t)
    p.coarse = longest > 0 and core.is_coarse(steps, p.width, value, t, longest) or nil
  end
  return value, s, t, window.note(p, "N")
end

--- Puts a peak into a table of measures, as name = value, name_time, raw_name, ...
function window.fill(m, name, p, unit)
  m[name], m[name .. "_time"] = p.value, p.time
  m["raw_" .. name], m["raw_" .. name .. "_time"] = p.raw, p.raw_time
  m["raw_" .. name .. "_span"] = p.raw_span
  m[name .. "_coarse"] = p.coarse
  m[name .. "_note"], m[name .. "_text"] = window.note(p, unit), window.text(p, unit)
end

-- --- obstacles ------------------------------------------------------------------------------------

local over_keys = { window = true }

-- Returns impulse and duration of the force on an obstacle over [t1, t2] [s], the integral of its magnitude
-- [N s], and its steps as a flat list for core.peak.
local function sum_over(obstacle, t1, t2)
  local rows, count = obstacle:log(t1, t2)
  local m, steps, n = { impulse = { 0, 0, 0 }, duration = 0 }, {}, 0
  local sum, impulse = 0, m.impulse
  local function add(h, b) -- the force of the row that begins at b
    if h <= 0 then return end
    local x, y, z = rows[b + 2], rows[b + 3], rows[b + 4]
    m.duration, sum = m.duration + h, sum + h * size(x, y, z)
    impulse[1], impulse[2], impulse[3] = impulse[1] + h * x, impulse[2] + h * y, impulse[3] + h * z
  end
  for b = 0, 5 * (count - 1), 5 do
    local t, span = rows[b + 1], rows[b + 5]
    local t0 = t - span
    if t <= t2 and (t > t1 or t == t1 and (span == 0 or t1 == t2)) then
      steps[n + 1], steps[n + 2] = t1 < t2 and math.max(t0, t1) or t0, t
      steps[n + 3], steps[n + 4], steps[n + 5] = rows[b + 2], rows[b + 3], rows[b + 4]
      n = n + 5
    end
    add(math.min(t, t2) - math.max(t0, t1), b)
    if span == 0 and b > 0 then -- equilibria: linear between them
      local h = 0.5 * (math.min(t, t2) - math.max(rows[b - 4], t1))
      add(h, b)
      add(h, b - 5)
    end
  end
  return m, sum, steps
end

--- Returns the mean magnitude of the force on an obstacle from a time on [N], as obstacle:over does. Peaks,
-- which take most of the time, are not looked for.
function window.mean_force(obstacle, start)
  local m, sum, steps = sum_over(obstacle, start, math.huge)
  return m.duration > 0 and sum / m.duration or core.peak(steps, core.window(obstacle)).value
end

--- obstacle:over(t1, t2, { window = [s] }): force of wires on the obstacle over [t1, t2] [s], blows included.
-- Returns a table with peak_force, mean_force [N] (of the magnitude), impulse (vector), impulse_size [N s],
-- duration [s], the times of the peaks, and raw_peak_force, that of a single step of raw_peak_force_span.
function core.class.obstacle.over(obstacle, t1, t2, options)
  if core.type(obstacle) ~= "obstacle" then
    error("obstacle:over is a method: call it with a colon", 2)
  end
  build.call(3, core.window, obstacle) -- raises if it does not exist any more
  options = options or {}
  checks.keys("obstacle:over", options, over_keys, 3)
  t1, t2 = window.interval(obstacle, t1, t2, "obstacle:over", 3)
  local width = window.of(obstacle, options.window, "obstacle:over", 3)
  local m, sum, steps = build.call(3, sum_over, obstacle, t1, t2)
  m.window = width
  window.fill(m, "peak_force", core.peak(steps, width), "N")
  m.mean_force = m.duration > 0 and sum / m.duration or m.peak_force
  m.impulse_size = size(m.impulse[1], m.impulse[2], m.impulse[3])
  return m
end

return window
