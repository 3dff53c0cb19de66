-- SPDX-License-Identifier: GPL-3.0-or-later
-- Frames: their values and their bounded memory. Films: the values read back, within the quantisation of a
-- track.
local sw = require "softworld"
local core = require "softworld.core"
local film = require "spec.film.film"

-- A gripper draws a wire over an edge; obstacles press on the wire.
local function laying(options)
  local scene = sw.scene { name = "film" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:obstacle { name = "wall", shape = "box", size = { 0.02, 1, 0.1 }, at = { 0.25, 0, 0.05 } }
  local wire = scene:wire { E = 50e6, density = 1500, radius = 0.0025, segments = 40,
    from = { 0, 0, 0.0025 }, to = { -0.6, 0, 0.0025 } }
  local hand = scene:gripper { name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.03 })
    hand:move { by = { 0.1, 0, 0.15 }, speed = 0.4 }
    hand:move { by = { 0.4, 0.1, -0.05 }, speed = 0.4 }
    hand:release()
    p:wait(0.3)
  end)
  local args = { dt = 0.005, frame = 0.02 }
  for key, value in pairs(options or {}) do args[key] = value end
  local run = scene:run(args)
  assert(run.ok, run.reason)
  return scene, run, wire, hand
end

local function largest(list)
  local most = 0
  for _, x in ipairs(list) do most = math.max(most, math.abs(x)) end
  return most
end

describe("frames", function()
  it("hold the same values as the wire gives at its nodes", function()
    local scene, _, wire = laying()
    scene:run { duration = 0.02, dt = 0.005, frame = 0.005 } -- every step: the last frame is the present
    local values = scene:frame(scene:frame_count()).values[1]
    local arc = film.track(film.read((core.film(scene, 0, 1e9, true))), "value", 0, 8).frames
    arc = arc[#arc]
    assert.equal(#arc, #values.tension)
    for i, s in pairs{ [1] = 0, [#arc] = wire.length } do
      assert.near(wire:tension(s), values.tension[i], 1e-6)
    end
    for i = 2, #arc - 1 do
      local s = arc[i]
      -- arc lengths are rounded to 0.6 m / 2^20, which is 4e-5 of an edge
      assert.near(wire:curvature(s), values.curvature[i], 1e-4 * largest(values.curvature))
      assert.near(wire:tension(s), values.tension[i], 1e-4 * largest(values.tension))
      local stress = values.tension[i] / (math.pi * 0.0025 ^ 2) + 50e6 * 0.0025 * values.curvature[i]
      assert.near(stress, values.stress[i], 1e-5 * largest(values.stress))
    end
  end)

  it("hold the forces of obstacles and holds: the forces on wire and obstacles balance", function()
    local scene = laying()
    local seen = 0
    local read = film.read((core.film(scene, -math.huge, math.huge, true)))
    local nodes = film.track(read, "value", 0, 5)
    for f = 1, #read.times do
      local frame, sum = scene:frame(f), { 0, 0, 0 }
      for i, x in ipairs(nodes.frames[f]) do sum[(i - 1) % 3 + 1] = sum[(i - 1) % 3 + 1] + x end
      local on = frame.obstacles
      for k = 1, 3 do
        local others = on[1].force[k] + on[2].force[k]
        -- only calm frames count: impacts within a step are in its mean force, but not in the forces of the
        -- state
        if math.abs(sum[k] + others) < 0.02 then seen = seen + 1 end
      end
    end
    assert.is_true(seen > 0.9 * 3 * #read.times)
    local held = scene:frame(10).holds[1]
    assert.is_true(held.held and held.force[3] > 0.01)
  end)

  it("hold the twist moment of a rod", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local wire = scene:wire { E = 1e8, density = 1500, radius = 2e-3, from = { 0, 0, 0 },
      to = { 0.5, 0, 0 }, segments = 20, model = "rod" }
    scene:clamp(wire, { s = 0 })
    local far = scene:clamp(wire, { s = 0.5 })
    far:follow { points = { { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = 1 }, duration = 0.1,
      relative = true }
    scene:run { duration = 0.2, dt = 0.01, frame = 0.05 }
    local twist = scene:frame(scene:frame_count()).values[1].twist_moment
    local expected = wire:twist_moment(0.25)
    assert.is_true(math.abs(expected) > 1e-4)
    for i = 2, #twist - 1 do assert.near(expected, twist[i], 1e-6 * math.abs(expected)) end
  end)

  it("are thinned evenly when their memory is full, and the summary says so", function()
    local scene, run = laying { frame = 0.005, frames = { memory = 60e3 } }
    local count = scene:frame_count()
    local stride = core.frames_thinned(scene)
    assert.is_true(stride >= 4)
    -- a frame: 41 nodes, or two more, of 3 + 9 floats
    assert.is_true(count * 41 * 12 * 4 < 60e3 and count >= 3)
    for i = 2, count - 1 do -- the last one is that of the end
      -- steps of 5 ms end where the process continues; a frame is stored at the first step that reaches its
      -- time
      assert.near(0.005 * stride, scene:frame(i).t - scene:frame(i - 1).t, 0.005)
    end
    local text = {}
    run:summary { write = function(_, line) text[#text + 1] = line end }
    assert.truthy(table.concat(text):find("one of this many is kept", 1, true))
  end)

  it("are not stored when switched off, and the results keep every bit", function()
    local scene, run = laying { frames = false }
    local _, other = laying()
    assert.equal(0, scene:frame_count())
    local a, b = run:series(), other:series()
    assert.same(a.time, b.time)
    for c, column in ipairs(a.columns) do
      for i, x in ipairs(column.values) do
        local y = b.columns[c].values[i]
        assert.is_true(x == y or x ~= x and y ~= y)
      end
    end
  end)

  it("go back with a snapshot, thinned or not", function()
    local scene = sw.scene {}
    scene:wire { E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
    scene:run { duration = 0.2, dt = 0.01, frame = 0.01 }
    local snapshot, before = scene:snapshot(), scene:frame_count()
    scene:run { duration = 0.2, dt = 0.01, frame = 0.01 }
    scene:restore(snapshot)
    assert.equal(before, scene:frame_count())
    scene:run { duration = 0.4, dt = 0.01, frame = 0.01, frames = { memory = 1e5 } }
    assert.equal(2, core.frames_thinned(scene))
    scene:restore(snapshot)
    assert.equal((before + 1) // 2, scene:frame_count())
    assert.is_true(scene:frame(scene:frame_count()).t <= 0.2 + 1e-9)
  end)

  it("refuse an invalid memory limit", function()
    local scene = sw.scene {}
    scene:wire { E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    for given, told in pairs { [{ memory = 10 }] = "memory", [{ memry = 1e6 }] = "did you mean 'memory'",
      [{ memory = 0 / 0 }] = "memory", [7] = "must be a table", yes = "must be a table" } do
      local ok, text = pcall(scene.run, scene, { duration = 0.1, frames = given })
      assert.is_false(ok)
      assert.truthy(text:find(told, 1, true), text)
    end
    assert.is_true(scene:run { duration = 0.1, frames = true }.ok)
    assert.is_true(scene:frame_count() > 1)
  end)
end)

describe("a film", function()
  it("gives positions back within a thousandth of the radius, at every frame", function()
    local scene = laying()
    local packed, frames, broken = core.film(scene, -math.huge, math.huge, true)
    local read = film.read(packed)
    assert.equal(scene:frame_count(), frames)
    assert.equal(0, broken)
    local places = film.track(read, "wire", 0)
    local worst = { 0, 0 } -- in the first and in the second half of the frames
    for f = 1, frames do
      local frame = scene:frame(f)
      assert.equal(frame.t, read.times[f])
      assert.equal(#frame.wires[1], #places.frames[f])
      local half = f <= frames // 2 and 1 or 2
      for i, x in ipairs(frame.wires[1]) do
        worst[half] = math.max(worst[half], math.abs(x - places.frames[f][i]))
      end
    end
    -- half a step of rounding: the errors of differences between frames do not add up
    for _, error_of in ipairs(worst) do assert.is_true(error_of <= 0.5e-3 * 0.0025 * (1 + 1e-6)) end
    assert.is_true(worst[1] > 0)
  end)

  it("gives values back within their range over 4095, and poses and arc lengths", function()
    local scene = laying()
    local read = film.read((core.film(scene, -math.huge, math.huge, true)))
    local names = { "tension", "curvature", "contact", "twist_moment", "stress" }
    for channel, name in ipairs(names) do
      local track = film.track(read, "value", 0, channel - 1)
      local low, high, worst = math.huge, -math.huge, 0
      for f = 1, #read.times do
        for i, x in ipairs(scene:frame(f).values[1][name]) do
          low, high = math.min(low, x), math.max(high, x)
          worst = math.max(worst, math.abs(x - track.frames[f][i]))
        end
      end
      assert.is_true(worst <= 0.5 * (high - low) / 4095 * (1 + 1e-6), name)
      if name ~= "twist_moment" then assert.is_true(high > low, name) end
    end
    local arc = film.track(read, "value", 0, 8).frames[1]
    assert.near(0.6, arc[#arc], 1e-6)
    assert.near(0.3, arc[#arc // 2 + 1], 0.02)
    for f = 1, #read.times do
      local there = scene:frame(f).holds[1]
      local place, turn = film.track(read, "hold", 0).frames[f], film.track(read, "hold", 0, 1).frames[f]
      assert.equal(there.held and 3 or 0, #place)
      for k = 1, #place do assert.near(there.position[k], place[k], 1.3e-6) end
      for k = 1, #turn do assert.near(there.rotation[k], turn[k], 5e-7) end
    end
  end)

  it("has the surface of a mesh", function()
    local scene = sw.scene {}
    scene:obstacle { shape = "plane" }
    local wire = scene:wire { E = 5e6, density = 1200, radius = 0.005, from = { 0, 0, 0.006 },
      to = { 0.1, 0, 0.006 }, model = "tube", ring_radius = 0.0045 }
    scene:run { duration = 0.04, dt = 0.002, frame = 0.01 }
    local read = film.read((core.film(scene, -math.huge, math.huge, true)))
    local surface = film.track(read, "surface", 0)
    for f = 1, #read.times do
      local given = scene:frame(f).surfaces[1]
      assert.equal(given.around, surface.line)
      assert.equal(#given.points, #surface.frames[f])
      for i, x in ipairs(given.points) do assert.near(x, surface.frames[f][i], 0.5e-3 * 0.005 * 1.001) end
    end
    assert.truthy(film.track(read, "pressed", 0))
    assert.truthy(wire)
  end)

  it("has the nodes that a wire has in each frame", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local wire = scene:wire { E = 5e6, density = 1200, radius = 0.005, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 }, segments = 10 }
    wire:set_velocity { 0.1, 0, 0.2 }
    local counts = {}
    for _, model in ipairs { "rod", "tube", "rod" } do
      if #counts > 0 then wire:remodel { model = model, segments = model == "rod" and 25 or nil } end
      scene:run { duration = 0.02, dt = 0.005, frame = 0.01 }
      counts[#counts + 1] = wire.segments + 1
    end
    assert.is_true(counts[1] == 11 and counts[3] == 26 and counts[2] ~= 11 and counts[2] ~= 26)
    local read = film.read((core.film(scene, -math.huge, math.huge, true)))
    local track, tension = film.track(read, "wire", 0), film.track(read, "value", 0)
    local surface = film.track(read, "surface", 0)
    assert.equal(7, #read.times) -- the first, and two of each model
    for f = 1, #read.times do
      local points, count = scene:frame(f).wires[1], counts[math.max(1, f // 2)]
      assert.same({ 3 * count, count }, { #track.frames[f], #tension.frames[f] })
      assert.equal(#points, #track.frames[f])
      for i, x in ipairs(points) do assert.near(x, track.frames[f][i], 0.5e-3 * 0.005 * 1.001) end
      assert.equal(f == 4 or f == 5, #surface.frames[f] > 0)
    end
  end)

  it("of a failed run has positions and no results", function()
    local scene = laying()
    local read = film.read((core.film(scene, -math.huge, math.huge, false)))
    for _, t in ipairs(read.tracks) do
      assert.is_true(t.kind ~= "pressed" and (t.kind ~= "value" or t.channel == 8))
      assert.is_true(t.kind == "value" or t.channel < 2)
    end
  end)

  it("takes the frames of a time span, or none", function()
    local scene = laying()
    local _, frames = core.film(scene, 0.1, 0.2, true)
    local expected = 0
    for i = 1, scene:frame_count() do
      local t = scene:frame(i).t
      if t >= 0.1 and t <= 0.2 then expected = expected + 1 end
    end
    assert.is_true(frames >= 5)
    assert.equal(expected, frames)
    local packed, none = core.film(scene, 1e6, 2e6, true)
    assert.equal(0, none)
    assert.equal(0, #film.read(packed).tracks)
  end)

  it("packs bytes as zlib does and text as base64 does", function()
    local text = ("laying a wire, "):rep(300) .. "\0\255"
    assert.equal(text, film.inflate(core.deflate(text)))
    assert.is_true(#core.deflate(text) < 100)
    assert.equal("", film.inflate(core.deflate ""))
    for given, told in pairs { [""] = "", f = "Zg==", fo = "Zm8=", foo = "Zm9v", foobar = "Zm9vYmFy",
      ["\255\254\0"] = "//4A" } do
      assert.equal(told, core.base64(given))
    end
  end)
end)
