-- SPDX-License-Identifier: GPL-3.0-or-later
-- Poses that fail on fine edges only: coarse edges do not show this, and the run goes on with dynamics. Edges
-- so coarse that no run of any model succeeds on them.
local hung = require "spec.model.hung"
local rod = require "spec.model.rod"
local sw = require "softworld"
local twist = require "softworld.model.twist"

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

describe("model = 'auto' where nothing can be computed on the coarsest edges", function()
  local function are_coarse(_, segments) return segments < 12 end

  for _, more in ipairs { {}, { quasistatic = true } } do
    local who = more.quasistatic and "with poses that the script asks for" or "with any model"
    it("begins on finer edges " .. who, function()
      local usual, run = hung.run(nil, more), hung.run(fails, more, are_coarse)
      assert.is_true(run.ok, run.reason)
      assert.is_true(run.met, tostring(run:why()))
      for _, choice in ipairs(usual.model.choices) do
        assert.equal(choice.rung, run.model[choice.name], tostring(run:why()))
      end
      assert.equal(12, run.levels[1].segments[1])
      local away, bars = hung.apart(usual, run)
      assert.is_true(away <= bars, ("%.3g N apart"):format(away))
    end)
  end

  it("says so if no edges help", function()
    local run = hung.run(fails, nil, function() return true end)
    assert.is_false(run.ok)
    assert.truthy(run.reason:find("as this spec has it", 1, true), run.reason)
  end)
end)

-- Two wires hang one above the other; touches of wires change the quantity. Rolling is compared without them.
-- With them it cannot be computed, as this spec has it: like a wire that rolls and should become a mesh.
local function beside()
  local scene = sw.scene { name = "beside" }
  scene:force { kind = "damping", mass = 5 }
  for k, name in ipairs { "a", "b" } do
    local z = 2.2 * rod.radius * (k - 1)
    local w = rod.wire(scene, { name = name, from = { 0, 0, z }, to = { 0.6, 0, z } })
    scene:clamp(w, { s = 0 })
    scene:clamp(w, { s = 0.6 }):follow { relative = true, duration = 0.5,
      points = { { 0, 0, 0 }, { -0.1, 0, 0 } } }
  end
  local function odd() return 1 + (sw.core.data(scene).touching and 0.05 or 0) end
  return scene:run { duration = 0.5, model = "auto", levels = 3, quasistatic = true,
    tolerance = { { name = "odd", value = 0.03, unit = "-", of = odd } } }
end

describe("model = 'auto' where a rung can no longer be computed after a later choice", function()
  local free, apply = twist.free, twist.apply
  after_each(function() twist.free, twist.apply = free, apply end)

  it("keeps what was found before, and says so", function()
    function twist.free() return nil end
    function twist.apply(context, rung, changes, rungs)
      if rung == 2 and rungs.contact == 2 then error("they cannot roll, as this spec has it", 0) end
      return apply(context, rung, changes, rungs)
    end
    local run = beside()
    assert.equal("wires", run.model.contact, tostring(run:why()))
    assert.equal("held", run.model.twist)
    local why = tostring(run:why())
    local words = "found with cheaper models of the other choices; now rolling cannot be computed"
    assert.truthy(why:find(words, 1, true), why)
    assert.is_nil(run.model.blind)
    assert.is_true(run.met, why)
  end)
end)
