-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses that fail on fine edges only: coarse ones say nothing of that, and the run goes on with dynamics.
local sw = require "softworld"
local refine = require "softworld.run.refine"
local rod = require "spec.model.rod"

local FINE = 20 -- segments from which poses fail

-- A wire hangs between two clamps, and one comes nearer slowly. fails: on fine edges its poses do.
local function hung(fails, more)
  local scene = sw.scene { name = "hung" }
  scene:force { kind = "damping", mass = 5 }
  local w = rod.wire(scene)
  scene:clamp(w, { s = 0 })
  local right = scene:clamp(w, { s = 0.6, name = "right" })
  scene:settle()
  right:follow { points = { { 0.6, 0, 0 }, { 0.4, 0.1, 0 } }, duration = 10 }
  local args = { duration = 10, tolerance = { ["right.force"] = { relative = 0.001 } } }
  for key, value in pairs(more or {}) do args[key] = value end
  local computer = refine.computer
  function refine.computer(job, steps, run_once, total)
    return computer(job, steps, function(s, options, name, why)
      local fine = fails and options.quasistatic and sw.core.segments(w) >= FINE
      return run_once(s, options, name, fine and "no equilibrium, as this spec has it" or why)
    end, total)
  end
  local fine, run = pcall(scene.run, scene, args)
  refine.computer = computer
  assert(fine, run)
  return run
end

describe("model = 'auto' where poses fail on fine edges", function()
  it("computes dynamics, says why, and has the same value", function()
    local poses, run = hung(false), hung(true)
    assert.equal("poses", poses.model.motion)
    assert.equal("dynamic", run.model.motion)
    assert.is_true(run.ok, run.reason)
    local why = tostring(run:why())
    assert.truthy(why:find("poses cannot be computed finer: ", 1, true), why)
    assert.truthy(why:find("as this spec has it", 1, true), why)
    local a, b = poses.quantities["right.force"], run.quantities["right.force"]
    local away = 0
    for i = 1, 3 do away = away + (a.value[i] - b.value[i]) ^ 2 end
    assert.is_true(away ^ 0.5 <= a.error + b.error, ("%.3g N apart"):format(away ^ 0.5))
  end)

  it("keeps to poses that the script asks for, and says that they failed", function()
    local run = hung(true, { quasistatic = true })
    assert.is_false(run.ok)
    assert.equal("poses", run.model.motion)
    assert.truthy(run.reason:find("as this spec has it", 1, true), run.reason)
  end)
end)
