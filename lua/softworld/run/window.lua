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

-- Returns the integral of the steps up to the start of each.
local function sums_of(steps)
  local sums, x, y, z = {}, 0, 0, 0
  for i, s in ipairs(steps) do
    sums[i] = { x, y, z }
    local h = s.t1 - s.t0
    x, y, z = x + h * s[1], y + h * s[2], z + h * s[3]
  end
  return sums
end

-- Returns a function that integrates up to a time; times must not fall from call to call.
local function integral(steps, sums)
  local i, n = 1, #steps
  return function(t)
    while i < n and steps[i + 1].t0 <= t do i = i + 1 end
    local s, sum = steps[i], sums[i]
    local h = math.max(0, math.min(t, s.t1) - s.t0)
    return sum[1] + h * s[1], sum[2] + h * s[2], sum[3] + h * s[3]
  end
end

-- Returns the size of the largest mean over whole windows that begin or end with a step, and that window's
-- end.
local function largest_mean(steps, width)
  local sums, first, last = sums_of(steps), steps[1].t0, steps[#steps].t1
  local most, time = 0, nil
  local function try(begins, stop, from, to)
    local x0, y0, z0 = from(begins)
    local x1, y1, z1 = to(stop)
    local mean = size(x1 - x0, y1 - y0, z1 - z0) / (stop - begins)
    if mean > most then most, time = mean, stop end
  end
  if last - first < width * (1 - SLACK) then
    try(first, last, integral(steps, sums), integral(steps, sums))
    return most, time
  end
  local from, to = integral(steps, sums), integral(steps, sums)
  for _, s in ipairs(steps) do
    if s.t1 - width >= first - SLACK * width then try(math.max(first, s.t1 - width), s.t1, from, to) end
  end
  from, to = integral(steps, sums), integral(steps, sums)
  for _, s in ipairs(steps) do
    if s.t0 + width <= last then try(s.t0, s.t0 + width, from, to) end
  end
  return most, time
end

local FEW = 3 -- steps in a peak's window that show a blow to 15 % (make stability: laying, drops, pegs) [-]
local NEAR = 3 -- a blow starts at most this many windows before its peak [-]
local SHARP = 0.55 -- largest mean before a blow over its own mean [-]

-- True if a blow lasts few steps: shorter steps may show another peak.
local function is_coarse(steps, p, width)
  local long = math.max(width, p.span)
  if p.span * FEW < long then return false end
  local till, first = p.time - long, steps[1].t0
  local from = math.max(till - long, first)
  if till - from < 0.25 * long then return false end -- nothing is known before
  local to = integral(steps, sums_of(steps))
  local x0, y0, z0 = to(from)
  local x1, y1, z1 = to(till)
  return size(x1 - x0, y1 - y0, z1 - z0) / (till - from) < SHARP * p.value
end

-- Returns the longest step within the window that ends at a time.
local function longest(steps, time, width)
  local most = 0
  for _, s in ipairs(steps) do
    if s.t1 > time - width * (1 - SLACK) and s.t0 < time then most = math.max(most, s.t1 - s.t0) end
  end
  return most
end

--- Returns the peaks of a vector.
-- @tparam table steps { { t0 =, t1 =, x, y, z }, ... } in order: the vector from t0 to t1 [s];
-- t0 = t1 at an equilibrium
-- @tparam number width of the window [s]
-- @treturn table value of the largest mean and its time, raw (of single steps) with raw_time and raw_span;
-- steps as long as the window, and equilibria, are not averaged; whole: length of the record, if it is
-- shorter than the window; coarse: true for a blow that lasts few steps
function window.peak(steps, width)
  local p = window.largest(steps, width)
  if p.time and p.value > 0 and width > 0 then
    p.span = longest(steps, p.time, width)
    p.coarse = is_coarse(steps, p, width) or nil
  end
  return p
end

--- Same without coarse.
function window.largest(steps, width)
  local p = { value = 0, raw = 0, raw_span = 0, width = width }
  local averaged = false
  for _, s in ipairs(steps) do
    local now, span = size(s[1], s[2], s[3]), s.t1 - s.t0
    if now > p.raw then p.raw, p.raw_time, p.raw_span = now, s.t1, span end
    if span == 0 or span >= width * (1 - SLACK) then
      if now > p.value then p.value, p.time = now, s.t1 end
    else
      averaged = true
    end
  end
  if not averaged then return p end
  local mean, time = largest_mean(steps, width)
  if mean > p.value then p.value, p.time = mean, time end
  local whole = steps[#steps].t1 - steps[1].t0
  if whole < width * (1 - SLACK) then p.whole = whole end
  return p
end

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

-- Returns the wire's largest tension in each step between two times [s], as in a series.
local function tension_steps(wire, from, to)
  local rows, count = wire:log(from, to)
  local steps, before = {}, nil
  for i = 0, count - 1 do
    local t = rows[3 * i + 1]
    steps[#steps + 1] = before and t > before and { t0 = before, t1 = t, rows[3 * i + 2], 0, 0 } or nil
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
    local steps = tension_steps(wire, t - p.width, t)
    p.span = longest(steps, t, p.width)
    steps = tension_steps(wire, t - NEAR * math.max(p.width, p.span), t)
    p.coarse = p.span > 0 and is_coarse(steps, p, p.width) or nil
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
-- [N s], and its steps.
local function sum_over(obstacle, t1, t2)
  local rows, count = obstacle:log(t1, t2)
  local m, steps = { impulse = { 0, 0, 0 }, duration = 0 }, {}
  local sum, before = 0, nil
  local function add(h, s)
    if h <= 0 then return end
    m.duration, sum = m.duration + h, sum + h * size(s[1], s[2], s[3])
    for k = 1, 3 do m.impulse[k] = m.impulse[k] + h * s[k] end
  end
  for i = 0, count - 1 do
    local b = 5 * i
    local t, span = rows[b + 1], rows[b + 5]
    local s = { t0 = t - span, t1 = t, rows[b + 2], rows[b + 3], rows[b + 4] }
    if t <= t2 and (t > t1 or t == t1 and (span == 0 or t1 == t2)) then
      steps[#steps + 1] = { t0 = t1 < t2 and math.max(s.t0, t1) or s.t0, t1 = t, s[1], s[2], s[3] }
    end
    add(math.min(t, t2) - math.max(s.t0, t1), s)
    if span == 0 and before then -- equilibria: linear between them
      local h = 0.5 * (math.min(t, t2) - math.max(before.t1, t1))
      add(h, s)
      add(h, before)
    end
    before = s
  end
  return m, sum, steps
end

--- Returns the mean magnitude of the force on an obstacle from a time on [N], as obstacle:over does. Peaks,
-- which take most of the time, are not looked for.
function window.mean_force(obstacle, start)
  local m, sum, steps = sum_over(obstacle, start, math.huge)
  return m.duration > 0 and sum / m.duration or window.peak(steps, core.window(obstacle)).value
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
  window.fill(m, "peak_force", window.peak(steps, width), "N")
  m.mean_force = m.duration > 0 and sum / m.duration or m.peak_force
  m.impulse_size = size(m.impulse[1], m.impulse[2], m.impulse[3])
  return m
end

return window
