-- SPDX-License-Identifier: GPL-3.0-or-later
-- Does the process pass? A cable is turned back by half a circle towards its plug. The first free length is
-- too short for it: the report fails, says by how much, and the script takes the length that follows.
--
--   softworld examples/24_check.lua           prints both reports
--   softworld --check examples/24_check.lua   exits with 0, since the report that counts passes
local sw = require "softworld"
local mm = sw.units.mm

local duration = 2 -- of turning [s]

-- The free length bends to an arc of ever smaller radius while its end is taken round.
local function turn_back(free)
  local scene = sw.scene { name = ("turn back with %.1f mm"):format(1e3 * free), gravity = { 0, 0, 0 } }
  local cable = scene:wire { name = "cable", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { free, 0, 0 } }
  scene:clamp(cable, { s = 0 })
  scene:force { kind = "damping", mass = 20 }
  local plug = scene:clamp(cable, { name = "plug", s = free })
  plug:follow { duration = duration, func = function(t)
    local angle = math.max(1e-6, math.pi * (1 - math.cos(math.pi * t / duration)) / 2)
    local R = free / angle
    return { R * math.sin(angle), 0, R * (1 - math.cos(angle)) }, { axis = { 0, 1, 0 }, angle = -angle }
  end }
  scene:process(function(p)
    p:step("turn", function() p:wait(duration) end)
    p:step("hold", function() p:wait(0.5) end)
  end)
  local run = scene:run { dt = 0.005 }
  assert(run.ok, run.reason)
  return run
end

-- A limit of the plug's maker, as a check of one's own.
local moment = { name = "moment on the plug", unit = "N m", max = 0.09, source = "drawing of the plug",
  of = function(run)
    local most, time = 0, nil
    local series = run:series()
    for _, column in ipairs(series.columns) do
      for i, value in ipairs(column.name == "plug.moment" and column.values or {}) do
        if value > most then most, time = value, series.time[i] end
      end
    end
    return most, nil, time
  end }

local function judge(run, trial)
  return run:check { use = "movement", limits = { cycle_time = 3 }, checks = { moment }, trial = trial }
end

local free = mm(40)
local check = judge(turn_back(free), true)
print(check)

-- Half a circle: the radius is the free length over pi. 2 % are for what the arc swings.
local lacks = -check:row "min_bend_radius".margin
free = 1.02 * (free + math.pi * lacks)
print(("\nthe radius lacks %.2f mm: take %.1f mm of free cable\n"):format(1e3 * lacks, 1e3 * free))
print(judge(turn_back(free)))
