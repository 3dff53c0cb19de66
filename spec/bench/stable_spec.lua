-- SPDX-License-Identifier: GPL-3.0-or-later
local benchstable = require "bench.stable"

local cord = { name = "cord", E = 1e7, density = 1500, radius = 0.0025, length = 1, segments = 8 }
-- Edges shorter than the radius: bending sets the limit.
local stub = { name = "stub", E = 1e7, density = 1500, radius = 0.0025, length = 0.02, segments = 16 }

describe("benchstable.modes", function()
  it("agrees with exact eigenvalues", function()
    local known = benchstable.wires[1]
    local fastest, share = 0, 0
    for _, mode in ipairs(benchstable.modes(known, "rod")) do
      fastest, share = math.max(fastest, mode.omega), share + mode.share
    end
    assert.near(known.omega, fastest, 1e-8 * known.omega)
    assert.near(1, share, 1e-9)
  end)

  it("agrees with the closed form of a chain", function()
    local modes = benchstable.modes(cord, "rod")
    local list = {}
    for i = 1, cord.segments do list[i] = modes[i].omega end
    table.sort(list)
    local c = (cord.E / cord.density) ^ 0.5
    for k = 1, cord.segments do
      local exact = 2 * c * cord.segments * math.sin((2 * k - 1) * math.pi / (4 * cord.segments))
      assert.near(exact, list[k], 1e-7 * exact)
    end
  end)
end)

describe("benchstable.largest", function()
  it("finds a threshold, and reports when there is none in the interval", function()
    local found, how = benchstable.largest(function(x) return x < 3 end, 1, 10, 20)
    assert.near(3, found, 1e-4)
    assert.equal("found", how)
    assert.equal("below", select(2, benchstable.largest(function() return false end, 1, 10, 20)))
    assert.equal("above", select(2, benchstable.largest(function() return true end, 1, 10, 20)))
  end)
end)

describe("the largest stable step", function()
  for _, w in ipairs{ cord, stub } do
    for _, model in ipairs{ "rod", "string" } do
      for _, integrator in ipairs{ "symplectic-euler", "velocity-verlet", "rk4" } do
        it(("is the theoretical one within 2 %%: %s, %s, %s"):format(w.name, model, integrator), function()
          local modes = benchstable.modes(w, model)
          local found, expected, how = benchstable.measure(integrator, w, model, modes, 7)
          assert.equal("found", how)
          assert.near(1, found / expected, 0.02)
        end)
      end
    end
  end
end)

describe("benchsqueeze", function()
  local squeeze = require "bench.squeeze"

  local function row_of(item, model)
    local found
    squeeze.add_all(function(name, run, o)
      if name == item and o.model == model then
        o.integrator = "tr-bdf2"
        found = found or run(o)
      end
    end)
    return found
  end

  it("presses a tube and releases it", function()
    local row = row_of("squeezed to 60 %", "tube")
    assert.equal("ok", row.status, row.reason)
    assert.truthy(row.note:find "afterwards")
    assert.is_true(row.steps >= 300)
  end)

  it("reports that springs cannot turn inside out, while solid elements recover", function()
    local row = row_of("pushed inside out", "tube")
    assert.equal("failed", row.status)
    assert.truthy(row.reason:find "turn over")
    row = row_of("pushed inside out", "radial, solid")
    assert.equal("ok", row.status, row.reason)
  end)

  it("finds the explicit stability limit above the program's bound, by less than a factor of 3", function()
    for _, mesh in ipairs{ squeeze.meshes[1], squeeze.meshes[5] } do
      local found, how, own = squeeze.measure("velocity-verlet", mesh, 1, 5)
      assert.equal("found", how)
      assert.is_true(own < found and found < 3 * own, found / own)
    end
  end)
end)
