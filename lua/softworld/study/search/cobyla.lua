-- SPDX-License-Identifier: GPL-3.0-or-later
--- COBYLA (M. J. D. Powell 1994, by NLopt): linear models of the result and of each limit. It gets the
-- constraints directly: by how much each limit is broken or kept.
-- @module softworld.study.search.cobyla
local guided = require "softworld.study.search.guided"

return { doc = "linear models of result and constraints, Powell 1994: for smooth constraints", starts = 4,
  each = 100, step = 0.2, most = 64, kinds = {},
  begin = function(problem) return guided.begin("cobyla", problem, { gives_sides = true }) end }
