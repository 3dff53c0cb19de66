-- SPDX-License-Identifier: GPL-3.0-or-later
-- Does a process pass its checks, and what must be changed? A cable is bent back by 180 degrees to its plug.
-- The first free length is too short, so the report fails. A study suggests changes and checks each of
-- them with a run. The script applies the smallest change with which all checks pass.
--
--   softworld examples/24_check.lua             prints both reports and their differences
--   softworld examples/24_check.lua FOLDER      also writes FOLDER/before.html and FOLDER/after.html
--   softworld --check examples/24_check.lua     exits with 0: the first report is a trial, the second passes
local sw = require "softworld"
local mm = sw.units.mm

-- Moves the end of the free length p.free so that it bends to an arc of shrinking radius, in p.duration.
local function turn_back(p)
  local scene = sw.scene { name = ("turn back with %.1f mm"):format(1e3 * p.free), gravity = { 0, 0, 0 } }
  local cable = scene:wire { name = "cable", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { p.free, 0, 0 } }
  scene:clamp(cable, { s = 0 })
  scene:force { kind = "damping", mass = 20 }
  local plug = scene:clamp(cable, { name = "plug", s = p.free })
  plug:follow { duration = p.duration, func = function(t)
    local angle = math.max(1e-6, math.pi * (1 - math.cos(math.pi * t / p.duration)) / 2)
    local R = p.free / angle
    return { R * math.sin(angle), 0, R * (1 - math.cos(angle)) }, { axis = { 0, 1, 0 }, angle = -angle }
  end }
  scene:process(function(process)
    process:step("turn", function() process:wait(p.duration) end)
    process:step("hold", function() process:wait(0.5) end)
  end)
  return scene:run { dt = 0.005 }
end

-- Your own check, for a limit of the plug's maker: returns value, place and time of the largest moment.
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

local function judge(p, trial)
  return turn_back(p):check { use = "movement", limits = { cycle_time = 3 }, checks = { moment },
    trial = trial }
end

-- The parameters that may be changed, with their ranges; start is the present value.
local study = sw.study { name = "turn back", evaluate = judge, parameters = {
  free = { mm(20), mm(80), start = mm(40), unit = "m" }, duration = { 1, 4, start = 2, unit = "s" } } }

local before = judge({ free = mm(40), duration = 2 }, true)
local change = study:change()
local after = judge(change.parameters)
for _, one in ipairs { before, change, after, sw.compare(before, after) } do print(tostring(one) .. "\n") end

if arg and arg[1] then
  before:report(arg[1] .. "/before.html", { change = change })
  after:report(arg[1] .. "/after.html")
end
