-- SPDX-License-Identifier: GPL-3.0-or-later
local bench = require "bench.rows"
local benchcases = require "bench.cases"
local core = require "softworld.core"
local program = require "spec.host.program"
local sw = require "softworld"

-- The released cantilever's tip at 0.1, 0.2 ... 1 s: x, z [m].
local tip = { .99740368, -.04799323, .96010061, -.26845650, .79598274, -.56311003, .55184860, -.78309375,
  .21791427, -.87207490, -.00032852, -.84061284, .00216890, -.85089323, .20048970, -.87569957,
  .51411943, -.79622880, .79467077, -.57262267 }

describe("bench.row", function()
  it("fills every column of a successful run, and a file gives them back", function()
    local rows = {
      bench.row(benchcases.release, { segments = 5, integrator = "tr-bdf2", dt = 0.05 }),
      bench.row(benchcases.droop, { segments = 5, model = "string" }),
    }
    for _, row in ipairs(rows) do
      assert.equal("ok", row.status, row.reason)
      assert.is_true(row.wall > 0 and row.cpu >= 0 and row.runs >= 1)
      assert.is_true(row.iterations > 0 and row.evaluations > 0)
      for _, name in ipairs(bench.columns) do assert.is_not_nil(row[name], name) end
    end
    assert.equal(20, rows[1].steps)
    local folder = program.folder()
    bench.write(folder .. "/b.csv", rows)
    local back = bench.read(folder .. "/b.csv")
    program.clean()
    assert.equal(2, #back)
    assert.equal(rows[1].error, back[1].error)
    assert.equal("string", back[2].model)
    assert.is_nil(back[2].dt)
    assert.is_nil(back[1].reason)
  end)

  it("gives the error that a direct computation gives", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 9.4176e8, density = 1500, radius = 0.0025, from = { 0, 0, 0 },
      to = { 1, 0, 0 }, segments = 10 }
    scene:clamp(wire, { s = 0 })
    local sum = 0
    for k = 1, 10 do
      assert.is_true(scene:advance({ dt = 0.01, integrator = "bdf2" }, k / 10).ok)
      local p = wire:position(1)
      sum = sum + (p[1] - tip[2 * k - 1]) ^ 2 + (p[3] - tip[2 * k]) ^ 2
    end
    local row = bench.row(benchcases.release, { segments = 10, integrator = "bdf2", dt = 0.01 }, true)
    assert.near(100 * (sum / 10) ^ 0.5, row.error, 1e-4)
    assert.equal("% of L", row.unit)
  end)

  it("reports a divergence and gives no error for it", function()
    local row = bench.row(benchcases.release, { segments = 5, integrator = "velocity-verlet", share = 1.3 })
    assert.equal("diverged", row.status)
    assert.truthy(row.reason:find "at t = ", row.reason)
    assert.equal("", row.error)
    assert.is_true(row.rejected > 0)
  end)

  it("reports refused arguments", function()
    local row = bench.row(benchcases.release, { segments = 5, integrator = "bdf2", dt = 0.01,
      tolerance = 1e-3 })
    assert.equal("refused", row.status)
    assert.truthy(row.reason:find "no error estimate")
    assert.equal("", row.error)
  end)

  it("takes explicit steps as shares of the largest stable step", function()
    for _, name in ipairs{ "symplectic-euler", "rk4" } do
      local row = bench.row(benchcases.release, { segments = 5, integrator = name, share = 0.5 }, true)
      assert.equal("ok", row.status)
      -- axial waves: l / c for leapfrog
      local limit = (name == "rk4" and 2 ^ 0.5 or 1) * 0.2 / (9.4176e8 / 1500) ^ 0.5
      assert.near(0.5 * limit, row.dt, 0.02 * limit)
    end
  end)

  it("measures penetration depth and crossings at walls", function()
    local config = { segments = 10, integrator = "tr-bdf2", dt = 0.02, duration = 2 }
    local row = bench.row(benchcases.walls, config, true)
    assert.equal("ok", row.status, row.reason)
    assert.near(1e3 * row.penetration, row.error, 1e-12)
    local state, deepest = benchcases.walls.make(config), 0
    for k = 1, 100 do
      assert.is_true(state.scene:advance({ integrator = "tr-bdf2", dt = 0.02, parts = false }, k / 50).ok)
      deepest = math.max(deepest, (state.scene:penetration()))
    end
    assert.near(deepest, row.penetration, 1e-12)
    assert.is_true(deepest > 0)
    assert.is_true(row.looked > 0 and row.crossings <= row.looked)
  end)

  it("measures the memory of a scene in bytes per node", function()
    local row = bench.row(benchcases.scale, { segments = 2000, integrator = "tr-bdf2", dt = 1e-3 }, true)
    assert.equal("ok", row.status, row.reason)
    assert.is_true(row.bytes > 3 * 8 * 3 and row.bytes < 4000, row.bytes)
  end)
end)

describe("bench.time", function()
  it("starts each call from a fresh state and fills a batch", function()
    local fresh, calls = 0, 0
    local wall, cpu, runs = bench.time(function() fresh = fresh + 1 end, function()
      calls = calls + 1
      local stop = core.clock() + 2e-3
      repeat until core.clock() >= stop
    end)
    assert.equal(runs, calls)
    assert.equal(runs, fresh)
    assert.is_true(wall >= 2e-3 and cpu >= 0 and runs * 2e-3 >= bench.batch / 2)
  end)
end)

describe("bench.growth", function()
  it("is 1 up to the stability limit of undamped methods, and larger beyond", function()
    assert.near(2, bench.limit("velocity-verlet", 2000, 1e4), 2e-3)
    assert.near(8 ^ 0.5, bench.limit("rk4", 2000, 1e4), 1e-2)
    assert.near(3 ^ 0.5, bench.limit("gsl-rk2", 2000, 1e4), 2e-2)
    assert.near(1, bench.growth("symplectic-euler", 1.9), 1e-12)
    assert.near(1.88, bench.growth("velocity-verlet", 2.1), 0.005)
  end)

  it("covers every explicit method of the registry", function()
    for _, name in ipairs(bench.integrators(false)) do
      assert.near(1, bench.growth(name, 0.1), 1e-3, name)
      assert.is_true(bench.growth(name, 8) > 1, name)
    end
  end)
end)

describe("scripts/bench.lua and scripts/chart.lua", function()
  local function sh(command)
    local pipe = assert(io.popen(command .. " 2>&1"))
    local text = pipe:read "a"
    return text, pipe:close()
  end

  it("write rows, a summary and pictures", function()
    local folder = program.folder()
    local host, to = program.quote(program.path), program.quote(folder)
    local text, fine = sh(("%s scripts/bench.lua quick case=droop,release n=5,10 model=rod "
      .. "integrator=static,tr-bdf2 out=%s"):format(host, to))
    assert.is_true(fine, text)
    assert.truthy(text:find("3 rows in", 1, true), text)
    assert.truthy(text:find("S2 error", 1, true), text)
    assert.equal(3, #bench.read(folder .. "/bench.csv"))
    text, fine = sh(("%s scripts/chart.lua from=%s/bench.csv out=%s readme=%s/r"):format(host, to, to, to))
    assert.is_true(fine, text)
    assert.truthy(program.read(folder .. "/r/speed-accuracy.svg"):find("TR-BDF2", 1, true))
    assert.equal("\137PNG", program.read(folder .. "/release.png"):sub(1, 4))
    program.clean()
  end)

  it("refuse unknown words", function()
    local text, fine = sh(program.quote(program.path) .. " scripts/bench.lua slow")
    assert.is_nil(fine)
    assert.truthy(text:find("'slow' is none of", 1, true))
    text, fine = sh(program.quote(program.path) .. " scripts/chart.lua from=/nowhere/bench.csv")
    assert.is_nil(fine)
    assert.truthy(text:find("run make bench first", 1, true))
  end)
end)

describe("bench.error_bars", function()
  it("gives bars within the error asked for, and compares the time of all levels with the finest", function()
    local rows = bench.error_bars()
    assert.equal(2, #rows)
    for _, row in ipairs(rows) do
      assert.is_true(row.ok, row.case)
      assert.is_true(row.error > 0 and row.error <= row.asked, row.case)
      assert.is_true(row.levels >= 3 and row.ratio > 0 and row.ratio < math.huge, row.case)
    end
  end)
end)

describe("benchlinks.rows", function()
  it("compares a wire that touches itself and a wire in two pieces with plain wires", function()
    local links = require "bench.links"
    local kept = links.batches
    links.batches = 2
    local rows = links.rows()
    links.batches = kept
    assert.equal(2, #rows)
    for _, row in ipairs(rows) do
      assert.is_true(row.ok, row.reason)
      assert.is_true(row.plain > 0 and row.linked > 0)
      assert.near(row.linked / row.plain, row.ratio, 1e-12)
    end
    assert.is_true(rows[1].places >= 5, rows[1].places)
  end)
end)

describe("benchmeshes", function()
  local meshes = require "bench.meshes"
  local kept = {}

  before_each(function()
    for key, value in pairs{ repeats = 1, solves = 2, share = 0.02 } do
      kept[key], meshes[key] = meshes[key], value
    end
  end)

  after_each(function()
    for key, value in pairs(kept) do meshes[key] = value end
  end)

  it("times one second of the tube, and squeezed wires", function()
    local rows = meshes.squeezes()
    rows[#rows + 1] = meshes.second()
    assert.equal(3, #rows)
    for _, row in ipairs(rows) do
      assert.is_true(row.ok, row.reason)
      assert.is_true(row.wall > 0 and row.iteration > 0 and row.iterations >= row.steps)
    end
  end)

  it("times the block solver, and long tubes per ring", function()
    local rows = meshes.blocks()
    assert.equal(5, #rows)
    for _, row in ipairs(rows) do
      assert.is_true(row.factor > 0 and row.solve > 0 and row.ratio > 0 and row.ratio < math.huge)
    end
    rows = meshes.rings()
    assert.equal(3, #rows)
    assert.equal(1, rows[1].ratio)
    assert.near(rows[3].ring, rows[3].ratio * rows[1].ring, 1e-15)
  end)

  it("compares every model with the rod", function()
    for _, what in ipairs{ "cantilever", "wall" } do
      local rows = meshes.costs(what)
      assert.equal(#meshes.models, #rows)
      assert.equal("rod", rows[1].name)
      for _, row in ipairs(rows) do
        assert.is_true(row.ok, row.reason)
        assert.near(row.wall / rows[1].wall, row.ratio, 1e-9 * row.ratio)
      end
      assert.is_true(rows[3].particles > rows[1].particles)
    end
  end)

  it("times the calibration of each mesh", function()
    local rows = meshes.calibrations()
    assert.equal(#meshes.models - 2, #rows)
    for _, row in ipairs(rows) do assert.is_true(row.ok and row.wall >= 0, row.reason) end
  end)
end)
