-- SPDX-License-Identifier: GPL-3.0-or-later
local files = require "spec.output.files"
local scene = require "spec.output.scene"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local tools = require "spec.shape.tools"
local vtk = require "softworld.output.vtk"

local tetrahedron = {
  name = 'odd <&"> name', shape = "mesh", vertices = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 },
  indices = { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 },
}

-- The arrays of a .vtp file by name, and the counts of its piece.
local function read_vtp(path)
  local arrays, piece = {}, nil
  for _, element in ipairs(files.xml(sink.read_file(path))) do
    if element.tag == "Piece" then piece = element.at end
    if element.tag == "Lines" or element.tag == "Polys" then arrays.kind = element.tag end
    if element.tag == "DataArray" then
      arrays[(arrays.kind or "") .. element.at.Name] = files.numbers(element.text)
    end
  end
  return arrays, piece
end

describe("vtk", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  it("writes a collection whose files and counts agree", function()
    local run = scene.run { frames = 4 }
    vtk.write(run, folder .. "/lay & co.pvd")
    local sets = {}
    for _, element in ipairs(files.xml(sink.read_file(folder .. "/lay & co.pvd"))) do
      if element.tag == "DataSet" then sets[#sets + 1] = element.at end
    end
    assert.equal(8, #sets) -- wires and obstacles of 4 frames
    for i, set in ipairs(sets) do
      assert.equal(run.frames[(i + 1) // 2].t, tonumber(set.timestep))
      local file = set.file:gsub("&amp;", "&")
      local arrays, piece = read_vtp(folder .. "/" .. file)
      assert.equal(tonumber(piece.NumberOfPoints) * 3, #arrays.Points)
      assert.equal(tonumber(piece.NumberOfLines), #arrays.Linesoffsets)
      assert.equal(tonumber(piece.NumberOfPolys), #arrays.Polysoffsets)
      assert.equal(#arrays.Linesoffsets + #arrays.Polysoffsets, #arrays.object)
      assert.equal(arrays.Linesoffsets[#arrays.Linesoffsets] or 0, #arrays.Linesconnectivity)
      assert.equal(arrays.Polysoffsets[#arrays.Polysoffsets] or 0, #arrays.Polysconnectivity)
    end
    -- obstacles at rest: one file for all frames; no temporary file is left
    assert.same({ "objects.json", "obstacles_00000.vtp", "wires_00000.vtp", "wires_00001.vtp",
      "wires_00002.vtp", "wires_00003.vtp" }, files.list(folder .. "/lay & co.vtk"))
  end)

  it("gives unchanged positions, radius and arc length", function()
    local run = scene.run { frames = 2 }
    vtk.write(run, folder .. "/a.pvd")
    local arrays = read_vtp(folder .. "/a.vtk/wires_00001.vtp")
    assert.same(run.frames[2].wires[1], arrays.Points)
    assert.equal(0.0025, arrays.radius[50])
    assert.equal(0, arrays.s[1])
    assert.near(run.wires[1].length, arrays.s[101], 1e-12)
  end)

  it("writes the surface of a particle mesh as quadrilaterals and two ends", function()
    local run = scene.run { frames = 2 }
    run.wires[2] = { name = "hose", radius = 0.02, length = 0.3 }
    for _, frame in ipairs(run.frames) do
      local surface, line = scene.surface(5, 4, 0.02)
      frame.wires[2], frame.surfaces = line, { false, surface }
    end
    vtk.write(run, folder .. "/a.pvd")
    local arrays, piece = read_vtp(folder .. "/a.vtk/surfaces_00001.vtp")
    assert.equal(20, tonumber(piece.NumberOfPoints))
    assert.equal(3 * 5 + 2, tonumber(piece.NumberOfPolys))
    assert.same(run.frames[2].surfaces[2].points, arrays.Points)
    assert.same(run.frames[2].surfaces[2].force, arrays.contact_force)
    assert.near(0.3, arrays.s[20], 1e-12)
    assert.same({ 0, 1, 6, 5 }, { table.unpack(arrays.Polysconnectivity, 1, 4) })
    assert.equal(3 * 20 + 2 * 5, #arrays.Polysconnectivity)
    for _, object in ipairs(arrays.object) do assert.equal(1, object) end
    local series = sink.read_file(folder .. "/a.pvd")
    assert.equal(2, select(2, series:gsub('part="2"', "")))
    run.frames[2].surfaces[2].points[4] = 0 / 0
    vtk.write(run, folder .. "/b.pvd")
    assert.is_nil(io.open(folder .. "/b.vtk/surfaces_00001.vtp"))
  end)

  it("moves obstacles by their pose, and writes them again when they move", function()
    local run = scene.run { frames = 3 }
    local half = math.sqrt(0.5)
    run.obstacles = { tetrahedron }
    for f, frame in ipairs(run.frames) do
      -- turned by 90 deg about z
      frame.obstacles = { { position = { f < 3 and 1 or 2, 0, 0 }, rotation = { half, 0, 0, half } } }
    end
    vtk.write(run, folder .. "/a.pvd")
    local first = read_vtp(folder .. "/a.vtk/obstacles_00000.vtp")
    local expected = { 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1 }
    for i, x in ipairs(expected) do assert.near(x, first.Points[i], 1e-15) end
    assert.same(tetrahedron.indices, first.Polysconnectivity)
    assert.equal(2, read_vtp(folder .. "/a.vtk/obstacles_00002.vtp").Points[1])
    assert.is_nil(io.open(folder .. "/a.vtk/obstacles_00001.vtp"))
    assert.equal('{"obstacles":["odd <&\\"> name"],"wires":["wire"]}\n',
      sink.read_file(folder .. "/a.vtk/objects.json"))
  end)

  it("gives a wire that is not there neither tension nor bend", function()
    local run, nan = scene.run { frames = 2 }, 0 / 0
    run.series = { time = { run.frames[1].t, run.frames[2].t }, columns = {
      { name = "w.bend_radius", unit = "m", values = { 0.05, nan } },
      { name = "w.tension", unit = "N", values = { 3, nan } },
      { name = "v.bend_radius", unit = "m", values = { math.huge, 0.02 } } } }
    vtk.write(run, folder .. "/a.pvd")
    local first = read_vtp(folder .. "/a.vtk/wires_00000.vtp")
    local second = read_vtp(folder .. "/a.vtk/wires_00001.vtp")
    assert.same({ 0.05 }, first["w.bend_radius"])
    assert.same({ 1e9 }, first["v.bend_radius"]) -- straight
    assert.same({ 1e9 }, second["w.bend_radius"])
    assert.same({ 0 }, second["w.tension"])
    assert.same({ 0.02 }, second["v.bend_radius"])
  end)

  it("leaves out frames that are not finite", function()
    local run = scene.run { frames = 3 }
    run.frames[3].wires[1][7] = 0 / 0
    vtk.write(run, folder .. "/a.pvd")
    assert.is_nil(io.open(folder .. "/a.vtk/wires_00002.vtp"))
    run.frames = { run.frames[3] }
    assert.error_matches(function() vtk.write(run, folder .. "/b.pvd") end, "no frame with finite")
  end)

  it("makes no folder but its own", function()
    local run = scene.run { frames = 2 }
    local function refuses(path, why)
      local fine, text = pcall(vtk.write, run, path)
      assert.is_false(fine)
      assert.equal(("cannot write %s: %s"):format(path, why), text:match "cannot write.*")
    end
    refuses(folder .. "/no/deep/x.pvd", "No such file or directory")
    sink.write_file(folder .. "/file", "")
    refuses(folder .. "/file/x.pvd", "Not a directory")
    assert.same({ "file" }, files.list(folder))
    vtk.write(run, folder .. "/x.pvd")
    assert.same({ "file", "x.pvd", "x.vtk" }, files.list(folder))
  end)

  it("names wrong arguments", function()
    local run = scene.run { frames = 1 }
    assert.error_matches(function() vtk.write(run, folder .. "/a.vtu") end, "does not end in .pvd")
    assert.error_matches(function() vtk.write({}, folder .. "/a.pvd") end, "a run with frames")
    sink.write_file(folder .. "/file", "")
    assert.error_matches(function() vtk.write(run, folder .. "/file/a.pvd") end,
      "cannot write .*/file/a.pvd: Not a directory")
    run.obstacles = { { name = "cone1", shape = "cone" } }
    assert.has_error(function() vtk.write(run, folder .. "/a.pvd") end, "cone1: unknown shape cone")
  end)
end)

describe("solid", function()
  it("makes closed solids of the right volume", function()
    local ball, tube = 4 / 3 * math.pi * 0.1 ^ 3, math.pi * 0.1 ^ 2 * 0.5
    local expected = {
      { { shape = "box", size = { 1, 2, 3 } }, 6, 1e-12 },
      { { shape = "sphere", radius = 0.1 }, ball, 2e-3 },
      { { shape = "capsule", radius = 0.1, length = 0.5 }, ball + tube, 2e-3 },
      { { shape = "cylinder", radius = 0.1, length = 0.5 }, tube, 1e-3 },
      { tetrahedron, 1 / 6, 1e-12 },
    }
    for _, case in ipairs(expected) do
      local shape = solid.triangles(case[1], 128)
      assert.near(case[2], tools.closed_volume(shape), case[2] * case[3])
    end
  end)

  it("closes the surface of a particle mesh, with normals outwards", function()
    local surface = scene.surface(6, 5, 0.02)
    local quads, ends = solid.tube_faces(surface)
    local shape = { vertices = surface.points, indices = {} }
    local function face(a, b, c) table.move({ a, b, c }, 1, 3, #shape.indices + 1, shape.indices) end
    for i = 1, #quads, 4 do
      face(quads[i], quads[i + 1], quads[i + 2])
      face(quads[i], quads[i + 2], quads[i + 3])
    end
    for _, corners in ipairs(ends) do
      for k = 2, #corners - 1 do face(corners[1], corners[k], corners[k + 1]) end
    end
    assert.near(3 * math.sin(math.pi / 3) * 0.02 ^ 2 * 0.4, tools.closed_volume(shape), 1e-12)
  end)

  it("cuts a piece of a plane that lies in the plane", function()
    local pose = { position = { 0, 0, 2 }, rotation = { 1, 0, 0, 0 } }
    local piece = solid.plane_piece({ shape = "plane", normal = { 1, 2, 3 } }, pose, { 5, 6, 7 }, 3)
    for i = 1, 12, 3 do
      local v = piece.vertices
      assert.near(6, v[i] + 2 * v[i + 1] + 3 * v[i + 2], 1e-12)
    end
  end)
end)
