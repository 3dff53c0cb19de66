-- SPDX-License-Identifier: GPL-3.0-or-later
--- Grippers whose wires are removed, and grippers that are removed: see scene:remove.
-- @module softworld.grip.losing
local grasp = require "softworld.grip.grasp"
local mixed = require "softworld.grip.mixed"

local losing = {}

--- Prepares to remove the gripper: its wires become what they would be after a release.
function losing.begin(self)
  if self.frozen then mixed.leave(self) end
  if self.tool and self.way == "mixed" and self.wire then mixed.finish(self) end
end

--- Drops all wires after the gripper was removed.
function losing.all(self)
  for _, grip in ipairs(self.grips) do losing.wire(self, grip.wire) end
end

--- Drops a removed wire. A later release of it is no error.
function losing.wire(self, wire)
  local left, held = {}, false
  for _, grip in ipairs(self.grips) do
    if grip.wire == wire then held = true else left[#left + 1] = grip end
  end
  if not held then return end
  self.bereft, self.turns_seen = true, nil
  if not self.tool then return grasp.drop(self, wire) end
  if self.wire == wire then self.frozen = nil end
  self.grips, self.wire = left, left[1] and left[1].wire
  self.held = self.held and #left > 0
end

return losing
