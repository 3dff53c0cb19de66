-- SPDX-License-Identifier: GPL-3.0-or-later
-- Load cycles that runs record for wires meshed by particles: bending to and fro, bent meshes that roll, and
-- tension. They are compared with counts by hand and with the rod of the same cable; also where the model
-- changes during the run.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"
local bent = require "spec.check.bent"

local R, L = 0.05, 0.1
local curve = { { 1, 1e6 }, { 100, 1 } } -- slope -3: 1e6 / range^3 cycles [1/m]

local function merged(...)
  local all = {}
  for _, part in ipairs{ ... } do
    for key, value in pairs(part) do all[key] = value end
  end
  return all
end

local SOFT = { E = 1e7, density = 1000, radius = 0.003 }
-- Meshes have few slices where these suffice.
local MESHES = { ["a tube"] = { model = "tube" }, ["layers of springs"] = { model = "radial" },
  ["layers of elements"] = { model = "radial", section = "solid", segments = 40 },
  ["small cubes"] = { model = "cubic", segments = 70 },
  ["a sheath and its core"] = { model = "composite", segments = 60 },
  ["a sheath on a line"] = { model = "composite", core = "line", segments = 40 },
  ["a sheath that slides on a line"] = { model = "composite", core = "line", bonded = false, segments = 40 } }

-- The allowed error of the largest sum relative to a rod's. A sheath that slides bends more at its clamps,
-- where it does not slide, and is 1.4 % stiffer in tension. Its own curvature and force are counted right.
local function near_rod(model, usual, sliding) return model.bonded == false and sliding or usual end

local function share(run, given)
  return run:check{ fatigue = merged({ bending = curve, source = "this spec" }, given or {}) }:row "fatigue"
end

-- Largest Miner's sum of bending at a place, over 12 directions, and the widest range [1/m].
local function at_place(wire, k)
  local most, widest = 0, 0
  for way = 1, 12 do
    local sum, flat = 0, core.worn_cycles(wire, k, way)
    for i = 1, #flat, 3 do
      sum, widest = sum + flat[i + 2] * flat[i] ^ 3 / 1e6, math.max(widest, flat[i])
    end
    most = math.max(most, sum)
  end
  return most, widest
end

-- The place of a section nearest to s.
local function nearest(wire, s)
  local best
  local places = core.worn(wire)
  for k, place in ipairs(places) do
    local off = math.abs(place.s - s)
    if place.side == 0 and (not best or off < math.abs(places[best].s - s)) then best = k end
  end
  return best
end

local function is_share(wanted, value, part, what)
  print(("measured: %s %.3g %% (demanded %.3g %%)"):format(what, 100 * (value / wanted - 1), 100 * part))
  assert.is_near(wanted, value, part * math.abs(wanted), what)
end

-- From straight to 1/R, -1/R and back: half a cycle of 2/R and two halves of 1/R.
local function wave(t) return math.sin(math.pi * t / 2) / R end
local function of_wave(bend) return (0.5 * (2 * bend) ^ 3 + bend ^ 3) / 1e6 end

-- Bent, then rolled by one turn about its axis: each fibre goes from 1/R to -1/R and back. The worst fibre
-- has two halves of 2/R and half of 1/R.
local function hold(t) return math.min(1, t) / R end
local function roll(t) return 2 * math.pi * math.max(0, math.min(1, t - 1)) end
local function of_roll(bend) return ((2 * bend) ^ 3 + 0.5 * bend ^ 3) / 1e6 end

-- Runs one of these motions in steps of 0.1 s; returns the run and its wire. options: more of the run; how:
-- see bent.lua.
local function done(k, turn, args, options, how)
  local run, _, wire = bent(k, turn, merged({ dt = 0.1 }, options or {}), args,
    merged({ plain = true }, how or {}))
  return run, wire
end

describe("fatigue of a mesh by bending", function()
  local rod = share((done(wave, nil, merged(SOFT, { segments = 40 })))).value

  for name, model in pairs(MESHES) do
    it("counts to and fro as one range of the mesh's own curvature, and counts rolling while bent: "
      .. name, function()
      local args = merged(SOFT, model)
      local _, still = done(hold, nil, args)
      local run, wire = done(wave, nil, args)
      local row, worst = share(run), 0
      for k, place in ipairs(core.worn(wire)) do
        local wanted = of_wave(still:curvature(place.s))
        assert.is_near(wanted, (at_place(wire, k)), 0.005 * wanted, "at " .. place.s)
        worst = math.max(worst, wanted)
      end
      local middle = nearest(wire, L / 2)
      is_share(worst, row.value, 0.005, "of the count by hand")
      is_share(rod, row.value, near_rod(model, 0.04, 0.25), "of the rod")
      is_share(of_wave(1 / R), (at_place(wire, middle)), near_rod(model, 0.025, 0.05),
        "in the middle, of the circle")
      assert.equal("PASS", row.verdict)
      local bend = still:curvature(L / 2) -- bending alone is half a cycle
      is_share(0.5 * bend ^ 3 / 1e6, (at_place(still, middle)), 0.005, "only bent")

      local rolled, turning = done(hold, roll, args, { dt = 0.05 })
      is_share(of_roll(bend), (at_place(turning, middle)), 0.005, "rolled, in the middle, by hand")
      is_share(of_roll(1 / still:min_bend_radius()), share(rolled).value, near_rod(model, 0.02, 0.06),
        "rolled, of the sharpest bend")
    end)
  end

  it("does not depend on direction, swapped ends or step size", function()
    local tube, values = merged(SOFT, { model = "tube" }), {}
    for k, case in ipairs{ {}, { { about = 0.7 } }, { { about = -2.2, swapped = true } },
      { nil, 0.1 }, { nil, 0.01 } } do
      values[k] = share((done(hold, roll, tube, { dt = case[2] or 0.025 }, case[1]))).value
    end
    is_share(values[1], values[2], 1e-6, "turned")
    is_share(values[1], values[3], 1e-6, "turned and swapped")
    is_share(values[1], values[4], 0.01, "in steps of 0.1 s, a tenth of a turn")
    is_share(values[1], values[5], 0.005, "in steps of 0.01 s")
  end)

  for _, case in ipairs{ { "GXL 1.5", "tube", wave }, { "H07V-K 2.5", "radial", hold, roll } } do
    it("is that of the rod: " .. table.concat(case, " as a ", 1, 2), function()
      local values = {}
      for k, more in ipairs{ { segments = 40 }, { model = case[2] } } do
        values[k] = share((done(case[3], case[4], merged({ cable = case[1] }, more)))).value
      end
      is_share(values[1], values[2], 0.025, "of the rod")
    end)
  end

  -- The far end is turned by 1 rad relative to the near one, so the middle has rolled by half of that.
  it("follows how far sections between two holds have rolled", function()
    local function twist(t, s) return s / L * math.max(0, math.min(1, t - 1)) end
    local widest = {}
    for k, more in ipairs{ { segments = 40 }, { model = "radial" } } do
      local run, wire = done(hold, twist, merged(SOFT, more), { duration = 1 })
      run.scene:run{ duration = 1, dt = 0.05, quasistatic = true, wear = true }
      widest[k] = select(2, at_place(wire, nearest(wire, L / 2))) * R
    end
    is_share(2 * math.sin(0.25), widest[1], 0.02, "of the turn, a rod")
    is_share(widest[1], widest[2], 0.02, "of the rod, layers of springs")
  end)
end)

describe("fatigue of a mesh by tension", function()
  -- 0, F, 0, F, F / 2: three halves of F and one of F / 2.
  local function pulled(args, about)
    local c, s = math.cos(about or 0), math.sin(about or 0)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire(merged({ name = "w", from = { 0, 0, 0 }, to = { L * c, L * s, 0 } }, args))
    local function out(d) return { d * c, d * s, 0 } end
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = L }):follow{ points = { out(0), out(1e-4), out(0), out(1e-4), out(0.5e-4) },
      relative = true, duration = 0.7, law = "linear" }
    local run = scene:run{ duration = 0.7, dt = 0.02, quasistatic = true, frame = 0.7, wear = true }
    local F = wire.beam.EA * 1e-3
    local row = run:check{ fatigue = { curve = { { 1, 1e9 }, { 10, 1e6 } } } }:row "fatigue"
    return row.value, (1.5 * F ^ 3 + 0.5 * (F / 2) ^ 3) / 1e9, wire
  end

  for name, model in pairs(MESHES) do
    it("counts the force of every section: " .. name, function()
      local value, wanted, wire = pulled(merged({ E = 1e7, density = 1000, radius = 0.003 }, model), 0.5)
      is_share(wanted, value, near_rod(model, 0.015, 0.05), "of EA times strain")
      for k, place in ipairs(core.worn(wire)) do
        local flat, widest = core.worn_cycles(wire, k, 0), 0
        for i = 1, #flat, 3 do widest = math.max(widest, flat[i]) end
        assert.is_near(2 * wire:tension(place.s), widest, 0.003 * widest)
      end
    end)
  end

  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5" } do
    it("is that of the rod: " .. cable, function()
      local rod, wanted = pulled{ cable = cable, segments = 20 }
      is_share(wanted, rod, 1e-3, "of EA times strain, a rod")
      for _, model in ipairs{ "tube", "radial" } do
        is_share(rod, (pulled{ cable = cable, model = model }), 1e-3, "of the rod, " .. model)
      end
    end)
  end
end)

describe("fatigue of a cable that is shaken", function()
  -- The upper end is shaken to and fro within 0.4 s. Bending is largest at its clamp, where sections of a
  -- mesh keep their shape and are stiffer. The steps that turn the springs of the stiff cable leave errors
  -- in their lengths, which would give the tube a tension of up to 38 N.
  local function shaken(more, dt)
    local scene = sw.scene{}
    local wire = scene:wire(merged({ name = "w", from = { 0, 0, 0 }, to = { 0, 0, -L } }, more))
    scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 1e-3 }
    scene:clamp(wire, { s = 0 }):follow{ duration = 0.4, func = function(t)
      return { 0.06 * math.sin(2.5 * math.pi * t) ^ 2 * math.sin(10 * math.pi * t), 0, 0 }
    end }
    local run = scene:run{ duration = 0.6, dt = dt, wear = true, frame = 0.6 }
    local pull = run:check{ fatigue = { curve = { { 0.01, 1e6 }, { 1, 1 } } } }:row "fatigue"
    return share(run).value, pull.value
  end

  for name, case in pairs{ ["GXL 1.5"] = { { cable = "GXL 1.5" }, 0.02 }, soft = { SOFT, 0.15 } } do
    it("is that of the rod: " .. name, function()
      for dt, pulls in pairs{ [4e-3] = 1.5, [2e-3] = case[2], [1e-3] = case[2] } do
        local bend, pull = shaken(merged(case[1], { segments = 40 }), dt)
        local mesh_bend, mesh_pull = shaken(merged(case[1], { model = "tube" }), dt)
        is_share(bend, mesh_bend, 0.15, "bending, of the rod")
        is_share(pull, mesh_pull, pulls, "tension, of the rod")
      end
    end)
  end
end)

describe("cycles of a wire whose model changes", function()
  local THREE = { { 0.5, { model = "tube" } }, { 1.5, { model = "rod" } }, { 2.5, { model = "radial" } } }
  local ONE = { { 1.5, { model = "tube" } } }
  local function thin(more) return merged(SOFT, { radius = 0.002 }, more or {}) end

  it("continue in the same directions", function()
    for _, changes in ipairs{ ONE, THREE } do
      local run = done(wave, nil, thin(), { dt = 0.05 }, { changes = changes })
      is_share(of_wave(1 / R), share(run).value, 0.03, "of the circle, to and fro")
      run = done(hold, roll, thin(), { dt = 0.05 }, { changes = changes })
      is_share(of_roll(1 / R), share(run).value, 0.03, "of the circle, rolled")
    end
  end)

  -- Lines beside a region carry no twist, so the part between them could turn about its axis at no cost. It
  -- turns with the holds, as the wire does.
  it("follow the holds where lines lie between", function()
    local region = { { 0.5, { model = "radial", region = { 0.04, 0.06 } } } }
    for _, case in ipairs{ { wave, nil, of_wave }, { hold, roll, of_roll } } do
      local run, wire = done(case[1], case[2], thin(), { dt = 0.05 }, { changes = region })
      is_share(case[3](1 / R), (at_place(wire, nearest(wire, L / 2))), 0.03, "in the region, of the circle")
      assert.is_true(share(run).value >= 0.98 * case[3](1 / R))
    end
  end)
end)
