-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds which change of one parameter mends a row of a check. Each parameter is scanned over its whole range
-- and closely about its present value; then the least change that passes is narrowed down. Every reported
-- value was run.
--
-- A target: { key =, row =, floor = least margin wanted, passes = true if it has it already }, or { all =
-- true }: every row. Lists of values are requested by coroutine.yield, which returns their records.
-- @module softworld.study.changing
local axis = require "softworld.study.axis"
local parameters = require "softworld.study.parameters"

local changing = {}

local ROUNDS = 8 -- most rounds of a hunt
local AGAIN = 2  -- repeats of reported values, if values are noisy
local FARTHER = { 1, 1.25, 1.5, 2 } -- factors on the single changes when they are made together
local LITTLE = 0.01 -- a gain below this share of what is lacking counts as none [-]

-- --- one record ------------------------------------------------------------------------------------

local function margin_of(target, record) return record.results and record.results[target.key .. "_margin"] end

local function error_of(target, record) return record.results[target.key .. "_error"] or 0 end

-- Returns what a margin lacks to the wanted one; nil without a margin.
local function lacks(target, record)
  local margin = not target.all and margin_of(target, record)
  return margin and target.floor + error_of(target, record) - margin or nil
end

local function row_passes(target, record)
  if record.results[target.key .. "_verdict"] ~= 1 then return false end
  local margin = margin_of(target, record)
  return margin == nil or margin >= target.floor
end

-- True if all rows pass, except those that no parameter can help.
local function all_pass(self, record)
  for _, target in ipairs(self.targets) do
    if not target.all and not row_passes(target, record) then return false end
  end
  for name, value in pairs(record.results) do
    local key = name:match "^(.*)_verdict$"
    if key and value < 1 and not self.hopeless[key] then return false end
  end
  return true
end

local function passes(self, target, record)
  if not record.results then return false end
  if target.all then return all_pass(self, record) end
  return row_passes(target, record)
end

-- Returns the names of rows whose verdict is worse than at present.
local function broken(self, record)
  local list, now = {}, self.now.results
  for name, value in pairs(record.results) do
    local key = name:match "^(.*)_verdict$"
    if key and value < (now[name] or 1) then list[#list + 1] = self.names[key] or key end
  end
  table.sort(list)
  return list
end

-- --- evaluations -----------------------------------------------------------------------------------

local function moved(self, i, value)
  local values = table.move(self.values, 1, #self.values, 1, {})
  values[i] = value
  return values
end

-- Returns the records of lists of values; each is evaluated only once.
local function ask(self, list)
  local new, words = {}, {}
  for k, values in ipairs(list) do
    words[k] = parameters.word(values)
    if not self.known[words[k]] then
      self.known[words[k]], new[#new + 1] = true, values
    end
  end
  local records = #new > 0 and coroutine.yield(new) or {}
  for k, values in ipairs(new) do self.known[parameters.word(values)] = records[k] end
  for k, word in ipairs(words) do words[k] = self.known[word] end
  return words
end

-- Scans each range, and closely about the present value: sets lists of records by parameter, sorted.
local function look(self)
  local list, at = {}, {}
  for i, p in ipairs(self.own.parameters) do
    for _, values in ipairs{ axis.scan(p, self.count), axis.around(p, self.values[i]) } do
      for _, value in ipairs(values) do list[#list + 1], at[#at + 1] = moved(self, i, value), i end
    end
  end
  local records, seen = ask(self, list), {}
  self.lines = {}
  for i in ipairs(self.own.parameters) do
    self.lines[i], seen[i] = { self.now }, { [self.values[i]] = true }
  end
  for k, record in ipairs(records) do
    local i = at[k]
    local value = list[k][i]
    if not seen[i][value] then table.insert(self.lines[i], record) end
    seen[i][value] = true
  end
  for i, line in ipairs(self.lines) do
    table.sort(line, function(a, b) return a.values[i] < b.values[i] end)
  end
end

-- --- the least change that passes --------------------------------------------------------------------

local function end_of(target, i, record)
  return { value = record.values[i], lacks = record.results and lacks(target, record), record = record }
end

-- Searches from the present value outwards. Returns the first value that passes with the one before it, or
-- nil.
local function hunt_of(self, target, i, by)
  local line, k = self.lines[i], 1
  while line[k] ~= self.now do k = k + 1 end
  local before = self.now
  while true do
    k = k + by
    local record = line[k]
    if not record then return nil end
    if passes(self, target, record) then
      return { target = target, index = i, bad = end_of(target, i, before), good = end_of(target, i, record) }
    end
    before = record
  end
end

-- Returns the size of a change over the range.
local function size_of(self, hunt)
  local p = self.own.parameters[hunt.index]
  if p.kind == "choice" then return 1 end
  return math.abs(parameters.place(p, hunt.good.value) - parameters.place(p, self.values[hunt.index]))
end

local function nearest(self, one, other)
  if not (one and other) then return one or other end
  return size_of(self, one) <= size_of(self, other) and one or other
end

local function hunts_of(self)
  local list = {}
  for _, target in ipairs(self.targets) do
    for i in ipairs(self.own.parameters) do
      for _, by in ipairs(target.passes and {} or { 1, -1 }) do
        list[#list + 1] = hunt_of(self, target, i, by)
      end
    end
  end
  return list
end

local function narrow(self, hunts)
  for _ = 1, ROUNDS do
    local list, asked = {}, {}
    for _, hunt in ipairs(hunts) do
      local value = axis.between(self.own.parameters[hunt.index], hunt)
      if value then list[#list + 1], asked[#asked + 1] = moved(self, hunt.index, value), hunt end
    end
    if #list == 0 then return end
    for k, record in ipairs(ask(self, list)) do
      local hunt = asked[k]
      local which = passes(self, hunt.target, record) and "good" or "bad"
      hunt[which] = end_of(hunt.target, hunt.index, record)
    end
  end
end

-- If values are noisy, runs what passed once again, with other random numbers.
local function confirm(self, hunts)
  if not self.noisy then return end
  local list = {}
  for k, hunt in ipairs(hunts) do
    for _ = 1, AGAIN do list[#list + 1] = { hunt = k, values = hunt.good.record.values } end
  end
  if #list == 0 then return end
  local values = {}
  for k, one in ipairs(list) do values[k] = one.values end
  for k, record in ipairs(coroutine.yield(values)) do
    local hunt = hunts[list[k].hunt]
    if not passes(self, hunt.target, record) then hunt.unsure = true end
  end
end

-- Returns the nearest hunt of each failing row; nil if a row has none.
local function one_of_each(self, hunts)
  local list = {}
  for _, target in ipairs(self.targets) do
    local best
    for _, hunt in ipairs(hunts) do
      local fits = hunt.target == target and not target.all and not hunt.unsure
      if fits and (not best or size_of(self, hunt) < size_of(self, best)) then best = hunt end
    end
    if not best and not (target.all or target.passes) then return nil end
    list[#list + 1] = best
  end
  return list
end

-- Returns the values with several changes made `times` as far; nil if they concern fewer than two parameters,
-- or contradict each other.
local function several(self, chosen, times)
  local values, count = table.move(self.values, 1, #self.values, 1, {}), 0
  for _, hunt in ipairs(chosen) do
    local i, value = hunt.index, hunt.good.value
    local p, from = self.own.parameters[i], self.values[i]
    if p.kind ~= "choice" then
      local here = parameters.place(p, from)
      local there = here + times * (parameters.place(p, value) - here)
      value = times == 1 and value or axis.round(p, parameters.at(p, math.max(0, math.min(1, there))))
    end
    if values[i] == from then values[i], count = value, count + 1
    elseif (values[i] > from) ~= (value > from) then return nil
    elseif math.abs(value - from) > math.abs(values[i] - from) then values[i] = value end
  end
  return count > 1 and values or nil
end

local function stands(self, record)
  if not (record.results and all_pass(self, record)) then return false end
  local list = {}
  for k = 1, self.noisy and AGAIN or 0 do list[k] = record.values end
  for _, other in ipairs(#list > 0 and coroutine.yield(list) or {}) do
    if not (other.results and all_pass(self, other)) then return false end
  end
  return true
end

-- If no single change mends all rows: combines changes that mend one row each, also somewhat farther, since
-- one may work against another. Returns the record in which all rows pass, or false.
local function together(self, hunts)
  for _, hunt in ipairs(hunts) do
    if not hunt.unsure and all_pass(self, hunt.good.record) then return nil end
  end
  local chosen, list = one_of_each(self, hunts), {}
  for _, times in ipairs(chosen and FARTHER or {}) do list[#list + 1] = several(self, chosen, times) end
  if #list == 0 then return nil end
  for _, record in ipairs(ask(self, list)) do
    if stands(self, record) then return record end
  end
  return false
end

-- --- what it comes to ------------------------------------------------------------------------------

-- Returns the difference of the margins of two runs with the same parameters.
local function noise_of(self, target)
  local a, b = margin_of(target, self.now), margin_of(target, self.again)
  return a and b and math.abs(a - b) or 0
end

local function slope_of(self, target, i, noise)
  local p, here, points = self.own.parameters[i], self.values[i], {}
  if p.kind == "choice" or not margin_of(target, self.now) then return {} end
  local near, place = { [here] = true }, parameters.place(p, here)
  for _, value in ipairs(axis.around(p, here)) do near[value] = true end
  for _, record in ipairs(self.lines[i]) do
    local margin, value = margin_of(target, record), record.values[i]
    if near[value] and margin then points[#points + 1] = { parameters.place(p, value) - place, margin } end
  end
  local slope, doubt, deviation = axis.slope(points, error_of(target, self.now) + noise)
  if not slope then return {} end
  local each = p.log and here * math.log(p.high / p.low) or p.high - p.low -- dp / d place
  return { slope = slope / each, slope_error = doubt / each, deviation = deviation }
end

-- Returns the record with the largest margin in a parameter's line.
local function best_of(self, target, i)
  local best
  for _, record in ipairs(self.lines[i]) do
    local margin = margin_of(target, record)
    if margin and (not best or margin > margin_of(target, best)) then best = record end
  end
  return best
end

local function say_best(self, target, i, found, noise)
  local best, now = best_of(self, target, i), margin_of(target, self.now)
  found.status = "does not help"
  if not best or not now then return end
  local doubt = error_of(target, self.now) + error_of(target, best)
    + 2 * math.max(noise, found.deviation or 0)
  found.gain = margin_of(target, best) - now
  if found.gain > math.max(doubt, LITTLE * (target.floor - now)) then
    found.status = "helps"
    found.to, found.margin = best.values[i], margin_of(target, best)
    found.value, found.evaluation, found.part = best.results[target.key], best.number, best.part
    if best.results[target.key .. "_verdict"] == 1 then found.status = "passes" end
  end
end

local function found_of(self, target, i, hunt)
  local p, noise = self.own.parameters[i], target.all and 0 or noise_of(self, target)
  local found = target.all and {} or slope_of(self, target, i, noise)
  found.name, found.unit, found.from, found.parameter = p.name, p.unit, self.values[i], p
  if hunt and not hunt.unsure then
    local record = hunt.good.record
    found.status, found.to = "mends", record.values[i]
    found.evaluation, found.part = record.number, record.part
    found.breaks, found.all_pass = broken(self, record), all_pass(self, record)
    if not target.all then
      found.value, found.margin = record.results[target.key], margin_of(target, record)
    end
  elseif hunt then found.status = "noise"
  elseif target.all then found.status = "does not mend"
  elseif target.passes then found.status = "no need"
  else say_best(self, target, i, found, noise) end
  return found
end

local function answer(self, hunts)
  local list = {}
  for t, target in ipairs(self.targets) do
    local one = { target = target, parameters = {} }
    for i in ipairs(self.own.parameters) do
      local hunt
      for _, h in ipairs(hunts) do
        local fits = h.target == target or target.all and all_pass(self, h.good.record)
        if fits and h.index == i then hunt = nearest(self, hunt, h) end
      end
      one.parameters[i] = found_of(self, target, i, hunt)
    end
    list[t] = one
  end
  return list
end

local function is_noisy(one, other)
  for name, value in pairs(one.results or {}) do
    if not other.results or other.results[name] ~= value then return true end
  end
  return one.results == nil or other.results == nil
end

--- Runs the whole search; call it within a coroutine. self: own (of the study), values (present), targets,
-- count (of values scanned in each range), hopeless (keys of rows that nothing can help), names (of rows by
-- key). Returns a list of { target =, parameters = { what was found } }; self.together is the record of
-- changes of several parameters that mend all rows.
function changing.run(self)
  local first = coroutine.yield{ self.values, self.values }
  self.now, self.again, self.known = first[1], first[2], { [parameters.word(self.values)] = first[1] }
  if not self.now.results then error(("the present parameters fail: %s"):format(self.now.failed), 0) end
  self.noisy = is_noisy(first[1], first[2])
  look(self)
  local hunts = hunts_of(self)
  narrow(self, hunts)
  confirm(self, hunts)
  self.together = together(self, hunts)
  return answer(self, hunts)
end

return changing
