-- SPDX-License-Identifier: GPL-3.0-or-later
-- The change that the next rung makes, followed from level to level.
local change = require "softworld.model.change"
local motion = require "softworld.model.motion"

local function none() return 0 end

-- Returns the bound of a change from here to above, with that of the level before if given, as a share of
-- what is allowed, for values of 1.
local function bound(choice, here, above, before)
  choice.name = "choice"
  local q = { name = "q", tolerance = 1 / change.MODEL }
  local function level(v) return { values = { q = v }, facts = { choice = {} } } end
  local c = change.between({ job = { quantities = { q } } }, { choice = choice, rung = 1 },
    { here = level(here), above = level(above),
      before = before and { here = level(before[1]), above = level(before[2]) } }, none)
  assert.is_near(c.worst, c.all.q, 1e-12)
  return c.all.q
end

local function choice_of(more)
  local c = { safety = 1.5, rungs = { {} } }
  for key, value in pairs(more or {}) do c[key] = value end
  return c
end

describe("the change by the next rung", function()
  it("counts 1.5 times on a single level, and more where steps show only a part of it", function()
    assert.is_near(0.3, bound(choice_of(), 1, 1.2), 1e-12)
    assert.is_near(0.4, bound(choice_of { safety = 3, shows = function() return 0.75 end }, 1, 1.2), 1e-12)
    assert.is_near(0.6, bound(choice_of { safety = 3, shows = function() return 0.1 end }, 1, 1.2), 1e-12)
    assert.is_near(0.6, bound(choice_of { safety = 3, shows = function() return 0 end }, 1, 1.2,
      { 2, 2.2 }), 1e-12)
  end)

  -- Both rungs move by 1 as edges become finer; only the movement of the change itself counts.
  it("stays as it is where it does not move, and otherwise adds 1.5 times its movement", function()
    assert.is_near(0.2, bound(choice_of(), 1, 1.2, { 2, 2.2 }), 1e-12)
    assert.is_near(0.2 + 1.5 * 0.05, bound(choice_of(), 1, 1.2, { 2, 2.15 }), 1e-12)
    assert.is_near(0.2 + 1.5 * 0.05, bound(choice_of(), 1, 1.2, { 2, 2.25 }), 1e-12)
    assert.is_near(0.3, bound(choice_of(), 1, 1.2, { 2, 2.01 }), 1e-12) -- at most 1.5 times
    assert.is_near(0.08 ^ 0.5 + 1.5 * 0.2, bound(choice_of { safety = 9 }, { 0, 0 }, { 0.2, 0.2 },
      { { 1, 1 }, { 1.2, 1 } }), 1e-12)
  end)

  it("ignores levels without a number", function()
    assert.is_near(0.3, bound(choice_of(), 1, 1.2, { math.huge, 2 }), 1e-12)
    assert.equal(math.huge, bound(choice_of(), math.huge, 2))
  end)
end)

-- Amplification of one step of tr-bdf2 for y' = i w y by its two stages: the trapezoid to g h, then bdf2.
local function step_of(phase)
  local g = 2 - 2 ^ 0.5
  local function times(a, b) return { a[1] * b[1] - a[2] * b[2], a[1] * b[2] + a[2] * b[1] } end
  local function over(a, b)
    local size = b[1] ^ 2 + b[2] ^ 2
    local c = times(a, { b[1], -b[2] })
    return { c[1] / size, c[2] / size }
  end
  local half = g * phase / 2
  local y = over({ 1, half }, { 1, -half })
  local right = { y[1] / (g * (2 - g)) - (1 - g) ^ 2 / (g * (2 - g)), y[2] / (g * (2 - g)) }
  local z = over(right, { 1, -(1 - g) / (2 - g) * phase })
  return (z[1] ^ 2 + z[2] ^ 2) ^ 0.5
end

describe("steps of dynamics", function()
  it("show the share of a swing that tr-bdf2 leaves in half a period, next to the peak", function()
    for _, n in ipairs { 2.5, 4, 8, 20 } do
      local expected = step_of(2 * math.pi / n) ^ (n / 2) * math.cos(math.pi / n)
      assert.is_near(expected, motion.shows { swing = 1, dt = 1 / n, weight = 9.81 }, 1e-12)
    end
    assert.equal(0, motion.shows { swing = 1, dt = 0.5, weight = 9.81 })
    assert.equal(0, motion.shows { dt = 0.5, weight = 9.81 })
    assert.equal(1, motion.shows { swing = 1, dt = 0.5, weight = 9.81, acceleration = 0.9 })
  end)
end)
