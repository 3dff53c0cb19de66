-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of a run in which a process settles the scene: scene:settle begins the peaks of wires anew, so
-- rows of wires know nothing of the time before.
local sw = require "softworld"

-- A wire of 0.2 m is pulled by 0.1 mm and let back, then settled by `settle(p, scene)`, then at rest.
local function script(settle, options, fails)
  local scene = sw.scene{ name = "settled", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.02,
    radius = 0.0015, from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 20 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:gripper{ name = "hand", rating = false }
  if settle == "at once" then scene:process(function() assert(scene:settle().ok) end) end
  scene:process(function(p)
    p:step("pull", function()
      hand:grasp(wire, { s = 0.2 })
      hand:move{ by = { 1e-4, 0, 0 }, duration = 0.1 }
      hand:move{ by = { -1e-4, 0, 0 }, duration = 0.1 }
    end)
    p:step("settle", function()
      if settle == "later" then assert(scene:settle().ok) end
      p:wait(0.05)
    end)
    p:step("end", function()
      if fails then error "the lights go out" end
      p:wait(0.05)
    end)
  end)
  return scene:run(options or { dt = 0.005, quasistatic = true })
end

local PULL = 1e4 * 1e-4 / 0.19 -- [N]
local LIMITS = { max_tension = 2, min_bend_radius = 0.01, cycle_time = 1, max_sidewall = false }

describe("run:check of a run in which a process settles the scene", function()
  -- The gripper holds the last 10 mm, so EA x strain = 1e4 N x 0.0001 / 0.19 = 5.26 N, above the limit of
  -- 2 N. Poses have no waves, and one of them is at the turn: 1e-3 of it.
  it("is open, with the time, because the peaks before are lost", function()
    local plain = script(nil):check{ limits = LIMITS }
    assert.is_near(PULL, plain:row "w.max_tension".value, 5e-3)
    assert.equal("FAIL", plain.verdict)
    assert.has_error(function() plain:row "settled" end)
    local run = script "later"
    local check = run:check{ limits = LIMITS }
    assert.is_true(check:row "w.max_tension".value < 0.5) -- the pull is not in it
    local row = check:row "settled"
    assert.same({ "OPEN", "OPEN" }, { check.verdict, row.verdict })
    assert.is_near(0.2, row.time, 1e-9)
    local file = assert(io.tmpfile())
    run:summary(file)
    file:seek "set"
    assert.truthy(file:read "a":find("peaks of wires are of the time after", 1, true))
    file:close()
  end)

  it("loses nothing if it settles at the start", function()
    local check = script "at once":check{ limits = LIMITS }
    assert.has_error(function() check:row "settled" end)
    assert.is_near(PULL, check:row "w.max_tension".value, 5e-3)
  end)

  it("is open too if the run goes on from a file, and not in the next run", function()
    local file = os.tmpname()
    os.remove(file)
    local options = { dt = 0.005, quasistatic = true, save = file, resume = file }
    assert.has_error(function() script("later", options, true) end)
    local run = script("later", options)
    os.remove(file)
    assert.is_near(0.2, run:check{ limits = LIMITS }:row "settled".time, 1e-9)
    local second = run.scene:run{ duration = 0.05, dt = 0.005, quasistatic = true }
    assert.has_error(function() second:check{ limits = LIMITS }:row "settled" end)
  end)
end)
