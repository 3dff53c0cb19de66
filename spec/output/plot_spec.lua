-- SPDX-License-Identifier: GPL-3.0-or-later
-- sw.plot: curves of runs and of any numbers, in files and as characters.
local files = require "spec.output.files"
local gnuplot = require "softworld.output.gnuplot"
local sink = require "softworld.output.sink"
local sw = require "softworld"

local function run_of(name, height)
  local scene = sw.scene { name = name }
  local wire = scene:wire { name = "w", E = 5e7, density = 1500, radius = 0.0025, from = { 0, 0, height },
    to = { 0.2, 0, height }, segments = 8 }
  scene:clamp(wire, { s = 0, name = "wall" })
  return scene:run { duration = 0.1, dt = 0.01 }
end

-- The script that gnuplot gets.
local function script_of(args)
  local draw, kept = gnuplot.draw, nil
  gnuplot.draw = function(script)
    kept = table.concat(script.lines, "\n")
    return "drawn"
  end
  local fine, why = pcall(sw.plot, args)
  gnuplot.draw = draw
  assert(fine, why)
  return kept
end

describe("sw.plot", function()
  local folder, a, b
  setup(function()
    folder = files.folder()
    a, b = run_of("it's a", 0.1), run_of("b & <c>", 0.2)
  end)
  teardown(function() files.remove(folder) end)

  it("leaves out bend radii of almost straight wire, as run:chart does", function()
    local scene = sw.scene {}
    local wire = scene:wire { name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local script = script_of { scene:run { duration = 0.2, dt = 0.005 }, columns = { "w.bend_radius" } }
    local least, most = math.huge, 0
    for value in script:gmatch "\n%S+ ([%d.e+-]+)%f[\n]" do
      least, most = math.min(least, tonumber(value)), math.max(most, tonumber(value))
    end
    assert.is_true(most <= 100 * least and least > 0, most .. " of " .. least)
  end)

  it("overlays runs, with one panel for each unit", function()
    local script = script_of { a, b, path = "x.svg",
      columns = { "wall.force", "wall.moment", "wall.force_z" } }
    local _, plots = script:gsub("\nplot ", "")
    assert.equal(2, plots) -- N and N m
    for _, name in ipairs { "'it''s a, wall.force'", "'b & <c>, wall.force_z'", "'it''s a, wall.moment'" } do
      assert.truthy(script:find(name, 1, true), script)
    end
    local path = folder .. "/it's.svg"
    assert.equal(path, sw.plot { a, b, columns = { "wall.force" }, path = path })
    assert.truthy(sink.read_file(path):find("b &amp; &lt;c>, wall.force", 1, true))
  end)

  it("draws every given value with its error", function()
    local script = script_of { { name = "m", x = { 1, 3 }, y = { 0.25, { value = 0.5, error = 0.125 } } } }
    assert.truthy(script:find("\n1 0.25 0\n3 0.5 0.125\n", 1, true), script)
    assert.truthy(script:find("yerrorbars", 1, true))
    script = script_of { { y = { 4, 5 }, error = 0.5 } }
    assert.truthy(script:find("\n1 4 0.5\n2 5 0.5\n", 1, true), script)
    script = script_of { { y = { 4, 0 / 0, 5 }, style = "points" } }
    assert.truthy(script:find("\n2 NaN\n", 1, true), script)
  end)

  it("has logarithmic axes, and names curves that have no positive value", function()
    local script = script_of { { x = { 1, 10 }, y = { 2, 200 } }, log = "xy" }
    assert.truthy(script:find("set logscale x", 1, true) and script:find("set logscale y", 1, true))
    script = script_of { { x = { -1, 10 }, y = { 2, 200 } }, log = "y" }
    assert.is_nil(script:find("set logscale x", 1, true))
    assert.error_matches(function() sw.plot { { name = "n", y = { -1, 0 } }, log = "y" } end,
      "y of 'n' has no value above 0")
  end)

  it("writes PNG and PDF, and characters without a path", function()
    for _, kind in ipairs { "png", "pdf" } do
      local path = folder .. "/a." .. kind
      sw.plot { { y = { 1, 4, 9 } }, path = path }
      assert.equal(kind == "png" and "\x89PNG" or "%PDF", sink.read_file(path):sub(1, 4))
    end
    assert.truthy(sw.plot { { name = "squares", y = { 1, 4, 9 } } }:find("squares", 1, true))
  end)

  it("refuses wrong arguments by name, and leaves no files", function()
    local list = files.list(folder)
    local function refuses(args, text)
      local fine, why = pcall(sw.plot, args)
      assert.is_false(fine)
      assert.truthy(why:find("plot_spec.lua:%d+: ") and why:find(text, 1, true), why)
    end
    refuses({}, "give a run or a curve")
    refuses({ 1 }, "[1] must be a run, or a curve")
    refuses({ { y = {} } }, "[1]: y has no values")
    refuses({ { x = { 1 }, y = { 1, 2 } } }, "[1]: x has 1 value, and y 2")
    refuses({ { y = { "a" } } }, "y[1] must be a number")
    refuses({ { y = { 0 / 0 } } }, "no finite value")
    refuses({ { y = { 1 }, error = -1 } }, "error[1] = -1 is not allowed")
    refuses({ { y = { 1, 2 }, error = { 1 } } }, "error has 1 value, and y 2")
    refuses({ { y = { 1 }, style = "lines" } }, "did you mean 'line'?")
    refuses({ { y = { 1 } }, lgo = "x" }, "did you mean 'log'?")
    refuses({ a, columns = { "wall.forse" } }, "did you mean 'wall.force'?")
    refuses({ { y = { 1, 2 } }, path = folder .. "/x.doc" }, "ends in none of")
    refuses({ { y = { 1, 2 } }, path = folder .. "/no/x.svg" }, "No such file")
    files.without_programs(function() refuses({ { y = { 1, 2 } } }, "apt-get install gnuplot-nox") end)
    assert.same(list, files.list(folder))
  end)

  it("of a failed run says that it has no series", function()
    local scene = sw.scene { name = "wild" }
    local wire = scene:wire { E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1 },
      to = { 0.5, 0, 0.1 } }
    scene:clamp(wire, { s = 0 })
    local failed = scene:run { duration = 1, dt = 1.2 * scene:stable_dt(), integrator = "velocity-verlet",
      unstable = true }
    assert.is_false(failed.ok)
    assert.error_matches(function() sw.plot { failed } end, "it has no series")
  end)
end)
