-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction that twists a wire, against the torque balance along it. Spin without friction: waves, and
-- agreement with wires that do not roll.
local core = require "softworld.core"
local tools = require "spec.physics.tools"

local near, share, below, fine = tools.near, tools.share, tools.below, tools.fine
local G = 9.81

describe("friction that twists", function()
  local r, mass, mu = 0.0025, 0.03, 0.3

  it("adds up along a wire that is rubbed across, from its free end to the clamp", function()
    for _, case in ipairs{ { 20, 0.5, { dt = 0.02, integrator = "implicit-euler" }, 3 },
      { 40, 0.5, { dt = 0.02, integrator = "implicit-euler" }, 3 },
      { 40, 0.01, { dt = 0.2, quasistatic = true }, 1 } } do
      local n, speed, run, duration = table.unpack(case)
      local s, L, GJ = core.scene{}, 0.5, 1e-4
      local belt = s:obstacle{ shape = "box", size = { 4, 8, 0.1 }, at = { 0, 0, -0.05 }, friction = mu }
      local w = s:wire{ EA = 1e4, EI = 1, GJ = GJ, mass_per_length = mass, radius = r, rolls = true,
        from = { 0, 0, r }, to = { L, 0, r }, segments = n }
      s:clamp(w, { s = 0 })
      fine(s:settle())
      belt:follow{ func = function(t) return { 0, speed * t, 0 } end, relative = true }
      fine(s:advance(run, duration))
      local torque = mu * mass * G * r -- per length
      for _, at in ipairs{ 0.2, 0.3, 0.4 } do
        share(torque * (L - at), w:twist_moment(at), 0.01, "torque at " .. at)
      end
      near(0, w:twist_moment(L), 1e-12, "torque at the end")
      near(0, w:spin(L), 0.01, "spin when all is done")
    end
  end)

  -- In a groove of 90 degrees both sides rub; friction shifts load from one side to the other.
  local function groove(n, angle, options)
    local s, L, GJ = core.scene{}, 1, 2e-4
    for _, sign in ipairs{ 1, -1 } do
      s:obstacle{ shape = "plane", friction = mu,
        rotation = { axis = { 1, 0, 0 }, angle = sign * math.pi / 4 } }
    end
    local z = r * 2 ^ 0.5
    local w = s:wire{ EA = 1e4, EI = 1e-5, GJ = GJ, mass_per_length = mass, radius = r, rolls = true,
      from = { 0, 0, z }, to = { L, 0, z }, segments = n }
    local clamp = s:clamp(w, { s = 0 })
    fine(s:settle())
    clamp:follow{ points = { { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = angle }, duration = 2,
      relative = true }
    fine(s:advance(options, 2))
    local torque = 2 ^ 0.5 * mu * mass * G * r / (1 + mu * mu) -- per length
    return w, clamp, torque, (2 * GJ * angle * torque) ^ 0.5
  end

  for _, case in ipairs{ { 0.1, { dt = 0.01 } }, { 0.3, { dt = 0.01 } },
    { 0.2, { dt = 0.1, quasistatic = true } } } do
    it(("lets the turn of a gripper go in as far as torque balance says, %g rad%s")
      :format(case[1], case[2].quasistatic and ", slowly" or ""), function()
      local w, clamp, torque, first = groove(100, table.unpack(case))
      for at = 0.05, 0.95, 0.05 do
        near(-math.max(0, first - torque * at), w:twist_moment(at), 0.004 * first, "torque at " .. at)
      end
      share(first, clamp:moment()[1], 0.02, "torque at the gripper")
    end)
  end

  -- On a flat table the wire would roll away; this one is too stiff in bending for that.
  it("lets the turn go in as far on a table", function()
    for _, n in ipairs{ 50, 100 } do
      local s, L, GJ, angle = core.scene{}, 1, 2e-4, 0.2
      s:obstacle{ shape = "plane", friction = mu }
      local w = s:wire{ EA = 1e4, EI = 100, GJ = GJ, mass_per_length = mass, radius = r, rolls = true,
        from = { 0, 0, r }, to = { L, 0, r }, segments = n }
      fine(s:settle())
      local clamp = s:clamp(w, { s = 0 })
      clamp:follow{ points = { { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = angle },
        duration = 2, relative = true }
      fine(s:advance({ dt = 0.02 }, 2))
      local torque = mu * mass * G * r -- per length
      local first = (2 * GJ * angle * torque) ^ 0.5
      for at = 0.05, 0.95, 0.1 do
        near(-math.max(0, first - torque * at), w:twist_moment(at), 0.02 * first, "torque at " .. at)
      end
    end
  end)

  it("converges with the mesh at first order", function()
    tools.order_at_least(0.9, { 25, 50, 100 }, function(n)
      local _, clamp, _, first = groove(n, 0.2, { dt = 0.02 })
      return math.abs(clamp:moment()[1] / first - 1)
    end, "torque at the gripper")
  end)
end)

describe("spin without friction", function()
  local function wire(rolls, o)
    local s = core.scene{}
    if o.floor then s:obstacle{ shape = "plane", friction = 0 } end
    local w = s:wire{ E = 1e7, density = 1500, radius = 0.0025, segments = 20, rolls = rolls,
      from = { 0, 0, o.height }, to = { 0.5, 0, o.height }, spin_inertia = rolls and o.inertia or nil }
    return s, w
  end

  -- A wire that bends out of its plane is twisted too, and that takes a little of its energy. A falling
  -- wire lands at 0.1 s with 1 m/s, which is followed in parts (substeps) of 0.1 ms. A difference of 4e-9 m
  -- decides in which part a node is stopped, up to 0.1 mm apart, and without friction nothing takes that
  -- back. A wire that lies there from the start strikes nothing.
  for _, case in ipairs{ { "in a plane", 0, 0.05, 1e-11, 1e-11 },
    { "in space without its inertia", 0.3, 0.05, 1e-8, 1e-4, 1e-11 },
    { "sliding on the floor without its inertia", 0.3, 0.0025, 1e-8, 1e-6, 1e-11 },
    { "in space with it, nearly", 0.3, 0.05, 5e-4, 5e-4 } } do
    it("does not change a wire's motion " .. case[1], function()
      local early, late = {}, {}
      for k, rolls in ipairs{ false, true } do
        local s, w = wire(rolls, { floor = true, height = case[3], inertia = case[6] })
        s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
        w:set_velocity{ 0, case[2], 0 }
        fine(s:advance({ dt = 0.005 }, 0.095))
        early[k] = w:positions()
        fine(s:advance({ dt = 0.005 }, 0.5))
        late[k] = w:positions()
      end
      below(case[4], tools.largest_difference(early[1], early[2]), "difference before the landing [m]")
      below(case[5], tools.largest_difference(late[1], late[2]), "difference [m]")
    end)
  end

  it("stays constant", function()
    local s, w = wire(true, { floor = true, height = 0.0025 })
    w:set_velocity({ 0, 0, 0 }, { 50, 0, 0 }, { 0, 0, 0.0025 })
    fine(s:advance({ dt = 0.01 }, 1))
    near(50, w:spin(0.25), 1e-6, "spin")
    near(0, w:twist_moment(0.25), 1e-9, "torque")
  end)

  it("goes along a wire that is stopped at one end as a wave", function()
    local s = core.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ EA = 1e4, EI = 1e-2, GJ = 1e-3, mass_per_length = 0.03, radius = 0.0025,
      segments = 100, from = { 0, 0, 0 }, to = { 1, 0, 0 }, rolls = true }
    s:clamp(w, { s = 0 })
    w:set_velocity({ 0, 0, 0 }, { 10, 0, 0 }, { 0, 0, 0 })
    local inertia = w.beam.spin_inertia
    local speed = (1e-3 / inertia) ^ 0.5
    local before = s:energy().total
    share(0.5 * inertia * 10 ^ 2, before, 1e-9, "energy")
    local run = { dt = 2e-4, integrator = "implicit-midpoint" }
    fine(s:advance(run, 0.5 / speed))
    share(1e-3 * 10 / speed, w:twist_moment(0.1), 0.05, "torque behind the front")
    near(0, w:spin(0.1), 1, "spin behind the front")
    near(10, w:spin(0.9), 0.1, "spin before the front")
    fine(s:advance(run, 2 / speed))
    share(before, s:energy().total, 1e-6, "energy")
    near(-10, w:spin(0.9), 1.5, "spin on its way back")
  end)

  it("is second order in the step", function()
    local function spin(dt)
      local s = core.scene{ gravity = { 0, 0, 0 } }
      local w = s:wire{ EA = 1e4, EI = 1e-2, GJ = 1e-5, mass_per_length = 0.03, radius = 0.0025,
        segments = 4, from = { 0, 0, 0 }, to = { 1, 0, 0 }, rolls = true }
      s:clamp(w, { s = 0 })
      w:set_velocity({ 0, 0, 0 }, { 10, 0, 0 }, { 0, 0, 0 })
      fine(s:advance({ dt = dt }, 0.25))
      return w:spin(1)
    end
    local exact = spin(0.25 / 3200)
    tools.order_at_least(1.8, { 50, 100, 200 }, function(n)
      return math.abs(spin(0.25 / n) - exact)
    end, "spin")
  end)

  it("does not change the poses of a wire between two clamps", function()
    local found = {}
    for k, rolls in ipairs{ false, true } do
      local s, w = wire(rolls, { height = 0.5 })
      s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
      local clamp = s:clamp(w, { s = 0.5, direction = { 1, 0, 0 } })
      fine(s:settle())
      clamp:follow{ points = { { 0, 0, 0 }, { -0.1, 0.05, 0.02 } }, duration = 1, relative = true,
        turn = { axis = { 1, 0.2, 0 }, angle = 2.5 } }
      fine(s:advance({ dt = 0.02, quasistatic = true }, 1))
      found[k] = { w:positions(), w:twist_moment(0.25), clamp:moment() }
    end
    below(1e-7, tools.largest_difference(found[1][1], found[2][1]), "difference [m]")
    share(found[1][2], found[2][2], 1e-5, "torque")
    for k = 1, 3 do near(found[1][3][k], found[2][3][k], 1e-8, "moment") end
  end)
end)

-- Without spin inertia, a wire that is led through space between two clamps moves like one whose twist is
-- taken as a whole.
describe("a wire led between two clamps", function()
  it("moves like one that does not roll", function()
    local found = {}
    for k, rolls in ipairs{ false, true } do
      local s = core.scene{}
      local w = s:wire{ E = 5e7, density = 1500, radius = 0.0025, segments = 30, rolls = rolls,
        spin_inertia = rolls and 1e-11 or nil, from = { 0, 0, 0.5 }, to = { 0.5, 0, 0.5 } }
      s:clamp(w, { s = 0, direction = { 1, 0, 0 } })
      local clamp = s:clamp(w, { s = 0.5, direction = { 1, 0, 0 } })
      fine(s:settle())
      clamp:follow{ points = { { 0, 0, 0 }, { -0.25, 0.1, 0.1 } }, duration = 1, relative = true,
        turn = { axis = { 1, 0.3, 0.2 }, angle = 5.5 } }
      fine(s:advance({ dt = 0.005 }, 1.2))
      found[k] = { w:positions(), w:twist_moment(0.25), s:energy() }
    end
    below(1e-7, tools.largest_difference(found[1][1], found[2][1]), "difference [m]")
    share(found[1][2], found[2][2], 1e-5, "torque")
    for _, kind in ipairs{ "twist", "bend", "kinetic" } do
      share(found[1][3][kind], found[2][3][kind], 1e-4, kind)
    end
  end)
end)
