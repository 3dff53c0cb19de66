-- SPDX-License-Identifier: GPL-3.0-or-later
--- Which parameter matters: the share of a result's variance that is due to each parameter alone.
--
-- Sobol's first-order index Var(E(y | x)) / Var(y), from the evaluations of a spread: they are sorted by the
-- parameter and cut into groups of equal size. What a straight line through each group leaves over, corrected
-- for chance, is not due to the parameter (epsilon squared; T. L. Kelley 1935). The standard error comes from
-- leaving out a tenth at a time (M. H. Quenouille's jackknife). Rank correlation (C. Spearman 1904) gives the
-- sign.
-- @module softworld.study.matters
local judge = require "softworld.study.judge"

local matters = {}

local TENTHS = 10
local FEWEST = 20     -- least evaluations
local MOST = 5000     -- most evaluations; of more only every second, third, ... is used
local GROUPS = 20     -- most groups

-- --- what is there -------------------------------------------------------------------------------

local function sorted(count, key)
  local order = {}
  for k = 1, count do order[k] = k end
  table.sort(order, function(a, b)
    if key[a] == key[b] then return a < b end
    return key[a] < key[b]
  end)
  return order
end

-- Returns ranks from an order; equal values get their mean rank.
local function ranks_of(order, key)
  local rank, from = {}, 1
  while from <= #order do
    local to = from
    while to < #order and key[order[to + 1]] == key[order[from]] do to = to + 1 end
    for k = from, to do rank[order[k]] = 0.5 * (from + to) end
    from = to + 1
  end
  return rank
end

-- Returns values of the parameters by evaluation, their orders and ranks.
local function prepare(own, records)
  local data, every = { keys = {}, orders = {}, ranks = {}, records = {} }, math.ceil(#records / MOST)
  for k = 1, #records, every do data.records[#data.records + 1] = records[k] end
  for i in ipairs(own.parameters) do
    local key = {}
    for k, record in ipairs(data.records) do key[k] = record.values[i] end
    data.keys[i], data.orders[i] = key, sorted(#key, key)
    data.ranks[i] = ranks_of(data.orders[i], key)
  end
  return data
end

-- Returns values of a result minus their mean, over the largest; nil if they do not vary.
local function scaled(data, value)
  local y, mean, most, varies = {}, 0, 0, false
  for k, record in ipairs(data.records) do
    y[k] = value(record)
    mean, varies = mean + y[k] / #data.records, varies or y[k] ~= y[1]
  end
  for k, v in ipairs(y) do
    y[k] = v - mean
    most = math.max(most, math.abs(y[k]))
  end
  if not varies or most <= 0 or most == math.huge then return nil end
  for k, v in ipairs(y) do y[k] = v / most end
  return y, mean, most
end

-- --- shares ---------------------------------------------------------------------------------------

-- Returns what a straight line through a group leaves over; for choices, which have no order, what the mean
-- leaves.
local function left_in(g, line)
  local yy = g.yy - g.y ^ 2 / g.n
  local xx, xy = g.xx - g.x ^ 2 / g.n, g.xy - g.x * g.y / g.n
  return line and xx > 0 and math.max(0, yy - xy ^ 2 / xx) or yy
end

local function add(groups, at, x, y)
  local g = groups[at]
  if not g then
    g = { n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0 }
    groups[at] = g
  end
  g.n, g.x, g.y = g.n + 1, g.x + x, g.y + y
  g.xx, g.xy, g.yy = g.xx + x * x, g.xy + x * y, g.yy + y * y
end

-- Returns groups of the evaluations in the order of a parameter, and the most there can be; without: the
-- tenth that is left out. x in a group is the place in the order, relative to the group's middle.
local function groups_of(data, p, i, y, without)
  local order, key, left, at, groups = data.orders[i], data.keys[i], 0, 0, {}
  for _, k in ipairs(order) do left = left + (k % TENTHS ~= without and 1 or 0) end
  local count = math.max(2, math.min(GROUPS, math.floor(math.sqrt(left) / 2)))
  for _, k in ipairs(order) do
    if k % TENTHS ~= without then
      local group = p.kind == "choice" and key[k] or 1 + at * count // left
      add(groups, group, at / left - (group - 0.5) / count, y[k])
      at = at + 1
    end
  end
  return groups, p.kind == "choice" and #p.choices or count
end

-- Returns the share of the variance of y due to a parameter.
local function share(data, p, i, y, without)
  local groups, count = groups_of(data, p, i, y, without)
  local line, n, sum, square, within, free = p.kind == "number", 0, 0, 0, 0, 0
  for at = 1, count do
    local g = groups[at]
    if g then
      n, sum, square, within = n + g.n, sum + g.y, square + g.yy, within + left_in(g, line)
      free = free + g.n - (line and 2 or 1)
    end
  end
  local total = square - sum ^ 2 / n
  return total > 0 and free > 0 and 1 - within / free * (n - 1) / total or 0
end

local function jackknife(data, p, i, y)
  local shares, sum, square = {}, 0, 0
  for k = 1, TENTHS do
    shares[k] = share(data, p, i, y, k - 1)
    sum = sum + shares[k]
  end
  for _, s in ipairs(shares) do square = square + (s - sum / TENTHS) ^ 2 end
  return math.sqrt((TENTHS - 1) / TENTHS * square)
end

local function correlation(a, b)
  local middle, ab, aa, bb = 0.5 * (#a + 1), 0, 0, 0
  for k, x in ipairs(a) do
    local u, v = x - middle, b[k] - middle
    ab, aa, bb = ab + u * v, aa + u * u, bb + v * v
  end
  return aa > 0 and bb > 0 and ab / math.sqrt(aa * bb) or 0
end

-- Returns the means of y in the lowest and the highest fifth of a parameter; for choices the extremes.
local function swing(data, p, i, y)
  local order, key = data.orders[i], data.keys[i]
  if p.kind == "choice" then
    local n, sums, least, most = {}, {}, math.huge, -math.huge
    for k, v in ipairs(y) do n[key[k]], sums[key[k]] = (n[key[k]] or 0) + 1, (sums[key[k]] or 0) + v end
    for c, size in pairs(n) do
      least, most = math.min(least, sums[c] / size), math.max(most, sums[c] / size)
    end
    return least, most
  end
  local fifth, low, high = math.max(1, #order // 5), 0, 0
  for k = 1, fifth do
    low, high = low + y[order[k]] / fifth, high + y[order[#order + 1 - k]] / fifth
  end
  return low, high
end

local function of(own, data, value)
  if #data.records < FEWEST then return nil end
  local y, mean, most = scaled(data, value)
  if not y then return nil end
  local list, ranks = {}, ranks_of(sorted(#y, y), y)
  for i, p in ipairs(own.parameters) do
    local low, high = swing(data, p, i, y)
    list[i] = { name = p.name, share = math.max(0, math.min(1, share(data, p, i, y))),
      error = jackknife(data, p, i, y), low = mean + most * low, high = mean + most * high,
      rank = p.kind ~= "choice" and correlation(data.ranks[i], ranks) or nil }
  end
  table.sort(list, function(a, b)
    if a.share == b.share then return a.name < b.name end
    return a.share > b.share
  end)
  return list
end

--- Returns how much of a result, a function of a record, is due to each parameter, the largest first: a list
-- of { name =, share =, error =, rank = (nil for choices), low =, high = (means in the lowest and highest
-- fifth) }. nil with too few evaluations, or if it does not vary.
function matters.of(own, records, value) return of(own, prepare(own, records), value) end

--- Returns the same for all results of the records, by name, and for whether the constraints are met
-- ("pass").
function matters.all(own, list)
  local good, names, all = {}, {}, {}
  for _, record in ipairs(list) do
    if record.results then good[#good + 1] = record end
  end
  for name in pairs(good[1] and good[1].results or {}) do names[#names + 1] = name end
  table.sort(names)
  local data = prepare(own, good)
  for _, name in ipairs(names) do
    all[name] = of(own, data, function(r) return r.results[name] end)
  end
  if #own.constraints > 0 then
    all.pass = of(own, data, function(r) return judge.pass(own, r) and 1 or 0 end)
  end
  return all
end

--- Returns one line: "time depends on speed (76 +- 3 %, rising), force (19 +- 3 %)"; shares that may be
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
  return ("%s depends on %s"):format(name, #parts > 0 and table.concat(parts, ", ")
    or "no parameter alone")
end

return matters
