-- SPDX-License-Identifier: GPL-3.0-or-later
-- Every check of run:check gives the value of a formula, within the share written beside it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local capstan = require "spec.check.capstan"
local registry = require "softworld.check.registry"

local g, R, RADIUS = 9.81, capstan.R, capstan.RADIUS

local function still(options)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  for key, value in pairs{ name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02,
    radius = RADIUS, segments = 20 } do
    if options[key] == nil then options[key] = value end
  end
  if not options.path then options.from, options.to = { 0, 0, 0 }, { 0.3, 0, 0 } end
  return scene, scene:wire(options)
end

-- A piece of a circle that is stress-free in this shape.
local function arc()
  local path = {}
  for i = 0, 40 do path[i + 1] = { R * math.sin(i / 20), 0, R * (1 - math.cos(i / 20)) } end
  local scene = still{ path = path, rest = "path", segments = 40 }
  return scene:run{ duration = 0.02, dt = 0.01 }
end

-- A wire stretched by 1 % in one second, then held.
local function pulled()
  local scene, wire = still{}
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = 0.3 }):follow{ points = { { 0, 0, 0 }, { 3e-3, 0, 0 } }, relative = true,
    duration = 1, law = "linear" }
  return scene:run{ duration = 1.2, dt = 0.01, frame = 0.01 }
end

-- A wire twisted by 1 rad over its length, with a frame of every step.
local function twisted()
  local scene, wire = still{}
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = 0.3 }):follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } },
    turn = { axis = { 1, 0, 0 }, angle = 1 }, relative = true, duration = 1, law = "linear" }
  return scene:run{ duration = 1, dt = 0.02, frame = 0.02 }
end

-- A string drawn over a cylinder by its end, with a frame of every step. Its tension where it leaves is T_in
-- exp(mu angle). duration: of the last run, at 0.02 m/s.
local function drawn_over(duration)
  local mu = 0.3
  local scene, _, pin, along = capstan.scene{ friction = mu, angle = math.pi, segments = 240, around = 100,
    lead = 10 }
  scene:run{ duration = 0.2, dt = 0.002 }
  pin:follow{ points = capstan.draw(along, 0.03), relative = true, speed = 0.02, law = "linear" }
  scene:run{ duration = 0.6, dt = 0.002 }
  return scene:run{ duration = duration, dt = 0.002, frame = 0.002, wear = true },
    math.exp(mu * math.pi) / (R + RADIUS)
end

-- The place that leaves the cylinder at the end of the run has gone round a part of the cylinder, under the
-- tension T_in exp(mu angle). The normal force per angle is T, so its sum over the way is the integral of
-- exp(mu angle) [N].
local drawn
local function slid()
  drawn = drawn or drawn_over(0.4)
  local part, mu = 0.02 * 0.4 / (R + RADIUS), 0.3
  return drawn, (math.exp(mu * math.pi) - math.exp(mu * (math.pi - part))) / mu
end

-- A gripper holds a stiff wire still, at its middle or at s. It bears the weight of the wire.
local function held(s)
  local scene = sw.scene{}
  local wire = scene:wire{ name = "w", EA = 1e5, EI = 10, mass_per_length = 0.02, radius = RADIUS,
    segments = 20, from = { -0.05, 0, 0.2 }, to = { 0.05, 0, 0.2 } }
  scene:force{ kind = "damping", mass = 20, on = wire }
  local hand = scene:gripper{ name = "hand", at = { 0, 0, 0.2 }, pads = { width = 0.02, friction = 0.5 } }
  scene:process(function(p)
    hand:grasp(wire, { s = s or 0.05 })
    p:wait(0.4)
  end)
  return scene:run{ dt = 0.005 }
end

-- Pads have lifted a stiff wire from a table and hold it still.
local function lifted(force)
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 20 }
  local wire = scene:wire{ name = "w", EA = 1e5, EI = 1, mass_per_length = 0.02, radius = RADIUS,
    segments = 20, from = { -0.05, 0, RADIUS }, to = { 0.05, 0, RADIUS } }
  local hand = scene:gripper{ name = "hand", pads = { width = 0.02, friction = 0.5, opening = 0.004 } }
  scene:process(function()
    hand:grasp(wire, { s = 0.05, approach = "plates", force = force })
    hand:move{ by = { 0, 0, 0.02 }, duration = 0.5 }
  end)
  scene:run{ dt = 0.005 }
  scene:run{ duration = 0.3, dt = 0.005 }
  return scene:run{ duration = 0.1, dt = 0.005 }
end

-- A wire lies on a table under its weight, 3 mm beside a straight line. Returns the run and how deep the
-- lowest node sank below the plane in any step.
local function lying()
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = RADIUS,
    segments = 20, from = { 0, 0.003, RADIUS }, to = { 0.3, 0.003, RADIUS } }
  local deepest = 0
  scene:observe{ call = function()
    local x = wire:positions()
    for i = 3, #x, 3 do deepest = math.max(deepest, RADIUS - x[i]) end
  end }
  return scene:run{ duration = 0.25, dt = 0.01 }, deepest
end

-- A wire lies 3 mm beside y = 0, with zones beside it and zones that it lies in.
local function between_zones()
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  scene:wire{ name = "w", EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = RADIUS, segments = 20,
    from = { 0, 0.003, 0 }, to = { 0.3, 0.003, 0 } }
  scene:zone{ shape = "sphere", radius = 0.02, at = { 0.101, 0.063, 0 } }
  scene:zone{ name = "hot", shape = "box", size = { 0.02, 0.1, 0.1 }, at = { 0.2, 0, 0 }, temperature = 90 }
  scene:zone{ name = "cold", shape = "sphere", radius = 0.05, temperature = -30 }
  scene:zone{ name = "far", shape = "sphere", radius = 0.05, at = { 1, 0, 0 }, temperature = 500 }
  return scene:run{ duration = 0.02, dt = 0.01 }
end

-- Holds press a stiff wire into a clip. A force smaller than the clip's retention then pulls it outward.
local clipped
local function in_clip()
  if clipped then return clipped end
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e5, EI = 10, mass_per_length = 0.05, radius = 0.004,
    segments = 20, from = { -0.05, 0, 0.03 }, to = { 0.05, 0, 0.03 } }
  scene:force{ kind = "damping", mass = 20, on = wire }
  scene:clip{ name = "clip", at = { 0, 0, 0 }, width = 0.01, insertion = 8, retention = 20 }
  local ends = { scene:clamp(wire, { s = 0.02 }), scene:clamp(wire, { s = 0.08 }) }
  for _, hold in ipairs(ends) do
    hold:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.03 } }, relative = true, duration = 1, law = "linear" }
  end
  scene:run{ duration = 1.2, dt = 0.001 }
  for _, hold in ipairs(ends) do hold:release() end
  scene:force{ kind = "point", on = wire, s = 0.05, force = { 0, 0, 5 } }
  clipped = scene
  return scene
end

-- A rod of 1 m, clamped at both ends, at rest; returns the run and its lowest frequency.
local function beam()
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e5, EI = 0.01, mass_per_length = 0.03, radius = 0.002,
    segments = 50, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = 1 })
  -- reference case 04: lambda = 22.373285 of the lowest mode
  return scene:run{ duration = 0.02, dt = 0.01 }, 22.373285 / (2 * math.pi) * math.sqrt(0.01 / 0.03)
end

-- A tube along x, pressed at its middle by two narrow plates that come nearer by a tenth of its diameter.
-- Returns the run, the wire and the radius of the ring of particles at the start.
local function squeezed()
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", E = 5e6, density = 1200, radius = 0.004, model = "tube",
    particles = 15, normal = { 0, 0, 1 }, from = { 0, 0, 0 }, to = { 0.03, 0, 0 } }
  local first = wire:section(0).particles[1]
  scene:force{ kind = "damping", on = wire, mass = 50 }
  for side = -1, 1, 2 do
    local plate = scene:obstacle{ shape = "box", size = { 0.006, 0.1, 0.1 }, at = { 0.015, 0, 0.054 * side } }
    plate:follow{ points = { { 0, 0, 0 }, { 0, 0, -4e-4 * side } }, relative = true, duration = 0.5 }
  end
  return scene:run{ duration = 0.6, dt = 0.01 }, wire, math.sqrt(first[2] ^ 2 + first[3] ^ 2)
end

-- The ovalisation of a section of that tube: (largest - least) / (largest + least) of the widths of the
-- smooth curve through its n particles. n is odd: the curve has the harmonics up to (n - 1) / 2. beyond: how
-- far the surface is outside of the curve [m].
local function ovalisation(section, beyond)
  local p, curve = section.particles, {}
  local n = #p
  for i = 1, 360 do
    local y, z = 0, 0
    for k = 1, n do
      local share, angle = 1, math.rad(i) - 2 * math.pi * k / n
      for m = 1, (n - 1) // 2 do share = share + 2 * math.cos(m * angle) end
      y, z = y + share / n * p[k][2], z + share / n * p[k][3]
    end
    curve[i] = { y, z }
  end
  local least, largest = math.huge, 0
  for i = 1, 180 do
    local low, high, c, s = math.huge, -math.huge, math.cos(math.rad(i)), math.sin(math.rad(i))
    for _, q in ipairs(curve) do
      local at = c * q[1] + s * q[2]
      low, high = math.min(low, at), math.max(high, at)
    end
    least, largest = math.min(least, high - low), math.max(largest, high - low)
  end
  return (largest - least) / (largest + least + 4 * beyond)
end

local weight = 0.02 * 0.1 * g

-- Name of the check -> a run, arguments of run:check, the value by formula, the allowed error as a share.
local cases = {
  min_bend_radius = function() return arc(), {}, R - RADIUS, 0.01 end,
  end_bend_radius = function() return arc(), {}, R - RADIUS, 0.01 end,
  max_tension = function() return pulled(), {}, 1e4 * 0.01, 1e-3 end,
  max_strain = function() return pulled(), {}, 0.01, 1e-3 end,
  max_stress = function() return pulled(), {}, 1e4 * 0.01 / (math.pi * RADIUS ^ 2), 1e-3 end,
  max_sidewall = function()
    local run, value = drawn_over(0.2)
    return run, {}, value, 0.01
  end,
  max_torsion = function() return twisted(), {}, 1 / 0.3, 0.01 end,
  -- Tension from 0 to 100 N on a curve through 100 N, 500 cycles. The first pass counts half a cycle, each
  -- repeat a whole one.
  fatigue = function()
    local curve = { { 10, 5e5 }, { 100, 500 } }
    return pulled(), { fatigue = { curve = curve, repeats = 20 } }, (0.5 + 19) / 500, 0.01
  end,
  friction_work = function()
    local run, value = slid()
    return run, { abrasion = { coefficient = 1, width = 1e-3 } }, 0.3 * value / 1e-3, 0.01
  end,
  wear_depth = function()
    local run, value = slid()
    return run, { abrasion = { coefficient = 1e-12, width = 1e-3, repeats = 50 } }, 50 * 1e-12 * value / 1e-3,
      0.01
  end,
  landing_error = function()
    return lying(), { landing = { path = { { -1, 0, RADIUS }, { 1, 0, RADIUS } } } }, 0.003, 1e-3
  end,
  clearance = function() return between_zones(), {}, 0.06 - 0.02 - RADIUS, 1e-9 end,
  max_temperature = function() return between_zones(), {}, 90, 0 end,
  min_temperature = function() return between_zones(), {}, -30, 0 end,
  -- The band ends at half the lowest frequency f. The gap is (f - f/2) / (f/2) = 1.
  frequency_gap = function()
    local run, f = beam()
    return run, { vibration = { bands = { { 1e-3, f / 2 } } } }, 1, 0.01
  end,
  -- Miles' formula for the lowest mode: shape times participation at the middle is 1.588146 x 0.830862
  vibration_amplitude = function()
    local run, f = beam()
    local sigma = math.sqrt(2 / (2 * 0.02) / (32 * math.pi ^ 3 * f ^ 3)) * 1.588146 * 0.830862
    return run, { vibration = { spectrum = { { 0.1, 2 }, { 10, 2 } }, damping = 0.02, modes = 2,
      direction = { 0, 0, 3 } } }, 3 * sigma, 0.01
  end,
  peak_force = function() return held(), {}, weight, 0.01 end,
  peak_moment = function() return held(0.03), {}, weight * 0.02, 0.01 end,
  mean_force = function() return held(), {}, weight, 0.01 end,
  peak_margin = function() return lifted(0.1), {}, weight / (0.5 * 2 * 0.1), 0.02 end,
  insertion_force = function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e5, EI = 10, mass_per_length = 0.05, radius = 0.004,
      segments = 20, from = { -0.05, 0, 0.01 }, to = { 0.05, 0, 0.01 } }
    scene:force{ kind = "damping", mass = 20, on = wire }
    scene:clip{ name = "clip", at = { 0, 0, 0 }, width = 0.01, insertion = 8, retention = 20 }
    for _, s in ipairs{ 0.02, 0.08 } do
      scene:clamp(wire, { s = s }):follow{ points = { { 0, 0, 0 }, { 0, 0, -0.01 } }, relative = true,
        duration = 1, law = "linear" }
    end
    return scene:run{ duration = 1.1, dt = 0.001 }, {}, 8, 0.01
  end,
  -- a pull of 5 N out of 20 N
  retention_used = function()
    return in_clip():run{ duration = 0.02, dt = 0.01, quasistatic = true }, {}, 0.25, 0.01
  end,
  -- the wire hangs by the tie: its weight of 0.0981 N out of 0.3924 N
  strength_used = function()
    local scene = sw.scene{}
    local wire = scene:wire{ EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02, radius = 0.002,
      from = { 0, 0, 0 }, to = { 0, 0, -0.5 }, segments = 10 }
    scene:tie(wire, { s = 0, to = { 0, 0, 0 }, strength = 0.3924 })
    return scene:run{ duration = 0.02, dt = 0.01, quasistatic = true }, {}, 0.25, 0.01
  end,
  seated = function() return in_clip():run{ duration = 0.02, dt = 0.01, quasistatic = true }, {}, 1, 0 end,
  pad_load = function() return lifted(0.1), {}, 0.1 / 0.02, 0.01 end,
  opening = function() return lifted(0.1), {}, 2 * RADIUS, 0.01 end, -- the pads are closed on the wire
  penetration = function()
    local run, deepest = lying()
    return run, {}, deepest, 1e-9
  end,
  -- The plates are nearest at the end of the run. Widths are sampled at each degree: to 1e-3.
  max_ovalisation = function()
    local run, wire, ring = squeezed()
    local most = 0
    for i = 0, wire.segments do
      most = math.max(most, ovalisation(wire:section(wire.length * i / wire.segments), 0.004 - ring))
    end
    return run, {}, most, 2e-3
  end,
  kinks = function() return lying(), {}, 0, 0 end,
  events = function() return lying(), {}, 0, 0 end,
  cycle_time = function() return lying(), {}, 0.25, 1e-9 end,
}

describe("run:check:", function()
  for _, member in ipairs(registry.list) do
    it(member.name .. " is that of its formula", function()
      local case = assert(cases[member.name], "there is no case of " .. member.name)
      local run, args, value, share = case()
      assert(run.ok, run.reason)
      args.limits = { [member.name] = { max = 1e9, min = -1e9, sure = true } }
      local row = run:check(args):row(member.name)
      print(("measured: %s = %.6g, formula %.6g"):format(member.name, row.value, value))
      assert.equal(member.unit, row.unit)
      assert.is_true(math.abs(row.value - value) <= share * math.abs(value),
        ("%s: %.6g instead of %.6g"):format(member.name, row.value, value))
    end)
  end
end)
