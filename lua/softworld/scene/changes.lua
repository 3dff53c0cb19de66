-- SPDX-License-Identifier: GPL-3.0-or-later
--- get and set of scenes, wires and grippers: the values of their rows. Rows marked changeable can be set
-- between steps. Obstacles and forces have get and set in the core.
-- @module softworld.scene.changes
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local rating = require "softworld.grip.rating"
local reactions = require "softworld.grip.reactions"
local stand = require "softworld.grip.stand"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local Gripper = require "softworld.grip.gripper"

-- --- scenes -----------------------------------------------------------------------------------

local of_scene = rows.call("scene:set", "{...}", "changes the scene from now on", {
  example = "scene:set { gravity = { 0, 0, 0 } }",
  { "gravity", "vector", "m/s2", "on everything" },
})
rows.calls{ { "scene:get", "", "present values of the scene's parameters", "name, gravity [m/s2]" } }

--- scene:get() -> { name =, gravity = {x, y, z} [m/s2] }
function core.class.scene.get(scene)
  return { name = scene.name, gravity = build.call(3, scene.gravity, scene) }
end

local function set_scene(scene, args)
  local given = of_scene:read(args)
  remarks.gravity(given.gravity)
  if given.gravity then scene:gravity(given.gravity) end
end

--- scene:set{ gravity = }: see help "scene:set".
function core.class.scene.set(scene, args)
  build.check(scene, "scene:set", 3)
  build.call(3, set_scene, scene, args)
end

-- --- wires ------------------------------------------------------------------------------------

rows.calls{
  { "wire:get", "", "present values of the wire's parameters; wire:remodel changes them",
    "name, model, cable (its name), length [m], segments, radius [m], EA [N], EI, GJ [N m2], "
      .. "mass_per_length [kg/m]" },
}

local function values_of(wire)
  local cable = wire:cable()
  local values = { name = wire.name, model = wire.model, cable = cable and cable.name, length = wire.length,
    segments = wire.segments }
  for key, value in pairs(wire.beam) do values[key] = value end
  return values
end

--- wire:get() -> { name =, model =, length = [m], EI = [N m2], ... }
function core.class.wire.get(wire)
  if core.type(wire) ~= "wire" then error("wire:get is a method: call it with a colon", 2) end
  return build.call(3, values_of, wire)
end

-- --- obstacles --------------------------------------------------------------------------------

rows.calls{
  { "obstacle:get", "", "present values of its parameters",
    "name, at [m], rotation, friction, kinetic_friction, restitution" },
  { "obstacle:set", "{...}", "changes at, rotation, friction, kinetic_friction, restitution from now on",
    example = "plane:set { friction = 0.5 }" },
}

rows.calls{
  { "force:get", "", "present values of its parameters", "kind, and its parameters" },
  { "force:set", "{...}", "new values of drag, wind, damping, viscous_bend, push, point, line, moment",
    example = "damping:set { stiffness = 2e-3 }" },
}

-- --- grippers ---------------------------------------------------------------------------------

local of_gripper = rows.call("gripper:set", "{...}", "changes the gripper from now on", {
  example = "hand:set { force = 12 }",
  { "force", "number", "N", "force that jaws closed by force keep on the wire", min = 0, above = true },
  { "slip_tolerance", "number", "m", "shorter slides do not count as slip", min = 0, above = true },
  reactions.on_slip_row,
  { "on_crash", "reaction", "-", "reaction when pads or arm run into an obstacle: one of these, or a "
    .. "function",
    choices = reactions.words },
  rating.row,
})
rows.calls{ { "gripper:get", "", "present values of its parameters",
  "name, pads, at [m], rotation, arm, slip_tolerance [m], rating, on_slip, on_crash, force [N]" } }

local function copied(t)
  if type(t) ~= "table" then return t or nil end
  local copy = {}
  for key, value in pairs(t) do copy[key] = copied(value) end
  return copy
end

local function kept_force(self)
  return self.order and self.order.mode == "force" and self.order.force or nil
end

function Gripper:get()
  stand.check_there(self, 3)
  local rated = self.rating -- it may be false, and so may its parts
  if rated then
    rated = { force = rated.force, moment = rated.moment, stroke = rated.stroke, source = rated.source }
  end
  return { name = self.name, pads = copied(self.pads), rating = rated, at = self:position(),
    rotation = copied(self.rotation),
    arm = copied(self.arm), slip_tolerance = self.slip_tolerance, on_slip = self.on_slip,
    on_crash = self.on_crash, force = kept_force(self) }
end

function Gripper:set(args)
  stand.check_scene(self, 3)
  local given = of_gripper:read(args)
  if given.force and (not self.tool or self.frozen or not kept_force(self)) then
    error(("gripper:set: force: gripper '%s' has no jaws that keep a force on a wire; grasp with force [N]")
      :format(checks.shown(self.name)), 0)
  end
  self.slip_tolerance = given.slip_tolerance or self.slip_tolerance
  if given.on_crash ~= nil then self.on_crash = given.on_crash end
  if given.on_slip ~= nil then self.on_slip = given.on_slip end
  if given.rating ~= nil then self.rating = given.rating end
  remarks.on("rating", ("gripper '%s': rating"):format(self.name), given.rating)
  if given.slip_tolerance or given.on_slip ~= nil then reactions.watch(self) end
  if given.force then
    self.order = { mode = "force", speed = self.order.speed, force = given.force }
    self.tool:jaws(self.order)
  end
end

for _, name in ipairs{ "get", "set" } do Gripper[name] = build.placed(Gripper[name]) end
