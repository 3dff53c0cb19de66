-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rows with independent reference values for the specs of error bars. A set is one
-- scene: { name, make(segments) -> case, rows [, duration and options of a run] }, rows a
-- list of { name, unit, scale, exact, of [, at] }; see the cases for the sources.
local cases = require "softworld.cases"
local core = require "softworld.core"

local sets = {}
local stiff = 1e9 -- EA L^2/EI of wires whose reference does not stretch

local function settle_set(name, make)
  sets[#sets + 1] = { name = name, static = true, make = make }
end

for _, row in ipairs(cases.droop{}.all) do
  settle_set(("droop %g"):format(row[1]), function(segments)
    local c = cases.droop{ gamma = row[1], segments = segments, axial = stiff }
    return c, {
      { name = "tip", unit = "m", scale = 1, exact = { row[2], 0, row[3] },
        of = function() return c.wire:position(1) end },
      { name = "moment", unit = "N m", scale = c.exact.M0, exact = c.exact.M0,
        of = function() return c.clamp:moment()[2] * -1 end },
    }
  end)
end

for _, row in ipairs(cases.end_load{}.all) do
  settle_set(("end load %g"):format(row[1]), function(segments)
    local c = cases.end_load{ load = row[1], segments = segments, axial = stiff }
    return c, {
      { name = "tip", unit = "m", scale = 1, exact = { row[2], 0, row[3] },
        of = function() return c.wire:position(1) end },
      { name = "angle", unit = "rad", scale = 1, exact = c.exact.angle,
        of = function() return c.measured().angle end },
    }
  end)
end

-- Quarter circles clamped level, EI = 1: nu, weight, tip, moment at the clamp; shooting
-- with quaternions, error 1e-10.
local arcs = {
  { 0, 1, { 0.6319805182, 0.6314779257, -0.1077217854 }, { -0.2294822182, 0.4034618722 } },
  { 0, 5, { 0.5526037988, 0.5442878988, -0.4427589746 }, { -0.9883727488, 1.857608424 } },
  { 0, 20, { 0.3134018081, 0.2903053724, -0.7818443273 }, { -1.998056717, 5.223173599 } },
  { 0, 80, { 0.1471340051, 0.1160624307, -0.9128043087 }, { -2.410363908, 11.8422479 } },
  { 0.5, 1, { 0.6306467848, 0.6300348615, -0.1205999166 }, { -0.2290913181, 0.4030826035 } },
  { 0.5, 5, { 0.535032018, 0.5261269979, -0.4759766673 }, { -0.96507845, 1.833767175 } },
  { 0.5, 20, { 0.2860995674, 0.2683067407, -0.7904529915 }, { -1.91562707, 5.110154504 } },
  { 0.5, 80, { 0.134765855, 0.1104795508, -0.9124615522 }, { -2.367087255, 11.72984208 } },
}
for _, row in ipairs(arcs) do
  settle_set(("arc %g %g"):format(row[1], row[2]), function(segments)
    local path = {}
    for i = 0, 6144 do -- halved evenly by all meshes
      local u = math.pi / 2 * i / 6144
      path[i + 1] = { 2 / math.pi * math.sin(u), 2 / math.pi * (1 - math.cos(u)), 0 }
    end
    local scene = core.scene{ gravity = { 0, 0, -1 } }
    local wire = scene:wire{ EA = 1e7, EI = 1, GJ = 1 / (1 + row[1]), mass_per_length = row[2],
      radius = 0.001, path = path, segments = segments, rest = "path" }
    local clamp = scene:clamp(wire, { s = 0, direction = { 1, 0, 0 } })
    return { scene = scene, wire = wire }, {
      { name = "tip", unit = "m", scale = 1, exact = row[3],
        of = function() return wire:position(wire.length) end },
      { name = "moment", unit = "N m", scale = row[4][2], exact = { -row[4][1], -row[4][2] },
        of = function()
          local m = clamp:moment()
          return { m[1], m[2] }
        end },
    }
  end)
end

for _, ratio in ipairs{ 1.05, 1.5 } do
  for _, gamma in ipairs{ 10, 100, 1000 } do
    settle_set(("stiff catenary %g %g"):format(ratio, gamma), function(segments)
      local c = cases.catenary{ model = "rod", ratio = ratio, gamma = gamma, segments = segments,
        points = 2000, axial = 1e7 }
      return c, {
        { name = "sag", unit = "m", scale = 1, exact = c.exact.sag,
          of = function() return c.measured().sag end },
        { name = "H", unit = "N", scale = c.weight, exact = c.exact.H,
          of = function() return c.measured().H end },
        { name = "M0", unit = "N m", scale = math.abs(c.exact.M0), exact = c.exact.M0,
          of = function() return c.measured().M0 end },
      }
    end)
  end
  settle_set(("catenary %g"):format(ratio), function(segments)
    local c = cases.catenary{ ratio = ratio, segments = segments, points = 2000, axial = 1e7 }
    return c, {
      { name = "sag", unit = "m", scale = 1, exact = c.exact.sag,
        of = function() return c.measured().sag end },
      { name = "H", unit = "N", scale = c.weight, exact = c.exact.H,
        of = function() return c.measured().H end },
    }
  end)
end

for _, ends in ipairs{ "pinned", "clamped" } do
  for _, d in ipairs{ 0.01, 0.05, 0.2 } do
    settle_set(("column %s %g"):format(ends, d), function(segments)
      local c = cases.column{ ends = ends, d = d, segments = segments, points = 2000, axial = stiff }
      return c, {
        { name = "P", unit = "N", scale = c.exact.P, exact = c.exact.P,
          of = function() return c.measured().P end },
        { name = "w", unit = "m", scale = 1, exact = c.exact.w,
          of = function() return c.measured().w end },
      }
    end)
  end
end

-- Clamped ends brought together by d, then turned by R degrees: axial force and torque, EI = 1; shooting,
-- error 1e-7. They are brought into place on the first mesh, before error bars are asked for.
local turned = { { 2 / 3, 0.1, 90, -40.44877829, 0.9282219291 },
  { 2 / 3, 0.1, 180, -37.39582745, 1.87872062 },
  { 2 / 3, 0.1, 360, -27.67369354, 3.851265222 }, { 2 / 3, 0.1, 540, -15.27872242, 5.877583277 },
  { 1, 0.3, 90, -42.70384794, 0.6423256277 }, { 1, 0.3, 180, -34.369798, 1.694956009 },
  { 1, 0.3, 270, -24.37647544, 2.974579951 }, { 1, 0.3, 360, -13.46239318, 4.352855371 } }
for _, rest in ipairs{ "straight", "path" } do -- without and with frames
  for _, row in ipairs(turned) do
    settle_set(("turned %g %g %s"):format(row[2], row[3], rest), function(segments)
      local scene = core.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e7, EI = 1, GJ = row[1], mass_per_length = 1, radius = 0.001,
        from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = segments, rest = rest }
      local left, right = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = 1 })
      local side = scene:force{ kind = "line", on = wire, force = { 0, 0.5, 0 } }
      for angle = 0, row[3], 15 do
        right:pose({ 1 - row[2], 0, 0 }, { axis = { 1, 0, 0 }, angle = math.rad(angle) })
        assert(scene:settle().ok)
        if angle == 0 then side:release() end
      end
      return { scene = scene, wire = wire }, {
        { name = "T", unit = "N", scale = 39.5, exact = row[4], of = function() return -left:force()[1] end },
        { name = "M", unit = "N m", scale = 4, exact = row[5],
          of = function() return wire:twist_moment(0.5) end },
      }
    end)
  end
end

local function lift_rows(c, hold)
  local rows = { { name = "P", unit = "N", scale = c.exact.P, exact = c.exact.P,
    of = function() return c.measured().P end } }
  if hold == "horizontal" then
    rows[2] = { name = "M", unit = "N m", scale = math.abs(c.exact.M), exact = math.abs(c.exact.M),
      of = function() return math.abs(c.measured().M) end }
  end
  return rows
end

for _, hold in ipairs{ "pinned", "horizontal" } do
  for _, h in ipairs{ 0.1, 0.5, 2, 8 } do
    settle_set(("lift %s %g"):format(hold, h), function(segments)
      local c = cases.lift{ hold = hold, h = h, segments = segments, axial = 1e10,
        total = math.max(6, 1.6 * h + 4) }
      assert(c.run().ok) -- raised to its height, on the first mesh
      return c, lift_rows(c, hold)
    end)
    if h <= 2 then -- and raised pose by pose on every level
      sets[#sets + 1] = { name = ("slow lift %s %g"):format(hold, h), duration = 1, options =
        { quasistatic = true, dt = 0.1 }, make = function(segments)
        local c = cases.lift{ hold = hold, h = h, segments = segments, axial = 1e8,
          total = math.max(6, 1.6 * h + 4) }
        c.clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, c.h } }, duration = 1, relative = true }
        return c, lift_rows(c, hold)
      end }
    end
  end
end

-- Runs: the tip at several times.
local function run_set(name, duration, make)
  sets[#sets + 1] = { name = name, duration = duration, make = make }
end

local function tips(rows, from, scale, read)
  local list = {}
  for i, row in ipairs(rows) do
    if row[1] >= from then
      list[#list + 1] = { name = ("tip %g s"):format(row[1]), unit = "m", scale = scale, at = row[1],
        exact = { row[2], 0, row[3] }, of = read, number = i }
    end
  end
  return list
end

for _, gamma in ipairs{ 10, 100 } do
  run_set(("release %g"):format(gamma), 1, function(segments)
    local c = cases.release{ gamma = gamma, segments = segments }
    return c, tips(c.exact, 0.1, 1, function() return c.wire:position(1) end)
  end)
end

run_set("transport", 2, function(segments)
  local c = cases.transport{ segments = segments }
  assert(c.scene:settle().ok)
  c.clamp:follow{ points = { { 0, 0, 0 }, { 0.5, 0, 0 } }, times = { 0, 1 }, law = "minimum-jerk" }
  return c, tips(c.exact, 0.3, 0.5, function() return c.wire:position(c.wire.length) end)
end)

return sets
