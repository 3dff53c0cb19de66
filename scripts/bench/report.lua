-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cost of a player's page: its size, the time to write it, and the time for new geometry in each picture.
-- @module bench.report
local sw = require "softworld"
local core = sw.core

local report = {}

report.aims = { size = 2.5e6, write = 1.5, picture = 1.5, tube = 1e-3 } -- [B], [s], [s], [s]

--- Returns a scene with a table, three walls, a wire of 500 nodes and a gripper.
function report.scene(name)
  local scene = sw.scene{ name = name }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  for i, x in ipairs{ 0.15, 0.45, 0.75 } do
    scene:obstacle{ name = "wall " .. i, shape = "box", size = { 0.01, 1, 0.1 }, at = { x, 0, 0.05 },
      friction = 0.3 }
  end
  local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025, segments = 499,
    from = { 0, 0, 0.0025 }, to = { -1.25, 0, 0.0025 } }
  scene:force{ kind = "damping", on = wire, stiffness = 5e-3 }
  return scene, wire, scene:gripper{ name = "hand" }
end

--- Runs a wire that is drawn over the walls, with so many frames and 13 or more series.
function report.run(frames)
  local scene, wire, hand = report.scene "report"
  scene:process(function(p)
    hand:grasp(wire, { s = 0.03 })
    hand:move{ by = { 0.1, 0, 0.15 }, speed = 0.25 }
    hand:move{ by = { 0.85, 0, 0 }, speed = 0.25 }
    hand:move{ by = { 0, 0, -0.1 }, speed = 0.25 }
    hand:release()
    p:wait(0.5)
  end)
  local duration = 8.977 -- duration of the process [s]
  return scene:run{ dt = 0.002, frame = duration / frames }, scene
end

--- Writes a page; returns { frames, nodes, columns, write [s], cpu [s], size [B], path }.
function report.write(run, scene, path)
  local t, cpu = core.clock(), os.clock()
  run:report(path)
  t, cpu = core.clock() - t, os.clock() - cpu
  local file = assert(io.open(path, "rb"))
  local size = file:seek "end"
  file:close()
  return { frames = scene:frame_count(), nodes = #scene:frame(scene:frame_count()).values[1].tension,
    columns = #run:series().columns, rows = #run:series().time, write = t, cpu = cpu, size = size,
    path = path }
end

return report
