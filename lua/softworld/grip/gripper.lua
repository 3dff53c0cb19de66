-- SPDX-License-Identifier: GPL-3.0-or-later
--- Grippers. Three ways to take hold of a wire: "imposed" fixes the wire between the pads rigidly to
-- the gripper, so that it follows the gripper's trajectory; "plates" squeezes it between rigid pads
-- and carries it by friction; "mixed" squeezes it with pads and then carries it as imposed.
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
-- @module softworld.grip.gripper
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local grasp = require "softworld.grip.grasp"
local inherited = require "softworld.inherited"
local reactions = require "softworld.grip.reactions"
local stand = require "softworld.grip.stand"
local gripmoves = require "softworld.grip.moves"
local keep = require "softworld.scene.keep"
local measures = require "softworld.grip.measures"
local pads = require "softworld.grip.pads"
local press = require "softworld.grip.press"
local process = require "softworld.run.process"
local rating = require "softworld.grip.rating"
local replaced = require "softworld.run.replaced"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local target = require "softworld.grip.target"
local untwisted = require "softworld.grip.untwisted"
local vec = require "softworld.vec"
local vector = require "softworld.vector"

local Gripper = { __name = "gripper" }
keep.class("gripper", Gripper)
sealed.class(Gripper)

for _, part in ipairs{ grasp, measures, gripmoves } do
  for name, f in pairs(part.methods) do Gripper[name] = f end
end

-- True if there are real pads; with only `width` given, the grip is imposed.
local function has_pads(given)
  for key in pairs(given or {}) do
    if key ~= "width" then return true end
  end
  return false
end

local new = rows.call("scene:gripper", "{...}", "a gripper that grasps wires, moves them and lets go", {
  gives = "a gripper", example = 'scene:gripper { name = "left", pads = { friction = 0.6 } }',
  { "name", "text", "-", "name in messages and series", usual = "gripper1, ..." },
  { "pads", "table", "-", "its fingers", rows = pads.rows },
  { "at", "vector", "m", "the tool's centre while it holds nothing" },
  { "rotation", "rotation", "-", "orientation of the tool there: x along the wire, fingers close along y, z "
    .. "up" },
  { "arm", "table", "-", "a capsule that goes up from the pads", rows = pads.arm_rows },
  { "slip_tolerance", "number", "m", "shorter slides do not count as slip", min = 0, above = true,
    default = 1e-4 },
  { "on_crash", "reaction", "-",
    "reaction when pads or arm run into an obstacle: one of these, or a function(gripper, event)",
    choices = reactions.words, usual = "record" },
  rating.row,
})

-- Fields that a gripper keeps if a restored snapshot does not contain it.
local lasting = { scene = true, name = true, pads = true, width = true, arm = true, first_at = true,
  solid = true, slip_tolerance = true, rating = true }

local function make(scene, args)
  local a = new:read(args == nil and {} or args)
  local data = build.data(scene)
  local given = pads.check(a.pads or {}, "scene:gripper: pads")
  local self = sealed.new(Gripper)
  self.scene = scene
  self.name = build.name(scene, a.name, "gripper", #data.grippers, 0)
  self.pads, self.width = given, given.width
  remarks.on("pads", ("gripper '%s': pads"):format(self.name), a.pads or {})
  self.at, self.rotation, self.arm, self.on_crash = a.at, a.rotation, a.arm or false, a.on_crash
  self.slip_tolerance, self.rating = a.slip_tolerance, a.rating
  remarks.on("rating", ("gripper '%s': rating"):format(self.name), a.rating)
  self.past, self.spans = {}, {} -- holds of all grasps, and { from =, to = [s] } of each
  self.grips = {} -- what is held: { wire =, hold = }
  self.first_at = a.at or false
  self.solid = a.arm ~= nil or a.on_crash ~= nil or has_pads(args and args.pads) -- even while empty
  self.events = {} -- what happened: { kind =, time =, s =, ... }
  data.grippers[#data.grippers + 1] = self
  return self
end

--- scene:gripper{ ... }: see help "scene:gripper".
function core.class.scene.gripper(scene, args)
  build.check(scene, "scene:gripper", 3)
  return (build.call(3, make, scene, args))
end

--- Resets the gripper, for a restored snapshot from before it was made.
function Gripper:leave()
  local own = sealed.fields(self)
  for key in pairs(own) do
    if not lasting[key] then own[key] = nil end
  end
  own.grips, own.past, own.spans, own.events, own.gone = {}, {}, {}, {}, true
end

-- Raises an error unless the gripper can be moved. Makes nothing yet, because the arguments may be wrong.
local function check_place(self, verb)
  if getmetatable(self) ~= Gripper then
    error(("gripper:%s is a method: call it with a colon"):format(verb), 3)
  end
  process.guard("gripper:" .. verb)
  stand.check_scene(self, 4)
  if self.hold or self.tool or self.carrier or self.at or self.rotation then return end
  error(("gripper '%s' holds nothing; grasp a wire before you %s, or make the gripper with at = {x, y, z} "
    .. "[m]"):format(self.name, verb), 3)
end

-- Returns the moving object: tool or hold; nil if there is none yet.
local function moved(self)
  if self.hold and not self.tool then return self.carrier or self.hold end
  return self.tool or self.carrier
end

-- Returns the moving object; makes a tool at the gripper's place if there is none yet.
local function make_moved(self)
  if moved(self) then return moved(self) end
  if self.solid then stand.make_tool(self, 4) else build.call(4, stand.make_carrier, self) end
  return moved(self)
end

local function pose_of(self)
  local held, at = moved(self), self.at or { 0, 0, 0 }
  if held then return held:pose() end
  return { at[1], at[2], at[3] }, self.rotation or not self.solid and self.facing or { 1, 0, 0, 0 }
end

local move = rows.call("gripper:move", "{...}", "moves the tool; in a process it returns at the end of the "
  .. "move", {
  gives = "the gripper", also = "trajectory", example = "hand:move { by = { 0, 0, 0.1 }, speed = 0.2 }",
  { "by", "vector", "m", "displacement of the move" },
  { "to", "vector", "m", "target of the move" },
  { "rotation", "rotation", "-", "rotation of the tool at `to`" },
  { "points", "list", "m", "way-points {x, y, z}, with times t or rotations where wanted" },
  { "path", "file or list", "-", "CSV file of way-points, or the way-points" },
  { "scale", "number", "m", "length unit of columns of the file that name no unit", min = 0, above = true },
  { "turn", "table", "-", "turn about the tool's centre, during the move or in place", rows = rows.list{
    { "axis", "vector", "-", "of the turn" }, { "angle", "number", "rad", "of the turn" } } },
  reactions.on_slip_row,
})

--- Moves the tool, see help "gripper:move".
function Gripper:move(args)
  check_place(self, "move")
  args = move:read(args)
  local p = build.call(3, process.of, self.scene, "gripper:move")
  if not (args.path or args.points or args.to or args.by or args.turn or args.func) then
    error(("gripper '%s': move has no target; give path, points, to, by, turn or func"):format(self.name), 2)
  end
  if args.func and not args.duration then
    error(("gripper '%s': move: func has no end; give duration [s]"):format(self.name), 2)
  end
  local motion = build.call(3, target.motion, args, pose_of(self))
  remarks.on("move", ("gripper '%s': move"):format(self.name), args)
  local held = make_moved(self)
  if args.on_slip ~= nil then reactions.set_on_slip(self, args.on_slip, 3) end
  local duration = build.call(3, held.follow, held, motion)
  replaced.tell(self.scene, self.name, ("gripper '%s'"):format(self.name), "move", self.busy_until)
  if args.turn then untwisted.turns(self, args.turn) end
  self.busy_until = self.scene.time + duration
  if p then process.sleep_until(p, self.scene.time + duration) end
  return self
end

local rotate = rows.call("gripper:rotate", "{...}", "turns the tool about its centre, as gripper:move", {
  gives = "the gripper",
  { "axis", "vector", "-", "of the turn", required = true },
  { "angle", "number", "rad", "of the turn", required = true },
  { "about", "vector", "m", "centre of the turn, instead of the tool's own" },
  { "duration", "number", "s", "of the turn" },
  { "angular_speed", "number", "rad/s", "instead of a duration" },
  { "angular_acceleration", "number", "rad/s2", "for law = 'trapezoidal'" },
  { "speed", "number", "m/s", "see gripper:move" },
  { "acceleration", "number", "m/s2", "see gripper:move" },
  { "law", "text", "-", "see gripper:move" },
  { "blend", "number", "m", "see gripper:move" },
  { "stop", "boolean", "-", "see gripper:move" },
  { "on_slip", "reaction", "-", "see gripper:move", choices = reactions.words },
})

--- Turns the tool, see help "gripper:rotate".
function Gripper:rotate(args)
  rotate:read(args)
  local t = {}
  for k, v in pairs(inherited.flat(args)) do t[k] = v end
  t.turn, t.axis, t.angle = { axis = args.axis, angle = args.angle }, nil, nil
  return self:move(t)
end

--- Stops the tool where it is. A process that waits for its move still waits until the planned end.
function Gripper:stop()
  check_place(self, "stop")
  local held = moved(self)
  if held then held:follow(nil) end
  self.busy_until = math.min(self.busy_until or self.scene.time, self.scene.time)
  return self
end

local press_call = rows.call("gripper:press", "{...}", "moves until the wire pushes back with a force; in a "
  .. "process only", {
  gives = "force reached [N], distance moved [m], true if the wanted force was reached",
  { "force", "number", "N", "push of the wire at which it stops; reached within 10 %", min = 0, above = true,
    required = true },
  { "direction", "vector", "-", "direction of the move", default = { 0, 0, -1 } },
  { "speed", "number", "m/s", "speed of the move", min = 0, above = true, default = 0.02 },
  { "distance", "number", "m", "longest move", min = 0, above = true, default = 0.1 },
})

--- Presses on the wire, see help "gripper:press".
function Gripper:press(args)
  check_place(self, "press")
  args = press_call:read(args)
  local p = build.call(3, process.within, self.scene, "gripper:press",
    "gripper:press works inside a process only")
  local way = vec.unit(args.direction)
  if not way then error("gripper:press: direction must not be zero", 2) end
  remarks.on("press", ("gripper '%s': press"):format(self.name), args)
  replaced.tell(self.scene, self.name, ("gripper '%s'"):format(self.name), "press", self.busy_until)
  return press.run(self, p, make_moved(self), way, args)
end

rows.calls{ { "gripper:position", "", "the tool's centre, or its place at the next grasp",
  "{x, y, z} [m], or nil" } }

--- Lets go, see help "gripper:release".
function Gripper:release(args)
  if getmetatable(self) ~= Gripper then
    error("gripper:release is a method: call it with a colon", 2)
  end
  stand.check_scene(self, 3)
  if not self.wire and self.bereft then -- its wire was removed
    self.bereft = nil
    return self.tool and self:open_jaws(args or {}) or self
  end
  if not self.wire then
    error(("gripper '%s' holds nothing; grasp a wire before you release"):format(self.name), 2)
  end
  return grasp.release(self, args)
end

function Gripper:position()
  local carrier = self.tool or self.carrier
  if carrier then return (carrier:pose()) end
  if self.hold then return (self.hold:pose()) end
  return self.at and vector.of{ table.unpack(self.at, 1, 3) }
end

local shortcuts = { peak_force = true, mean_force = true, peak_moment = true, mean_moment = true,
  impulse = true, peak_margin = true }

-- Fields that may be nil.
local fields = {}
for _, key in ipairs{ "gone", "wires", "hold", "at", "rotation", "tool", "wire", "way", "frozen", "on_slip",
  "opening", "order", "obstacles", "held", "unchecked", "s", "free_height", "margin", "segments",
  "mesh_model", "rod_model", "slip_event", "crash_time", "on_crash", "carrier", "facing",
  "busy_until", "left", "bereft", "astray", "rating", "unlooked", "turns_seen",
  "closing" } do
  fields[key] = true
end

-- What scripts see while pads close in a grasp: the gripper holds nothing yet.
local unheld = { wire = function() return nil end, wires = function() return {} end }

function Gripper:__index(key)
  if reactions.looks[key] and not sealed.by_library() then reactions.seen(self) end
  if unheld[key] and rawget(sealed.fields(self), "closing") and not sealed.by_library() then
    return unheld[key]()
  end
  local own = rawget(sealed.fields(self), key)
  if own ~= nil then return own end
  if shortcuts[key] then return self:over()[key] end
  if key == "wires" then -- the wires it holds
    local list = {}
    for i, grip in ipairs(self.grips) do list[i] = grip.wire end
    return list
  end
  local value = Gripper[key]
  if value ~= nil or fields[key] then return value end
  local names = {}
  for name in pairs(Gripper) do names[#names + 1] = name end
  for name in pairs(shortcuts) do names[#names + 1] = name end
  error(checks.lacks("gripper", key, names, "`softworld doc gripper` lists what it has"), 2)
end

-- Fields that scripts may set, each with its check.
local settable = {
  slip_tolerance = function(value) checks.number("gripper.slip_tolerance", value, 0, " m", 4, nil, true) end,
  on_slip = function(value) reactions.check("gripper.on_slip", value, 4) end,
  on_crash = function(value) reactions.check("gripper.on_crash", value, 4) end,
  events = function(value)
    if type(value) == "table" then return end
    error("gripper.events: must be a table, such as {} to forget events, got " .. type(value), 4)
  end,
}

function Gripper:__newindex(key, value)
  if not sealed.by_library() then
    local check = settable[key]
    if not check then
      local near = core.nearest(checks.shown(key), { "slip_tolerance", "on_slip", "on_crash", "events" })
      error(("gripper has no '%s' to set%s"):format(checks.shown(key),
        near and ("; did you mean '%s'?"):format(near) or "; other values are given to scene:gripper"), 2)
    end
    if value ~= nil then check(value) end
  end
  rawset(sealed.fields(self), key, value)
end

rows.calls{
  { "gripper:stop", "", "stops where it is now", "the gripper" },
  { "gripper.name", nil, "name in messages and series" },
  { "gripper.width", nil, "of the pads along the wire", "m" },
  { "gripper.wire", nil, "the wire that it holds, the first of several", "a wire, or nil" },
  { "gripper.wires", nil, "all that it holds", "a list" },
  { "gripper.events", nil, "what happened; may be set to {}",
    "{ kind = 'slip', 'lost', 'crash', ..., time [s], wire = the lost one of several }, ..." },
  { "gripper.slip_tolerance", nil, "see scene:gripper; may be set", "m" },
  { "gripper.rating", nil, "see scene:gripper; gripper:set replaces it", "a table, false or nil" },
  { "gripper.on_slip", nil, "see gripper:grasp; may be set" },
  { "gripper.on_crash", nil, "see scene:gripper; may be set" },
}

for name, value in pairs(Gripper) do
  if type(value) == "function" and name:sub(1, 2) ~= "__" then
    Gripper[name] = build.placed(value)
  end
end

--- Returns the names of methods and measures, for completion at the prompt.
function Gripper.__names()
  local names = { "name", "width", "events", "wire", "wires", "rating" }
  for name in pairs(Gripper) do
    if name:sub(1, 2) ~= "__" and name ~= "leave" then
      names[#names + 1] = name
    end
  end
  for name in pairs(shortcuts) do names[#names + 1] = name end
  return names
end

function Gripper:__tostring()
  if not core.exists(self.scene) then return ("gripper '%s' (its scene is closed)"):format(self.name) end
  local doing = "open"
  local names = {}
  for i, grip in ipairs(self.grips) do names[i] = ("'%s'"):format(grip.wire.name) end
  if self.left then doing = "taken away" end
  local verb = rawget(sealed.fields(self), "closing") and "closing on" or "holding"
  if #names > 0 then doing = ("%s %s, %s"):format(verb, table.concat(names, " and "), self.way) end
  return ("gripper '%s' (%s)"):format(self.name, doing)
end

return Gripper
