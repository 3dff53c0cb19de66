-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lists and vectors within a table of parameters refuse a name that they do not have: a misspelt one, or one
-- that stands within a brace too many.
local sw = require "softworld"

local scene, wire, run

local function new_wire(s)
  return s:wire{ name = "w", E = 1e8, density = 1400, radius = 0.002, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 }, segments = 6 }
end

setup(function()
  scene = sw.scene{}
  wire = new_wire(scene)
  local other = sw.scene{}
  other:clamp(new_wire(other), { s = 0 })
  run = other:run{ duration = 0.02, frames = true }
end)

local function particles(more)
  local args = { positions = { { 0, 0, 5 }, { 1, 0, 5 } }, masses = { 1, 1 }, radius = 0.1 }
  for key, value in pairs(more) do args[key] = value end
  return scene:particles(args)
end

local function cell(more)
  local args = { spacing = 0.1, particles = { { 0, 0, 0 }, { 0.05, 0, 0 } },
    links = { { from = 1, to = 2, group = "x" } }, stiffness = { x = 1 } }
  for key, value in pairs(more) do args[key] = value end
  return sw.calibrate.cell(args)
end

local function hung(more)
  local sag = { length = 1, to = { 0.9, 0 }, points = { { 0.4, -0.1 }, { 0.5, -0.1 }, { 0.6, -0.1 } } }
  for key, value in pairs(more) do sag[key] = value end
  return sw.calibration{ name = "a", source = "b", outer_diameter = 0.003, mass_per_length = 0.01, sag = sag }
end

local function study(parameter)
  return sw.study{ name = "q", parameters = { a = parameter or { 0, 1 } },
    evaluate = function(p) return { y = { p.a, p.a } } end }
end

local O = { 0, 0, 0 }
local X = { 1, 0, 0 }
local cases = {
  ["a place"] = { function() scene:gripper{ at = { 0, 0, 1, hieght = 3 } } end,
    "scene:gripper: at has no field 'hieght'; known are: x y z" },
  ["a vector of the core"] = { function()
    scene:wire{ E = 1e8, density = 1400, radius = 0.002, from = { 0, 0, 1, name = "w" }, to = { 1, 0, 1 } }
  end, "wire: from has no field 'name'; known are: x y z" },
  ["a quaternion"] = { function()
    scene:obstacle{ shape = "plane", at = { 0, 0, -9 }, rotation = { 1, 0, 0, 0, angel = 1 } }
  end, "rotation has no field 'angel'; did you mean 'angle'?" },
  ["a quaternion of a gripper"] = { function() scene:gripper{ rotation = { 1, 0, 0, 0, axs = X } } end,
    "scene:gripper: rotation has no field 'axs'; did you mean 'axis'?" },
  ["way-points"] = { function() sw.trajectory{ points = { O, X, speed = 1 } } end,
    "trajectory: points is a list; it has no field 'speed'" },
  ["times"] = { function() sw.trajectory{ points = { O, X }, times = { 0, 1, law = "linear" } } end,
    "trajectory: times is a list; it has no field 'law'" },
  ["way-points of a gripper"] = { function()
    scene:gripper{ at = O }:move{ points = { O, X, speed = 1 }, duration = 1 }
  end, "points is a list; it has no field 'speed'" },
  ["the path of a wire"] = { function()
    scene:wire{ E = 1e8, density = 1400, radius = 0.002, path = { { 0, 0, 1 }, { 1, 0, 1 }, segments = 9 } }
  end, "wire: path is a list; it has no field 'segments'" },
  ["a point of a wire's path"] = { function()
    scene:wire{ E = 1e8, density = 1400, radius = 0.002, path = { { 0, 0, 1, pin = 1 }, { 1, 0, 1 } } }
  end, "wire: path, point 1 has no field 'pin'; known are: x y z" },
  ["two stiffnesses"] = { function()
    scene:wire{ EI = { 1e-3, 1e-3, GJ = 1 }, EA = 100, density = 1400, radius = 0.002, from = O, to = X }
  end, "wire: EI is a list; it has no field 'GJ'" },
  ["the points of a channel"] = { function()
    scene:channel{ points = { O, X, width = 0.02 }, width = 0.02, depth = 0.02 }
  end, "points is a list; it has no field 'width'" },
  ["the points of a hull"] = { function()
    scene:obstacle{ shape = "hull", points = { O, X, { 0, 1, 0 }, { 0, 0, 1 }, friction = 1 } }
  end, "points is a list; it has no field 'friction'" },
  ["friction of two fingers"] = { function()
    scene:gripper{ pads = { friction = { 0.1, 0.2, kind = 1 } } }
  end, "pads.friction is a list; it has no field 'kind'" },
  ["wires to grasp"] = { function() scene:gripper{ at = { 0.1, 0, 0.1 } }:grasp { wire, s = 0.1 } end,
    "gripper:grasp: the first argument is a list; it has no field 's'" },
  ["places of a grasp"] = { function()
    scene:gripper{ name = "hand", at = { 0.1, 0, 0.1 } }:grasp({ wire }, { s = { 0.1, force = 3 } })
  end, "gripper 'hand': s is a list; it has no field 'force'" },
  ["wires that touch"] = { function() scene:wire_contact{ between = { wire, friction = 0.3 } } end,
    "scene:wire_contact: between is a list; it has no field 'friction'" },
  ["a region"] = { function() wire:remodel{ model = "radial", region = { 0.1, 0.2, particles = 6 } } end,
    "wire:remodel: region is a list; it has no field 'particles'" },
  ["the ends of a join"] = { function()
    scene:join{ ends = { { wire, s = 0.3 }, { wire, s = 0 }, name = "knot" } }
  end, "scene:join: ends is a list; it has no field 'name'" },
  ["positions"] = { function() particles{ positions = { O, X, radius = 1 } } end,
    "particles: positions is a list; it has no field 'radius'" },
  ["a position"] = { function() particles{ positions = { O, { 1, 0, 0, mass = 1 } } } end,
    "particles: a position is a list; it has no field 'mass'" },
  ["masses"] = { function() particles{ masses = { 1, 1, k = 1 } } end,
    "particles: masses is a list; it has no field 'k'" },
  ["links"] = { function() particles{ links = { { 1, 2, k = 1 }, yield = 1 } } end,
    "particles: links is a list; it has no field 'yield'" },
  ["pairs of links"] = { function() particles{ links = { { pairs = { 1, 2, k = 2 }, k = 1 } } } end,
    "particles: pairs is a list; it has no field 'k'" },
  ["an entry of a surface"] = { function() particles{ surface = { { 1, 2, k = 2 } } } end,
    "particles: an entry of surface is a list; it has no field 'k'" },
  ["particles to hold"] = { function() scene:hold(particles{}, { particles = { 1, at = O } }) end,
    "is a list; it has no field 'at'" },
  ["a wanted path"] = { function() run:check{ landing = { path = { O, X, wire = "w" } } } end,
    "run:check: landing.path is a list; it has no field 'wire'" },
  ["a point of a wanted path"] = { function() run:check{ landing = { path = { { 0, 0, 0, from = 1 } } } } end,
    "run:check: landing.path[1] has no field 'from'; known are: x y z" },
  ["a curve of lives"] = { function()
    run:check{ fatigue = { curve = { { 1, 2000 }, { 2, 100 }, spread = 5 } } }
  end, "run:check: fatigue.curve is a list; it has no field 'spread'" },
  ["a point of a curve of lives"] = { function()
    run:check{ fatigue = { curve = { { 1, 2000, flag = "guessed" }, { 2, 100 } } } }
  end, "run:check: fatigue.curve[1] is a list; it has no field 'flag'" },
  ["bands"] = { function() run:check{ vibration = { bands = { { 1, 2 }, damping = 0.1 } } } end,
    "run:check: vibration.bands is a list; it has no field 'damping'" },
  ["a band"] = { function() run:check{ vibration = { bands = { { 1, 2, too = 3 } } } } end,
    "run:check: vibration.bands[1] is a list; it has no field 'too'" },
  ["times of pictures"] = { function()
    run:pictures{ path = "/nowhere/x.png", times = { 0.01, width = 9 } }
  end, "run:pictures: times is a list; it has no field 'width'" },
  ["columns of a chart"] = { function() run:chart{ columns = { "time", size = 9 } } end,
    "run:chart: columns is a list; it has no field 'size'" },
  ["an error of a curve"] = { function() sw.plot{ { y = { { value = 1, eror = 2 } } } } end,
    "sw.plot: [1]: y[1] has no field 'eror'; did you mean 'error'?" },
  ["measured points"] = { function() hung{ points = { { 0.4, -0.1 }, sigma = 1e-3 } } end,
    "sw.calibration: sag: points is a list; it has no field 'sigma'" },
  ["a measured point"] = { function() hung{ points = { { 0.4, -0.1, sigma = 1e-3 } } } end,
    "sw.calibration: sag: points[1] is a list; it has no field 'sigma'" },
  ["an end of a wire that sags"] = { function() hung{ to = { 0.9, 0, ends = "hung" } } end,
    "sw.calibration: sag: to is a list; it has no field 'ends'" },
  ["choices"] = { function() study{ choices = { "a", "b", unit = "m" } } end,
    "sw.study: parameter 'a': choices is a list; it has no field 'unit'" },
  ["sigmas of data"] = { function()
    study():fit{ data = { y = { 0.5, 0.6, sigma = { 0.1, 0.1, unit = "N" } } } }
  end, "study:fit: data.y: sigma is a list; it has no field 'unit'" },
  ["the start of a search"] = { function()
    sw.tune.minimise{ f = function(x) return x[1] ^ 2 end, start = { 1, step = 0.1 } }
  end, "tune.minimise: start is a list; it has no field 'step'" },
  ["stiffness of a cell"] = { function()
    cell{ stiffness = { along = 1, alogn = 2 }, links = { { from = 1, to = 2, group = "along" } } }
  end, "cell: stiffness has a group 'alogn', which no link uses; did you mean 'along'?" },
  ["stiffness of a cell, far from all"] = { function() cell{ stiffness = { x = 1, other = 2 } } end,
    "cell: stiffness has a group 'other', which no link uses; links use: x" },
  ["a link of a cell"] = { function() cell{ links = { { from = 1, to = 2, group = "x", wieght = 2 } } } end,
    "cell: link 1 has no field 'wieght'; did you mean 'weight'?" },
  ["an element of a cell"] = { function()
    cell{ nu = 0.1, elements = { { particles = { 1, 2, 1, 1, 2, 1 }, modulos = 1 } } }
  end, "cell: element 1 has no field 'modulos'; did you mean 'modulus'?" },
}

-- Returns a function that waits in a process for two places to come near each other.
local function waiting(place)
  return function()
    local other = sw.scene{}
    local hand, w = other:gripper{ at = O }, new_wire(other)
    other:process(function(p)
      p:wait_until{ distance = 0.1, between = { place(w), hand } } -- this line is told
    end)
    other:run{ dt = 0.01 }
  end
end

cases["a place to wait for"] = { waiting(function() return { 0, 0, 1, t = 2 } end),
  "p:wait_until: between: a place has no field 't'; known are: x y z" }
cases["a place of a wire to wait for"] = { waiting(function(w) return { w, s = 0.1, t = 2 } end),
  "p:wait_until: between: a place has no field 't'; known are: s" }

describe("a name that is not known is refused in", function()
  for name, case in pairs(cases) do
    it(name, function()
      local fine, why = pcall(case[1])
      assert.is_false(fine, "no error")
      assert.truthy(why:find(case[2], 1, true), why)
      assert.falsy(why:find "softworld/[%w_/]+%.lua", why) -- no place in the library
    end)
  end
end)

describe("a list or a vector may", function()
  it("have the count that table.pack writes", function()
    local path = sw.trajectory{ points = table.pack(O, table.pack(1, 0, 0)), speed = 1 }
    assert.equal(1, path:length())
    scene:gripper{ at = table.pack(0, 0, 1) }
  end)

  it("name its items x, y and z, and have methods", function()
    local Point = { __index = { along = function(self) return self.x end } }
    local path = sw.trajectory{ points = { O, setmetatable({ x = 1, y = 0, z = 0 }, Point) }, speed = 1 }
    assert.equal(1, path:length())
  end)

  it("give way-points a rotation or a time", function()
    local last = { 1, 0, 0, t = 2, rotation = { 1, 0, 0, 0 } }
    local path = sw.trajectory{ points = { { 0, 0, 0, t = 0 }, last } }
    assert.equal(2, path:duration())
  end)
end)
