-- SPDX-License-Identifier: GPL-3.0-or-later
--- Limits from the rating of a gripper: scene:gripper{ rating = { force =, moment =, stroke =, source = } }.
-- @module softworld.check.rated
local ratings = require "softworld.grip.rating"

--- Returns the function limit of a row that is judged by this part of the rating. It returns the limit; nil
-- if the rating lacks this part; false if the script says that none is needed.
return function(part)
  return function(entry)
    local rating = ratings.of(entry.object)
    local value = rating and rating[part]
    if rating == false or value == false then return false end
    return value and { value = value, from = "rating", source = rating.source or "rating of the gripper" }
  end
end
