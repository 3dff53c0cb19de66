-- SPDX-License-Identifier: GPL-3.0-or-later
--- How grippers take hold of a wire and let go: imposed, by plates, or mixed.
-- @module softworld.grip.grasp
local core = require "softworld.core"
local approach_words = require "softworld.grip.approach"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local grasped = require "softworld.grip.grasped"
local jaws = require "softworld.grip.jaws"
local mixed = require "softworld.grip.mixed"
local counted = require "softworld.output.number".count
local process = require "softworld.run.process"
local reactions = require "softworld.grip.reactions"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local stand = require "softworld.grip.stand"
local untwisted = require "softworld.grip.untwisted"
local vec = require "softworld.vec"

local grasp = { methods = jaws.methods }
local Methods = grasp.methods

-- Raises an error while the gripper moves: another wire could not join the move.
local function check_rest(self, what)
  if stand.is_moving(self) then
    error(("gripper '%s' is moving until t = %g s; %s after that"):format(self.name, self.busy_until, what),
      0)
  end
end

-- Holds the wire rigidly at s (nil: at the place nearest to the tool).
local function impose(self, wire, s)
  if s == nil then
    local at = (#self.grips > 0 or self.carrier or self.at) and self:position()
    if not at then
      error(("gripper '%s': give s [m], or the gripper's place at = {x, y, z} [m]"):format(self.name), 0)
    end
    s = stand.nearest_place(wire, at)
  end
  if type(s) == "number" then checks.number(("gripper '%s': s"):format(self.name), s, 0, " m", 0) end
  local count, flies = #self.past, stand.is_moving(self)
  local from = not flies and self:position() or nil
  local hold = self.scene:grip(wire, { s = s, width = self.width, -- first, for it may be refused
    name = count > 0 and checks.part_name(self.name, "#" .. count + 1) or self.name })
  if #self.grips > 0 and not self.carrier then
    stand.make_carrier(self)
    self.carrier:hold(self.hold)
    self.spans[count].carried = self.scene.time
  end
  local span = { from = self.scene.time }
  if self.carrier then
    -- a gripper that flies keeps its way, and the wire its place beside it
    if #self.grips == 0 and not flies then self.carrier:pose(hold:pose()) end
    if flies then stand.tell_distance(self, wire, s, wire.radius) end
    self.carrier:hold(hold)
    span.carried = self.scene.time
  end
  if s then stand.tell_far(self, wire, s, from, #self.grips == 0 and stand.JUMPS or stand.STAYS) end
  self.past[count + 1], self.spans[count + 1] = hold, span
  local grips = table.move(self.grips, 1, #self.grips, 1, {})
  grips[#grips + 1] = { wire = wire, hold = hold }
  if not self.hold then self.s = s end
  self.grips, self.hold, self.wire = grips, self.hold or hold, self.wire or wire
end

-- Lets go of one wire; the others stay.
local function drop(self, wire)
  local left = {}
  for _, grip in ipairs(self.grips) do
    if grip.wire == wire then
      -- its move goes on without the wire, unless the wire was removed and the hold with it
      if stand.is_moving(self) and not self.carrier and grip.hold.held then
        stand.make_carrier(self)
        self.carrier:take(grip.hold)
        self.spans[#self.past].carried = self.scene.time
      end
      self.at, self.facing = grip.hold:pose()
      grip.hold:release()
      local i = #self.past -- from the last one: there may be thousands of earlier grasps
      while i > 0 and self.past[i] ~= grip.hold do i = i - 1 end
      if i > 0 then self.spans[i].to = self.scene.time end
    else
      left[#left + 1] = grip
    end
  end
  self.grips = left
  self.hold, self.wire = left[1] and left[1].hold, left[1] and left[1].wire
end

grasp.drop = drop

-- Takes all of the wires, or raises an error and takes none.
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

-- Returns the wires with the thickest first; it must fit between the pads.
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
    s = checks.place(("gripper '%s': s"):format(self.name), s, wire.length, 4)
  elseif not self.tool and not self.at then
    error(("gripper '%s': give s [m], or the gripper's place at = {x, y, z} [m]"):format(self.name), 3)
  end
  local opening = self.tool and self.tool:state().opening or self.pads.opening
  if opening and self.pads.shape == "flat" and opening < 2 * wire.radius then
    error(("gripper '%s': its jaws are %.3g mm open, less than the wire's diameter of %.3g mm; open "
      .. "them (pads.opening)"):format(self.name, 1e3 * opening, 2e3 * wire.radius), 3)
  end
  local order = jaws.order(self, args, "gripper:grasp")
  local nearest = s or stand.nearest_place(wire, self.tool and self.tool:pose() or self:position())
  local is_mesh = wire.model ~= "rod" and wire.model ~= "string" -- its section is not quite round
  if is_mesh then wire:width(nearest, { 0, 1, 0 }) end -- raises if it is a line there: before pads are made
  stand.place_tool(self, wire, s, wires, 4)
  self.wire, self.grips, self.s = wire, {}, nearest
  for i, one in ipairs(wires) do self.grips[i] = { wire = one } end
  self.free_height = nil
  if self.way == "mixed" then
    mixed.prepare(self, args)
    reactions.watch(self)
  end
  if is_mesh then
    local _, q = self.tool:pose()
    self.free_height = wire:width(self.s, vec.rotate(q, { 0, 1, 0 }))
  end
  if not jaws.move(self, order) then return end
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
  { "approach", "choice", "-", "imposed: one with the wire; plates: by the pads' friction; mixed: squeezed, "
    .. "then carried rigidly",
    choices = { "imposed", "plates", "mixed", "auto" }, usual = "imposed" },
  jaws.force_row, jaws.distance_row, jaws.speed_row,
  reactions.on_slip_row,
  { "freeze", "boolean", "-", "of mixed: false keeps the pads until gripper:freeze()", usual = "true" },
  { "margin", "number", "-", "of mixed: margin above which the pads take over again",
    min = 0,
    max = 1, above = true, usual = "0.9" },
  { "region", "number", "m", "of mixed: length of the wire that becomes a mesh", min = 0, above = true,
    usual = "pads and 6 radii on both sides" },
  { "model", "choice", "-", "of mixed: model of the mesh", -- an unknown one is refused before pads are made
    choices = { "tube", "radial", "cubic", "composite" }, usual = "radial" },
  { "section", "mesh", "-", "of mixed: parameter of the mesh, see wire:remodel" },
  { "spacing", "mesh", "m", "of mixed: parameter of the mesh, see wire:remodel" },
  { "particles", "mesh", "-", "of mixed: parameter of the mesh, see wire:remodel" },
  { "layers", "mesh", "-", "of mixed: parameter of the mesh, see wire:remodel" },
  { "across", "mesh", "-", "of mixed: parameter of the mesh, see wire:remodel" },
})
-- Returns the wire or list of wires as a list.
local function wires_of(self, given)
  local list = checks.kind(given) == "table" and given or { given }
  if list == given then checks.only("gripper:grasp: the first argument", list, nil, 0) end
  if #list == 0 then
    error("gripper:grasp: the first argument must be a wire (from scene:wire) or a list of wires, got "
      .. (given == nil and "nil" or "an empty table"), 0)
  end
  local seen = {}
  for _, wire in ipairs(list) do
    if core.type(wire) ~= "wire" then
      error("gripper:grasp: the first argument must be a wire (from scene:wire) or a list of wires, got "
        .. checks.got(wire), 0)
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

-- Raises an error if the gripper cannot hold these wires in addition to those it holds.
local function check_free(self, wires, approach, args)
  if type(args.s) == "table" then checks.only(("gripper '%s': s"):format(self.name), args.s, nil, 0) end
  if type(args.s) == "table" and #args.s ~= #wires then
    error(("gripper '%s': s has %s for %s"):format(self.name, counted(#args.s, "place"),
      counted(#wires, "wire")), 0)
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

--- Takes hold of a wire, see help "gripper:grasp". A list of wires, with one s or a list of them, is taken at
-- once; an imposed grip can also take one wire after another. In a process the call returns when the wire is
-- held; elsewhere the jaws start to close.
function Methods:grasp(wire, args)
  if args == nil then args = {} end
  if type(self) ~= "table" or not self.pads then error("gripper:grasp: call it with a colon", 2) end
  stand.check_scene(self, 3)
  local wires = build.call(3, wires_of, self, wire)
  args = take:read(args)
  local approach = build.call(3, approach_words.of, self, wires, args)
  build.call(3, check_free, self, wires, approach, args)
  remarks.on("grasp", ("gripper '%s': grasp"):format(self.name), args)
  approach_words.check(self, approach, args)
  local mixes = approach == "mixed"
  local p = approach ~= "imposed" and build.call(3, mixes and process.within or process.of, self.scene,
    "gripper:grasp", ("gripper '%s': a mixed grasp takes time; call it in a process"):format(self.name))
  if args.on_slip ~= nil then reactions.set_on_slip(self, args.on_slip, 3) end
  self.bereft, self.astray = nil, nil
  if approach == "imposed" then
    grasp_imposed(self, wires, args)
    self.way, self.frozen, self.held = approach, nil, false
    return self
  end
  self.way, self.frozen, self.held, self.closing = approach, nil, false, p and true or nil
  local fine, why = pcall(grasp_by_pads, self, wires, args)
  self.closing = nil
  if not fine then
    self.wire, self.grips = nil, {}
    if type(why) ~= "string" then error(why, 0) end
    error(build.plain(why), 2)
  end
  self.held = true
  self.unchecked = not p or nil
  reactions.watch(self)
  untwisted.look(self)
  if approach == "mixed" and args.freeze ~= false then mixed.settle(self, args) end
  return self
end

local let_go = rows.call("gripper:release", "{...}", "lets go", {
  gives = "the gripper; in a process once the jaws are open",
  { "wire", "wire", "-", "the one to let go, of several held without pads", usual = "all" },
  { "distance", "number", "m", "between the faces", min = 0, max = jaws.MOST, usual = "pads' opening" },
  { "speed", "number", "m/s", "of the opening", min = 0, max = jaws.MOST, above = true, usual = jaws.SPEED },
})

-- True if pads of another gripper press on the wire as on a rod, without a mesh of theirs.
local function is_pressed(self)
  for _, other in ipairs(build.data(self.scene).grippers) do
    if other ~= self and other.tool and other.held and other.way == "plates" then
      for _, grip in ipairs(other.grips) do
        if grip.wire == self.wire then return true end
      end
    end
  end
  return false
end

--- Lets go; see gripper:release.
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
  if self.frozen then
    -- A loose mesh may search for rest for minutes; other pads would press on a line beside the mesh, and
    -- this line would lose the torsion between other holds.
    local as_rod = build.data(self.scene).slow or is_pressed(self) or untwisted.others_keep(self)
    local fine, why = not as_rod, nil
    if fine then fine, why = pcall(mixed.let_go, self) end
    if not (fine or self.frozen) then error(why, 0) end
    if not fine then mixed.leave(self) end -- also where a force for rods refuses the mesh
  end
  self.held = false
  self:open_jaws{ speed = args.speed, distance = args.distance }
  if not self.wire then return self end -- another process let go meanwhile
  if self.way == "mixed" then mixed.finish(self) end
  self.wire, self.grips, self.turns_seen = nil, {}, nil
  return self
end

rows.calls{
  { "gripper:freeze", "", "in a mixed grasp: holds the wire rigidly, as the pads hold it now",
    "the gripper" },
  { "gripper:thaw", "", "in a mixed grasp: goes back to the pads and the mesh between them", "the gripper" },
}

Methods.freeze = mixed.freeze
Methods.thaw = mixed.thaw

return grasp
