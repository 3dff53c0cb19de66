-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire bent to one curvature all along by two clamps. Every hinge then carries the same moment, whatever
-- the mesh.
local sw = require "softworld"
local arc = {}

arc.L, arc.EI = 0.5, 0.02

--- A weightless wire along x under two clamps. options: N, force (arguments).
function arc.new(options)
  local bent = setmetatable({ N = options.N or 12 }, { __index = arc })
  bent.scene = sw.scene{ gravity = { 0, 0, 0 } }
  bent.wire = bent.scene:wire{ EA = 1e4, EI = arc.EI, mass_per_length = 0.05, radius = 0.002,
    from = { 0, 0, 0 }, to = { arc.L, 0, 0 }, segments = bent.N }
  local args = { on = bent.wire }
  for key, value in pairs(options.force or {}) do args[key] = value end
  bent.force = options.force and bent.scene:force(args)
  bent.first = bent.scene:clamp(bent.wire, { s = 0 })
  bent.last = bent.scene:clamp(bent.wire, { s = arc.L })
  return bent
end

-- Hinge lengths: 5/12 and 13/12 of an edge next to the clamps, see csrc/state/plan.c.
local function hinge_lengths(N)
  local l, w = arc.L / N, {}
  for i = 0, N do w[i] = l end
  w[0], w[N], w[1], w[N - 1] = 5 / 12 * l, 5 / 12 * l, 13 / 12 * l, 13 / 12 * l
  return w, l
end

--- Bends the wire to the curvature [1/m] in the plane of x and {0, cos a, sin a}, and settles. The polygon
-- of that curvature needs no force except the moment.
function arc:bend(kappa, a)
  a = a or math.pi / 2
  local w, l = hinge_lengths(self.N)
  local turn, along, across = 0, 0, 0
  for i = 0, self.N - 1 do
    turn = turn + kappa * w[i]
    along, across = along + l * math.cos(turn), across + l * math.sin(turn)
  end
  self.last:pose({ along, across * math.cos(a), across * math.sin(a) },
    { axis = { 0, -math.sin(a), math.cos(a) }, angle = kappa * arc.L })
  local rest = self.scene:settle{ tolerance = 1e-12 }
  assert(rest.ok, rest.reason)
  return self
end

--- Bends to the curvature in steps, from the present one (0 at first). Calls visit(kappa, moment) after
-- each.
function arc:sweep(kappa, steps, visit, a)
  local from = self.kappa or 0
  for i = 1, steps do
    self.kappa = from + (kappa - from) * i / steps
    self:bend(self.kappa, a)
    if visit then visit(self.kappa, self:moment()) end
  end
  return self
end

--- Returns the moment [N m] with which the wire resists: in the plane of z, then of y.
function arc:moment()
  local m = self.first:moment{}
  return m[2], -m[3]
end

return arc
