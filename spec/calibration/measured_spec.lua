-- SPDX-License-Identifier: GPL-3.0-or-later
-- sw.calibration: files of measurements, and refusals.
local sw = require "softworld"
local core = require "softworld.core"
local program = require "host.program"
local sagging = require "spec.calibration.sagging"

local SHAPES, mirrored = sagging.SHAPES, sagging.mirrored

local function near(expected, value, tolerance, what)
  local off = math.abs(value / expected - 1)
  assert.is_true(off <= tolerance, ("%s: %.9g instead of %.9g"):format(what or "value", value, expected))
end

describe("files of measurements", function()
  teardown(program.clean)
  local function write(text)
    local path = program.folder() .. "/m.csv"
    local file = assert(io.open(path, "wb"))
    file:write(text)
    file:close()
    return path
  end
  local function pull(text)
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004,
      pull = { file = write(text), length = 0.5 } }
    return found
  end

  it("give their units in the names of columns", function()
    local one = pull "force [N],elongation [mm]\n0,0\n10,0.1\n20,0.2\n31,0.3\n"
    local two = pull("# bench\nelongation [m]; note; force [kN]\n0;1;0\n1e-4;2;0.01\n2e-4;3;0.02\n"
      .. "3e-4;4;0.031\n")
    near(one.EA.value, two.EA.value, 1e-9)
    assert.is_true(one.EA.value > 5e4 and one.EA.value < 5.3e4)
  end)

  for text, case in pairs {
    ["m.csv, line 1, place 11: column 'elongation' does not tell its unit; write 'elongation [m]' (of: "
      .. "m, mm, cm)"]
      = "force [N],elongation\n1,2\n",
    ["m.csv, line 1, place 11: column 'elongation' is in 'lbf'; allowed are m, mm, cm"]
      = "force [N],elongation [lbf]\n1,2\n",
    ["m.csv, line 2: there is no column 'force [N]'; it has: load [N], elongation [mm]"]
      = "\nload [N],elongation [mm]\n1,2\n",
    ["(did you mean 'elongations'?)"] = "force [N],elongations [mm]\n1,2\n",
    ["m.csv, line 3, place 3: 'x' in column 'elongation [mm]' is not a number"]
      = "force [N],elongation [mm]\n1,2\n2,x\n",
    ["m.csv, line 2, place 1: '1,5' in column"] = "force [N];elongation [mm]\n1,5;2\n",
    ["m.csv, line 3, place 3: 'nan'"] = "force [N],elongation [mm]\n1,2\n2,nan\n",
    ["m.csv, line 3, place 3: '1e999' in column 'elongation [mm]' is too large"]
      = "force [N],elongation [mm]\n1,2\n2,1e999\n",
    ["2 cells in this row, but 3 columns"] = "force [N],elongation [mm],t\n1,2\n",
    ["m.csv has 2 points, and at least 3 are needed"] = "force [N],elongation [mm]\n1,2\n3,4\n",
    ["the first row must name the columns"] = "1,2\n3,4\n",
    ["the elongation does not grow with the force"] = "force [N],elongation [mm]\n1,3\n2,2\n3,1\n",
  } do
    it("are refused: " .. text, function()
      local fine, why = pcall(pull, case)
      assert.is_false(fine)
      assert.truthy(why:find(text, 1, true), why)
      assert.truthy(why:find("measured_spec.lua:", 1, true), why)
    end)
  end
end)

describe("sw.calibration refuses", function()
  local SAG = { points = mirrored(SHAPES[1]), length = 1, to = { 1 / 1.05, 0 }, sigma = 1e-4 }
  local function with(changes, key)
    local copy = {}
    for k, v in pairs(SAG) do copy[k] = v end
    for k, v in pairs(changes) do copy[k] = v end
    if key then copy[key] = nil end
    return { sag = copy }
  end
  local TWIST = { length = 0.5, angle = 12, sigma = 0.2 }
  for text, args in pairs {
    ["no measurement is given; give sag, twist, pull or squeeze"] = {},
    ["sag.length is required"] = with({}, "length"),
    ["sag: length = 0.9 m is not allowed; it must be above 0.952381 m"] = with { length = 0.9 },
    ["sag: length = -1 m is not allowed"] = with { length = -1 },
    ["sag: length: sigma = 1 m is not allowed"] = with { length = { 1, sigma = 1 } },
    ["sag: length: sigma = 1e-160 m is not allowed; it must be at least 1e-12 m and at most 0.333333 m"]
      = with { length = { 1, sigma = 1e-160 } },
    ["sag.sigma = 1e-160 m is not allowed; it must be at least 1e-60 m and at most 1e+60 m"]
      = with { sigma = 1e-160 },
    ["twist.sigma = 1e-160 is not allowed; it must be at least 1e-60"]
      = { EI = 1e-3, twist = { length = 1, angle = 9, sigma = 1e-160 } },
    ["sag: length: there is no 'sigm'"] = with { length = { 1, sigm = 1 } },
    ["sag: to is required"] = with({}, "to"),
    ["sag: to must be { x, z }: in the plane, without y"] = with { to = { 1, 0, 0 } },
    ["sag: points[1] must be { x [m], z [m] }, got 3 numbers"] = with { points = { { 0.1, 0, -0.1 } } },
    ["sag: from must be { x, z } [m], two finite numbers in the plane, z upwards; got 'a'"]
      = with { from = "a" },
    ["a cantilever has a free end"] = with { ends = "cantilever" },
    ["did you mean 'clamped'?"] = with { ends = "clampd" },
    ["directions[2] is {0, 0}"] = with { directions = { { 1, 0 }, { 0, 0 } } },
    ["sag: give either file or points"] = with { file = "x.csv" },
    ["sag: points[2] must be { x [m], z [m] }"] = with { points = { { 0, 0 }, { 1 }, { 2, 2 } } },
    ["points[2]: {500, -100} is 509.9 m from where the wire begins, which is 1 m long"]
      = with { points = { { 0, 0 }, { 500, -100 }, { 0.2, 0 } } },
    ["pixel_sigma goes with pixels only"] = with({ pixel_sigma = 1 }, "sigma"),
    ["sag.file must be a string, got 5"] = with({ file = 5 }, "points"),
    ["nowhere.csv"] = with({ file = "nowhere.csv" }, "points"),
    ["determines EI / GJ only; give a sag too, or EI"] = { twist = TWIST },
    ["twist: give one of angle"] = { EI = 1e-3, twist = { length = 1, sigma = 1 } },
    ["twist.sigma is required"] = { EI = 1e-3, twist = { length = 1, angle = 9 } },
    ["twist: period and inertia go together"] = { twist = { length = 1, period = 9, sigma = 1 } },
    ["give EI or sag, not both: the sag determines EI"] = { EI = 1e-3, sag = SAG },
    ["mass_per_length: there is no 'unit'"] = { sag = SAG, mass_per_length = { 1, unit = "g" } },
    ["outer_diameter = 0 m is not allowed"] = { sag = SAG, outer_diameter = 0 },
    ["there is no cable 'GXL 1.6'; did you mean"] = { sag = SAG, like = "GXL 1.6" },
    ["did you mean 'twist'?"] = { twst = TWIST },
  } do
    it(text, function()
      local given = { mass_per_length = 0.02, outer_diameter = 0.004 }
      for key, value in pairs(args) do given[key] = value end
      local fine, why = pcall(function() sw.calibration(given) end)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(text, 1, true), why)
      assert.truthy(tostring(why):find("measured_spec.lua:", 1, true), "no line: " .. tostring(why))
    end)
  end

  it("writes to its result, and misspelt fields", function()
    local found = sw.calibration { mass_per_length = 0.02, outer_diameter = 0.004, sag = SAG }
    assert.error_matches(function() found.EI = 5 end, "cannot be written to")
    assert.error_matches(function() return found.cabel end, "did you mean 'cable'")
    assert.error_matches(function() found.chart {} end, "call it with a colon")
    assert.equal("calibration", core.type(found) or getmetatable(found).__name)
  end)
end)
