-- SPDX-License-Identifier: GPL-3.0-or-later
-- Snap-in clips: force on the way in and out against the law, energy over a closed cycle, loads on a seated
-- wire, friction along the wire, independence of nodes and orientation.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local RADIUS, WIDTH, INTO, OUT = 0.003, 0.008, 10, 30
local WAY = 1.5 * RADIUS -- as help says
local FLANK_OUT = WAY * INTO / (INTO + OUT)
local FLANK_IN = WAY - FLANK_OUT

-- Returns the lips' force on a wire at height u above the seat [N].
local function law(u)
  if u <= 0 or u >= WAY then return 0 end
  if u < FLANK_OUT then return -OUT * math.sin(math.pi * u / FLANK_OUT) end
  return INTO * math.sin(math.pi * (WAY - u) / FLANK_IN)
end

local function turned(q, v)
  local x, y, z = require "softworld.output.solid".rotate(q, v[1], v[2], v[3])
  return { x, y, z }
end

-- A wire along the turned x axis at height z above a clip at the origin.
local function scene_with(options)
  local o = options or {}
  local q = o.turn or { 1, 0, 0, 0 }
  local function at(x, y, z) return turned(q, { x, y, z }) end
  local scene = sw.scene{ gravity = o.gravity or { 0, 0, 0 } }
  local half = o.half or 0.1
  local args = { name = "w", E = o.E or 1e9, density = 1200, radius = RADIUS, model = o.model,
    segments = o.segments or not o.mesh and 40 or nil,
    from = at(-half, 0, o.z or 0.008), to = at(half, 0, o.z or 0.008) }
  for k, v in pairs(o.more or {}) do args[k] = v end
  local wire = scene:wire(args)
  local clip = scene:clip{ name = "c", at = at(o.x or 0, 0, 0), direction = at(0, 0, 1), axis = at(1, 0, 0),
    width = WIDTH, insertion = INTO, retention = OUT, friction = o.friction, snap = o.snap,
    stiffness = o.stiffness, radius = o.seat }
  return scene, wire, clip, at
end

-- Applies a load in ten parts, so that the overshoot stays small.
local function load_slowly(scene, wire, kind, force, s)
  for _ = 1, 10 do
    scene:force{ kind = kind, on = wire, s = s, force = { force[1] / 10, force[2] / 10, force[3] / 10 } }
    t.fine(scene:run{ duration = 0.05, dt = 1e-3 })
  end
end

-- Two holds beside the clip. Returns a function that moves both up or down, and one that returns their
-- force.
local function hands(scene, wire, apart)
  local middle = wire.length / 2
  local list = { scene:grip(wire, { s = middle - apart, width = 0.004, name = "left" }),
    scene:grip(wire, { s = middle + apart, width = 0.004, name = "right" }) }
  return function(by, duration)
    for _, hand in ipairs(list) do
      hand:follow(sw.trajectory{ points = { { 0, 0, 0 }, by }, duration = duration, law = "linear",
        relative = true })
    end
  end, function()
    local a, b = list[1]:force(), list[2]:force()
    return { a[1] + b[1], a[2] + b[2], a[3] + b[3] }
  end
end

describe("a clip", function()
  -- A wide grip keeps the wire straight, so the wire's height is the grip's. Checked: the force against the
  -- law at every step, and the work over the cycle. The edges beside the grip's nodes differ in length; the
  -- sum over the window is not exact there (16 places: 2e-4). The trapezoidal rule loses about (pi 80 um /
  -- 1.1 mm)^2 / 12 = 4e-3 of the steep flank's work.
  it("pushes and pulls by its law and takes no work over a cycle, in any orientation", function()
    local random = t.random(7)
    for k = 1, 3 do
      local scene, wire, clip, at = scene_with{ segments = 80, turn = k > 1 and t.turn(random) or nil }
      local grip = scene:grip(wire, { s = 0.1, width = 0.03 })
      local up, total, half, last = at(0, 0, 1), 0, 0, nil
      local function go(z, duration)
        grip:follow(sw.trajectory{ points = { { 0, 0, 0 }, at(0, 0, z) }, duration = duration,
          law = "linear", relative = true })
        for _ = 1, 100 do
          t.fine(scene:run{ duration = duration / 100, dt = duration / 100, quasistatic = true })
          local f, p = grip:force(), grip:pose()
          local u = p[1] * up[1] + p[2] * up[2] + p[3] * up[3]
          local force = -(f[1] * up[1] + f[2] * up[2] + f[3] * up[3])
          t.near(law(u), force, 3e-4 * OUT, ("force at u = %.6f m"):format(u))
          if last then total = total + 0.5 * (force + last[2]) * (u - last[1]) end
          if last and z < 0 then half = math.min(half, total) end
          last = { u, force }
        end
      end
      go(-0.008, 1)
      assert.is_true(clip:seated())
      -- the energy at the top is 2/pi times the insertion force times the length of the outer flank
      t.share(2 / math.pi * INTO * FLANK_IN, -half, 1e-3, "work up to the lips' top")
      t.near(0, total, 5e-3 * -half, "work to the seat")
      go(0.008, 1)
      t.near(0, total, 1e-3 * -half, "work of the cycle")
      assert.is_false(clip:seated())
      t.near(0, t.norm(clip:force()), 1e-12, "force of an empty clip")
    end
  end)

  -- The wire is held 25 mm to either side, is not rigid there, and snaps. The peak is sampled at steps of
  -- 40 um, which miss the sine's peak by at most (pi/2 * 40 um / 3.4 mm)^2 / 2 = 2e-4.
  it("lets a wire in at its insertion force and out at its retention force, on any mesh", function()
    for _, segments in ipairs{ 20, 40, 80 } do
      for _, x in ipairs{ 0, 0.0013 } do -- wherever nodes are
        local scene, wire, clip = scene_with{ segments = segments, x = x }
        local move, force = hands(scene, wire, 0.025)
        move({ 0, 0, -0.009 }, 1)
        t.fine(scene:run{ duration = 1, dt = 1 / 225, quasistatic = true })
        assert.are.equal("seated", clip:state())
        assert.are.equal(wire, clip.wire)
        t.share(INTO, clip.inserted.peak_force, 2e-3, "insertion")
        t.near(0.1 + x, clip.inserted.s, 1e-4, "place on the wire")
        t.near(0, force()[3] + clip:force()[3], 1e-6 * INTO, "balance with the hands")
        move({ 0, 0, 0.012 }, 1)
        t.fine(scene:run{ duration = 1, dt = 1 / 300, quasistatic = true })
        assert.is_nil(clip.wire)
        t.share(OUT, clip.pulled_out.peak_force, 0.01, "retention") -- 40 um of 1.1 mm: 1.6e-3, and bending
        t.share(1, clip:ratio(), 0.01, "ratio")
      end
    end
  end)

  it("does so in motion, and records the time", function()
    local scene, wire, clip = scene_with()
    scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
    local move = hands(scene, wire, 0.025)
    move({ 0, 0, -0.009 }, 1)
    assert.is_nil(clip.inserted)
    t.fine(scene:run{ duration = 1, dt = 2e-3 })
    assert.is_true(clip:seated())
    t.share(INTO, clip.peak_insertion_force, 5e-3, "insertion")
    -- The lips' force is zero at their top, so there the wire is as high as the hands. The wire counts as
    -- inserted between the top and the middle of the inner flank.
    t.above((0.008 - FLANK_OUT) / 0.009, clip.inserted.time, "time")
    t.below((0.008 - 0.5 * FLANK_OUT) / 0.009 + 2e-3, clip.inserted.time, "time")
    assert.are.equal(wire, clip.inserted.wire)
    assert.are.equal(1, clip.inserted.count)
  end)

  for _, model in ipairs{ { "string" }, { "rod" }, { "radial", mesh = true, E = 1e8 },
    { "radial", mesh = true, E = 1e8, more = { body = "solid" } },
    { "tube", mesh = true, E = 1e8, more = { spacing = 0.002 } } } do
    it("takes a wire of model " .. model[1] .. (model.more and model.more.body or ""), function()
      local scene, wire, clip = scene_with{ model = model[1], mesh = model.mesh, E = model.E,
        half = 0.03, z = 0.007, more = model.more }
      local move, force = hands(scene, wire, 0.015)
      local still = model[1] ~= "string"
      if not still then scene:force{ kind = "damping", on = wire, mass = 50, stiffness = 1e-3 } end
      move({ 0, 0, -0.008 }, 1)
      t.fine(scene:run{ duration = still and 1 or 1.5, dt = 5e-3, quasistatic = still })
      assert.is_true(clip:seated())
      -- rings are up to 3 mm apart, so the width over which the lips act on a bent wire differs
      t.share(INTO, clip.inserted.peak_force, 0.02, "insertion")
      t.near(0, force()[3] + clip:force()[3], 1e-3 * INTO, "balance with the hands")
    end)
  end

  -- A stiff rod, held by the clip alone, is pulled by a point force at its middle. On the inner flank OUT
  -- sin(pi u / FLANK_OUT) = pull. Without friction the rod would tilt and slide away, like a rod on one
  -- support.
  it("holds a pulled wire at the height that its law gives", function()
    for _, share in ipairs{ 0.2, 0.5, 0.9 } do
      local scene, wire, clip = scene_with{ half = 0.02, z = 0, E = 2e11, segments = 16, friction = 0.3 }
      scene:force{ kind = "damping", on = wire, mass = 2000 }
      load_slowly(scene, wire, "point", { 0, 0, share * OUT }, 0.02)
      t.fine(scene:run{ duration = 0.2, dt = 2e-3 })
      t.near(FLANK_OUT / math.pi * math.asin(share), clip:height(), 2e-3 * FLANK_OUT, "height")
      t.near(-share * OUT, clip:force()[3], 1e-3 * OUT, "force")
      t.above(share * 0.999, clip:ratio(), "ratio") -- the last tenth of the load may overshoot
      t.below(share * 1.1, clip:ratio(), "ratio")
    end
  end)

  -- Only friction keeps the wire from sliding along its axis, and the first solve does not know the normal
  -- force.
  for _, model in ipairs{ "string", "rod", "radial" } do
    it("bears a " .. model .. " that lies in two of them alone, settled at once", function()
      local scene = sw.scene{}
      local wire = scene:wire{ E = 1e8, density = 1200, radius = RADIUS, from = { 0, 0, 0 },
        to = { 0.16, 0, 0 }, segments = model ~= "radial" and 40 or nil, model = model }
      local up, clips = 0, {}
      for i, x in ipairs{ 0.03, 0.13 } do
        clips[i] = scene:clip{ at = { x, 0, 0 }, width = WIDTH, insertion = INTO, retention = OUT,
          friction = 0.3 }
      end
      t.fine(scene:settle())
      for _, clip in ipairs(clips) do
        assert.is_true(clip:seated())
        up = up + clip:force()[3]
      end
      t.share(wire.beam.mass_per_length * wire.length * 9.81, up, 1e-3, "force upwards")
      -- the friction springs are up to W/200 long in either clip
      t.near(0.08, wire:position(0.08)[1], 2 * WIDTH / 200, "place along the axis")
    end)
  end

  it("yields by force over stiffness at floor and walls", function()
    for _, side in ipairs{ { 0, 0, -1 }, { 0, 1, 0 }, { 0, -1, 0 } } do
      local scene, wire = scene_with{ half = 0.02, z = 0, E = 2e11, segments = 16, stiffness = 1e5,
        seat = 1.1 * RADIUS, friction = 0.3 }
      scene:force{ kind = "point", on = wire, s = 0.02, force = { 5 * side[1], 5 * side[2], 5 * side[3] } }
      scene:force{ kind = "damping", on = wire, mass = 200 }
      t.fine(scene:run{ duration = 0.5, dt = 2e-3 })
      local p = wire:position(0.02)
      t.share(5 / 1e5 + 0.1 * RADIUS, p[1] * side[1] + p[2] * side[2] + p[3] * side[3], 0.01, "depth")
    end
  end)

  -- A rod lies in two clips under its weight m g and is pulled along them. Below mu m g it sticks; above,
  -- the excess accelerates it. The friction spring is W/200 = 40 um long. A load put on at once overshoots
  -- up to twice as far, so the largest such load that sticks is half of mu m g.
  it("exerts friction mu N along the wire's axis", function()
    local g, mu, radius = 9.81, 0.3, RADIUS
    local function pulled(share, before)
      local scene = sw.scene{}
      local wire = scene:wire{ E = 2e11, density = 7800, radius = radius, from = { -0.2, 0, 0 },
        to = { 0.2, 0, 0 }, segments = 40 }
      for _, x in ipairs{ -0.1, 0.1 } do
        scene:clip{ at = { x, 0, 0 }, width = WIDTH, insertion = INTO, retention = OUT, friction = mu }
      end
      scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
      t.fine(scene:run{ duration = 0.1, dt = 2e-3 }) -- until friction has its normal force
      local m = wire.beam.mass_per_length * wire.length
      scene:force{ kind = "line", on = wire, force = { share * mu * m * g / wire.length, 0, 0 } }
      t.fine(scene:run{ duration = before, dt = 1e-3 })
      local from, speed = wire:position(0.2)[1], wire:velocity(0.2)[1]
      t.fine(scene:run{ duration = 0.05, dt = 1e-3 })
      return wire:position(0.2)[1] - from, wire:velocity(0.2)[1] - speed, scene, wire
    end
    t.below(WIDTH / 200, math.abs(pulled(0.49, 1e-3)), "creep while it sticks")
    local _, gain, scene, wire = pulled(2, 0.02)
    t.share(mu * g * 0.05, gain, 5e-3, "gain of speed under twice the friction")
    -- work of friction: mu m g times the distance
    local m, way = wire.beam.mass_per_length * wire.length, wire:position(0.2)[1]
    t.share(mu * m * g * way, scene:energy().dissipated, 0.02, "work")
  end)

  -- Two clips keep the rod from tilting as it slides off their middle.
  it("has friction at the lips too, in steady sliding", function()
    local scene, wire, clip = scene_with{ half = 0.05, z = 0, x = -0.03, E = 2e11, segments = 40,
      friction = 0.4 }
    local other = scene:clip{ at = { 0.03, 0, 0 }, width = WIDTH, insertion = INTO, retention = OUT,
      friction = 0.4 }
    scene:force{ kind = "damping", on = wire, mass = 2000 }
    load_slowly(scene, wire, "line", { 0, 0, 24 / 0.1 })
    -- steady speed v with this damping: 2000/s m v = F - mu N
    local m, N = wire.beam.mass_per_length * wire.length, 24
    scene:force{ kind = "line", on = wire, force = { 1.05 * 0.4 * N / 0.1, 0, 0 } }
    local from = wire:position(0.05)[1]
    t.fine(scene:run{ duration = 0.03, dt = 5e-4 })
    t.near(-0.4 * N, clip:force()[1] + other:force()[1], 0.01 * 0.4 * N, "friction")
    t.share(0.05 * 0.4 * N / (2000 * m), wire:velocity(0.05)[1], 0.2, "speed") -- 1 % of mu N
    t.above(5e-4, wire:position(0.05)[1] - from, "way so far")
    t.near(-N, clip:force()[3] + other:force()[3], 1e-2 * N, "pull of the lips")
  end)

  it("exerts no force on a wire below it, and keeps out a wire that comes from below", function()
    local scene, wire, clip = scene_with{ z = -0.012, E = 2e11, segments = 40 }
    t.fine(scene:run{ duration = 0.05, dt = 2e-3 })
    t.near(0, t.norm(clip:force()), 1e-12, "force on a wire below")
    assert.is_false(clip:seated())
    local hold = scene:grip(wire, { s = 0.1, width = 0.03 })
    hold:follow(sw.trajectory{ points = { { 0, 0, 0 }, { 0, 0, 0.007 } }, duration = 0.5, relative = true })
    t.fine(scene:run{ duration = 0.5, dt = 2e-3 })
    t.below(-INTO, clip:force()[3], "push of the floor on a wire from below")
    assert.are.equal("empty", clip:state())
    assert.is_nil(clip.wire)
  end)

  it("is restored bit for bit from a snapshot in the middle of an insertion", function()
    local scene, wire, clip = scene_with{ friction = 0.3 }
    scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
    local move = hands(scene, wire, 0.025)
    move({ 0.002, 0, -0.009 }, 1)
    t.fine(scene:run{ duration = 0.6, dt = 2e-3 })
    assert.are.equal("inserting", clip:state())
    local snapshot, ends = scene:snapshot(), {}
    local peak = clip.peak_insertion_force
    for k = 1, 2 do
      t.fine(scene:run{ duration = 0.5, dt = 2e-3 })
      ends[k] = { wire:positions(), clip.inserted.peak_force, clip.inserted.time, clip:force(),
        scene:energy().dissipated }
      clip:release()
      assert.has_error(function() clip:seated() end,
        "clip 'c' was released, or taken back when a snapshot was restored")
      scene:restore(snapshot)
      assert.are.equal("inserting", clip:state())
      assert.are.equal(peak, clip.peak_insertion_force)
    end
    assert.are.same(ends[1], ends[2])
  end)

  it("keeps its wire and its friction when a hold is put on and when nodes change", function()
    local scene, wire, clip = scene_with{ half = 0.05, z = 0, E = 2e11, segments = 40, friction = 0.4 }
    scene:force{ kind = "line", on = wire, force = { 0, 0, -12 / 0.1 } }
    scene:force{ kind = "damping", on = wire, mass = 100 }
    t.fine(scene:run{ duration = 0.2, dt = 2e-3 })
    scene:force{ kind = "line", on = wire, force = { 0.9 * 0.4 * 12 / 0.1, 0, 0 } }
    t.fine(scene:run{ duration = 0.3, dt = 1e-3 })
    local before = clip:force()
    t.near(-0.9 * 0.4 * 12, before[1], 0.01 * 4.8, "friction that sticks")
    scene:clamp(wire, { s = 0.0973 })
    t.fine(scene:run{ duration = 1e-3, dt = 1e-3 })
    t.near(before[1], clip:force()[1], 0.02 * 4.8, "friction after a clamp")
    assert.is_true(clip:seated())
  end)

  -- Velocity Verlet is the explicit method whose limit stable_dt states.
  it("limits the step of explicit methods to stable_dt", function()
    local scene, wire, clip = scene_with{ half = 0.03, z = 0, segments = 12, model = "string",
      stiffness = 1e7 }
    wire:set_velocity{ 0, 0.05, 0 }
    local dt = scene:stable_dt()
    t.fine(scene:run{ duration = 2000 * dt, dt = 0.95 * dt, integrator = "velocity-verlet" })
    t.below(2e-3, math.abs(wire:position(0.03)[2]), "the wire between the walls")
    assert.is_true(clip:seated())
  end)

  it("works with error bars", function()
    local scene, wire, clip = scene_with{ segments = 20 }
    scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
    local move = hands(scene, wire, 0.025)
    move({ 0, 0, -0.009 }, 0.5)
    local run = scene:run{ duration = 0.5, dt = 4e-3, tolerance = {
      { name = "peak", value = 0.1, unit = "N", of = function() return clip.peak_insertion_force end } } }
    t.fine(run)
    t.near(INTO, run.quantities.peak.value, run.quantities.peak.error + 0.02, "peak")
  end)

  it("is in the summary, in pictures and in files", function()
    local scene, wire, clip = scene_with()
    local move = hands(scene, wire, 0.025)
    move({ 0, 0, -0.009 }, 1)
    local run = t.fine(scene:run{ duration = 1, dt = 5e-3, frame = 0.5 })
    local document = run:document()
    local shown = document.obstacles[#document.obstacles]
    assert.are.equal("c", shown.name)
    assert.are.equal("mesh", shown.shape)
    for i = 1, #shown.vertices, 3 do -- all vertices lie within a few radii of the seat
      t.below(4 * RADIUS, t.norm{ shown.vertices[i], shown.vertices[i + 1], shown.vertices[i + 2] })
    end
    assert.is_truthy(require "softworld.output.vtk".objects(document):find('"c"', 1, true))
    local text = require "softworld.output.summary".text(document)
    assert.is_truthy(text:find("c: largest force as 'w' went in", 1, true))
    assert.is_truthy(tostring(clip):find "seated")
    assert.are.equal(wire, clip.wire)
  end)

  describe("refuses", function()
    local function refused(message, args)
      local scene = scene_with()
      local a = { name = "d", at = { 0, 0, 0.05 }, width = 0.01, insertion = 5, retention = 5 }
      for k, v in pairs(args) do a[k] = v end
      local before = scene:energy()
      local ok, text = pcall(scene.clip, scene, a)
      assert.is_false(ok)
      assert.is_truthy(text:find(message, 1, true), text)
      assert.are.same(before, scene:energy())
      a.name = "d"
      for k in pairs(args) do a[k] = nil end
      a.at, a.width, a.insertion, a.retention = { 0, 0, 0.05 }, 0.01, 5, 5
      assert.are.equal("empty", scene:clip(a):state()) -- the name is still free
    end

    it("arguments that make no sense, naming them", function()
      refused("clip 'd': insertion = -3 N is not allowed; it must be above 0 N", { insertion = -3 })
      refused("clip 'd': width = 0 m is not allowed", { width = 0 })
      refused("clip 'd': insertion = 9.2e+18 N and retention = 5 N are not", { insertion = 9.2e18 })
      refused("one at most 1e+06 times the other", { insertion = 1e-300 })
      refused("they must be at most 1e+12 N", { insertion = 1e300, retention = 1e300 })
      for _, kind in ipairs{ "clip", "snap" } do
        local scene, wire = scene_with()
        local fine, text = pcall(scene.force, scene, { kind = kind, on = wire, at = { 0, 0, 0.05 },
          direction = { 0, 0, 1 }, axis = { 1, 0, 0 }, width = 0.01, insertion = 9.2e18, retention = 5 })
        assert.is_false(fine)
        assert.is_truthy(text:find("force " .. kind .. ": insertion = 9.2e+18 N", 1, true), text)
      end
      refused("clip 'd': at must be a table of 3 finite numbers [m]", { at = { 0, 0, 0 / 0 } })
      refused("clip 'd': axis (along the wire) and direction (towards the mouth) are parallel",
        { axis = { 0, 0, 1 } })
      refused("clip 'd': direction and axis must not be zero vectors", { direction = { 0, 0, 0 } })
      refused("there is no parameter 'insertoin'; did you mean 'insertion'?", { insertoin = 3 })
      refused("radius = 0.002 m of the seat is below the 0.003 m of wire 'w'", { radius = 0.002 })
      refused("clip 'd': on must be a wire (from scene:wire), got 'w'", { on = "w" })
      refused("clip 'd': friction = 'a' is not allowed", { friction = "a" })
    end)

    it("a wire, made later, that is thicker than the seat", function()
      local scene = scene_with{ seat = 0.004 }
      assert.has_error(function()
        scene:wire{ E = 1e9, density = 1000, radius = 0.006, from = { 0, 1, 0 }, to = { 1, 1, 0 } }
      end)
    end)
  end)
end)
