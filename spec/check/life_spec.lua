-- SPDX-License-Identifier: GPL-3.0-or-later
-- S-N curves where the script gives none: those of the cable, otherwise those of its copper strands by the
-- method of universal slopes, range of strain = 3.5 (Su / E) N^-0.12 + D^0.6 N^-0.6, here Su = 220 MPa, E =
-- 115 GPa, D = 1.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local bent = require "spec.check.bent"
local lifecurve = require "softworld.wire.lifecurve"
local rainflow = require "softworld.check.rainflow"

local R = 0.05
local STRAND, STRANDS = 0.286e-3, 19       -- of GXL 1.5 [m], [-]
local BUNCH = STRAND * math.sqrt(19 / 0.75) -- diameter of its conductor [m]

local function strain(n, elastic) return (elastic or 3.5 * 220 / 115e3) * n ^ -0.12 + n ^ -0.6 end

-- Number of cycles that the strands endure at a range of strain, by bisection.
local function life(range, elastic)
  local low, high = -3, 30
  for _ = 1, 80 do
    local middle = (low + high) / 2
    if strain(10 ^ middle, elastic) > range then low = middle else high = middle end
  end
  return 10 ^ low
end

-- From straight to 1/R, -1/R and back: half a cycle of 2/R and two halves of 1/R.
local function wave(t) return math.sin(math.pi * t / 2) / R end
local function miner(of) return 0.5 / of(2 / R) + 1 / of(1 / R) end

local FREE = { mass_per_length = 0.02, EA = 1e4, EI = 1e-3, GJ = 1e-3 }
local function run_of(cable)
  local given = { cable = cable }
  for key, value in pairs(FREE) do given[key] = value end
  return (bent(wave, nil, nil, given))
end

local count = 0
local function own_cable(fatigue, more)
  count = count + 1
  local given = { name = "own " .. count, outer_diameter = 0.003, mass_per_length = 0.0193, EA = 1e5,
    EI = 1e-3, GJ = 1e-3, friction = 0.3, temperature = { low = -20, high = 80 },
    bend = { movement = 5, use = "movement" }, fatigue = fatigue, source = "this spec", flag = "guessed",
    spread = 0.1 }
  for key, value in pairs(more or {}) do given[key] = value end
  return sw.cable.define(given)
end

describe("S-N curves of annealed copper", function()
  it("follow the method of universal slopes", function()
    for _, n in ipairs{ 1, 1e3, 1e7 } do assert.is_near(strain(n), lifecurve.strain(n), 1e-12) end
    -- at 1e4 cycles by hand: 0.0066957 x 0.33113 + 0.0039811
    assert.is_near(0.0061982, lifecurve.strain(1e4), 1e-6)
  end)

  -- Points are a quarter of a decade of cycles apart, with straight lines in logarithms between them.
  it("give the life between their points within 1 %", function()
    local known = lifecurve.of(sw.cable "GXL 1.5".construction)
    for _, range in ipairs{ 0.0009, 0.0031, 0.007, 0.019, 0.3 } do
      local found = rainflow.life(known.bending, range / (STRAND / 2))
      assert.is_near(1, found / life(range), 0.01)
      local force = range * 115e9 * STRANDS * math.pi * STRAND ^ 2 / 4
      assert.is_near(1, rainflow.life(known.curve, force) / life(range), 0.01)
    end
  end)

  -- The handbook value of annealed copper, 76 MPa for 1e8 cycles, lies within their spread.
  it("have a spread that covers other literature", function()
    local known = lifecurve.of(sw.cable "GXL 1.5".construction)
    local bend = 2 * 76e6 / 115e9 / (STRAND / 2)
    assert.is_true(rainflow.life(known.high.bending, bend) < 1e8)
    assert.is_true(rainflow.life(known.low.bending, bend) > 1e8)
    assert.is_true(rainflow.life(known.bending, bend) < rainflow.life(known.low.bending, bend))
  end)

  it("exist for copper only, and for every cable whose strands are known", function()
    assert.is_nil(lifecurve.of{ strands = 7, strand_diameter = 3e-4, conductor = "aluminium" })
    for _, name in ipairs(sw.cables()) do
      local entry = sw.cable(name)
      assert.equal(entry.construction ~= nil, entry.fatigue ~= nil, name)
    end
    assert.truthy(tostring(sw.cable "H07V-K 2.5"):find("S-N curves +guessed +literature, not of this cable"))
    assert.is_nil(tostring(sw.cable "identified red"):find("S-N curves", 1, true))
  end)
end)

describe("run:check of fatigue without curves in the script", function()
  local run = run_of "GXL 1.5"

  it("uses the strands' curves, and gives their spread and source", function()
    local row = run:check{ limits = { fatigue = 1 } }:row "fatigue"
    local wanted = miner(function(bend) return life(bend * STRAND / 2) end)
    local most = miner(function(bend) return life(bend * BUNCH / 2) / 5 end)
    local long = 2 * 76e6 / 115e9 * 1e8 ^ 0.12
    local least = miner(function(bend) return 5 * life(bend * STRAND / 2, long) end)
    print(("measured: %.4g, %.4g to %.4g; by hand %.4g, %.4g to %.4g"):format(row.value, row.low, row.high,
      wanted, least, most))
    assert.is_near(1, row.value / wanted, 0.02)
    assert.is_near(1, row.low / least, 0.03)
    assert.is_near(1, row.high / most, 0.02)
    assert.equal("PASS", row.verdict)
    for _, words in ipairs{ "literature, not of this cable", "Manson 1965", "guessed", "0.57 % if they slip",
      ("%.3g to %.3g with the curves' spread"):format(row.low, row.high) } do
      assert.truthy(row.note:find(words, 1, true), row.note)
    end
  end)

  it("is open where its spread covers the limit, and decided elsewhere", function()
    local once = run:check{ fatigue = {} }:row "fatigue"
    for verdict, times in pairs{ PASS = 0.5 / once.high, OPEN = 1 / once.value, FAIL = 2 / once.low } do
      local row = run:check{ fatigue = { repeats = math.max(1, times) } }:row "fatigue"
      assert.equal(verdict, row.verdict)
      assert.equal(1, row.limit)
    end
  end)

  it("prefers the script's curves", function()
    local row = run:check{ fatigue = { bending = { { 1, 1e6 }, { 100, 1 } }, spread = 4 } }:row "fatigue"
    local wanted = miner(function(bend) return 1e6 / bend ^ 3 end)
    assert.is_near(1, row.value / wanted, 0.01)
    assert.same({ row.value / 4, 4 * row.value }, { row.low, row.high })
    assert.is_nil(row.note:find("literature", 1, true), row.note)
    assert.is_nil(run:check{ fatigue = { bending = { { 1, 1e6 }, { 100, 1 } } } }:row "fatigue".high)
  end)

  it("writes the same numbers to files", function()
    local check = run:check{ fatigue = {} }
    local path = os.tmpname()
    local row = check:row "fatigue"
    for _, kind in ipairs{ "csv", "json" } do
      check[kind](check, path)
      local file <close> = assert(io.open(path))
      local seen = {}
      for word in file:read "a":gmatch "[%d.e+-]+" do seen[tonumber(word) or 0] = true end
      for _, x in ipairs{ row.value, row.low, row.high } do
        assert.is_true(seen[x], kind .. " lacks " .. x)
      end
    end
    os.remove(path)
  end)

  -- The page prints numbers with the sign of micro; words that begin with u stay words.
  it("shows its note on the page letter by letter", function()
    local path = os.tmpname() .. ".html"
    local check = run:check{ fatigue = {}, checks = { { name = "tiny", unit = "m", max = 3e-6,
      of = function() return 2e-6 end } } }
    check:report(path)
    local file <close> = assert(io.open(path))
    local text = file:read "a"
    os.remove(path)
    -- the page holds this script too
    for _, words in ipairs{ "2.000", "3.000" } do assert.truthy(text:find(words .. " µm", 1, true), words) end
    for _, words in ipairs{ "p to", "niversal" } do assert.is_nil(text:find("µ" .. words, 1, true), words) end
  end)

  -- The run's own results would show the limit of another use beside that of the check.
  it("is the only place of its page that shows a bend limit", function()
    local path = os.tmpname()
    os.remove(path)
    path = path .. ".html"
    local function shown(object)
      object:report(path)
      local file <close> = assert(io.open(path))
      local text = file:read "a"
      os.remove(path)
      return text:match '"label": ?"[^"]*: smallest bend radius of the centre line([^"]*)"'
    end
    assert.equal("", shown(run:check{ use = "movement", limits = { fatigue = false } }))
    assert.matches("^ %(limit .* fixed", shown(run))
  end)

  it("is open without a record of each step, and says how to record it", function()
    local blind = bent(wave, nil, { wear = false }, { cable = "GXL 1.5" })
    local row = blind:check{ fatigue = {} }:row "fatigue"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("wear = true", 1, true), row.note)
  end)

  it("fails where nothing is known of the strands", function()
    local row = run_of "identified red":check{ fatigue = {} }:row "fatigue"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("the wire's strands are not known", 1, true), row.note)
  end)

  it("records wear by itself when the check is given to the run, and has a bar beside its spread", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.2 }, to = { 0.2, 0, 0.2 },
      segments = 10 }
    scene:clamp(wire, { s = 0 })
    local given = { limits = { fatigue = 1 }, trial = true }
    local row = scene:run{ duration = 0.1, dt = 0.01, check = given }:check():row "fatigue"
    assert.equal("PASS", row.verdict)
    assert.is_true(row.error > 0 and row.low < row.value and row.value + row.error < row.high)
  end)
end)

describe("S-N curves of a cable", function()
  it("take precedence over the literature, with their own spread factor", function()
    local entry = own_cable({ bending = { { 1, 1e6 }, { 100, 1 } }, spread = 3, source = "flex test", flag =
      "measured" }, { construction = { strands = 19, strand_diameter = 2.86e-4, conductor = "copper",
      insulation = "XLPE" } })
    local row = run_of(entry):check{ fatigue = {} }:row "fatigue"
    assert.is_near(1, row.value / miner(function(bend) return 1e6 / bend ^ 3 end), 0.01)
    assert.same({ row.value / 3, 3 * row.value }, { row.low, row.high })
    assert.truthy(row.note:find("S-N curve: flex test, measured", 1, true), row.note)
    assert.truthy(tostring(entry):find("S-N curves +measured +flex test"))
  end)

  for words, fatigue in pairs{ ["fatigue has no curve"] = {},
    ["fatigue has no field 'bendin'"] = { bendin = 1 },
    ["fatigue.curve must be points { range [N], cycles }, got 3"] = { curve = 3 },
    ["fatigue.bending has fewer than 2 points"] = { bending = { { 1, 2 } } },
    ["fatigue.bending[2]: each range must be larger"] = { bending = { { 2, 5 }, { 1, 2 } } },
    ["fatigue: spread is a factor of the life, from 1, got 0.5"] = { bending = { { 1, 5 }, { 2, 2 } },
      spread = 0.5 }, ["there is no flag 'sure'"] = { bending = { { 1, 5 }, { 2, 2 } }, flag = "sure" },
    ["fatigue must be a table"] = 7 } do
    it("are refused: " .. words, function()
      local fine, why = pcall(own_cable, fatigue)
      assert.is_false(fine)
      assert.truthy(why:find(words, 1, true), why)
    end)
  end
end)
