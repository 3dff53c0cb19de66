-- SPDX-License-Identifier: GPL-3.0-or-later
-- A tie at the end of a cable snaps taut. It stops the light end within 0.1 ms and throws it back. In steps
-- of 20 to 0.1 ms its peak (mean over 10 ms) was up to 25 % off, by where in a step the tie goes taut: slacks
-- that differ by 0.03 mm. In steps of 0.02 and 0.01 ms it is the same within 0.2 %.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A clamped cable falls on a bar and into a tie at its end. length [m], at: place of the bar [-], up: the
-- tie's point above the end [m], slack [m], damping [1/s], [s].
local falls = {
  { "FLRY-B 0.5", length = 0.28, at = 0.45, up = 0.045, slack = 0.14, damping = { 1.3, 0.0016 } },
  { "GXL 1.5", length = 0.42, at = 0.55, up = 0.07, slack = 0.125, damping = { 2.1, 0.003 } },
  { "FLRY-B 2.5", length = 0.36, at = 0.35, up = 0.03, slack = 0.16, damping = { 0.8, 0.001 } },
}

-- Options: shift: more slack [m]; strength [N]; stiffness [N/m]; turned: about the vertical [rad]; swapped:
-- ends; segments; beam: tied to the middle of a stiff wire instead of a point; tolerance: of an adaptive run
-- [m]; middle: a second tie there with this slack [m].
local function peak(case, dt, options)
  local o = options or {}
  local scene = sw.scene{}
  local c, s = math.cos(o.turned or 0), math.sin(o.turned or 0)
  local function turn(x, y, z) return { c * x - s * y, s * x + c * y, z } end
  local ends = { { 0, 0, 0 }, turn(case.length, 0, 0) }
  local w = scene:wire{ cable = case[1], from = ends[o.swapped and 2 or 1], to = ends[o.swapped and 1 or 2],
    segments = o.segments or 40 }
  scene:force{ kind = "damping", on = w, mass = case.damping[1], stiffness = case.damping[2] }
  scene:clamp(w, { s = o.swapped and w.length or 0 })
  scene:obstacle{ shape = "capsule", radius = 0.025, length = 0.3, at = turn(case.at * case.length, 0, -0.06),
    rotation = { axis = turn(1, 0, 0), angle = math.pi / 2 }, friction = 0.3 }
  local to = turn(case.length, 0, case.up)
  if o.beam then
    local half = turn(0, 0.1, 0)
    to = { scene:wire{ E = 2e11, density = 7800, radius = 0.005, segments = 40,
      from = { to[1] - half[1], to[2] - half[2], to[3] }, to = { to[1] + half[1], to[2] + half[2], to[3] } },
      s = 0.1 }
    scene:clamp(to[1], { s = 0 })
    scene:clamp(to[1], { s = to[1].length })
  end
  local tie = scene:tie(w, { s = o.swapped and 0 or w.length, to = to, slack = case.slack + (o.shift or 0),
    strength = o.strength, stiffness = o.stiffness })
  local s2 = 0.6 * case.length
  local second = o.middle and scene:tie(w, { s = s2, to = turn(s2, 0, 0.06), slack = 0.06 + o.middle })
  local run = scene:run{ duration = 0.35, dt = dt, tolerance = o.tolerance }
  if not o.strength then t.fine(run) end
  return tie.peak_force, tie, second
end

-- The same for a clamped tube of particle rings.
local function peak_of_tube(dt, shift)
  local scene = sw.scene{}
  local w = scene:wire{ E = 5e6, nu = 0.4, density = 1200, radius = 0.01, model = "tube", from = { 0, 0, 0 },
    to = { 0.25, 0, 0 } }
  scene:force{ kind = "damping", on = w, mass = 1.3, stiffness = 0.002 }
  scene:clamp(w, { s = 0 })
  local tie = scene:tie(w, { s = w.length, to = { 0.25, 0, 0.05 }, slack = 0.12 + shift })
  t.fine(scene:run{ duration = 0.2, dt = dt })
  return tie.peak_force, tie.raw_peak_force
end

describe("a tie at the end of a cable that snaps taut", function()
  -- Means were 0.75 to 1.03 N, pulls of single steps 4.5 to 9 N.
  it("has the same peak at any step where the cable is a mesh", function()
    local mean, pull = peak_of_tube(1e-4, 0)
    for _, dt in ipairs{ 2e-2, 1e-2, 2e-3 } do
      for shift = 0, 1e-4, 5e-5 do
        local found, also = peak_of_tube(dt, shift)
        t.share(mean, found, 0.03, ("dt %g, slack + %g"):format(dt, shift))
        t.share(pull, also, 0.05, ("dt %g, slack + %g, pull"):format(dt, shift))
      end
    end
  end)

  it("pulls harder in single steps the stiffer it is, with the same mean", function()
    local fine, at = peak(falls[2], 2e-5)
    t.share(5, at.raw_peak_force, 0.05, "1e5 N/m")
    for _, dt in ipairs{ 1e-2, 1e-4 } do
      local mean, stiff = peak(falls[2], dt, { stiffness = 1e6 })
      t.share(fine, mean, 0.03, ("dt %g"):format(dt))
      t.share(13.3, stiff.raw_peak_force, 0.05, ("dt %g, 1e6 N/m"):format(dt))
    end
  end)

  for _, case in ipairs(falls) do
    it("has the peak of steps of 0.02 ms for " .. case[1], function()
      local fine = peak(case, 2e-5)
      assert.is_true(fine > 0.02)
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3, 4e-4, 1e-4 } do
        for i = 0, 4 do
          t.share(fine, (peak(case, dt, { shift = 3e-5 * i })), 0.03, ("dt %g, slack %d"):format(dt, i))
        end
      end
      t.share(fine, (peak(case, 1e-2, { segments = 20 })), 0.03, "20 segments")
      t.share(fine, (peak(case, 1e-2, { segments = 90 })), 0.03, "90 segments")
      t.share(fine, (peak(case, 1e-2, { turned = 2, swapped = true })), 0.03, "turned, ends swapped")
      t.share(fine, (peak(case, 1e-2, { tolerance = 1e-4 })), 0.03, "by tolerance")
    end)

    -- Before, ties of 0.9 times the pull held in 10 of these 12 runs, and at 20 ms two of 0.3 times, too.
    it("breaks only if its strength is below the pull, for " .. case[1], function()
      local _, fine = peak(case, 2e-5)
      for _, dt in ipairs{ 2e-2, 1e-2, 2e-3, 1e-4 } do
        local _, tie = peak(case, dt)
        t.share(fine.raw_peak_force, tie.raw_peak_force, 0.05, ("dt %g, pull"):format(dt))
        for _, share in ipairs{ 0.3, 0.6, 0.9, 1.1 } do
          local _, held = peak(case, dt, { strength = share * fine.raw_peak_force })
          t.near(share < 1 and 1 or 0, held.broken and 1 or 0, 0, ("dt %g, strength %g"):format(dt, share))
        end
      end
    end)

    it("has the same where it goes to another wire, for " .. case[1], function()
      local fine = peak(case, 2e-5, { beam = true })
      for _, dt in ipairs{ 1e-2, 2e-3, 1e-4 } do
        t.share(fine, (peak(case, dt, { beam = true })), 0.03, ("dt %g"):format(dt))
      end
    end)

    -- The lighter of two snaps was not followed: its peak was up to 44 % off.
    it("is followed beside a tie that snaps before, for " .. case[1], function()
      local fine, _, middle = peak(case, 2e-5, { middle = 0.03 })
      for _, dt in ipairs{ 2e-2, 1e-2, 2e-3, 4e-4 } do
        local found, _, also = peak(case, dt, { middle = 0.03 })
        t.share(fine, found, 0.05, ("dt %g, end"):format(dt))
        t.share(middle.peak_force, also.peak_force, 0.05, ("dt %g, middle"):format(dt))
      end
    end)
  end
end)
