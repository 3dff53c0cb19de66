-- SPDX-License-Identifier: GPL-3.0-or-later
-- Error bars of wires that swing, fall and are struck: the bar after three, four and five levels is
-- compared with the error that finer levels show.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local quantity = require "softworld.quantity"
local estimate = require "softworld.run.estimate"
local trust = require "softworld.run.trust"
local t = require "spec.physics.tools"

local finest = 7 -- level that the others are compared with
local soft = { E = 5e6, density = 1500, radius = 0.0025 }
local plain = { max_tension = true, max_stress = true, min_bend_radius = true, ["hand.peak_force"] = true,
  ["hand.peak_moment"] = true, ["peg.peak_force"] = true }

local function wire(scene, cable, damping, from, to, segments)
  local args = { from = from, to = to, segments = segments }
  for key, value in pairs(type(cable) == "string" and { cable = cable } or cable) do args[key] = value end
  local made = scene:wire(args)
  if damping then scene:force{ kind = "damping", on = made, mass = damping, stiffness = 1e-3 } end
  return made
end

local function peg(scene, at)
  scene:obstacle{ name = "peg", shape = "cylinder", radius = 0.01, length = 0.2, at = at, friction = 0.3,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
end

-- Each builds a scene and returns the wire, the duration (nil: its process ends the run) and its
-- quantities.
local kinds = {}

function kinds.swing(scene, cable, damping)
  local w = wire(scene, cable, damping, { 0, 0, 1 }, { 0.4, 0, 1 }, 24)
  scene:clamp(w, { s = 0 })
  return w, 0.4, { "clamp1.force" }
end

function kinds.pendulum(scene, cable, damping)
  local w = wire(scene, cable, damping, { 0, 0, 1 }, { 0.4, 0, 1 }, 24)
  scene:pin(w, { s = 0 })
  return w, 0.35, { "pin1.force" }
end

function kinds.release(scene, cable, damping)
  local w = wire(scene, cable, damping, { 0, 0, 1 }, { 0.5, 0, 1 }, 24)
  scene:clamp(w, { s = 0 })
  local held = scene:clamp(w, { s = w.length })
  scene:process(function(p)
    p:wait(0.1)
    held:release()
    p:wait(0.3)
  end)
  return w, nil, { "clamp1.force" }
end

function kinds.carried(scene, cable, damping)
  local w = wire(scene, cable, damping, { 0, 0, 0.5 }, { 0, 0, 0.1 }, 24)
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(w, { s = 0.02 })
    hand:move{ by = { 0.2, 0, 0.02 }, speed = 0.5 }
    p:wait(0.2)
  end)
  return w, nil, { "hand.peak_force", "hand.mean_force", "hand.peak_moment" }
end

kinds["dropped on a peg"] = function(scene, cable, damping)
  local w = wire(scene, cable, damping, { -0.25, 0, 0.2 }, { 0.25, 0, 0.2 }, 30)
  peg(scene, { 0.05, 0, 0.1 })
  return w, 0.3, { "peg.peak_force", "peg.impulse" }
end

kinds["swung on a peg"] = function(scene, cable, damping)
  local w = wire(scene, cable, damping, { 0, 0, 1 }, { 0.5, 0, 1 }, 30)
  scene:pin(w, { s = 0 })
  peg(scene, { 0.05, 0, 0.8 })
  return w, 0.4, { "peg.peak_force", "pin1.force" }
end

-- Kind, cable, damping by mass [1/s], finest level.
local cases = { { "swing", "GXL 1.5" }, { "swing", soft }, { "swing", "FLRY-B 0.5", 1 },
  { "pendulum", "GXL 0.5" }, { "pendulum", "FLRY-B 10", 1 }, { "pendulum", soft, 1 },
  { "release", soft, nil, 6 }, { "release", "GXL 1.5", 1, 6 }, { "release", "FLRY-B 0.5", nil, 6 },
  { "carried", "GXL 0.5", 1 }, { "carried", "GXL 1.5", nil, 6 },
  { "dropped on a peg", soft, 1, 6 }, { "dropped on a peg", "FLRY-B 0.5", 1, 6 },
  { "swung on a peg", { E = 2e6, density = 1100, radius = 0.004 }, 1, 6 } }

-- Returns the values of the quantities on all levels, and for each level whether anything touched.
local function levels_of(case)
  local scene = sw.scene{}
  local w, duration, own = kinds[case[1]](scene, case[2], case[3])
  local touched, level = {}, 0
  local asked = { energy = 1e9, tip = 1e9, max_tension = 1e9, max_stress = 1e12, min_bend_radius = 1e9 }
  for _, name in ipairs(own) do asked[name] = 1e9 end
  asked[1] = { name = "all levels", value = 2, of = function() -- its bar is 3
    level = level + 1
    touched[level] = trust.touches(scene)
    return level % 2 * 2
  end }
  local r = t.fine(scene:run{ duration = duration, tolerance = asked, levels = case[4] or finest,
    frames = false })
  assert.are.equal(case[4] or finest, #r.levels)
  assert.is_true(w.segments > 100)
  scene:close()
  return r.quantities, touched
end

describe("error bars of motions", function()
  it("hold in 95 % of cases after three to five levels, and are at most ten times the " ..
    "error in half", function()
    local n, held, busy, misses = 0, 0, 0, {}
    for _, case in ipairs(cases) do
      local found, touched = levels_of(case)
      found["all levels"] = nil
      for name, q in pairs(found) do
        local exact = q.levels[#q.levels]
        for k = 3, math.min(5, #q.levels - 2) do
          local values = table.move(q.levels, 1, k, 1, {})
          local bar = estimate.bar({ plain = plain[name] }, values, touched[k], true)
          local off = quantity.distance(q.levels[k], exact)
          n = n + 1
          if off <= bar then held = held + 1
          else misses[#misses + 1] = ("%s %s: %.3g off, bar %.3g"):format(case[1], name, off, bar) end
          if bar <= 10 * off then busy = busy + 1 end
        end
      end
    end
    print(("measured: motions: %d bars, %d hold the true error, %d are at most ten times it"):format(n, held,
      busy))
    assert.is_true(n > 200)
    assert.is_true(held >= 0.95 * n, table.concat(misses, "\n"))
    assert.is_true(busy >= 0.5 * n)
  end)
end)
