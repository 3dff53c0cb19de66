-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions as forces that change within a step.
local sw = require "softworld"

local SPEED = 0.02 -- that the whole pulse gives [m/s]

--- A free cable that a function pushes by a pulse from t0 on, of the length `long` [s]. Returns its velocity
-- over SPEED, and the events `coarse`.
local function push(t0, long, args)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "pushed", cable = "GXL 1.5", segments = 20, from = { 0, 0, 0 },
    to = { 0.4, 0, 0 } }
  local mass = wire.beam.mass_per_length * wire.length
  scene:force{ on = wire, kind = function(t, _, _, f)
    if t <= t0 or t >= t0 + long then return end
    local n = #f // 3
    for i = 1, n do
      f[3 * i] = f[3 * i] + mass / (n - 1) * ((i == 1 or i == n) and 0.5 or 1) * SPEED / long
    end
  end }
  local run = scene:run{ duration = 0.7, dt = args.dt, tolerance = args.tolerance }
  assert.is_true(run.ok)
  local told = {}
  for _, e in ipairs(run.events) do
    if e.kind == "coarse" then told[#told + 1] = e end
  end
  return wire:velocity(0.2)[3] / SPEED, told
end

describe("a force function that changes within a step", function()
  it("is followed by steps with a tolerance", function()
    for k = 0, 19 do
      local speed = push(0.5 + 0.001 * k, 0.01, { tolerance = 1e-5 })
      assert.near(1, speed, 0.05)
    end
  end)

  it("is told in steps of fixed size, with the part that they miss and a time step", function()
    for _, case in ipairs{ { 0.01, 0.01 }, { 0.03, 0.02 }, { 0.003, 0.01 } } do
      local _, told = push(0.5021, case[1], { dt = case[2] })
      assert.equal(1, #told)
      assert.equal("pushed", told[1].object)
      assert.is_true(told[1].value > 0.05)
      assert.truthy(told[1].text:find("run again with dt = ", 1, true), told[1].text)
    end
  end)

  it("is seen if it lasts 0.45 of a step; of pulses of a tenth of a step some are not", function()
    local seen = { 0, 0 }
    for k = 0, 19 do
      for i, long in ipairs{ 0.009, 0.002 } do
        local _, told = push(0.5 + 0.001 * k, long, { dt = 0.02 })
        seen[i] = seen[i] + #told
      end
    end
    assert.equal(20, seen[1])
    assert.is_true(seen[2] < 20)
  end)

  it("is not told where steps follow it, nor a steady force", function()
    local speed, told = push(0.5021, 0.1, { dt = 0.002 })
    assert.near(1, speed, 0.02)
    assert.equal(0, #told)
    local _, none = push(-1, 2, { dt = 0.02 })
    assert.equal(0, #none)
  end)

  it("is told if it swings faster than steps follow", function()
    for dt, count in pairs{ [0.005] = 1, [0.0002] = 0 } do
      local scene = sw.scene{}
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.4 }, to = { 0, 0, 0 }, segments = 20 }
      scene:clamp(wire, { s = 0 })
      scene:force{ kind = "damping", mass = 2, stiffness = 0.001 }
      scene:force{ on = wire, kind = function(t, _, _, f)
        f[#f - 1] = f[#f - 1] + 0.03 * (1 + math.sin(800 * math.pi * t))
      end }
      local told = 0
      for _, e in ipairs(scene:run{ duration = 0.1, dt = dt }.events) do
        if e.kind == "coarse" and e.text:find("force function", 1, true) then told = told + 1 end
      end
      assert.equal(count, told)
    end
  end)
end)
