-- SPDX-License-Identifier: GPL-3.0-or-later
-- The catalogue of cables, cables of one's own, the bend rule, and wires made from a cable.
local sw = require "softworld"
local bendrule = require "softworld.wire.bendrule"
local stranding = require "softworld.wire.stranding"

local units = { outer_diameter = "m", mass_per_length = "kg/m", EA = "N", EI = "N m2", GJ = "N m2",
  friction = "-" }
local flags = { measured = true, computed = true, guessed = true }

local function near(expected, value, share)
  local ok = math.abs(value - expected) <= share * math.abs(expected)
  if not ok then error(("expected %g within %g, got %g"):format(expected, share, value), 2) end
end

-- Checks that f raises a text that matches, at a line of this file.
local function refuses(f, pattern)
  local ok, message = pcall(f)
  if ok then error("expected an error like " .. pattern, 2) end
  if not message:find(pattern) or not message:find "^[^\n]*cable_spec.lua:%d+: " then
    error(("expected an error here like '%s', got '%s'"):format(pattern, message), 2)
  end
end

-- Returns a complete definition with some other fields and a new name each time.
local count = 0
local function own(fields)
  count = count + 1
  local d = { name = "own " .. count, outer_diameter = 0.003, mass_per_length = 0.0193, EA = 1e5,
    EI = 1.2e-3, GJ = 1.5e-3, friction = 0.3, temperature = { low = -20, high = 80 },
    bend = { rule = "IEC 62440" }, flag = "measured", source = "our bench", spread = 0.1 }
  for key, value in pairs(fields) do d[key] = value ~= "none" and value or nil end
  return d
end

describe("catalogue", function()
  it("has complete and consistent entries", function()
    local names = sw.cables()
    assert.is_true(#names >= 20)
    for _, name in ipairs(names) do
      local e = sw.cable(name)
      assert.are.equal(name, e.name)
      for key, unit in pairs(units) do
        local q, where = e[key], name .. ", " .. key
        assert.is_true(type(q) == "table", where)
        assert.are.equal(unit, q.unit, where)
        assert.is_true(q.low <= q.value and q.value <= q.high and q.low > 0, where)
        assert.is_true(flags[q.flag], where)
        assert.is_true(#q.source > 5, where)
      end
      assert.is_true(e.temperature.low < e.temperature.high and flags[e.temperature.flag], name)
      assert.is_true(#e.temperature.source > 5 and flags[e.bend.flag] and #e.bend.source > 5, name)
      local density = e.mass_per_length.value / (math.pi * e.outer_diameter.value ^ 2 / 4)
      assert.is_true(density > 1200 and density < 5500, name)
      assert.is_true(e:bend_limit "termination" < e:bend_limit "load", name)
    end
  end)

  it("orders the bounds of EI and GJ where the construction is known", function()
    for _, name in ipairs(sw.cables()) do
      local e = sw.cable(name)
      for _, key in ipairs { "EI", "GJ" } do
        local q = e[key]
        assert.are.equal(e.construction ~= nil, q.slip ~= nil, name)
        if q.slip then
          assert.is_true(q.low <= q.slip and q.slip < q.stick and q.stick <= q.high, name)
          assert.is_true(q.slip <= q.value and q.value <= q.stick, name)
        end
      end
      if e.construction then
        assert.are.equal(e.EI.slip, e.EI.value)
        near(1.25, e.GJ.value / e.EI.value, 1e-9)
        -- the stated mass against strands and insulation of bulk density 8930 and 1350 or 1400 kg/m3
        near(1, e.mass_per_length.value
          / stranding.compute(e.construction, e.outer_diameter).mass_per_length.value, 0.06)
      end
    end
  end)

  it("has the sizes and masses of the tables", function()
    local gxl = { [0.5] = { 2.4, 10.4 }, [1] = { 2.6, 13.4 }, [1.5] = { 3.0, 19.3 }, [2.5] = { 3.5, 28.3 },
      [4] = { 4.1, 38.7 }, [6] = { 4.8, 59.5 }, [10] = { 5.9, 95.2 } }
    for size, row in pairs(gxl) do
      local e = sw.cable(("GXL %g"):format(size))
      near(row[1] / 1000, e.outer_diameter.value, 1e-12)
      near(row[2] / 1000, e.mass_per_length.value, 1e-12)
      assert.are.equal("measured", e.mass_per_length.flag)
    end
    local thin = { [0.5] = 1.7, [0.75] = 1.9, [1] = 2.1, [1.5] = 2.4, [2.5] = 3.0, [4] = 3.7, [6] = 4.3,
      [10] = 6.0 }
    for size, od in pairs(thin) do
      near(od / 1000, sw.cable(("FLRY-B %g"):format(size)).outer_diameter.high, 1e-12)
    end
    local identified = { white = { 17.4, 1.22e-4, 0.82 }, black = { 26.8, 1.20e-3, 1.46 },
      red = { 21.5, 9.30e-4, 1.64 } }
    for colour, row in pairs(identified) do
      local e = sw.cable("identified " .. colour)
      near(row[1] / 1000, e.mass_per_length.value, 1e-12)
      near(row[2], e.EI.value, 1e-12)
      near(row[3], e.GJ.value / e.EI.value, 1e-12)
      assert.are.equal("measured", e.EI.flag)
      assert.are.equal("guessed", e.outer_diameter.flag)
    end
  end)

  it("computes EI and GJ of strands by the formulas for hand computation", function()
    -- GXL 1.5: 19 strands of 0.286 mm; copper 115 and 43 GPa, XLPE 150 and 50 MPa; 3 mm outside
    local d, Dc, D = 0.286e-3, 0.286e-3 * math.sqrt(19 / 0.75), 3e-3
    local tube = math.pi / 64 * (D ^ 4 - Dc ^ 4)
    local e = sw.cable "GXL 1.5"
    near(115e9 * 19 * math.pi / 64 * d ^ 4 + 150e6 * tube, e.EI.slip, 1e-9)
    near(115e9 * 19 * math.pi / 4 * d ^ 2 * Dc ^ 2 / 16 + 150e6 * tube, e.EI.stick, 1e-9)
    near(2 * (43e9 * 19 * math.pi / 64 * d ^ 4 + 50e6 * tube), e.GJ.slip, 1e-9)
    -- a single strand is a solid wire and has nothing to slip
    local solid = sw.cable.define(own { EI = "none", GJ = "none", EA = "none", mass_per_length = 0.0195,
      construction = { strands = 1, strand_diameter = 1.4e-3, conductor = "copper", insulation = "PVC" } })
    near(solid.EI.stick, solid.EI.slip, 1e-12)
    near(115e9 * math.pi / 4 * 1.4e-3 ^ 2 + 60e6 * math.pi / 4 * (9e-6 - 1.96e-6), solid.EA.value, 1e-9)
  end)

  it("shows readable sheets", function()
    local sheet = tostring(sw.cable "GXL 1.5")
    for _, part in ipairs { "GXL 1.5", "outer_diameter", "0.003 ", "kg/m", "measured", "computed", "guessed",
      "J1128", "strands slip", "IEC 62440", "degC" } do
      assert.truthy(sheet:find(part, 1, true), part)
    end
    assert.truthy(tostring(sw.cables()):find("identified red", 1, true))
    assert.are.equal(115e9, sw.material "copper".E.value)
  end)

  it("suggests the nearest name", function()
    refuses(function() local _ = sw.cable "GXL1.5" end,
      "there is no cable 'GXL1.5'; did you mean 'GXL 1.5'?")
    refuses(function() local _ = sw.cable "a rope" end, "sw.cables%(%) lists them")
    refuses(function() local _ = sw.cable(7) end, "got number")
    refuses(function() local _ = sw.material "coper" end, "did you mean 'copper'?")
  end)
end)

describe("an entry that a script has written into", function()
  it("is refused, with the field that was written", function()
    local entry = sw.cable "FLRY-B 0.5"
    local EA = entry.EA
    for _, spoil in ipairs{ function() entry.EA = 0.138 end, function() entry.EA = { value = "x" } end } do
      spoil()
      local told = "into its EA; to make an entry of your own use sw.cable.define"
      local function wire(cable)
        return function() sw.scene{}:wire{ cable = cable, from = { 0, 0, 0 }, to = { 1, 0, 0 } } end
      end
      for _, use in ipairs{ wire "FLRY-B 0.5", wire(entry), function() entry:section() end } do
        local fine, why = pcall(use)
        assert.is_false(fine)
        assert.truthy(why:find(told, 1, true), why)
      end
      assert.truthy(tostring(entry):find(told, 1, true))
    end
    entry.EA = EA
    assert.is_true(entry:section().EA > 0)
  end)
end)

describe("bend rule", function()
  it("is the table of IEC 62440", function()
    local diameters = { 0.005, 0.010, 0.015, 0.025 }
    local expected = { fixed = { 4, 5, 6, 6 }, termination = { 2, 3, 4, 4 }, movement = { 5, 5, 6, 6 },
      load = { 9, 9, 9, 10 }, reeling = { 7, 7, 8, 8 }, pulleys = { 10, 10, 10, 10 } }
    for use, row in pairs(expected) do
      for i, factor in ipairs(row) do assert.are.equal(factor, bendrule.factor(use, diameters[i])) end
    end
    -- the upper limits belong to their columns
    assert.are.equal(4, bendrule.factor("fixed", 0.008))
    assert.are.equal(5, bendrule.factor("fixed", 0.012))
    assert.are.equal(9, bendrule.factor("load", 0.020))
    assert.are.equal(#bendrule.uses, 6)
  end)

  it("gives the inside and centre-line radius of a cable", function()
    local inside, centre, use = sw.cable "GXL 1.5":bend_limit()
    near(0.012, inside, 1e-12)
    near(0.0135, centre, 1e-12)
    assert.are.equal("fixed", use)
    near(0.027, (sw.cable "GXL 1.5":bend_limit "load"), 1e-12)
    refuses(function() sw.cable "GXL 1.5":bend_limit "reelin" end, "did you mean 'reeling'?")
  end)
end)

describe("cable.define", function()
  it("takes a cable of one's own", function()
    local e = sw.cable.define(own { EI = { value = 1e-3, low = 5e-4, high = 2e-3, flag = "guessed",
      source = "a neighbour" }, bend = { movement = 7.5, use = "movement" } })
    assert.are.equal(e, sw.cable(e.name))
    near(0.09, e.EA.low / 1e6, 1e-9)
    assert.are.equal("guessed", e.EI.flag)
    assert.are.equal("our bench", e.GJ.source)
    near(0.0225, (e:bend_limit()), 1e-12)
    refuses(function() e:bend_limit "load" end, "it has no bend limit for the use 'load'")
    refuses(function() sw.cable.define(own { name = e.name }) end, "already has a cable of this name")
    assert.is_true(#tostring(e) > 200)
  end)

  it("computes missing values from the construction", function()
    local e = sw.cable.define(own { EA = "none", EI = "none", GJ = "none", mass_per_length = "none",
      friction = "none", outer_diameter = 3.4e-3,
      construction = { strands = 30, strand_diameter = 0.25e-3, conductor = "copper", insulation = "PUR" } })
    for _, key in ipairs { "EA", "EI", "GJ", "mass_per_length" } do
      assert.are.equal("computed", e[key].flag)
    end
    assert.are.equal(0.5, e.friction.value)
  end)

  local strands = { strands = 19, strand_diameter = 0.286e-3, conductor = "copper", insulation = "XLPE" }
  local refused = {
    { { outer_diameter = "none" }, "outer_diameter %[m%] is missing" },
    { { mass_per_length = "none" }, "mass_per_length %[kg/m%] is missing" },
    { { EA = "none" }, "EA %[N%] is missing" },
    { { EI = "none" }, "EI %[N m2%] is missing" },
    { { GJ = "none" }, "GJ %[N m2%] is missing; for a cable it does not follow from E and nu" },
    { { friction = "none" }, "friction %[%-%] is missing" },
    { { temperature = "none" }, "temperature is missing" },
    { { bend = "none" }, "bend is missing" },
    { { flag = "none" }, "outer_diameter has no flag" },
    { { source = "none" }, "outer_diameter has no source" },
    { { spread = "none" }, "outer_diameter has no spread" },
    { { flag = "mesured" }, "did you mean 'measured'?" },
    { { diameter = 3 }, "no field 'diameter'" },
    { { EI = "soft" }, "EI %[N m2%] must be a number" },
    { { EI = { value = 1e-3, lo = 1 } }, "EI has no field 'lo'; did you mean 'low'?" },
    { { EI = { value = 1e-3, low = 2e-3, high = 3e-3 } }, "EI = 0.001 N m2 lies outside its spread" },
    { { EI = { value = 1200, unit = "N mm2" } }, "EI is in N m2, not in N mm2" },
    { { EI = -1e-3 }, "EI = %-0.001 N m2 is not allowed" },
    { { EI = 0 / 0 }, "EI: its value" },
    { { EI = 1200 }, "EI = 1200 N m2 is more than EA R%^2" },
    { { GJ = 1 }, "GJ = 1 N m2 is .* times EI" },
    { { GJ = 1e-6 }, "GJ = 1e%-06 N m2 is" },
    { { outer_diameter = 3 }, "outer_diameter = 3 m is not allowed; it must be at most 0.2 m" },
    { { mass_per_length = 19.3 }, "cables have 300 to 12000 kg/m3; are the units right?" },
    { { mass_per_length = 1.9e-5 }, "are the units right?" },
    { { friction = 4 }, "friction = 4" },
    { { spread = 1.5 }, "spread is a share" },
    { { temperature = { low = 80, high = -20 } }, "low below high" },
    { { bend = { rule = "DIN 1" } }, "there is no rule 'DIN 1'" },
    { { bend = { use = "fixed" } }, "neither a rule nor a multiple" },
    { { bend = { fixd = 4 } }, "did you mean 'fixed'?" },
    { { bend = { fixed = -4 } }, "fixed must be a multiple" },
    { { bend = { movement = 4 } }, "no multiple for its use 'fixed'" },
    { { construction = { strands = 19 } }, "strand_diameter" },
    { { construction = { strands = 1.5 } }, "whole number" },
    { { construction = { strands = 190, strand_diameter = 0.286e-3, conductor = "copper",
      insulation = "XLPE" } }, "thicker than outer_diameter" },
    { { construction = { strands = 19, strand_diameter = 0.286e-3, conductor = "PVC",
      insulation = "XLPE" } }, "conductor must be a metal, not PVC" },
    { { construction = strands, flag = "guessed", EI = 5e-2, GJ = 5e-2 },
      "EI = 0.05 N m2 is outside the bounds of its construction" },
    { { construction = strands, mass_per_length = 0.05 }, "does not fit its construction" },
  }
  for i, case in ipairs(refused) do
    it(("refuses, case %d: %s"):format(i, case[2]), function()
      local d = own(case[1])
      refuses(function() sw.cable.define(d) end, case[2])
      refuses(function() sw.cable.define(d) end, "cable '" .. d.name)
      refuses(function() local _ = sw.cable(d.name) end, "there is no cable")
    end)
  end

  it("refuses a definition without a name", function()
    refuses(function() sw.cable.define(own { name = "none" }) end, "name is missing")
    refuses(function() sw.cable.define "GXL" end, "takes one table")
  end)
end)

-- Sag of 1 m of cable between pins 0.95 m apart [m].
local function sag(args)
  local scene = sw.scene {}
  args.from, args.to, args.segments = { 0, 0, 0 }, { 1, 0, 0 }, 60
  local wire = scene:wire(args)
  scene:pin(wire, { s = 0 })
  local right = scene:pin(wire, { s = 1 })
  for i = 1, 10 do
    right:pose { 1 - 0.05 * i / 10, 0, 0 }
    local rest = scene:settle()
    assert.is_true(rest.ok, rest.reason)
  end
  return -wire:position(0.5)[3]
end

-- Droop of a cantilever of 0.3 m [m].
local function droop(args)
  local scene = sw.scene {}
  args.from, args.to = { 0, 0, 0 }, { 0.3, 0, 0 }
  local wire = scene:wire(args)
  scene:clamp(wire, { s = 0 })
  local rest = scene:settle()
  assert.is_true(rest.ok, rest.reason)
  return -wire:position(0.3)[3]
end

describe("scene:wire{ cable = }", function()
  it("takes the entry's section; explicit parameters override it", function()
    local scene, e = sw.scene {}, sw.cable "GXL 1.5"
    local line = { from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local function wire(more)
      for key, value in pairs(line) do more[key] = value end
      return scene:wire(more)
    end
    local w = wire { cable = "GXL 1.5" }
    for _, key in ipairs { "EA", "EI", "GJ", "mass_per_length" } do
      assert.are.equal(e[key].value, w.beam[key])
    end
    near(0.0015, w.radius, 1e-12)
    assert.are.equal(e, w:cable())
    w = wire { cable = e, EI = 2e-3, radius = 0.002, stiffness = "stick" }
    assert.are.equal(2e-3, w.beam.EI)
    assert.are.equal(e.GJ.stick, w.beam.GJ)
    assert.are.equal(0.002, w.radius)
    near(0.018, w:bend_limit().limit, 1e-12) -- for the wire's own diameter: (4 + 0.5) * 4 mm
    assert.is_nil(wire { radius = 0.001, E = 1e8, density = 1000 }:cable())
  end)

  it("names what is wrong", function()
    local scene = sw.scene {}
    local wrong = {
      { { cable = "GXL 1,5" }, "did you mean 'GXL 1.5'?" },
      { { cabel = "GXL 1.5" }, "did you mean 'cable'?" },
      { { cable = true }, "got boolean" },
      { { cable = "GXL 1.5", stiffness = "stuck" }, "did you mean 'stick'?" },
      { { cable = "identified red", stiffness = "slip" }, "no bound 'slip'; EI is measured" },
      { { cable = "GXL 1.5", use = "pulley" }, "did you mean 'pulleys'?" },
      { { cable = "GXL 1.5", E = 1e9 }, "E describes a solid round wire" },
      { { stiffness = "slip", radius = 1 }, "stiffness goes with cable" },
    }
    for _, case in ipairs(wrong) do
      local args = case[1]
      args.from, args.to = { 0, 0, 0 }, { 1, 0, 0 }
      refuses(function() local _ = scene:wire(args) end, case[2])
    end
  end)

  it("has a sag between those of its two stiffness bounds", function()
    local e = sw.cable "GXL 1.5"
    local slip, stick = sag { cable = e, stiffness = "slip" }, sag { cable = e, stiffness = "stick" }
    local middle = sag { cable = e, EI = math.sqrt(e.EI.slip * e.EI.stick) }
    local usual = sag { cable = e }
    -- the stiffer cable sags more at this length: 137.5 mm and 139.7 mm, the catenary 135.9 mm
    assert.is_true(slip < middle and middle < stick)
    assert.is_true(slip <= usual and usual < stick)
  end)

  it("droops like a beam with its EI", function()
    local e = sw.cable "GXL 1.5"
    -- w L^4 / (8 EI) [m] holds for the stuck strands: 1.0 cm in 0.3 m
    near(e.mass_per_length.value * 9.81 * 0.3 ^ 4 / (8 * e.EI.stick),
      droop { cable = e, stiffness = "stick" }, 0.02)
    assert.is_true(droop { cable = e } > 5 * droop { cable = e, stiffness = "stick" })
  end)

  it("compares the smallest bend radius with the limit", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    -- an arc of radius 20 mm as it lies
    local path = {}
    for i = 0, 300 do path[i + 1] = { 0.02 * math.sin(i / 100), 0.02 * (1 - math.cos(i / 100)), 0 } end
    local wire = scene:wire { cable = "GXL 1.5", path = path, use = "reeling", name = "loop" }
    local now = wire:bend_limit { use = "fixed", now = true }
    near(0.02, now.radius, 0.05)
    near(0.0135, now.limit, 1e-12)
    near(0.012, now.inside, 1e-12)
    assert.is_true(now.ok)
    local run = scene:run { duration = 1e-3 }
    local judged = wire:bend_limit()
    assert.are.equal("reeling", judged.use)
    assert.is_false(judged.ok)
    assert.truthy(tostring(judged):find "NOT kept")
    local label = run:document().summary[1].label
    assert.are.equal("loop: smallest bend radius of the centre line (limit 22.50 mm, reeling, EXCEEDED)",
      label)
    refuses(function() wire:bend_limit { us = 1 } end, "no parameter 'us'")
    refuses(function() wire:bend_limit { use = "x" } end, "there is no use 'x'")
    local bare = scene:wire { E = 1e8, density = 1000, radius = 0.001, from = { 0, 0, 1 }, to = { 1, 0, 1 } }
    refuses(function() bare:bend_limit() end, "not made from a cable")
  end)
end)
