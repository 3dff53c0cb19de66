-- SPDX-License-Identifier: GPL-3.0-or-later
-- Holds that start abruptly: the impulse is the momentum that the wire gains, at any step. Through a window
-- longer than the jerk, the peak force is that impulse over the window.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local V, L = 0.4, 0.3

-- A damped wire in space. A hold at its middle draws it along its axis, abruptly at speed V. Axial waves
-- cross the wire in well under a millisecond.
local function drawn(cable, dt, integrator)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local args = { from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 30, cable = cable or nil }
  if not cable then args.E, args.density, args.radius = 5e7, 1500, 0.0025 end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, stiffness = 1e-3 }
  local hand = scene:gripper{}
  scene:process(function(p)
    hand:grasp(wire, { s = L / 2 })
    p:wait(0.03)
    hand:move{ by = { 0.04, 0, 0 }, speed = V, law = "linear" }
  end)
  t.fine(scene:run{ dt = dt, duration = 0.09, integrator = integrator })
  -- three nodes get the hold's speed at once; the hold does not bear their momentum
  return hand, (1 - 3 / 30) * wire.beam.mass_per_length * L * V
end

describe("a hold that starts at once", function()
  for _, cable in ipairs{ false, "GXL 1.5", "FLRY-B 10" } do
    it(("gives its momentum and no more: %s"):format(cable or "soft"), function()
      for _, dt in ipairs{ 0.01, 0.005, 0.002, 0.0005 } do
        local hand, momentum = drawn(cable, dt)
        local all = hand:over()
        -- forces at the steps' ends would add up to -5.8 times the momentum at 10 ms
        t.share(momentum, all.impulse[1], 0.03, ("impulse at %g s"):format(dt))
        -- a soft wire's waves run to and fro within the window
        if cable then t.share(momentum / 0.01, all.peak_force, 0.06, ("peak at %g s"):format(dt)) end
      end
    end)
  end

  it("gives the same momentum with other methods", function()
    for _, method in ipairs{ "implicit-euler", "implicit-midpoint", "sdirk2" } do
      local hand, momentum = drawn("GXL 1.5", 0.002, method)
      t.share(momentum, hand:over().impulse[1], 0.03, method)
    end
  end)

  -- The first step of a run does not know the forces at its start. All work of the drive is done between
  -- its ends: by the forces of the ends alone a quarter of the energy in play came from nowhere, and the run
  -- ended.
  for _, case in ipairs{ { "GXL 1.5", 0.3, 1e-3 }, { "FLRY-B 0.5", 0.1, 0 }, { "H07V-K 4", 0.3, 0 } } do
    local cable, mu, lag = table.unpack(case)
    it(("may do so in the first step, with a cable on a table: %s, mu = %g"):format(cable, mu), function()
      for _, speed in ipairs{ 0.02, 0.15 } do
        for _, dt in ipairs{ 0.01, 0.005, 0.001 } do
          local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
          scene:obstacle{ shape = "plane", friction = mu }
          local wire = scene:wire{ cable = cable, from = { 0, 0, r }, to = { -L, 0, r }, segments = 30 }
          if lag > 0 then scene:force{ kind = "damping", mass = 0, stiffness = lag } end
          local hold = scene:clamp(wire, { s = 0 })
          hold:follow{ relative = true, points = { { 0, 0, 0 }, { 0.6 * speed, 0, 0 } }, law = "linear",
            duration = 0.6 }
          local books = t.fine(scene:run{ dt = dt, duration = 0.5 }):ledger()
          t.below(0.005, books.gap / books.play, "energy from nowhere over that in play")
          -- half of the work of such a start (momentum times speed) is lost, half becomes kinetic energy;
          -- without dashpots, waves run on; the clamp's node does not rub
          if lag > 0 then
            local weight = 9.81 * wire.beam.mass_per_length * (1 - 1 / 60) * L
            t.share(mu * weight, hold:force()[1], 0.02, "pull [N]")
          end
          t.fine(scene:run{ dt = dt, duration = 0.3 })
        end
      end
    end)
  end

  -- Steps end where the velocity of a drive jumps. Within a step a jump had a peak force of up to 1.9 times
  -- as much, by where it was; at the end of a step it had the event `energy`, for the own node of the hold.
  -- The times of jumps of a Lua function are found from its values.
  local function from_law(hold, start, duration)
    hold:follow{ relative = true, points = { { 0, 0, 0 }, { 0.075, 0, 0 } }, law = "linear", start = start,
      duration = duration }
  end
  local function from_function(hold, start, duration)
    local at = hold:pose()
    hold:follow(function(time)
      local share = math.max(0, math.min(1, (time - start) / duration))
      return { at[1] + 0.075 * share, at[2], at[3] }
    end)
  end
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it(("gives the same peak wherever in a step it starts and stops: %s"):format(cable), function()
      local expected
      for _, times in ipairs{ { 0.1, 0.5 }, { 0.1, 0.5037 }, { 0.1083, 0.5 } } do
        for _, dt in ipairs{ 0.01, 0.005, 0.002 } do
          for _, follow in ipairs{ from_law, from_function } do
            local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
            scene:obstacle{ shape = "plane", friction = 0.3 }
            local wire = scene:wire{ cable = cable, from = { 0, 0, r }, to = { -L, 0, r }, segments = 30 }
            scene:force{ kind = "damping", mass = 0.5, stiffness = 2e-3 }
            local hold = scene:clamp(wire, { s = 0 })
            follow(hold, table.unpack(times))
            -- steps are equal parts of the duration; a function cannot be restored
            local run = t.fine(scene:run{ dt = dt, duration = follow == from_law and 0.8 or 0.8037 })
            assert.are.same({}, run.events)
            expected = expected or hold:over().peak_force
            t.share(expected, hold:over().peak_force, 0.02,
              ("peak at %g s, from %g s on"):format(dt, times[1]))
          end
        end
      end
    end)
  end

  -- 16 mm in 0.2 s, to and fro, then on at once at a tenth of the speed: speeds jump by 0.16 and 0.088 m/s.
  it("is found in a function in steps by tolerance, and where it turns back", function()
    local function peak(args)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 30 }
      scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 2e-3 }
      local hold = scene:clamp(wire, { s = 0 })
      hold:follow(function(time)
        local x = time < 0.2 and 0.08 * time or time < 0.4 and 0.08 * (0.4 - time) or 0.008 * (time - 0.4)
        return { x, 0, 0 }
      end)
      args.duration = 0.6
      t.fine(scene:run(args))
      return hold:over().peak_force
    end
    local fine = peak{ dt = 0.0002 }
    for _, dt in ipairs{ 0.01, 0.0073, 0.003 } do t.share(fine, peak{ dt = dt }, 0.03, dt) end
    t.share(fine, peak{ dt = 0.01, tolerance = 1e-3 }, 0.03, "by tolerance")
  end)

  -- Measured poses have noise, or are rounded. Each of them jumps, and steps that end at each would have no
  -- end.
  it("is not looked for in noise and in places that jump", function()
    local function noise(time) return math.sin(12345.678 * time) * 43758.5453 % 1 - 0.5 end
    for name, off in pairs{ noise = function(time) return 1e-6 * noise(time) end,
      ["rounded to 10 nm"] = function(time) return -(0.05 * time % 1e-8) end } do
      local scene, r = sw.scene{}, sw.cable("GXL 1.5").outer_diameter.value / 2
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, r }, to = { -L, 0, r }, segments = 30 }
      scene:force{ kind = "damping", mass = 0.5, stiffness = 2e-3 }
      local hold = scene:clamp(wire, { s = 0 })
      hold:follow(function(time) return { 0.05 * time + (time > 0 and off(time) or 0), 0, r } end)
      local run = t.fine(scene:run{ dt = 0.01, duration = 0.3 })
      -- 30 steps, and parts of the blow at the start
      t.below(60, run.steps, name)
    end
  end)
end)
