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
  ["a path and its ends"] = { function()
    scene:wire{ E = 1e7, density = 1000, radius = 0.003, path = { { 0, 0, 1 }, { 1, 0, 1 } },
      from = { 0, 0, 0 } }
  end, "give either path or from and to, not both" },
  ["a number for a model"] = { function()
    scene:wire{ E = 1e7, density = 1000, radius = 0.003, model = 3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  end, "wire: there is no model number 3; known are: string" },
  ["an endless turn"] = { function()
    hand:rotate{ axis = { 0, 0, 1 }, angle = -math.huge, duration = 1 }
  end, "gripper:rotate: angle = -inf rad is not allowed; it must be finite" },
  ["an endless rotation"] = { function()
    scene:gripper{ at = { 0, 0, 0 }, rotation = { axis = { 0, 0, 1 }, angle = -math.huge } }
  end, "scene:gripper: rotation.angle = -inf rad is not allowed; it must be finite" },
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
  ["a named mesh whose file is not there"] = { function()
    scene:obstacle{ name = "wall", shape = "mesh", file = "nothere.stl" }
  end, "obstacle mesh 'wall': mesh file 'nothere.stl': No such file" },
  ["a mesh with a number for a file"] = { function()
    scene:obstacle{ name = "wall", shape = "mesh", file = 3 }
  end, "obstacle mesh 'wall': file must be the name of a mesh file, got 3" },
  ["a named obstacle of negative size"] = { function()
    scene:obstacle{ name = "100%1", shape = "sphere", radius = -1 }
  end, "obstacle sphere '100%1': radius = -1 m is not allowed" },
  ["a zone whose file is not there"] = { function()
    scene:zone{ name = "oven", shape = "mesh", file = "nothere.stl" }
  end, "zone mesh 'oven': mesh file 'nothere.stl': No such file" },
  ["a path that is not there"] = { function() sw.trajectory{ path = "nothere.csv", speed = 1 } end,
    "cannot read nothere.csv: No such file" },
  ["a tie to nothing"] = { function() scene:tie(wire, { s = 0.1, to = { nil, s = 0.1 } }) end,
    "to[1] must be a wire (from scene:wire), got nil" },
  ["a tie of nothing"] = { function() scene:tie(nil) end,
    "scene:tie: the first argument must be a wire (from scene:wire), got nil" },
  ["a grasp of nothing"] = { function() hand:grasp(nil) end,
    "gripper:grasp: the first argument must be a wire (from scene:wire) or a list of wires, got nil" },
  ["a join with a number"] = { function()
    scene:join{ ends = { { wire, s = 0.2 }, { 7, s = 0 } } }
  end, "scene:join: ends[2][1] must be a wire of the scene (from scene:wire), got number 7" },
  ["a force on a text"] = { function() scene:force{ kind = "drag", on = "wire" } end, "scene:force: on must "
    .. "be a wire (from scene:wire) or particles (from scene:particles) of the scene, got string 'wire'" },
  ["particles that are none"] = { function() scene:hold(wire, {}) end,
    "scene:hold: the first argument must be particles of the scene (from scene:particles), got wire" },
  ["another spelling of a function"] = { function() sw.tune.minimize{} end, "did you mean 'minimise'?" },
}

for _, kind in ipairs{ "clamp", "pin", "grip", "feed", "slider" } do
  cases["a " .. kind .. " of nothing"] = { function() scene[kind](scene, nil) end,
    ("scene:%s: the first argument must be a wire of the scene (from scene:wire), got nil"):format(kind) }
end

describe("the message on", function()
  for name, case in pairs(cases) do
    it(name .. " says what is wrong and where", function() told(case[1], case[2]) end)
  end
end)
