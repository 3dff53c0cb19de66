-- SPDX-License-Identifier: GPL-3.0-or-later
--- DIRECT-L (Gablonsky, Kelley 2001, by NLopt): cuts the ranges into ever smaller boxes, first where a low
-- value is likely. It finds the lowest valley of few parameters and ends only when its evaluations are used
-- up.
-- @module softworld.study.search.direct
local guided = require "softworld.study.search.guided"

return { doc = "divides the ranges into boxes: the lowest valley of few parameters", each = 200, step = 0.2,
  most = 20, kinds = { integer = true },
  begin = function(problem) return guided.begin("direct", problem, {}) end }
