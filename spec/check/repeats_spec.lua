-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fatigue of runs that are repeated: Miner's sum against the count of all runs in sequence, written out.
local sw = require "softworld"
local core = require "softworld.core"
local fatigue = require "softworld.check.fatigue"
local rainflow = require "softworld.check.rainflow"

local curve = { { 1, 1e6 }, { 100, 1 } } -- slope -3: a range of 10 lasts 1000 cycles

-- Miner's sum of a history that is written out as often as it is repeated.
local function written_out(history, times)
  return (rainflow.damage(rainflow.repeated(history, times), curve))
end

-- Same from the record of one run.
local function by_record(history, times)
  local cycles, residue = core.cycles(history)
  return (fatigue.repeated(cycles, residue, { repeats = times }, curve))
end

-- Same from the frames of one run.
local function by_frames(history, times)
  return (fatigue.repeated(rainflow.flat(history), history, { repeats = times }, curve))
end

local function agree(history, share)
  for _, times in ipairs{ 1, 2, 3, 10 } do
    local wanted = written_out(history, times)
    assert.is_near(wanted, by_frames(history, times), 1e-12 * wanted)
    assert.is_near(wanted, by_record(history, times), (share or 1e-12) * wanted)
  end
end

describe("Miner's sum of repeated histories", function()
  -- The sums by hand of the first run and of each further one, as numbers of cycles of the range 10.
  for name, case in pairs{
    ["to 10 and back"] = { { 0, 10, 0 }, 1, 1 },
    ["to 10 and back in small steps"] = { { 0, 3, 7, 10, 9.9, 4, 0, 0 }, 1, 1 },
    ["to 10, to -10 and back"] = { { 0, 10, -10, 0 }, 0.5 * 8 + 1, 8 },
    ["to 10, then back to 0.1"] = { { 0, 10, 0.1 }, 0.5 + 0.5 * 0.99 ^ 3, 1 },
    ["of one rise"] = { { 0, 10 }, 0.5, 1 },
    ["of swings that grow"] = { { 0, 1, -1, 2, -2, 3 }, 0.5 * (1 + 8 + 27 + 64 + 125) / 1000,
      (125 + 27 + 1) / 1000 },
    ["of swings that fall"] = { { 3, -3, 2, -2, 1 }, 0.5 * (216 + 125 + 64 + 27) / 1000, (216 + 64) / 1000 },
  } do
    local history, first, each = table.unpack(case)
    it("is that of the runs in sequence: " .. name, function()
      agree(history)
      assert.is_near(first / 1000, by_record(history, 1), 1e-15)
      assert.is_near(each / 1000, by_record(history, 1000) - by_record(history, 999), 1e-12)
    end)
  end

  it("is that of the runs in sequence: random histories", function()
    local seed = 5
    for try = 1, 200 do
      local history = {}
      for i = 1, 2 + try % 29 do
        seed = (seed * 1103515245 + 12345) % 2 ^ 31
        history[i] = try % 2 == 0 and seed // 65536 % 20 or seed / 2 ^ 27
      end
      agree(history)
    end
  end)

  -- More reversals than the record keeps; the allowance is that of the manual, 2 %.
  for name, of in pairs{
    ["equal swings"] = function(i) return i % 2 end,
    ["a swing that grows"] = function(i) return math.sin(i) * math.exp(0.004 * i) end,
    ["a swing that dies away"] = function(i) return math.sin(i) * math.exp(-0.004 * i) end,
    ["beats with ripples"] = function(i)
      return math.sin(0.37 * i) * (1 + 0.5 * math.sin(0.003 * i)) + 0.2 * math.sin(2.1 * i)
    end,
  } do
    it("is within 2 % of them where there are many: " .. name, function()
      local history = {}
      for i = 1, 900 do history[i] = of(i) end
      agree(history, 0.02)
    end)
  end
end)

describe("run:check of fatigue with repeats", function()
  -- Tension to 10 N and back to a given force [N]; the curve allows 1000 cycles of 10 N.
  local function share(last, wear, repeats)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.03,
      radius = 0.002, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 10 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 1 }):follow{ duration = 2,
      points = { { 1, 0, 0 }, { 1 + 1e-3, 0, 0 }, { 1 + last / 1e4, 0, 0 } } }
    local run = scene:run{ duration = 2, dt = 0.05, quasistatic = true, wear = wear, frame = 0.05 }
    return run:check{ use = "movement", limits = { fatigue = 1 },
      fatigue = { curve = curve, repeats = repeats, source = "this spec" } }:row "w.fatigue".value
  end

  for name, wear in pairs{ steps = true, frames = false } do
    it("counts one cycle for each run that ends where it began: " .. name, function()
      for _, times in ipairs{ 1, 2, 1000 } do
        assert.is_near(times / 1000, share(0, wear, times), 1e-5 * times)
      end
      -- from 0.1 N it goes on to 0, where the next run begins; only the last fall is shorter
      assert.is_near((999.5 + 0.5 * 0.99 ^ 3) / 1000, share(0.1, wear, 1000), 1e-5)
    end)
  end
end)
