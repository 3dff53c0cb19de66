-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wrong values: the message names the object, the parameter, the value as written, what is allowed, and the
-- script's line.
local sw = require "softworld"

local HERE = debug.getinfo(1, "S").short_src

local function told(call, text)
  local fine, message = pcall(call)
  assert.is_false(fine, "no error: " .. text)
  assert.is_truthy(message:find(HERE .. ":", 1, true) == 1, message)
  assert.is_truthy(message:find(text, 1, true), message)
end

local scene = sw.scene{}
local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
local hand = scene:gripper{ name = "hand" }
hand:grasp(wire, { s = 0.1 })

local cases = {
  ["a number as a string, in the core"] = { function()
    scene:wire{ E = "1e7", density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  end, "wire: E must be a number [Pa], got string '1e7'" },
  ["a number as a string, in Lua"] = { function() scene:gripper{ pads = { friction = "0.5" } } end,
    "pads.friction = '0.5' is not allowed; it must be a number at least 0 and at most 100" },
  ["a time as a string"] = { function() hand:move{ by = { 0, 0, 1 }, duration = "1" } end,
    "gripper:move: duration must be a number [s], got string '1'" },
  ["a negative speed of a move"] = { function() hand:move{ by = { 0, 0, 1 }, speed = -1 } end,
    "gripper:move: speed = -1 m/s is not allowed; it must be above 0 m/s" },
  ["a turn by a string"] = { function() hand:rotate{ axis = { 0, 0, 1 }, angle = "90", duration = 1 } end,
    "angle = '90' is not allowed; it must be a number that is finite" },
  ["a number for a place"] = { function() scene:gripper{ at = 5 } end,
    "scene:gripper: at must be a table of 3 finite numbers [m], got 5" },
  ["two numbers for a place"] = { function()
    scene:clip{ at = { 0, 0 }, width = 0.01, insertion = 8, retention = 20 }
  end, "at must be a table of 3 finite numbers [m], got nil as item 3" },
  ["a word for a rotation"] = { function() scene:gripper{ at = { 0, 0, 0 }, rotation = "up" } end,
    "scene:gripper: rotation must be a rotation, { w, x, y, z } or { axis = {x, y, z}, angle = [rad] }, "
      .. "got 'up'" },
  ["a rotation of no size"] = { function() scene:gripper{ rotation = { 0, 0, 0, 0 } } end, "got a table" },
  ["pads of a light year"] = { function() scene:gripper{ pads = { width = 1e16 } } end,
    "scene:gripper: pads.width = 1e+16 m is not allowed; it must be at least 0 m and at most 1000 m" },
  ["a mesh without a file"] = { function() scene:obstacle{ shape = "mesh" } end,
    "obstacle mesh: file is required" },
  ["a mesh with a misspelt file"] = { function() scene:obstacle{ shape = "mesh", fil = "x.stl" } end,
    "obstacle mesh: there is no parameter 'fil'; did you mean 'file'?" },
  ["a path that is not there"] = { function() sw.trajectory{ path = "nothere.csv", speed = 1 } end,
    "cannot read nothere.csv: No such file" },
  ["a tie to nothing"] = { function() scene:tie(wire, { s = 0.1, to = { nil, s = 0.1 } }) end,
    "to[1] must be a wire, got nil" },
  ["another spelling of a function"] = { function() sw.tune.minimize{} end, "did you mean 'minimise'?" },
}

describe("the message on", function()
  for name, case in pairs(cases) do
    it(name .. " says what is wrong and where", function() told(case[1], case[2]) end)
  end
end)
