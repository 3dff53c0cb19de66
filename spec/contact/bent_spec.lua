-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is bent down over a peg with a radius of up to four edges. It touches the peg with its smooth
-- curve, first in one edge, then in two. A touch that appears with its whole stiffness where another one
-- already presses throws the cable back, until only one edge touches again.
local core = require "softworld.core"

local UP = { axis = { 1, 0, 0 }, angle = math.pi / 2 } -- a cylinder's axis along y
local HALF = 0.2 -- half the cable's length [m]
local GAP = 0.003 -- between cable and peg [m]

-- o: wire, segments, radius of the peg, shift of the peg along the cable, friction, duration and way down
-- of the ends. Returns the run, the cable's positions, the peg and the scene.
local function bent(o, options, duration)
  local s, n = core.scene{}, o.segments
  local args = { from = { -HALF, 0, 0 }, to = { HALF, 0, 0 }, segments = n }
  for key, value in pairs(o.wire) do args[key] = value end
  local peg = s:obstacle{ shape = "cylinder", radius = o.radius, length = 0.2, rotation = UP,
    friction = o.friction or 0, at = { o.shift or 0, 0, -o.radius - args.radius - GAP } }
  local w = s:wire(args)
  for k, at in ipairs{ 0, 2 * HALF } do
    s:clamp(w, { s = at }):follow{ relative = true, duration = o.duration,
      points = { { 0, 0, 0 }, { (3 - 2 * k) * 0.06, 0, -o.down } } }
  end
  s:force{ kind = "damping", mass = 5 }
  s:settle()
  local r = s:advance(options, duration)
  return r, w:positions(), peg, s
end

local function off(a, b)
  local most = 0
  for i = 1, #a do most = math.max(most, math.abs(a[i] - b[i])) end
  return most
end

-- Compares a run with steps chosen by their error to a run with fine, fixed steps.
local function check(o, tolerance, duration)
  local r, x, _, s = bent(o, { dt = o.dt or 0.4 / o.segments, tolerance = tolerance }, duration)
  assert.is_true(r.ok, r.reason)
  local l = core.ledger(s)
  local fine, y = bent(o, { dt = 2e-4 }, duration)
  assert.is_true(fine.ok, fine.reason)
  print(("measured: %d steps, the smallest %.2g s; %d redone, %d halved, %d accepted; %.2g m off fine ones")
    :format(r.steps, r.smallest_dt, l.redone.count, l.halved.count, l.accepted.count, off(x, y)))
  return r, l, off(x, y)
end

describe("a cable that is bent over a peg", function()
  -- Two edges touch where a node is above the peg, or where the cable begins to wrap round it. A step taken
  -- there without an error estimate must not set the size of all later steps.
  local softer = { E = 5e6, density = 1500, radius = 0.0025 }
  for _, case in ipairs{ { 40, 2, 0.5, 0.25, 1e-8 }, { 37, 0.5, 0.5, 0, 1e-7 }, { 37, 0.5, 0.5, 0.25, 1e-7 },
    { 40, 1, 0.25, 0, 1e-7 } } do
    local n, edges, share, friction, tolerance = table.unpack(case)
    it(("meets one of %g edges by steps of any size: shifted by %g, friction of %g"):format(edges, share,
      friction), function()
        local o = { wire = softer, segments = n, radius = edges * 0.4 / n, shift = share * 0.4 / n,
          friction = friction, duration = 1, down = 0.1 }
        local r, l, away = check(o, tolerance, 1)
        assert.is_true(l.accepted.count == 0 and r.steps < 4000, ("%d steps, %d accepted"):format(r.steps,
          l.accepted.count))
        assert.is_true(away < 2e-4, ("%.2g m off"):format(away))
      end)
  end
end)
