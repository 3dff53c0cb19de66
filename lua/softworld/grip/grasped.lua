-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks whether the pads press on the wire that was to be grasped, or on another one.
-- @module softworld.grip.grasped
local grasped = {}

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

--- Called once the pads press. Returns nil if only the intended wires are between the pads; else the trouble
-- as a text, and true if the intended wire is not there at all. The run logs an event about it.
function grasped.check(self)
  if not self.wire then return nil end
  local on, others = pressed(self)
  if #others == 0 then return nil end
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
