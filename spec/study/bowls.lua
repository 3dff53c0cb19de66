-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the specs of searches: a bowl in two parameters, and a helper that minimises it.
local sw = require "softworld"

local bowls = {}

bowls.RANGES = { a = { -2, 2 }, b = { -2, 2, start = 1 } }

function bowls.study(parameters, evaluate, constraints, workers)
  return sw.study { name = "s", parameters = parameters, evaluate = evaluate, constraints = constraints,
    workers = workers or 0 }
end

-- Smallest at (0.5, -0.25); its axes are not parallel to those of the parameters.
function bowls.bowl(p)
  local u, v = p.a - 0.5, p.b + 0.25
  return { y = 2 + u ^ 2 + v ^ 2 + u * v }
end

function bowls.search_by(name, o)
  o = o or {}
  local evaluations = o.evaluations or 800
  return o.study:minimise("y", { method = name, evaluations = evaluations, workers = o.workers })
end

return bowls
