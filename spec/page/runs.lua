-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs for the specs of the player, each of a small scene.
local sw = require "softworld"

local runs = {}

--- A gripper lifts a wire over a wall; an event at 0.4 s.
function runs.laying(options)
  options = options or {}
  local scene = sw.scene { name = options.name or "laying" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:obstacle { name = options.wall or "wall", shape = "box", size = { 0.02, 0.3, 0.08 },
    at = { 0.2, 0, 0.04 }, friction = 0.3 }
  local wire = scene:wire { name = options.wire or "wire", E = 50e6, density = 1500, radius = 0.003,
    segments = 60, from = { 0, 0, 0.003 }, to = { -0.6, 0, 0.003 } }
  local hand = scene:gripper { name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.03 })
    hand:move { by = { 0.1, 0, 0.14 }, speed = 0.4 }
    scene:tell { kind = "note", object = "hand", text = options.note or "the hand is up" }
    hand:move { by = { 0.3 * (options.far or 1), 0, 0 }, speed = 0.4 }
    hand:release()
    p:wait(0.3)
  end)
  local run = scene:run { dt = 0.004, frame = 0.02, frames = options.frames }
  assert(run.ok, run.reason)
  return run
end

--- A run that fails, with frames up to the failure: a far too large force pulls on the wire.
function runs.failed()
  local scene = sw.scene { name = "torn" }
  local wire = scene:wire { name = "wire", E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 },
    to = { 0.5, 0, 0 }, segments = 10 }
  scene:clamp(wire, { s = 0 })
  scene:force { kind = function(t, _, _, f)
    if t > 0.1 then for i = 1, #f do f[i] = 1e300 end end
  end, on = wire }
  local run = scene:run { duration = 0.3, dt = 0.01, frame = 0.02 }
  assert(not run.ok)
  return run
end

--- The laying, with a wire that is a mesh.
function runs.mesh()
  local scene = sw.scene { name = "mesh" }
  scene:obstacle { name = "table", shape = "plane" }
  scene:wire { name = "hose", E = 5e6, density = 1200, radius = 0.005, from = { 0, 0, 0.006 },
    to = { 0.08, 0, 0.006 }, model = "tube", ring_radius = 0.0045 }
  local run = scene:run { duration = 0.06, dt = 0.002, frame = 0.01 }
  assert(run.ok, run.reason)
  return run
end

return runs
