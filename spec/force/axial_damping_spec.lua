-- SPDX-License-Identifier: GPL-3.0-or-later
-- Stiffness damping of wires that hardly stretch: no axial force from an edge that only turns, the true
-- force where an edge gets longer, and no loss from turning.
local sw = require "softworld"
local t = require "physics.tools"

local CABLES = { "GXL 0.5", "GXL 1.5", "FLRY-B 10" }
local METHODS = { "tr-bdf2", "bdf2", "implicit-euler", "implicit-midpoint", "sdirk2" }
local BETA = 1e-3

-- Returns v turned about a unit axis (Rodrigues).
local function turned(v, axis, angle)
  local c, s, across = math.cos(angle), math.sin(angle), t.cross(axis, v)
  local along = axis[1] * v[1] + axis[2] * v[2] + axis[3] * v[3]
  local out = {}
  for k = 1, 3 do out[k] = c * v[k] + s * across[k] + (1 - c) * along * axis[k] end
  return out
end

-- Returns the largest tension of a cable clamped at one end [N]. options: beta [s]; sag: true = the cable
-- falls, false = its clamp turns it to and fro, up to 6 rad/s; axis, angle: of the whole scene.
local function swung(cable, options, run)
  local function place(v) return turned(v, options.axis or { 0, 0, 1 }, options.angle or 0) end
  local to, down = place{ 0.3, 0, 0 }, place{ 0, 0, options.sag and -9.80665 or 0 }
  local scene = sw.scene{ gravity = down }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = to, segments = 30 }
  scene:force{ kind = "damping", on = wire, stiffness = options.beta or BETA }
  local clamp = scene:clamp(wire, { s = 0 })
  if not options.sag then
    local axis = place{ 0, 0, 1 }
    clamp:follow{ relative = true, func = function(time)
      return { 0, 0, 0 }, { axis = axis, angle = 1 - math.cos(6 * time) }
    end }
  end
  run.duration = run.duration or 0.5
  t.fine(scene:run(run))
  return (wire:max_tension()), wire
end

describe("stiffness damping of cables", function()
  for _, cable in ipairs(CABLES) do
    it("adds no tension to a falling " .. cable .. " at any step", function()
      local true_one = swung(cable, { sag = true }, { dt = 5e-4 })
      for _, run in ipairs{ {}, { dt = 2e-2 }, { dt = 2e-3 }, { tolerance = 1e-5 } } do
        t.share(true_one, swung(cable, { sag = true }, run), 0.06, "tension at dt " .. (run.dt or 0))
      end
    end)

    it("adds no tension to a " .. cable .. " that turns at a changing speed", function()
      local true_one = swung(cable, {}, { dt = 5e-4 })
      for _, dt in ipairs{ 2e-2, 1e-2, 2e-3 } do
        t.share(true_one, swung(cable, {}, { dt = dt }), dt > 0.01 and 0.06 or 0.02, "tension at " .. dt)
      end
    end)
  end

  it("adds no tension to any cable of the catalogue at the default step", function()
    for _, cable in ipairs(sw.cables()) do
      local none = swung(cable, { beta = 0 }, { duration = 0.3 })
      t.share(none, swung(cable, {}, { duration = 0.3 }), 0.05, "tension of " .. cable)
    end
  end)

  -- The method's own error is in both; an error of damping would be many times as large. (With sdirk2
  -- alone, the axial force of a turning edge counts five times.)
  for _, method in ipairs(METHODS) do
    it("changes the tension that " .. method .. " has by no more than it damps", function()
      for _, dt in ipairs{ 2e-2, 5e-3, 1e-3 } do
        local none = swung("GXL 1.5", { beta = 0 }, { dt = dt, integrator = method })
        local damped = swung("GXL 1.5", {}, { dt = dt, integrator = method })
        local most = method == "sdirk2" and 0.5 or 1.06 * none
        t.below(most, damped, ("tension at dt = %g s"):format(dt))
      end
    end)
  end

  it("gives the same tension in a turned scene", function()
    local random = t.random(3)
    for _, sag in ipairs{ true, false } do
      local straight = swung("GXL 1.5", { sag = sag }, {})
      for _ = 1, 3 do
        local axis = { random() - 0.5, random() - 0.5, random() - 0.5 }
        local size = t.norm(axis)
        for k = 1, 3 do axis[k] = axis[k] / size end
        local there = swung("GXL 1.5", { sag = sag, axis = axis, angle = 6 * random() }, {})
        t.share(straight, there, 1e-6, "tension")
      end
    end
  end)

  it("does not change the tension of a cable that turns steadily", function()
    local function turn(beta, dt)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 30 }
      scene:force{ kind = "damping", on = wire, mass = 3, stiffness = beta }
      scene:clamp(wire, { s = 0 }):follow{ relative = true, func = function(time)
        local u = math.min(2 * time, 1) -- up to 8 rad/s within half a second
        return { 0, 0, 0 }, { axis = { 0, 0, 1 },
          angle = 4 * (u ^ 3 - 0.5 * u ^ 4) + 8 * math.max(time - 0.5, 0) }
      end }
      t.fine(scene:run{ duration = 2, dt = dt })
      return wire:tension(0)
    end
    local true_one = turn(2e-3, 5e-4)
    for _, dt in ipairs{ 2e-2, 1e-2, 2e-3 } do
      local damped = turn(2e-3, dt)
      t.share(turn(0, dt), damped, 0.01, "tension at dt = " .. dt)
      t.share(true_one, damped, 0.05, "tension at dt = " .. dt)
    end
  end)
end)

describe("the tension of a damped wire", function()
  -- Both ends clamped, one drawn away at a steady speed: EA (strain + beta rate).
  local function drawn(method, dt)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 50, EI = 1e-4, mass_per_length = 0.02, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = 16 }
    scene:force{ kind = "damping", on = wire, mass = 300, stiffness = 2e-3 }
    scene:clamp(wire, { s = 0 })
    local hand = scene:clamp(wire, { s = 0.4 })
    hand:follow{ relative = true, func = function(time) return { 0.02 * time, 0, 0 } end }
    t.fine(scene:run{ duration = 0.3, dt = dt, integrator = method })
    return wire, hand
  end

  local methods = { "rk4", "velocity-verlet" }
  table.move(METHODS, 1, #METHODS, 3, methods)
  for _, method in ipairs(methods) do
    it("is the force on its clamp, dashpots included, with " .. method, function()
      local wire, hand = drawn(method, method:find "^[rv]" and 5e-5 or 2e-3)
      local strain, rate = 0.02 * 0.3 / 0.4, 0.02 / 0.4
      t.share(50 * (strain + 2e-3 * rate), wire:tension(0.2), 4e-3, "tension")
      t.share(hand:force()[1], wire:tension(0.4), 5e-3, "tension at the clamp")
      t.share(wire:tension(0.2), (wire:max_tension()), 0.03, "largest tension")
      t.share(strain, wire:strain(0.2), 4e-3, "strain")
    end)
  end
end)

describe("the loss by stiffness damping", function()
  it("is beta omega / 2 for an axial mode", function()
    local EA, m, L = 200, 0.05, 0.5
    local omega = math.pi / 2 / L * (EA / m) ^ 0.5
    for _, method in ipairs{ "tr-bdf2", "bdf2", "implicit-midpoint" } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = EA, EI = 1e-4, mass_per_length = m, radius = 0.002,
        from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 32 }
      scene:clamp(wire, { s = 0 })
      -- pulled in the shape of the first mode
      local pull = scene:force{ kind = "line", on = wire, force = { 0.2, 0, 0 } }
      t.fine(scene:settle())
      pull:release()
      scene:force{ kind = "damping", on = wire, stiffness = 2 * 0.03 / omega }
      local period = 2 * math.pi / omega
      t.fine(scene:run{ duration = 2 * period, dt = period / 400, integrator = method })
      local before = scene:energy().total
      t.fine(scene:run{ duration = 4 * period, dt = period / 400, integrator = method })
      local ratio = math.log(before / scene:energy().total) / (2 * 4 * 2 * math.pi)
      t.share(0.03, ratio, 0.01, "damping ratio with " .. method)
    end
  end)

  -- A bent wire that turns as a rigid body keeps its bend.
  it("is zero for a bent wire that turns in its plane", function()
    for _, kind in ipairs{ "damping", "viscous_bend" } do
      local points = {}
      for i = 0, 40 do
        local a = math.pi * i / 40
        points[#points + 1] = { 0.1 * math.cos(a), 0.1 * math.sin(a), 0 }
      end
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e4, EI = 2e-3, mass_per_length = 0.02, radius = 0.002,
        path = points, segments = 40, rest = "path" }
      if kind == "damping" then
        scene:force{ kind = kind, on = wire, stiffness = 5e-3 }
      else
        scene:force{ kind = kind, on = wire, eta = 5e-3 * 2e-3 }
      end
      wire:set_velocity({ 0, 0, 0 }, { 0, 0, 10 }, { 0, 2 * 0.1 / math.pi, 0 })
      t.fine(scene:run{ duration = 0.5, dt = 1e-3 }) -- it opens a little and stays so
      local _, before = t.momentum(wire)
      local energy = scene:energy().total
      t.fine(scene:run{ duration = 1, dt = 1e-3 })
      local _, after = t.momentum(wire)
      t.share(before[3], after[3], 1e-3, "spin")
      t.share(energy, scene:energy().total, 1e-3, "energy")
    end
  end)

  it("never becomes a gain", function()
    for _, method in ipairs(METHODS) do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = 20 }
      scene:force{ kind = "damping", on = wire, stiffness = 2e-2 }
      scene:clamp(wire, { s = 0 })
      local pull = scene:force{ kind = "point", on = wire, s = 0.4, force = { 0, 0, 0.1 } }
      t.fine(scene:settle())
      pull:release()
      local first = scene:energy().total
      local last = first
      for _ = 1, 40 do
        t.fine(scene:run{ duration = 5e-3, dt = 5e-3, integrator = method })
        local now = scene:energy().total
        t.below(last + 1e-3 * first, now, "energy with " .. method)
        last = now
      end
      t.below(0.9 * first, last, "energy left with " .. method)
    end
  end)
end)

describe("rates of strain", function()
  local function scene_of(kind)
    local scene = sw.scene{}
    local wire
    if kind == "tube" then
      wire = scene:wire{ E = 5e6, density = 1000, radius = 0.005, model = "tube",
        from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }
    else
      wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.4, 0, 0 }, segments = 20 }
    end
    scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
    if kind == "feed" then
      scene:feed(wire, { s = 0 }):feed{ length = 0.05, duration = 0.2 }
    else
      scene:clamp(wire, { s = 0 })
    end
    return scene, wire
  end

  local function read(wire)
    local list = { wire:positions() }
    local all = { table.unpack(list[1]) }
    for _, v in ipairs(wire:velocities()) do all[#all + 1] = v end
    for k = 0, 8 do all[#all + 1] = wire:tension(wire.length * k / 8) end
    return all
  end

  for _, kind in ipairs{ "rod", "feed", "tube" } do
    for _, method in ipairs{ "tr-bdf2", "bdf2" } do
      it(("of a %s go on to the bit from snapshots and files with %s"):format(kind, method), function()
        local run = function(scene, duration)
          t.fine(scene:run{ duration = duration, dt = 2e-3, integrator = method })
        end
        local scene, wire = scene_of(kind)
        run(scene, 0.02)
        local kept, path = scene:snapshot(), os.tmpname()
        scene:save(path)
        run(scene, 0.03)
        local straight = read(wire)
        scene:restore(kept)
        run(scene, 0.03)
        assert.same(straight, read(wire))
        local loaded = sw.load(path)
        os.remove(path)
        run(loaded, 0.03)
        assert.same(straight, read(loaded:find "wire1"))
      end)
    end
  end

  -- Another wire that is fed rebuilds the system now and then.
  it("go on when the system is rebuilt", function()
    local function run(feeds)
      local scene, wire = scene_of "rod"
      local other = scene:wire{ cable = "GXL 1.5", from = { 0, 1, 0 }, to = { 0.1, 1, 0 }, segments = 20 }
      if feeds then
        scene:feed(other, { s = 0 }):feed{ length = 0.05, duration = 0.1 }
      else
        scene:clamp(other, { s = 0 })
      end
      t.fine(scene:run{ duration = 0.1, dt = 2e-3 })
      return (wire:max_tension()), wire:tension(0.1)
    end
    local largest, now = run(false)
    local largest_of_fed, now_of_fed = run(true)
    t.share(largest, largest_of_fed, 1e-6, "largest tension")
    t.share(now, now_of_fed, 1e-6, "tension")
  end)

  it("are right for a mesh's springs too", function()
    local function swung_tube(dt)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ E = 5e7, density = 1000, radius = 0.005, model = "tube",
        from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }
      scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
      scene:clamp(wire, { s = 0 }):follow{ relative = true, func = function(time)
        return { 0, 0, 0 }, { axis = { 0, 0, 1 }, angle = 1 - math.cos(6 * time) }
      end }
      t.fine(scene:run{ duration = 0.3, dt = dt })
      return (wire:max_tension())
    end
    t.share(swung_tube(1e-3), swung_tube(1e-2), 0.05, "tension")
  end)

  it("are right for a cable that is fed out and swings", function()
    local function fed(run)
      local scene = sw.scene{}
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 20 }
      scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
      scene:feed(wire, { s = 0 }):feed{ length = 0.2, duration = 0.5 }
      run.duration = 0.5
      t.fine(scene:run(run))
      return (wire:max_tension())
    end
    local true_one = fed{ dt = 1e-3 }
    t.share(true_one, fed{}, 0.08, "tension at the default step")
  end)
end)
