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
local number = require "softworld.output.number"
local place = require "softworld.place"
local unread = require "softworld.unread"

local tune = {}

local Found = { __name = "minimum" }
local field = checks.fields("the result of tune.minimise",
  "x value ok reason iterations evaluations nonfinite")

function Found.__index(self, key)
  local apart, value = unread.look(self, key)
  if apart then return value end
  return field(self, key)
end

local function text_of(x)
  if type(x) == "number" then return ("%.6g"):format(x) end
  local parts = {}
  for k, value in ipairs(x) do parts[k] = ("%.6g"):format(value) end
  return ("{ %s }"):format(table.concat(parts, ", "))
end

function Found:__tostring()
  return ("%.6g at %s (%s, %s)"):format(self.value, text_of(self.x), self.reason,
    number.count(self.evaluations, "evaluation"))
end

-- Makes a search that ended before its tolerance a note at the end of a script that does not look at it.
local function found(result)
  if not result.ok then
    local at = place.of_caller()
    local mark = unread.note(
      ("softworld: note: the search of tune.minimise%s is not at its end: %s; see .ok of its result"):format(
      at and " at " .. at or "", result.reason), "tune.minimise: " .. result.reason)
    unread.hide(result, mark, "ok", "reason")
  end
  return setmetatable(result, Found)
end

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
-- `nonfinite`, how many values were not finite. A script that looks neither at `ok` nor at `reason` nor
-- prints it is told at its end if the search did not end
function tune.minimise(args) return found(unread.excused(build.call, 3, core.minimise, args)) end

return setmetatable(tune, { __index = checks.fields("tune", "minimise") })
