-- SPDX-License-Identifier: GPL-3.0-or-later
--- How long the edges of a wire may be in the corners of channels.
-- @module softworld.link.narrow
local fixing = require "softworld.link.fixing"
local sealed = require "softworld.sealed"
local vec = require "softworld.vec"

local narrow = {}

-- A straight edge passes a corner of angle a, with w beside the wire, if it is shorter than 2 w / sin(a/2).
-- Measured: edges of 0.9 to 1 of that jam, and pull with some kN; edges of 0.7 do not
-- (spec/model/channel_edges_spec) [-].
local SHARE = 0.7
local LEAST = 0.1    -- least room beside the wire that counts, over the channel's width [-]
local STRAIGHT = 0.1 -- angles up to this one are no corners [rad]

-- Returns the largest angle between legs of a channel [rad].
local function sharpest(legs)
  local most = 0
  for i = 2, #legs do
    local cosine = vec.dot(legs[i - 1].along, legs[i].along)
    most = math.max(most, math.acos(math.max(-1, math.min(1, cosine))))
  end
  return most
end

--- Returns the longest edge with which a wire of this radius passes the corners of all channels of a scene
-- [m], and the name of the channel with the narrowest corner; math.huge without one.
function narrow.edge(scene, radius)
  local least, name = math.huge, nil
  for _, it in ipairs(fixing.all(scene)) do
    local own = getmetatable(it).__name == "channel" and sealed.fields(it)
    local angle = own and sharpest(own.legs) or 0
    if angle > STRAIGHT then
      local room = math.max(own.width - 2 * radius, LEAST * own.width)
      local edge = SHARE * 2 * room / math.sin(angle / 2)
      if edge < least then least, name = edge, own.name end
    end
  end
  return least, name
end

return narrow
