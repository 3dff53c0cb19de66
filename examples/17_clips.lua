-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable is laid into three clips. One gripper presses the cable into each clip; another gripper holds
-- its end and gives slack. Which force does each clip need, and at which force does it release the cable?
local sw = require "softworld"
local mm, ms = sw.units.mm, sw.units.ms

local scene = sw.scene { name = "clips" }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
local wire = scene:wire { name = "cable", E = sw.units.MPa(60), density = 1500, radius = mm(4),
  from = mm { 0, 0, 45 }, to = mm { 420, 0, 45 }, segments = 168 }
scene:force { kind = "damping", on = wire, mass = 3, stiffness = ms(3) }

local clips = {}
for i, place in ipairs { { 100, 0 }, { 200, 5 }, { 300, 0 } } do
  clips[i] = scene:clip { name = "clip " .. i, at = mm { place[1], place[2], 14 }, width = mm(10),
    insertion = 8, retention = 25, friction = 0.25 }
end

local guide = scene:gripper { name = "guide", pads = { width = mm(8) } }
local keeper = scene:gripper { name = "keeper", pads = { width = mm(12) } }

scene:process(function(p)
  keeper:grasp(wire, { s = mm(400) })
  for i, clip in ipairs(clips) do
    local place = { s = clip.at[1] + mm(14) }
    if i > 1 then guide:approach(wire, place) end -- it begins at the first place
    guide:grasp(wire, place)
    local done = guide:clip { into = clip, speed = 0.05, max_force = 40 }
    print(("%s: wire in at t = %.2f s, s = %.1f mm; lips %.2f N, gripper %.2f N"):format(clip.name,
      clip.inserted.time, done.s * 1e3, done.peak_force, done.force))
    guide:release()
    guide:retreat { distance = mm(30) }
    keeper:move { by = mm { -0.7, 0, -8 }, speed = 0.1 }
    p:wait_until(function() return clip:seated() end, { timeout = 1 })
    p:wait(0.3)
  end
end)

local run = scene:run { dt = ms(5), frame = 0.05 }
assert(run.ok, run.reason)
local up = keeper:force()[3]
for _, clip in ipairs(clips) do
  local f = clip:force()
  up = up + f[3]
  print(("%s holds it with %6.3f %6.3f %6.3f N; pulled with %.1f %% of its retention so far"):format(
    clip.name, f[1], f[2], f[3], 100 * clip:ratio()))
end
print(("clips and keeper together: %.4f N up; weight %.4f N"):format(up,
  wire.beam.mass_per_length * wire.length * 9.81))
if arg and arg[1] then run:pictures { path = arg[1], count = 4 } end

-- Pull the cable out of the first clip: it releases the cable at its retention force.
scene:process(function()
  guide:approach(wire, { s = clips[1].at[1] })
  guide:grasp(wire, { s = clips[1].at[1] })
  guide:move { by = mm { 0, 0, 8 }, speed = 0.02 }
end)
assert(scene:run { dt = ms(2) }.ok)
print(("%s: pulled out with %.2f N; the others are %s and %s"):format(clips[1].name,
  clips[1].pulled_out.peak_force, clips[2]:state(), clips[3]:state()))
