-- SPDX-License-Identifier: GPL-3.0-or-later
local files = require "spec.output.files"
local json = require "softworld.output.json"
local scene = require "spec.output.scene"
local series = require "softworld.output.series"
local sink = require "softworld.output.sink"

-- A reader of JSON, just good enough to check the writer.
local function parse(text)
  local chunk = text:gsub('"([^"]*)":', '["%1"]='):gsub("%[(%-?[%d%[])", "{%1"):gsub("null", "false")
  chunk = chunk:gsub("=%[", "={"):gsub("%]([,}\n])", "}%1")
  return assert(load("return " .. chunk))()
end

describe("series", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  local function lines_of(path)
    local lines = {}
    for line in io.lines(path) do lines[#lines + 1] = line end
    return lines
  end

  it("writes a CSV that reads back to the same numbers", function()
    local run = scene.run { frames = 2 }
    local path = series.csv(run, folder .. "/a.csv")
    local lines = lines_of(path)
    assert.equal("t [s],left.force [N],energy.kinetic [J]", lines[1])
    assert.equal(#run.series.time + 1, #lines)
    for i = 2, #lines do
      local t, force, energy = lines[i]:match("^([^,]*),([^,]*),([^,]*)$")
      assert.equal(run.series.time[i - 1], tonumber(t))
      assert.equal(run.series.columns[1].values[i - 1], tonumber(force))
      assert.equal(run.series.columns[2].values[i - 1], tonumber(energy))
    end
    assert.same({ "a.csv" }, files.list(folder))
  end)

  it("quotes awkward names and writes values that are not finite", function()
    local data = {
      time = { 0.0, 0.5 },
      columns = {
        { name = 'a,"b" µ\n%d', unit = "N m", values = { 0 / 0, 1 / 0 } },
        { name = "n", values = { 1, -2 } },
      },
    }
    local text = sink.read_file(series.write(data, folder .. "/b.CSV")) -- a line end would split rows
    assert.equal('t [s],"a,""b"" µ %d [N m]",n\n0,nan,1\n0.5,inf,-2\n', text)
  end)

  it("writes JSON with units", function()
    local run = scene.run { frames = 2 }
    run.series.columns[1].values[2] = 0 / 0
    local text = sink.read_file(series.write(run, folder .. "/a.json"))
    local document = parse(text)
    assert.equal("laying", document.name)
    assert.is_true(document.ok)
    assert.equal("s", document.time.unit)
    assert.same(run.series.time, document.time.values)
    assert.equal("N", document.columns[1].unit)
    assert.is_false(document.columns[1].values[2]) -- null
    assert.same(run.series.columns[2].values, document.columns[2].values)
  end)

  it("rejects columns of another length and other extensions", function()
    local data = { time = { 0, 1 }, columns = { { name = "f", values = { 1 } } } }
    assert.has_error(function() series.csv(data, folder .. "/c.csv") end,
      "series: column f has 1 value for 2 times")
    assert.error_matches(function() series.write({ time = {}, columns = {} }, "a.txt") end,
      "neither in .csv nor")
    assert.error_matches(function() series.csv({}, folder .. "/c.csv") end, "a run with time series")
    assert.same({}, files.list(folder))
  end)

  it("names the missing folder", function()
    local data = { time = {}, columns = {} }
    assert.has_error(function() series.json(data, folder .. "/no/c.json") end,
      "cannot write " .. folder .. "/no/c.json: No such file or directory")
  end)
end)

describe("series derived from others", function()
  it("average over a time for any step sizes, and keep gaps", function()
    -- The mean of a straight line over a centred window is the line itself; the mean of a step is a ramp.
    local time, line, jump = {}, {}, {}
    for i = 1, 201 do
      time[i] = ((i - 1) / 200) ^ 1.5 -- uneven steps
      line[i], jump[i] = 3 * time[i] - 1, time[i] < 0.5 and 0 or 1
    end
    local smooth = series.mean({ time = time, columns = {
      { name = "line", unit = "N", values = line }, { name = "jump", unit = "N", values = jump } } }, 0.1)
    for i, t in ipairs(time) do
      if t > 0.06 and t < 0.94 then
        assert.is_true(math.abs(smooth.columns[1].values[i] - line[i]) < 0.02)
        local ramp = math.max(0, math.min(1, (t - 0.45) / 0.1))
        assert.is_true(math.abs(smooth.columns[2].values[i] - ramp) < 0.1)
      end
    end
    local gap = series.mean({ time = { 0, 1, 2, 3, 4 }, columns = {
      { name = "gap", unit = "N", values = { 1, 1, 0 / 0, 5, 5 } } } }, 2).columns[1].values
    assert.equal(1, gap[1])
    assert.is_true(gap[3] ~= gap[3])
    assert.equal(5, gap[5])
    assert.error_matches(function() series.mean({ time = {}, columns = {} }, 0) end,
      "mean = 0 is not allowed")
  end)

  it("take the energies from the frames", function()
    local data = series.energy { frames = {
      { t = 0, energy = { kinetic = 1, elastic = 2, gravity = -3 } },
      { t = 0.5, energy = { kinetic = 4, elastic = 5, gravity = -7 } } } }
    assert.same({ 0, 0.5 }, data.time)
    assert.same({ 1, 4 }, data.columns[1].values)
    assert.same({ 4, 0 }, data.columns[3].values) -- measured from the lowest
    assert.error_matches(function() series.energy { frames = { { t = 0 } } } end, "hold no energies")
  end)
end)

describe("json", function()
  it("encodes values", function()
    assert.equal('{"a":[1,2.5,null,true],"b":{},"c":[],"d":null}',
      json.encode { a = { 1, 2.5, 0 / 0, true }, b = json.object {}, c = {}, d = 1 / 0 })
    assert.equal('"q\\" \\\\ \\n \\u0001 \\u007f µ %"', json.encode 'q" \\ \n \1 \127 µ %')
    assert.equal('"\195\191"', json.encode "\255") -- not UTF-8, so it is read as Latin-1
  end)

  it("rejects values that JSON cannot hold", function()
    assert.error_matches(function() json.encode(print) end, "a function cannot")
    assert.error_matches(function() json.encode { [1.5] = 2 } end, "a key of type number")
    assert.error_matches(function() json.encode { 1, a = 2 } end, "both")
    local loop = {}
    loop[1] = loop
    assert.error_matches(function() json.encode(loop) end, "contains itself")
  end)
end)
