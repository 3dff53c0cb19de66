-- SPDX-License-Identifier: GPL-3.0-or-later
-- Helpers for the specs of run:check: a run with a laid wire, wide limits, and a test of error messages.
local assert = require "luassert"
local sw = require "softworld"

-- A gripper lifts the end of a wire and lays it down. options: of the wire; run_options: of run.
local function laying(options, run_options)
  local scene = sw.scene{ name = "lay" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local given = { name = "w", from = { 0, 0, 0.0015 }, to = { 0.3, 0, 0.0015 }, segments = 30 }
  for key, value in pairs(options or { cable = "GXL 1.5" }) do given[key] = value end
  local wire = scene:wire(given)
  local left = scene:gripper{ name = "left", pads = { width = 0.02 } }
  scene:process(function(p)
    p:step("grasp", function() left:grasp(wire, { s = 0.02 }) end)
    p:step("lift", function() left:move{ by = { 0.05, 0, 0.08 }, duration = 0.4 } end)
    p:step("lay", function() left:move{ by = { 0, 0, -0.08 }, duration = 0.4 } end)
    left:release()
    p:wait(0.4)
  end)
  run_options = run_options or {}
  run_options.dt = run_options.dt or 0.005
  local run = scene:run(run_options)
  return run, scene, wire, left
end

-- Limits with which all rows of a wire and a gripper pass.
local function wide()
  return { max_sidewall = { max = 1e9, sure = true }, peak_force = { max = 1e3, sure = true },
    peak_moment = { max = 1e3, sure = true } }
end

local function fails(f, ...)
  local fine, why = pcall(f)
  assert.is_false(fine)
  for _, words in ipairs{ ... } do assert.truthy(why:find(words, 1, true), why) end
end

return { laying = laying, wide = wide, fails = fails }
