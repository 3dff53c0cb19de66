-- SPDX-License-Identifier: GPL-3.0-or-later
--- How grippers take hold of a wire and let go: imposed, by plates, or mixed.
-- @module softworld.grip.grasp
local core = require "softworld.core"
local approach_words = require "softworld.grip.approach"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local grasped = require "softworld.grip.grasped"
local mixed = require "softworld.grip.mixed"
local pads = require "softworld.grip.pads"
local process = require "softworld.run.process"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local vec = require "softworld.vec"

local grasp = { methods = {} }
local Methods = grasp.methods

local JAW_SPEED = 0.02 -- of the opening, unless told [m/s]
local PATIENCE = 2 -- a force is waited for so long after jaws could have closed [s]
local CRUSHED = 0.2 -- opening over the wire's diameter at which it is [-]

--- Raise when the gripper was taken back with a snapshot.
function grasp.check_there(self, level)
  if self.gone then
    error(("gripper '%s' was made after the snapshot that was restored; make it anew")
      :format(self.name), level)
  end
  if self.left then
    error(("gripper '%s' was taken away at t = %.6g s"):format(self.name, self.left), level)
  end
end

--- The same, and when the scene may not be changed now.
function grasp.check_scene(self, level)
  grasp.check_there(self, level + 1)
  build.check(self.scene, "gripper '" .. self.name .. "'", level + 1)
end

-- The arc length of the wire nearest to a point, and how far it is.
local function nearest_place(wire, at)
  local x, s = wire:positions()
  local best, place = math.huge, 0
  for i = 1, #s - 1 do
    local a, b, t, e = 3 * i - 2, 3 * i + 1, 0, 0
    for k = 0, 2 do
      local d = x[b + k] - x[a + k]
      t, e = t + d * (at[k + 1] - x[a + k]), e + d * d
    end
    t = e > 0 and math.max(0, math.min(1, t / e)) or 0
    local d2 = 0
    for k = 0, 2 do d2 = d2 + (at[k + 1] - x[a + k] - t * (x[b + k] - x[a + k])) ^ 2 end
    if d2 < best then best, place = d2, s[i] + t * (s[i + 1] - s[i]) end
  end
  return place, best ^ 0.5
end

grasp.nearest_place = nearest_place

-- The orientation of a tool at arc length s: x along the wire, z as far up as may be.
local function facing(scene, wire, s)
  local up = vec.unit(vec.scale(scene:gravity(), -1)) or { 0, 0, 1 }
  return vec.facing(vec.unit(wire:tangent(s)), up)
end

--- Give the gripper its pads, where it is (at, rotation) or around the wire at s.
function grasp.make_tool(self, level, wire, s)
  local at = s and wire:position(s) or self.at or { 0, 0, 0 }
  local rotation = self.rotation or (s and facing(self.scene, wire, s)) or nil
  build.call(level, function()
    self.tool, self.obstacles, self.opening = remarks.without(pads.make, self.scene, self, at, rotation,
      wire and wire.radius)
  end)
end

--- Give it a place of its own that moves: while it holds nothing, and for several wires.
function grasp.make_carrier(self)
  local at, q = self.at or { 0, 0, 0 }, self.rotation or self.facing or nil
  if self.hold then at, q = self.hold:pose() end
  self.carrier = self.scene:tool{ name = self.name, at = at, rotation = q }
  return self.carrier
end

-- Pads open at the wire's arc length s.
local function place_tool(self, wire, s, level)
  if not self.tool and self.carrier then self.at = (self.carrier:pose()) end
  if not self.tool then return grasp.make_tool(self, level + 1, wire, s) end
  if s then self.tool:pose(wire:position(s), self.rotation or facing(self.scene, wire, s)) end
end

-- --- slip ---------------------------------------------------------------------------

grasp.reactions = { "record", "warn", "stop" }
grasp.on_slip_row = { "on_slip", "reaction", "-",
  "to a wire that slips or is lost: one of these, or a function(gripper, event)", choices = grasp.reactions,
  usual = "as before" }

function grasp.check_reaction(what, value, level)
  local known = checks.set(table.concat(grasp.reactions, " "))
  if type(value) ~= "function" then checks.word(what, value, known, level + 1) end
end

--- Reaction to a wire that slips, and to one that is lost: "record" (default), "warn", "stop" or a
-- function, called with the gripper and the event.
function grasp.set_on_slip(self, value, level)
  grasp.check_reaction("gripper '" .. self.name .. "': on_slip", value, level + 1)
  self.on_slip = value
  grasp.watch(self)
end

--- Slip counts from now on.
function grasp.watch(self)
  self.slip_event = nil
  if self.tool then
    self.tool:watch(self.slip_tolerance, self.on_slip ~= nil and self.on_slip ~= "record")
  end
end

local function slip_text(self, event)
  return ("gripper '%s': the wire slips, %.3g mm by t = %.4g s at s = %.4g m"):format(self.name,
    1e3 * event.distance, event.time, event.s)
end

local function crash_text(self, event)
  return ("gripper '%s': '%s' runs into '%s' at t = %.4g s"):format(self.name, event.part,
    event.obstacle, event.time)
end

local function lost_text(self, event)
  return ("gripper '%s': nothing is left between the pads at t = %.4g s"):format(self.name, event.time)
end

-- Keep the event and act on it; returns the text when the run is to stop.
local function react(self, event, reaction, text)
  self.events[#self.events + 1] = event
  if reaction == "warn" then io.stderr:write("softworld: ", text(self, event), "\n")
  elseif reaction == "stop" then return text(self, event)
  elseif type(reaction) == "function" then reaction(self, event) end
end

-- A crash of an imposed grip, which drives the wire itself into an obstacle.
local function look_at_hold(self)
  local crash = self.hold:crash()
  if not crash or crash.time == self.crash_time then return end
  self.crash_time = crash.time
  return react(self, { kind = "crash", time = crash.time, part = self.name, obstacle = crash.obstacle,
    depth = crash.depth, s = self.s }, self.on_crash, crash_text)
end

-- Events of one gripper with pads; returns why the run is to stop, or nil.
local function look_at(self)
  local now, why = self.tool:state(), nil
  if now.crash_time and now.crash_time ~= self.crash_time then
    self.crash_time = now.crash_time
    why = react(self, { kind = "crash", time = now.crash_time, part = now.crash_part,
      obstacle = now.crash_obstacle, depth = now.crash_depth }, self.on_crash, crash_text)
  end
  if self.held and now.slip_time and not self.slip_event then
    self.slip_event = { kind = "slip", time = now.slip_time, s = now.slip_place, distance = now.slip }
    why = react(self, self.slip_event, self.on_slip, slip_text) or why
  end
  if self.unchecked and self.held and now.squeeze > 0 and now.jaws ~= "moves" then
    self.unchecked = nil
    grasped.check(self) -- outside of a process: it is told, and the run goes on
  end
  if self.held and now.normal == 0 and not now.frozen then
    self.held = false
    local event = { kind = "lost", time = self.scene.time, s = now.place }
    why = react(self, event, self.on_slip, lost_text) or why
  end
  if self.frozen and now.lost_time then mixed.lose(self, now) end
  return why
end

--- After steps of a run: events of the scene's grippers. Returns why the run is to stop, or nil.
function grasp.look(scene)
  local why
  for _, self in ipairs(build.data(scene).grippers) do
    if self.tool and not self.left then why = look_at(self) or why
    elseif self.hold then why = look_at_hold(self) or why end
  end
  return why
end

-- --- jaws ---------------------------------------------------------------------------

local function note(self, kind, fields)
  fields.kind, fields.time = kind, self.scene.time
  self.events[#self.events + 1] = fields
end

local force_row = { "force", "number", "N", "of each finger on the wire, kept from then on", min = 0,
  above = true }
local distance_row = { "distance", "number", "m", "opening to go to, unless force stops them before",
  min = 0 }
local speed_row = { "speed", "number", "m/s", "of the opening; alone: until there is contact", min = 0,
  above = true, usual = JAW_SPEED }

local close = rows.call("gripper:close_jaws", "{...}", "closes the jaws", {
  gives = "the gripper; in a process once that is done", force_row, distance_row, speed_row })
local open = rows.call("gripper:open_jaws", "{...}", "opens the jaws", {
  gives = "the gripper; in a process once that is done",
  { "distance", "number", "m", "between the faces", min = 0, usual = "pads' opening" },
  { "speed", "number", "m/s", "of the opening", min = 0, above = true, usual = JAW_SPEED },
})

-- The core's order for close_jaws' words, which are checked.
local function jaw_order(self, args, what)
  local distance, force, speed = args.distance, args.force, args.speed or JAW_SPEED
  if not (distance or force or args.speed) then
    error(("%s: how far? give force [N], distance [m] or speed [m/s]"):format(what), 0)
  end
  if distance then return { mode = "to", opening = distance, speed = speed, force = force } end
  if force then return { mode = "force", speed = speed, force = force } end
  -- by speed: until there is contact, which is a force that counts against the wire's weight
  local contact = 0.01
  if self.wire then
    contact = math.max(1e-3, 0.01 * self.wire.beam.mass_per_length * 9.81 * self.wire.length)
  end
  return { mode = "to", opening = 0, speed = speed, force = contact }
end

-- Wait until the jaws are done; raises when they cannot do it.
local function wait_for_jaws(self, p, order)
  local state, crushed
  local wire = self.wire -- another process may let go of it meanwhile
  local least = wire and CRUSHED * 2 * wire.radius or 0
  local function done()
    if not self.tool then -- a snapshot was restored
      error(("gripper '%s': its pads went while it was waiting for them"):format(self.name), 0)
    end
    grasp.check_there(self, 0)
    state = self.tool:state()
    crushed = order.force and state.squeeze > 0 and state.opening < least
    return crushed or state.jaws ~= "moves"
  end
  local longest = self.tool:state().opening / order.speed + PATIENCE
  local arrived = p:wait_until(done, { timeout = longest })
  if arrived and not crushed and state.jaws ~= "empty" then
    if state.squeeze > 0 and state.opening < least then -- as they were told to
      note(self, "crushed", { opening = state.opening, squeeze = state.squeeze })
    end
    return state
  end
  self.tool:jaws{ mode = "still" }
  local force = order.mode == "force" and ("%g N"):format(order.force) or "the force"
  if crushed then
    note(self, "crushed", { opening = state.opening, squeeze = state.squeeze })
    error(("gripper '%s' crushes the wire: %.3g mm are left of its %.3g mm between the pads, at %.4g N "
      .. "per finger; %s is not reached"):format(self.name, 1e3 * state.opening,
      2e3 * wire.radius, state.squeeze, force), 0)
  end
  if state.jaws == "empty" then
    note(self, "missed", {})
    local far = ""
    if wire then
      local _, d = nearest_place(wire, (self.tool:pose()))
      far = (": wire '%s' is %.3g mm from the tool centre"):format(wire.name, 1e3 * d)
    end
    error(("gripper '%s' closed on nothing%s"):format(self.name, far), 0)
  end
  note(self, "unreached", { opening = state.opening, squeeze = state.squeeze })
  error(("gripper '%s': %s is not reached in %.3g s; it is %.4g N at an opening of %.4g mm"):format(
    self.name, force, longest, state.squeeze, 1e3 * state.opening), 0)
end

local function move_jaws(self, order)
  self.order = order
  self.tool:jaws(order)
  local p = process.current()
  return p and wait_for_jaws(self, p, order)
end

--- Close the jaws, see help "gripper:close_jaws". Errors tell what is in the way.
function Methods:close_jaws(args)
  grasp.check_scene(self, 3)
  local order = jaw_order(self, close:read(args), "gripper:close_jaws")
  if self.frozen then mixed.thaw(self) end
  if self.hold and not self.tool then
    error(("gripper '%s' holds its wire by imposed handling: there are no jaws to close"):format(
      self.name), 2)
  end
  if not self.tool then grasp.make_tool(self, 3, self.wire) end
  move_jaws(self, order)
  return self
end

--- Open the jaws, see help "gripper:open_jaws".
function Methods:open_jaws(args)
  grasp.check_scene(self, 3)
  args = open:read(args or {})
  if not self.tool and not self.hold and self.at then grasp.make_tool(self, 3) end
  if not self.tool then
    error(("gripper '%s' has no pads yet: grasp with approach = 'plates' or 'mixed'"):format(self.name),
      2)
  end
  if self.frozen then mixed.thaw(self) end
  self.held = false
  move_jaws(self, jaw_order(self, { distance = args.distance or self.opening, speed = args.speed },
    "gripper:open_jaws"))
  return self
end

-- --- grasp --------------------------------------------------------------------------

-- Raise while it moves: wires and things that it holds besides could not go with it.
local function check_rest(self, what)
  if (self.busy_until or -math.huge) > self.scene.time * (1 + 1e-12) + 1e-12 then
    error(("gripper '%s' moves until t = %g s; %s after that"):format(self.name, self.busy_until, what), 0)
  end
end

-- One with the wire at s (nil: at the place nearest to the tool).
local function impose(self, wire, s)
  if s == nil then
    local at = (#self.grips > 0 or self.carrier or self.at) and self:position()
    if not at then
      error(("gripper '%s': give s [m], or the gripper's place at = {x, y, z} [m]"):format(self.name), 0)
    end
    s = nearest_place(wire, at)
  end
  local count = #self.past
  local hold = self.scene:grip(wire, { s = s, width = self.width, -- first, for it may be refused
    name = self.name .. (count > 0 and "#" .. count + 1 or "") })
  if #self.grips > 0 and not self.carrier then
    grasp.make_carrier(self)
    self.carrier:hold(self.hold)
    self.spans[count].carried = self.scene.time
  end
  local span = { from = self.scene.time }
  if self.carrier then
    if #self.grips == 0 then self.carrier:pose(hold:pose()) end
    self.carrier:hold(hold)
    span.carried = self.scene.time
  end
  self.past[count + 1], self.spans[count + 1] = hold, span
  local grips = table.move(self.grips, 1, #self.grips, 1, {})
  grips[#grips + 1] = { wire = wire, hold = hold }
  if not self.hold then self.s = s end
  self.grips, self.hold, self.wire = grips, self.hold or hold, self.wire or wire
end

-- Let go of one; the others stay.
local function drop(self, wire)
  local left = {}
  for _, grip in ipairs(self.grips) do
    if grip.wire == wire then
      self.at, self.facing = grip.hold:pose()
      grip.hold:release()
      for i, hold in ipairs(self.past) do
        if hold == grip.hold then self.spans[i].to = self.scene.time end
      end
    else
      left[#left + 1] = grip
    end
  end
  self.grips = left
  self.hold, self.wire = left[1] and left[1].hold, left[1] and left[1].wire
end

grasp.drop = drop

-- All of the wires or none more than before.
local function grasp_imposed(self, wires, args)
  if self.tool then
    error(("gripper '%s' has pads; it grasps by 'plates' or 'mixed'"):format(self.name), 3)
  end
  if #self.grips > 0 then build.call(4, check_rest, self, "grasp another wire") end
  for i, wire in ipairs(wires) do
    local s = args.s
    if type(s) == "table" then s = s[i] end
    local fine, why = pcall(impose, self, wire, s)
    if not fine then
      for k = 1, i - 1 do drop(self, wires[k]) end
      if type(why) ~= "string" then error(why, 0) end
      error(build.plain(why), 3)
    end
  end
end

-- The thickest, which must go between the pads, comes first.
local function by_thickness(wires)
  local list = table.move(wires, 1, #wires, 1, {})
  table.sort(list, function(a, b) return a.radius > b.radius end)
  return list
end

local function grasp_by_pads(self, wires, args)
  local wire, s = by_thickness(wires)[1], args.s
  if type(s) == "table" then
    for i, one in ipairs(wires) do if one == wire then s = args.s[i] end end
  end
  if s then
    checks.number(("gripper '%s': s"):format(self.name), s, 0, " m", 4, wire.length)
  elseif not self.tool and not self.at then
    error(("gripper '%s': give s [m], or the gripper's place at = {x, y, z} [m]"):format(self.name), 3)
  end
  local opening = self.tool and self.tool:state().opening or self.pads.opening
  if opening and self.pads.shape == "flat" and opening < 2 * wire.radius then
    error(("gripper '%s': its jaws are %.3g mm open, less than the wire's diameter of %.3g mm; open "
      .. "them (pads.opening)"):format(self.name, 1e3 * opening, 2e3 * wire.radius), 3)
  end
  local order = jaw_order(self, args, "gripper:grasp")
  local nearest = s or nearest_place(wire, self.tool and self.tool:pose() or self:position())
  local is_mesh = wire.model ~= "rod" and wire.model ~= "string" -- its section is not quite round
  if is_mesh then wire:width(nearest, { 0, 1, 0 }) end -- refused where it is a line: before pads are made
  place_tool(self, wire, s, 4)
  self.wire, self.grips, self.s = wire, {}, nearest
  for i, one in ipairs(wires) do self.grips[i] = { wire = one } end
  self.free_height = nil
  if self.way == "mixed" then
    mixed.prepare(self, args)
    grasp.watch(self)
  end
  if is_mesh then
    local _, q = self.tool:pose()
    self.free_height = wire:width(self.s, vec.rotate(q, { 0, 1, 0 }))
  end
  if not move_jaws(self, order) then return end
  if self.wire ~= wire then
    build.present(wire)
    error(("gripper '%s': something let go of wire '%s' while its jaws moved to grasp it"):format(self.name,
      wire.name), 0)
  end
  local text, missed = grasped.check(self)
  if missed then error(text, 0) end
end

local take = rows.call("gripper:grasp", "wire, {...}", "takes hold of a wire, or of a list of wires", {
  gives = "the gripper; in a process once the wire is held",
  example = 'hand:grasp(wire, { s = 0.1, approach = "plates", force = 5 })',
  { "s", "arc length", "m", "place along the wire, of several wires also a list",
    usual = "nearest to the tool" },
  { "approach", "choice", "-", "one with the wire, by the pads' friction, or squeezed first and then carried",
    choices = { "imposed", "plates", "mixed", "auto" }, usual = "imposed" },
  force_row, distance_row, speed_row,
  grasp.on_slip_row,
  { "freeze", "boolean", "-", "of mixed: false stays with the pads until gripper:freeze()", usual = "true" },
  { "margin", "number", "-", "of mixed: share of what the pads bear at which they take over again", min = 0,
    max = 1, above = true, usual = "0.9" },
  { "region", "number", "m", "of mixed: length of the wire that becomes a mesh", min = 0, above = true,
    usual = "pads and 6 radii on both sides" },
  { "model", "text", "-", "of mixed: of the mesh", usual = "radial" },
  { "section", "mesh", "-", "of mixed, as of wire:remodel" },
  { "spacing", "mesh", "m", "of mixed, as of wire:remodel" },
  { "particles", "mesh", "-", "of mixed, as of wire:remodel" },
  { "layers", "mesh", "-", "of mixed, as of wire:remodel" },
  { "across", "mesh", "-", "of mixed, as of wire:remodel" },
})
-- The wire or list of wires as a list.
local function wires_of(self, given)
  local list = type(given) == "table" and given or { given }
  if #list == 0 then
    error("gripper:grasp expects a wire, or a list of wires, got "
      .. (given == nil and "nil" or "an empty table"), 0)
  end
  local seen = {}
  for _, wire in ipairs(list) do
    if core.type(wire) ~= "wire" then
      error("gripper:grasp expects a wire, got " .. (core.type(wire) or type(wire)), 0)
    end
    build.own(self.scene, ("gripper '%s': wire '%s' belongs to"):format(self.name, wire.name), wire)
    for _, one in ipairs(seen) do
      if one == wire then
        error(("gripper '%s': wire '%s' is in the list twice"):format(self.name, wire.name), 0)
      end
    end
    seen[#seen + 1] = wire
  end
  return seen
end

-- May the gripper hold these wires besides those that it holds?
local function check_free(self, wires, approach, args)
  if type(args.s) == "table" and #args.s ~= #wires then
    error(("gripper '%s': s has %d places for %d wires"):format(self.name, #args.s, #wires), 0)
  end
  if approach == "mixed" and #wires > 1 then
    error(("gripper '%s': a mixed grasp is of one wire; take several by 'plates' or 'imposed'")
      :format(self.name), 0)
  end
  for _, grip in ipairs(self.grips) do
    for _, wire in ipairs(wires) do
      if grip.wire == wire then
        error(("gripper '%s' already holds wire '%s'"):format(self.name, wire.name), 0)
      end
    end
  end
  if self.wire and (approach ~= "imposed" or self.way ~= "imposed") then
    error(("gripper '%s' already holds a wire: pads take several at once only, grasp({ a, b }, ...)")
      :format(self.name), 0)
  end
end

--- Take hold of a wire, see help "gripper:grasp". A list of wires, with one s or a list of them, is taken at
-- once; an imposed grip also takes one wire after another. In a process it returns when the wire is held;
-- elsewhere jaws begin to close.
function Methods:grasp(wire, args)
  if args == nil then args = {} end
  if type(self) ~= "table" or not self.pads then error("gripper:grasp: call it with a colon", 2) end
  grasp.check_scene(self, 3)
  local wires = build.call(3, wires_of, self, wire)
  args = take:read(args)
  local approach = build.call(3, approach_words.of, self, wires, args)
  build.call(3, check_free, self, wires, approach, args)
  remarks.on("grasp", ("gripper '%s': grasp"):format(self.name), args)
  approach_words.check(self, approach, args)
  if approach == "mixed" and not process.current() then
    error(("gripper '%s': a mixed grasp takes its time; call it in a process"):format(self.name), 2)
  end
  if args.on_slip ~= nil then grasp.set_on_slip(self, args.on_slip, 3) end
  self.bereft = nil
  if approach == "imposed" then
    grasp_imposed(self, wires, args)
    self.way, self.frozen, self.held = approach, nil, false
    return self
  end
  self.way, self.frozen, self.held = approach, nil, false
  local fine, why = pcall(grasp_by_pads, self, wires, args)
  if not fine then
    self.wire, self.grips = nil, {}
    if type(why) ~= "string" then error(why, 0) end
    error(build.plain(why), 2)
  end
  self.held = true
  self.unchecked = not process.current() or nil
  grasp.watch(self)
  if approach == "mixed" and args.freeze ~= false then mixed.settle(self, args) end
  return self
end

local let_go = rows.call("gripper:release", "{...}", "lets go", {
  gives = "the gripper; in a process once the jaws are open",
  { "wire", "wire", "-", "of several that are held without pads", usual = "all" },
  { "distance", "number", "m", "between the faces", min = 0, usual = "pads' opening" },
  { "speed", "number", "m/s", "of the opening", min = 0, above = true, usual = JAW_SPEED },
})

--- Let go; see gripper:release.
function grasp.release(self, args)
  args = let_go:read(args or {})
  local one = args.wire
  if one ~= nil then
    local held = false
    for _, grip in ipairs(self.grips) do held = held or grip.wire == one end
    if not held then
      error(("gripper '%s' does not hold %s"):format(self.name,
        core.type(one) == "wire" and ("wire '%s'"):format(one.name) or "this: wire must be a wire"), 3)
    end
    if self.tool and #self.grips > 1 then
      error(("gripper '%s': pads that open let go of all wires; release() without wire"):format(self.name),
        3)
    end
  end
  if not self.tool then
    local grips = self.grips
    for _, grip in ipairs(grips) do
      if one == nil or grip.wire == one then build.call(4, drop, self, grip.wire) end
    end
    return self
  end
  if self.frozen then mixed.thaw(self) end
  self.held = false
  self:open_jaws{ speed = args.speed, distance = args.distance }
  if not self.wire then return self end -- another process let go meanwhile
  if self.way == "mixed" then mixed.finish(self) end
  self.wire, self.grips = nil, {}
  return self
end

rows.calls{
  { "gripper:freeze", "", "holds the wire rigidly as the pads of a mixed grasp hold it now", "the gripper" },
  { "gripper:thaw", "", "goes back to the pads and the mesh between them", "the gripper" },
}

Methods.freeze = mixed.freeze
Methods.thaw = mixed.thaw

return grasp
