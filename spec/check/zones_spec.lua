-- SPDX-License-Identifier: GPL-3.0-or-later
-- Zones: how near a wire comes to them over a whole motion, and whose temperature it has.
local solid = require "softworld.output.solid"
local sw = require "softworld"
local core = require "softworld.core"

local RADIUS = 0.0015

-- A wire along x that holds carry along z by way(t) in so many steps; zones: a list.
local function carried(zones, options)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local given = { name = "w", cable = not (options and options.EA) and "GXL 1.5" or nil, segments = 16,
    from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
  for key, value in pairs(options or {}) do given[key] = value end
  local steps, points = given.steps or 40, given.points or { { 0, 0, 0 }, { 0, 0, 0.4 }, { 0, 0, 0 } }
  given.steps, given.points = nil, nil
  local wire = scene:wire(given)
  for k = 0, 8 do
    scene:clamp(wire, { s = 0.025 * k }):follow{ points = points, relative = true, duration = 1,
      law = "linear" }
  end
  for _, zone in ipairs(zones) do scene:zone(zone) end
  return scene:run{ duration = 1, dt = 1 / steps, quasistatic = true, frame = 1 }, scene, wire
end

describe("run:check of the clearance", function()
  local post = { name = "post", shape = "sphere", radius = 0.05, at = { 0.1, 0.06, 0.2 } }

  -- Steps of 20 mm: one of them ends where the wire is nearest.
  it("is that of the whole motion, at the end of which the wire is far", function()
    local row = carried{ post }:check{}:row "clearance"
    assert.is_near(0.01 - RADIUS, row.value, 1e-9)
    assert.is_near(0.1, row.s, 1e-6)
    assert.is_near(0.25, row.time, 1e-6)
    assert.same({ "definition", 0 }, { row.from, row.limit })
    assert.truthy(row.note:find("zone 'post'", 1, true), row.note)
  end)

  -- The least of a step is known to half a step's way at most.
  it("knows what passes between steps to within half of their way", function()
    for _, steps in ipairs{ 30, 200, 2000 } do
      local row = carried({ post }, { steps = steps }):check{}:row "clearance"
      local way = 0.8 / steps
      assert.is_true(row.value >= 0.01 - RADIUS - 1e-9 and row.value <= 0.01 - RADIUS + way)
      assert.is_true(row.low <= 0.01 - RADIUS + 1e-9 and row.low >= row.value - way / 2 - 1e-9, row.low)
    end
    local fine = carried({ post }, { steps = 2000 })
    assert.equal("PASS", fine:check{ limits = { clearance = 0.008 } }:row "clearance".verdict)
    assert.equal("FAIL", fine:check{ limits = { clearance = 0.009 } }:row "clearance".verdict)
  end)

  -- A wall of 0.1 mm between two steps of 20 mm: at no step is the wire in it.
  it("does not miss a thin wall that is passed between two steps", function()
    local wall = { name = "wall", shape = "box", size = { 1, 1, 1e-4 }, at = { 0, 0, 0.21 } }
    local check = carried{ wall }:check{}
    local row = check:row "clearance"
    assert.is_true(row.value > 0.005)
    assert.is_true(row.low < 0)
    assert.same({ "OPEN", "OPEN" }, { row.verdict, check.verdict })
    assert.truthy(row.note:find("within steps it may have been", 1, true), row.note)
    row = carried({ wall }, { steps = 1600 }):check{}:row "clearance"
    assert.same({ "FAIL" }, { row.verdict })
    assert.is_true(row.value < 0)
  end)

  it("is met where a wire just reaches the limit, and broken beyond it", function()
    local row = carried({ { shape = "plane", at = { 0, 0, -0.25 } } }, { points = { { 0, 0, 0 },
      { 0, 0, 0.1 } } }):check{ limits = { clearance = 0.25 - RADIUS } }:row "clearance"
    assert.same({ 0.25 - RADIUS, "PASS" }, { row.value, row.verdict })
  end)

  it("sees where the run begins, and begins anew with the next", function()
    local run, scene = carried({ { shape = "sphere", radius = 0.01 } }, { points = { { 0, 0, 0 },
      { 0, 0, 0.4 } } })
    local row = run:check{}:row "clearance"
    assert.same({ "FAIL", 0 }, { row.verdict, row.time })
    row = scene:run{ duration = 0.02, dt = 0.01 }:check{}:row "clearance"
    assert.equal("PASS", row.verdict)
    assert.is_near(0.39 - RADIUS, row.value, 1e-6)
  end)

  it("is kept where the nodes of the wire change on the way", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 10 }
    scene:zone{ shape = "sphere", radius = 0.01, at = { 0.2, 0, 0.1 } }
    local hand = scene:gripper{ name = "hand" }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.2 })
      hand:move{ by = { 0, 0, 0.05 }, duration = 0.5 }
      hand:move{ by = { 0, 0, -0.05 }, duration = 0.5 }
      hand:release()
      p:wait(0.1)
    end)
    local row = scene:run{ dt = 0.01 }:check{}:row "clearance"
    assert.is_near(0.04 - RADIUS, row.value, 1e-3)
    assert.is_near(0.5, row.time, 0.02)
  end)

  it("is that of the particles of a mesh", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    scene:wire{ name = "w", E = 5e6, density = 1200, radius = 0.004, model = "tube", segments = 8,
      from = { 0, 0, 0 }, to = { 0.06, 0, 0 } }
    scene:zone{ shape = "plane", at = { 0, 0, -0.02 } }
    local row = scene:run{ duration = 0.02, dt = 0.01 }:check{}:row "clearance"
    assert.is_near(0.016, row.value, 2e-4)
  end)
end)

describe("run:check of temperatures", function()
  local oven = { name = "oven", shape = "box", size = { 1, 1, 0.1 }, at = { 0, 0, 0.4 } }
  local function zone(temperature)
    local copy = { temperature = temperature }
    for key, value in pairs(oven) do copy[key] = value end
    return copy
  end

  it("judges the zones that a wire was in by its cable's class", function()
    for temperature, verdict in pairs{ [125] = "PASS", [126] = "FAIL" } do
      local row = carried{ zone(temperature) }:check{}:row "max_temperature"
      assert.same({ temperature, 125, "catalogue", verdict }, { row.value, row.limit, row.from, row.verdict })
      -- 0.35 m to 0.4 m and back at 0.8 m/s, to within the two steps
      local inside = tonumber(row.note:match "in it for ([%d.]+) s")
      assert.is_near(0.125, inside, 0.03)
    end
    local row = carried{ zone(-60) }:check{}:row "min_temperature"
    assert.same({ -60, -40, "FAIL" }, { row.value, row.limit, row.verdict })
    row = carried{ zone(-60) }:check{ limits = { min_temperature = -70 } }:row "min_temperature"
    assert.equal("PASS", row.verdict)
  end)

  it("has no row for zones that the wire does not reach, and is open where it may have", function()
    local far = zone(900)
    far.at = { 0, 0, 0.6 }
    local check = carried{ far }:check{}
    assert.has_error(function() check:row "max_temperature" end)
    local thin = zone(900)
    thin.size, thin.at = { 1, 1, 1e-4 }, { 0, 0, 0.21 }
    local row = carried{ thin }:check{}:row "max_temperature"
    assert.same({ 900, "OPEN" }, { row.value, row.verdict })
    local warm = zone(100)
    warm.name = "warm"
    row = carried{ thin, warm }:check{}:row "max_temperature"
    assert.same({ 100, "OPEN" }, { row.value, row.verdict })
  end)

  it("is open for a wire of no cable", function()
    local row = carried({ zone(90) }, { EA = 1e4, EI = 1e-3, mass_per_length = 0.02,
      radius = RADIUS }):check{}:row "max_temperature"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("temperature class", 1, true), row.note)
  end)
end)

describe("scene:zone", function()
  local scene = sw.scene{ name = "z" }

  for words, args in pairs{ ["scene:zone takes one table"] = 3, ["'size'"] =
    { shape = "box", siez = { 1, 1, 1 } },
    ["zone sphere: temperature = -300 degC"] = { shape = "sphere", radius = 1, temperature = -300 },
    ["there is no parameter 'friction'"] = { shape = "sphere", radius = 1, friction = 1 },
    ["'no.stl'"] = { shape = "mesh", file = "no.stl" } } do
    it("refuses " .. words, function()
      local fine, why = pcall(scene.zone, scene, args)
      assert.is_false(fine)
      assert.truthy(why:find(words, 1, true), why)
    end)
  end

  it("gives names, and none twice", function()
    assert.equal("zone1", scene:zone{ shape = "sphere", radius = 0.1 })
    assert.equal("a", scene:zone{ name = "a", shape = "sphere", radius = 0.1 })
    local fine, why = pcall(scene.zone, scene, { name = "a", shape = "sphere", radius = 0.1 })
    assert.is_false(fine)
    assert.truthy(why:find("there is another zone 'a'", 1, true), why)
  end)

  it("goes with a snapshot", function()
    local other = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = other:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    other:zone{ name = "first", shape = "sphere", radius = 0.01, at = { 0, 0, 0.1 } }
    other:run{ duration = 0.02, dt = 0.01 }
    local snapshot = other:snapshot()
    other:zone{ name = "late", shape = "sphere", radius = 0.01, at = { 0, 0, 0.2 } }
    other:run{ duration = 0.02, dt = 0.01 }
    assert.equal(2, #core.zones(wire))
    other:restore(snapshot)
    local zones = core.zones(wire)
    assert.same({ 1, "first" }, { #zones, zones[1].name })
    assert.is_near(0.09 - RADIUS, zones[1].gap, 1e-9)
    assert.equal("PASS", other:run{ duration = 0.02, dt = 0.01 }:check{}:row "clearance".verdict)
    other:zone{ name = "late", shape = "sphere", radius = 0.01 }
  end)

  it("is refused from inside a step", function()
    local other = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = other:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    other:force{ on = wire, kind = function() other:zone{ shape = "sphere", radius = 1 } end }
    assert.has_error(function() other:run{ duration = 0.01, dt = 0.01 } end)
  end)

  it("is in a file and in a script", function()
    local path = os.tmpname()
    local other = sw.scene{ gravity = { 0, 0, 0 } }
    other:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    other:zone{ name = "post", shape = "sphere", radius = 0.01, at = { 0.1, 0, 0.05 } }
    assert.truthy(other:script():find("post", 1, true))
    other:save(path)
    local again = sw.load(path)
    os.remove(path)
    local row = again:run{ duration = 0.02, dt = 0.01 }:check{}:row "clearance"
    assert.is_near(0.04 - RADIUS, row.value, 1e-6)
  end)

  -- Vectors may be told by x, y, z, as everywhere: the ends of the drawn normal are at the pose of the core.
  it("is drawn where it was told to be by names of axes too", function()
    local other = sw.scene{ gravity = { 0, 0, 0 } }
    other:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    other:zone{ shape = "plane", at = { x = 0, y = 0, z = -1 }, normal = { x = 0, y = 3, z = 0 } }
    other:zone{ shape = "box", size = { x = 0.1, y = 0.2, z = 0.3 }, at = { x = 0.1, y = 0, z = 0.5 },
      rotation = { axis = { x = 0, y = 0, z = 2 }, angle = math.pi / 2 } }
    local zones = other:run{ duration = 0.01, dt = 0.01 }:document().zones
    assert.same({ 2, 0, 0, -1 }, { #zones, table.unpack(zones[1].position) })
    for k = 2, 12, 3 do assert.equal(0, zones[1].vertices[k]) end
    assert.is_near(math.sqrt(0.5), zones[2].rotation[4], 1e-15)
    for i, x in ipairs(solid.place(zones[2].vertices, zones[2])) do -- x and y have changed places
      local size, centre = ({ 0.2, 0.1, 0.3 })[(i - 1) % 3 + 1], ({ 0.1, 0, 0.5 })[(i - 1) % 3 + 1]
      assert.is_near(size / 2, math.abs(x - centre), 1e-12)
    end
  end)

  -- Eight corners of the box, at its pose; the others have their triangles.
  it("is drawn where it is, also after a snapshot and from a file", function()
    local path = os.tmpname() .. ".html"
    local other = sw.scene{ gravity = { 0, 0, 0 } }
    other:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    other:zone{ name = "post", shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 0.1, 0, 0.2 },
      rotation = { axis = { 0, 0, 2 }, angle = math.pi / 2 } }
    local snapshot = other:snapshot()
    for i, z in ipairs{ { shape = "plane", at = { 0, 0, -1 } }, { shape = "sphere", radius = 0.02 },
      { shape = "torus", radius = 0.1, tube = 0.01, temperature = 40 },
      { shape = "hull", points = { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 0, 0, 2 } } } } do
      z.name = "zone" .. i
      other:zone(z)
    end
    local zones = other:run{ duration = 0.01, dt = 0.01 }:document().zones
    assert.equal(5, #zones)
    assert.same({ { 0.1, 0, 0.2 }, 36 }, { zones[1].position, #zones[1].indices })
    assert.is_near(math.sqrt(0.5), zones[1].rotation[4], 1e-15)
    for _, z in ipairs(zones) do assert.is_true(#z.vertices >= 12, z.name) end
    assert.same({ 72, 36 }, { #solid.edges(zones[1]), #solid.edges(zones[5]) }) -- 12 and 6 edges
    local picture = path .. ".svg"
    other:picture{ path = picture, technique = "wireframe" }
    other:restore(snapshot)
    local run = other:run{ duration = 0.01, dt = 0.01 }
    assert.equal(1, #run:document().zones)
    run:report(path)
    local file = assert(io.open(path))
    assert.truthy(file:read "a":find('"zones":[{"at":[0.1', 1, true))
    file:close()
    other:save(path)
    assert.equal(1, #sw.load(path):run{ duration = 0.01, dt = 0.01 }:document().zones)
    os.remove(path)
    os.remove(picture)
  end)
end)
