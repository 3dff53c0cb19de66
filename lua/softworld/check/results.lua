-- SPDX-License-Identifier: GPL-3.0-or-later
--- The rows of a check as results of a study's evaluation, numbers by name: the row "cable.max_tension" gives
-- cable_max_tension (value), cable_max_tension_margin, cable_max_tension_error (half of the range in which
-- the value is known to lie, if known) and cable_max_tension_verdict (PASS 1, OPEN 0, FAIL -1).
-- @module softworld.check.results
local core = require "softworld.core"
local sealed = require "softworld.sealed"

local results = {}

local LONGEST = 48 -- longest name without its ending [characters]

--- Numbers for verdicts.
results.verdicts = { PASS = 1.0, OPEN = 0.0, FAIL = -1.0 }

-- Returns the name of a row as a result.
local function word_of(row)
  local word = row.name:gsub("[^%w_]", "_")
  if not word:find "^%a" then word = "row_" .. word end
  if #word > LONGEST then
    word = ("%s_%08x"):format(word:sub(1, LONGEST - 9), core.checksum(row.name) >> 32)
  end
  return word
end

-- True if one of the names for a row is taken already.
local function is_taken(word, taken)
  for _, ending in ipairs{ "", "_margin", "_error", "_verdict" } do
    if taken[word .. ending] then return true end
  end
  return false
end

--- Returns the rows with their names: a list of { key =, row = }. taken: names of the study's parameters.
function results.keys(check, taken)
  local list, seen = {}, {}
  for name in pairs(taken) do seen[name] = true end
  for i, row in ipairs(sealed.fields(check).rows) do
    local word = word_of(row)
    if is_taken(word, seen) then word = ("%s_%s"):format(word, row.side or "row") end
    local key, count = word, 1
    while is_taken(key, seen) do
      count = count + 1
      key = ("%s_%d"):format(word, count)
    end
    for _, ending in ipairs{ "", "_margin", "_error", "_verdict" } do seen[key .. ending] = true end
    list[i] = { key = key, row = row }
  end
  return list
end

local function is_finite(x) return type(x) == "number" and x - x == 0 end

--- Returns a check as a table of numbers; nil and the reason if its run failed. Values that are not finite
-- are left out, but not their verdicts.
function results.of(check, taken)
  local own = sealed.fields(check)
  if own.no_numbers then return nil, own.reason end
  local flat = {}
  for _, one in ipairs(results.keys(check, taken)) do
    local key, row = one.key, one.row
    flat[key .. "_verdict"] = results.verdicts[row.verdict]
    if is_finite(row.value) then flat[key] = row.value end
    if is_finite(row.margin) then flat[key .. "_margin"] = row.margin end
    local width = row.low and row.high and row.high - row.low
    if is_finite(row.value) and is_finite(width) then flat[key .. "_error"] = width / 2 end
  end
  return flat
end

return results
