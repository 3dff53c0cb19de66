-- SPDX-License-Identifier: GPL-3.0-or-later
--- Grippers with imposed handling: the wire between the pads is one with the
-- gripper and follows its trajectory; force and moment are reported.
--
--     local left = scene:gripper{ name = "left", pads = { width = 0.02 } }
--     scene:process(function(p)
--       left:grasp(wire, { s = 0.02 })
--       left:move{ by = {0.3, 0, 0}, speed = 0.2 }
--       left:release()
--     end)
--     scene:run()
--     print(left.peak_force, left.mean_moment)
--
-- Forces and moments are those of the gripper on the wire, moments about the
-- tool centre (the held point) unless another point is named [N], [N m].
-- @module softworld.gripper
local core = require "softworld.core"
local build = require "softworld.build"
local keep = require "softworld.keep"
local process = require "softworld.process"
local trajectory = require "softworld.trajectory"

local Gripper = { __name = "gripper" }
keep.class("gripper", Gripper)
local approaches = { imposed = true }

local function check_keys(what, args, known, level)
  if type(args) ~= "table" then
    error(("%s takes one table of parameters, got %s"):format(what, type(args)), level)
  end
  for key in pairs(args) do
    if not known[key] then
      local names = {}
      for name in pairs(known) do names[#names + 1] = name end
      table.sort(names)
      local near = core.nearest(tostring(key), names)
      error(("%s: there is no parameter '%s'; %s"):format(what, tostring(key), near
        and ("did you mean '" .. near .. "'?") or "known are: " .. table.concat(names, " ")), level)
    end
  end
end

local function number(what, value, low, unit, level)
  if type(value) ~= "number" or not (value >= low and value < math.huge) then
    error(("%s = %s%s is not allowed; it must be at least %g%s"):format(what, tostring(value),
      type(value) == "number" and unit or "", low, unit), level)
  end
end

-- A copy of the vector {x, y, z}.
local function vector(what, value, level)
  local copy = {}
  for k, axis in ipairs{ "x", "y", "z" } do
    local v = type(value) == "table" and (value[k] or value[axis])
    if type(v) ~= "number" or v - v ~= 0 then
      error(("%s must be a table of 3 finite numbers [m]"):format(what), level)
    end
    copy[k] = v
  end
  return copy
end

--- scene:gripper{ name =, pads = { width = [m] }, at = {x, y, z} [m] }
-- at is where the tool is while it holds nothing; grasp without s takes the
-- place of the wire nearest to it.
function core.class.scene.gripper(scene, args)
  build.check(scene, "scene:gripper", 3)
  if args == nil then args = {} end
  check_keys("scene:gripper", args, { name = true, pads = true, at = true }, 3)
  local pads = args.pads or {}
  check_keys("scene:gripper: pads", pads, { width = true, friction = true }, 3)
  if pads.width ~= nil then number("scene:gripper: pads.width", pads.width, 0, " m", 3) end
  if pads.friction ~= nil then number("scene:gripper: pads.friction", pads.friction, 0, "", 3) end
  if args.name ~= nil and type(args.name) ~= "string" then
    error("scene:gripper: name must be a string, got " .. type(args.name), 2)
  end
  local data = build.data(scene)
  local self = setmetatable({}, Gripper)
  self.scene = scene
  self.name = build.name(scene, args.name, "gripper", #data.grippers, 3)
  self.width = pads.width or 0.02
  self.at = args.at ~= nil and vector("scene:gripper: at", args.at, 3) or nil
  self.past = {} -- clamps of earlier grasps, for the series
  data.grippers[#data.grippers + 1] = self
  return self
end

--- What a snapshot must know of the gripper, and the way back; recall(nil) for
-- one that was made later.
function Gripper:remember()
  return { hold = self.hold, at = self.at, grasps = #self.past }
end

function Gripper:recall(state)
  self.gone = state == nil or nil
  self.hold, self.at = state and state.hold, state and state.at
  for i = #self.past, (state and state.grasps or 0) + 1, -1 do self.past[i] = nil end
end

local function needs_scene(self)
  if self.gone then
    error(("gripper '%s' was made after the snapshot that was restored; make it anew")
      :format(self.name), 3)
  end
end

-- The arc length of the wire nearest to a point.
local function nearest_place(wire, at)
  local x, s = wire:positions()
  local best, place = math.huge, 0
  for i = 1, #s - 1 do
    local a, b, t, e = 3 * i - 2, 3 * i + 1, 0, 0
    for k = 0, 2 do
      local d = x[b + k] - x[a + k]
      t, e = t + d * (at[k + 1] - x[a + k]), e + d * d
    end
    t = math.max(0, math.min(1, t / e))
    local d2 = 0
    for k = 0, 2 do d2 = d2 + (at[k + 1] - x[a + k] - t * (x[b + k] - x[a + k])) ^ 2 end
    if d2 < best then best, place = d2, s[i] + t * (s[i + 1] - s[i]) end
  end
  return place
end

local function needs_hold(self, verb)
  if getmetatable(self) ~= Gripper then
    error(("gripper:%s is a method: call it with a colon"):format(verb), 3)
  end
  if not self.hold then
    error(("gripper '%s' holds nothing; grasp a wire before you %s"):format(self.name, verb), 3)
  end
  process.guard("gripper:" .. verb)
end

--- Take hold of wire around arc length s [m].
function Gripper:grasp(wire, args)
  if args == nil then args = {} end
  if getmetatable(self) ~= Gripper then error("gripper:grasp: call it with a colon", 2) end
  needs_scene(self)
  if core.type(wire) ~= "wire" then
    error("gripper:grasp expects a wire, got " .. (core.type(wire) or type(wire)), 2)
  end
  check_keys("gripper:grasp", args, { s = true, approach = true }, 3)
  local approach = args.approach or "imposed"
  if not approaches[approach] then
    error(("gripper '%s': approach = '%s' is not one of: imposed"):format(self.name,
      tostring(approach)), 2)
  end
  if self.hold then error(("gripper '%s' already holds a wire"):format(self.name), 2) end
  local s = args.s
  if s == nil then
    if not self.at then
      error(("gripper '%s': give s [m], or the gripper's place at = {x, y, z} [m]")
        :format(self.name), 2)
    end
    s = nearest_place(wire, self.at)
  end
  self.hold = build.call(3, self.scene.grip, self.scene, wire, { s = s, width = self.width,
    name = self.name .. (#self.past > 0 and "#" .. #self.past + 1 or "") })
  self.past[#self.past + 1] = self.hold
  return self
end

local move_keys = { path = true, points = true, to = true, by = true, rotation = true, scale = true }

-- The trajectory's table for a move from the present pose.
local function move_table(self, args)
  local t = {}
  for k, v in pairs(args) do
    if not move_keys[k] and k ~= "on_slip" then t[k] = v end
  end
  local here, facing = self.hold:pose()
  here.rotation = facing
  local points = args.points or args.path
  if type(points) == "string" then points = trajectory.read(points, args.scale) end
  if args.rotation ~= nil and args.to == nil then
    error("gripper:move: rotation goes with to; way-points have their own", 3)
  end
  if args.to then
    local to = vector("gripper:move: to", args.to, 4)
    to.rotation = args.rotation
    points = { here, to }
  elseif args.by then
    points, t.relative = { { 0, 0, 0 }, vector("gripper:move: by", args.by, 4) }, true
  elseif not points and t.turn then
    points, t.relative = { { 0, 0, 0 }, { 0, 0, 0 } }, true
  elseif type(points) == "table" and type(points[1]) == "table" and not t.relative then
    local first = points[1]
    local x, y, z = first.x or first[1], first.y or first[2], first.z or first[3]
    local numbers = type(x) == "number" and type(y) == "number" and type(z) == "number"
    local gap = numbers and ((x - here[1]) ^ 2 + (y - here[2]) ^ 2 + (z - here[3]) ^ 2) ^ 0.5 or 0
    if gap > 1e-9 and not (first.t or t.times) then
      points = table.move(points, 1, #points, 2, { here }) -- the caller's stays as it is
    end
  end
  t.points = points
  return t
end

--- Move the tool: { path = "file.csv" | points = {...} | to = point | by = vector,
-- speed = [m/s] | duration = [s], law =, blend =, turn = { axis =, angle = [rad] } }.
-- Inside a process it returns when the move is done, elsewhere at once.
function Gripper:move(args)
  needs_hold(self, "move")
  if type(args) ~= "table" then error("gripper:move takes one table of parameters", 2) end
  if not (args.path or args.points or args.to or args.by or args.turn) then
    error(("gripper '%s': move where? give path, points, to, by or turn"):format(self.name), 2)
  end
  local motion = build.call(3, core.trajectory, move_table(self, args))
  local duration = build.call(3, self.hold.follow, self.hold, motion)
  local p = process.current()
  if p then process.sleep_until(p, self.scene.time + duration) end
  return self
end

--- Turn the tool about its centre by angle [rad] around axis.
function Gripper:rotate(args)
  if type(args) ~= "table" then error("gripper:rotate takes { axis =, angle = [rad] }", 2) end
  local t = {}
  for k, v in pairs(args) do t[k] = v end
  t.turn, t.axis, t.angle = { axis = args.axis, angle = args.angle }, nil, nil
  return self:move(t)
end

function Gripper:release()
  needs_hold(self, "release")
  self.at = self.hold:pose()
  build.call(3, self.hold.release, self.hold)
  self.hold = nil
  return self
end

--- Force on the wire now [N]; zero while nothing is held.
function Gripper:force()
  return self.hold and self.hold:force() or { 0, 0, 0 }
end

--- Moment on the wire now, about the tool centre or { at = point } [N m].
function Gripper:moment(args)
  return self.hold and self.hold:moment(args) or { 0, 0, 0 }
end

function Gripper:position()
  return self.hold and self.hold:pose() or self.at
end

-- Every recorded step of every grasp: t, force, moment as three arrays.
local function records(self)
  local list = {}
  for _, hold in ipairs(self.past) do
    local rows, count = hold:log()
    for i = 0, count - 1 do
      local b = 10 * i
      list[#list + 1] = { t = rows[b + 1], rows[b + 2], rows[b + 3], rows[b + 4], rows[b + 5],
        rows[b + 6], rows[b + 7] }
    end
  end
  return list
end

local function norm(r, first) return (r[first] ^ 2 + r[first + 1] ^ 2 + r[first + 2] ^ 2) ^ 0.5 end

--- Measures over [t1, t2] [s]: a table with peak_force, mean_force [N],
-- peak_moment, mean_moment [N m], impulse (vector) [N s] and the times of the
-- peaks. Means are over time, of the magnitudes.
function Gripper:over(t1, t2)
  t1, t2 = t1 or -math.huge, t2 or math.huge
  local m = { peak_force = 0, peak_moment = 0, impulse = { 0, 0, 0 }, duration = 0 }
  local force_time, moment_time, before = 0, 0, nil
  for _, r in ipairs(records(self)) do
    if r.t >= t1 and r.t <= t2 then
      local f, n = norm(r, 1), norm(r, 4)
      if f > m.peak_force then m.peak_force, m.peak_force_time = f, r.t end
      if n > m.peak_moment then m.peak_moment, m.peak_moment_time = n, r.t end
      if before then
        local h = r.t - before.t
        m.duration = m.duration + h
        force_time = force_time + 0.5 * h * (f + norm(before, 1))
        moment_time = moment_time + 0.5 * h * (n + norm(before, 4))
        for k = 1, 3 do m.impulse[k] = m.impulse[k] + 0.5 * h * (r[k] + before[k]) end
      end
      before = r
    end
  end
  m.mean_force = m.duration > 0 and force_time / m.duration or m.peak_force
  m.mean_moment = m.duration > 0 and moment_time / m.duration or m.peak_moment
  return m
end

--- Series of force and moment: { t =, force = {{x, y, z}, ...}, moment = }.
function Gripper:series()
  local s = { t = {}, force = {}, moment = {} }
  for i, r in ipairs(records(self)) do
    s.t[i], s.force[i], s.moment[i] = r.t, { r[1], r[2], r[3] }, { r[4], r[5], r[6] }
  end
  return s
end

local measures = { peak_force = true, mean_force = true, peak_moment = true, mean_moment = true,
  impulse = true }

-- Fields that may be nil.
local fields = { hold = true, at = true, gone = true }

function Gripper:__index(key)
  if measures[key] then return self:over()[key] end
  local value = Gripper[key]
  if value ~= nil or fields[key] then return value end
  local names = {}
  for name in pairs(Gripper) do names[#names + 1] = name end
  for name in pairs(measures) do names[#names + 1] = name end
  local near = core.nearest(tostring(key), names)
  error(("gripper has no '%s'%s"):format(tostring(key),
    near and ("; did you mean '" .. near .. "'?")
      or "; help 'gripper' at the prompt lists what it has"), 2)
end

--- Names of methods and measures, for completion at the prompt.
function Gripper.__names()
  local names = { "name", "width" }
  for name in pairs(Gripper) do
    if name:sub(1, 2) ~= "__" and name ~= "remember" and name ~= "recall" then
      names[#names + 1] = name
    end
  end
  for name in pairs(measures) do names[#names + 1] = name end
  return names
end

function Gripper:__tostring()
  return ("gripper '%s' (%s)"):format(self.name, self.hold and "holding" or "open")
end

return Gripper
