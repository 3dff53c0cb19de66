-- SPDX-License-Identifier: GPL-3.0-or-later
--- Loads of holds and grippers between two times, from the forces and moments of single steps. See help
-- "peaks".
-- @module softworld.run.loads
local core = require "softworld.core"
local build = require "softworld.scene.build"
local rows = require "softworld.rows"
local vec = require "softworld.vec"
local window = require "softworld.run.window"

local loads = {}

--- Returns a series of forces alone (t, fx, fy, fz at the end of each step [s], [N]) as rows of a hold's log,
-- and their spans.
function loads.forces(log, count)
  local list, spans = {}, {}
  for i = 1, count do
    local from, to = 4 * (i - 1), 10 * (i - 1)
    for k = 1, 4 do list[to + k] = log[from + k] end
    for k = 5, 10 do list[to + k] = 0 end
    spans[i] = i > 1 and log[from - 3] - log[from + 1] or 0
  end
  if count > 1 then spans[1] = spans[2] end -- also from a step, whose start is not known
  return list, spans
end

--- Returns measures of the rows and spans of a hold's log, or of the rows of a tool's. o: t1, t2 [s]; width
-- of the window [s]; at: point for moments, or nil; forces_only: no moments; held: times from, to, ... in
-- which something was held [s], or nil for always. Means of steps count with their duration, other values
-- by trapezoids; see record/loads.c.
-- @treturn table of gripper:over, without what pads have; and what core.loads found
function loads.over(log, spans, o)
  local found = core.loads(log, spans, o.t1, o.t2, o.width, o.at, o.held)
  local m = { impulse = found.impulse, duration = found.duration, window = o.width }
  m.impulse_size, m.mean_force = vec.norm(m.impulse), found.mean_force
  window.fill(m, "peak_force", found.force, "N")
  if o.forces_only then return m, found end
  window.fill(m, "peak_moment", found.moment, "N m")
  m.mean_moment = found.mean_moment
  return m, found
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
  local log, _, spans = build.call(3, hold.log, hold, t1, t2)
  return (loads.over(log, spans, { t1 = t1, t2 = t2, at = options.at,
    width = window.of(hold, options.window, "clamp:over", 3) }))
end

return loads
