-- SPDX-License-Identifier: GPL-3.0-or-later
--- The result of sw.compare: prints the differences, writes CSV and JSON.
-- @module softworld.check.comparison
local build = require "softworld.scene.build"
local cells = require "softworld.check.cells"
local json = require "softworld.output.json"
local methods = require "softworld.methods"
local counted = require "softworld.output.number".count
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"

local comparison = {}
local Comparison = { __name = "comparison" }

rows.calls{
  { "comparison.same", nil, "true if no value, limit or verdict has changed and both have the same rows",
    "true or false" },
  { "comparison.reason", nil, "in one sentence", "a text" },
  { "comparison.rows", nil, "status ('same', 'changed', 'only in a', 'only in b'), name, object, what, unit, "
    .. "side, value_a, value_b, change, share, error, limit_a, limit_b, margin_a, margin_b, verdict_a, "
    .. "verdict_b, verdict_changed, limit_changed, better, tolerated", "a list" },
  { "comparison:csv", "path", "writes the rows as CSV", "the path" },
  { "comparison:json", "path", "writes the rows as JSON", "the path" },
}

local columns = { "status", "name", "object", "what", "unit", "side", "value_a", "value_b", "change", "share",
  "error", "limit_a", "limit_b", "margin_a", "margin_b", "verdict_a", "verdict_b", "verdict_changed",
  "limit_changed", "better" }

local function is_shown(row) return row.status ~= "same" or row.verdict_changed or row.limit_changed end

-- --- the terminal ----------------------------------------------------------------------------------

local function change_of(row)
  if row.status == "same" then
    if row.tolerated then return "the same within the tolerance" end
    return row.change and row.change ~= 0 and "the same within its error" or "the same"
  end
  if not row.change then return "" end
  local share = row.share and math.abs(row.share) < 100 and (" (%+.3g %%)"):format(100 * row.share) or ""
  return (row.change > 0 and "+" or "") .. cells.number(row.change, row.unit) .. share
end

local function note_of(row)
  if not row.limit_changed then return nil end
  local function text(limit) return limit and cells.number(limit, row.unit) or "none" end
  return ("limit: %s -> %s"):format(text(row.limit_a), text(row.limit_b))
end

local function line_of(row)
  local only = row.status:match "^only in (.)$"
  if only then
    return { row.status, cells.plain(row.name), cells.number(row["value_" .. only], row.unit),
      row["verdict_" .. only], "" }
  end
  local verdict = row.verdict_changed and row.verdict_a .. " -> " .. row.verdict_b or row.verdict_b
  local value = cells.number(row.value_b, row.unit)
  if row.status == "changed" or row.tolerated then
    value = cells.number(row.value_a, row.unit) .. " -> " .. value
  end
  local better = ""
  if row.better ~= nil then better = row.better and "better" or "worse" end
  return { verdict, cells.plain(row.name), value, change_of(row), better, note = note_of(row) }
end

function Comparison:__tostring()
  local own = sealed.fields(self)
  local list, same = {}, 0
  for _, row in ipairs(own.rows) do
    if is_shown(row) then list[#list + 1] = line_of(row) else same = same + 1 end
  end
  local lines = { ("comparison of a = '%s' (%s) with b = '%s' (%s): %s"):format(cells.plain(own.a.label),
    own.a.verdict, cells.plain(own.b.label), own.b.verdict, own.reason) }
  for _, which in ipairs{ "a", "b" } do
    if own[which].no_numbers then
      lines[#lines + 1] = ("  %s has no numbers: %s"):format(which, cells.plain(own[which].reason))
    end
  end
  cells.add_table(lines, list)
  if same > 0 then
    lines[#lines + 1] = ("  %d row%s the same in both"):format(same, same == 1 and " is" or "s are")
  end
  return table.concat(lines, "\n")
end

-- --- files -----------------------------------------------------------------------------------------

--- Writes the rows as CSV; a cell is empty if there is no value.
function Comparison:csv(path)
  cells.check_path("comparison:csv", path, "a .csv")
  return cells.write_csv(path, columns, sealed.fields(self).rows)
end

--- Writes the comparison as JSON: a, b (label, verdict, reason), same, reason, rows.
function Comparison:json(path)
  cells.check_path("comparison:json", path, "a .json")
  local own = sealed.fields(self)
  local function side(s) return json.object{ label = s.label, verdict = s.verdict, reason = s.reason } end
  return cells.write_json(path, json.object{ a = side(own.a), b = side(own.b), same = own.same,
    reason = own.reason, rows = cells.known_rows(columns, own.rows) })
end

for _, name in ipairs{ "csv", "json" } do Comparison[name] = build.placed(Comparison[name]) end

-- --- the object --------------------------------------------------------------------------------------

methods.found("comparison", Comparison, { "same", "reason", "rows" })

local function reason_of(list)
  local count = { changed = 0, values = 0, verdicts = 0, limits = 0, ["only in a"] = 0, ["only in b"] = 0,
    same = 0 }
  for _, row in ipairs(list) do
    count[row.status] = count[row.status] + 1
    if row.status == "changed" then count.values = count.values + 1 end
    if row.verdict_changed then count.verdicts = count.verdicts + 1 end
    if row.limit_changed then count.limits = count.limits + 1 end
  end
  local texts = {}
  for _, what in ipairs{ "value", "verdict", "limit" } do
    local n = count[what .. "s"]
    if n > 0 or what ~= "limit" then texts[#texts + 1] = counted(n, what) .. " changed" end
  end
  for _, which in ipairs{ "only in a", "only in b" } do
    if count[which] > 0 then texts[#texts + 1] = counted(count[which], "row") .. " " .. which end
  end
  return table.concat(texts, ", "), count.changed + count.verdicts + count.limits + count["only in a"]
    + count["only in b"] == 0
end

-- True for a failed run, which has one row without a value.
local function has_no_numbers(side)
  return side.verdict == "FAIL" and #side.rows == 1 and side.rows[1].name == "run" and not side.rows[1].value
end

--- Returns a comparison of two sides { label =, verdict =, reason =, rows = }; list: the compared rows.
function comparison.new(a, b, list)
  local reason, same = reason_of(list)
  for _, side in ipairs{ a, b } do side.no_numbers = has_no_numbers(side) end
  return sealed.new(Comparison, { a = a, b = b, rows = list, reason = reason, same = same })
end

return comparison
