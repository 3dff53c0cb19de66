-- SPDX-License-Identifier: GPL-3.0-or-later
-- Corners of motions: their acceleration jumps, as in a trapezoidal law. A cable is stiff along itself,
-- so what it bears follows the jump at once, at any step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local WAY, TIME, WAIT = 0.2, 0.4, 0.06 -- corners at 0.06, 0.193, 0.327, 0.46 s: two within steps
local RATE = 4.5 * WAY / TIME ^ 2      -- a third of the time speeds up [m/s2]

local function series(run, name)
  for _, column in ipairs(run:series().columns) do
    if column.name == name then return column.values, run:series().time end
  end
end

-- Extremes of a column from a time on.
local function range(run, name, from)
  local values, time = series(run, name)
  local low, high = math.huge, -math.huge
  for i, v in ipairs(values) do
    if time[i] > from then low, high = math.min(low, v), math.max(high, v) end
  end
  return low, high
end

local function damped(scene) scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 } end

local function carry(what, by)
  what:follow{ relative = true, law = "trapezoidal", duration = TIME, points = { { 0, 0, 0 }, by } }
end

-- Share of the way of a trapezoidal motion at a share u of its time.
local function share_at(u)
  if u > 0.5 then return 1 - share_at(1 - u) end
  return u < 0 and 0 or u < 1 / 3 and 2.25 * u ^ 2 or 1.5 * u - 0.25
end

-- A cable behind its clamp in free space: the clamp bears m a.
local function pulled(o)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local c, s, length = math.cos(o.turn or 0), math.sin(o.turn or 0), 0.3
  local near, far = { 0, 0, 0 }, { -length * c, -length * s, 0 }
  local wire = scene:wire{ cable = o.cable, segments = o.segments or 30, from = o.swap and near or far,
    to = o.swap and far or near }
  damped(scene)
  local clamp = scene:clamp(wire, { s = o.swap and 0 or wire.length })
  scene:process(function(p)
    if o.wait then p:wait(o.wait) end
    carry(clamp, { WAY * c, WAY * s, 0 })
    p:wait(TIME + 0.1)
  end)
  local run = t.fine(scene:run{ dt = o.dt, integrator = o.integrator, tolerance = o.tolerance })
  local x_low, x_high = range(run, "clamp1.force_x", 0)
  local inert = wire.beam.mass_per_length * length * RATE * c
  return x_low / inert, x_high / inert, clamp:over().peak_force * c / inert
end

describe("a corner of a motion", function()
  -- Waves along the cable swing for a moment: 1.4 % in steps of 0.5 ms, less in longer ones.
  local function bears(o, what)
    local low, high, peak = pulled(o)
    t.share(-1, low, 0.02, "force, slowing down, over m a: " .. what)
    t.share(1, high, 0.02, "force, speeding up, over m a: " .. what)
    t.share(1, peak, 0.02, "peak over m a: " .. what)
  end

  for _, cable in ipairs{ "GXL 1.5", "H07V-K 10", "FLRY-B 0.5" } do
    it("gives a cable its inertia at once: " .. cable, function()
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 5e-4 } do
        bears({ cable = cable, dt = dt, wait = WAIT }, ("%g ms"):format(1e3 * dt))
        bears({ cable = cable, dt = dt }, ("%g ms, from the start"):format(1e3 * dt))
      end
    end)
  end

  it("does so for other methods, meshes, directions and ends", function()
    for _, method in ipairs{ "sdirk2", "tr-bdf2", "generalized-alpha" } do
      bears({ cable = "GXL 1.5", dt = 1e-2, wait = WAIT, integrator = method }, method)
    end
    bears({ cable = "GXL 1.5", dt = 1e-2, wait = WAIT, segments = 31, turn = 0.7, swap = true }, "turned")
    bears({ cable = "GXL 1.5", dt = 1e-2, wait = WAIT, tolerance = 1e-4 }, "by tolerance")
  end)

  -- Real pads carry the cable along itself. In steps of 20 ms the run had failed: 12 % of the energy came
  -- from nowhere.
  it("gives a gripped cable its inertia at once", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10" } do
      for _, dt in ipairs{ 2e-2, 1e-2, 2e-3 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ cable = cable, segments = 30, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
        damped(scene)
        local hand = scene:gripper{ name = "hand", at = { 0.29, 0, 0 },
          pads = { width = 0.02, friction = 0.6, height = 0.012 } }
        local gripped
        scene:process(function(p)
          hand:grasp(wire, { s = 0.29, approach = "plates", force = 20 })
          p:wait(0.05)
          gripped = scene.time
          hand:move{ by = { WAY, 0, 0 }, duration = TIME, law = "trapezoidal" }
          p:wait(0.1)
        end)
        local low, high = range(t.fine(scene:run{ dt = dt }), "hand.force_x", gripped)
        local inert, what = wire.beam.mass_per_length * 0.3 * RATE, ("%s, %g ms"):format(cable, 1e3 * dt)
        t.share(1, high / inert, 0.02, "force, speeding up, over m a: " .. what)
        t.share(-1, low / inert, 0.02, "force, slowing down, over m a: " .. what)
      end
    end
  end)

  -- On a table that moves up and stops: the table bears m (g + a).
  it("gives a lying cable its inertia at once", function()
    for _, dt in ipairs{ 2e-2, 1e-2, 2e-3 } do
      local scene, r = sw.scene{}, sw.cable("GXL 1.5").outer_diameter.value / 2
      local plate = scene:obstacle{ shape = "plane", friction = 0.3, name = "table" }
      local wire = scene:wire{ cable = "GXL 1.5", segments = 30, from = { 0, 0, r }, to = { 0.3, 0, r } }
      damped(scene)
      scene:process(function(p)
        p:wait(WAIT)
        carry(plate, { 0, 0, WAY })
        p:wait(TIME + 0.04)
      end)
      local run = t.fine(scene:run{ dt = dt })
      local low, high = range(run, "table.contact_force", 0.01)
      local weight = wire.beam.mass_per_length * 0.3 * 9.81
      local what = ("%g ms"):format(1e3 * dt)
      t.share(1 + RATE / 9.81, high / weight, 0.01, "largest force over the weight, " .. what)
      t.share(1 - RATE / 9.81, low / weight, 0.01, "smallest force over the weight, " .. what)
    end
  end)

  -- The table moves sideways with 1.15 mu g: the cable lags behind, catches up and slides on. Rigid
  -- body: its speed changes by mu g t until it is the table's. In the end friction has taken all work.
  it("gives a sliding cable its friction at once", function()
    local mu, g, top = 0.5, 9.81, 1.5 * WAY / TIME
    local lag = (RATE / (mu * g) - 1) -- the cable speeds up for (1 + lag) of the table's time
    -- area between both speeds while the table speeds up, and the same again while it slows down [m]
    local slip = 2 * 0.5 * top * (TIME / 3) * lag
    for _, dt in ipairs{ 1e-2, 5e-3, 2e-3 } do
      for _, turn in ipairs{ 0, 1.2 } do
        local scene, r = sw.scene{}, sw.cable("GXL 1.5").outer_diameter.value / 2
        local plate = scene:obstacle{ shape = "plane", friction = mu, name = "table" }
        local c, s = math.cos(turn), math.sin(turn)
        local wire = scene:wire{ cable = "GXL 1.5", segments = 30, from = { 0, 0, r },
          to = { 0.3 * c, 0.3 * s, r } }
        damped(scene)
        carry(plate, { WAY, 0, 0 })
        local lost = t.fine(scene:run{ dt = dt, duration = TIME + 0.1 }):ledger().lost
        local heat = mu * wire.beam.mass_per_length * 0.3 * g * slip
        t.share(heat, lost.friction, 0.01, ("heat [J] at %g ms, turned by %g"):format(1e3 * dt, turn))
      end
    end
  end)

  -- Two clamps keep a cable taut and one moves away: the force is EA over the length times the way, and
  -- the dashpot's. It must not be that of a stage that is ahead of its hold. In the series it is the mean
  -- over a step, or that at its end where both differ little.
  it("leaves a taut cable its force", function()
    for _, dt in ipairs{ 1e-2, 2e-3 } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
      damped(scene)
      scene:clamp(wire, { s = 0, name = "held" })
      local far = scene:clamp(wire, { s = 0.3 })
      local way, duration = 1e-4, 0.3
      far:follow{ relative = true, law = "trapezoidal", duration = duration,
        points = { { 0, 0, 0 }, { way, 0, 0 } } }
      local run = t.fine(scene:run{ dt = dt, duration = 0.35 })
      local values, time = series(run, "held.force")
      local full, before = wire.beam.EA / 0.3 * way, 0
      for i, force in ipairs(values) do
        local h, now = time[i] - before, share_at(time[i] / duration)
        local dashpot = 1e-3 * (now - share_at(before / duration)) / h
        local mean = 0
        for k = 1, 10 do mean = mean + share_at((before + h * (k - 0.5) / 10) / duration) / 10 end
        local off = math.min(math.abs(force / full - dashpot - mean), math.abs(force / full - dashpot - now))
        -- the quadrature of the first step is off by 6 % of its mean force, 0.01 % of the full one
        t.below(2e-3, off, ("force over the full one, off at %g s, %g ms"):format(time[i], 1e3 * dt))
        before = time[i]
      end
    end
  end)
end)
