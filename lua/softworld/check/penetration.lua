-- SPDX-License-Identifier: GPL-3.0-or-later
--- Deepest penetration of all steps. Contact models hard bodies: beyond a quarter of the thinnest wire's
-- radius its forces cannot be trusted. Penetration itself is an error of the steps and changes with each of
-- them, so its bar is at least as large as the depth.
-- @module softworld.check.penetration
local build = require "softworld.scene.build"
local terms = require "softworld.check.terms"

local SHARE = 0.25 -- of the radius, as of crashes [-]

local function thinnest(scene)
  local least = math.huge
  for _, w in ipairs(build.data(scene).wires) do least = math.min(least, w.object.radius) end
  return least
end

return { name = "penetration", vanishes = true, unit = "m", side = "max", on = "run",
  terms = terms.places_of_all,
  label = "deepest penetration", missing = "allowed penetration",
  value = function(_, context)
    if #build.data(context.scene).obstacles == 0 then return nil end
    local depth, s, time = context.scene:penetration()
    return { value = depth, s = s, time = time }
  end,
  limit = function(_, context)
    local radius = thinnest(context.scene)
    if radius == math.huge then return nil end
    return { value = SHARE * radius, from = "definition", source = "a quarter of the thinnest wire's radius" }
  end,
  reference = function(_, context)
    local radius = thinnest(context.scene)
    return radius < math.huge and radius or nil
  end }
