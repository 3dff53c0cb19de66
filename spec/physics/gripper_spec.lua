-- SPDX-License-Identifier: GPL-3.0-or-later
-- Grippers with real pads. What they press and hold is checked against Coulomb's law (reference case 10a),
-- the plates of case 11b, and the statics of a wire lifted from a table (case 09).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local r = 0.003

local function new_scene(gravity)
  local scene = sw.scene{ gravity = gravity or { 0, 0, 0 } }
  scene:force{ kind = "damping", mass = 20 }
  return scene
end

local function new_wire(scene, args)
  local p = { E = 5e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }
  for k, v in pairs(args or {}) do p[k] = v end
  return scene:wire(p)
end

local function run(scene, dt)
  local result = scene:run{ dt = dt or 0.005 }
  assert(result.ok, result.reason)
  return result
end

-- Closes pads on a wire's middle in a scene without gravity, then calls body(p, gripper, wire, scene).
local function grasped(args, pads, wire, body)
  local scene = new_scene()
  wire = new_wire(scene, wire)
  local p = { width = 0.02, friction = 0.4, opening = 2.5 * r }
  for k, v in pairs(pads or {}) do p[k] = v end
  local g = scene:gripper{ name = "hand", pads = p }
  args.s, args.approach = args.s or wire.length / 2, args.approach or "plates"
  local left
  scene:process(function(process)
    g:grasp(wire, args)
    left = body(process, g, wire, scene)
  end)
  run(scene)
  return left, g, wire, scene
end

describe("jaws", function()
  it("reach a force and keep it", function()
    -- control within the step is to 0.1 % of the force; the last of ten trials is taken as it is
    for _, wire in ipairs{ {}, { model = "radial", body = "solid", E = 5e6 }, { model = "tube", E = 5e6 } } do
      grasped({ force = 4 }, nil, wire, function(p, g)
        local state = g:state()
        assert.equal("holds", state.jaws)
        p:wait(0.3)
        for _ = 1, 5 do
          p:wait(0.02)
          t.share(4, g:state().squeeze, 0.004, "force per finger")
        end
        local normal = g:state().normal -- edges press aslant and may add a little
        t.above(8 * 0.996, normal, "sum of both")
        t.below(8 * (wire.model and 1.2 or 1.004), normal, "sum of both")
        t.near(0, g:force()[2], 0.02, "the pads' forces balance")
      end)
    end
  end)

  it("go to an opening, or stop where the force limit is reached", function()
    grasped({ distance = 2 * r - 2e-4 }, nil, { model = "radial", body = "solid", E = 5e6 }, function(_, g)
      local state = g:state()
      assert.equal("rests", state.jaws)
      t.near(2 * r - 2e-4, state.opening, 1e-12, "opening")
      t.above(0.5, state.squeeze, "force")
      g:open_jaws{ distance = 2.2 * r }
      t.near(2.2 * r, g:state().opening, 1e-12, "opening")
      assert.equal(0, g:state().squeeze)
      g:close_jaws{ distance = 0, force = 3 }
      assert.equal("stopped", g:state().jaws)
      t.share(3, g:state().squeeze, 0.05, "force that stops") -- a limit, not a control
      g:open_jaws()
      g:close_jaws{ speed = 0.01 }
      assert.equal("stopped", g:state().jaws)
      t.above(0, g:state().squeeze, "contact")
      t.below(0.5, g:state().squeeze, "contact")
    end)
  end)
end)

describe("a solid section between pads", function()
  it("pushes back as between plates that stick (case 11b)", function()
    -- quadratic finite elements, nu = 0.3: approach over diameter, force over E R. 48 x 6 particles are
    -- within 3 % of them
    local E, R, L = 1e6, 0.01, 0.001
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ model = "radial", body = "solid", particles = 48, layers = 6, E = E, nu = 0.3,
      density = 1000, radius = R, from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 2 }
    scene:force{ kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
    scene:force{ kind = "damping", mass = 200 }
    local g = scene:gripper{ pads = { width = 0.1, height = 0.1, below = 0.05, friction = 5,
      opening = 2.2 * R } }
    scene:process(function(p)
      g:grasp(wire, { s = L / 2, approach = "plates", distance = 2 * R, speed = 0.05 })
      for _, row in ipairs{ { 0.1, 0.08485878573 }, { 0.2, 0.2240633922 } } do
        g:close_jaws{ distance = 2 * R - row[1] * 2 * R, speed = 0.05 }
        p:wait(0.1)
        t.share(row[2], g:state().squeeze / (E * R * L), 0.03, ("force at %g"):format(row[1]))
      end
    end)
    run(scene, 0.01)
  end)
end)

-- Pulls the wire slowly through the pads by its end. Returns the pull and the normal forces, averaged over
-- the last part, in which the wire slides.
local function pull(force, pads, wire, way)
  local pulled, allowed, n = 0, 0, 0
  local _, g = grasped({ force = force }, pads, wire, function(p, g, w, scene)
    local hand = scene:clamp(w, { s = w.length })
    hand:follow{ points = { { 0, 0, 0 }, { way, 0, 0 } }, duration = 2, relative = true, law = "linear" }
    p:wait(1)
    while n < 100 do
      p:wait(0.01)
      pulled, allowed, n = pulled + hand:force()[1], allowed + g:state().normal, n + 1
    end
    t.above(0.2 * way, g:state().slip, "slip")
  end)
  return pulled / n, allowed / n, g
end

describe("friction of pads", function()
  it("gives mu times the normal forces when the wire is pulled out", function()
    -- means over a second of sliding; the pads were given a force of 5 N each
    local force, normal = pull(5, { friction = 0.4 }, {}, 0.004)
    t.share(0.4 * normal, force, 0.005, "pull against normal forces")
    t.share(0.4 * 2 * 5, force, 0.005, "pull against what the pads were told")
  end)

  it("gives mu times the normal forces after slip that spreads from one end, too", function()
    -- a soft wire: it is drawn thinner and slips first where it leaves the pads
    local force, normal = pull(4, { friction = 0.3 }, { model = "radial", body = "solid", E = 2e7 }, 0.006)
    t.share(0.3 * normal, force, 0.005, "pull against normal forces")
  end)

  it("is set for each finger; each touch records how far it slid", function()
    local gone
    local _, g = grasped({ force = 5 }, { friction = { 0.2, 0.6 } }, nil, function(p, hand, w, scene)
      local pulled = scene:clamp(w, { s = w.length })
      pulled:follow{ points = { { 0, 0, 0 }, { 0.003, 0, 0 } }, duration = 1,
        relative = true, law = "linear" }
      p:wait(0.8)
      local a, b = hand:force{ finger = 1 }, hand:force{ finger = 2 }
      t.share(-0.2 * 5, a[1], 0.05, "friction of the first finger")
      t.share(-0.6 * 5, b[1], 0.05, "friction of the second finger")
      gone = w:position(w.length / 2)[1] - w.length / 2
      for _, touch in ipairs(hand:pressure_map().touches) do -- new ones come in at the pads' edge
        t.below(gone * 1.05, touch.slid, "slid")
      end
    end)
    t.share(gone, g:state().slip, 0.3, "slip") -- it slides on for a fifth of the time
    local ok, message = pcall(g.scene.gripper, g.scene, { pads = { friction = { 0.1 } } })
    assert.is_false(ok)
    assert.is_truthy(message:find("friction has 1 value; it must have one, or one for each of 2", 1, true))
  end)

  it("is less while the wire slides, if kinetic_friction is given", function()
    -- stiff, so that the whole wire begins to slide at once
    local force, normal, g = pull(5, { friction = 0.5, kinetic_friction = 0.3 }, { E = 2e10 }, 0.004)
    t.share(0.3 * normal, force, 0.03, "pull while it slides") -- it sticks again now and then
    t.above(0.45 * 10, g:over(nil, nil, { window = 0 }).peak_force, "pull before it slid")
  end)

  -- The wire hangs from the pads alone. share: its weight over what they can hold.
  local function hang(share, mu, time, model)
    local scene = new_scene{ 0, 0, -9.81 }
    local wire = new_wire(scene, { model = model, body = model and "solid", to = { 0, 0, -0.1 } })
    local weight = wire.beam.mass_per_length * 9.81 * wire.length
    local g = scene:gripper{ pads = { width = 0.02, friction = mu, opening = 2.5 * r } }
    local top = scene:clamp(wire, { s = 0 })
    local result = {}
    scene:process(function(p)
      g:grasp(wire, { s = 0.02, approach = "plates", force = weight / (2 * mu * share) })
      p:wait(0.1)
      top:release()
      p:wait(0.5)
      local z, slip = wire:position(0.02)[3], g:state().slip
      p:wait(time)
      result.drift, result.slip = z - wire:position(0.02)[3], g:state().slip
      result.drifted, result.margin = result.slip - slip, g:state().margin
      result.force = g:force()[3] / weight
    end)
    local ended = scene:run{ dt = 0.02 }
    assert(ended.ok, ended.reason)
    return result, g
  end

  it("holds 0.95 of what it can for 100 s, but not 1.02 of it", function()
    for _, model in ipairs{ false, "radial" } do
      local held = hang(0.95, 0.5, model and 5 or 100, model or nil)
      t.near(0, held.drift, 5e-6, "drift")
      t.near(0, held.drifted, 5e-6, "slip while it holds")
      t.share(0.95, held.margin, 0.01, "margin")
      t.share(1, held.force, 1e-3, "weight")
      local lost, g = hang(1.02, 0.5, 0.5, model or nil)
      t.above(1e-3, lost.slip, "slip")
      assert.equal("slip", g.events[1].kind)
      t.near(0.02, g.events[1].s, 0.01, "place of the slip")
    end
  end)

  it("needs the squeeze of case 10a", function()
    for _, row in ipairs{ { 0.2, 2.5 }, { 0.5, 1.0 } } do -- N over pull, two faces: 1/(2 mu)
      t.near(row[2], 1 / (2 * row[1]), 1e-12, "closed form")
      t.below(1e-4, hang(0.98, row[1], 0.5).slip, "slip with 2 % more than it needs")
      t.above(1e-3, hang(1.02, row[1], 0.5).slip, "slip with 2 % less")
    end
  end)
end)

describe("a wire lifted from a table (case 09)", function()
  -- For the part that hangs free between the table and any point of it: M^2 / (2 EI) = w y - V sin theta,
  -- with the height y over the lying wire and the vertical force V at the point. With a level end this is M
  -- = sqrt(2 w h EI).
  local l, h, radius, density = 0.15, 0.075, 0.0025, 1500
  local w = density * 9.81 * math.pi * radius ^ 2
  local EI, L, width = w * l ^ 3, 5 * l, 0.02

  for _, approach in ipairs{ "imposed", "plates", "mixed" } do
    it("loads the gripper as statics says: " .. approach, function()
      local scene = sw.scene{}
      scene:obstacle{ shape = "plane", friction = 0 }
      local wire = scene:wire{ E = 4 * EI / (math.pi * radius ^ 4), nu = 0.3, density = density,
        radius = radius,        from = { 0, 0, radius }, to = { L, 0, radius }, segments = 200 }
      scene:force{ kind = "damping", mass = 4, stiffness = 2e-3 }
      local g = scene:gripper{ pads = { width = width, friction = 0.8, opening = 3 * radius } }
      scene:process(function(p)
        g:grasp(wire, { s = L - width / 2, approach = approach, force = approach ~= "imposed" and 20 or nil })
        g:move{ by = { 0, 0, h }, duration = 1 }
        p:wait(2)
      end)
      run(scene, 0.01)
      local s = L - 1.5 * width -- a little outside the pads
      local M, expected = t.lifted(g, wire, s, w, EI)
      t.share(expected, M, 0.01, "moment")
      if approach == "imposed" then -- level at the pads' face: the row h/l = 0.5
        local face = g:moment{ at = wire:position(L - width) }[2] + w * width * width / 2
        t.share((2 * w * h * EI) ^ 0.5, face, 0.01, "moment at the face")
        t.share(1.66280521 * w * l, g:force()[3] - w * width, 0.01, "force at the face")
      end
    end)
  end
end)

describe("fingers", function()
  it("of other shapes centre and hold the wire", function()
    for _, pads in ipairs{ { shape = "v" }, { shape = "round" },
      { fingers = 3, height = 0.004, below = 0.002 },
      { shape = "v", angle = math.pi / 2 } } do
      pads.opening = 0.014
      local scene = new_scene()
      local wire = new_wire(scene, { from = { -0.05, 2e-4, 0 }, to = { 0.05, 2e-4, 0 } })
      pads.width, pads.friction = 0.02, 0.1
      local g = scene:gripper{ at = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 }, pads = pads }
      scene:process(function(p)
        g:grasp(wire, { approach = "plates", force = 2 })
        p:wait(0.3)
        t.share(2, g:state().squeeze, 0.02, "force per finger")
        local f = g:force()
        t.near(0, (f[1] ^ 2 + f[2] ^ 2 + f[3] ^ 2) ^ 0.5, 0.02, "sum of forces")
        if pads.shape == "v" then
          t.near(0, wire:position(0.05)[2], 1e-4, "centred")
          t.near(0, wire:position(0.05)[3], 1e-4, "centred")
        end
      end)
      run(scene)
    end
  end)

  it("from mesh files hold it as plates of the same shape do", function()
    -- a block 20 x 8 x 10 mm whose face is at y = 0, in millimetres
    local corners = {}
    for i = 0, 7 do
      corners[i + 1] = ("v %g %g %g"):format(i % 2 == 0 and -10 or 10, i // 2 % 2 == 0 and 0 or 8,
        i // 4 == 0 and -5 or 5)
    end
    local sides = { { 1, 2, 4, 3 }, { 5, 7, 8, 6 }, { 1, 5, 6, 2 }, { 3, 4, 8, 7 },
      { 1, 3, 7, 5 }, { 2, 6, 8, 4 } }
    for _, q in ipairs(sides) do -- outward
      corners[#corners + 1] = ("f %d %d %d"):format(q[1], q[3], q[2])
      corners[#corners + 1] = ("f %d %d %d"):format(q[1], q[4], q[3])
    end
    local file = os.tmpname() .. ".obj"
    local out = assert(io.open(file, "w"))
    out:write(table.concat(corners, "\n"), "\n")
    out:close()
    local seen = {}
    for k, pads in ipairs{ { shape = "mesh", file = file, scale = 1e-3 },
      { height = 0.01, below = 0.005 } } do
      pads.opening = 2.5 * r
      grasped({ force = 4 }, pads, { model = "radial", body = "solid", E = 5e6 }, function(p, g)
        p:wait(0.1)
        seen[k] = { opening = g:state().opening, squeeze = g:state().squeeze, force = g:force() }
      end)
    end
    os.remove(file)
    t.share(4, seen[1].squeeze, 0.01, "force")
    t.share(seen[2].opening, seen[1].opening, 0.01, "opening")
    t.near(0, seen[1].force[2], 0.02, "sum")
  end)

  it("report their own share of force and moment", function()
    grasped({ force = 3 }, nil, nil, function(_, g)
      local sum = g:force()
      for k = 1, 3 do
        local a, b = g:force{ finger = 1 }, g:force{ finger = 2 }
        t.near(sum[k], a[k] + b[k], 1e-9, "sum of fingers")
      end
      t.share(-3, g:force{ finger = 1 }[2], 0.02, "the finger at +y pushes to -y")
      t.share(-3, g:force{ finger = 1, axes = "gripper" }[2], 0.02, "in the tool's axes")
      assert.error_matches(function() g:force{ finger = 3 } end, "there is no finger 3")
    end)
  end)

  it("report a map of their pressure", function()
    grasped({ force = 3 }, nil, { model = "radial", body = "solid", E = 5e6 }, function(_, g)
      local map, sum = g:pressure_map{ cell = { 0.004, 0.002 } }, 0
      for _, c in ipairs(map) do
        sum = sum + c.pressure * 0.004 * 0.002
        t.below(0.012, math.abs(c.x), "on the pad")
      end
      t.share(map.force, sum, 1e-9, "pressure times area")
      t.share(g:state().normal, map.force, 1e-9, "normal forces")
      local q = g:squeeze()
      t.above(0.01, q.share, "squeezed")
      t.above(q.height, q.width, "wider than high")
    end)
  end)
end)

describe("a gripper that moves a wire", function()
  it("reports the impulse that the wire gets", function()
    -- gravity is off: the momentum of the free wire is the gripper's impulse on it
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    scene:force{ kind = "damping", stiffness = 1e-3 }
    local wire = new_wire(scene, { to = { 0.05, 0, 0 } })
    local g = scene:gripper{ name = "hand", pads = { friction = 0.8, opening = 2.5 * r } }
    local from, to
    scene:process(function()
      g:grasp(wire, { s = 0.025, approach = "plates", force = 5 })
      from = scene.time
      g:move{ by = { 0.1, 0, 0.1 }, speed = 1, law = "minimum-jerk" }
      to = scene.time
    end)
    run(scene, 0.002)
    local mass, impulse = wire.beam.mass_per_length * wire.length, g:over(from, to).impulse
    local v = wire:velocity(0.025)
    t.near(mass * v[1], impulse[1], 2e-5, "along x")
    t.near(mass * v[3], impulse[3], 2e-5, "along z")
    local half = g:over(from, 0.5 * (from + to)).impulse -- at half time it is fastest
    t.above(1e-4, half[3], "impulse while it speeds up")
    t.near(0.1, wire:position(0.025)[3], 2e-4, "carried")
  end)
end)
