-- SPDX-License-Identifier: GPL-3.0-or-later
--- The simplex of Nelder and Mead (GSL), reflected at the ends of the ranges. It only compares values, so
-- failures, constraints and steps do no harm; in many dimensions it shrinks too early.
-- @module softworld.study.search.simplex
local guided = require "softworld.study.search.guided"

return { doc = "the simplex of Nelder and Mead: robust, for few parameters", starts = 4, each = 100,
  step = 0.2, most = 32, kinds = { integer = true },
  begin = function(problem) return guided.begin("simplex", problem, { ranks = true, folds = true }) end }
