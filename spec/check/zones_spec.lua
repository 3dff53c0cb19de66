-- SPDX-License-Identifier: GPL-3.0-or-later
-- Zones: how close a wire comes to them during a whole motion, and the temperature they give it.
local solid = require "softworld.output.solid"
local sw = require "softworld"
local core = require "softworld.core"

local RADIUS = 0.0015

-- A wire along x. Holds carry it along z by way(t) in a number of steps; zones: a list.
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

  -- Steps of 20 mm; one of them ends where the wire is nearest.
  it("is the least of the whole motion, although the wire ends far away", function()
    local row = carried{ post }:check{}:row "clearance"
    assert.is_near(0.01 - RADIUS, row.value, 1e-9)
    assert.is_near(0.1, row.s, 1e-6)
    assert.is_near(0.25, row.time, 1e-6)
    assert.same({ "definition", 0 }, { row.from, row.limit })
    assert.truthy(row.note:find("zone 'post'", 1, true), row.note)
  end)

  -- Within a step the least distance is known to half the way of the step.
  it("covers what passes between steps, to within half the way of a step", function()
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

  -- A wall of 0.1 mm lies between two steps of 20 mm. The wire is in it at no step.
  it("does not miss a thin wall that the wire passes between two steps", function()
    local wall = { name = "wall", shape = "box", size = { 1, 1, 1e-4 }, at = { 0, 0, 0.21 } }
    local check = carried{ wall }:check{}
    local row = check:row "clearance"
    assert.is_true(row.value > 0.005)
    assert.is_true(row.low < 0)
    assert.same({ "OPEN", "OPEN" }, { row.verdict, check.verdict })
    assert.truthy(row.note:find("between steps it may have been", 1, true), row.note)
    row = carried({ wall }, { steps = 1600 }):check{}:row "clearance"
    assert.same({ "FAIL" }, { row.verdict })
    assert.is_true(row.value < 0)
  end)

  it("passes a wire that just reaches the limit, and fails one beyond it", function()
    local row = carried({ { shape = "plane", at = { 0, 0, -0.25 } } }, { points = { { 0, 0, 0 },
      { 0, 0, 0.1 } } }):check{ limits = { clearance = 0.25 - RADIUS } }:row "clearance"
    assert.same({ 0.25 - RADIUS, "PASS" }, { row.value, row.verdict })
  end)

  it("counts the start of the run, and measures afresh in the next run", function()
    local run, scene = carried({ { shape = "sphere", radius = 0.01 } }, { points = { { 0, 0, 0 },
      { 0, 0, 0.4 } } })
    local row = run:check{}:row "clearance"
    assert.same({ "FAIL", 0 }, { row.verdict, row.time })
    row = scene:run{ duration = 0.02, dt = 0.01 }:check{}:row "clearance"
    assert.equal("PASS", row.verdict)
    assert.is_near(0.39 - RADIUS, row.value, 1e-6)
  end)

  it("is kept when the nodes of the wire change during the run", function()
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

  it("is measured from the particles of a mesh", function()
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

  it("judges the zones that the wire was in against its cable's temperature class", function()
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

  it("has no row for zones that the wire does not reach, and is open where it may have reached "
    .. "one", function()
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

  it("is open for a wire without a cable", function()
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

  it("gives names, and refuses a name that exists", function()
    assert.equal("zone1", scene:zone{ shape = "sphere", radius = 0.1 })
    assert.equal("a", scene:zone{ name = "a", shape = "sphere", radius = 0.1 })
    local fine, why = pcall(scene.zone, scene, { name = "a", shape = "sphere", radius = 0.1 })
    assert.is_false(fine)
    assert.truthy(why:find("there is another zone 'a'", 1, true), why)
  end)

  it("is kept and removed with a snapshot", function()
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

  it("is saved to a file and to a script", function()
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

  -- Vectors may be given by x, y, z, as everywhere. The drawn plane has the pose that the core has.
  it("is drawn in the right place when its vectors name their axes", function()
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

  -- The box has eight corners at its pose; the other shapes have their triangles.
  it("is drawn in the right place, also after a snapshot and from a file", function()
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

-- A sphere or box on an obstacle passes over a wire at rest along x. The wire is held along its whole
-- length; the obstacle is at height 0.05 m.
describe("a zone on an obstacle", function()
  local path = { { 0.1, -0.3, 0.05 }, { 0.1, 0.3, 0.05 } }
  local function passing(shape, steps, turn, made)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 16 }
    for k = 0, 8 do scene:clamp(wire, { s = 0.025 * k }) end
    local hand = scene:obstacle{ name = "hand", shape = "sphere", radius = 0.01, at = path[1] }
    local zone = { name = "guard", at = path[1], on = hand }
    for key, value in pairs(shape) do zone[key] = value end
    scene:zone(zone)
    hand:follow{ points = path, duration = 1, law = "linear", turn = turn }
    if made then made(scene, hand) end
    return scene:run{ duration = 1, dt = 1 / steps, quasistatic = true, frame = 1 / 4 }, scene, hand
  end
  local ball, bar = { shape = "sphere", radius = 0.02 }, { shape = "box", size = { 0.4, 0.02, 0.06 } }
  local spin = { axis = { 1, 0, 0 }, angle = math.pi }

  it("moves with the obstacle", function()
    local row = passing(ball, 40):check{}:row "clearance"
    assert.is_near(0.05 - 0.02 - RADIUS, row.value, 1e-9)
    assert.is_near(0.5, row.time, 1e-9)
    assert.truthy(row.note:find("zone 'guard'", 1, true), row.note)
  end)

  -- Distance of the wire, at y = z = 0, from a bar at (-0.3 + 0.6 t, 0.05) that has turned by pi t about x.
  it("turns with the obstacle, and its least distance within steps is a lower bound", function()
    local least = math.huge
    for i = 0, 100000 do
      local t = i / 100000
      local c, s, y, z = math.cos(math.pi * t), math.sin(math.pi * t), 0.3 - 0.6 * t, -0.05
      local a, b = math.abs(c * y + s * z) - 0.01, math.abs(c * z - s * y) - 0.03
      least = math.min(least, math.sqrt(math.max(a, 0) ^ 2 + math.max(b, 0) ^ 2))
    end
    least = least - RADIUS
    for _, steps in ipairs{ 25, 200, 1600 } do
      local row = passing(bar, steps, spin):check{}:row "clearance"
      print(("measured: %d steps: %.5f, at least %.5f m; by hand %.5f m"):format(steps, row.value, row.low,
        least))
      assert.is_true(row.low <= least + 1e-9 and row.value >= least - 1e-9)
      -- at most half the way of a step: the way of the obstacle and of the turn at the wire's distance from
      -- it
      assert.is_true(row.value - row.low <= 0.5 * (0.6 + 0.31 * math.pi) / steps * 1.2, row.low)
    end
  end)

  -- A wire carried with the zone does not move relative to it, so no way within steps is counted.
  it("counts no motion of a wire that is carried with it", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local hand = scene:obstacle{ name = "hand", shape = "sphere", radius = 0.01, at = { 0.1, 0, 0.05 } }
    scene:zone{ shape = "sphere", radius = 0.02, at = { 0.1, 0, 0.05 }, on = hand }
    local moves = { points = { { 0, 0, 0 }, { 0, 0.4, 0.2 } }, relative = true, duration = 1, law = "linear" }
    for k = 0, 8 do scene:clamp(wire, { s = 0.025 * k }):follow(moves) end
    hand:follow(moves)
    local row = scene:run{ duration = 1, dt = 0.05, quasistatic = true }:check{}:row "clearance"
    assert.is_near(0.03 - RADIUS, row.value, 1e-6)
    assert.is_true((row.low or row.value) > row.value - 1e-6, row.low)
  end)

  it("is removed with the obstacle, and keeps what it measured before", function()
    local run, scene, hand = passing(ball, 40, nil, function(scene, hand)
      scene:process(function(p)
        p:wait(0.25)
        hand:remove()
        p:wait(0.1)
      end)
    end)
    -- at 0.25 s the hand is 0.15 m beside the wire and 0.05 m above
    assert.is_near(math.sqrt(0.15 ^ 2 + 0.05 ^ 2) - 0.02 - RADIUS, run:check{}:row "clearance".value, 1e-6)
    assert.has_error(function() scene:run{ duration = 0.1 }:check{}:row "clearance" end)
    assert.has_error(function() scene:zone{ shape = "sphere", radius = 1, on = hand } end)
  end)

  it("is drawn at the obstacle's pose", function()
    local run = passing(bar, 40, spin)
    local document = run:document()
    local zone = document.zones[1]
    for _, frame in ipairs(document.frames) do
      local pose = solid.carried(zone, frame)
      assert.is_near(-0.3 + 0.6 * frame.t, pose.position[2], 1e-6) -- frames have rounded numbers
      assert.is_near(math.abs(math.cos(math.pi / 2 * frame.t)), math.abs(pose.rotation[1]), 1e-6)
    end
    assert.is_nil(solid.carried(zone, { obstacles = { false } }))
  end)

  it("still moves after a file and after a snapshot", function()
    local file = os.tmpname()
    local _, scene = passing(ball, 40, nil, function(scene) scene:save(file) end)
    assert.truthy(scene:script():find("on = hand", 1, true))
    local again = sw.load(file)
    os.remove(file)
    local snapshot = again:snapshot()
    for _ = 1, 2 do
      local row = again:run{ duration = 1, dt = 1 / 40, quasistatic = true }:check{}:row "clearance"
      assert.is_near(0.05 - 0.02 - RADIUS, row.value, 1e-9)
      again:restore(snapshot)
    end
  end)

  for words, on in pairs{ ["got table"] = {},
    ["on must be an obstacle of the scene (from scene:obstacle), got number 3"] = 3 } do
    it("refuses an invalid obstacle: " .. words, function()
      local scene = sw.scene{}
      local fine, why = pcall(scene.zone, scene, { shape = "sphere", radius = 1, on = on })
      assert.is_false(fine)
      assert.truthy(why:find(words, 1, true), why)
    end)
  end
end)
