-- SPDX-License-Identifier: GPL-3.0-or-later
--- Charts of a study: one file each in study/chart, and its name here.
--
-- A kind: { doc =, needs = names of arguments, draw = function(own, o, list) } with the records to draw.
-- @module softworld.study.chart
local judge = require "softworld.study.judge"
local output = require "softworld.study.output"

local chart = {}

chart.names = { "points", "cross", "convergence", "histogram", "tornado", "front" }

--- Returns the kind with this name.
function chart.of(name) return require("softworld.study.chart." .. name) end

--- Returns name and unit of a parameter or a result, for an axis.
function chart.label(own, name)
  local p, unit = own.by_name[name], nil
  if p then unit = p.unit end
  for _, c in ipairs(own.constraints) do
    if c.name == name then unit = unit or c.unit end
  end
  return unit and unit ~= "-" and unit ~= "" and ("%s [%s]"):format(name, unit) or name
end

--- Returns the logarithmic axes: as given, else by the parameters.
function chart.log(own, o, x, y)
  if o.log then return o.log end
  local axes = ""
  if own.by_name[x] and own.by_name[x].log then axes = "x" end
  if own.by_name[y] and own.by_name[y].log then axes = axes .. "y" end
  return axes ~= "" and axes or nil
end

--- Returns points of x over y as curves of sw.plot, those that meet the constraints apart from the others.
function chart.points(own, x, y, list)
  local met, broken = { x = {}, y = {}, style = "points" }, { x = {}, y = {}, style = "points" }
  for _, record in ipairs(list) do
    local curve = judge.pass(own, record) and met or broken
    curve.x[#curve.x + 1], curve.y[#curve.y + 1] = judge.value(own, x, record), judge.value(own, y, record)
  end
  met.name = #own.constraints > 0 and "meets the constraints" or y
  broken.name = "breaks constraints"
  local curves = {}
  for _, curve in ipairs { met, broken } do
    if #curve.x > 0 then curves[#curves + 1] = curve end
  end
  return curves
end

--- Returns width and height for gnuplot from a size in pixels: inches for .pdf, 79 by 24 for characters.
function chart.size(o, width, height)
  if not o.path then return { 79, 24 } end
  if o.path:lower():find "%.pdf$" then return { width / 96, height / 96 } end
  return { width, height }
end

local function check_names(own, o, list)
  local kind = chart.of(o.kind)
  for key in kind.needs:gmatch "%S+" do
    if o[key] == nil then
      error(("study:chart: %s is required with kind = '%s', a parameter or a result"):format(key, o.kind), 0)
    end
  end
  for _, key in ipairs { "x", "y" } do
    if o[key] ~= nil then
      if not kind.needs:find(key) then
        error(("study:chart: %s does not go with kind = '%s'"):format(key, o.kind), 0)
      end
      output.check_name(own, "study:chart", o[key], list)
      local p = own.by_name[o[key]]
      if p and p.kind == "choice" then
        error(("study:chart: %s = '%s' has choices, no numbers"):format(key, p.name), 0)
      end
    end
  end
end

--- Draws a chart; o: kind, x, y, part, path, log.
function chart.draw(own, o)
  if o.part and not own.asked[o.part] and not own.journal.parts[o.part] then
    error(("study:chart: there is no part %d; print(study) numbers them"):format(o.part), 0)
  end
  local list, good = chart.of(o.kind).records and not o.part and chart.of(o.kind).records(own)
    or output.records(own, o.part), {}
  check_names(own, o, list)
  for _, record in ipairs(list) do
    if record.results then good[#good + 1] = record end
  end
  if #good == 0 then error("study:chart: there is no evaluation to draw", 0) end
  return chart.of(o.kind).draw(own, o, good, list)
end

return chart
