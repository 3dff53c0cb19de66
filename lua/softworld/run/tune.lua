-- SPDX-License-Identifier: GPL-3.0-or-later
--- Tuning: finds the parameters for which a simulation agrees with a measurement.
--
--     local found = sw.tune.minimise{ from = 0.001, to = 0.1, f = function(EI)
--       return (sag_of(EI) - 0.042) ^ 2
--     end }
--     print(found.x, found.value, found.ok)
-- @module softworld.run.tune
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local unread = require "softworld.unread"

local tune = {}

--- Minimises f.
--
-- For one number in an interval (GSL's Brent after nine evenly spaced values): `from`, `to`.
-- For one or several from a first guess (GSL's simplex of Nelder and Mead):
-- `start`, a number or a list; `step`, the size of the first steps, default a
-- tenth of start. `tolerance` (1e-6) is a share of the interval or of the steps;
-- Brent cannot find x closer than about 1e-8 of itself. `max_iterations` (200).
--
-- An error in f is raised unchanged. A value of f that is not finite counts as
-- worse than all others. Failed runs within f need not be looked at. One Ctrl-C stops the search.
-- @tparam table args `f`, a function of the number (or of the list, when start is
-- one) returning a number, and the above
-- @treturn table `x`, `value`, `ok`, `reason`, `iterations`, `evaluations`, and
-- `nonfinite`, how many values were not finite
function tune.minimise(args) return unread.excused(build.call, 3, core.minimise, args) end

return setmetatable(tune, { __index = checks.fields("tune", "minimise") })
