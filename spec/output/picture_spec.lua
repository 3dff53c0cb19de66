-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pictures without a display or other programs, and films. The places of things in a picture are compared
-- with the projection of what was drawn.
local core = require "softworld.core"
local files = require "spec.output.files"
local picture = require "softworld.output.picture"
local scene = require "spec.output.scene"
local scale = require "softworld.output.scale"
local sink = require "softworld.output.sink"
local sw = require "softworld"
local view = require "softworld.output.view"

-- A camera straight above the origin: x to the right, y up; 1 m at the origin is half the picture.
local function from_above()
  return { at = { 0, 0, 4 }, forward = { 0, 0, -1 }, right = { 1, 0, 0 }, up = { 0, 1, 0 }, sky = { 0, 0, 1 },
    tx = 0.5, ty = 0.5, middle = { 0, 0, 0 } }
end

local size = 200 -- [px]

local function shown(drawing, technique)
  local canvas = core.canvas(size, size)
  canvas:show(drawing, from_above(), technique or "shaded", 0, 0, size, size)
  return canvas
end

-- Red, green and blue of the pixel at a point of the plane z = 0.
local function dot(canvas, x, y)
  local column, row = math.floor(size * (0.5 + x / 4)), math.floor(size * (0.5 - y / 4))
  return canvas:rgb():byte(3 * (size * row + column) + 1, 3 * (size * row + column) + 3)
end

local square = { { -0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0 }, { 0, 1, 2, 0, 2, 3 } }
local function add_square(drawing, at, colour)
  drawing:mesh(square[1], square[2], at, { 1, 0, 0, 0 }, colour, 0)
end

local function is_red(r, g, b) return r > 1.5 * g and r > 1.5 * b end
local function is_green(r, g, b) return g > 1.5 * r and g > 1.5 * b end

describe("a drawing", function()
  it("shows things in their places, nearer ones in front, in either order of drawing", function()
    for _, first in ipairs { 1, 2 } do
      local drawing = core.drawing()
      for k = 1, 2 do
        if k == first then add_square(drawing, { 0, 0, 0 }, { 1, 0.1, 0.1 })
        else drawing:balls({ 0.3, 0, 0.5 }, 0.15, { 0.1, 1, 0.1 }, 0) end
      end
      local canvas = shown(drawing)
      assert.is_true(is_red(dot(canvas, -0.4, 0)))
      assert.is_true(is_green(dot(canvas, 0.3 * 4 / 3.5, 0))) -- 0.5 m nearer to a camera 4 m away
      for _, out in ipairs { { 0.56, 0 }, { -0.56, 0 }, { 0, 0.56 }, { 0, -0.56 } } do
        local r, g, b = dot(canvas, out[1], out[2])
        assert.is_true(math.min(r, g, b) > 200, ("%d %d %d"):format(r, g, b)) -- the background
      end
    end
  end)

  it("draws tubes in their width, shaded as round", function()
    local drawing = core.drawing()
    drawing:tube({ -1, 0, 0, 0, 0, 0, 1, 0, 0 }, 0.2, { 1, 0.1, 0.1 }, 0)
    local canvas = shown(drawing)
    for _, y in ipairs { 0, 0.17, -0.17 } do assert.is_true(is_red(dot(canvas, 0.5, y))) end
    for _, y in ipairs { 0.24, -0.24 } do assert.is_false(is_red(dot(canvas, 0.5, y))) end
    local middle, low = dot(canvas, 0.5, -0.03), dot(canvas, 0.5, 0.17)
    assert.is_true(middle > low + 30, "the side that is turned from the light is not darker")
  end)

  it("has shadows", function()
    local function light(with)
      local drawing = core.drawing()
      drawing:floor({ 0, 0, 0 }, { 0, 0, 1 }, 100, 50, { 0.8, 0.8, 0.8 }) -- one square
      add_square(drawing, { 1.4, 1.4, 0.01 }, { 0.5, 0.5, 0.5 }) -- keeps the lamp the same in both
      add_square(drawing, { -1.4, -1.4, 1 }, { 0.5, 0.5, 0.5 })
      if with then drawing:balls({ 0, 0, 0.6 }, 0.2, { 1, 1, 1 }, 0) end
      return shown(drawing):rgb()
    end
    local bare, dark, lit = light(false), light(true), 0
    for i = 1, #bare, 3 do
      if dark:byte(i) < 0.8 * bare:byte(i) and dark:byte(i) > 60 then lit = lit + 1 end
    end
    local ball = math.pi * (0.2 * size / 4) ^ 2 -- its own pixels
    assert.is_true(lit > 0.7 * ball and lit < 4 * ball, lit)
  end)

  it("interpolates colours between points", function()
    local drawing = core.drawing()
    drawing:tube({ -1, 0, 0, 1, 0, 0 }, 0.2, { 1, 0, 0, 0, 1, 0 }, 0)
    local canvas = shown(drawing)
    assert.is_true(is_red(dot(canvas, -0.9, 0)))
    assert.is_true(is_green(dot(canvas, 0.9, 0)))
    local r, g = dot(canvas, 0, 0)
    assert.is_true(math.abs(r - g) < 30)
  end)

  it("shows edges and lines, and hidden ones pale", function()
    local drawing = core.drawing()
    add_square(drawing, { 0, 0, 1 }, { 0, 0, 0 })
    drawing:lines({ -1.5, 0, 0, 1.5, 0, 0 }, { 1, 0, 0 })
    local canvas = shown(drawing, "wireframe")
    local function reddest(x)
      local most = 0
      for k = -3, 3 do
        local r, g = dot(canvas, x, 4 * k / size)
        most = math.max(most, r - g)
      end
      return most
    end
    assert.is_true(reddest(-1) > 150)
    assert.is_true(reddest(0) > 15 and reddest(0) < 80, reddest(0)) -- behind the square
    local dark = 255
    for k = -3, 3 do dark = math.min(dark, (dot(canvas, 0.5 * 4 / 3 + 4 * k / size, 0.3))) end
    assert.is_true(dark < 130, dark) -- the edge of the square
    local inside = { dot(canvas, 0.3, 0.3) }
    assert.same({ 255, 255, 255 }, inside)
  end)

  it("refuses numbers that are not finite, and corners that do not exist", function()
    local drawing = core.drawing()
    local none = { 1, 0, 0 }
    assert.error_matches(function() drawing:tube({ 0, 0, 0, 0 / 0, 0, 0 }, 1, none) end, "not finite")
    assert.error_matches(function() drawing:balls({ 0, 0, 1 / 0 }, 1, none) end, "not finite")
    assert.error_matches(function() drawing:lines({ 0, 0, 0, 0, 0, 0 / 0 }, none) end, "not finite")
    for _, corner in ipairs { 4, -1, 1e30, 0 / 0 } do
      assert.error_matches(function()
        drawing:mesh(square[1], { 0, 1, corner }, { 0, 0, 0 }, { 1, 0, 0, 0 }, none, 0)
      end, "out of range")
    end
    local canvas = core.canvas(10, 10)
    assert.error_matches(function()
      canvas:show(drawing, from_above(), "shaded", 5, 0, 6, 10)
    end, "out of range")
    assert.error_matches(function() core.canvas(0, 10) end, "out of range")
    assert.error_matches(function() core.canvas(16384, 16384) end, "out of range")
    canvas:fill(8, 8, 100, 100, none) -- what leaves the canvas is cut off
    canvas:text("a long text with \255 bytes", -5, 200, 30, none)
    canvas:text("a long text", 2, 9, 30, none)
  end)

  it("frees all its memory, also when memory runs out", function()
    local function draw()
      local drawing = core.drawing()
      add_square(drawing, { 0, 0, 0 }, { 1, 0, 0 })
      drawing:tube({ -1, 0, 0, 1, 0, 0 }, 0.2, { 1, 0, 0, 0, 1, 0 }, 0)
      drawing:balls({ 0, 0, 0.6 }, 0.2, { 1, 1, 1 }, 0)
      drawing:lines({ -1.5, 0, 0, 1.5, 0, 0 }, { 1, 0, 0 })
      local canvas = core.canvas(20, 20)
      canvas:show(drawing, from_above(), "shaded", 0, 0, 20, 20)
      canvas:show(drawing, from_above(), "wireframe", 0, 0, 20, 20)
      return canvas:png(), drawing:svg(from_above(), "shaded", 20, 20)
    end
    draw()
    collectgarbage()
    collectgarbage()
    local before, done, failures = core.allocated(), false, 0
    for k = 1, 200 do
      core.fail_allocation(k)
      local fine, why = pcall(draw)
      core.fail_allocation(0)
      if fine then done = true break end
      failures = failures + 1
      assert.truthy(tostring(why):find("memory", 1, true), why)
    end
    assert.is_true(done and failures > 20, failures)
    collectgarbage()
    collectgarbage()
    assert.equal(before, (core.allocated()))
  end)
end)

describe("a canvas", function()
  it("writes PNG files that other programs read back pixel by pixel", function()
    local folder = files.folder()
    local canvas = core.canvas(37, 23)
    for k = 0, 22 do canvas:fill(k, k, 9, 3, { k / 23, 1 - k / 23, 0.3 }) end
    canvas:text("µ 12", 2, 20, 14, { 0, 0, 0 })
    sink.write_file(folder .. "/a.png", canvas:png())
    local fine, why = sink.run(("ffmpeg -loglevel error -y -i %s -f rawvideo -pix_fmt rgb24 %s"):format(
      sink.quote(folder .. "/a.png"), sink.quote(folder .. "/a.raw")))
    assert.is_true(fine, why)
    assert.is_true(canvas:rgb() == sink.read_file(folder .. "/a.raw"))
    files.remove(folder)
  end)

  it("writes letters, and gives their width", function()
    local canvas = core.canvas(100, 30)
    local long = canvas:text("III", 10, 22, 20, { 0, 0, 0 })
    assert.near(core.text_width("III", 20), long, 1e-12)
    assert.near(3 * core.text_width("I", 20), long, 1e-9)
    assert.is_true(core.text_width("WWW", 20) > 2 * long)
    local rgb, first, last = canvas:rgb(), nil, nil
    for x = 0, 99 do
      if rgb:byte(3 * (100 * 15 + x) + 1) < 128 then first, last = first or x, x end
    end
    assert.is_true(first >= 10 and first < 14 and last <= 10 + long)
    for x = 0, 99 do assert.equal(255, rgb:byte(3 * (100 * 26 + x) + 1)) end -- below the line
  end)
end)

describe("a scale of colours", function()
  it("goes from the smallest to the largest value; with both signs 0 is in the middle", function()
    local s = scale.new("tension", 0, 4)
    assert.same(s.at(0), s.at(-1))
    assert.same(s.at(4), s.at(5))
    assert.is_true(s.at(0)[3] > s.at(0)[1] and s.at(4)[1] > s.at(4)[3]) -- blue, red
    s = scale.new("tension", -1, 4)
    assert.same({ -4, 4 }, { s.low, s.high })
    local middle = s.at(0)
    assert.is_true(math.abs(middle[1] - middle[3]) < 0.1)
    assert.equal("4 N", s.text(4))
    assert.equal("12.5 mN", s.text(0.0125))
  end)
end)

describe("pictures", function()
  local folder, run, wire
  setup(function()
    folder = files.folder()
    local s = sw.scene { name = "a <b> & \"c's\"" }
    s:obstacle { shape = "plane" }
    s:obstacle { shape = "box", size = { 0.05, 0.2, 0.05 }, at = { 0.2, 0, 0.025 } }
    wire = s:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0.2 }, to = { 0.4, 0, 0.2 },
      segments = 20 }
    s:clamp(wire, { s = 0 })
    run = s:run { duration = 0.3, dt = 0.005 }
  end)
  teardown(function() files.remove(folder) end)

  it("have the requested size, in each technique", function()
    for _, technique in ipairs { "shaded", "particles", "wireframe" } do
      local result = run:picture { path = folder .. "/it's \"a\".png", technique = technique, width = 320,
        height = 240, t = 0.1 }
      assert.same({ result.width, result.height }, { files.png_size(result.path) })
      assert.is_true(math.abs(result.width - 320) <= 2 and math.abs(result.height - 240) <= 2)
      local lines = run:picture { path = folder .. "/a.svg", technique = technique, colour = "curvature" }
      local text = sink.read_file(lines.path)
      assert.truthy(text:find("^<svg ") and text:find("</svg>\n$"))
      assert.truthy(text:find("Curvature", 1, true))
      assert.is_nil(text:find("nan", 1, true) or text:find("inf", 1, true))
      local _, opened = text:gsub("<g[ >]", "")
      local _, closed = text:gsub("</g>", "")
      assert.equal(opened, closed)
    end
    assert.same({ "a.svg", "it's \"a\".png" }, files.list(folder))
  end)

  it("have the wire where the camera sees its nodes", function()
    local path = folder .. "/w.svg"
    run:picture { path = path, width = 600, height = 400, thickness = 1, t = 0.3,
      camera = { from = { 0.2, -1.5, 0.2 }, to = { 0.2, 0, 0.1 } } }
    local text = sink.read_file(path)
    local width, height = text:match '<svg x="10" y="10" width="(%d+)" height="(%d+)"'
    local camera = view.camera({ gravity = { 0, 0, -9.81 }, frames = {}, obstacles = {} }, width / height,
      { from = { 0.2, -1.5, 0.2 }, to = { 0.2, 0, 0.1 } })
    local tip = run.scene:frame(run.scene:frame_count()).wires[1]
    local x, y = view.project(camera, { table.unpack(tip, #tip - 2) })
    local wanted = { (1 + x) * width / 2, (1 - y) * height / 2 }
    local nearest = math.huge
    for a, b in text:gmatch "L(%-?[%d.]+) (%-?[%d.]+)" do
      nearest = math.min(nearest, math.sqrt((a - wanted[1]) ^ 2 + (b - wanted[2]) ^ 2))
    end
    assert.is_true(nearest < 0.3, nearest)
  end)

  it("have one scale for all times: the scale of the run, or the requested one", function()
    local a = run:picture { path = folder .. "/a.png", t = 0, colour = "curvature", width = 200 }
    local b = run:picture { path = folder .. "/a.png", t = 0.3, colour = "curvature", width = 200 }
    assert.same({ a.low, a.high }, { b.low, b.high })
    local most = 0
    for i = 1, run.scene:frame_count() do
      for _, k in ipairs(run.scene:frame(i).values[1].curvature) do most = math.max(most, k) end
    end
    assert.near(most, a.high, 1e-9)
    b = run:picture { path = folder .. "/a.png", colour = "curvature", range = { 1, 5 }, width = 200 }
    assert.same({ 1, 5 }, { b.low, b.high })
  end)

  it("of a scene show its present state and leave it unchanged", function()
    local before, frames = run.scene:snapshot(), run.scene:frame_count()
    local x = wire:positions()
    local result = run.scene:picture { path = folder .. "/now.png", width = 300, colour = "stress" }
    assert.is_true(result.high > 0)
    assert.equal(frames, run.scene:frame_count())
    assert.same(x, wire:positions())
    before:close()
    local fresh = sw.scene {}
    local w = fresh:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    fresh:picture { path = folder .. "/now.svg" }
    w:remodel { model = "string" } -- it can still be changed
    assert.equal(0, fresh:frame_count())
  end)

  it("never change the results of a run", function()
    local function tip(look)
      local s = sw.scene {}
      local w = s:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0.2 }, to = { 0.4, 0, 0.2 } }
      s:clamp(w, { s = 0 })
      for _ = 1, 3 do
        s:run { duration = 0.05, dt = 0.005 }
        if look then s:picture { path = folder .. "/now.png", width = 100 } end
      end
      return w:position(0.4)
    end
    assert.same(tip(false), tip(true))
  end)

  it("leave out points that are not numbers, and say when nothing is left", function()
    local made = scene.run { frames = 3 }
    made.range = function() return 0, 1 end
    made.frames[3].wires[1][5] = 0 / 0
    local result = picture.write(made, { path = folder .. "/n.png", width = 200 })
    assert.equal(200, result.width)
    for _, frame in ipairs(made.frames) do frame.wires[1][5] = 0 / 0 end
    assert.error_matches(function() picture.write(made, { path = folder .. "/n.png" }) end,
      "no frame with finite coordinates")
  end)

  it("refuse wrong arguments by name, and leave no files", function()
    local list = files.list(folder)
    local function refuses(given, text, method)
      local fine, why = pcall(run[method or "picture"], run, given)
      assert.is_false(fine)
      assert.truthy(tostring(why):find(text, 1, true), why)
    end
    refuses({ path = folder .. "/x.jpg" }, "ends in none of .png .svg")
    refuses({ path = folder .. "/no/x.png" }, "No such file or directory")
    refuses({ path = folder .. "/x.png", colour = "tensoin" }, "did you mean 'tension'?")
    refuses({ path = folder .. "/x.png", technique = "shade" }, "did you mean 'shaded'?")
    refuses({ path = folder .. "/x.png", t = 1, count = 2 }, "t and count do not go together")
    refuses({ path = folder .. "/x.png", times = {} }, "times is empty")
    refuses({ path = folder .. "/x.png", range = { 1, 0 }, colour = "tension" }, "range must be")
    refuses({ path = folder .. "/x.png", camera = { form = { 1, 1, 1 } } }, "did you mean 'from'?")
    refuses({ path = folder .. "/x.png", width = 8192, height = 8192 }, "25 million")
    refuses({ path = folder .. "/x.png", technique = "raytraced", colour = "tension" }, "shaded")
    os.execute("ln -s /dev/full " .. sink.quote(folder .. "/full.png"))
    refuses({ path = folder .. "/full.png" }, "No space left on device")
    os.remove(folder .. "/full.png")
    local bare = sw.scene {}
    bare:wire { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local none = bare:run { duration = 0.01, dt = 0.01, frames = false }
    assert.error_matches(function() none:picture { path = folder .. "/x.png" } end, "has no frames")
    assert.error_matches(function() none:film(folder .. "/x.webm") end, "has no frames")
    assert.same(list, files.list(folder))
  end)

  it("show a failed run up to its end", function()
    local s = sw.scene {}
    s:clamp(s:wire { E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1 },
      to = { 0.5, 0, 0.1 } }, { s = 0 })
    local failed = s:run { duration = 1, dt = 1.2 * s:stable_dt(),
      integrator = "velocity-verlet", frame = 0.001,
      unstable = true }
    assert.is_false(failed.ok)
    local result = failed:picture { path = folder .. "/f.png", count = 2, width = 500 }
    assert.truthy(result.note:find("FAILED", 1, true), result.note)
  end)

  it("as films last as long as the run, and less when they are faster", function()
    local function length(path)
      local fine, text = sink.run("ffprobe -v error -show_entries format=duration -of csv=p=0 "
        .. sink.quote(path))
      return fine and tonumber(text) or error(text)
    end
    local slow = run:film(folder .. "/it's.webm", { width = 160, speed = 0.5, progress = false })
    assert.near(0.6, length(slow.path), 0.05)
    local quick = run:film(folder .. "/b.gif", { width = 160, colour = "tension", rate = 20 })
    assert.near(0.3, length(quick.path), 0.06)
    assert.equal(7, quick.frames)
    assert.equal(0, quick.width % 2 + quick.height % 2)
  end)

  it("as films name the missing package, and pass on what ffmpeg complains about", function()
    files.without_programs(function()
      assert.error_matches(function() run:film(folder .. "/m.gif") end, "apt%-get install ffmpeg")
    end)
    local list = files.list(folder)
    assert.error_matches(function() run:film(folder .. "/no/m.gif", { width = 100 }) end, "No such file")
    assert.error_matches(function() run:film(folder .. "/m.mp4") end, "ends in none of .webm .gif")
    assert.error_matches(function() run:film(folder .. "/m.gif", { speed = 1e-9 }) end, "too many")
    os.execute("mkdir " .. sink.quote(folder .. "/dir.gif"))
    assert.error_matches(function() run:film(folder .. "/dir.gif", { width = 100 }) end, "Is a directory")
    os.remove(folder .. "/dir.gif")
    assert.same(list, files.list(folder))
  end)
end)

describe("pictures side by side", function()
  it("are three in a row, and four in two rows of two", function()
    local looks = require "softworld.output.looks"
    for count, columns in pairs { [1] = 1, [2] = 2, [3] = 3, [4] = 2, [5] = 3, [6] = 3 } do
      assert.equal(columns, looks.columns(nil, count))
    end
    assert.equal(4, looks.columns(4, 4))
    assert.equal(2, looks.columns(5, 2))
  end)
end)
