-- SPDX-License-Identifier: GPL-3.0-or-later
-- A long run is saved to a file after every step of its process. Here the second step fails the first
-- time, as if the computer had crashed. The script then runs again and continues from the file.
local sw = require "softworld"
local mm = sw.units.mm
local file = os.tmpname()
os.remove(file) -- begin without a file

-- A whole script, from its start. fails = true: it fails in the middle of the second step.
local function script(options, fails)
  local scene = sw.scene { name = "laying" }
  scene:obstacle { shape = "plane", friction = 0.3 }
  local wire = scene:wire { cable = "GXL 1.5", from = mm { 0, 0, 1.5 }, to = mm { 600, 0, 1.5 } }
  local left = scene:gripper { name = "left" }
  scene:process(function(p)
    p:step("grasp", function() left:grasp(wire, { s = mm(20) }) end)
    p:step("lift", function()
      left:move { by = mm { 0, 0, 150 }, speed = 0.3 }
      if fails then error "the lights go out" end
    end)
    p:step("lay", function() left:move { by = mm { 300, 100, -140 }, speed = 0.3 } end)
    p:step("release", function() left:release() end)
  end)
  local run = scene:run(options)
  return wire:position(0), left.peak_force, run
end

local ok, why = pcall(script, { dt = 0.005, save = file, resume = file }, true)
print(ok, why)
local at, peak, run = script { dt = 0.005, save = file, resume = file }
local loaded = sw.load(file) -- the file can also be loaded later, without the script
os.remove(file)
local plain_at, plain_peak, plain_run = script { dt = 0.005 }

print(("laid from x = %.4f, y = %.4f m, at most %.4f N"):format(at[1], at[2], peak))
print(("%d steps of time, without the break %d"):format(run.steps, plain_run.steps))
print(("difference of the wire's start %g m, of the peak force %g N"):format(
  math.abs(at[1] - plain_at[1]) + math.abs(at[2] - plain_at[2]) + math.abs(at[3] - plain_at[3]),
  math.abs(peak - plain_peak)))
print(("in the file: %s, t = %.3f s"):format(table.concat(loaded:names(), " "), loaded.time))
