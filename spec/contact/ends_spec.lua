-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire knows no direction: the same scene with arc length counted from the wire's other end gives the
-- same positions, to what rounding becomes in a few hundred iterations and to what blows of several nodes
-- at once do, which are dealt with in the nodes' order: 0.03 mm. What these scenes were made for was 0.1
-- to 0.4 mm.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local A, B = { -0.2, -0.03, 0.004 }, { 0.2, 0.03, 0 }

-- Largest difference of places along the wire, of both ways to draw a scene: make(scene, from, to, place)
-- adds what is in it besides and gives the wire; place turns a share of the length into arc length.
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

describe("from its other end, a wire is the same", function()
  for _, share in ipairs{ 0.32, 0.43, 0.55 } do -- nodes have other masses beside a clamp in mid-wire
    it(("over an edge beside a clamp at %g of its length"):format(share), function()
      t.below(4e-5, apart(function(scene, from, to, place)
        scene:obstacle{ shape = "box", size = { 0.01, 0.2, 0.02 }, friction = 0.4,
          at = { -0.2 + 0.4 * share - 0.011, 0, -0.0123 } }
        local w = wire(scene, from, to)
        scene:clamp(w, { s = place(w, share) }):follow{ points = { { 0, 0, 0 }, { 0, 0, -0.004 } },
          relative = true, duration = 0.2 }
        return w
      end, 0.3), "difference [m]")
    end)
  end

  for _, speed in ipairs{ 0.07, 0.1 } do -- nodes come out of the feed, and push those that do not touch
    it(("paid out over an edge at %g m/s"):format(speed), function()
      t.below(4e-5, apart(function(scene, from, to, place)
        scene:obstacle{ shape = "box", size = { 0.03, 0.2, 0.02 }, friction = 0.2, at = { 0.12, 0, -0.0152 } }
        local w = wire(scene, from, to)
        scene:feed(w, { s = place(w, 1), speed = speed })
        return w
      end, 0.4), "difference [m]")
    end)
  end
end)
