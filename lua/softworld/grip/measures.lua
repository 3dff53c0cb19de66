-- SPDX-License-Identifier: GPL-3.0-or-later
--- Measurements of grippers: force and moment now and over time, pressure on the pads, squeeze, slip.
-- @module softworld.grip.measures
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local rows = require "softworld.rows"
local vec = require "softworld.vec"
local loads = require "softworld.run.loads"
local window = require "softworld.run.window"
local vector = require "softworld.vector"

local Measures = {}

local function in_axes(self, v, axes)
  local held = axes == "gripper" and (self.tool or self.hold and (self.carrier or self.hold))
  if not held then return vector.of(v) end
  local _, q = held:pose()
  return vector.of(vec.rotate(vec.conjugate(q), v))
end

-- Returns the hold of one of several wires.
local function grip_of(self, wire, what)
  for _, grip in ipairs(self.grips) do
    if grip.wire == wire then return grip end
  end
  if self.astray and core.type(wire) == "wire" and self.astray[wire.name] then return { astray = true } end
  error(("%s: gripper '%s' does not hold %s"):format(what, self.name,
    core.type(wire) == "wire" and ("wire '%s'"):format(wire.name) or "this: wire must be a wire"), 3)
end

-- Returns the force and moment, about a point (nil: the centre), of the pads on one of several wires.
local function pads_on(self, wire, at, finger)
  local force, moment = { 0, 0, 0 }, { 0, 0, 0 }
  local centre, q = self.tool:pose()
  local _, slot = core.number(wire)
  for _, touch in ipairs(self.tool:touches()) do
    if touch.wire == slot and (finger == nil or finger == touch.finger) then
      local f = vec.rotate(q, touch.force)
      local arm = vec.rotate(q, touch.acts)
      if at then arm = vec.add(arm, vec.sub(centre, at)) end
      force, moment = vec.add(force, f), vec.add(moment, vec.cross(arm, f))
    end
  end
  return force, moment
end

-- Returns what carries the wires: the pads, or the carrier of all holds.
local function carrier_of(self) return self.tool or self.hold and self.carrier or nil end

local axes = { "axes", "choice", "-", "of the result", choices = { "world", "gripper" }, usual = "world" }
local finger = { "finger", "integer", "-", "of this finger alone", min = 1, max = 6, usual = "all" }
local one_wire = { "wire", "wire", "-", "on this wire of several", usual = "all" }

local force = rows.call("gripper:force", "{...}", "force of the gripper on its wires, or zero", {
  gives = "{x, y, z} [N]", axes, finger, one_wire })
local moment = rows.call("gripper:moment", "{...}", "moment of the gripper on its wires now", {
  gives = "{x, y, z} [N m]",
  { "at", "vector", "m", "point about which it is taken", usual = "the tool's centre" }, axes, finger,
    one_wire })

--- Returns the present force on the wire; with several wires, on all of them.
function Measures:force(args)
  args = force:read(args or {})
  local f, carrier = { 0, 0, 0 }, carrier_of(self)
  if args.wire ~= nil then
    local grip = grip_of(self, args.wire, "gripper:force")
    f = grip.hold and grip.hold:force()
      or #self.grips == 1 and not grip.astray and self.tool:force(args.finger)
      or pads_on(self, args.wire, nil, args.finger)
  elseif carrier then f = carrier:force(args.finger)
  elseif self.hold then f = self.hold:force() end
  return in_axes(self, f, args.axes)
end

--- Returns the present moment on the wire.
function Measures:moment(args)
  args = moment:read(args or {})
  local m, carrier = { 0, 0, 0 }, carrier_of(self)
  if args.wire ~= nil then
    local grip = grip_of(self, args.wire, "gripper:moment")
    if grip.hold then m = grip.hold:moment{ at = args.at or self:position() }
    elseif #self.grips == 1 and not grip.astray then m = self.tool:moment(args.at, args.finger)
    else m = select(2, pads_on(self, args.wire, args.at, args.finger)) end
  elseif carrier then m = carrier:moment(args.at, args.finger)
  elseif self.hold then m = self.hold:moment(args.at and { at = args.at } or nil) end
  return in_axes(self, m, args.axes)
end

-- True if a row at time t tells of the time after another. A step that ends then is before it; an equilibrium
-- found then is after it.
local function is_after(t, width, time) return t > time or t == time and width == 0 end

-- True if the gripper held something by this carrier in the step of this length up to t.
local function carried_at(self, t, width)
  for _, span in ipairs(self.spans) do
    local carried = span.carried and is_after(t, width, span.carried)
    if carried and (not span.to or t <= span.to) then return true end
  end
  return false
end

-- True if pads bear nothing in this row, and hold nothing.
local function is_idle(r)
  for k = 1, 6 do
    if r[k] ~= 0 then return false end
  end
  return r.squeeze == 0 and r.margin ~= r.margin
end

-- Returns every recorded step: t, span, force, moment; for a tool also opening, squeeze, margin, slip. span:
-- above 0 = the force is the mean over this time up to t; below 0 = it is the force at the end of a step of
-- this length; 0 = an equilibrium. t1, t2: steps further from these times than one step are left out.
local function records(self, t1, t2)
  local list = {}
  local function add(log, count, spans, wanted, jaws)
    local width = spans and 10 or 15
    for i = 0, count - 1 do
      local b = width * i
      local step = spans and spans[i + 1] or log[b + 11]
      if not wanted or wanted(log[b + 1], step) then
        list[#list + 1] = { t = log[b + 1], log[b + 2], log[b + 3], log[b + 4], log[b + 5],
          log[b + 6], log[b + 7], at = { log[b + 8], log[b + 9], log[b + 10] },
          span = step,
          opening = jaws and log[b + 12] or nil, squeeze = jaws and log[b + 13] or nil,
          margin = jaws and log[b + 14] or nil, slip = jaws and log[b + 15] or nil }
        list[#list].idle = jaws and is_idle(list[#list])
      end
    end
  end
  for i, hold in ipairs(self.past) do
    local held = self.spans[i]
    if not (t1 and held.to and held.to < t1) then
      local log, count, spans = build.call(3, hold.log, hold, t1, t2)
      local function alone(t, step) return not is_after(t, step, held.carried) end
      add(log, count, spans, held.carried and alone)
    end
  end
  if self.carrier then
    local log, count = build.call(3, self.carrier.log, self.carrier, t1, t2)
    add(log, count, nil, function(t, step) return carried_at(self, t, step) end)
  end
  if self.tool then
    local log, count = build.call(3, self.tool.log, self.tool, t1, t2)
    add(log, count, nil, nil, true)
  end
  if #self.past > 1 or self.tool and #self.past > 0 then
    table.sort(list, function(a, b) return a.t < b.t end)
  end
  return list
end

-- True if a gripper without pads held nothing at this time.
local function is_gap(self, t)
  if self.tool then return false end
  for _, span in ipairs(self.spans) do
    if t >= span.from and (not span.to or t <= span.to) then return false end
  end
  return true
end

local over = rows.call("gripper:over", "t1, t2, {...}",
  "its loads between two times [s]; without times, of the whole series", {
  gives = "peak_force, mean_force [N], peak_moment, mean_moment [N m], impulse, impulse_size [N s], "
    .. "duration, times of the peaks [s]; raw_peak_force, ... of single steps; of pads peak_squeeze [N], "
    .. "peak_margin, slip [m]; raw_peak_margin of a single step",
  { "window", "number", "s", "time over which the mean is taken whose peak is given", min = 0,
    usual = "that of the run" },
  { "at", "vector", "m", "point about which moments are taken", usual = "the tool's centre" },
})

-- Reads the third argument of gripper:over: a point, or a table of options.
local function over_options(options)
  if options == nil then return {} end
  if type(options) ~= "table" or options[1] ~= nil or options.x ~= nil then
    return { at = checks.vector("gripper:over: at", options, "m", 0) }
  end
  return over:read(options)
end

--- Measures over [t1, t2] [s]: a table with peak_force, mean_force [N],
-- peak_moment, mean_moment [N m], impulse (vector), impulse_size [N s] and the times of the
-- peaks. Means are of the magnitudes, over the time in which it holds something. Peaks are of means
-- over a window of time; raw_peak_force and raw_peak_moment are of single steps; see help "peaks".
-- Moments are about the tool centre. options: { window = [s], at = point [m] that moments are
-- about }, or that point.
-- With pads also peak_squeeze [N] of single steps, peak_margin, raw_peak_margin (while they hold, not
-- while they close or let go), slip [m].
function Measures:over(t1, t2, options)
  options = over_options(options)
  t1, t2 = window.interval(self.scene, t1, t2, "gripper:over", 3)
  local width = window.of(self.scene, options.window, "gripper:over", 3)
  local margins, squeeze, slip = {}, nil, nil
  local list = records(self, t1, t2)
  local m = loads.over(list, { t1 = t1, t2 = t2, width = width, at = options.at,
    is_gap = function(t) return is_gap(self, t) end,
    each = function(r, t0)
      if not r.squeeze then return end
      local held = r.margin == r.margin
      squeeze, slip = math.max(squeeze or 0, r.squeeze), r.slip
      margins[#margins + 1] = { t0 = t0, t1 = r.t, held and r.margin or 0, 0, 0 }
      margins.held = margins.held or held
    end })
  for name, unit in pairs(#list == 0 and { peak_force = "N", peak_moment = "N m" } or {}) do
    m[name .. "_note"], m[name .. "_text"] = "it held nothing", ("0 %s (it held nothing)"):format(unit)
  end
  m.peak_squeeze, m.slip = squeeze, slip
  if margins.held then
    local p = window.largest(margins, width)
    m.peak_margin, m.peak_margin_time, m.raw_peak_margin = p.value, p.time, p.raw
  end
  return m
end

--- Returns the series { t =, force = {{x, y, z}, ...}, moment = } and, with pads, opening, squeeze, margin
-- (NaN while they hold nothing, close or let go), slip.
function Measures:series()
  local s = { t = {}, force = {}, moment = {} }
  for i, r in ipairs(records(self)) do
    s.t[i], s.force[i], s.moment[i] = r.t, { r[1], r[2], r[3] }, { r[4], r[5], r[6] }
    for _, key in ipairs{ "opening", "squeeze", "margin", "slip" } do
      if self.tool then
        s[key] = s[key] or {}
        s[key][i] = r[key] or 0 / 0
      end
    end
  end
  return s
end

local function needs_tool(self, verb)
  if self.tool then return self.tool end
  error(("gripper '%s' has no pads yet, so no %s: grasp with approach = 'plates' or 'mixed'")
    :format(self.name, verb), 3)
end

--- Returns the state of the pads: a table with jaws ("rests", "moves", "holds", "stopped", "empty"),
-- opening [m], squeeze (force per finger [N]), normal (sum over pads [N]), margin (friction and its moment
-- over what the touches can resist, the largest of its wires; for a frozen grip, force and moment over what
-- its touches could balance [-]), sliding (share of the normal force that slides [-]), slip (longest way of
-- a touch [m]) by the vectors slipped [m] and turned [rad] in the tool's axes, and, once it exceeds the
-- gripper's slip_tolerance, slip_time [s] and slip_place (arc length [m]).
function Measures:state()
  local now = needs_tool(self, "state"):state()
  if self.frozen then
    for _, key in ipairs{ "squeeze", "normal", "most", "opening" } do now[key] = self.frozen[key] end
    now.jaws = "holds"
  end
  return now
end

--- Returns how far the wire is squeezed at the pads: height from pad to pad and width across [m], and
-- the lost share of the height [-].
function Measures:squeeze()
  needs_tool(self, "squeeze")
  local state = self:state()
  if not self.wire then error(("gripper '%s' holds nothing"):format(self.name), 2) end
  local d, result = 2 * self.wire.radius
  if self.frozen then
    result = { height = self.frozen.section.height, width = self.frozen.section.width }
  elseif self.wire.model ~= "rod" and self.wire.model ~= "string" then
    local _, q = self.tool:pose()
    result = { height = self.wire:width(state.place, vec.rotate(q, { 0, 1, 0 })),
      width = self.wire:width(state.place, vec.rotate(q, { 0, 0, 1 })) }
  else
    result = { height = math.min(d, state.opening), width = d }
  end
  result.share = 1 - result.height / (self.free_height or d)
  return result
end

rows.calls{
  { "gripper:series", "", "every recorded step",
    "t [s], force, moment; of pads opening, squeeze, margin, slip" },
  { "gripper:state", "", "state of the pads", "jaws, opening [m], squeeze, normal [N], margin, sliding [-], "
    .. "slip, slipped [m], turned [rad], slip_time [s], slip_place, place [m]" },
  { "gripper:squeeze", "", "how flat the wire is squeezed", "height, width [m], share [-]" },
  { "gripper.peak_force", nil, "over all of its time, see gripper:over", "N" },
  { "gripper.mean_force", nil, "over all of its time", "N" },
  { "gripper.peak_moment", nil, "over all of its time", "N m" },
  { "gripper.mean_moment", nil, "over all of its time", "N m" },
  { "gripper.impulse", nil, "over all of its time", "{x, y, z} [N s]" },
  { "gripper.peak_margin", nil, "largest margin of its pads over all of its time; nil without pads",
    "number" },
}

local pressure = rows.call("gripper:pressure_map", "{...}", "where the pads press", {
  gives = "{ finger, x, z [m], pressure [Pa] }, ... with largest [Pa], force [N], touches",
  { "cell", "list", "m", "size along and across", usual = "an eighth of the width" },
})

--- Returns a map of the pads' mean pressure [Pa] over cells,
-- { { finger =, x =, z =, pressure = }, ... } in the tool's axes [m], with
-- .largest, .force (sum of normal forces [N]) and .touches, the single touches with { finger, at
-- (in the tool's axes), normal [N], force, s, slid [m] }. Options: cell = { along, across } [m].
function Measures:pressure_map(args)
  local cell = pressure:read(args or {}).cell or { self.width / 8, self.width / 8 }
  for k = 1, 2 do
    checks.number("gripper:pressure_map: cell", type(cell) == "table" and cell[k], 0, " m", 3, nil, true)
  end
  local touches, cells, map = needs_tool(self, "pressure map"):touches(), {}, { largest = 0, force = 0 }
  for _, touch in ipairs(touches) do
    local i, j = touch.at[1] // cell[1], touch.at[3] // cell[2]
    local key = ("%d %d %d"):format(touch.finger, i, j)
    local entry = cells[key]
    if not entry then
      entry = { finger = touch.finger, x = (i + 0.5) * cell[1], z = (j + 0.5) * cell[2], pressure = 0 }
      cells[key] = entry
      map[#map + 1] = entry
    end
    entry.pressure = entry.pressure + touch.normal / (cell[1] * cell[2])
    map.largest = math.max(map.largest, entry.pressure)
    map.force = map.force + touch.normal
  end
  map.touches = touches
  return map
end

return { methods = Measures, records = records }
