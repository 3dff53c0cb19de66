-- SPDX-License-Identifier: GPL-3.0-or-later
--- BOBYQA (M. J. D. Powell 2009, by NLopt): a quadratic model through 2 n + 1 values, within a trust region.
-- It needs the fewest evaluations if the result is smooth; constraints are penalties, which are not smooth.
-- @module softworld.study.search.bobyqa
local guided = require "softworld.study.search.guided"

return { doc = "a quadratic model, Powell 2009: the fewest evaluations of a smooth result", starts = 4,
  each = 100, step = 0.2, most = 64, kinds = {},
  begin = function(problem) return guided.begin("bobyqa", problem, {}) end }
