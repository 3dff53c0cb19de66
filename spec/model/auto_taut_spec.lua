-- SPDX-License-Identifier: GPL-3.0-or-later
-- Choosing poses or dynamics for taut wires without weight. Inertia is compared with the forces asked for, on
-- finer edges if coarse ones are too long for what the wire goes round. No run of dynamics is needed then.
local quantity = require "softworld.quantity"
local sw = require "softworld"

local ENDS, WAY, POINTS = 0.1, 0.03, 40 -- straight ends, way of the hand [m]; intervals of the arc
local ERROR = 0.003 -- of the capstan equation: bending, EI/(T R^2) = 0.001, and stretch [-]

-- A force T pulls at the wire's start, a hand draws its end round a peg, by an angle `row.turns` * pi. flat:
-- the peg stands along z instead of y. Returns the run, the hand's force by the capstan equation, and what
-- that is off [N].
local function capstan(row, args)
  local r, flat = 0.0025, row.flat
  local R, angle = row.R + r, row.turns * math.pi
  local function place(x, z) return flat and { x, z, 0 } or { x, 0, z } end
  local first = math.pi / 2 + angle / 2
  local function on(a, by)
    return place(R * math.cos(a) + by * math.sin(a), R * math.sin(a) - by * math.cos(a))
  end
  local path = {}
  for i = 10, 1, -1 do path[#path + 1] = on(first, -ENDS * i / 10) end
  for i = 0, POINTS do path[#path + 1] = on(first - angle * i / POINTS, 0) end
  for i = 1, 10 do path[#path + 1] = on(first - angle, ENDS * i / 10) end
  local scene = sw.scene { name = "capstan", gravity = { 0, 0, 0 } }
  scene:obstacle { name = "peg", shape = "cylinder", radius = row.R, length = 0.4, friction = row.mu,
    rotation = not flat and { axis = { 1, 0, 0 }, angle = math.pi / 2 } or nil }
  local EI = 0.001 * row.T * R ^ 2
  local w = scene:wire { name = "w", path = path, segments = row.segments, EA = 1e4, EI = EI, GJ = EI,
    mass_per_length = row.mass or 0.02, radius = r }
  local into, last = { math.sin(first), -math.cos(first) }, first - angle
  local out = { math.sin(last), -math.cos(last) }
  scene:force { kind = "point", on = w, s = 0, force = place(-row.T * into[1], -row.T * into[2]) }
  scene:pin(w, { s = w.length, name = "hand" }):follow { relative = true, duration = row.lasts,
    points = { { 0, 0, 0 }, place(WAY * out[1], WAY * out[2]) } }
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  args.duration, args.model = row.lasts, "auto"
  local pull = row.T * math.exp(row.mu * angle)
  return scene:run(args), place(pull * out[1], pull * out[2]), ERROR * pull
end

local function force(share) return { tolerance = { ["hand.force"] = { relative = share } } } end

local function motion_of(run)
  for _, c in ipairs(run.model.choices) do
    if c.name == "motion" then return c end
  end
end

local rows = {
  { T = 1, R = 0.03, mu = 0.1, turns = 0.6, lasts = 5, segments = 32, share = 0.03 },
  { T = 1, R = 0.05, mu = 0.3, turns = 1.0, lasts = 20, segments = 32, share = 0.1 },
  { T = 2.5, R = 0.04, mu = 0.2, turns = 0.8, lasts = 5, segments = 27, share = 0.01, flat = true },
  { T = 0.6, R = 0.03, mu = 0.35, turns = 1.1, lasts = 20, segments = 36, share = 0.03, flat = true },
}

describe("model = 'auto', where a wire without weight is drawn round a peg,", function()
  for _, row in ipairs(rows) do
    it(("takes poses without computing dynamics, R = %g m, %g pi, %d segments"):format(row.R, row.turns,
      row.segments), function()
      local run, pull, known = capstan(row, force(row.share))
      local c = motion_of(run)
      assert.equal("poses", c.rung, c.why)
      assert.equal("free", c.by, c.why)
      assert.is_true(run.model.probes <= 2, tostring(run:why())) -- poses on one level or two
      assert.is_true(run.met)
      -- the capstan equation, within the bar and the equation's own error
      local q = run.quantities["hand.force"]
      local away = quantity.distance(q.value, pull)
      assert.is_true(away <= q.error + known, ("%.3g N away, bar %.3g N"):format(away, q.error))
    end)
  end

  -- EA and EI fit no material here. On the coarsest edges nothing presses on the wire.
  it("does not begin again where the stiffness of the pressed section is not known, and says so", function()
    for _, row in ipairs { { T = 1.32, R = 0.042, mu = 0.252, turns = 1.11, lasts = 5, segments = 32 },
      { T = 1.75, R = 0.0315, mu = 0.255, turns = 1.112, lasts = 5, segments = 32 } } do
      local run = capstan(row, force(0.1))
      local why = tostring(run:why())
      assert.equal(1, run.model.probes, why)
      assert.is_nil(why:find("began again", 1, true), why)
      assert.truthy(why:find("not checked: section: the stiffness of the section of 'w'", 1, true), why)
      assert.is_true(run.met)
    end
  end)

  -- A hundred times heavier and five times faster: inertia, 2500 times as large, is no small part of the
  -- force.
  it("compares with dynamics if the wire is heavy and quick", function()
    local run = capstan({ T = 1, R = 0.04, mu = 0.2, turns = 0.8, lasts = 1, segments = 32, mass = 2 },
      { tolerance = { ["hand.force"] = { relative = 0.1 } }, levels = 3 })
    assert.is_true(motion_of(run).by ~= "free", tostring(run:why()))
  end)

  -- How inertia changes a place is not known from forces.
  it("compares with dynamics if a place is asked for", function()
    local row = rows[1]
    local run = capstan(row, { tolerance = { tip = { relative = 0.1 } } })
    assert.is_true(motion_of(run).by ~= "free", tostring(run:why()))
  end)
end)
