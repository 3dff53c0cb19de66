-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires, some of which are removed, for specs of scene:remove.
local assert = require "luassert"
local sw = require "softworld"

local R = 0.0025

local function rod(scene, name, y, more)
  local p = { name = name, E = 50e6, density = 1500, radius = R, from = { 0, y, 0.1 }, to = { -0.5, y, 0.1 },
    segments = 20 }
  for key, value in pairs(more or {}) do p[key] = value end
  return scene:wire(p)
end

local function three()
  local scene = sw.scene{ name = "three" }
  return scene, rod(scene, "a", 0), rod(scene, "b", 0.05), rod(scene, "c", 0.1)
end

-- Calls f between two steps, at the first state from time t on.
local function at(scene, t, f)
  local done
  scene:observe{ call = function(o)
    if scene.time >= t and not done then
      done = true
      o:change(f)
    end
  end }
end

local function refused(text, f)
  local fine, why = pcall(f)
  assert.is_false(fine, text)
  assert(tostring(why):find(text, 1, true), why)
end

return { rod = rod, three = three, at = at, refused = refused }
