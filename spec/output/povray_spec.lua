-- SPDX-License-Identifier: GPL-3.0-or-later
local files = require "spec.output.files"
local povray = require "softworld.output.povray"
local povscene = require "softworld.output.povscene"
local scene = require "spec.output.scene"
local sink = require "softworld.output.sink"
local view = require "softworld.output.view"

local function each_point(run, visit)
  for _, frame in ipairs(run.frames) do
    for _, flat in ipairs(frame.wires) do
      for i = 1, #flat, 3 do visit { flat[i], flat[i + 1], flat[i + 2] } end
    end
  end
end

describe("view", function()
  it("fits everything into the picture, centred and close to its edges", function()
    for _, aspect in ipairs { 0.5, 1, 1.5, 3 } do
      local run = scene.run { frames = 5 }
      local camera = view.camera(run, aspect)
      local low, high = { 1, 1 }, { -1, -1 }
      local function see(point)
        local x, y, ahead = view.project(camera, point)
        assert.is_true(ahead > 0)
        low[1], high[1] = math.min(low[1], x), math.max(high[1], x)
        low[2], high[2] = math.min(low[2], y), math.max(high[2], y)
      end
      each_point(run, see)
      for _, x in ipairs { 0.4, 0.9, 1.4 } do
        for _, y in ipairs { -0.5, 0.5 } do
          for _, z in ipairs { 0, 0.1 } do see { x + 0.005, y, z } end
        end
      end
      local wide, tall = high[1] - low[1], high[2] - low[2]
      assert.is_true(math.max(-low[1], high[1], -low[2], high[2]) <= 1)
      assert.is_true(math.max(wide, tall) > 1.7)
      assert.is_true(math.abs(high[2] + low[2]) < 0.1)
    end
  end)

  it("is right-handed in space: x goes right, y goes away, z goes up", function()
    local camera = view.camera(scene.run { frames = 3 }, 1.5)
    local x0, y0, d0 = view.project(camera, { 0, 0, 0 })
    local x1 = view.project(camera, { 1, 0, 0 })
    local _, y1 = view.project(camera, { 0, 0, 0.1 })
    local _, _, d1 = view.project(camera, { 0, 1, 0 })
    assert.is_true(x1 > x0)
    assert.is_true(y1 > y0)
    assert.is_true(d1 > d0)
    local r, u, f = camera.right, camera.up, camera.forward
    assert.near(u[3], r[1] * f[2] - r[2] * f[1], 1e-12) -- right x forward = up
  end)

  it("handles gravity, no gravity and the script's own camera", function()
    local run = scene.run { frames = 1 }
    run.gravity = { 0, 9.81, 0 }
    assert.same({ 0, -1, 0 }, view.up(run))
    run.gravity = { 0, 0, 0 }
    assert.same({ 0, 0, 1 }, view.up(run))
    local camera = view.camera(run, 1, { from = { 0, 0, 5 }, to = { 0, 0, 0 } }) -- straight down
    assert.same({ 0, 0, 5 }, camera.at)
    local x, y = view.project(camera, { 0, 0, 0 })
    assert.near(0, x, 1e-12)
    assert.near(0, y, 1e-12)
    assert.error_matches(function() view.camera(run, 1, { from = { 0, 0, 0 }, to = { 0, 0, 0 } }) end,
      "no direction")
  end)
end)

-- Makes a strip; returns its result, the frames of its pictures, and the texts of the scenes by file name.
local function watched(options)
  local text, write, frames, written = povscene.text, sink.write_file, {}, {}
  povscene.text = function(run, frame, look)
    frames[#frames + 1] = frame
    return text(run, frame, look) .. "// picture " .. #frames .. "\n"
  end
  sink.write_file = function(path, given)
    written[path:match "[^/]*$"] = given
    return write(path, given)
  end
  local ok, result = pcall(povray.strip, options)
  povscene.text, sink.write_file = text, write
  assert(ok, result)
  return result, frames, written
end

describe("povray", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  it("renders a strip of six in the requested size and leaves no other files", function()
    local path = folder .. "/it's a \"strip\" µ.png"
    local result = povray.strip {
      run = scene.run { frames = 13 }, path = path, width = 460, height = 300, draft = true,
    }
    assert.equal(path, result.path)
    local width, height = files.png_size(path)
    assert.same({ result.width, result.height }, { width, height })
    assert.is_true(math.abs(width - 460) < 6 and math.abs(height - 300) < 6)
    assert.is_true(result.thickness > 1)
    local times = string.format("wire drawn %g times", result.thickness)
    assert.truthy(result.note:find(times, 1, true))
    assert.truthy(result.note:find("squares of 200 mm", 1, true))
    assert.same({ path:match("[^/]*$") }, files.list(folder))
  end)

  it("shows the wire in each picture", function()
    local run = scene.run { frames = 2 }
    povray.picture { run = run, frame = 1, path = folder .. "/with.png", size = { 200, 160 }, draft = true }
    run.wires[1].color = { 0, 1, 0 }
    povray.picture { run = run, frame = 1, path = folder .. "/green.png", size = { 200, 160 }, draft = true }
    assert.are_not.equal(sink.read_file(folder .. "/with.png"), sink.read_file(folder .. "/green.png"))
    assert.same({ 200, 160 }, { files.png_size(folder .. "/with.png") })
  end)

  it("renders every shape, several wires and open grips", function()
    local run = scene.run { frames = 1 }
    local frame = run.frames[1]
    run.obstacles = {
      { shape = "plane" }, { shape = "sphere", radius = 0.1 },
      { shape = "capsule", radius = 0.1, length = 0.2 }, { shape = "cylinder", radius = 0.1, length = 0.2 },
      { shape = "box", size = { 1, 0.1, 0.1 }, color = { 1, 0, 0 } },
      { shape = "hull", vertices = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 },
        indices = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 } },
    }
    frame.obstacles = {}
    run.wires[2], frame.wires[2] = { radius = 0.01 }, { 0, 0, 0.1, 0, 0, 0.1, 0.3, 0, 0.2 }
    frame.grips[1].held = false
    local result = povray.picture {
      run = run, path = folder .. "/a.png", size = { 120, 100 }, draft = true, caption = 'awkward "\\" µ',
    }
    assert.same({ 120, 100 }, { result.width, result.height })
  end)

  it("never uses sphere sweeps, and leaves out planes seen from behind", function()
    local run = scene.run { frames = 1 }
    local look = { camera = view.camera(run, 1.5), size = 2, thickness = 1, smallest_grip = 0 }
    local text = povscene.text(run, run.frames[1], look)
    assert.is_nil(text:find("sphere_sweep", 1, true))
    local _, cylinders = text:gsub("cylinder {", "")
    assert.equal(run.wires[1].segments + 1, cylinders) -- and one for the gripper's stem
    assert.truthy(text:find("plane {", 1, true))
    run.obstacles[1].normal = { 0, 0, -1 }
    assert.is_nil(povscene.text(run, run.frames[1], look):find("plane {", 1, true))
  end)

  it("draws the surface of a mesh of particles", function()
    local run = scene.run { frames = 1 }
    local surface, line = scene.surface(8, 6, 0.02)
    run.wires[1].radius, run.frames[1].wires[1], run.frames[1].surfaces = 0.02, line, { surface }
    local look = { camera = view.camera(run, 1.5), size = 2, thickness = 1, smallest_grip = 0 }
    local text = povscene.text(run, run.frames[1], look)
    assert.truthy(text:find("mesh2 {\nvertex_vectors { 66,", 1, true)) -- 6 x 8, and two ends of 9
    assert.truthy(text:find("face_indices { 96,", 1, true)) -- 2 x 5 x 8, and twice 8
    assert.is_nil(text:find("sphere {", 1, true))
    look.thickness = 2 -- further from the centreline
    text = povscene.text(run, run.frames[1], look)
    assert.truthy(text:find("<0,0.04,0.05>", 1, true))
    povray.picture { run = run, path = folder .. "/a.png", size = { 120, 100 }, draft = true }
    assert.same({ 120, 100 }, { files.png_size(folder .. "/a.png") })
  end)

  it("chooses round sizes for the squares of the table", function()
    assert.near(0.2, povscene.square(3.4), 1e-15)
    assert.near(0.05, povscene.square(1), 1e-15)
    assert.near(0.001, povscene.square(0.014), 1e-15)
  end)

  it("takes the frames nearest to the given times, with their captions", function()
    local run = scene.run { frames = 9 }
    local t4 = run.frames[4].t
    local shot, frames, written = watched { run = run, path = folder .. "/t.png", draft = true, width = 400,
      columns = 2, times = { run.frames[1].t, t4 - 0.3, t4 + 0.3, 1e9 }, captions = { "first", "then" } }
    assert.equal(4, #frames)
    for k, number in ipairs { 1, 4, 4, 9 } do
      assert.equal(run.frames[number], frames[k])
      assert.truthy(written["f" .. k .. ".pov"]:find("// picture " .. k .. "\n", 1, true))
    end
    local captions = {}
    for picture, words in written["sheet.pov"]:gmatch 'png "(.-)%.png".-text { internal 2 "(.-)"' do
      captions[#captions + 1] = picture .. " " .. words
    end
    assert.same({ "f1 t = 0.00 s: first", "f2 t = 1.88 s: then", "f3 t = 1.88 s", "f4 t = 5.00 s" }, captions)
    assert.equal(400 // 10, shot.width // 10)
    assert.same({ "t.png" }, files.list(folder))
  end)

  it("names the package if povray is missing", function()
    files.without_programs(function()
      local run = scene.run { frames = 2 }
      assert.has_error(function() povray.strip { run = run, path = folder .. "/x.png" } end,
        "a strip of pictures needs the program povray, which is not installed: apt-get install povray")
    end)
    assert.same({}, files.list(folder))
  end)

  it("names wrong arguments, and leaves no files", function()
    local run = scene.run { frames = 2 }
    assert.error_matches(function() povray.strip { run = run, path = folder .. "/x.jpg" } end,
      "does not end in .png")
    assert.error_matches(function() povray.strip { path = folder .. "/x.png" } end, "run = a run")
    assert.has_error(function() povray.strip { run = run, path = folder .. "/no/x.png", draft = true } end,
      "cannot write " .. folder .. "/no/x.png: No such file or directory")
    assert.error_matches(function() povray.picture { run = run, frame = 9, path = folder .. "/x.png" } end,
      "no frame 9 of 2")
    run.wires[1].radius = "wide"
    assert.error(function() povray.picture { run = run, path = folder .. "/x.png" } end)
    assert.same({}, files.list(folder))
  end)
end)
