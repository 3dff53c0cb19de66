-- SPDX-License-Identifier: GPL-3.0-or-later
--- Closes and opens the jaws of a gripper: to a force, an opening, or until contact.
-- @module softworld.grip.jaws
local build = require "softworld.scene.build"
local mixed = require "softworld.grip.mixed"
local number = require "softworld.output.number"
local process = require "softworld.run.process"
local replaced = require "softworld.run.replaced"
local rows = require "softworld.rows"
local stand = require "softworld.grip.stand"
local tension = require "softworld.check.tension"
local vec = require "softworld.vec"

local jaws = { methods = {} }
local Methods = jaws.methods

jaws.SPEED = 0.02 -- default speed of the opening [m/s]
jaws.MOST = 1e3   -- largest opening and largest speed that the core accepts [m], [m/s]
local PATIENCE = 2 -- wait for a force after the time in which the jaws could have closed [s]
local CRUSHED = 0.2 -- a wire is crushed below this opening over its diameter [-]

local function note(self, kind, fields)
  fields.kind, fields.time = kind, self.scene.time
  self.events[#self.events + 1] = fields
end

jaws.force_row = { "force", "number", "N", "force of each finger on the wire, kept from then on", min = 0,
  above = true }
jaws.distance_row = { "distance", "number", "m", "opening to go to, unless the force is reached before",
  min = 0, max = jaws.MOST }
jaws.speed_row = { "speed", "number", "m/s", "speed of the opening; given alone: close until contact",
  min = 0, max = jaws.MOST, above = true, usual = jaws.SPEED }

local close = rows.call("gripper:close_jaws", "{...}", "closes the jaws", {
  gives = "the gripper; in a process once that is done", jaws.force_row, jaws.distance_row,
  jaws.speed_row })
local open = rows.call("gripper:open_jaws", "{...}", "opens the jaws", {
  gives = "the gripper; in a process once that is done",
  { "distance", "number", "m", "between the faces", min = 0, max = jaws.MOST, usual = "pads' opening" },
  { "speed", "number", "m/s", "of the opening", min = 0, max = jaws.MOST, above = true, usual = jaws.SPEED },
})

--- Returns the core's order for the arguments of close_jaws, after checks.
function jaws.order(self, args, what)
  local distance, force, speed = args.distance, args.force, args.speed or jaws.SPEED
  if not (distance or force or args.speed) then
    error(("%s: give force [N], distance [m] or speed [m/s]"):format(what), 0)
  end
  if distance then return { mode = "to", opening = distance, speed = speed, force = force } end
  if force then return { mode = "force", speed = speed, force = force } end
  -- by speed: until contact, a force of 1 % of the wire's weight but at least 1 mN
  local contact = 0.01
  if self.wire then
    contact = math.max(1e-3, 0.01 * self.wire.beam.mass_per_length * 9.81 * self.wire.length)
  end
  return { mode = "to", opening = 0, speed = speed, force = contact }
end

local FAST = 0.1 -- a wire that moves faster while jaws close at rest is held by nothing [m/s]

-- Returns how far the wire is from the tool, and whether it went away while the jaws closed.
local function whereabouts(self, wire)
  local s, d = stand.nearest_place(wire, (self.tool:pose()))
  local speed = vec.norm(wire:velocity(s))
  local away = speed > FAST and (" and moves at %s: it went away while the jaws closed; hold it, or lay it "
    .. "on something"):format(number.text(speed, "m/s")) or ""
  return (": wire '%s' is %s from the tool centre%s"):format(wire.name, number.text(d, "m"), away)
end

-- True if the wire's axis lies above or below the fingers, which then touch it with their rims only.
local function is_beside(self, wire)
  if not (wire and self.span) then return false end
  local at, q = self.tool:pose()
  local s = stand.nearest_place(wire, at)
  local z = vec.dot(vec.sub(wire:position(s), at), vec.rotate(q, { 0, 0, 1 }))
  return z < self.span[1] or z > self.span[2]
end

local AROUND = { flat = true, round = true } -- shapes of fingers that close as the sides of a polygon

-- True if the wire's axis is out of the polygon of three or more fingers: they have closed beside it, and
-- some press it from outside. Within the polygon an axis has at least its radius to each side, and is at most
-- twice as far from the centre as it could go towards a side: in the corner of a triangle.
local function is_outside(self, wire, state)
  local fingers = self.pads
  if not wire or state.squeeze <= 0 then return false end
  if fingers.fingers < 3 or not AROUND[fingers.shape] then return false end
  local at, q = self.tool:pose()
  local place = wire:position(stand.nearest_place(wire, at))
  local off = vec.rotate(vec.conjugate(q), vec.sub(place, at))
  local half = 0.5 * state.opening
  return math.max(half, 2 * (half - wire.radius)) < (off[2] ^ 2 + off[3] ^ 2) ^ 0.5
end

-- Stops the jaws and raises an error with the reason why they failed.
local function give_up(self, order, wire, state, crushed, longest)
  self.tool:jaws{ mode = "still" }
  local force = order.mode == "force" and ("%g N"):format(order.force) or "the force"
  if crushed and is_beside(self, wire) then
    note(self, "missed", {})
    error(("gripper '%s' closed beside the wire: its pads touch it with their rims at %.4g N per finger; "
      .. "%s is not reached%s"):format(self.name, state.squeeze, force, whereabouts(self, wire)), 0)
  end
  if crushed then
    note(self, "crushed", { opening = state.opening, squeeze = state.squeeze })
    error(("gripper '%s' crushes the wire: %.3g mm of its %.3g mm are left between the pads, at %.4g N per "
      .. "finger; %s is not reached"):format(self.name, 1e3 * state.opening,
      2e3 * wire.radius, state.squeeze, force), 0)
  end
  if state.jaws == "empty" then
    note(self, "missed", {})
    error(("gripper '%s' closed on nothing%s"):format(self.name, wire and whereabouts(self, wire) or ""), 0)
  end
  note(self, "unreached", { opening = state.opening, squeeze = state.squeeze })
  error(("gripper '%s': %s is not reached in %.3g s; the force is %.4g N at an opening of %.4g mm"):format(
    self.name, force, longest, state.squeeze, 1e3 * state.opening), 0)
end

-- Logs an event if the pads press on a rod harder than its strength. Pads that go to an opening press on a
-- rod as on a solid section of its mean modulus: squeezing a cable by a hundredth of its diameter takes
-- kilonewtons there, while the insulation of a real cable would yield.
local function tell_overload(self, wire, state)
  local rod = wire and (wire.model == "rod" or wire.model == "string")
  local limit = rod and tension.limit{ object = wire }
  if not limit or state.squeeze <= limit.value then return end
  self.scene:tell{ kind = "overload", object = self.name, value = state.squeeze,
    text = ("gripper '%s' presses on wire '%s' with %.3g N per finger, more than the %.3g N that break it: "
      .. "pads press on a rod as on a solid section of its mean modulus; give force [N] too, or use a mesh")
      :format(self.name, wire.name, state.squeeze, limit.value) }
end

-- Waits until the jaws are done; raises an error if they fail.
local function wait_for_jaws(self, p, order)
  local state, crushed
  local wire = self.wire -- another process may let go of it meanwhile
  local least = wire and CRUSHED * 2 * wire.radius or 0
  local function done()
    if not self.tool then -- a snapshot was restored
      error(("gripper '%s': its pads were taken away while it waited for them"):format(self.name), 0)
    end
    stand.check_there(self, 0)
    state = self.tool:state()
    crushed = order.force and state.squeeze > 0 and state.opening < least
    return crushed or state.jaws ~= "moves"
  end
  local longest = self.tool:state().opening / order.speed + PATIENCE
  local arrived = p:wait_until(done, { timeout = longest })
  if arrived and not crushed and is_outside(self, wire, state) then
    self.tool:jaws{ mode = "still" }
    note(self, "missed", {})
    error(("gripper '%s' closed beside the wire: it is not between the %d fingers, which are %.4g mm "
      .. "open%s"):format(self.name, self.pads.fingers, 1e3 * state.opening, whereabouts(self, wire)), 0)
  end
  if arrived and not crushed and state.jaws ~= "empty" then
    if state.squeeze > 0 and state.opening < least then -- the order asked for this opening
      note(self, "crushed", { opening = state.opening, squeeze = state.squeeze })
    end
    tell_overload(self, wire, state)
    return state
  end
  give_up(self, order, wire, state, crushed, longest)
end

--- Gives an order to the jaws. In a process it waits until they are done and returns their state.
function jaws.move(self, order)
  local p = build.call(3, process.of, self.scene, "an order to the jaws")
  if self.order and self.tool:state().jaws == "moves" then
    replaced.tell(self.scene, self.name, ("gripper '%s'"):format(self.name), "order to its jaws", true)
  end
  self.order = order
  self.tool:jaws(order)
  self.unlooked = not p and order.force and not self.wire or nil
  return p and wait_for_jaws(self, p, order)
end

--- Closes the jaws, see help "gripper:close_jaws". Errors name what is in the way.
function Methods:close_jaws(args)
  stand.check_scene(self, 3)
  local order = jaws.order(self, close:read(args), "gripper:close_jaws")
  if self.frozen then mixed.thaw(self) end
  if self.hold and not self.tool then
    error(("gripper '%s' holds its wire by imposed handling: there are no jaws to close"):format(
      self.name), 2)
  end
  if not self.tool then stand.make_tool(self, 3, self.wire) end
  jaws.move(self, order)
  return self
end

--- Opens the jaws, see help "gripper:open_jaws".
function Methods:open_jaws(args)
  stand.check_scene(self, 3)
  args = open:read(args or {})
  if not self.tool and not self.hold and self.at then stand.make_tool(self, 3) end
  if not self.tool then
    error(("gripper '%s' has no pads yet: grasp with approach = 'plates' or 'mixed'"):format(self.name),
      2)
  end
  if self.frozen then mixed.open(self) end
  self.held = false
  jaws.move(self, jaws.order(self, { distance = args.distance or self.opening, speed = args.speed },
    "gripper:open_jaws"))
  return self
end

return jaws
