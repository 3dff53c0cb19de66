-- SPDX-License-Identifier: GPL-3.0-or-later
-- Strands of three and of seven cables are drawn taut, in motion, pose by pose and by settling alone. Poses
-- of some of them did not come to rest; after settling the wires were so deep in each other that they bore
-- far too little. Compared with helices whose radius is that of wires that touch.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Least distance of two helices of radius rho and wave number k, turned by an angle against each other.
local function apart(rho, k, angle)
  local least = math.huge
  for i = -300, 300 do
    local x = 0.9 / k * i / 300
    local across = (math.cos(k * x + angle) - 1) ^ 2 + math.sin(k * x + angle) ^ 2
    least = math.min(least, math.sqrt(x * x + rho * rho * across))
  end
  return least
end

-- Radius of the helices of n outer wires of radius r that touch each other.
local function touching(n, r, k)
  local low, high = r, 4 * r
  for _ = 1, 50 do
    local mid = (low + high) / 2
    if apart(mid, k, 2 * math.pi / n) < 2 * r then low = mid else high = mid end
  end
  return high
end

-- Draws a strand: its outer wires, and one in the middle of six. Returns the pulls, the middle one first, and
-- those of helices [N].
local function drawn(o)
  local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
  local r, k = sw.cable(o.cable).outer_diameter.value / 2, 2 * math.pi * o.turns / o.distance
  local rho, ends = touching(o.outer, r, k), {}
  local function add(radius, angle)
    local path, per = {}, 8 * o.segments
    for i = 0, per do
      local x = o.distance * i / per
      path[#path + 1] = { x, radius * math.cos(k * x + angle), radius * math.sin(k * x + angle) }
    end
    local wire = scene:wire{ cable = o.cable, path = path, segments = o.segments, rest = "path" }
    scene:clamp(wire, { s = 0 })
    ends[#ends + 1] = scene:clamp(wire, { s = wire.length })
    return wire.beam.EA
  end
  local EA = o.outer == 6 and add(0, 0)
  for i = 1, o.outer do EA = add(1.003 * rho, 2 * math.pi * i / o.outer) end
  scene:wire_contact{ friction = 0.1 }
  scene:force{ kind = "damping", mass = 30, stiffness = 0.001 }
  local way = o.strain * o.distance
  for _, clamp in ipairs(ends) do
    local p = clamp:pose()
    if o.settle then
      clamp:pose({ p[1] + way, p[2], p[3] })
    else
      clamp:follow{ points = { { 0, 0, 0 }, { way, 0, 0 } }, relative = true, duration = 0.5 }
    end
  end
  local result = o.settle and scene:settle() or
    scene:run{ duration = o.quasistatic and 0.5 or 0.8, dt = 0.02, quasistatic = o.quasistatic }
  t.fine(result)
  for _, e in ipairs(result.events) do assert.not_equal("pressed", e.kind) end
  local pulls = {}
  for i, clamp in ipairs(ends) do pulls[i] = clamp:force()[1] end
  local far = o.distance + way
  local now = k * o.distance / far -- wave number of the strand that was drawn
  local before = math.sqrt(o.distance ^ 2 + (1.003 * rho * k * o.distance) ^ 2)
  local after = math.sqrt(far ^ 2 + (touching(o.outer, r, now) * k * o.distance) ^ 2)
  return pulls, EA * (after / before - 1) * far / after, EA * o.strain
end

describe("a strand of cables drawn taut", function()
  -- Chords of a helix with 20 and 30 edges in a turn bear 2 to 8 % more than the helix.
  for _, o in ipairs{
    { cable = "FLRY-B 0.5", outer = 3, turns = 3, distance = 0.1, segments = 60, chords = 0.09 },
    { cable = "H07V-K 4", outer = 3, turns = 1.5, distance = 0.2, segments = 60, chords = 0.02 },
    { cable = "GXL 1.5", outer = 6, turns = 2, distance = 0.2, segments = 60, chords = 0.05 } } do
    for _, how in ipairs{ "settle", "quasistatic", "motion" } do
      it(("shares its pull as helices do: %d outer %s, %s"):format(o.outer, o.cable, how), function()
        o.strain, o.settle, o.quasistatic = o.cable == "H07V-K 4" and 5e-4 or 1e-3, how == "settle",
          how == "quasistatic"
        local pulls, outer, middle = drawn(o)
        for i, pull in ipairs(pulls) do
          if o.outer == 6 and i == 1 then
            t.share(middle, pull, 0.005, "pull of the middle wire [N]")
          else
            t.share(outer * (1 + o.chords / 2), pull, o.chords / 2, "pull of an outer wire [N]")
          end
        end
      end)
    end
  end
end)
