-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire for specs of joins.
local EA, EI, MASS = 1e5, 1e-3, 0.02

local function wire(s, a, b, segments, more)
  local args = { EA = EA, EI = EI, GJ = 1e-3, mass_per_length = MASS, radius = 1e-3, from = a, to = b,
    segments = segments }
  for k, v in pairs(more or {}) do args[k] = v end
  return s:wire(args)
end

return { wire = wire }
