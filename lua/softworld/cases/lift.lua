-- SPDX-License-Identifier: GPL-3.0-or-later
--- Lifting: a long wire lies straight on a frictionless table, and its end is held at
-- height h above its resting height, static. Lengths in l = (EI/w)^(1/3).
-- Options: hold = "pinned" | "horizontal", h in l (0.5; 0.1, 0.5, 2, 8 have exact
-- values), total: length of the wire in l (6), l [m] (0.1), shift: resting position
-- along the wire [segments] (0), steps (4).
-- error(): largest of the relative errors of P and (horizontal) M.
-- @module softworld.cases.lift
local sw = require "softworld"
local frame = require "softworld.cases.frame"

-- Boundary-value solution, error 3e-9: h/l, free length a/l, distance of the
-- lift-off point x_g/l, end force P/(w l), reaction at lift-off N0/(w l), end
-- angle [deg], end moment/(w l^2).
local exact = {
  pinned = {
    { 0.1, 1.247009465, 1.2410333, 0.6251195866, 0.6218898788, 9.205119611, 0 },
    { 0.5, 1.902087586, 1.800900617, 0.9794338014, 0.9226537848, 30.69707522, 0 },
    { 2, 3.231760358, 2.063599455, 2.043660021, 1.188100337, 78.13544382, 0 },
    { 8, 9.202702115, 2.036811921, 8, 1.202702115, 89.99998455, 0 },
  },
  horizontal = {
    { 0.1, 1.639645195, 1.63545641, 1.093796005, 0.5458491901, 0, -0.4472135955 },
    { 0.5, 2.476279738, 2.405800353, 1.66280521, 0.8134745283, 0, -1 },
    { 2, 3.812688043, 2.984621085, 2.700822868, 1.111865175, 0, -2 },
    { 8, 9.41221706, 2.549854396, 8.209515284, 1.202701776, 0, -4 },
  },
}

return function(options)
  local f = frame.new(options)
  local kind, h = options.hold or "pinned", options.h or 0.5
  local row
  for _, r in ipairs(exact[kind]) do if r[1] == h then row = r end end
  local l, n = options.l or 0.1, options.segments or 50
  local L, m, radius = (options.total or 6) * l, 0.03, 0.001
  local w = m * f.g
  local EI = w * l ^ 3
  local shift = (options.shift or 0) * L / n
  local scene = sw.scene{ name = "lift", gravity = f.gravity }
  scene:obstacle{ shape = "plane", friction = 0, at = f.point(0, 0, 0), rotation = f.quaternion }
  -- the lifted end is s = L; a shorter wire moves the mesh against lift-off
  local wire = scene:wire{ EA = (options.axial or 1e7) * EI / L ^ 2, EI = EI, radius = radius,
    mass_per_length = m, from = f.point(shift - L, 0, radius), to = f.point(0, 0, radius),
    segments = n, model = options.model }
  local hold = kind == "pinned" and scene:pin(wire, { s = wire.length })
    or scene:clamp(wire, { s = wire.length })
  local c = { name = "lift", scene = scene, wire = wire, clamp = hold, frame = f, l = l, h = h * l,
    weight = w, EI = EI, segment = wire.length / n, all = exact,
    exact = row and { a = row[2] * l, x_g = row[3] * l, P = row[4] * w * l, N0 = row[5] * w * l,
      angle = math.rad(row[6]), M = row[7] * w * l * l,
      source = "boundary-value solution of the heavy elastica, error 3e-9" } }

  --- Raises the end in steps and settles each. Only the end holds the wire along the table,
  -- so it is raised straight up.
  function c.run(o)
    local steps, total, result = options.steps or 4, 0, nil
    for k = 1, steps do
      hold:pose(f.point(0, 0, radius + c.h * k / steps))
      result = scene:settle(o or {})
      total = total + result.iterations
      if not result.ok then return result end
    end
    result.iterations = total
    return result
  end

  function c.measured()
    local F, M = f.local_vector(hold:force()), f.local_vector(hold:moment())
    local t = f.local_vector(wire:tangent(wire.length))
    local flat, s = wire:positions()
    local lift = 0 -- last node on the table
    for i = 1, #s do
      if f.local_point{ flat[3 * i - 2], flat[3 * i - 1], flat[3 * i] }[3] < radius then lift = i end
    end
    lift = math.max(lift, 1)
    local p = f.local_point{ flat[3 * lift - 2], flat[3 * lift - 1], flat[3 * lift] }
    local e = f.local_point(wire:position(wire.length))
    return { P = F[3], H = F[1], M = M[2], angle = math.atan(t[3], t[1]),
      a = wire.length - s[lift], x_g = e[1] - p[1], depth = radius - p[3] }
  end

  function c.error()
    local n_, e = c.measured(), c.exact
    local worst = math.abs(n_.P / e.P - 1)
    if e.M ~= 0 then worst = math.max(worst, math.abs(math.abs(n_.M / e.M) - 1)) end
    return worst
  end
  return c
end
