-- SPDX-License-Identifier: GPL-3.0-or-later
-- Taut cables drawn over round obstacles of fine facets, as mesh files of cylinders have them. A cable's edge
-- lies on one facet and rocks on its two edges. It left an edge at a tilt of 1/20 of the angle between two
-- facets. If the cable sank in by more than that, there was no balance between both, and the run ended with
-- "no convergence": with 150 facets or more, in steps of 20 to 2.5 ms. Cables whose chords begin inside such
-- a cylinder failed while they came out: their friction stuck and slid on several edges in turn.
local sw = require "softworld"

local R, MU, FREE = 0.03, 0.3, 0.15 -- cylinder [m], friction [-], straight part at each end [m]

-- Text of an OBJ file: a closed cylinder along y with n facets; phase: turn about its axis, in facets.
local function drum(n, phase)
  local text = {}
  for k = 0, 1 do
    for i = 0, n - 1 do
      local a = 2 * math.pi * (i + phase) / n
      text[#text + 1] = ("v %.9g %g %.9g"):format(R * math.cos(a), 0.1 * k - 0.05, R * math.sin(a))
    end
  end
  text[#text + 1] = "v 0 -0.05 0\nv 0 0.05 0"
  for i = 1, n do
    local j = i % n + 1
    text[#text + 1] = ("f %d %d %d\nf %d %d %d"):format(i, i + n, j + n, i, j + n, j)
    text[#text + 1] = ("f %d %d %d\nf %d %d %d"):format(2 * n + 1, i, j, 2 * n + 2, j + n, i + n)
  end
  return table.concat(text, "\n") .. "\n"
end

-- The same of a ring of radius 0.1 m: the cable goes over a row of its corners.
local function ring(n, around)
  local text = {}
  for i = 0, around - 1 do
    for j = 0, n - 1 do
      local a, b = 2 * math.pi * i / around, 2 * math.pi * j / n
      local far = 0.1 + R * math.cos(b)
      text[#text + 1] = ("v %.9g %.9g %.9g"):format(R * math.sin(b), far * math.sin(a),
        -far * math.cos(a) - 0.1)
    end
  end
  local function at(i, j) return (i % around) * n + j % n + 1 end
  for i = 0, around - 1 do
    for j = 0, n - 1 do
      text[#text + 1] = ("f %d %d %d"):format(at(i, j), at(i + 1, j), at(i + 1, j + 1))
      text[#text + 1] = ("f %d %d %d"):format(at(i, j), at(i + 1, j + 1), at(i, j + 1))
    end
  end
  return table.concat(text, "\n") .. "\n"
end

local function obstacle(s, o)
  local text, points = o.around and ring(o.facets, o.around) or drum(o.facets, o.phase or 0), {}
  if not o.hull then
    local plain = os.tmpname()
    local name = plain .. ".obj"
    local file <close> = assert(io.open(name, "w"))
    file:write(text):close()
    s:obstacle{ shape = "mesh", file = name, friction = MU }
    return os.remove(name), os.remove(plain)
  end
  for x, y, z in text:gmatch "v (%S+) (%S+) (%S+)" do
    points[#points + 1], points[#points + 2], points[#points + 3] = tonumber(x), tonumber(y), tonumber(z)
  end
  s:obstacle{ shape = "hull", points = points, friction = MU }
end

-- A way half round the cylinder; off: distance from its corners over the radius [-].
local function way(radius, off)
  local path, top = {}, (1 + off) * (R + radius)
  for k = 30, 1, -1 do path[#path + 1] = { -top, 0, -FREE * k / 30 } end
  for k = 0, 200 do
    local a = math.pi * (1 - k / 200)
    path[#path + 1] = { top * math.cos(a), 0, top * math.sin(a) }
  end
  for k = 1, 30 do path[#path + 1] = { top, 0, -FREE * k / 30 } end
  return path
end

-- Returns the mean pull while the cable slides, over that of an ideal cable of its bending stiffness.
local function drawn(o)
  local s = sw.scene{ gravity = { 0, 0, 0 } }
  local r = sw.scene{}:wire{ cable = o.cable, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 2 }.radius
  obstacle(s, o)
  local w = s:wire{ cable = o.cable, path = way(r, o.off or 0.015), segments = o.segments or 67 }
  if not o.poses then s:force{ kind = "damping", on = w, mass = 5, stiffness = 0.001 } end
  s:force{ kind = "point", on = w, s = 0, force = { 0, 0, -o.pull } }
  local hold = s:pin(w, { s = w.length })
  assert.is_true(s:run{ duration = 0.3, dt = o.dt, frames = false, quasistatic = o.poses }.ok)
  hold:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.04 } }, relative = true, duration = 1 }
  assert.is_true(s:run{ duration = 1, dt = o.dt, frames = false, quasistatic = o.poses }.ok)
  local bends = w.beam.EI / 2 / (R + r) ^ 2 -- tension that turns into bending [N]
  local pull = hold:over(s.time - 0.5, s.time - 0.3).mean_force
  return pull / ((o.pull - bends) * math.exp(MU * math.pi) + bends)
end

local GXL, THIN, THICK = { "GXL 1.5", 20 }, { "FLRY-B 0.5", 8 }, { "H07V-K 4", 60 }

describe("a taut cable over a cylinder of facets", function()
  for _, case in ipairs{
    { GXL, 24, 0.02 }, { GXL, 150, 0.01 }, { GXL, 200, 0.005, phase = 0.5 }, { GXL, 400, 0.02 },
    { THIN, 200, 0.02 }, { THIN, 400, 0.0025, phase = 0.3 }, { THICK, 150, 0.02, phase = 0.7 },
    { THICK, 200, 0.0025 }, { THICK, 400, 0.01, hull = true }, { GXL, 200, 0.01, poses = true },
    { THIN, 100, 0.01, phase = 0.7, off = 0, segments = 40 }, { THIN, 150, 0.01, phase = 0.7, off = 0 },
    { THIN, 200, 0.01, phase = 0.1, off = 0, segments = 40 }, { GXL, 200, 0.01, around = 60 },
  } do
    local cable, facets, dt = case[1], case[2], case[3]
    it(("is drawn as over the exact one: %s, %d facets, %g ms%s"):format(cable[1], facets, 1e3 * dt,
      case.poses and ", poses" or case.hull and ", hull" or case.off and ", from inside" or
      case.around and ", over a row of corners" or ""), function()
      local got = drawn{ cable = cable[1], pull = cable[2], facets = facets, dt = dt, phase = case.phase,
        hull = case.hull, poses = case.poses, off = case.off, segments = case.segments,
        around = case.around }
      print(("measured: %.4f of the ideal pull"):format(got))
      assert.is_true(math.abs(got - 1) < 0.015, got) -- 0.008 measured
    end)
  end
end)
