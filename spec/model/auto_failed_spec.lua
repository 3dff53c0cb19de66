-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses that fail on fine edges only: coarse edges do not show this, and the run goes on with dynamics.
local hung = require "spec.model.hung"

local function fails(run_once, scene, options, name)
  return run_once(scene, options, name, "no equilibrium, as this spec has it")
end

describe("model = 'auto' where poses fail on fine edges", function()
  it("computes dynamics, says why, and has the same value", function()
    local poses, run = hung.run(), hung.run(fails)
    assert.equal("poses", poses.model.motion)
    assert.equal("dynamic", run.model.motion)
    assert.is_true(run.ok, run.reason)
    local why = tostring(run:why())
    assert.truthy(why:find("poses cannot be computed on finer edges: ", 1, true), why)
    assert.truthy(why:find("as this spec has it", 1, true), why)
    local away, bars = hung.apart(poses, run)
    assert.is_true(away <= bars, ("%.3g N apart"):format(away))
  end)

  it("tries no finer poses after the first that fail", function()
    local count = 0
    hung.run(function(...)
      count = count + 1
      return fails(...)
    end)
    assert.equal(1, count)
  end)

  it("keeps poses that the script asks for, and reports that they failed", function()
    local run = hung.run(fails, { quasistatic = true })
    assert.is_false(run.ok)
    assert.equal("poses", run.model.motion)
    assert.truthy(run.reason:find("as this spec has it", 1, true), run.reason)
  end)
end)
