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

local FEWER, ALL = 10, 15 -- numbers in a row of a hold's log, without its span, and in one of a tool [-]

-- Appends the wanted rows of a log to a flat list with rows of a tool; spans: of a hold, or nil; jaws: they
-- are of pads.
local function append(list, log, count, spans, wanted, jaws)
  local n, each = #list, spans and FEWER or ALL
  for i = 0, count - 1 do
    local b = each * i
    local span = spans and spans[i + 1] or log[b + FEWER + 1]
    if not wanted or wanted(log[b + 1], span) then
      table.move(log, b + 1, b + FEWER, n + 1, list)
      list[n + FEWER + 1] = span
      for k = FEWER + 2, ALL do list[n + k] = jaws and log[b + k] or 0 / 0 end
      n = n + ALL
    end
  end
end

-- Returns the rows of a flat list in the order of time.
local function in_order(list)
  local starts, sorted = {}, {}
  for b = 0, #list - 1, ALL do starts[#starts + 1] = b end
  table.sort(starts, function(a, b)
    local t, u = list[a + 1], list[b + 1]
    return t < u or t == u and a < b
  end)
  for i, b in ipairs(starts) do table.move(list, b + 1, b + ALL, ALL * (i - 1) + 1, sorted) end
  return sorted
end

-- Returns every recorded step as rows of a tool's log: time, force, moment, point, span, opening, squeeze,
-- margin, slip; the last four are NaN without pads. span: above 0 = the force is the mean over this time up
-- to t; below 0 = it is the force at the end of a step of this length; 0 = an equilibrium. Or rows of a
-- hold's log, and their spans. t1, t2: steps further from these times than one step are left out.
local function recorded(self, t1, t2)
  local list = {}
  local alone = not self.carrier and (#self.past == 0 or #self.past == 1 and not self.tool)
  for i, hold in ipairs(self.past) do
    local held = self.spans[i]
    if not (t1 and held.to and held.to < t1) then
      local log, count, spans = build.call(3, hold.log, hold, t1, t2)
      if alone and not held.carried then return log, spans end
      append(list, log, count, spans, held.carried and function(t, step)
        return not is_after(t, step, held.carried)
      end)
    end
  end
  if self.carrier then
    local log, count = build.call(3, self.carrier.log, self.carrier, t1, t2)
    append(list, log, count, nil, function(t, step) return carried_at(self, t, step) end)
  end
  if self.tool then
    local log, count = build.call(3, self.tool.log, self.tool, t1, t2)
    if alone then return log end
    append(list, log, count, nil, nil, true)
  end
  return (#self.past > 1 or self.tool and #self.past > 0) and in_order(list) or list
end

-- Returns the same as a list of { t =, force and moment, opening =, squeeze =, margin =, slip = }, the last
-- four of pads.
local function records(self, t1, t2)
  local log, spans = recorded(self, t1, t2)
  local list, each = {}, spans and FEWER or ALL
  for b = 0, #log - 1, each do
    local r = { t = log[b + 1], table.unpack(log, b + 2, b + 7) }
    local pads = not spans and log[b + 13] == log[b + 13]
    if pads then r.opening, r.squeeze, r.margin, r.slip = table.unpack(log, b + 12, b + 15) end
    list[#list + 1] = r
  end
  return list
end

-- Returns the times from, to, ... in which a gripper without pads held something [s]; nil with pads.
local function held_times(self)
  if self.tool then return nil end
  local list = {}
  for _, span in ipairs(self.spans) do
    list[#list + 1] = span.from
    list[#list + 1] = span.to or math.huge
  end
  return list
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
  local log, spans = recorded(self, t1, t2)
  local m, found = loads.over(log, spans, { t1 = t1, t2 = t2, width = width, at = options.at,
    held = held_times(self) })
  for name, unit in pairs(#log == 0 and { peak_force = "N", peak_moment = "N m" } or {}) do
    m[name .. "_note"], m[name .. "_text"] = "it held nothing", ("0 %s (it held nothing)"):format(unit)
  end
  m.peak_squeeze, m.slip = found.squeeze, found.slip
  if found.margin then
    m.peak_margin, m.peak_margin_time, m.raw_peak_margin = found.margin.value, found.margin.time,
      found.margin.raw
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
