-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:picture, run:picture, run:film, run:gltf, run:obj, run:stl: their arguments, and the frames they
-- need.
-- @module softworld.run.pictures
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local rows = require "softworld.rows"
local runfiles = require "softworld.run.files"
local scale = require "softworld.output.scale"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"

local pictures = {}

local techniques = { "particles", "wireframe", "shaded", "raytraced" }
local most_pixels = 8192

-- Returns rows with those that pictures and films share.
local function with_common(list)
  for _, row in ipairs{
    { "technique", "choice", "-", "how; raytraced needs POV-Ray", choices = techniques, usual = "shaded" },
    { "colour", "choice", "-", "quantity that colours the wires", choices = scale.names,
      usual = "one for each wire" },
    { "range", "list", "-", "of the colours: { least, largest }", of = "number", usual = "of all frames" },
    { "camera", "camera", "-", "'auto' or where it stands", rows = runfiles.camera, usual = "auto" },
    { "width", "number", "px", "of the picture", min = 64, max = most_pixels,
      usual = "1080, of several moments 1500" },
    { "height", "number", "px", "of the picture", min = 64, max = most_pixels, usual = "as the view needs" },
    { "thickness", "number", "-", "times the wires' radius", min = 0, above = true,
      max = 1000, usual = "1, or more to be seen" },
  } do list[#list + 1] = row end
  return list
end

local of_scene = rows.call("scene:picture", "{...}", "a picture of the scene as it is now", with_common{
  gives = "path, width, height [px], thickness, note", example = 'scene:picture { path = "now.png" }',
  { "path", "text", "-", "a .png or .svg file", required = true },
  { "caption", "text", "-", "below it", empty = true, usual = "the time" },
})

local of_run = rows.call("run:picture", "{...}", "a picture of a moment of the run, or of several",
  with_common{
  gives = "path, width, height [px], thickness, note",
  example = 'run:picture { path = "run.png", colour = "curvature", count = 3 }',
  { "path", "text", "-", "a .png or .svg file", required = true },
  { "t", "number", "s", "of the moment", usual = "the last one" },
  { "times", "list", "s", "of several moments, side by side", of = "number" },
  { "count", "integer", "-", "number of moments from the first to the last", min = 1, max = 1000, usual = 1 },
  { "columns", "integer", "-", "pictures side by side", min = 1, max = 1000, usual = "3, of four 2" },
  { "captions", "list", "-", "words after the times" },
  { "caption", "text", "-", "of a single picture", empty = true, usual = "its time" },
})

local of_film = rows.call("run:film", "path, {...}", "the run as a film, a .webm or .gif file; needs ffmpeg",
  with_common{
    gives = "path, width, height [px], frames",
    example = 'run:film("run.webm", { colour = "tension" })',
    { "speed", "number", "-", "seconds of the run in one second of the film", min = 1e-9, max = 1e9,
      default = 1 },
    { "rate", "number", "1/s", "pictures a second", min = 1, max = 60, usual = "30, of .gif 15" },
    { "progress", "boolean", "-", "shown while it is made", usual = "on a terminal" },
  })

local of_gltf = rows.call("run:gltf", "path, {...}",
  "the run as a scene that moves, a .glb file for other programs", {
  gives = "the path", example = 'run:gltf "run.glb"',
  { "frames", "integer", "-", "largest number of moments", min = 1, max = 2000, default = 120 },
  { "thickness", "number", "-", "times the wires' radius", min = 0, above = true, max = 1000, default = 1 },
})

local of_moment = { { "t", "number", "s", "of the moment", usual = "the last one" },
  { "thickness", "number", "-", "times the wires' radius", min = 0, above = true, max = 1000, default = 1 } }
local of_obj = rows.call("run:obj", "path, {...}", "the shapes at a moment, an .obj file of triangles", {
  gives = "the path", example = 'run:obj("end.obj", { t = 0.5 })', of_moment[1], of_moment[2] })
local of_stl = rows.call("run:stl", "path, {...}", "the shapes at a moment, an .stl file of triangles", {
  gives = "the path", example = 'run:stl("end.stl", { t = 0.5 })', of_moment[1], of_moment[2] })

-- --- checks -------------------------------------------------------------------------------

local function check(o, what)
  runfiles.check_camera(o.camera, what)
  local range = o.range
  if range and not (#range == 2 and range[1] <= range[2]) then
    error(what .. ": range must be { least, largest }: two numbers, the smaller one first", 0)
  end
  if range and not o.colour then error(what .. ": range goes with colour only", 0) end
  for _, name in ipairs { "width", "height" } do
    if o[name] then o[name] = math.floor(o[name]) end
  end
end

local alone = { "t", "times", "count" }

local function check_moments(o)
  local given
  for _, name in ipairs(alone) do
    if o[name] ~= nil and given then
      error(("run:picture: %s and %s do not go together"):format(given, name), 0)
    end
    given = o[name] ~= nil and name or given
  end
  if o.times and #o.times == 0 then error("run:picture: times is empty", 0) end
end

-- --- which frames ---------------------------------------------------------------------------

local many = 40 -- frames of a run that the camera considers

-- Returns the number of the frame nearest to a time.
local function nearest(times, t)
  local low, high = 1, #times
  while high - low > 1 do
    local middle = (low + high) // 2
    if times[middle] <= t then low = middle else high = middle end
  end
  return #times > 0 and math.abs(times[high] - t) < math.abs(times[low] - t) and high or low
end

-- Returns the numbers of the wanted frames, of some of all for the camera, and of those where grippers grasp
-- and let go.
local function numbers_of(self, times, wanted)
  local set, total = {}, #times
  local function add(k) if k >= 1 and k <= total then set[k] = true end end
  for _, k in ipairs(wanted) do
    for near = k - 1, k + 1 do add(near) end
  end
  for k = 0, many - 1 do add(1 + math.floor(k * (total - 1) / (many - 1) + 0.5)) end
  for _, gripper in ipairs(build.data(self.scene).grippers) do
    for _, span in ipairs(gripper.spans) do
      for _, t in ipairs { span.from, span.to, span.carried } do
        for near = -1, 1 do add(nearest(times, t) + near) end
      end
    end
  end
  return checks.sorted(set)
end

-- Returns the times of the wanted moments; for a run that failed, the last ones.
local function times_of(self, times, o)
  if o.t then return { o.t } end
  if o.times or #times == 0 then return o.times or {} end
  local list, count, total = {}, math.min(o.count or 1, #times), #times
  for k = 1, count do
    local at = self.ok and math.floor(1 + (k - 1) * (total - 1) / math.max(count - 1, 1) + 0.5)
      or total - count + k
    list[k] = times[count == 1 and total or at]
  end
  return list
end

local function joined(a, b) return table.move(b, 1, #b, #a + 1, a) end

local function moments(self, times, wanted, between)
  local numbers = {}
  for k, t in ipairs(wanted) do numbers[k] = nearest(times, t) end
  local doc = runfiles.moments(self, joined(numbers_of(self, times, numbers), between.numbers))
  function doc.range(quantity) return core.frame_range(self.scene, quantity) end
  return doc
end

-- Returns a function for the range of values in the frame itself, for a scene without a run.
local function own_range(doc)
  return function(quantity)
    local low, high
    for _, wire in ipairs(doc.frames[1].values or {}) do
      for _, x in ipairs(wire[quantity]) do
        if x == x and math.abs(x) < math.huge then
          low, high = math.min(low or x, x), math.max(high or x, x)
        end
      end
    end
    return low, high
  end
end

-- --- methods ----------------------------------------------------------------------------------

local function traced(doc, o)
  if o.colour then
    error("a ray-traced picture has no colours by quantity; use technique = 'shaded'", 0)
  end
  o.run = doc
  if not o.times then
    o.size = { o.width or 1200, o.height or 800 }
    return require("softworld.output.povray").picture(o)
  end
  return require("softworld.output.povray").strip(o)
end

local function draw(doc, o)
  if o.technique == "raytraced" then return traced(doc, o) end
  return require("softworld.output.picture").write(doc, o)
end

local function name_of(scene) return scene.name end

local function picture_of_scene(scene, args)
  if core.type(scene) ~= "scene" then error("scene:picture is a method: call it with a colon", 0) end
  name_of(scene) -- raises if the scene is closed
  local o = of_scene:read(args or {})
  check(o, "scene:picture")
  local doc = runfiles.present(scene)
  doc.range = own_range(doc)
  return draw(doc, o)
end

local function picture_of_run(self, args)
  local o = of_run:read(args or {})
  check(o, "run:picture")
  check_moments(o)
  runfiles.readable(self, "frames", true)
  runfiles.check_times(self, o.times or { o.t }, "run:picture")
  local times = core.frame_times(self.scene)
  o.times, o.t, o.count = times_of(self, times, o), nil, nil
  runfiles.check_captions(o, "run:picture", math.max(1, #o.times))
  local between <close> = runfiles.between(self, o.times)
  return draw(moments(self, times, o.times, between), o)
end

--- scene:picture{ path =, technique =, colour =, camera =, ... }
pictures.picture = build.placed(function(self, args)
  if core.type(self) then return picture_of_scene(self, args) end
  return picture_of_run(self, args)
end)

--- run:film(path, { speed =, rate =, colour =, ... })
pictures.film = build.placed(function(self, path, args)
  if type(path) ~= "string" or path == "" then
    error("run:film expects the name of a .webm or .gif file, got " .. (path == "" and "''" or type(path)), 0)
  end
  local o = of_film:read(args or {})
  check(o, "run:film")
  if o.technique == "raytraced" then error("run:film: technique = 'raytraced' would take hours", 0) end
  runfiles.readable(self, "frames", true)
  local kind = sink.extension(path)
  if kind ~= "webm" and kind ~= "gif" then
    sink.fail("a film: %s ends in none of .webm .gif", path)
  end
  o.path = path
  local doc = runfiles.moments(self)
  function doc.range(quantity) return core.frame_range(self.scene, quantity) end
  return require("softworld.output.film").write(doc, o)
end)

-- --- exchange -----------------------------------------------------------------------------------

-- Returns what exchange files need: frames, the scene, and the numbers of its wires, from 0.
local function exchanged(self, numbers)
  local doc = runfiles.moments(self, numbers)
  if #doc.frames == 0 then
    error(("the run of '%s' has no frames, %s"):format(self.name, doc.none), 0)
  end
  doc = solid.finite_run(doc)
  for _, kind in ipairs { "wires", "particles" } do
    for _, shown in ipairs(doc[kind]) do
      if shown.edges then shown.corners = solid.enclosed(shown.edges) end
    end
  end
  doc.scene = self.scene
  return doc
end

local function check_path(path, what, kind)
  if type(path) == "string" and path ~= "" then return end
  error(("%s expects the name of a .%s file, got %s"):format(what, kind, path == "" and "''" or type(path)),
    0)
end

--- run:gltf(path, { frames =, thickness = })
pictures.gltf = build.placed(function(self, path, args)
  check_path(path, "run:gltf", "glb")
  local o = of_gltf:read(args or {})
  runfiles.readable(self, "frames", true)
  local total, numbers = self.scene:frame_count(), {}
  local count = math.min(o.frames, total)
  for k = 1, count do
    numbers[k] = count == 1 and total or 1 + math.floor((k - 1) * (total - 1) / (count - 1) + 0.5)
  end
  return require("softworld.output.gltf").write(exchanged(self, numbers), path, o)
end)

local function of_one(kind, list)
  return build.placed(function(self, path, args)
    check_path(path, "run:" .. kind, kind)
    local o = list:read(args or {})
    runfiles.readable(self, "frames", true)
    runfiles.check_times(self, { o.t }, "run:" .. kind)
    local times, numbers = core.frame_times(self.scene), {}
    o.t = o.t or times[#times] or 0
    local between <close> = runfiles.between(self, { o.t })
    if #times > 0 then
      numbers = joined(numbers_of(self, times, { nearest(times, o.t) }), between.numbers)
    end
    return require("softworld.output.triangles").write(exchanged(self, numbers), path, kind, o)
  end)
end

--- run:obj(path, { t =, thickness = }), run:stl the same.
pictures.obj, pictures.stl = of_one("obj", of_obj), of_one("stl", of_stl)

return pictures
