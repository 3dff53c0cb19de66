-- SPDX-License-Identifier: GPL-3.0-or-later
--- Radii of round obstacles.
-- @module softworld.scene.roundness
local core = require "softworld.core"

local roundness = {}

local known = setmetatable({}, { __mode = "k" }) -- a mesh's entry -> its radius [m], or false

--- Returns the radius of an obstacle, an entry of a scene's data: its parameter, or of a mesh or hull the
-- radius of the round surface that its facets approximate, about [m]. nil: it is not round, or was removed.
function roundness.of(entry)
  if not core.exists(entry.object) or not entry.object.present then return nil end
  if entry.radius ~= nil or entry.shape ~= "mesh" and entry.shape ~= "hull" then return entry.radius end
  if known[entry] == nil then
    local radius = entry.object.shape:roundness()
    known[entry] = radius > 0 and radius or false
  end
  return known[entry] or nil
end

return roundness
