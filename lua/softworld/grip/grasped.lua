-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks whether the pads press on the wires that were to be grasped, or on others.
-- @module softworld.grip.grasped
local number = require "softworld.output.number"
local stand = require "softworld.grip.stand"
local vec = require "softworld.vec"

local grasped = {}

local LEAST = 1e-3 -- a wire is held if it is squeezed by this share of the force per finger [-]

-- Returns the normal force on each wire [N per finger], and the names of unintended wires, the largest force
-- first.
local function pressed(self)
  local on, others, fingers, count, meant = {}, {}, {}, 0, { [self.wire.name] = true }
  for _, grip in ipairs(self.grips) do meant[grip.wire.name] = true end
  for _, touch in ipairs(self.tool:touches()) do
    local name = touch.wire_name
    if not on[name] and not meant[name] then others[#others + 1] = name end
    on[name] = (on[name] or 0) + touch.normal
    if not fingers[touch.finger] then fingers[touch.finger], count = true, count + 1 end
  end
  for name, force in pairs(on) do on[name] = force / count end
  table.sort(others, function(a, b)
    if on[a] ~= on[b] then return on[a] > on[b] end
    return a < b
  end)
  return on, others
end

-- Calls f(name, force on this wire [N], what presses) for each touch of a wire with a pad or, near the tool,
-- with another wire.
local function each_touch(self, f)
  local centre, q = self.tool:pose()
  local reach = math.max(self.width, self.tool:state().opening)
  for _, touch in ipairs(self.tool:touches()) do
    f(touch.wire_name, vec.rotate(q, touch.force), touch.finger)
  end
  for _, touch in ipairs(self.scene:touches()) do
    if vec.norm(vec.sub(touch.point, centre)) <= reach then
      f(touch.wires[1], touch.force, touch.wires[2])
      f(touch.wires[2], vec.scale(touch.force, -1), touch.wires[1])
    end
  end
end

-- Returns the names of the wires of a list that are not held. A wire is held if at least two of the fingers,
-- and of the wires that are held, press it from different sides: a wire that only lies on another one, or on
-- the table, is not.
local function left_out(self)
  local forces = {}
  for _, grip in ipairs(self.grips) do forces[grip.wire.name] = {} end
  each_touch(self, function(name, force, by)
    local on = forces[name]
    if on then on[#on + 1] = { force = force, by = by } end
  end)
  local least, out = LEAST * self.tool:state().squeeze, {}
  local function is_held(name)
    local sizes, sum, seen, count = 0, { 0, 0, 0 }, {}, 0
    for _, one in ipairs(forces[name]) do
      if not out[one.by] then
        sizes, sum = sizes + vec.norm(one.force), vec.add(sum, one.force)
        if not seen[one.by] then seen[one.by], count = true, count + 1 end
      end
    end
    return count > 1 and 0.5 * (sizes - vec.norm(sum)) > least
  end
  local names, before = {}, -1
  while #names > before do -- what is not held holds nothing
    before = #names
    for _, grip in ipairs(self.grips) do
      local name = grip.wire.name
      if not out[name] and not is_held(name) then out[name], names[#names + 1] = true, name end
    end
  end
  return names
end

-- Returns where the wires of these names are, in words: the distance of the first one from the tool centre.
local function whereabouts(self, names)
  local place = ""
  for _, grip in ipairs(self.grips) do
    if grip.wire.name == names[1] then
      local _, d = stand.nearest_place(grip.wire, (self.tool:pose()))
      place = (" ('%s' is %s from the tool centre)"):format(names[1], number.text(d, "m"))
    end
  end
  return ("wire%s '%s'%s"):format(#names > 1 and "s" or "", table.concat(names, "', '"), place)
end

-- Tells which wires of a list the pads leave out. Returns nil if they hold all; else the text, and true.
local function check_list(self)
  local names = #self.grips > 1 and left_out(self) or {}
  if #names == 0 then return nil end
  local text = ("gripper '%s' leaves out %s: the pads have closed to %s, and neither they nor other wires "
    .. "press it there"):format(self.name, whereabouts(self, names),
    number.text(self.tool:state().opening, "m"))
  self.scene:tell{ kind = "grasp", object = self.name, value = #names, text = text }
  return text .. ". Lay the wires side by side between the pads, take pads = { shape = 'v' }, give more "
    .. "force, or take it off the list", true
end

--- Returns those of several wires that nothing between the pads touches: each was lost.
function grasped.strays(self)
  local touched, list = {}, {}
  each_touch(self, function(name) touched[name] = true end)
  for _, grip in ipairs(self.grips) do
    if not touched[grip.wire.name] then list[#list + 1] = grip.wire end
  end
  return list
end

--- Called once the pads press. Returns nil if only the intended wires are between the pads; else the trouble
-- as a text, and true if an intended wire is not there at all. The run logs an event about it.
function grasped.check(self)
  if not self.wire then return nil end
  local on, others = pressed(self)
  if #others == 0 or on[self.wire.name] and #self.grips > 1 then
    local text, missed = check_list(self)
    if missed or #others == 0 then return text, missed end
  end
  local missed = not on[self.wire.name]
  local list = {}
  for i, name in ipairs(others) do list[i] = ("'%s' (%.3g N)"):format(name, on[name]) end
  local text = missed
    and ("gripper '%s' presses on wire %s, not on wire '%s', the one to grasp"):format(
      self.name,
      table.concat(list, ", "), self.wire.name)
    or ("gripper '%s' presses on wire %s besides wire '%s', the one to grasp"):format(
      self.name,
      table.concat(list, ", "), self.wire.name)
  self.scene:tell{ kind = "grasp", object = self.name, value = on[others[1]], text = text }
  return text, missed
end

return grasped
