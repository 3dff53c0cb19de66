-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable held at one end runs through a clip with friction and is pulled at its other end. At rest the
-- hold's force, the clip's, the load and the weight add up to zero. Regression: friction of a first settle
-- was not that of the push at rest but up to mu times the clip's larger lip force, and where the last
-- iteration of the search failed, forces of holds were those of the failed iteration: up to 21 times the
-- load, with ok and without an event.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local vec = require "softworld.vec"

local LENGTH, AT = 0.25, 0.1 -- of the cable, of the clip [m]
local TURN = { 0.5, 0.1, -0.7, 0.5 } -- of the turned scenes: a unit quaternion

local function rest(p)
  local turn = p.turned and TURN or { 1, 0, 0, 0 }
  local function seen(v) return vec.rotate(turn, v) end
  local scene = sw.scene{ gravity = seen{ 0, 0, -9.81 } }
  local ends = { seen{ 0, 0, 0 }, seen{ LENGTH, 0, 0 } }
  local args = { segments = p.segments, from = ends[p.swapped and 2 or 1], to = ends[p.swapped and 1 or 2] }
  if p.cable == "tube" then
    args.EA, args.EI, args.GJ, args.mass_per_length, args.radius = 300, 2e-3, 1.5e-3, 0.03, 0.004
  else
    args.cable = p.cable
  end
  local wire = scene:wire(args)
  local clip = scene:clip{ at = seen{ AT, 0, -p.below }, direction = seen{ 0, 0, 1 },
    axis = seen{ 1, 0, 0 }, width = 0.012, insertion = 15, retention = 40, friction = p.friction }
  local function s(place) return p.swapped and LENGTH - place or place end
  local hold = scene[p.hold](scene, wire, { s = s(0) })
  local load = seen{ 0.9 * p.load, 0, -0.44 * p.load }
  scene:force{ kind = "point", on = wire, s = s(LENGTH), force = load }
  return scene, wire, hold, clip, load
end

local CASES = {
  { cable = "GXL 10", segments = 200, friction = 0.365, load = 1.38, below = 0.0016, hold = "feed" },
  { cable = "GXL 10", segments = 50, friction = 0.206, load = 1.158, below = 0.00143, hold = "clamp" },
  { cable = "FLRY-B 2.5", segments = 200, friction = 0.113, load = 1.15, below = 0.0015, hold = "feed" },
  { cable = "FLRY-B 2.5", segments = 50, friction = 0.368, load = 2.09, below = 0.0015, hold = "pin" },
  { cable = "GXL 0.5", segments = 70, friction = 0.23, load = 2.07, below = 0.0006, hold = "clamp" },
  { cable = "tube", segments = 50, friction = 0.372, load = 1.78, below = 0.0006, hold = "feed" },
  { cable = "tube", segments = 100, friction = 0.163, load = 1.194, below = 0.00282, hold = "clamp" },
  { cable = "tube", segments = 150, friction = 0.396, load = 1.13, below = 0.0018, hold = "clamp" },
}

describe("a cable at rest in a clip with friction", function()
  -- The search ends when friction changes by less than 1e-5 of its limit, which is at most the load here;
  -- 1e-3 leaves room for what the search for rest itself leaves out of balance. Measured 5e-7 of the load at
  -- most, before 0.12 to 7 times the load.
  local SHARE = 1e-3
  for i, case in ipairs(CASES) do
    for _, view in ipairs{ {}, { turned = true }, { swapped = true } } do
      local p = setmetatable(view, { __index = case })
      local name = ("%d: %s, %s%s%s"):format(i, p.cable, p.hold, p.turned and ", turned" or "",
        p.swapped and ", swapped" or "")
      it("is in balance, " .. name, function()
        local scene <close>, wire, hold, clip, load = rest(p)
        local settled = scene:settle()
        assert.is_true(settled.ok, settled.reason)
        local weight = vec.scale(scene:get().gravity, wire.beam.mass_per_length * LENGTH)
        local sum = vec.add(vec.add(hold:force(), clip:force()), vec.add(load, weight))
        t.below(SHARE * p.load, vec.norm(sum), "imbalance [N]")
        local first = hold:force()
        assert.is_true(scene:settle().ok)
        t.below(SHARE * p.load, vec.norm(vec.add(first, hold:force(), -1)), "change by a second settle [N]")
      end)
    end

    -- Nothing moves, so all poses have the force at rest; a peak is that of one pose. Before, the first pose
    -- had up to 4.7 times that force.
    it(("has the same force in the first pose, %d: %s, %s"):format(i, case.cable, case.hold), function()
      local settled <close>, _, at_rest = rest(case)
      assert.is_true(settled:settle().ok)
      local scene <close>, _, hold = rest(case)
      t.fine(scene:run{ duration = 0.1, dt = 0.05, quasistatic = true })
      local off = math.abs(hold:over().peak_force - vec.norm(at_rest:force()))
      t.below(SHARE * case.load, off, "peak of poses less the force at rest [N]")
    end)
  end
end)
