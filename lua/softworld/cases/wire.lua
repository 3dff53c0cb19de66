-- SPDX-License-Identifier: GPL-3.0-or-later
--- The wire most cases use: 1 m of round solid wire, radius 2.5 mm, 1500 kg/m3,
-- whose modulus follows from gamma = weight per length * length^3 / EI.
-- @module softworld.cases.wire
local wire = {}

local pi = math.pi

--- Returns parameters for scene:wire, without from and to. options: gamma, g, length,
-- radius, density, segments, model; axial: EA L^2 / EI (default: that of a solid
-- round section, 4 L^2 / r^2).
function wire.parameters(options)
  local L, r, rho = options.length or 1, options.radius or 0.0025, options.density or 1500
  local m = rho * pi * r * r
  local EI = options.EI or m * options.g * L ^ 3 / options.gamma
  local axial = options.axial or 4 * (L / r) ^ 2
  return { EA = axial * EI / L ^ 2, EI = EI, GJ = EI / 1.35, mass_per_length = m, radius = r,
    segments = options.segments or 50, model = options.model, section = options.section }
end

--- Adds a straight wire between two points of the case's axes.
function wire.straight(scene, frame, p, from, to)
  p.from, p.to = frame.point(from[1], from[2], from[3]), frame.point(to[1], to[2], to[3])
  return scene:wire(p)
end

--- Returns points of an inextensible curve of length 1 in the x-z plane from (0, 0, 0) to
-- (span, 0, 0) whose slope is a multiple of shape(u), u = s/L, found by bisection.
function wire.arch(frame, segments, span, shape)
  local low, high = 0, 2.5
  local function width(size)
    local x = 0
    for i = 1, segments do x = x + math.cos(size * shape((i - 0.5) / segments)) / segments end
    return x
  end
  for _ = 1, 60 do
    local middle = (low + high) / 2
    if width(middle) > span then low = middle else high = middle end
  end
  local x, z, points = 0, 0, { frame.point(0, 0, 0) }
  for i = 1, segments do
    local slope = low * shape((i - 0.5) / segments)
    x, z = x + math.cos(slope) / segments, z + math.sin(slope) / segments
    points[i + 1] = frame.point(x, 0, z)
  end
  return points
end

--- Returns the row that starts with key, or nil.
function wire.row(rows, key)
  for _, row in ipairs(rows) do
    if math.abs(row[1] - key) <= 1e-6 * math.abs(key) then return row end
  end
end

--- Runs a scene in pieces that end at the given times; returns one report.
function wire.sampled(scene, times, options, sample)
  local total = { ok = true, reason = "", steps = 0, rejected = 0, iterations = 0,
    evaluations = 0, wall = 0, cpu = 0, smallest_dt = math.huge }
  local o = {}
  for k, v in pairs(options or {}) do o[k] = v end
  o.frame = o.frame or 1e9
  local start = scene.time
  for _, t in ipairs(times) do
    o.duration = start + t - scene.time
    local part = scene:run(o)
    for _, key in ipairs{ "steps", "rejected", "iterations", "evaluations", "wall", "cpu" } do
      total[key] = total[key] + part[key]
    end
    total.smallest_dt = math.min(total.smallest_dt, part.smallest_dt)
    total.ok, total.reason, total.time = part.ok, part.reason, part.time
    if not part.ok then break end
    sample(t)
  end
  return total
end

--- Returns the distance of a sample's tip from its row, see wire.compared [m].
function wire.off(sample)
  local p, row = sample.tip, sample.row
  return ((p[1] - row[2]) ^ 2 + p[2] ^ 2 + (p[3] - row[3]) ^ 2) ^ 0.5
end

--- Lets a case compare its wire's tip with rows { t, x, z } 0.05 s apart, each `every` seconds (0.1 s): adds
-- samples and largest(t) to the case, and returns the run that fills them.
function wire.compared(case, rows, every)
  local stride = math.floor((every or 0.1) / 0.05 + 0.5)
  case.samples = {}

  function case.largest(t)
    local most = 0
    for _, sample in ipairs(case.samples) do
      if sample.row[1] <= t + 1e-9 then most = math.max(most, wire.off(sample)) end
    end
    return most
  end

  return function(o)
    local times, k = {}, 1
    for i = 1 + stride, #rows, stride do times[#times + 1] = rows[i][1] end
    return wire.sampled(case.scene, times, o, function()
      k = k + stride
      case.samples[#case.samples + 1] =
        { row = rows[k], tip = case.frame.local_point(case.wire:position(case.wire.length)) }
    end)
  end
end

return wire
