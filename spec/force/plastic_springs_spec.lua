-- SPDX-License-Identifier: GPL-3.0-or-later
-- Springs that yield, compared with their law computed by hand.
local sw = require "softworld"

local function near(expected, value, tolerance, what)
  assert.is_true(math.abs(value - expected) <= tolerance,
    ("%s: %.12g instead of %.12g"):format(what or "value", value, expected))
end

local K, YIELD, HARD = 200, 0.05, 0.25 -- [N/m], [-], [-]

-- A spring of 1 m between two held particles; returns a function that sets its length.
local function bench(more)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local link = { 1, 2, k = K, yield = YIELD, hardening = HARD }
  for k, v in pairs(more or {}) do link[k] = v end
  local object = scene:particles{ positions = { 0, 0, 0, 1, 0, 0 }, masses = 1, links = { link } }
  scene:hold(object, { particles = { 1 } })
  local hand = scene:hold(object, { particles = { 2 } })
  local function stretch(length, method)
    hand:pose{ length, 0, 0 }
    if method == "settle" then
      assert.is_true(scene:settle().ok)
    else
      assert.is_true(scene:run{ duration = 0.01, dt = 0.01, quasistatic = method ~= "motion" }.ok)
    end
    return object:links()
  end
  return scene, object, hand, stretch
end

-- The law step by step: radial return with kinematic hardening.
local function model()
  local p, work = 0, 0
  return function(d)
    local xi = K * d - (1 + HARD) * K * p
    local over = math.max(0, math.abs(xi) - K * YIELD)
    local flow = over / ((1 + HARD) * K) * (xi < 0 and -1 or 1)
    p = p + flow
    work = work + K * YIELD * math.abs(flow)
    return K * (d - p), p, work
  end
end

describe("springs that yield", function()
  for _, method in ipairs{ "settle", "pose" } do
    it("follow their stress-strain curve there and back: " .. method, function()
      local scene, object, _, stretch = bench()
      local law = model()
      local lengths = { 1.03, 1.05, 1.08, 1.2, 1.15, 1.05, 0.9, 0.95, 1.1, 1 }
      for _, l in ipairs(lengths) do
        local force, strain, plastic = stretch(l, method)
        local T, p, work = law(l - 1)
        near(T, force[1], 1e-9, "force at " .. l)
        near(l - 1, strain[1], 1e-12)
        near(p, plastic[1], 1e-12)
        near(work, scene:energy().dissipated, 1e-10, "work")
        near(work, object:energy().dissipated, 1e-10)
        -- stored energy: in the spring, and in hardening
        local energy = object:energy()
        near(0.5 * T * T / K, energy.stretch, 1e-10)
        near(0.5 * HARD * K * p * p, energy.plastic_springs, 1e-10)
      end
    end)
  end

  it("pull at a hold with the force of the law", function()
    local _, _, hand, stretch = bench()
    stretch(1.2)
    local T = model()(0.2)
    near(T, hand:force()[1], 1e-9) -- pulls the particle outwards
  end)

  it("flow without gaining force where they do not harden", function()
    local _, _, _, stretch = bench{ hardening = 0 }
    near(K * YIELD, (stretch(1.3))[1], 1e-9)
    near(K * YIELD, (stretch(1.5))[1], 1e-9)
    near(-K * YIELD, (stretch(1.2))[1], 1e-9)
  end)

  it("are elastic below their limit; springs without a limit always are", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local object = scene:particles{ positions = { 0, 0, 0, 1, 0, 0, 2, 0, 0 }, masses = 1,
      links = { { 1, 2, k = K, yield = 10 }, { 2, 3, k = K } } }
    scene:hold(object, { particles = { 1 } })
    local hand = scene:hold(object, { particles = { 3 } })
    hand:pose{ 3, 0, 0 }
    assert.is_true(scene:settle().ok)
    local force, _, plastic = object:links()
    near(0.5 * K, force[1], 1e-8)
    near(0.5 * K, force[2], 1e-8)
    assert.are.same({ 0, 0 }, plastic)
  end)

  -- A mass falls onto the spring and swings until no swing yields any more. Energy is conserved except for
  -- what was dissipated.
  it("take their plastic work from the motion", function()
    local scene = sw.scene{}
    local object = scene:particles{ positions = { 0, 0, 0, 0, 0, -1 }, masses = 1,
      links = { { 1, 2, k = K, yield = YIELD, hardening = HARD } } }
    scene:hold(object, { particles = { 1 } })
    object:set_velocity{ 0, 0, 0, 0, 0, -2 }
    local before = scene:energy()
    local run = scene:run{ duration = 2, dt = 1e-3 }
    assert.is_true(run.ok, run.reason)
    local after = scene:energy()
    assert.is_true(after.dissipated > 1)
    -- the step resolves a swing by 440 steps: the scheme loses about 1e-4 of the energy in one
    near(before.total, after.total + after.dissipated, 1e-3 * math.abs(before.total))
  end)

  it("go on the same from snapshots", function()
    local scene, _, hand, stretch = bench()
    stretch(1.2)
    local snapshot = scene:snapshot()
    local first = { stretch(0.95) }
    local work = scene:energy().dissipated
    scene:restore(snapshot)
    assert.are.same(first, { stretch(0.95) })
    assert.are.equal(work, scene:energy().dissipated)
    assert.is_truthy(hand.held)
  end)

  it("keep their plastic strain when something else is held or let go", function()
    local scene, object, hand, stretch = bench()
    local _, _, plastic = stretch(1.2)
    hand:release()
    scene:force{ kind = "damping", on = object, mass = 1 }
    local _, _, later = object:links()
    assert.are.same(plastic, later)
    assert.is_true(scene:settle().ok)
    local force, strain = object:links()
    near(0, force[1], 1e-8)
    near(plastic[1], strain[1], 1e-10) -- unloaded: only plastic strain is left
  end)

  it("yield in wires made of particles too", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ model = "tube", EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.05,
      from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    scene:force{ kind = "plastic_springs", on = wire, yield = 0.02 }
    scene:clamp(wire, { s = 0 })
    local hand = scene:clamp(wire, { s = 1 })
    hand:pose{ 1.1, 0, 0 }
    local result = scene:settle()
    assert.is_true(result.ok, result.reason)
    assert.is_true(hand:force()[1] < 0.6 * 60 * 0.1) -- elastic it would be EA times the strain
    hand:release()
    assert.is_true(scene:settle().ok)
    assert.is_true(wire:position(1)[1] > 1.04)
    assert.is_true(scene:energy().dissipated > 0)
  end)
end)
