-- SPDX-License-Identifier: GPL-3.0-or-later
-- Charts, VTK files and pictures of a run with many kinds of objects.
local files = require "spec.output.files"
local povscene = require "softworld.output.povscene"
local sink = require "softworld.output.sink"
local sw = require "softworld"

local folder, run, wire, ball

local function build()
  local scene = sw.scene{ name = "day" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  ball = scene:obstacle{ name = "ball", shape = "sphere", radius = 0.05, at = { 0.25, 0, 0.05 } }
  wire = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1025 },
    to = { 0.5, 0, 0.1025 } }
  scene:clamp(wire, { s = 0, name = "a clamp with quite a long name indeed" })
  scene:pin(wire, { s = 0.5 })
  scene:clip{ name = "c1", at = { 0.4, 0.2, 0.03 }, width = 0.01, insertion = 5, retention = 9 }
  local other = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 20,
    from = { 0, 0.2, 0.03 }, to = { 0.5, 0.2, 0.03 } }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(other, { s = 0.1 })
    hand:move{ by = { 0, 0, 0.05 }, duration = 0.5 }
    p:wait(0.1)
  end)
  return scene:run{ dt = 0.01, frame = 0.05, integrator = "implicit-euler" }
end

setup(function()
  folder = files.folder()
  run = build()
  assert.is_true(run.ok)
end)
teardown(function() files.remove(folder) end)

-- The names in the keys of an SVG with their positions, and the size of the drawing.
local function keys_of(path)
  local text, list = sink.read_file(path), {}
  local key = 'translate%(([%d.]+),([%d.]+)%)"[^>]*text%-anchor="start">%s*<text>([^<]*)<'
  for x, y, name in text:gmatch(key) do
    list[#list + 1] = { x = tonumber(x), y = tonumber(y), name = name }
  end
  local width, height = text:match 'width="(%d+)" height="(%d+)"'
  return list, tonumber(width), tonumber(height)
end

describe("a chart of all series", function()
  it("names every curve that it draws, within the edges of the drawing", function()
    run:chart{ path = folder .. "/all.svg" }
    local keys, width, height = keys_of(folder .. "/all.svg")
    local found = {}
    for _, key in ipairs(keys) do
      found[key.name] = true
      assert.is_true(key.x + 6.5 * #key.name < width, key.name)
      assert.is_true(key.y < height)
    end
    for _, name in ipairs{ "hand.force", "hand.moment", "table.contact_force", "ball.contact_force",
      "c1.force", "wire1.tension", "wire1.bend_radius", "wire2.bend_radius",
      "a clamp with quite a long name indeed.force" } do
      assert.is_true(found[name], name)
    end
    assert.is_nil(found["hand.force_x"]) -- with so many curves, components are drawn only on request
  end)

  it("grows with the number of named curves", function()
    local names = {}
    for _, c in ipairs(run:series().columns) do
      if c.unit == "N" then names[#names + 1] = c.name end
    end
    assert.is_true(#names > 15)
    run:chart{ path = folder .. "/forces.svg", columns = names }
    local keys, _, height = keys_of(folder .. "/forces.svg")
    local rows, lowest = {}, 0
    for _, key in ipairs(keys) do
      rows[key.name], lowest = key.y, math.max(lowest, key.y)
    end
    for _, name in ipairs(names) do assert.truthy(rows[name], name) end
    assert.is_true(lowest < height - 60)
    local first = keys[1].x
    for _, key in ipairs(keys) do assert.near(first, key.x, 1) end -- a single column
  end)

  it("leaves out the bend radii of almost straight wire", function()
    run:chart{ path = folder .. "/bends.svg", columns = { "wire1.bend_radius" } }
    assert.truthy(sink.read_file(folder .. "/bends.svg"):find("wire1.bend_radius [m]", 1, true))
  end)
end)

describe("VTK files", function()
  local function arrays_of(path)
    local arrays, fields, inside = {}, {}, false
    for _, element in ipairs(files.xml(sink.read_file(path))) do
      if element.tag == "FieldData" then inside = true end
      if element.tag == "Piece" then inside = false end
      if element.tag == "DataArray" then
        (inside and fields or arrays)[element.at.Name] = files.numbers(element.text)
      end
    end
    return arrays, fields
  end

  it("have tension, bend radius and contact force at each node, and the series as field data", function()
    run:vtk(folder .. "/day.pvd")
    local frames = run:frames()
    local arrays, fields = arrays_of(("%s/day.vtk/wires_%05d.vtp"):format(folder, #frames - 1))
    for _, name in ipairs{ "tension", "bend_radius", "contact_force" } do
      assert.are.equal(42, #arrays[name], name)
    end
    local pressed, tight, tension = 0, math.huge, -math.huge
    for i = 1, 21 do
      pressed = pressed + arrays.contact_force[i]
      tight = math.min(tight, arrays.bend_radius[i])
      tension = math.max(tension, arrays.tension[i])
    end
    local f = ball:force()
    local length = (f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2) ^ 0.5
    assert.is_true(length > 0.01)
    assert.near(length, pressed, 0.05 * length)
    assert.near(wire:min_bend_radius{ now = true }, tight, 0.02 * tight)
    assert.near(wire:max_tension{ now = true }, tension, 0.2 * math.abs(tension))
    local series = run:series()
    for _, column in ipairs(series.columns) do
      assert.are.equal(1, #fields[column.name], column.name)
      local last = column.values[#series.time]
      if last == last and last < 1e9 then
        assert.near(last, fields[column.name][1], 1e-6 * math.abs(last) + 1e-12)
      end
    end
  end)
  it("of a wire at rest on a table have contact forces that sum to its weight", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local w = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 10, from = { 0, 0, 0.0025 },
      to = { 0.3, 0, 0.0025 } }
    local frames, sum = scene:run{ duration = 1, dt = 0.01, integrator = "implicit-euler" }:frames(), 0
    for _, force in ipairs(frames[#frames].values[1].contact) do sum = sum + force end
    local weight = w.beam.mass_per_length * w.length * 9.81
    assert.near(weight, sum, 0.01 * weight)
  end)
end)

describe("pictures", function()
  it("show clamps, a ball for a pin, and one gripper", function()
    local doc = run:document()
    local camera = { at = { 0, -1, 0.5 }, forward = { 0, 1, 0 }, right = { 1, 0, 0 }, up = { 0, 0, 1 },
      tx = 0.3, ty = 0.2, middle = { 0.2, 0, 0 } }
    local frame = doc.frames[#doc.frames]
    local function text(clamps, grips)
      frame.clamps, frame.grips = clamps, grips
      return povscene.text(doc, frame, { camera = camera, size = 1, thickness = 1, smallest_grip = 0 })
    end
    local clamps, grips = frame.clamps, frame.grips
    assert.are.equal(2, #clamps)
    assert.are.equal(1, #grips)
    local all, without = text(clamps, grips), text({ false, false }, { false })
    local function count(what, where) return select(2, where:gsub(what, "")) end
    assert.are.equal(3 + 3, count("box {", all) - count("box {", without)) -- clamp; jaws and palm
    assert.are.equal(2, count("cylinder {", all) - count("cylinder {", without)) -- axle; stem
    assert.are.equal(1, count("sphere { 0", all) - count("sphere { 0", without))
  end)
end)
