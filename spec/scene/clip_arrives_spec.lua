-- SPDX-License-Identifier: GPL-3.0-or-later
-- A gripper presses a cable past a clip's lips and opens while the lips still draw it in. As the pads open,
-- the cable moves outwards by micrometres. The lips' own pull at that place counted as a load: clip:ratio was
-- 0.71 in steps of 1 ms and less, 0.05 in steps of 5 ms.
local sw = require "softworld"
local t = require "physics.tools"
local mm = sw.units.mm

-- Returns clip:ratio of three clips after the cable was pressed into them, as in example 17.
local function ratios(dt)
  local scene, clips = sw.scene{}, {}
  local wire = scene:wire{ cable = "GXL 1.5", from = mm{ 0, 0, 30 }, to = mm{ 300, 0, 30 }, segments = 60 }
  scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
  for k = 1, 2 do
    clips[k] = scene:clip{ at = mm{ 100 * k, 0, 14 }, width = mm(10), insertion = 8, retention = 25,
      friction = 0.25 }
  end
  local guide = scene:gripper{ name = "guide", pads = { width = mm(8) } }
  scene:clamp(wire, { s = wire.length }):follow{ points = mm{ { 0, 0, 0 }, { 0, 0, -14 } }, relative = true,
    duration = 0.5 }
  scene:process(function(p)
    for _, clip in ipairs(clips) do
      guide:grasp(wire, { s = clip.at[1] + mm(14) })
      guide:clip{ into = clip, speed = 0.05, max_force = 40 }
      guide:release()
      p:wait(0.1)
    end
  end)
  local run = scene:run{ dt = dt, frames = false }
  assert(run.ok, run.reason)
  return clips[1]:ratio(), clips[2]:ratio()
end

-- Returns clip:ratio and the largest pull over the retention of a cable that is pressed past the lips and
-- drawn out again at once.
local function turned(dt, way)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", from = mm{ 0, 0, 16 }, to = mm{ 200, 0, 16 }, segments = 40 }
  local clip = scene:clip{ at = mm{ 100, 0, 0 }, width = mm(10), insertion = 2, retention = 5 }
  local hold = scene:clamp(wire, { s = mm(100) })
  hold:follow{ points = mm{ { 0, 0, 0 }, { 0, 0, way }, { 0, 0, 4 } }, relative = true, duration = 0.2,
    law = "linear" }
  local run = scene:run{ dt = dt, duration = 0.25, frames = false }
  assert(run.ok, run.reason)
  return clip:ratio(), clip.pulled_out and clip.pulled_out.peak_force / clip.retention
end

describe("the pull on a cable in a clip", function()
  it("is not the lips' own pull on a cable that still goes in", function()
    for _, dt in ipairs{ 0.005, 0.002, 0.001, 5e-4 } do
      for k, ratio in ipairs{ ratios(dt) } do
        -- the pads pull the cable by up to 0.01 of the retention while it lies in the seat
        t.near(0, ratio, 0.02, ("%g ms, clip %d: pull over retention"):format(1e3 * dt, k))
      end
    end
  end)

  it("counts on a cable that is drawn out before it came to rest", function()
    for _, dt in ipairs{ 0.005, 0.002, 0.001, 5e-4 } do
      local ratio, out = turned(dt, -15.85)
      t.share(1, ratio, 0.03, ("%g ms: pull over retention"):format(1e3 * dt))
      t.share(1, out, 0.03, ("%g ms: force at which it came out"):format(1e3 * dt))
    end
  end)
end)
