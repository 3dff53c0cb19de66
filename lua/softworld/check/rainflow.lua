-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rainflow count of a load history, ASTM E1049-85, 5.4.4, and the damage of its cycles by Miner's sum.
-- @module softworld.check.rainflow
local rainflow = {}

--- Returns the reversals of a history: its first value, each turning point, its last value.
function rainflow.reversals(history)
  local list = {}
  for _, x in ipairs(history) do
    local n = #list
    if n >= 2 and (list[n] - list[n - 1]) * (x - list[n]) >= 0 then
      list[n] = x -- same direction
    elseif n == 0 or x ~= list[n] then
      list[n + 1] = x
    end
  end
  return list
end

--- Returns the cycles { range =, mean =, count = 1 or 0.5 } in the order of counting.
function rainflow.count(history)
  local cycles, open = {}, {}
  for _, x in ipairs(rainflow.reversals(history)) do
    open[#open + 1] = x
    while #open >= 3 do
      local n = #open
      local now, before = math.abs(open[n] - open[n - 1]), math.abs(open[n - 1] - open[n - 2])
      if now < before then break end
      if n == 3 then -- the range before holds the history's start
        cycles[#cycles + 1] = { range = before, mean = (open[1] + open[2]) / 2, count = 0.5 }
        table.remove(open, 1)
      else
        cycles[#cycles + 1] = { range = before, mean = (open[n - 1] + open[n - 2]) / 2, count = 1 }
        table.remove(open, n - 1)
        table.remove(open, n - 2)
      end
    end
  end
  for i = 2, #open do
    cycles[#cycles + 1] = { range = math.abs(open[i] - open[i - 1]), mean = (open[i] + open[i - 1]) / 2,
      count = 0.5 }
  end
  return cycles
end

--- Returns them as one list of range, mean, count.
function rainflow.flat(history)
  local list = {}
  for _, c in ipairs(rainflow.count(history)) do
    list[#list + 1], list[#list + 2], list[#list + 3] = c.range, c.mean, c.count
  end
  return list
end

--- Returns a history in sequence with itself, so many times.
function rainflow.repeated(history, times)
  local list = {}
  for _ = 1, times do table.move(history, 1, #history, #list + 1, list) end
  return list
end

--- Returns the number of cycles that a range is endured: straight lines through the curve's points { range,
-- cycles } in logarithms, the outer ones extended. There is no endurance limit.
function rainflow.life(curve, range)
  local i = 1
  while i + 2 <= #curve and range > curve[i + 1][1] do i = i + 1 end
  local a, b = curve[i], curve[i + 1]
  local slope = math.log(b[2] / a[2]) / math.log(b[1] / a[1])
  return a[2] * (range / a[1]) ^ slope
end

--- Returns Miner's sum of a history, the share of life it uses, and the largest range.
function rainflow.damage(history, curve)
  local sum, most = 0, 0
  for _, cycle in ipairs(rainflow.count(history)) do
    if cycle.range > 0 then sum = sum + cycle.count / rainflow.life(curve, cycle.range) end
    most = math.max(most, cycle.range)
  end
  return sum, most
end

return rainflow
