-- SPDX-License-Identifier: GPL-3.0-or-later
--- The best value so far over the number of evaluations, with each evaluation.
-- @module softworld.study.chart.convergence
local chart = require "softworld.study.chart"
local judge = require "softworld.study.judge"

-- Returns each evaluation that meets the constraints, and the best so far as a step curve.
local function curves_of(own, y, list)
  local each = { x = {}, y = {}, name = "each evaluation", style = "points" }
  local best = { x = {}, y = {}, name = "best so far", style = "line" }
  for k, record in ipairs(list) do
    if judge.pass(own, record) then
      local value, least = judge.value(own, y, record), best.y[#best.y]
      each.x[#each.x + 1], each.y[#each.y + 1] = k, value
      if not least or value < least then
        if least then best.x[#best.x + 1], best.y[#best.y + 1] = k, least end
        best.x[#best.x + 1], best.y[#best.y + 1] = k, value
      end
    end
  end
  if #best.x > 0 then best.x[#best.x + 1], best.y[#best.y + 1] = #list, best.y[#best.y] end
  return each, best
end

return { doc = "the best y so far over the evaluations that meet the constraints", needs = "y",
  draw = function(own, o, good, list)
    local each, best = curves_of(own, o.y, o.part and list or good)
    if #each.x == 0 then error("study:chart: no evaluation meets the constraints", 0) end
    return require("softworld.run.plot").plot { each, best, path = o.path, log = o.log, title = own.name,
      xlabel = "evaluation", ylabel = chart.label(own, o.y) }
  end }
