-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a gripper can bear and do, by its data sheet; rows of checks are judged by it.
-- @module softworld.grip.rating
local rows = require "softworld.rows"

local rating = {}

local parts = rows.list{
  { "force", "number", "N", "largest force on its wires, or false: no rating is needed", min = 0,
    above = true, off = true },
  { "moment", "number", "N m", "largest moment about its centre, or false", min = 0, above = true,
    off = true },
  { "stroke", "number", "m", "largest opening of its pads, or false", min = 0, above = true, off = true },
  { "source", "text", "-", "where the rating is from" },
}

-- The row of scene:gripper and gripper:set.
rating.row = { "rating", "table", "-", "limits of its data sheet, by which run:check judges its rows; false: "
  .. "no rating is needed", rows = parts, off = true }

--- Returns the rating of a gripper. A script may have written into the table: then it is checked again here.
function rating.of(gripper)
  local value, what = gripper.rating, ("gripper '%s': rating"):format(gripper.name)
  return value and parts:read(value, what, what .. ".")
end

return rating
