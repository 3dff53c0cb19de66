-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is laid into three clips: one gripper goes ahead and presses it into each, the other keeps
-- its end. What does each clip take, what holds the cable then, and when is it pulled out again?
local sw = require "softworld"
local mm, ms = sw.units.mm, sw.units.ms

local scene = sw.scene { name = "clips" }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
local radius = mm(3)
local wire = scene:wire { name = "cable", E = sw.units.MPa(150), density = 1500, radius = radius,
  from = mm { 0, 0, 40 }, to = mm { 600, 0, 40 }, segments = 80 }
scene:force { kind = "damping", on = wire, mass = 3, stiffness = ms(3) }

local clips = {}
for i, place in ipairs { { 150, 0 }, { 300, 10 }, { 450, 0 } } do
  clips[i] = scene:clip { name = "clip " .. i, at = mm { place[1], place[2], 15 }, width = mm(8),
    insertion = 8, retention = 25, friction = 0.25 }
end

local guide = scene:gripper { name = "guide", pads = { width = mm(10) } }
local keeper = scene:gripper { name = "keeper", pads = { width = mm(20) } }

scene:process(function(p)
  keeper:grasp(wire, { s = mm(580) })
  for i, clip in ipairs(clips) do
    guide:grasp(wire, { s = clip.at[1] + mm(12) })
    local done = guide:clip { into = clip, speed = 0.05, max_force = 40 }
    print(("%s: wire in at t = %.2f s, s = %.1f mm; lips %.2f N, gripper %.2f N"):format(clip.name,
      clip.inserted.time, clip.inserted.s * 1e3, done.peak_force, done.force))
    guide:release()
    keeper:move { by = mm { -1.5, 0, -5 }, speed = 0.1 } -- some slack for the next one
    p:wait(0.3)
  end
end)

local run = scene:run { dt = 5e-3, frame = 0.05 }
assert(run.ok, run.reason)
for _, clip in ipairs(clips) do
  print(("%s holds the cable with %6.3f %6.3f %6.3f N, %.1f %% of what it can"):format(clip.name,
    clip:force()[1], clip:force()[2], clip:force()[3], 100 * clip:ratio()))
end
if arg and arg[1] then run:pictures { path = arg[1], count = 4 } end

-- And out again, at the free end: the first clip lets go at its retention force.
scene:process(function()
  guide:grasp(wire, { s = clips[1].at[1] })
  guide:move { by = mm { 0, 0, 6 }, speed = 0.02 }
end)
assert(scene:run { dt = 2e-3 }.ok)
local out = clips[1].pulled_out
print(("%s: pulled out with %.2f N; the others: %s, %s"):format(clips[1].name, out.peak_force,
  clips[2]:state(), clips[3]:state()))
