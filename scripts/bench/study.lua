-- SPDX-License-Identifier: GPL-3.0-or-later
--- Gain and cost of a study's workers: laying over three walls with one and with two workers, evaluations
-- that compute nothing, a journal of a million lines.
-- @module bench.study
local sealed = require "softworld.sealed"
local sw = require "softworld"

local study = {}

study.aims = { ratio = 1.9, overhead = 0.3e-3, opening = 3, search = 30 } -- [-], [s], [s], [s]

local function build()
  local scene = sw.scene{ name = "laying" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  for i, x in ipairs{ 0.15, 0.45, 0.75 } do
    scene:obstacle{ name = "wall " .. i, shape = "box", size = { 0.01, 1, 0.1 }, at = { x, 0, 0.05 },
      friction = 0.3 }
  end
  local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025, segments = 40,
    from = { 0, 0, 0.0025 }, to = { -1.25, 0, 0.0025 } }
  scene:force{ kind = "damping", on = wire, stiffness = 5e-3 }
  return scene, wire, scene:gripper{ name = "hand", pads = { width = 0.02 } }
end

local function lay(p, scene, wire, hand)
  scene:process(function()
    hand:grasp(wire, { s = 0.03 })
    hand:move{ by = { 0, 0, 0.15 }, speed = p.speed }
    hand:move{ by = { 0.8, 0, 0 }, speed = p.speed }
    hand:release()
  end)
  local run = scene:run{ dt = 0.02, duration = 4.5 }
  assert(run.ok, run.reason)
  return { force = hand.peak_force, bend = wire:min_bend_radius() }
end

-- Returns the time of count evaluations [s].
local function time_of(args, count, workers)
  args.name = "bench"
  local s = sw.study(args)
  local clock = sw.core.clock()
  s:sweep{ count = count, workers = workers }
  return sw.core.clock() - clock
end

--- Returns the shortest times of count layings with one and with two workers, measured alternately [s], and
-- the evaluations per minute with two.
function study.laying(times, count)
  local one, two = math.huge, math.huge
  local args = { parameters = { speed = { 0.2, 0.3, unit = "m/s" } }, setup = build, evaluate = lay }
  for _ = 1, times do
    one, two = math.min(one, time_of(args, count, 1)), math.min(two, time_of(args, count, 2))
  end
  return one, two, 60 * count / two
end

-- Evaluates how soon the wire is laid if the hand moves at these speeds; 5 % of the runs fail at random.
local function hurry(p, scene, wire, hand)
  if p.random() < 0.05 then p.give_up "by chance" end
  scene:process(function()
    hand:grasp(wire, { s = 0.03 })
    hand:move{ by = { 0, 0, p.height }, speed = p.up }
    hand:move{ by = { 0.8, 0, 0 }, speed = p.along }
    hand:release()
  end)
  local run = scene:run{ dt = 0.02, duration = p.height / p.up + 0.8 / p.along + 0.3 }
  assert(run.ok, run.reason)
  return { time = p.height / p.up + 0.8 / p.along, force = hand.peak_force }
end

--- Runs CMA-ES on three parameters of a laying with one constraint; returns the time [s] and the result.
function study.search()
  local s = sw.study{ name = "bench", setup = build, evaluate = hurry,
    parameters = { height = { 0.11, 0.3, unit = "m" }, up = { 0.05, 0.5, unit = "m/s", log = true },
      along = { 0.1, 1, unit = "m/s", log = true } },
    constraints = { force = { max = 0.25, unit = "N" } } }
  local clock = sw.core.clock()
  local found = s:minimise("time", { method = "cma-es" })
  return sw.core.clock() - clock, found
end

--- Returns the shortest time of an evaluation that computes nothing, with a journal [s].
function study.overhead(times, count)
  local least = math.huge
  for _ = 1, times do
    local path = os.tmpname()
    os.remove(path)
    local args = { parameters = { a = { 0, 1 }, b = { 0, 1 } }, file = path,
      evaluate = function(p) return { sum = p.a + p.b } end }
    least = math.min(least, time_of(args, count, 1) / count)
    os.remove(path)
  end
  return least
end

--- Returns the time to open a journal of count evaluations [s].
function study.opening(count)
  local path = os.tmpname()
  os.remove(path)
  local args = { name = "bench", parameters = { a = { 0, 1 }, b = { 0, 1 } }, file = path, workers = 0,
    evaluate = function(p) return { sum = p.a + p.b } end }
  sw.study(args):sweep{ count = 1000 }
  local file, lines = assert(io.open(path, "a+")), {}
  for line in file:lines() do lines[#lines + 1] = line end
  for k = 1001, count do
    local body = lines[4 + k % 1000]:sub(1, -18):gsub("^e 1 %d+", "e 1 " .. k)
    file:write(("%s %016x\n"):format(body, sw.core.checksum(body)))
  end
  file:close()
  local clock = sw.core.clock()
  local s = sw.study(args)
  clock = sw.core.clock() - clock
  os.remove(path)
  assert(sealed.fields(s).journal:find(1, count), "the journal was not read")
  return clock
end

return study
