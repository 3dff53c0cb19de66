-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire has no preferred direction: the same scene with arc length counted from the wire's other end gives
-- the same positions. They differ by rounding, amplified over a few hundred iterations.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local A, B = { -0.2, -0.03, 0.004 }, { 0.2, 0.03, 0 }

-- Returns the largest distance between the positions of a scene built in both directions. make(scene, from,
-- to, place) builds the scene and returns the wire; place(wire, share) converts a share of the length into
-- arc length.
local function apart(make, duration)
  local function run(swapped)
    local scene = sw.scene{}
    local wire = make(scene, swapped and B or A, swapped and A or B,
      function(wire, share) return wire.length * (swapped and 1 - share or share) end)
    t.fine(scene:run{ duration = duration, dt = 5e-3 })
    local places = {}
    for i = 0, 40 do
      places[i] = wire:position(wire.length * (swapped and 40 - i or i) / 40)
    end
    return places
  end
  local one, other, most = run(false), run(true), 0
  for i = 0, 40 do most = math.max(most, t.distance(one[i], other[i])) end
  return most
end

local function wire(scene, from, to)
  return scene:wire{ E = 2e7, density = 1400, radius = 0.002, from = from, to = to, segments = 24 }
end

describe("a wire has the same positions when counted from its other end:", function()
  for _, share in ipairs{ 0.32, 0.43, 0.55 } do -- unequal node masses beside the clamp
    it(("over an edge beside a clamp at %g of its length"):format(share), function()
      t.below(1e-7, apart(function(scene, from, to, place)
        scene:obstacle{ shape = "box", size = { 0.01, 0.2, 0.02 }, friction = 0.4,
          at = { -0.2 + 0.4 * share - 0.011, 0, -0.0123 } }
        local w = wire(scene, from, to)
        scene:clamp(w, { s = place(w, share) }):follow{ points = { { 0, 0, 0 }, { 0, 0, -0.004 } },
          relative = true, duration = 0.2 }
        return w
      end, 0.3), "difference [m]")
    end)
  end

  for _, speed in ipairs{ 0.07, 0.1 } do -- nodes leave the feed and push others
    it(("paid out over an edge at %g m/s"):format(speed), function()
      t.below(1e-7, apart(function(scene, from, to, place)
        scene:obstacle{ shape = "box", size = { 0.03, 0.2, 0.02 }, friction = 0.2, at = { 0.12, 0, -0.0152 } }
        local w = wire(scene, from, to)
        scene:feed(w, { s = place(w, 1), speed = speed })
        return w
      end, 0.4), "difference [m]")
    end)
  end
end)
