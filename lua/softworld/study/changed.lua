-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of study:change: for each row that should pass, the effect of each parameter on it.
-- @module softworld.study.changed
local cells = require "softworld.check.cells"
local checks = require "softworld.checks"
local counted = require "softworld.output.number".count
local parameters = require "softworld.study.parameters"
local sealed = require "softworld.sealed"

local changed = {}

local Changed = { __name = "change" }
local unknown = checks.fields("change", "ok reason parameters rows evaluations failed noisy name values")
local MAY_LACK = checks.set "parameters several"

function Changed.__index(c, key)
  if not MAY_LACK[key] then return unknown(c, key) end
end

-- --- the text ----------------------------------------------------------------------------------------

local function shown(p, value)
  if p.kind == "choice" then return checks.shown(p.choices[value]) end
  return cells.number(value, p.unit or "-")
end

-- Returns a round step in which a slope is given, about a tenth of the range; for log ranges of the value.
local function round_part(p, from)
  return 10.0 ^ math.floor(math.log((p.log and from or p.high - p.low) / 5, 10))
end

local function slope_text(found, unit)
  if not found.slope then return "" end
  if math.abs(found.slope) <= found.slope_error then return "; no slope beyond its error there" end
  local part = round_part(found.parameter, found.from)
  local change = found.slope * part
  return ("; margin %s%s for each %s"):format(change > 0 and "+" or "", cells.number(change, unit),
    cells.number(part, found.unit or "-"))
end

local function move_text(found)
  local p = found.parameter
  local verb = p.kind == "choice" and "take" or found.to > found.from and "raise" or "lower"
  if p.kind == "choice" then return ("take %s = %s instead of %s"):format(p.name, shown(p, found.to),
    shown(p, found.from)) end
  return ("%s %s from %s to %s"):format(verb, p.name, shown(p, found.from), shown(p, found.to))
end

local function mends_text(found, row)
  local text = move_text(found)
  if found.value and row then
    text = ("%s: %s, margin %s"):format(text, cells.number(found.value, row.unit),
      cells.number(found.margin, row.unit))
  end
  if #found.breaks > 0 then return ("%s; but then %s would not pass"):format(text, table.concat(found.breaks,
    ", ")) end
  return text .. (found.all_pass and "; all rows pass" or "; other rows do not pass yet")
end

local function line_of(found, row)
  local p = found.parameter
  if found.status == "mends" then return mends_text(found, row) .. slope_text(found, row and row.unit) end
  if found.status == "noise" then
    return p.name .. ": a value that passed did not pass when it was run again; values are noisy"
  end
  if found.status == "helps" or found.status == "passes" then
    return ("%s %s: %s at best, with %s%s"):format(p.name, found.status == "helps" and "helps, but not enough"
      or "makes it pass, with a smaller reserve than wanted", cells.number(found.value, row.unit),
      shown(p, found.to), slope_text(found, row.unit))
  end
  if found.status == "does not mend" then return p.name .. " alone does not repair all rows" end
  if found.status == "no need" then return (p.name .. slope_text(found, row.unit)):gsub(";", ":", 1) end
  return p.name .. " does not help"
end

local signs = { max = "<= ", min = ">= " }

local function head_of(one)
  if one.all then return "  all rows" end
  local row, where = one, {}
  if row.s then where[1] = "s = " .. cells.number(row.s, "m") end
  if row.time then where[#where + 1] = "t = " .. cells.number(row.time, "s") end
  if row.step then where[#where + 1] = cells.plain(row.step) end
  return ("  %s  %s  %s%s%s"):format(row.verdict, cells.plain(row.name), cells.number(row.value, row.unit),
    row.side and (", limit %s%s"):format(signs[row.side], cells.number(row.limit, row.unit)) or "",
    #where > 0 and "  (" .. table.concat(where, ", ") .. ")" or "")
end

local function text_of(c, list, together)
  local lines = { ("what to change in '%s': %s (%s, %d failed)"):format(cells.plain(c.name),
    c.reason, counted(c.evaluations, "evaluation"), c.failed) }
  if c.noisy then lines[#lines + 1] = "  values are noisy: each result below was run three times" end
  for _, one in ipairs(list) do
    lines[#lines + 1] = head_of(one)
    for _, found in ipairs(one.parameters) do
      lines[#lines + 1] = "        " .. line_of(found, not one.all and one)
    end
    if not one.mended and not one.passes then
      lines[#lines + 1] = ("        no single parameter repairs %s with that reserve, of %d values over each "
        .. "range"):format(one.all and "all" or "it", c.values)
    end
  end
  if c.several then lines[#lines + 1] = ("  together: %s; all rows pass"):format(c.several)
  elseif together == false then
    lines[#lines + 1] = "  the changes that repair one row each do not repair all rows together, not even "
      .. "changes twice as large"
  end
  return table.concat(lines, "\n")
end

local texts = setmetatable({}, { __mode = "k" }) -- result -> its text

function Changed.__tostring(c) return texts[c] end

-- --- making it ---------------------------------------------------------------------------------------

local function size_of(found)
  local p = found.parameter
  if p.kind == "choice" then return 1 end
  return math.abs(parameters.place(p, found.to) - parameters.place(p, found.from))
end

-- Returns the row of one target: its fields and a list of parameters, those that mend it first, by rising
-- change.
local function row_of(one)
  local row = { parameters = one.parameters, mended = false, all = one.target.all or false,
    passes = one.target.passes or false }
  for key, value in pairs(one.target.row or {}) do row[key] = value end
  local order = { mends = 1, passes = 2, helps = 3, noise = 4 }
  for i, found in ipairs(row.parameters) do
    found.index = i
    if found.status == "mends" then row.mended = true end
  end
  table.sort(row.parameters, function(a, b)
    local x, y = order[a.status] or 5, order[b.status] or 5
    if x ~= y then return x < y end
    if x == 1 and size_of(a) ~= size_of(b) then return size_of(a) < size_of(b) end
    return a.index < b.index
  end)
  return row
end

-- Returns the least change after which all rows pass.
local function least(list)
  local best
  for _, row in ipairs(list) do
    for _, found in ipairs(row.parameters) do
      local fine = found.status == "mends" and found.all_pass
      if fine and (not best or size_of(found) < size_of(best)) then best = found end
    end
  end
  return best
end

local function reason_of(list, best)
  if best then return move_text(best) end
  for _, row in ipairs(list) do
    if not row.mended and not row.passes and not row.all then
      return "no single parameter repairs " .. cells.plain(row.name)
    end
  end
  return "no single parameter repairs all rows"
end

-- Returns the parameters by name, as evaluate takes them.
local function by_name(work, best)
  local values, from = {}, work.together and work.together.values or work.values
  for i, p in ipairs(work.own.parameters) do
    values[p.name] = parameters.shown(p, from[i])
    if best and best.name == p.name then values[p.name] = parameters.shown(p, best.to) end
  end
  return values
end

-- Returns several changes in words.
local function several_of(work)
  local moves = {}
  for i, p in ipairs(work.own.parameters) do
    local from, to = work.values[i], work.together and work.together.values[i]
    if to and to ~= from then moves[#moves + 1] = move_text { parameter = p, from = from, to = to } end
  end
  return #moves > 0 and table.concat(moves, " and ") or nil
end

-- Fields that scripts see.
local SEEN = { "name", "unit", "status", "value", "margin", "gain", "slope", "slope_error", "breaks",
  "all_pass", "evaluation", "part" }

local function public(list)
  for _, row in ipairs(list) do
    for k, found in ipairs(row.parameters) do
      local p, seen = found.parameter, {}
      for _, name in ipairs(SEEN) do seen[name] = found[name] end
      seen.from, seen.to = parameters.shown(p, found.from), found.to and parameters.shown(p, found.to)
      row.parameters[k] = seen
    end
  end
  return list
end

--- Makes the result from what changing.run found. check: of the present parameters.
function changed.new(work, check, o)
  local list = {}
  for i, one in ipairs(work.answer or {}) do list[i] = row_of(one) end
  local best, needed, reason = least(list), false
  for _, row in ipairs(list) do needed = needed or not row.passes end
  local hopeless = #list == 0 and next(work.hopeless) ~= nil
  if hopeless then reason = "no parameter can help: rows are open because a limit is missing"
  elseif #list == 0 then reason = "nothing, all rows pass with that reserve"
  elseif not needed then reason = "nothing, the named rows pass with that reserve"
  else reason = several_of(work) or reason_of(list, best) end
  local ok = best ~= nil or (work.together or nil) ~= nil or not needed and not hopeless
  local c = setmetatable({ ok = ok, reason = reason, parameters = ok and by_name(work, best) or nil,
    evaluations = work.total, failed = work.count_failed, noisy = work.noisy or false,
    name = sealed.fields(check).name, values = o.values, several = several_of(work) }, Changed)
  texts[c] = text_of(c, list, work.together)
  c.rows = public(list)
  return c
end

return changed
