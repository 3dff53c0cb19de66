-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire hangs from a clamp that moves sideways by 0.5 m in 1 s and stops: the load
-- swings on, undamped, to 2 s.
-- Options: every: time between samples [s] (0.1; or 0.05).
-- error(): largest distance of the tip from the exact tip over L up to 2 s.
-- largest(t): the same up to t [m].
-- @module softworld.cases.transport
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

local L, r, rho, E = 0.5, 0.002, 1400, 2e7 -- [m], [m], [kg/m3], [Pa]

-- Geometrically exact Hermite elements, 48 against 24, same data, started at the
-- stretched equilibrium; clamp x = d (10 u^3 - 15 u^4 + 6 u^5); error below 5e-5 m,
-- about 4e-6 m: t [s], tip x, tip z [m].
local exact = {
    { 0, 0, -0.5000858375 }, { 0.05, -3.857748509e-07, -0.5000845405 },
    { 0.1, -2.456807674e-05, -0.500037373 }, { 0.15, 0.0004719578444, -0.4997261472 },
    { 0.2, -0.0005835364327, -0.4987079322 }, { 0.25, -0.005597189567, -0.4962790108 },
    { 0.3, -0.01282647717, -0.4906953566 }, { 0.35, -0.01624532814, -0.4806071898 },
    { 0.4, -0.01023078327, -0.4673560437 }, { 0.45, 0.01040057055, -0.4558470079 },
    { 0.5, 0.04783416506, -0.4510554048 }, { 0.55, 0.1013793118, -0.4547085415 },
    { 0.6, 0.1689737208, -0.4651205744 }, { 0.65, 0.2506976352, -0.4796933421 },
    { 0.7, 0.3459112305, -0.4935197085 }, { 0.75, 0.4511804733, -0.4997956635 },
    { 0.8, 0.5597595333, -0.491854571 }, { 0.85, 0.6623412598, -0.4662815332 },
    { 0.9, 0.7467266848, -0.4268701255 }, { 0.95, 0.8062575453, -0.3832714136 },
    { 1, 0.8416420721, -0.345116651 }, { 1.05, 0.8560080211, -0.3205882753 },
    { 1.1, 0.8516970042, -0.3160819033 }, { 1.15, 0.8286461411, -0.337701193 },
    { 1.2, 0.7812528169, -0.3887088057 }, { 1.25, 0.6964737499, -0.4538846071 },
    { 1.3, 0.5746258753, -0.4936173141 }, { 1.35, 0.4520587596, -0.4914100025 },
    { 1.4, 0.3563150135, -0.4727291581 }, { 1.45, 0.2903563578, -0.4510970893 },
    { 1.5, 0.2396773534, -0.4216657789 }, { 1.55, 0.1930692542, -0.3865528584 },
    { 1.6, 0.1583497956, -0.3474651324 }, { 1.65, 0.1507702861, -0.3135852121 },
    { 1.7, 0.169512342, -0.3108987144 }, { 1.75, 0.2058914072, -0.3473165693 },
    { 1.8, 0.2692832195, -0.4181309012 }, { 1.85, 0.3862772394, -0.486436368 },
    { 1.9, 0.5316772277, -0.4850600322 }, { 1.95, 0.6375137607, -0.4551926221 },
    { 2, 0.7042697098, -0.4439854598 },
}

return function(options)
  local f = frame.new(options)
  local area = math.pi * r * r
  local p = { EA = E * area, EI = E * area * r * r / 4, GJ = E * area * r * r / 4 / 1.35,
    mass_per_length = rho * area * 9.81 / f.g, radius = r, segments = options.segments or 50,
    model = options.model }
  local scene = sw.scene{ name = "transport", gravity = f.gravity }
  local wire = wires.straight(scene, f, p, { 0, 0, 0 }, { 0, 0, -L })
  local clamp = scene:clamp(wire, { s = 0 })
  local c = { name = "transport", scene = scene, wire = wire, clamp = clamp, frame = f,
    parameters = p, exact = exact, duration = 2, length = L,
    source = "geometrically exact Hermite elements, error about 4e-6 m" }
  local run = wires.compared(c, exact, options.every)

  --- o: options of scene:run; settle = false leaves out the equilibrium before.
  function c.run(o)
    o = o or {}
    local settled = scene:settle()
    if not settled.ok then return settled end
    clamp:follow{ points = { f.point(0, 0, 0), f.point(0.5, 0, 0) }, times = { 0, 1 },
      law = "minimum-jerk" }
    return run(o)
  end

  function c.error() return c.largest(2) / L end
  return c
end
