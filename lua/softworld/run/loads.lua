-- SPDX-License-Identifier: GPL-3.0-or-later
--- Loads of holds and grippers between two times, from the forces and moments of single steps. See help
-- "peaks".
-- @module softworld.run.loads
local core = require "softworld.core"
local build = require "softworld.scene.build"
local rows = require "softworld.rows"
local vec = require "softworld.vec"
local window = require "softworld.run.window"
local vector = require "softworld.vector"

local loads = {}

local WIDTH = 10 -- numbers in a row of a hold's log

--- Returns the data of hold:log as a list of { t =, span =, fx, fy, fz, mx, my, mz, at = point } [s], [N], [N
-- m], [m]. span: above 0 = the force is the mean over this time up to t; below 0 = it is the force at the end
-- of a step of this length; 0 = an equilibrium.
function loads.list(log, count, spans)
  local list = {}
  for i = 0, count - 1 do
    local b = WIDTH * i
    list[i + 1] = { t = log[b + 1], span = spans[i + 1], table.unpack(log, b + 2, b + 7) }
    list[i + 1].at = { log[b + 8], log[b + 9], log[b + 10] }
  end
  return list
end

--- Same for a series of forces alone: t, fx, fy, fz at the end of each step [s], [N].
function loads.forces(log, count)
  local list = {}
  for i = 1, count do
    local b = 4 * (i - 1)
    list[i] = { t = log[b + 1], span = i > 1 and log[b - 3] - log[b + 1] or 0, log[b + 2], log[b + 3],
      log[b + 4], 0, 0, 0 }
  end
  if count > 1 then list[1].span = list[2].span end -- also from a step, whose start is not known
  return list
end

-- Returns the moment of a row about a fixed point.
local function moment_about(r, at)
  if not at then return { r[4], r[5], r[6] } end
  return vec.add({ r[4], r[5], r[6] }, vec.cross(vec.sub(r.at, at), { r[1], r[2], r[3] }))
end

-- Integrates force and moment from t1 to t2: means of steps times their duration, other values by trapezoids.
-- In a step that follows a mean, and in the first one of a hold, the start value is not known; the end value
-- counts for all of it. Steps with row.idle at both ends have no load and do not count as time.
local function add_up(m, list, o)
  local force_time, moment_time, before = 0, 0, nil
  local function add(h, r)
    m.duration = m.duration + h
    force_time, moment_time = force_time + h * (r[1] ^ 2 + r[2] ^ 2 + r[3] ^ 2) ^ 0.5,
      moment_time + h * vec.norm(r.moment)
    for k = 1, 3 do m.impulse[k] = m.impulse[k] + h * r[k] end
  end
  for _, r in ipairs(list) do
    if r.span > 0 then
      local h = math.min(r.t, o.t2) - math.max(r.t - r.span, o.t1)
      if h > 0 and not r.idle then add(h, r) end
      before = r.t >= o.t1 and r.t <= o.t2 and r or nil
    elseif r.t >= o.t1 and r.t <= o.t2 then
      local from, free = r.t + r.span, r.idle and (not before or before.idle)
      if not before or o.is_gap and o.is_gap(0.5 * (before.t + r.t)) then
        if not free and from >= o.t1 - 1e-12 * (1 + math.abs(o.t1)) then add(-r.span, r) end
      elseif not free then
        local share = before.span > 0 and 0 or 0.5
        add(share * (r.t - before.t), before)
        add((1 - share) * (r.t - before.t), r)
      end
      before = r
    end
  end
  m.mean_force = m.duration > 0 and force_time / m.duration or m.raw_peak_force
  if not o.forces_only then
    m.mean_moment = m.duration > 0 and moment_time / m.duration or m.raw_peak_moment
  end
  m.impulse_size = vec.norm(m.impulse)
end

-- True if a row tells of the time from o.t1 to o.t2. A step that ends at t1 is before that time.
local function is_within(r, o)
  return r.t <= o.t2 and (r.t > o.t1 or r.t == o.t1 and (r.span == 0 or o.t1 == o.t2))
end

--- Returns measures of such a list. o: t1, t2 [s]; width of the window [s]; at: point for moments, or nil;
-- forces_only: no moments; is_gap(t): true if nothing was held at that time; each(r, t0): called for each row
-- between t1 and t2; the row holds from t0 on [s].
-- @treturn table of gripper:over, without what pads have
function loads.over(list, o)
  local m = { impulse = vector.of{ 0, 0, 0 }, duration = 0, window = o.width }
  local forces, moments, last = {}, {}, o.t1 < o.t2 and o.t1 or -math.huge
  for _, r in ipairs(list) do
    r.moment = moment_about(r, o.at)
    if is_within(r, o) then
      local t0 = math.max(r.t - math.abs(r.span), math.min(last, r.t))
      forces[#forces + 1] = { t0 = t0, t1 = r.t, r[1], r[2], r[3] }
      moments[#moments + 1] = { t0 = t0, t1 = r.t, table.unpack(r.moment) }
      last = r.t
      if o.each then o.each(r, t0) end
    end
  end
  window.fill(m, "peak_force", window.peak(forces, o.width), "N")
  if not o.forces_only then window.fill(m, "peak_moment", window.peak(moments, o.width), "N m") end
  add_up(m, list, o)
  return m
end

local over = rows.call("clamp:over", "t1, t2, {...}",
  "its loads between two times [s]; without times, of the whole series", {
  gives = "peak_force, mean_force [N], peak_moment, mean_moment [N m], impulse, impulse_size [N s], "
    .. "duration, times of the peaks [s]; raw_peak_force, ... of single steps; see help 'peaks'",
  { "window", "number", "s", "time over which the mean is taken whose peak is given", min = 0,
    usual = "that of the run" },
  { "at", "vector", "m", "point about which moments are taken", usual = "where it holds, at that time" },
})

--- Same for a clamp, pin, grip, feed or slider; also after its release.
function core.class.clamp.over(hold, t1, t2, options)
  if core.type(hold) ~= "clamp" then error("clamp:over is a method: call it with a colon", 2) end
  build.call(3, core.window, hold) -- raises if it does not exist any more
  options = options == nil and {} or over:read(options)
  t1, t2 = window.interval(hold, t1, t2, "clamp:over", 3)
  return loads.over(loads.list(build.call(3, hold.log, hold, t1, t2)), { t1 = t1, t2 = t2,
    width = window.of(hold, options.window, "clamp:over", 3), at = options.at })
end

return loads
