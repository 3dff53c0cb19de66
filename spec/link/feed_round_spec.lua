-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire is drawn round a peg out of a feed that brakes it with a force.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local FREE = 0.15 -- [m], from the feed to the peg and from there to the hand

-- The wire lies along the tangents of the peg and round it by the angle wrap. The whole scene is turned
-- about the peg's axis by `lean`.
local function drawn(case)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local r = sw.scene{}:wire{ cable = case.cable, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 2 }.radius
  local top, lean = case.R + r, case.lean
  local function at(x, z)
    return { x * math.cos(lean) + z * math.sin(lean), 0, z * math.cos(lean) - x * math.sin(lean) }
  end
  local function round(a, beyond)
    return at(top * math.sin(a) + beyond * math.cos(a), top * math.cos(a) - beyond * math.sin(a))
  end
  local path, pieces = { at(-FREE, top) }, math.ceil(4 * top * case.wrap / case.edge)
  for k = 0, pieces do path[#path + 1] = round(case.wrap * k / pieces, 0) end
  path[#path + 1] = round(case.wrap, FREE)
  local wire = scene:wire{ cable = case.cable, path = path, rest = "straight",
    segments = math.ceil((2 * FREE + top * case.wrap) / case.edge) }
  scene:obstacle{ shape = "cylinder", radius = case.R, length = 0.2, friction = case.friction,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
  local feed = scene:feed(wire, { s = 0, force = -case.force })
  local hand = scene:clamp(wire, { s = wire.length })
  local from, to = round(case.wrap, 0), round(case.wrap, 0.1)
  hand:follow(sw.trajectory{ points = { { 0, 0, 0 }, { to[1] - from[1], 0, to[3] - from[3] } }, duration = 1,
    relative = true })
  if case.settled then t.fine(scene:settle()) end
  return scene, wire, feed, hand, top
end

-- Pull at the hand, from that at the feed. Tension + EI curvature^2/2 is the same along a free wire, so it
-- reaches the peg with less tension by B = EI/(2 top^2). There it lifts off under an angle, and its shear
-- force Q presses on the peg at one point. Between both points it is a rope.
local function pull(case, EI, top)
  local B = EI / (2 * top ^ 2)
  local function shear(F) return (F ^ 2 - (F - B) ^ 2) ^ 0.5 end
  local function lifts(F) return math.acos(1 - B / F) end
  local from, low, high = case.force - B + case.friction * shear(case.force), case.force, 50 * case.force
  for _ = 1, 60 do
    local F = 0.5 * (low + high)
    local arc = math.max(0, case.wrap - lifts(case.force) - lifts(F))
    local enough = F - B > from * math.exp(case.friction * arc) + case.friction * shear(F)
    if enough then high = F else low = F end
  end
  return low
end

-- Returns the largest jump of a drive's force that the run told [N].
local function told(run)
  local most = 0
  for _, e in ipairs(run.events) do if e.kind == "jump" then most = math.max(most, math.abs(e.value)) end end
  return most
end

local CASES = {
  { cable = "GXL 1.5", force = 2.4, R = 0.0465, friction = 0, wrap = 0.79, edge = 0.01, settled = true },
  { cable = "GXL 1.5", force = 9.6, R = 0.0487, friction = 0.1, wrap = 3.14, edge = 0.01, settled = true },
  { cable = "FLRY-B 0.5", force = 3.9, R = 0.0594, friction = 0.25, wrap = 2.56, edge = 0.006,
    settled = true },
  { cable = "FLRY-B 0.5", force = 5.4, R = 0.0564, friction = 0.5, wrap = 1.8, edge = 0.01 },
  { cable = "H07V-K 4", force = 2.5, R = 0.0396, friction = 0.1, wrap = 1.8, edge = 0.005, settled = true },
  { cable = "H07V-K 4", force = 2.04, R = 0.05, friction = 0.01, wrap = 1.2, edge = 0.005 },
}

-- Regression: the force that the drive compared with its target jumped between that of the last stage and a
-- mix of both stages. Where the target was in the jump, no speed was found: 5 of these 18 cases did not
-- start. In 12 others the drive's force was off by 0.03 to 1.8 % at a step.
-- Tolerances: a drive obeys to 1e-7 in each step; 1e-5 leaves a hundred times that. Where a touch begins to
-- slide the force may jump past the asked one (measured: by 7e-5 of it, in one step of 180); an event tells
-- that. The pull at the hand
-- contains damping (below 1 %), and edges up to R/5 make the wire stiffer: measured up to 2.3 %.
describe("a wire drawn round a peg out of a feed with a force", function()
  for number, case in ipairs(CASES) do
    for _, dt in ipairs{ 0.02, 0.005, 0.002 } do
      case.lean = (number + 1e3 * dt) % 2 < 1 and 0 or 0.7
      local lean = case.lean
      it(("case %d, steps of %g s, turned by %g rad"):format(number, dt, lean), function()
        case.lean = lean
        local scene, wire, feed, hand, top = drawn(case)
        t.fine(scene:run{ duration = 0.4, dt = dt })
        local sum, steps, jumps = 0, 10, 0
        for _ = 1, steps do
          local run = t.fine(scene:run{ duration = 0.02, dt = dt })
          local f, off = hand:force(), feed:drive_force() + case.force
          sum = sum + (f[1] ^ 2 + f[3] ^ 2) ^ 0.5 / steps
          if math.abs(off) > 1e-5 * case.force then
            jumps = jumps + 1
            t.above(math.abs(off) * (1 - 1e-6), told(run), "jump of the drive's force that was told [N]")
          end
        end
        assert.is_true(jumps <= 1, jumps .. " steps with jumps")
        t.share(pull(case, wire.beam.EI, top), sum, 0.04, "pull at the hand [N]")
      end)
    end
  end
end)
