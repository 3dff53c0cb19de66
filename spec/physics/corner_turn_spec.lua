-- SPDX-License-Identifier: GPL-3.0-or-later
-- Corners of motions that turn: their angular acceleration jumps. What a stiff cable bears along itself, and
-- what a table bears that turns under it, follow the jump at once, at any step.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local ANGLE, TIME, WAIT = 0.4, 0.4, 0.063 -- corners at 0.063, 0.196, 0.33, 0.463 s: all within steps
local ALPHA = 4.5 * ANGLE / TIME ^ 2      -- a third of the time speeds up [rad/s2]
local TOP = 1.5 * ANGLE / TIME            -- [rad/s]
local ARM, LENGTH = 0.5, 0.1

local function column(run, name)
  for _, c in ipairs(run:series().columns) do
    if c.name == name then return c.values, run:series().time end
  end
end

-- Share of the angle at a share u of the time.
local function share_at(u)
  if u > 0.5 then return 1 - share_at(1 - u) end
  return u < 0 and 0 or u < 1 / 3 and 2.25 * u ^ 2 or 1.5 * u - 0.25
end

-- A cable trails behind a gripper on an arm. Returns the smallest and largest force along it over m alpha R.
local function trails(o)
  local scene, c, s = sw.scene{ gravity = { 0, 0, 0 } }, math.cos(o.turn or 0), math.sin(o.turn or 0)
  local function at(x, y) return { c * x - s * y, s * x + c * y, 0 } end
  local wire = scene:wire{ cable = o.cable, segments = o.segments or 10,
    from = at(ARM, o.swap and 0 or -LENGTH), to = at(ARM, o.swap and -LENGTH or 0) }
  scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
  local hand = scene:gripper{ name = "hand", at = at(ARM, 0) }
  scene:process(function(p)
    hand:grasp(wire, { s = o.swap and 0 or wire.length })
    p:wait(WAIT)
    hand:rotate{ axis = { 0, 0, 1 }, angle = ANGLE, about = { 0, 0, 0 }, duration = TIME,
      law = "trapezoidal" }
    p:wait(0.05)
  end)
  local run = t.fine(scene:run{ dt = o.dt, integrator = o.integrator, tolerance = o.tolerance })
  local x, time = column(run, "hand.force_x")
  local y, low, high = column(run, "hand.force_y"), 0, 0
  for i = 1, #time do
    local middle = 0.5 * (time[i] + (time[i - 1] or 0)) -- forces of steps with a jump are means
    local angle = (o.turn or 0) + ANGLE * share_at(math.max(0, math.min(1, (middle - WAIT) / TIME)))
    local along = y[i] * math.cos(angle) - x[i] * math.sin(angle)
    low, high = math.min(low, along), math.max(high, along)
  end
  local inert = wire.beam.mass_per_length * LENGTH * ALPHA * ARM
  return low / inert, high / inert
end

describe("a corner of a turn", function()
  -- A rigid body: m alpha R, and m omega^2 L/2 since the cable's middle is behind the arm: 2 % at the top
  -- speed, of which steps of 20 ms show the mean. The cable bends a little, which changes less than 1 %.
  local function bears(o, what)
    local low, high = trails(o)
    t.near(-1, low, 0.01, "force, slowing down, over m alpha R: " .. what)
    t.near(1 + 0.5 * LENGTH * TOP ^ 2 / (ALPHA * ARM), high, 0.01, "force, speeding up: " .. what)
  end

  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 2.5", "H07V-K 10" } do
    it("gives a trailing cable its inertia at once: " .. cable, function()
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 5e-4 } do
        bears({ cable = cable, dt = dt }, ("%g ms"):format(1e3 * dt))
      end
    end)
  end

  it("does so for other methods, meshes, directions and ends", function()
    for _, method in ipairs{ "sdirk2", "bdf2" } do
      for _, dt in ipairs{ 1e-2, 2e-3 } do
        bears({ cable = "GXL 1.5", dt = dt, integrator = method }, ("%s, %g ms"):format(method, 1e3 * dt))
      end
    end
    bears({ cable = "GXL 1.5", dt = 1e-2, segments = 17, turn = 0.7, swap = true }, "turned")
    bears({ cable = "GXL 1.5", dt = 1e-2, tolerance = 1e-4 }, "by tolerance")
  end)

  -- A table turns like a seesaw under a cable at this distance from its axis. It bears m (g + alpha R) at the
  -- corner. The tilt of 0.06 rad takes 0.2 % of the weight, which is 0.9 % of m alpha R. In steps of 20 ms
  -- touches give way further than in the part of 1.3 ms that follows a corner: 2.7 % there.
  it("gives a cable on a seesaw its inertia at once", function()
    local far, angle, time = 0.3, 0.06, 0.2
    local alpha = 4.5 * angle / time ^ 2
    for _, cable in ipairs{ "GXL 1.5", "H07V-K 10" } do
      for _, method in ipairs{ "tr-bdf2", "sdirk2", "bdf2" } do
        for _, dt in ipairs(method == "tr-bdf2" and { 2e-2, 1e-2, 5e-3, 2e-3 } or { 1e-2, 2e-3 }) do
          local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
          local plate = scene:obstacle{ name = "table", shape = "box", size = { 0.8, 0.6, 0.02 },
            at = { 0, 0, -0.01 }, friction = 0.6 }
          local wire = scene:wire{ cable = cable, from = { far, -0.15, r }, to = { far, 0.15, r },
            segments = 20 }
          scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
          scene:process(function(p)
            p:wait(WAIT)
            plate:follow{ relative = true, law = "trapezoidal", duration = time, about = { 0, 0, 0 },
              points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 0, 1, 0 }, angle = -angle } }
            p:wait(time + 0.05)
          end)
          local run = t.fine(scene:run{ dt = dt, integrator = method })
          local force, at = column(run, "table.contact_force")
          local low, high = math.huge, 0
          for i, f in ipairs(force) do
            if at[i] > 0.02 then low, high = math.min(low, f), math.max(high, f) end
          end
          local mass = wire.beam.mass_per_length * 0.3
          local what = ("%s, %s, %g ms"):format(cable, method, 1e3 * dt)
          t.near(1, (high / mass - 9.81) / (alpha * far), 0.03, "largest force over m alpha R: " .. what)
          t.near(-1, (low / mass - 9.81) / (alpha * far), 0.03, "smallest force: " .. what)
        end
      end
    end
  end)
end)
