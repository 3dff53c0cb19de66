-- SPDX-License-Identifier: GPL-3.0-or-later
-- Viscous bending: a moment proportional to the rate of curvature.
local sw = require "softworld"
local tools = require "physics.tools"

local EI, MASS = 0.02, 0.05

local function wire_of(options)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e5, EI = EI, mass_per_length = MASS, radius = 0.002,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = options.N or 20 }
  if options.eta then scene:force{ kind = "viscous_bend", on = wire, eta = options.eta } end
  return scene, wire
end

-- Returns the heights and times of the largest deflections to one side.
local function peaks(scene, wire, duration, dt)
  local list, y = {}, {}
  for i = 1, math.ceil(duration / dt) do
    scene:run{ duration = dt, dt = dt, integrator = "implicit-midpoint" }
    y[i] = wire:position(1)[3]
    local a, b, c = y[i - 2], y[i - 1], y[i]
    if a and b > a and b >= c and b > 0 then
      local slope, bend = 0.5 * (c - a), a - 2 * b + c
      list[#list + 1] = { b - 0.5 * slope ^ 2 / bend, (i - 1 - slope / bend) * dt }
    end
  end
  return list
end

describe("viscous bending", function()
  it("damps the first mode by eta omega / (2 EI)", function()
    local omega = 1.875104068711961 ^ 2 * (EI / MASS) ^ 0.5
    for _, ratio in ipairs{ 0.02, 0.1 } do
      local scene, wire = wire_of{ eta = ratio * 2 * EI / omega }
      scene:clamp(wire, { s = 0 })
      local pull = scene:force{ kind = "point", on = wire, s = 1, force = { 0, 0, 6e-5 } }
      tools.fine(scene:settle())
      pull:release()
      local list = peaks(scene, wire, 9, 0.01)
      -- the first peak may still hold higher modes
      local a, b = list[2], list[#list]
      local decrement = math.log(a[1] / b[1]) / (#list - 2)
      tools.share(ratio, decrement / (4 * math.pi ^ 2 + decrement ^ 2) ^ 0.5, 0.01, "damping ratio")
      local period = (b[2] - a[2]) / (#list - 2)
      tools.share(omega * (1 - ratio ^ 2) ^ 0.5, 2 * math.pi / period, 0.005, "frequency")
    end
  end)

  -- The power is the sum over hinges of eta / w (rate of the angle)^2. The wire's edges turn by known rates
  -- in a plane, on top of any rotation of the whole.
  it("takes eta / w times the square of each hinge's rate in a plane", function()
    local scene, wire = wire_of{ eta = 0.3, N = 7 }
    local x, v, angle, rate = { 0, 0, 0 }, { 0, 0, 0 }, {}, {}
    local random = tools.random(4)
    for e = 1, 7 do
      angle[e] = (angle[e - 1] or 0) + 0.6 * random()
      rate[e] = 5 + 3 * random()
      local c, s = math.cos(angle[e]) / 7, math.sin(angle[e]) / 7
      for _, value in ipairs{ x[#x - 2] + c, 0, x[#x] + s } do x[#x + 1] = value end
      for _, value in ipairs{ v[#v - 2] - rate[e] * s, 0, v[#v] + rate[e] * c } do v[#v + 1] = value end
    end
    local f = scene:evaluate(wire, { positions = x, velocities = v }).viscous_bend.force
    local power, exact = 0, 0
    for i = 1, #x do power = power + f[i] * v[i] end
    for e = 2, 7 do exact = exact - 0.3 * 7 * (rate[e] - rate[e - 1]) ^ 2 end
    tools.share(exact, power, 1e-12, "power")
  end)

  it("does not act on a wire that turns in its plane", function()
    local scene, wire = wire_of{ eta = 1, N = 9 }
    local x, v = {}, {}
    for i = 0, 9 do
      local a, b = 0.2 * math.cos(0.4 * i), 0.2 * math.sin(0.4 * i)
      for _, value in ipairs{ a, b, 0 } do x[#x + 1] = value end
      for _, value in ipairs{ -b, a, 0 } do v[#v + 1] = value end
    end
    for _, f in ipairs(scene:evaluate(wire, { positions = x, velocities = v }).viscous_bend.force) do
      tools.near(0, f, 1e-12, "force")
    end
  end)

  it("counts the rate between a clamp and its edge", function()
    local scene, wire = wire_of{ eta = 0.5, N = 10 }
    scene:clamp(wire, { s = 0 })
    local x, s = wire:positions()
    local v = {}
    for i = 1, #s do
      v[3 * i - 2], v[3 * i - 1], v[3 * i] = 0, 0, 2 * s[i] -- turns at 2 rad/s
    end
    local f = scene:evaluate(wire, { positions = x, velocities = v }).viscous_bend.force
    local power = 0
    for i = 1, #f do power = power + f[i] * v[i] end
    tools.share(-0.5 / (5 / 12 * 0.1) * 2 ^ 2, power, 1e-12, "power")
  end)

  it("does not act at rest, where moving clamps count as standing", function()
    local function droop(eta)
      local scene, wire = wire_of{ eta = eta }
      scene:gravity{ 0, 0, -1 }
      local clamp = scene:clamp(wire, { s = 0 })
      clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.3 } }, turn = { axis = { 0, 1, 0 }, angle = 1 },
        duration = 1 }
      scene:run{ duration = 0.5, dt = 0.01 }
      tools.fine(scene:settle())
      return wire:position(1)
    end
    tools.near(0, tools.distance(droop(5), droop()), 1e-7, "end")
  end)

  it("needs eta", function()
    for _, args in ipairs{ {}, { eta = -1 }, { eta = 0 / 0 }, { nu = 1 } } do
      local scene = wire_of{}
      args.kind = "viscous_bend"
      assert.has_error(function() scene:force(args) end)
    end
  end)
end)
