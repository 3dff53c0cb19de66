-- SPDX-License-Identifier: GPL-3.0-or-later
--- Two results over one another, with the Pareto front.
-- @module softworld.study.chart.front
local chart = require "softworld.study.chart"
local pareto = require "softworld.study.pareto"

local function draw(own, o, list)
  local args, front = chart.points(own, o.x, o.y, list), { x = {}, y = {}, name = "front", style = "line" }
  for i, row in ipairs(pareto.of(own, { o.x, o.y }, list).rows) do
    if i > 1 then -- a step: the region beyond is dominated
      front.x[#front.x + 1], front.y[#front.y + 1] = row[o.x], front.y[#front.y]
    end
    front.x[#front.x + 1], front.y[#front.y + 1] = row[o.x], row[o.y]
  end
  if #front.x > 0 then table.insert(args, front) end
  args.path, args.log, args.title = o.path, chart.log(own, o, o.x, o.y), own.name
  args.xlabel, args.ylabel = chart.label(own, o.x), chart.label(own, o.y)
  return require("softworld.run.plot").plot(args)
end

return { doc = "the Pareto front of x and y among all evaluations", needs = "x y", draw = draw }
