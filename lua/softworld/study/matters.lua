-- SPDX-License-Identifier: GPL-3.0-or-later
--- Which parameter matters: what share of a result's variance goes with each parameter alone.
--
-- Sobol's first-order index Var(E(y | x)) / Var(y), from the evaluations that a spread has anyway: they are
-- sorted by the parameter and cut into groups of equal size, and the variance of the groups' means is taken,
-- less what chance alone gives (epsilon squared; T. L. Kelley 1935). The standard error is by leaving out a
-- tenth at a time (M. H. Quenouille's jackknife). Rank correlation (C. Spearman 1904) tells the sign.
-- @module softworld.study.matters
local judge = require "softworld.study.judge"

local matters = {}

local TENTHS = 10
local FEWEST = 20     -- evaluations: of less nothing is said
local GROUPS = 20     -- at most

-- Values of a parameter of the records as ranks; those of choices as they are.
local function sorted_by(records, i)
  local order = table.move(records, 1, #records, 1, {})
  table.sort(order, function(a, b)
    if a.values[i] == b.values[i] then return a.number < b.number end
    return a.values[i] < b.values[i]
  end)
  return order
end

-- Of an order of records a list of groups: of the same choice, else of the same size.
local function cut(order, p, i)
  local groups, count = {}, math.max(2, math.min(GROUPS, math.floor(math.sqrt(#order) / 2)))
  for k, record in ipairs(order) do
    local at = p.kind == "choice" and record.values[i] or 1 + (k - 1) * count // #order
    groups[at] = groups[at] or {}
    table.insert(groups[at], record)
  end
  local list = {}
  for at = 1, math.max(count, p.kind == "choice" and #p.choices or 0) do list[#list + 1] = groups[at] end
  return list
end

local function mean(list, value)
  local sum = 0
  for _, record in ipairs(list) do sum = sum + value(record) end
  return sum / #list
end

local function squares(list, value, about)
  local sum = 0
  for _, record in ipairs(list) do sum = sum + (value(record) - about) ^ 2 end
  return sum
end

-- Share of the variance that goes with the groups.
local function share_of(groups, count, value, whole, middle)
  local within = 0
  for _, group in ipairs(groups) do within = within + squares(group, value, mean(group, value)) end
  local total = squares(whole, value, middle)
  if total <= 0 or #groups < 2 or count <= #groups then return 0 end
  return 1 - within / (count - #groups) * (count - 1) / total
end

local function share(records, p, i, value)
  return share_of(cut(sorted_by(records, i), p, i), #records, value, records, mean(records, value))
end

local function jackknife(records, p, i, value)
  local shares, sum = {}, 0
  for k = 1, TENTHS do
    local left = {}
    for at, record in ipairs(records) do
      if at % TENTHS ~= k - 1 then left[#left + 1] = record end
    end
    shares[k] = share(left, p, i, value)
    sum = sum + shares[k]
  end
  local square = 0
  for _, s in ipairs(shares) do square = square + (s - sum / TENTHS) ^ 2 end
  return math.sqrt((TENTHS - 1) / TENTHS * square)
end

-- Ranks of values, those of equal ones their mean.
local function ranks(records, value)
  local order, rank = table.move(records, 1, #records, 1, {}), {}
  table.sort(order, function(a, b) return value(a) < value(b) end)
  local from = 1
  while from <= #order do
    local to = from
    while to < #order and value(order[to + 1]) == value(order[from]) do to = to + 1 end
    for k = from, to do rank[order[k]] = 0.5 * (from + to) end
    from = to + 1
  end
  return rank
end

local function rank_correlation(records, i, value)
  local a, b = ranks(records, function(r) return r.values[i] end), ranks(records, value)
  local middle, ab, aa, bb = 0.5 * (#records + 1), 0, 0, 0
  for _, r in ipairs(records) do
    local u, v = a[r] - middle, b[r] - middle
    ab, aa, bb = ab + u * v, aa + u * u, bb + v * v
  end
  return aa > 0 and bb > 0 and ab / math.sqrt(aa * bb) or 0
end

-- Means of a result in the lowest and the highest fifth of a parameter, of choices the extremes.
local function swing(records, p, i, value)
  local order, low, high = sorted_by(records, i), {}, {}
  if p.kind == "choice" then
    local least, most = math.huge, -math.huge
    for _, group in ipairs(cut(order, p, i)) do
      local m = mean(group, value)
      least, most = math.min(least, m), math.max(most, m)
    end
    return least, most
  end
  local fifth = math.max(1, #order // 5)
  for k = 1, fifth do low[k], high[k] = order[k], order[#order + 1 - k] end
  return mean(low, value), mean(high, value)
end

--- Of a result, a function of a record, how much of it goes with each parameter, the most first: a list of
-- { name =, share =, error =, rank = (of choices nil), low =, high = (means in the lowest and highest
-- fifth) }. nil where there are too few evaluations, or it does not vary.
function matters.of(own, records, value)
  if #records < FEWEST or squares(records, value, mean(records, value)) <= 0 then return nil end
  local list = {}
  for i, p in ipairs(own.parameters) do
    local low, high = swing(records, p, i, value)
    list[i] = { name = p.name, share = math.max(0, math.min(1, share(records, p, i, value))),
      error = jackknife(records, p, i, value), low = low, high = high,
      rank = p.kind ~= "choice" and rank_correlation(records, i, value) or nil }
  end
  table.sort(list, function(a, b)
    if a.share == b.share then return a.name < b.name end
    return a.share > b.share
  end)
  return list
end

--- Of all results of the records, by name, and of whether the constraints are met ("pass").
function matters.all(own, list)
  local good, names, all = {}, {}, {}
  for _, record in ipairs(list) do
    if record.results then good[#good + 1] = record end
  end
  for name in pairs(good[1] and good[1].results or {}) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    all[name] = matters.of(own, good, function(r) return r.results[name] end)
  end
  if #own.constraints > 0 then
    all.pass = matters.of(own, good, function(r) return judge.pass(own, r) and 1 or 0 end)
  end
  return all
end

--- One line: "time goes with speed (76 +- 3 %, rising), force (19 +- 3 %)"; shares that may be
-- chance are left out.
function matters.text(name, list)
  local parts = {}
  for _, m in ipairs(list) do
    if m.share > 2 * m.error and m.share >= 0.005 then
      local way = m.rank and math.abs(m.rank) > 0.2 and (m.rank > 0 and ", rising" or ", falling") or ""
      parts[#parts + 1] = ("%s (%.0f +- %.0f %%%s)"):format(m.name, 100 * m.share,
        math.max(1, 100 * m.error), way)
    end
  end
  return ("%s goes with %s"):format(name, #parts > 0 and table.concat(parts, ", ")
    or "no parameter alone")
end

return matters
