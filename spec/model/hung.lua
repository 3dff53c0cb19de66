-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire hangs between two clamps, one of which comes nearer slowly. Its model is chosen while runs of a
--- rung go through a function of the spec.
local refine = require "softworld.run.refine"
local rod = require "spec.model.rod"
local sw = require "softworld"

local hung = {}

local FINE = 20 -- from this number of segments on, edges are fine

-- Calls f() while instead(run_once, scene, options, name, why) replaces the runs of a model.
local function computing(instead, f)
  local computer = refine.computer
  function refine.computer(job, steps, run_once, total)
    return computer(job, steps, function(...) return instead(run_once, ...) end, total)
  end
  local fine, result = pcall(f)
  refine.computer = computer
  assert(fine, result)
  return result
end

local function are_fine_poses(options, segments) return options.quasistatic and segments >= FINE end

--- Returns its run; more: arguments of the run. instead(run_once, scene, options, name, why) is called
--- instead of run_once if replaces(options, segments), which is true for poses on fine edges if not given.
function hung.run(instead, more, replaces)
  local scene = sw.scene { name = "hung" }
  scene:force { kind = "damping", mass = 5 }
  local w = rod.wire(scene)
  scene:clamp(w, { s = 0 })
  local right = scene:clamp(w, { s = 0.6, name = "right" })
  scene:settle()
  right:follow { points = { { 0.6, 0, 0 }, { 0.4, 0.1, 0 } }, duration = 10 }
  local args = { duration = 10, tolerance = { ["right.force"] = { relative = 0.001 } } }
  for key, value in pairs(more or {}) do args[key] = value end
  return computing(function(run_once, s, options, ...)
    local other = instead and (replaces or are_fine_poses)(options, sw.core.segments(w))
    if other then return instead(run_once, s, options, ...) end
    return run_once(s, options, ...)
  end, function() return scene:run(args) end)
end

--- Returns how far the forces of two runs are apart, and the sum of their bars [N].
function hung.apart(one, other)
  local a, b, sum = one.quantities["right.force"], other.quantities["right.force"], 0
  for i = 1, 3 do sum = sum + (a.value[i] - b.value[i]) ^ 2 end
  return sum ^ 0.5, a.error + b.error
end

return hung
