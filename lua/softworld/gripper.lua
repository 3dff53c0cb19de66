-- SPDX-License-Identifier: GPL-3.0-or-later
--- Grippers. Three ways to take hold of a wire: "imposed", where the wire between the pads is one
-- with the gripper and follows its trajectory; "plates", where rigid pads squeeze it and carry it
-- by friction; "mixed", which squeezes it for real and then carries it as imposed.
--
--     local left = scene:gripper{ name = "left", pads = { width = 0.02, friction = 0.6 } }
--     scene:process(function(p)
--       left:grasp(wire, { s = 0.02, approach = "plates", force = 5 })
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
local checks = require "softworld.checks"
local grasp = require "softworld.grasp"
local gripmoves = require "softworld.gripmoves"
local keep = require "softworld.keep"
local measures = require "softworld.gripmeasures"
local pads = require "softworld.pads"
local process = require "softworld.process"
local remarks = require "softworld.remarks"
local sealed = require "softworld.sealed"
local trajectory = require "softworld.trajectory"

local Gripper = { __name = "gripper" }
keep.class("gripper", Gripper)
sealed.class(Gripper)
local check_keys, vector = checks.keys, checks.vector

for _, part in ipairs{ grasp, measures, gripmoves } do
  for name, f in pairs(part.methods) do Gripper[name] = f end
end

-- Are there real pads, or just how wide an imposed grip is?
local function has_pads(given)
  for key in pairs(given or {}) do
    if key ~= "width" then return true end
  end
  return false
end

local keys = { name = true, pads = true, at = true, rotation = true, slip_tolerance = true, arm = true,
  on_crash = true }

--- scene:gripper{ name =, pads = {...}, at = {x, y, z} [m], rotation =, slip_tolerance = [m],
-- arm = { radius =, length = [m] }, on_crash = }
-- at is where the tool is while it holds nothing; grasp without s takes the
-- place of the wire nearest to it. The arm goes up from the pads. on_crash as on_slip: the
-- reaction to pads or arm that run into an obstacle. See help "gripper" for pads.
function core.class.scene.gripper(scene, args)
  build.check(scene, "scene:gripper", 3)
  if args == nil then args = {} end
  check_keys("scene:gripper", args, keys, 3)
  local given = pads.check(args.pads or {}, "scene:gripper: pads", 3)
  if args.name ~= nil and type(args.name) ~= "string" then
    error("scene:gripper: name must be a string, got " .. type(args.name), 2)
  end
  if args.slip_tolerance ~= nil then
    checks.number("scene:gripper: slip_tolerance", args.slip_tolerance, 0, " m", 3, nil, true)
  end
  if args.on_crash ~= nil then grasp.check_reaction("scene:gripper: on_crash", args.on_crash, 3) end
  if args.arm ~= nil then pads.check_arm(args.arm, "scene:gripper: arm", 3) end
  local at = args.at ~= nil and vector("scene:gripper: at", args.at, "m", 3) or nil
  if args.rotation ~= nil then checks.rotation("scene:gripper: rotation", args.rotation, 3) end
  local data = build.data(scene)
  local self = sealed.new(Gripper)
  self.scene = scene
  self.name = build.name(scene, args.name, "gripper", #data.grippers, 3)
  self.pads, self.width = given, given.width
  remarks.on("pads", ("gripper '%s': pads"):format(self.name), args.pads or {})
  self.at, self.rotation = at, args.rotation
  self.arm, self.on_crash = args.arm or false, args.on_crash
  self.slip_tolerance = args.slip_tolerance or 1e-4
  self.past, self.spans = {}, {} -- clamps of all grasps, and { from =, to = [s] } of each
  self.grips = {} -- what is held: { wire =, hold = }
  self.first_at = at or false
  self.solid = args.arm ~= nil or args.on_crash ~= nil or has_pads(args.pads) -- also while empty
  self.events = {} -- what happened: { kind =, time =, s =, ... }
  data.grippers[#data.grippers + 1] = self
  return self
end

local remembered = { "hold", "at", "rotation", "tool", "wire", "way", "frozen", "on_slip", "opening",
  "order", "obstacles", "held", "unchecked", "s", "free_height",
  "margin", "segments", "mesh_model", "rod_model", "slip_event", "crash_time", "on_crash",
  "grips", "carrier", "facing", "busy_until" }

--- The gripper's part of a snapshot, and the way back; recall(nil) for one that was made later.
function Gripper:remember()
  local state = { grasps = #self.past, events = #self.events }
  for _, key in ipairs(remembered) do state[key] = self[key] end
  state.spans = {}
  for i, span in ipairs(self.spans) do
    state.spans[i] = { from = span.from, to = span.to, carried = span.carried }
  end
  return state
end

function Gripper:recall(state)
  if state ~= nil and (type(state) ~= "table" or not state.grasps or not state.events) then
    error("gripper:recall takes what gripper:remember gave, got " .. type(state), 2)
  end
  self.gone = state == nil or nil
  for _, key in ipairs(remembered) do self[key] = state and state[key] end
  if not state then
    self.grips = {}
    return
  end
  for i = #self.past, state.grasps + 1, -1 do self.past[i] = nil end
  self.spans = {}
  for i, span in ipairs(state.spans) do
    self.spans[i] = { from = span.from, to = span.to, carried = span.carried }
  end
  for i = #self.events, state.events + 1, -1 do self.events[i] = nil end
end

-- Raise unless the gripper can be moved. Makes nothing yet, for the arguments may be wrong.
local function check_place(self, verb)
  if getmetatable(self) ~= Gripper then
    error(("gripper:%s is a method: call it with a colon"):format(verb), 3)
  end
  process.guard("gripper:" .. verb)
  grasp.check_scene(self, 4)
  if self.hold or self.tool or self.carrier or self.at or self.rotation then return end
  error(("gripper '%s' holds nothing; grasp a wire before you %s, or give the place where it is when "
    .. "you make it: at = {x, y, z} [m]"):format(self.name, verb), 3)
end

-- The thing that moves: tool or hold; nil when there is none yet.
local function moved(self)
  if self.hold and not self.tool then return self.carrier or self.hold end
  return self.tool or self.carrier
end

-- The thing that moves; a new tool at the gripper's place when there is none yet.
local function make_moved(self)
  if moved(self) then return moved(self) end
  if self.solid then grasp.make_tool(self, 4) else build.call(4, grasp.make_carrier, self) end
  return moved(self)
end

local function pose_of(self)
  local held, at = moved(self), self.at or { 0, 0, 0 }
  if held then return held:pose() end
  return { at[1], at[2], at[3] }, self.rotation or not self.solid and self.facing or { 1, 0, 0, 0 }
end

local move_keys = { path = true, points = true, to = true, by = true, rotation = true, scale = true }

-- The trajectory's table for a move from the present pose.
local function move_table(self, args)
  local t = {}
  for k, v in pairs(args) do
    if not move_keys[k] and k ~= "on_slip" then t[k] = v end
  end
  local here, facing = pose_of(self)
  here.rotation = facing
  local points = args.points or args.path
  if type(points) == "string" then points = trajectory.read(points, args.scale) end
  if args.rotation ~= nil and args.to == nil then
    error("gripper:move: rotation goes with to; way-points have their own", 3)
  end
  if args.to then
    local to = vector("gripper:move: to", args.to, "m", 4)
    to.rotation = args.rotation
    points = { here, to }
  elseif args.by then
    points, t.relative = { { 0, 0, 0 }, vector("gripper:move: by", args.by, "m", 4) }, true
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

-- The trajectory of a move; errors name the move.
local function motion_of(args)
  local fine, result = pcall(core.trajectory, args)
  if fine then return result end
  if type(result) ~= "string" then error(result, 0) end
  error((build.plain(result):gsub("^trajectory: ", "gripper:move: ", 1)), 0)
end

local turn_keys = checks.set "axis angle"

--- Move the tool: { path = "file.csv" | points = {...} | to = point | by = vector,
-- speed = [m/s] | duration = [s], law =, blend =, turn = { axis =, angle = [rad] }, on_slip = }.
-- Inside a process it returns when the move is done, elsewhere at once.
function Gripper:move(args)
  check_place(self, "move")
  if type(args) ~= "table" then error("gripper:move takes one table of parameters", 2) end
  if not (args.path or args.points or args.to or args.by or args.turn) then
    error(("gripper '%s': move where? give path, points, to, by or turn"):format(self.name), 2)
  end
  if type(args.turn) == "table" then checks.keys("gripper:move: turn", args.turn, turn_keys, 3) end
  if args.on_slip ~= nil then
    grasp.check_reaction("gripper '" .. self.name .. "': on_slip", args.on_slip, 3)
  end
  local motion = build.call(3, motion_of, move_table(self, args))
  remarks.on("move", ("gripper '%s': move"):format(self.name), args)
  local held = make_moved(self)
  if args.on_slip ~= nil then grasp.set_on_slip(self, args.on_slip, 3) end
  local duration = build.call(3, held.follow, held, motion)
  self.busy_until = self.scene.time + duration
  local p = process.current()
  if p then process.sleep_until(p, self.scene.time + duration) end
  return self
end

--- Move the tool's centre to a point: move_to({x, y, z}, { speed =, rotation =, ... }).
function Gripper:move_to(point, args)
  local t = {}
  if args ~= nil and type(args) ~= "table" then
    error("gripper:move_to takes a point and a table of parameters", 2)
  end
  for k, v in pairs(args or {}) do t[k] = v end
  t.to = point
  return self:move(t)
end

local rotate_keys = checks.set [[axis angle speed angular_speed acceleration angular_acceleration duration
  law blend stop on_slip]]

--- Turn the tool about its centre by angle [rad] around axis.
function Gripper:rotate(args)
  if type(args) ~= "table" then error("gripper:rotate takes { axis =, angle = [rad] }", 2) end
  checks.keys("gripper:rotate", args, rotate_keys, 3)
  checks.rotation("gripper:rotate: turn", { axis = args.axis or {}, angle = args.angle }, 3)
  local t = {}
  for k, v in pairs(args) do t[k] = v end
  t.turn, t.axis, t.angle = { axis = args.axis, angle = args.angle }, nil, nil
  return self:move(t)
end

local press_keys = { direction = true, force = true, speed = true, distance = true }

--- Move along direction (default: down) at speed [m/s] until the wire pushes back with force [N],
-- at most by distance [m]; then stop. Only in a process. Returns the force that was reached and
-- the way gone; true as a third value when it was the force wanted.
function Gripper:press(args)
  check_place(self, "press")
  check_keys("gripper:press", args, press_keys, 3)
  local p = process.current()
  if not p then error("gripper:press works inside a process only", 2) end
  local force = checks.number("gripper:press: force", args.force, 0, " N", 3, nil, true)
  local speed = checks.number("gripper:press: speed", args.speed or 0.02, 0, " m/s", 3, nil, true)
  local most = checks.number("gripper:press: distance", args.distance or 0.1, 0, " m", 3, nil, true)
  local way = vector("gripper:press: direction", args.direction or { 0, 0, -1 }, "-", 3)
  local length = (way[1] ^ 2 + way[2] ^ 2 + way[3] ^ 2) ^ 0.5
  if length == 0 then error("gripper:press: direction must not be zero", 2) end
  for k = 1, 3 do way[k] = way[k] / length end
  local function pushed() -- the gripper pushes the wire along its way
    local f = self:force()
    return f[1] * way[1] + f[2] * way[2] + f[3] * way[3]
  end
  local held = make_moved(self)
  local from, start = held:pose(), pushed()
  held:follow{ points = { { 0, 0, 0 }, { most * way[1], most * way[2], most * way[3] } },
    relative = true, speed = speed, law = "linear" }
  local done = p:wait_until(function() return pushed() - start >= force end,
    { timeout = most / speed })
  held:follow(nil)
  local at, gone = held:pose(), 0
  for k = 1, 3 do gone = gone + (at[k] - from[k]) * way[k] end
  return pushed() - start, gone, done
end

--- Hand the wire over to another gripper, which takes hold with args (see grasp), then let go.
function Gripper:handover(other, args)
  if getmetatable(other) ~= Gripper then
    error("gripper:handover expects the gripper that takes over", 2)
  end
  if not self.wire then error(("gripper '%s' holds nothing to hand over"):format(self.name), 2) end
  if other == self then error(("gripper '%s' cannot hand over to itself"):format(self.name), 2) end
  local wires = {}
  for i, grip in ipairs(self.grips) do wires[i] = grip.wire end
  build.call(3, other.grasp, other, #wires == 1 and wires[1] or wires, args)
  build.call(3, self.release, self)
  return other
end

--- Let go: jaws open (by pads' opening, at speed [m/s]); in a process it returns when they have.
-- { wire = } lets go of one of several wires that are held without pads.
function Gripper:release(args)
  if getmetatable(self) ~= Gripper then
    error("gripper:release is a method: call it with a colon", 2)
  end
  grasp.check_scene(self, 3)
  if not self.wire then
    error(("gripper '%s' holds nothing; grasp a wire before you release"):format(self.name), 2)
  end
  return grasp.release(self, args)
end

function Gripper:position()
  local carrier = self.tool or self.carrier
  if carrier then return (carrier:pose()) end
  return self.hold and (self.hold:pose()) or self.at
end

local shortcuts = { peak_force = true, mean_force = true, peak_moment = true, mean_moment = true,
  impulse = true }

-- Fields that may be nil.
local fields = { gone = true, wires = true }
for _, key in ipairs(remembered) do fields[key] = true end

function Gripper:__index(key)
  local own = rawget(sealed.fields(self), key)
  if own ~= nil then return own end
  if shortcuts[key] then return self:over()[key] end
  if key == "wires" then -- that it holds
    local list = {}
    for i, grip in ipairs(self.grips) do list[i] = grip.wire end
    return list
  end
  local value = Gripper[key]
  if value ~= nil or fields[key] then return value end
  local names = {}
  for name in pairs(Gripper) do names[#names + 1] = name end
  for name in pairs(shortcuts) do names[#names + 1] = name end
  local near = core.nearest(checks.shown(key), names)
  error(("gripper has no '%s'%s"):format(checks.shown(key),
    near and ("; did you mean '" .. near .. "'?")
      or "; help 'gripper' at the prompt lists what it has"), 2)
end

-- Fields that scripts may set, each with its check.
local settable = {
  slip_tolerance = function(value) checks.number("gripper.slip_tolerance", value, 0, " m", 4, nil, true) end,
  on_slip = function(value) grasp.check_reaction("gripper.on_slip", value, 4) end,
  on_crash = function(value) grasp.check_reaction("gripper.on_crash", value, 4) end,
  events = function(value)
    if type(value) == "table" then return end
    error("gripper.events: a table is wanted, as {} to forget them, got " .. type(value), 4)
  end,
}

function Gripper:__newindex(key, value)
  if not sealed.by_library() then
    local check = settable[key]
    if not check then
      local near = core.nearest(checks.shown(key), { "slip_tolerance", "on_slip", "on_crash", "events" })
      error(("gripper has no '%s' to set%s"):format(checks.shown(key),
        near and ("; did you mean '%s'?"):format(near) or "; what it is like is given to scene:gripper"), 2)
    end
    if value ~= nil then check(value) end
  end
  rawset(sealed.fields(self), key, value)
end

for name, value in pairs(Gripper) do
  if type(value) == "function" and name:sub(1, 2) ~= "__" then
    Gripper[name] = build.placed(value)
  end
end

--- Names of methods and measures, for completion at the prompt.
function Gripper.__names()
  local names = { "name", "width", "events", "wire", "wires" }
  for name in pairs(Gripper) do
    if name:sub(1, 2) ~= "__" and name ~= "remember" and name ~= "recall" then
      names[#names + 1] = name
    end
  end
  for name in pairs(shortcuts) do names[#names + 1] = name end
  return names
end

function Gripper:__tostring()
  local doing = "open"
  local names = {}
  for i, grip in ipairs(self.grips) do names[i] = ("'%s'"):format(grip.wire.name) end
  if #names > 0 then doing = ("holding %s, %s"):format(table.concat(names, " and "), self.way) end
  return ("gripper '%s' (%s)"):format(self.name, doing)
end

return Gripper
