-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables that a moving box strikes with its lower edge, or another cable with its end, as they fall past. In
-- a step of 10 ms a cable is in front of the box at one end and below it at the other, clear of it at both.
local samples = require "contract.samples"
local sw = require "softworld"
local t = require "physics.tools"

local G = 9.81
local CABLES = { "GXL 0.5", "GXL 1.5", "FLRY-B 10" }

-- Returns a function of the step [s] that gives the force that the box bore: the largest mean over 10 ms [N].
-- The box arrives as the cable falls past its lower edge.
local function scene_of(seed)
  local r = samples.random(seed)
  local cable = CABLES[1 + seed % 3]
  local length, share, down = r(0.3, 0.5), r(0.75, 0.95), r(0.03, 0.12)
  local v, turn, when = r(0.2, 0.8), r(-0.4, 0.4), r(-0.015, 0.005)
  local side = v * (math.sqrt(2 * down / G) + when)
  return function(dt)
    local scene, radius = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
    local box = scene:obstacle{ name = "box", shape = "box", size = { 0.02, 0.3, 0.1 }, friction = 0.3,
      at = { length * share, 0.15 + radius + side, 0.05 - down },
      rotation = { axis = { 0, 0, 1 }, angle = turn } }
    box:follow{ relative = true, points = { { 0, 0, 0 }, { 0, -0.25 * v, 0 } }, duration = 0.25,
      law = "linear" }
    local w = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = 40 }
    scene:clamp(w, { s = 0 })
    scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
    t.fine(scene:run{ dt = dt, duration = 0.25 })
    return box:over().peak_force, w.beam.mass_per_length * length * G
  end
end

describe("a cable that falls past an edge which strikes it", function()
  it("is struck in steps of any size", function()
    local struck, missed, off = 0, 0, 0
    for seed = 1, 60 do
      local force_at = scene_of(seed)
      local fine, weight = force_at(0.0005)
      if fine > 0.2 * weight then
        struck = struck + 1
        for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
          local force = force_at(dt)
          missed = missed + (force < 0.3 * fine and 1 or 0)
          off = off + (math.abs(force - fine) > 0.1 * fine and 1 or 0)
        end
      end
    end
    t.below(struck, 20, "cables that are struck")
    -- Of 72 runs, 12 had no force and 13 were more than 10 % off. Measured: 3 and 5, of two cables that graze
    -- the edge: their forces change by as much in steps of 1.25 and 0.6 ms.
    t.below(4, missed, "runs without the blow")
    t.below(6, off, "runs more than 10 % off")
  end)
end)

-- Returns a function of the step [s] that gives the shift of the falling cable's tip by the other cable's
-- end [m].
local function pair_of(seed)
  local r = samples.random(seed)
  local cable = CABLES[1 + seed % 3]
  local length, share, down = r(0.3, 0.5), r(0.75, 0.95), r(0.03, 0.12)
  local v, when = r(0.2, 0.8), r(-0.015, 0.005)
  local side = v * (math.sqrt(2 * down / G) + when)
  return function(dt)
    local scene, radius = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
    local falls = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { length, 0, 0 }, segments = 40 }
    scene:clamp(falls, { s = 0 })
    local x, y = length * share, 2 * radius + side
    local other = scene:wire{ cable = cable, from = { x, y, -down }, to = { x, y + 0.1, -down },
      segments = 12 }
    scene:wire_contact{ friction = 0.3 }
    for _, s in ipairs{ 0.02, 0.1 } do
      scene:clamp(other, { s = s }):follow{ relative = true, points = { { 0, 0, 0 }, { 0, -0.25 * v, 0 } },
        duration = 0.25, law = "linear" }
    end
    scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
    t.fine(scene:run{ dt = dt, duration = 0.25 })
    return -falls:position(length)[2]
  end
end

describe("a cable that falls past the end of another which strikes it", function()
  it("is struck in steps of any size", function()
    local struck, missed = 0, 0
    for seed = 1, 40 do
      local shift_at = pair_of(seed)
      if shift_at(0.0005) > 0.005 then
        struck = struck + 1
        for _, dt in ipairs{ 0.02, 0.01, 0.005 } do missed = missed + (shift_at(dt) == 0 and 1 or 0) end
      end
    end
    t.below(struck, 15, "cables that are struck")
    -- 14 of 57 runs before; measured: 3, of two cables that overlap by less than 3 % of the radii
    t.below(4, missed, "runs without a touch")
  end)
end)
