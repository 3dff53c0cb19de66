-- SPDX-License-Identifier: GPL-3.0-or-later
--- A wire between two points at equal height, static. string: pinned ends and no
-- bending stiffness, the exact catenary. rod: clamped level at both ends.
-- Options: ratio = L/span (1.5 or 1.05), model ("string"), gamma (rod: 10, 100, 1000),
-- EI (string, default 0), axial = EA/(w L) (1e6), points of the path (segments).
-- error(): string: largest relative error of sag and end forces [-]; rod: of the sag.
-- @module softworld.cases.catenary
local sw = require "softworld"
local frame = require "softworld.cases.frame"
local wires = require "softworld.cases.wire"

-- Catenary, closed form: L/span, sag/L, H/(w L), end tension/(w L).
local strings = {
  { 1.05, 0.1326706729, 0.8758472667, 1.00851794 },
  { 1.5, 0.3350888411, 0.2054909798, 0.5405798209 },
}
-- Heavy inextensible elastica with level clamps, boundary-value solver, error 1e-9:
-- L/span, gamma, sag/L, H/(w L), clamp moment M0 L/EI.
local rods = {
  { 1.05, 10, 0.137197352, -3.348485861, -3.128883177 },
  { 1.05, 100, 0.1376655073, 0.30120686, -5.631296552 },
  { 1.05, 1000, 0.134729842, 0.7361901663, -16.47078916 },
  { 1.5, 10, 0.327511754, -4.578828787, -8.120543683 },
  { 1.5, 100, 0.3304012418, -0.2989278312, -10.84165933 },
  { 1.5, 1000, 0.334817289, 0.1291847389, -26.52393217 },
}

local function find(rows, ratio, gamma)
  for _, row in ipairs(rows) do
    if math.abs(row[1] - ratio) < 1e-9 and (not gamma or row[2] == gamma) then return row end
  end
end

-- Returns half of L/(2 a): sinh(u)/u = 1/span for a chain of length 1.
local function parameter(span)
  local u = 1
  for _ = 1, 60 do
    local s, c = (math.exp(u) - math.exp(-u)) / 2, (math.exp(u) + math.exp(-u)) / 2
    u = u - (s - u / span) / (c - 1 / span)
  end
  return u
end

return function(options)
  local f = frame.new(options)
  local model = options.model or "string"
  local rod = model ~= "string"
  local ratio, gamma = options.ratio or 1.5, options.gamma or 100
  local row = find(rod and rods or strings, ratio, rod and gamma or nil)
  local m, span = 0.05, 1 / ratio
  local w = m * f.g
  local EI = rod and w / gamma or options.EI or 0
  local p = { EA = (options.axial or 1e6) * w, EI = EI, GJ = math.max(EI, 1e-9), radius = 0.001,
    mass_per_length = m, segments = options.segments or 50, model = model }
  local scene = sw.scene{ name = "catenary", gravity = f.gravity }
  local c = { name = "catenary", scene = scene, frame = f, parameters = p, weight = w, span = span,
    exact = row and (rod and { sag = row[3], H = row[4] * w, M0 = row[5] * EI,
      source = "boundary-value solution of the heavy elastica, error 1e-9" } or
      { sag = row[2], H = row[3] * w, T = row[4] * w, source = "catenary, closed form" }) }
  local points = options.points or p.segments
  if rod then
    p.path = wires.arch(f, points, span, function(u) return -math.sin(2 * math.pi * u) end)
    c.wire = scene:wire(p)
    local level = f.vector(1, 0, 0)
    c.left = scene:clamp(c.wire, { s = 0, direction = level })
    c.right = scene:clamp(c.wire, { s = c.wire.length, direction = level })
  else
    local a = span / (2 * parameter(span)) -- H/w
    p.path = wires.arch(f, points, span, function(u) return math.atan((u - 0.5) / a) end)
    c.wire = scene:wire(p)
    c.left, c.right = scene:pin(c.wire, { s = 0 }), scene:pin(c.wire, { s = c.wire.length })
  end
  c.clamp = c.left

  function c.run(o) return scene:settle(o or {}) end

  function c.measured()
    local middle = f.local_point(c.wire:position(c.wire.length / 2))
    local F = f.local_vector(c.left:force())
    return { sag = -middle[3], H = -F[1], V = F[3], T = (F[1] ^ 2 + F[3] ^ 2) ^ 0.5,
      M0 = f.local_vector(c.left:moment())[2] }
  end

  function c.error()
    local n, e = c.measured(), c.exact
    local sag = math.abs(n.sag / e.sag - 1)
    if rod then return sag end
    return math.max(sag, math.abs(n.H / e.H - 1), math.abs(n.T / e.T - 1))
  end
  return c
end
