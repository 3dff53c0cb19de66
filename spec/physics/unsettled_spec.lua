-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses in which no equilibrium is found: the wires move until there is one. The process was drawn at
-- random and ended before: "not at rest". Forces at rest must be those of slow motion.
local sw = require "softworld"
local t = require "spec.physics.tools"

local cable = "FLRY-B 0.5"
local radius = sw.cable(cable).outer_diameter.value / 2

-- A cable that lies on a table in an arc of this length, from a clamp at its end.
local function lay(length, segments)
  local scene = sw.scene { name = "unsettled" }
  scene:force { kind = "damping", mass = 4, stiffness = 2e-3 }
  scene:obstacle { name = "table", shape = "plane", friction = 0.4 }
  local path = {}
  for i = 0, 30 do
    local u = i / 30
    path[i + 1] = { length * u, -0.48 * length * u * (1 - u), radius }
  end
  local wire = scene:wire { name = "w", cable = cable, path = path, rest = "path", segments = segments }
  scene:clamp(wire, { s = wire.length, name = "end" })
  return scene, wire
end

-- A gripper lifts the cable, gravity turns, and a tie is made: the cable snaps aside on the table.
local function tied()
  local scene, wire = lay(0.78044321023611, 80)
  local hand = scene:gripper { name = "hand", pads = { width = 0.01 } }
  local forces = {}
  local function note() forces[#forces + 1] = hand:force() end
  scene:process(function(p)
    hand:grasp(wire, { s = 0.21186937351278 })
    hand:move { by = { 0.05, 0, 0.08 }, duration = 0.8 }
    p:wait(0.4)
    note()
    scene:set { gravity = { -0.641380767782, 0, -9.81 } }
    p:wait(0.5)
    note()
    hand:move { by = { -0.050920109927, 0.016313413915, 0.029277466140 }, duration = 1.47053706155092 }
    p:wait(0.5)
    note()
  end)
  return scene, wire, hand, forces
end

local function run(options)
  local scene, wire, hand, forces = tied()
  local result = scene:run(options)
  return { run = result, wire = wire, hand = hand, forces = forces }
end

describe("a pose without an equilibrium", function()
  local slow = run { dt = 0.01 }

  -- The way to the last force differs: friction on the table keeps up to 2 % of it.
  it("lets the wires move until there is one; the force is that of slow motion", function()
    for _, dt in ipairs { 0.04, 0.02, 0.01 } do
      local poses = run { quasistatic = true, dt = dt }
      assert.is_true(poses.run.ok)
      local at = poses.run.events[1]
      assert.equal("unsettled", at.kind)
      t.above(2.2, at.time, "moves from [s]")
      local last, right = poses.forces[3], slow.forces[3]
      local size = (right.x ^ 2 + right.y ^ 2 + right.z ^ 2) ^ 0.5
      for _, k in ipairs { "x", "y", "z" } do t.near(right[k], last[k], 0.02 * size) end
    end
  end)

  it("ends the run, if the script wants that", function()
    local poses = run { quasistatic = true, dt = 0.04, unsettled = false }
    assert.is_false(poses.run.ok)
    assert.match("not at rest", poses.run.reason)
    t.below(2.7, poses.run.time)
  end)

  it("leaves peaks and places of a check open", function()
    local poses = run { quasistatic = true, dt = 0.04 }
    local report = poses.run:check { limits = { ["hand.peak_force"] = 100 } }
    assert.equal("OPEN", report.verdict)
    assert.match("inertia is in peaks", tostring(report))
  end)
end)

-- Nothing would stop it: motion has no end either, and the reason must stay the plain one.
describe("a wire that falls without limit", function()
  it("ends a quasi-static run as before", function()
    local scene = sw.scene { name = "fall" }
    local wire = scene:wire { cable = cable, from = { 0, 0, 1 }, to = { 0.3, 0, 1 }, segments = 20 }
    local clamp = scene:clamp(wire, { s = 0 })
    scene:process(function(p)
      p:wait(0.2)
      clamp:release()
      p:wait(0.2)
    end)
    local result = scene:run { quasistatic = true, dt = 0.04 }
    assert.is_false(result.ok)
    assert.match("which nothing holds, is carried away", result.reason)
    assert.equal(0, #t.events(result, "unsettled"))
  end)
end)
