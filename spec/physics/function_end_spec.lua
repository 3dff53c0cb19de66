-- SPDX-License-Identifier: GPL-3.0-or-later
-- A Lua function whose motion is under way when it ends, at the end of a run: the stop that follows is no
-- part of the run. Its last forces are those of the same function that goes on.
local sw = require "softworld"

-- Returns the largest force on the clamp of a single step in the last 15 ms of a run [N], and the run.
-- longer: by how much the function lasts longer than the run; wait: before the function begins [s]; kink:
-- when its acceleration jumps [s]; swings: per second [Hz].
local function last_force(time, longer, options, wait, kink, swings)
  local scene = sw.scene{ name = "end" }
  local wire = scene:wire{ name = "w", cable = "H07V-K 4", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
    segments = 25 }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.002 }
  scene:clamp(wire, { s = 0 })
  local arm = scene:clamp(wire, { s = 0.5, name = "arm" })
  assert(scene:settle().ok)
  local function swing(t)
    local r = math.min(1, t / kink)
    r = r ^ 2 * (3 - 2 * r)
    local angle = 0.6 * r * math.sin(2 * math.pi * swings * t)
    return { 0.5 - 0.15 * r - 0.3 * (1 - math.cos(angle)), 0, 0.3 * math.sin(angle) },
      { axis = { 0, 1, 0 }, angle = -0.5 * angle }
  end
  scene:process(function(p)
    p:wait(wait)
    arm:follow{ duration = time + longer, func = swing }
    p:wait(time)
  end)
  local run = scene:run(options)
  return arm:over(run.time - 0.015, run.time, { window = 0 }).raw_peak_force, run
end

describe("a function that ends with the run while it moves", function()
  for _, dt in ipairs{ 0.02, 0.013, 0.01, 0.004, 0.001 } do
    for _, wait in ipairs{ 0, 0.1, 0.123457 } do
      it(("does not stop within it: dt = %g s, begun at %g s"):format(dt, wait), function()
        local on = last_force(1, 1, { dt = dt }, wait, 1 / 3, 3)
        local ended = last_force(1, 0, { dt = dt }, wait, 1 / 3, 3)
        print(("measured: %.4f N, %.4f N if it goes on"):format(ended, on))
        assert.is_near(on, ended, 0.06 * on)
      end)
    end
  end

  it("does not stop within it: by tolerance", function()
    local on = last_force(1, 1, { tolerance = 1e-5 }, 0.2, 1 / 3, 3)
    local ended = last_force(1, 0, { tolerance = 1e-5 }, 0.2, 1 / 3, 3)
    print(("measured: %.4f N, %.4f N if it goes on"):format(ended, on))
    assert.is_near(on, ended, 0.03 * on)
  end)
end)

describe("a function whose acceleration jumps", function()
  for _, dt in ipairs{ 0.02, 0.01, 0.004 } do
    it(("at the end of a run: it makes no part of its own, dt = %g s"):format(dt), function()
      local force, run = last_force(1 / 3, 1, { dt = dt }, 0, 1 / 3, 1)
      local before = last_force(0.33, 1, { dt = dt }, 0, 1 / 3, 1)
      print(("measured: %.4f N, %.4f N 3 ms before; shortest part %g s"):format(force, before,
        run.smallest_dt))
      assert.is_near(before, force, 0.05 * before)
    end)
  end
end)
