-- SPDX-License-Identifier: GPL-3.0-or-later
-- The cost of contact. Within one linearisation, friction follows the normal forces, and touches that pull
-- open. Counts of iterations are the same on every machine.
package.path = "./?.lua;" .. package.path
local cases = require "softworld.cases"
local core = require "softworld.core"
local scenes = require "spec.contact.scenes"

-- Lays a wire over three walls with every friction coefficient and number of segments. Returns the sums.
local function laid()
  local sum = { steps = 0, iterations = 0, rejected = 0, redone = 0, depth = 0, tension = 0 }
  for _, n in ipairs{ 50, 100 } do
    for _, mu in ipairs{ 0.2, 0.27, 0.3, 0.33, 0.4 } do
      local c = cases.laying{ segments = n, friction = mu }
      local r = c.run()
      assert.is_true(r.ok, r.reason)
      for _, key in ipairs{ "steps", "iterations", "rejected" } do sum[key] = sum[key] + r[key] end
      sum.redone = sum.redone + r:ledger().redone.count
      local m = c.measured()
      sum.depth, sum.tension = math.max(sum.depth, m.penetration), math.max(sum.tension, m.tension)
      c.scene:close()
    end
  end
  return sum
end

describe("laying over walls at the default step", function()
  local sum
  setup(function() sum = laid() end)

  it("takes less than four and a half iterations a step", function()
    local each = sum.iterations / sum.steps -- 9.1 when each change of a touch took one
    assert.is_true(each < 4.5, each .. " iterations a step")
  end)

  it("redoes less than one step in a hundred", function()
    local share = sum.redone / sum.steps
    assert.is_true(share < 0.01, 100 * share .. " % of the steps were redone")
    assert.is_true(sum.rejected < 0.01 * sum.steps, sum.rejected .. " steps were rejected")
  end)

  it("stays above the walls, without a spike of tension", function()
    assert.is_true(sum.depth < 1e-4, sum.depth .. " m deep")
    assert.is_true(sum.tension < 3, sum.tension .. " N") -- the wire weighs 0.29 N
  end)
end)

describe("a wire that begins to slide", function()
  -- Lengthwise on a cylinder, off its top: the whole wire moves alike. At the start only rounding gives its
  -- friction a direction.
  it("stays straight and gains the speed that gravity less friction gives", function()
    local R, r, mu, h = 0.05, 0.0025, 0.3, 0.005
    local s = core.scene{}
    s:obstacle{ shape = "cylinder", radius = R, length = 1, friction = mu,
      rotation = { axis = { 0, 1, 0 }, angle = math.pi / 2 } }
    local y = 0.02
    local z = ((R + r) ^ 2 - y ^ 2) ^ 0.5
    local w = scenes.add_wire(s, { -0.25, y, z }, { 0.25, y, z }, 24)
    assert.is_true(s:advance({ dt = h }, h).ok)
    local a, least, most = math.asin(y / (R + r)), math.huge, -math.huge
    for i = 0, 24 do
      local v = w:velocity(0.5 * i / 24)
      local along = v[2] * math.cos(a) - v[3] * math.sin(a)
      least, most = math.min(least, along), math.max(most, along)
    end
    local right = h * 9.81 * (math.sin(a) - mu * math.cos(a))
    assert.is_true(most - least < 0.03 * right, ("from %g to %g m/s"):format(least, most))
    assert.is_true(math.abs(0.5 * (least + most) / right - 1) < 0.03, least .. " for " .. right)
  end)
end)

describe("a long wire that lands flat on a table", function()
  -- Its nodes are metres from the origin, so the rounding of their places is larger than the shift to which
  -- friction's spring responds. It is no real shift.
  it("shows no friction from the rounding of places", function()
    local s = core.scene{}
    s:obstacle{ shape = "plane", friction = 0.3 }
    local w = scenes.add_wire(s, { 0, 0, 0.01 }, { 20, 0, 0.01 }, 2000)
    assert.is_true(s:advance({ dt = 0.01 }, 0.03).ok)
    local row = s:advance({ dt = 0.01 }, 0.04)
    -- the landing is followed in parts (substeps) of two iterations each
    assert.is_true(row.ok and row.iterations < 3 * row.steps,
      ("%d iterations in %d steps"):format(row.iterations, row.steps))
    local most = 0
    for i = 0, 2000 do
      local v = w:velocity(0.01 * i)
      most = math.max(most, math.abs(v[1]), math.abs(v[2]))
    end
    assert.is_true(most < 1e-9, most .. " m/s along the table")
  end)
end)
