-- SPDX-License-Identifier: GPL-3.0-or-later
-- Objects of particles: their parts, their motion, their refusals.
local sw = require "softworld"
local nets = require "spec.scene.nets"

local net = nets.net
local core = sw.core
local G = 9.81

local function near(expected, value, tolerance, what)
  assert.is_true(math.abs(value - expected) <= tolerance,
    ("%s: %.12g instead of %.12g"):format(what or "value", value, expected))
end

local function momentum(object, mass)
  local v, sum = object:velocities(), { 0, 0, 0 }
  for i = 1, #v do sum[(i - 1) % 3 + 1] = sum[(i - 1) % 3 + 1] + mass * v[i] end
  return sum
end

describe("objects of particles", function()
  it("report their name, counts, mass and radius", function()
    local scene = sw.scene{}
    local object = net(scene, 3, { name = "net" })
    assert.are.equal("net", object.name)
    assert.are.equal(9, object.count)
    near(0.09, object.mass, 1e-15)
    near(0.005, object.radius, 0)
    assert.is_truthy(tostring(object):find "'net': 9 of them, 12 links, 3 folds, 0 elements")
    assert.are.equal("particles", core.type(object))
    assert.are.same({ 0.1, 0.2, 1 }, (object:particle(8)))
    assert.are.equal(27, #object:positions())
  end)

  it("take lists in either form", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local a = scene:particles{ positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } },
      masses = { 1, 2, 3 }, links = { { 1, 2, k = 10 }, { 2, 3, k = 20, rest = 0.5 } } }
    local b = scene:particles{ positions = { 0, 0, 0, 1, 0, 0, 2, 0, 0 }, masses = { 1, 2, 3 },
      links = { { pairs = { 1, 2, 2, 3 }, k = { 10, 20 }, rest = { 1, 0.5 } } } }
    assert.are.same({ a:links() }, { b:links() })
    near(10, (a:links())[2], 1e-12) -- 20 N/m, longer by 0.5 m
    near(6, a.mass, 0)
    near(0.05, a.radius, 1e-15) -- a tenth of the shortest link
  end)

  -- Trapezium and BDF2 are exact for constant acceleration.
  it("fall freely as a whole", function()
    local scene = sw.scene{}
    local object = net(scene, 4)
    object:set_velocity{ 3, 0, 4 }
    near(0.5 * 0.16 * 25, object:energy().kinetic, 1e-12)
    assert.is_true(scene:run{ duration = 0.2 }.ok)
    local x, v = object:particle(7)
    near(0.2 + 0.6, x[1], 1e-10)
    near(1 + 0.8 - 0.5 * G * 0.04, x[3], 1e-10)
    near(4 - 0.2 * G, v[3], 1e-9)
    for _, force in ipairs((object:links())) do near(0, force, 1e-8) end
  end)

  it("keep their momentum when they are shaken", function()
    for _, method in ipairs{ "tr-bdf2", "implicit-midpoint", "velocity-verlet" } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local object = net(scene, 4, { repel = { distance = 0.09, stiffness = 30 } })
      local v = object:velocities()
      for i = 1, #v do v[i] = 0.3 * math.sin(5 * i) end
      object:set_velocity(v)
      local before = momentum(object, 0.01)
      local run = scene:run{ duration = 0.1, dt = method == "velocity-verlet" and 1e-3 or 5e-3,
        integrator = method }
      assert.is_true(run.ok, run.reason)
      -- forces between particles are opposite to the last bit, the solver's to rounding
      local after = momentum(object, 0.01)
      for k = 1, 3 do near(before[k], after[k], 1e-13, method) end
      assert.is_true(math.abs(object:energy().stretch) > 1e-5)
    end
  end)

  -- A weight between two springs that lead to both sides: 2 k (l - l0) z / l = m g.
  it("find the equilibrium of a network that was computed by hand", function()
    local scene = sw.scene{}
    local object = scene:particles{ positions = { -1, 0, 0, 0, 0, -0.1, 1, 0, 0 }, masses = 0.5,
      links = { { 1, 2, k = 40, rest = 0.9 }, { 2, 3, k = 40, rest = 0.9 } } }
    local hold = scene:hold(object, { particles = { 1, 3 } })
    local result = scene:settle()
    assert.is_true(result.ok, result.reason)
    local low, high = 0, 5
    for _ = 1, 100 do
      local z = (low + high) / 2
      local l = math.sqrt(1 + z * z)
      if 2 * 40 * (l - 0.9) * z / l > 0.5 * G then high = z else low = z end
    end
    near(-low, object:particle(2)[3], 1e-9) -- the tolerance of settle
    near(3 * 0.5 * G, hold:force()[3], 1e-8)
    near(0, hold:force()[1], 1e-8)
    assert.are.same({ 0, 0, 0 }, (hold:pose()))
  end)

  -- The same springs and masses as a wire of the model string: half a mass at each end.
  it("hang like a string with the same springs", function()
    local scene = sw.scene{}
    local n, positions, masses, pairs_ = 20, {}, {}, {}
    for i = 0, n do
      positions[#positions + 1] = { i / n, 0, 0 }
      masses[i + 1] = 0.1 / n * ((i == 0 or i == n) and 0.5 or 1)
      if i > 0 then pairs_[2 * i - 1], pairs_[2 * i] = i, i + 1 end
    end
    local chain = scene:particles{ positions = positions, masses = masses,
      links = { { pairs = pairs_, k = 60 * n } } }
    local wire = scene:wire{ model = "string", EA = 60, EI = 0, mass_per_length = 0.1, radius = 0.001,
      segments = n, from = { 0, 1, 0 }, to = { 1, 1, 0 } }
    scene:hold(chain, { particles = { 1, n + 1 } })
    scene:pin(wire, { s = 0 })
    scene:pin(wire, { s = 1 })
    local result = scene:settle()
    assert.is_true(result.ok, result.reason)
    local x, y = chain:positions(), wire:positions()
    for i = 1, #x, 3 do
      near(y[i], x[i], 1e-7)
      near(y[i + 2], x[i + 2], 1e-7)
    end
    assert.is_true(x[3 * n // 2] < -0.05)
  end)

  -- Stress of a neo-Hookean bar that is free to narrow, as in the foam example.
  it("made of solid elements stretch as their material law says", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local positions = {}
    for z = 0, 1 do
      for _, c in ipairs{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } } do
        positions[#positions + 1] = { 0.1 * c[1], 0.1 * c[2], 0.2 * z }
      end
    end
    local cube = scene:particles{ positions = positions, masses = 0.1,
      elements = { { 1, 2, 3, 4, 5, 6, 7, 8, E = 1e4, nu = 0.3 } } }
    for _, k in ipairs{ 1, 2 } do -- pulled at both ends, free to narrow
      scene:force{ kind = "push", on = cube, force = { 0, 0, k == 1 and -20 or 20 },
        particles = k == 1 and { 1, 2, 3, 4 } or { 5, 6, 7, 8 } }
    end
    local pinned = scene:hold(cube, { particles = { 1 } })
    local result = scene:settle()
    assert.is_true(result.ok, result.reason)
    local mu, lambda = 1e4 / 2.6, 1e4 * 0.3 / (1.3 * 0.4)
    local function force(s)
      local low, high = 0.1, 2
      for _ = 1, 80 do
        local a = (low + high) / 2
        if mu * (a * a - 1) + lambda * math.log(a * a * s) > 0 then high = a else low = a end
      end
      return 0.01 * (mu * (s - 1 / s) + lambda * math.log(low * low * s) / s), low
    end
    local low, high = 1, 2
    for _ = 1, 80 do
      local s = (low + high) / 2
      if force(s) > 20 then high = s else low = s end
    end
    local _, narrow = force(low)
    local x, y = cube:particle(1), cube:particle(7)
    local across = math.sqrt((y[1] - x[1]) ^ 2 + (y[2] - x[2]) ^ 2)
    near(0.2 * low, y[3] - x[3], 1e-8)
    near(0.1 * narrow * math.sqrt(2), across, 1e-8)
    near(0, pinned:force()[3], 1e-6)
    assert.is_true(cube:energy().solid > 0.1)
  end)

  it("repel each other where they come near", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = scene:particles{ positions = { 0, 0, 0, 0.1, 0, 0 }, masses = { 0.01, 0.02 },
      radius = 0.001, repel = { distance = 0.02, stiffness = 50 } }
    object:set_velocity{ 0.1, 0, 0, -0.1, 0, 0 }
    local nearest = 1
    for _ = 1, 60 do
      assert.is_true(scene:run{ duration = 0.01, dt = 1e-3 }.ok)
      nearest = math.min(nearest, object:particle(2)[1] - object:particle(1)[1])
    end
    -- 1/2 k d^2 = 1/2 m v^2 of the relative motion, with the reduced mass m = 1/150 kg and v = 0.2 m/s
    near(0.02 - math.sqrt(0.2 ^ 2 / 150 / 50), nearest, 2e-4) -- sampled every 10 ms
    local v = object:velocities() -- an elastic blow; the method damps or drives it a little
    near(0.1 - 4 / 3 * 0.2, v[1], 1e-3)
    near(-0.1 + 2 / 3 * 0.2, v[4], 1e-3)
    near(0, scene:energy().repel, 0)
  end)

  it("lie on obstacles with their weight", function()
    local scene = sw.scene{}
    local floor = scene:obstacle{ shape = "plane", friction = 0.5 }
    local object = net(scene, 5, {})
    scene:force{ kind = "damping", on = object, mass = 5 }
    local run = scene:run{ duration = 2, dt = 0.01 }
    assert.is_true(run.ok, run.reason)
    near(-0.25 * G, floor:force()[3], 1e-4 * G) -- remainder of the damped swinging
    for i = 1, 25 do near(0.005, object:particle(i)[3], 1e-5) end
  end)
end)

describe("surfaces of particles", function()
  it("touch with the edges of triangles, or with particles alone where asked to", function()
    for _, case in ipairs{ { { { 1, 2, 3 } }, true }, { { { 1, 2 } }, true }, { "particles", false } } do
      local scene = sw.scene{}
      local object = scene:particles{ positions = { 0, 0, 0.1, 1, 0, 0.1, 0, 1, 0.1 }, masses = 0.1,
        links = { { pairs = { 1, 2, 2, 3, 3, 1 }, k = 1e3 } }, radius = 0.01, surface = case[1] }
      -- a ball below the middle of the edge from 1 to 2
      scene:obstacle{ shape = "sphere", radius = 0.05, at = { 0.5, 0, 0 } }
      assert.is_true(scene:run{ duration = 0.15, dt = 0.01 }.ok)
      assert.are.equal(case[2], scene:contacts() > 0)
      assert.is_true(object:particle(3)[3] < 0.05)
    end
  end)
end)

describe("holds of particles", function()
  it("carry them rigidly along a trajectory and let go", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = net(scene, 3)
    local hold = scene:hold(object, { particles = { 3, 1 }, name = "hand" })
    assert.are.equal("hand", hold.name)
    assert.are.same({ 0.1, 0, 1 }, (hold:pose()))
    hold:follow{ points = { { 0.1, 0, 1 }, { 0.1, 0, 1.5 } }, duration = 0.5 }
    assert.is_true(scene:run{ duration = 0.5 }.ok)
    near(1.5, object:particle(1)[3], 1e-12)
    near(0.2, object:particle(3)[1], 1e-12)
    hold:pose({ 0.1, 0, 1.5 }, { axis = { 0, 0, 1 }, angle = math.pi / 2 })
    scene:run{ duration = 0.1, dt = 0.01, quasistatic = true }
    near(-0.1, object:particle(1)[2], 1e-12)
    hold:release()
    assert.is_false(hold.held)
    assert.is_true(scene:run{ duration = 0.02 }.ok)
  end)

  it("bear force and moment", function()
    local scene = sw.scene{}
    local object = scene:particles{ positions = { 0, 0, 0, 1, 0, 0 }, masses = { 1, 2 },
      links = { { 1, 2, k = 100 } } }
    local hold = scene:clamp(object, { particles = { 1, 2 }, at = { 0, 0, 0 } })
    assert.is_true(scene:settle().ok)
    near(3 * G, hold:force()[3], 1e-12)
    near(-2 * G, hold:moment()[2], 1e-12)
    near(G, hold:moment{ at = { 1, 0, 0 } }[2], 1e-12)
  end)
end)

describe("forces on particles", function()
  it("push only the given particles", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = net(scene, 3)
    local push = scene:force{ kind = "push", on = object, particles = { 2, 5 }, force = { 0, 0, 4 } }
    local f = scene:evaluate(object).push.force
    for i = 1, 9 do near((i == 2 or i == 5) and 2 or 0, f[3 * i], 0) end
    push:release()
    assert.is_nil(scene:evaluate(object).push)
  end)

  it("may be functions, which get flat arrays", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = net(scene, 3)
    scene:force{ on = object, kind = function(_, x, v, f)
      assert(#x == 27 and #v == 27)
      for i = 3, #f, 3 do f[i] = f[i] + 0.01 end
    end }
    assert.is_true(scene:run{ duration = 0.1 }.ok)
    near(0.5 * 1 * 0.01, object:particle(5)[3] - 1, 1e-9) -- 1 m/s2
    scene:force{ on = object, kind = function() error("no such wind", 0) end }
    local ok, message = pcall(scene.run, scene, { duration = 0.1 })
    assert.is_false(ok)
    assert.is_truthy(tostring(message):find "no such wind")
  end)

  it("that need a wire are refused by name, and so are such holds and read-outs", function()
    local scene = sw.scene{}
    local object = net(scene, 3, { name = "net" })
    local wire = scene:wire{ E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 2 },
      to = { 1, 0, 2 } }
    local function refuses(text, f, ...)
      local ok, message = pcall(f, ...)
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    local any = { 0, 0, 1 }
    refuses("for particles use kind = 'push'", scene.force, scene, { kind = "point", on = object, s = 0,
      force = any })
    refuses("'net' is an object of particles", scene.force, scene, { kind = "plastic", on = object,
      yield_moment = 1 })
    refuses("goes with objects of particles", scene.force, scene, { kind = "push", on = wire,
      particles = { 1 }, force = any })
    refuses("got particles", scene.join, scene, { ends = { { wire, s = 0 }, { object, s = 0 } } })
    for _, kind in ipairs{ "pin", "grip", "feed" } do
      refuses("scene:hold", scene[kind], scene, object, { s = 0 })
    end
    refuses("got wire", scene.hold, scene, wire, { particles = { 1 } })
    refuses("no 'frequencies'", function() return object:frequencies() end)
    refuses("'net' is an object of particles", scene.run, scene,
      { duration = 0.01, tolerance = { tip = 1e-3 } })
    assert.is_true(scene:run{ duration = 0.02 }.ok)
  end)
end)

describe("snapshots of particles", function()
  it("restore the same bits", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0.2, 0.2, 0.85 }, friction = 0.3 }
    local object = net(scene, 5, { repel = { distance = 0.05, stiffness = 10 } })
    scene:hold(object, { particles = { 1 } })
    assert.is_true(scene:run{ duration = 0.1, dt = 0.01 }.ok)
    local snapshot = scene:snapshot()
    assert.is_true(scene:run{ duration = 0.1, dt = 0.01 }.ok)
    local first = object:positions()
    scene:hold(object, { particles = { 7 } })
    scene:force{ kind = "push", on = object, particles = { 3 }, force = { 0, 0, 1 } }
    scene:run{ duration = 0.05 }
    scene:restore(snapshot)
    assert.is_true(scene:run{ duration = 0.1, dt = 0.01 }.ok)
    assert.are.same(first, object:positions())
    assert.is_true(#first == 75)
  end)

  it("from before the object was made remove it and free its name", function()
    local scene = sw.scene{}
    local snapshot = scene:snapshot()
    local object = net(scene, 3, { name = "net" })
    scene:restore(snapshot)
    assert.is_false(object.present)
    assert.error_matches(function() object:positions() end, "is no longer in scene 'scene'")
    assert.are.equal(0, #scene:names())
    local again = net(scene, 2, { name = "net" })
    assert.is_true(scene:run{ duration = 0.01 }.ok)
    assert.is_true(again.present)
  end)
end)

describe("frames", function()
  it("list wires and particles separately", function()
    local scene = sw.scene{}
    local object = net(scene, 3)
    scene:wire{ E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 2 }, to = { 1, 0, 2 },
      segments = 4 }
    scene:run{ duration = 0.1, frame = 0.05 }
    local frame = scene:frame(scene:frame_count())
    assert.are.equal(1, #frame.wires)
    assert.are.equal(15, #frame.wires[1])
    local stored = object:positions()
    for i, x in ipairs(stored) do stored[i] = ("f"):unpack(("f"):pack(x)) end -- frames have 32 bits
    assert.are.same(stored, frame.particles[1])
  end)
end)
