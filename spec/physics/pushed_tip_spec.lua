-- SPDX-License-Identifier: GPL-3.0-or-later
-- A weightless wire, clamped upright, is pushed by eps L against a floor: its tip
-- sticks while the friction coefficient is above |Fx|/N of the elastica with a
-- pinned tip, and slips out below. Independent shooting solution, error 1e-11
-- (the test is that of Sano et al. 2017 and Romero et al. 2021).
local sw = require "softworld"

local RADIUS = 1e-4 -- [m] of a wire of 1 m
local thresholds = { { 0.01, 0.044854 }, { 0.1, 0.152793 }, { 0.3, 0.326491 } } -- eps, |Fx|/N

local function pushed(eps, mu)
  local s = sw.scene{ gravity = { 0, 0, 0 } }
  s:obstacle{ shape = "plane", friction = mu }
  local w = s:wire{ EA = 1e6, EI = 1, mass_per_length = 1, radius = RADIUS,
    from = { 0, 0, 1 + RADIUS - 1e-7 }, to = { 0, 0, RADIUS - 1e-7 }, segments = 50 }
  local c = s:clamp(w, { s = 0 })
  local side = s:force{ kind = "line", on = w, force = { 0.5, 0, 0 } } -- which way to bow
  c:follow{ points = { { 0, 0, 0 }, { 0, 0, -eps } }, relative = true, duration = 1, law = "linear" }
  local run = s:run{ duration = 0.3, dt = 0.02, quasistatic = true }
  assert.is_true(run.ok, run.reason)
  side:release()
  run = s:run{ duration = 0.7, dt = 0.02, quasistatic = true }
  assert.is_true(run.ok, run.reason)
  local f = c:force()
  return math.abs(w:position(1)[1]), math.abs(f[1] / f[3])
end

describe("the tip of a wire pushed against a floor", function()
  for _, row in ipairs(thresholds) do
    local eps, threshold = row[1], row[2]
    it(("sticks above mu = %.4g and slips below it, pushed by %g L"):format(threshold, eps), function()
      local stuck, ratio = pushed(eps, 1.02 * threshold)
      assert.is_true(stuck < 1e-4, "moved " .. stuck)
      assert.is_true(math.abs(ratio / threshold - 1) < 0.02, "force ratio " .. ratio)
      assert.is_true(pushed(eps, 0.98 * threshold) > 0.05)
    end)
  end
end)
