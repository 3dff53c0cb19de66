-- SPDX-License-Identifier: GPL-3.0-or-later
-- What the next rung changes, followed from level to level.
local change = require "softworld.model.change"
local motion = require "softworld.model.motion"

local function none() return 0 end

-- The bound of a change of here to above, and before that; as a share of what is allowed, of values of 1.
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
  it("counts 1.5 times where there is one level, or what little it shows", function()
    assert.is_near(0.3, bound(choice_of(), 1, 1.2), 1e-12)
    assert.is_near(0.4, bound(choice_of { safety = 3, shows = function() return 0.75 end }, 1, 1.2), 1e-12)
    assert.is_near(0.6, bound(choice_of { safety = 3, shows = function() return 0.1 end }, 1, 1.2), 1e-12)
    assert.is_near(0.6, bound(choice_of { safety = 3, shows = function() return 0 end }, 1, 1.2,
      { 2, 2.2 }), 1e-12)
  end)

  -- Both rungs move by 1, as edges become finer; what the change moves by tells.
  it("is what it was where it does not move, and counts with 1.5 times what it moved by", function()
    assert.is_near(0.2, bound(choice_of(), 1, 1.2, { 2, 2.2 }), 1e-12)
    assert.is_near(0.2 + 1.5 * 0.05, bound(choice_of(), 1, 1.2, { 2, 2.15 }), 1e-12)
    assert.is_near(0.2 + 1.5 * 0.05, bound(choice_of(), 1, 1.2, { 2, 2.25 }), 1e-12)
    assert.is_near(0.3, bound(choice_of(), 1, 1.2, { 2, 2.01 }), 1e-12) -- no more than 1.5 times
    assert.is_near(0.08 ^ 0.5 + 1.5 * 0.2, bound(choice_of { safety = 9 }, { 0, 0 }, { 0.2, 0.2 },
      { { 1, 1 }, { 1.2, 1 } }), 1e-12)
  end)

  it("tells nothing of levels where there is no number", function()
    assert.is_near(0.3, bound(choice_of(), 1, 1.2, { math.huge, 2 }), 1e-12)
    assert.equal(math.huge, bound(choice_of(), math.huge, 2))
  end)
end)

-- A step of tr-bdf2 of y' = i w y by its two stages: the trapezoid to g h, then bdf2.
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
  it("show of a swing what tr-bdf2 leaves of it in half a period, at the step next to the peak", function()
    for _, n in ipairs { 2.5, 4, 8, 20 } do
      local expected = step_of(2 * math.pi / n) ^ (n / 2) * math.cos(math.pi / n)
      assert.is_near(expected, motion.shows { swing = 1, dt = 1 / n, weight = 9.81 }, 1e-12)
    end
    assert.equal(0, motion.shows { swing = 1, dt = 0.5, weight = 9.81 })
    assert.equal(0, motion.shows { dt = 0.5, weight = 9.81 })
    assert.equal(1, motion.shows { swing = 1, dt = 0.5, weight = 9.81, acceleration = 0.9 })
  end)
end)
