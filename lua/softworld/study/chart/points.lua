-- SPDX-License-Identifier: GPL-3.0-or-later
--- One quantity over another; evaluations that meet the constraints are marked apart.
-- @module softworld.study.chart.points
local chart = require "softworld.study.chart"

return { doc = "y over x; evaluations that meet the constraints have another colour", needs = "x y",
  draw = function(own, o, list)
  local args = chart.points(own, o.x, o.y, list)
  args.path, args.log, args.title = o.path, chart.log(own, o, o.x, o.y), own.name
  args.xlabel, args.ylabel = chart.label(own, o.x), chart.label(own, o.y)
  return require("softworld.run.plot").plot(args)
end }
