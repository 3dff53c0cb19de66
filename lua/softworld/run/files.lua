-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes runs: tables, charts, pictures, files for ParaView. Methods of Run, see softworld.run.run.
-- @module softworld.run.files
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local rows = require "softworld.rows"

local runfiles = { methods = {} }
local Run = runfiles.methods

local camera = rows.list{
  { "from", "vector", "m", "where it stands" },
  { "to", "vector", "m", "point at which it looks" },
  { "direction", "vector", "-", "it looks in" },
  { "turn", "number", "deg", "about the vertical", min = -360, max = 360 },
  { "elevation", "number", "deg", "above the horizon", min = -360, max = 360 },
  { "angle", "number", "deg", "of its view", min = 1, max = 150 },
}

local chart = rows.call("run:chart", "{...}", "draws series over time; needs gnuplot", {
  gives = "the path, or without one the drawing in characters",
  example = 'run:chart { path = "run.svg", columns = { "hand.force" }, mean = 0.02 }',
  { "path", "text", "-", "a .svg, .png or .pdf file", usual = "drawn in characters" },
  { "columns", "names", "-", "of series, see help 'results'", usual = "all" },
  { "energy", "boolean", "-", "draws the energies of the run's frames instead", usual = "false" },
  { "mean", "number", "s", "draws running means over this time instead of samples", min = 0, above = true },
  { "title", "text", "-", "above the chart", empty = true, usual = "the scene's name" },
  { "size", "size", "px", "{ width, height }; of .pdf in inches, without path in characters",
    usual = "as the curves need" },
})

local USUAL = 6 -- pictures of a strip
local pictures = rows.call("run:pictures", "{...}", "a strip of ray-traced pictures; needs POV-Ray", {
  gives = "path, width, height [px], thickness, note",
  example = 'run:pictures { path = "run.png", count = 6 }',
  { "path", "text", "-", "a .png file", required = true },
  { "count", "integer", "-", "moments from the first to the last frame", min = 1, max = 1000, usual = USUAL },
  { "times", "list", "s", "of the moments instead", of = "number", min = 0 },
  { "captions", "list", "-", "words after the times" },
  { "caption", "text", "-", "of a single picture", empty = true },
  { "columns", "integer", "-", "pictures side by side", min = 1, max = 1000, usual = "3, of four 2" },
  { "width", "number", "px", "of the strip", min = 1, usual = 1500 },
  { "height", "number", "px", "of the strip", min = 1, usual = "as the view needs" },
  { "camera", "camera", "-", "'auto' or where it stands", rows = camera, usual = "auto" },
  { "thickness", "number", "-", "times the wires' radius", min = 0, above = true,
    usual = "1, or more to be seen" },
  { "draft", "boolean", "-", "fast and rough", usual = "false" },
  { "threads", "integer", "-", "of POV-Ray", min = 1, max = 1024, usual = 2 },
})

rows.calls{
  { "run:summary", "file", "peaks, means and events, on the terminal or into an open file" },
  { "run:save", "path", "every column at every step, as .csv or .json", "the path" },
  { "run:vtk", "path", "an animation for ParaView, a .pvd file", "the path" },
  { "run:report", "path", "a page that shows the run moving, with charts and numbers: one .html file",
    "the path", example = 'run:report "run.html"' },
  { "run:series", "", "time series", "time [s], columns of name, unit, values" },
  { "run:frames", "", "stored while running", "t [s], wires, obstacles, holds, energy; ..." },
  { "run:document", "", "plain tables of all that charts, pictures and files need" },
  { "run:ledger", "", "the energy balance, see help 'energy'", "J" },
  { "run:error_bars", "", "of the quantities asked for, see help 'tolerance'" },
}

runfiles.camera = camera

--- Raises an error unless the value is a camera: nil, "auto" or a table of its rows.
function runfiles.check_camera(given, what)
  if given == nil or given == "auto" then return end
  if type(given) ~= "table" then
    error(("%s: camera must be 'auto' or a table, got %s"):format(what, checks.got(given)), 0)
  end
  camera:read(given, what .. ": camera", what .. ": camera.")
end

--- Adds frames at times between two stored ones, until the returned value is closed; `numbers`: of these.
-- A wire that has another mesh in the later frame has nothing between: there the nearest frame is drawn, with
-- its own time.
function runfiles.between(self, times)
  local count, numbers = self.scene:frame_count(), {}
  local made = setmetatable({ numbers = numbers }, { __close = function()
    if core.exists(self.scene) then core.drop_frames(self.scene, count) end
  end })
  for _, t in ipairs(times or {}) do numbers[#numbers + 1] = core.add_between(self.scene, t) end
  return made
end

--- Raises an error unless the run has been at these times [s]; nil: no times. The nearest frame would be
-- drawn, with its own time: of a time after the run its last frame, which shows something else.
function runfiles.check_times(self, times, what)
  for k, t in ipairs(times or {}) do
    local name = #times > 1 and ("%s: times[%d]"):format(what, k) or what .. ": the time"
    checks.number(name, t, -math.huge, " s", 0)
    if t > self.time * (1 + 1e-9) + 1e-12 or t < -1e-12 then
      error(("%s = %.9g s is not in the run, which goes from %.9g s to %.9g s"):format(name, t, self.start,
        self.time), 0)
    end
  end
end

--- Raises an error if there are more captions than pictures; count: of these.
function runfiles.check_captions(o, what, count)
  if o.captions and #o.captions > count then
    error(("%s: captions has %d texts for %s"):format(what, #o.captions, counted(count, "picture")), 0)
  end
  if o.caption and count > 1 then
    error(("%s: caption is for one picture, and there are %d; give captions"):format(what, count), 0)
  end
end

-- Checks { width, height }, both above 0.
local function check_size(given)
  if given == nil then return end
  if type(given) ~= "table" then
    error("run:chart: size must be { width, height }, got " .. checks.got(given), 0)
  end
  checks.only("run:chart: size", given, nil, 0)
  for k = 1, 2 do checks.number(("run:chart: size[%d]"):format(k), given[k], 0, "", 0, nil, true) end
end

local function check_names(given)
  if given == nil then return end
  if type(given) == "table" then return checks.only("run:chart: columns", given, nil, 0) end
  error("run:chart: columns must be a list of names of series, got " .. checks.got(given), 0)
end

-- Raises an error if the run has no such results, or has lost them.
local function readable(self, what, even_failed)
  if not self.ok and not even_failed then
    error(("run of '%s' failed %s; it has no %s"):format(self.name, self.reason, what), 3)
  end
  if build.data(self.scene).restores ~= self.restores then
    error(("run of '%s': its %s were lost when a snapshot was restored; read them before you restore it")
      :format(self.name, what), 3)
  end
end

runfiles.readable = readable

local function check_path(path, what, wanted)
  if type(path) == "string" and path ~= "" then return end
  error(("%s expects %s, got %s"):format(what, wanted, path == "" and "''" or type(path)), 3)
end

--- Prints the table of results on the terminal.
function Run:summary(stream)
  if stream ~= nil and io.type(stream) ~= "file" and type(checks.field(stream, "write")) ~= "function" then
    error("run:summary: an open file is wanted, got " .. (io.type(stream) or type(stream)), 2)
  end
  require("softworld.output.summary").print(self:document(), stream or io.stdout)
end

--- Writes the series as CSV or JSON, by the file's extension.
function Run:save(path)
  check_path(path, "run:save", "the name of a .csv or .json file")
  readable(self, "series")
  require("softworld.output.series").write(self:document(), path)
  return path
end

--- Writes a ParaView series (.pvd).
function Run:vtk(path)
  check_path(path, "run:vtk", "the name of a .pvd file")
  readable(self, "frames", true)
  require("softworld.output.vtk").write(runfiles.pictured(self), path)
  return path
end

--- Writes the player: one .html file that needs no network.
function Run:report(path)
  check_path(path, "run:report", "the name of an .html file")
  return require("softworld.output.report").write({ runfiles.described(self) }, path)
end

local several = rows.call("sw.report", "{ run, ..., ... }",
  "writes one page that shows several runs moving, one over the other", {
  gives = "the path", example = 'sw.report { before, after, path = "both.html" }',
  { "path", "text", "-", "an .html file", required = true },
  { "title", "text", "-", "of the page", usual = "the runs' names" },
})

--- Writes several runs to one page: sw.report{ run1, run2, path =, title = }.
function runfiles.report(args)
  if type(args) ~= "table" or getmetatable(args) then
    error("sw.report takes a table such as { run1, run2, path = 'both.html' }, got " .. checks.got(args), 3)
  end
  local named, list = {}, {}
  for key, value in next, args do
    if math.type(key) ~= "integer" then named[key] = value end
  end
  local o = build.call(4, several.read, several, named)
  for i = 1, #args do
    if rawget(getmetatable(args[i]) or {}, "__name") ~= "run" then
      error(("sw.report: [%d] must be a run, got %s"):format(i, checks.got(args[i])), 3)
    end
    list[i] = runfiles.described(args[i])
  end
  if #list == 0 then error("sw.report: give a run, such as { run1, run2, path = 'both.html' }", 3) end
  return build.call(4, require("softworld.output.report").write, list, o.path, { title = o.title })
end

--- Draws a chart of series: { path = "x.svg", columns = { names }, title = }.
function Run:chart(options)
  local o = chart:read(options or {})
  check_size(o.size)
  check_names(o.columns)
  readable(self, "series")
  local length = self.time - self.start
  if o.mean and o.mean > length and length > 0 then
    error(("run:chart: mean = %g s is longer than the run, %.4g s"):format(o.mean, length), 0)
  end
  o.run = self:document()
  return require("softworld.output.chart").series(o)
end

--- Draws a strip of ray-traced pictures: { path = "x.png", count = 6, ... }.
function Run:pictures(options)
  local o = pictures:read(options or {})
  if o.times and o.count then error("run:pictures: times and count do not go together", 0) end
  if o.times and #o.times == 0 then error("run:pictures: times is empty", 0) end
  runfiles.check_captions(o, "run:pictures", o.times and #o.times or o.count or USUAL)
  runfiles.check_camera(o.camera, "run:pictures")
  readable(self, "frames", true)
  runfiles.check_times(self, o.times, "run:pictures")
  local _ <close> = runfiles.between(self, o.times) -- among all frames
  o.run = runfiles.pictured(self)
  return require("softworld.output.povray").strip(o)
end

return runfiles
