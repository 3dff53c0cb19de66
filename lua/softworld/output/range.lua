-- SPDX-License-Identifier: GPL-3.0-or-later
--- The vertical range of a chart over time: one blow of some steps must not make all the rest flat.
-- The player has the same rule (page/scale.js).
-- @module softworld.output.range
local finite = require "softworld.output.gnuplot".finite

local range = {}

local share = 0.01     -- of the time may be beyond the range, above it and below it
local many = 3         -- times the range: peaks that reach less far are shown whole
local room = 0.25      -- of the range is added on a side that is cut
local samples = 20000  -- of one curve are sorted at most; extremes are those of all

-- Returns the values of a curve, each with the time that it stands for, sorted by value; and their sum.
local function weighted(time, values)
  local list, total, stride = {}, 0, math.max(1, #time // samples)
  for i = 1, #time, stride do
    local x = values[i]
    if finite(x) then
      local weight = time[math.min(#time, i + stride)] - time[math.max(1, i - stride)]
      list[#list + 1] = { x, weight }
      total = total + weight
    end
  end
  table.sort(list, function(a, b) return a[1] < b[1] end)
  return list, total
end

-- Returns the value below which a sorted curve is for a share of the time.
local function quantile(list, total, part)
  local sum = 0
  for _, x in ipairs(list) do
    sum = sum + x[2]
    if sum >= part * total then return x[1] end
  end
  return list[#list][1]
end

-- Returns numbers of the samples with the least and the largest value; nil: none is finite.
local function extremes(values, count)
  local low, high
  for i = 1, count do
    local x = values[i]
    if finite(x) then
      if not low or x < values[low] then low = i end
      if not high or x > values[high] then high = i end
    end
  end
  return low, high
end

--- Returns the range that shows the curves, and their peaks beyond it.
-- @tparam {number} time [s]
-- @tparam table curves with `name` and `values`
-- @treturn number low; nil if no value is finite
-- @treturn number high
-- @treturn {table} peaks: { name, t, value, up }, the largest first
function range.of(time, curves)
  local low, high, least, most, ends = math.huge, -math.huge, math.huge, -math.huge, {}
  for _, curve in ipairs(curves) do
    local first, last = extremes(curve.values, #time)
    if first then
      local list, total = weighted(time, curve.values)
      low = math.min(low, quantile(list, total, share))
      high = math.max(high, quantile(list, total, 1 - share))
      least, most = math.min(least, curve.values[first]), math.max(most, curve.values[last])
      ends[#ends + 1] = { name = curve.name, t = time[last], value = curve.values[last], up = true }
      ends[#ends + 1] = { name = curve.name, t = time[first], value = curve.values[first] }
    end
  end
  if #ends == 0 then return end
  local span = high - low
  if not (span > 0 and most - least > many * span) then return least, most, {} end
  low, high = math.max(least, low - room * span), math.min(most, high + room * span)
  local peaks = {}
  for _, peak in ipairs(ends) do
    if peak.up and peak.value > high or not peak.up and peak.value < low then peaks[#peaks + 1] = peak end
  end
  table.sort(peaks, function(a, b)
    if math.abs(a.value) ~= math.abs(b.value) then return math.abs(a.value) > math.abs(b.value) end
    return a.name < b.name
  end)
  return low, high, peaks
end

--- Says in one line which peak beyond the range is the largest, and how many more there are.
-- @treturn string empty if there are none
function range.beyond(peaks, unit)
  local p = peaks[1]
  if not p then return "" end
  return ("beyond: %s %.3g %s at %.4g s%s"):format(p.name, p.value, unit, p.t,
    #peaks > 1 and (", and %d more"):format(#peaks - 1) or "")
end

--- Moments up to this are rounding: forces of the same run at 1 m, times 1e-11 [N m].
-- @tparam table columns
-- @treturn number
function range.moment_rounding(columns)
  local most = 0
  for _, column in ipairs(columns) do
    if column.unit == "N" then
      for _, x in ipairs(column.values) do if finite(x) then most = math.max(most, math.abs(x)) end end
    end
  end
  return 1e-11 * most
end

return range
