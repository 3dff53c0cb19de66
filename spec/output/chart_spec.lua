-- SPDX-License-Identifier: GPL-3.0-or-later
local chart = require "softworld.output.chart"
local files = require "spec.output.files"
local scene = require "spec.output.scene"
local sink = require "softworld.output.sink"

local awkward = "a_b^2 {x} 'q' \"d\" `id` $H @x 100 % <&> µ\\n"
local escaped = "a_b^2 {x} 'q' \"d\" `id` $H @x 100 % &lt;&amp;> µ\\n"

-- All the text of an SVG, piece by piece.
local function shown(path)
  local texts = {}
  for _, element in ipairs(files.xml(sink.read_file(path))) do texts[#texts + 1] = element.text end
  return table.concat(texts, "\n")
end

describe("chart", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  local points = {
    { x = 0.01, y = 1e-2, series = "rod" }, { x = 0.1, y = 1e-4, series = "rod", label = "h_1" },
    { x = 0.2, y = 1e-3, series = awkward },
    { x = 0.02, failed = true, series = awkward, label = "diverged" },
    { x = 0.1, y = 1e-3, series = "late" },
  }

  it("writes large numbers at its axes without markup", function()
    local run = scene.run { frames = 5 }
    for i, frame in ipairs(run.frames) do frame.energy = { kinetic = 1e6 * i, elastic = 0, gravity = 0 } end
    chart.series { run = run, energy = true, path = folder .. "/large.svg" }
    local text = shown(folder .. "/large.svg")
    assert.truthy(text:find "%de%+06")
    assert.falsy(text:find("^{", 1, true))
  end)

  it("draws the energies of the frames, and running means under a title that says so", function()
    local run = scene.run { frames = 5 }
    for i, frame in ipairs(run.frames) do
      frame.energy = { kinetic = i, elastic = 2 * i, gravity = -i }
    end
    chart.series { run = run, energy = true, path = folder .. "/e.svg" }
    local text = shown(folder .. "/e.svg")
    for _, expected in ipairs { "kinetic", "elastic", "gravity", "energy [J]" } do
      assert.truthy(text:find(expected, 1, true), expected)
    end
    chart.series { run = run, mean = 0.05, title = "forces", path = folder .. "/m.svg" }
    assert.truthy(shown(folder .. "/m.svg"):find("forces, means over 0.05 s", 1, true))
  end)

  it("draws series as SVG with names and units, and leaves no other files", function()
    local run = scene.run { frames = 2 }
    run.name = awkward
    run.series.columns[3] = { name = awkward, unit = "N", values = run.series.columns[1].values }
    assert.equal(folder .. "/it's.svg", chart.series { run = run, path = folder .. "/it's.svg" })
    local text = shown(folder .. "/it's.svg")
    for _, expected in ipairs { "left.force", "[N]", "energy.kinetic [J]", "t [s]" } do
      assert.truthy(text:find(expected, 1, true), expected)
    end
    local flat = sink.read_file(folder .. "/it's.svg")
    flat = flat:gsub("&quot;", '"'):gsub("&apos;", "'"):gsub("&gt;", ">")
    local _, times = flat:gsub((escaped:gsub("%p", "%%%0")), "")
    assert.is_true(times >= 2, flat:match("a_b[^<]*")) -- in the title and in the key
    assert.same({ "it's.svg" }, files.list(folder))
  end)

  it("draws SVG that is XML, whatever the names", function()
    local run, path = scene.run { frames = 2 }, folder .. "/x.svg"
    run.name = "]]> a ]]]>> & < > \" '"
    run.series.columns[3] = { name = "]]>", unit = "]]>", values = run.series.columns[1].values }
    chart.series { run = run, path = path }
    local text = sink.read_file(path)
    assert.is_nil(text:find("]]>", 1, true)) -- not allowed outside of CDATA
    local _, count = text:gsub("]]&gt;", "")
    assert.is_true(count >= 4)
    assert.truthy(text:gsub("&gt;", ">"):find("]]> a ]]]>> &amp; &lt; > ", 1, true))
    assert.is_nil(text:gsub("&%a+;", ""):find("&", 1, true))
    files.xml(text)
  end)

  it("draws PNG in the size asked for", function()
    chart.series { run = scene.run { frames = 2 }, path = folder .. "/a.png", size = { 640, 360 } }
    assert.same({ 640, 360 }, { files.png_size(folder .. "/a.png") })
    chart.front { points = points, path = folder .. "/b.png", size = { 500, 400 } }
    assert.same({ 500, 400 }, { files.png_size(folder .. "/b.png") })
    local values = { { 1, 0 / 0 } }
    chart.map { rows = { "r" }, columns = { "c", "d" }, values = values, path = folder .. "/c.png" }
    assert.same({ 420, 182 }, { files.png_size(folder .. "/c.png") })
    chart.series { run = scene.run { frames = 2 }, path = folder .. "/d.pdf" }
    assert.equal("%PDF", sink.read_file(folder .. "/d.pdf"):sub(1, 4))
    assert.same({ "a.png", "b.png", "c.png", "d.pdf" }, files.list(folder))
  end)

  it("draws with characters", function()
    local run = scene.run { frames = 2 }
    local text = chart.series { run = run, columns = { "left.force" }, size = { 60, 15 } }
    assert.truthy(text:find("left.force [N]", 1, true))
    assert.truthy(text:find("t [s]", 1, true))
    assert.truthy(text:find("%*%*"))
    for line in text:gmatch("[^\n]+") do assert.is_true(utf8.len(line) <= 60) end
    assert.truthy(chart.front { points = points, title = "cost" }:find("cost", 1, true))
  end)

  it("keeps the peaks of long series, and accepts gaps, constants and single points", function()
    local time, values, flat = {}, {}, {}
    for i = 1, 100000 do time[i], values[i], flat[i] = i * 1e-3, 0, 5 end
    values[54321], values[2] = 1000, 0 / 0
    local data = { time = time, columns = { { name = "f", unit = "N", values = values },
      { name = "c", unit = "m", values = flat }, { name = "none", unit = "J", values = { 0 / 0 } } } }
    data.columns[3].values = {}
    for i = 1, 100000 do data.columns[3].values[i] = 0 / 0 end
    chart.series { series = data, path = folder .. "/a.svg" }
    local text = shown(folder .. "/a.svg")
    assert.truthy(text:find("1000", 1, true))
    assert.is_nil(text:find("none", 1, true))
    assert.is_true(#sink.read_file(folder .. "/a.svg") < 300000)
    assert.error_matches(function() chart.series { series = data, columns = { "none" } } end, "finite value")
    chart.series { path = folder .. "/b.svg",
      series = { time = { 1 }, columns = { { name = "f", values = { 2 } } } } }
    assert.error_matches(function() chart.series { series = data, columns = { "nix" } } end,
      "no series named nix")
  end)

  it("finds the Pareto front", function()
    local front = chart.pareto(points)
    assert.same({ points[1], points[2] }, front)
    assert.same({}, chart.pareto { { x = 1, failed = true } })
    local same = { { x = 1, y = 2 }, { x = 1, y = 1 }, { x = 2, y = 1 } }
    assert.same({ same[2] }, chart.pareto(same))
  end)

  it("draws cost and error", function()
    chart.front { points = points, path = folder .. "/f.svg", xlabel = "time [s]", ylabel = "error_1 [m]",
      title = "it's" }
    local text = shown(folder .. "/f.svg")
    local names = { "time [s]", "error_1 [m]", "Pareto front", "failed", "h_1", "diverged", "rod" }
    for _, expected in ipairs(names) do
      assert.truthy(text:find(expected, 1, true), expected)
    end
    chart.front { points = { { x = 1, failed = true } }, path = folder .. "/g.svg" }
    assert.error_matches(function() chart.front { points = { { x = 1, y = 0 } } } end,
      "point 1: y = 0 cannot stand on a logarithmic axis")
    assert.error_matches(function() chart.front { points = {} } end, "points are expected")
  end)

  it("draws maps", function()
    local map = { rows = { "rod", awkward }, columns = { "Euler", "RK4" }, title = "step",
      values = { { 1.0, 250.0 }, { nil, 0.5 } } }
    assert.equal("step\n" .. string.rep(" ", #awkward - 1) .. "  Euler    RK4\n"
      .. string.rep(" ", #awkward - 4) .. "rod   1.00    250\n" .. awkward .. "      -  0.500\n",
      (chart.map(map)))
    map.path = folder .. "/m.svg"
    chart.map(map)
    local text = shown(map.path)
    for _, expected in ipairs { "rod", "Euler", "RK4", "250", "0.500", "step", "100 % &lt;" } do
      assert.truthy(text:find(expected, 1, true), expected)
    end
    assert.error_matches(function() chart.map { rows = { "a" }, columns = { "b" }, values = {} } end,
      "row a")
  end)

  it("names the package if gnuplot is missing", function()
    files.without_programs(function()
      assert.has_error(function() chart.front { points = points, path = folder .. "/x.svg" } end,
        "a chart needs the program gnuplot, which is not installed: apt-get install gnuplot-nox")
    end)
    assert.same({}, files.list(folder))
  end)

  it("gives path and reason of an error, and leaves no files", function()
    assert.has_error(function() chart.front { points = points, path = folder .. "/no/x.svg" } end,
      "cannot write " .. folder .. "/no/x.svg: No such file or directory")
    assert.error_matches(function() chart.front { points = points, path = folder .. "/x.gif" } end,
      "ends in none")
    assert.error_matches(function()
      chart.front { points = points, path = folder .. "/x.svg", size = { 0, 0 } }
    end, "gnuplot failed")
    assert.same({}, files.list(folder))
  end)
end)
