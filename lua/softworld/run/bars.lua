-- SPDX-License-Identifier: GPL-3.0-or-later
--- Quantities with error bars, as results show them; whether tolerances are met, and whether a script looks.
-- @module softworld.run.bars
local number = require "softworld.output.number"
local sealed = require "softworld.sealed"
local unread = require "softworld.unread"

local bars = {}

local function text_of(value, unit)
  if type(value) == "number" then return number.text(value, unit) end
  if type(value[1]) ~= "number" then return number.count(#value, "point") end
  local list, most = {}, 0
  for _, x in ipairs(value) do most = math.max(most, math.abs(x)) end
  for i, x in ipairs(value) do list[i] = number.digits(math.abs(x) < 1e-12 * most and 0 or x) end -- rounding
  return ("(%s)%s"):format(table.concat(list, ", "), unit ~= "" and " " .. unit or "")
end

local Quantity = { __name = "quantity" }
bars.Quantity = Quantity -- class of the quantities of a result

function Quantity.__index(self, key)
  local apart, value = unread.look(self, key) -- of a quantity whose tolerance is not met
  if apart then return value end
  return Quantity[key]
end

function Quantity:__tostring()
  return ("%s +- %s"):format(text_of(self.value, self.unit), number.text(self.error, self.unit))
end

--- Returns the value for people: a vector as one text.
function Quantity:text() return text_of(self.value, self.unit) end

--- Returns the name; a row of a check gets "check: " in front, because it may differ from the quantity of
-- that name.
function Quantity:label() return self.row and "check: " .. self.name or self.name end

local Bars = { __name = "error bars" }
Bars.__index = Bars

--- Returns what was asked for in words: by the script, or by the row of a check for its verdict.
function Quantity:asked()
  local q = self
  local asked = q.tolerance < math.huge and number.text(q.tolerance, q.unit) or nil
  if not q.row then return ("asked for %s: %s"):format(asked, q.met and "met" or "NOT met") end
  if not asked then return "no verdict depends on it" end
  return ("up to its limit %s: %s"):format(asked, q.met and "decided" or "NOT decided")
end

function Bars:__tostring()
  local lines = {}
  for i, q in ipairs(self) do
    local place = (q.where and (", s = %.4g m"):format(q.where) or "")
      .. (q.when and (", t = %.4g s"):format(q.when) or "") .. (q.note and (" (%s)"):format(q.note) or "")
    lines[i] = ("%s = %s (%s)%s"):format(q.name, tostring(q), q:asked(), place)
  end
  return table.concat(lines, "\n")
end

--- result:error_bars(): returns the quantities in the order asked for; prints as lines.
function bars.error_bars(result)
  if sealed.fields(result).refused then
    error(("there are no numbers: %s (%s)"):format(result.reason, result.advice), 2)
  end
  local asked = result.quantities
  if not asked then
    error("no error bars were asked for: give tolerance = { quantity = value }, or check = {...}", 2)
  end
  local list = {}
  for i, name in ipairs(result.asked) do list[i] = asked[name] end
  return setmetatable(list, Bars)
end

--- Returns in words which tolerances were not met; nil if all were, or none was asked for.
function bars.unmet(result)
  local names = {}
  for _, name in ipairs(result.quantities and result.asked or {}) do
    if not result.quantities[name].met then names[#names + 1] = name end
  end
  if #names == 0 then
    return result.met == false and result.model and "the model may leave out too much, see run:why()" or nil
  end
  return ("%d of %d tolerances NOT met: %s"):format(#names, #result.asked, table.concat(names, ", "))
end

--- Stores a note of tolerances that the script asked for and that are not met. Returns its mark, which counts
-- as seen once the error of such a quantity is read; nil if there are none. what: the result in words.
function bars.watch(result, what)
  local text, open, all = result.ok and bars.unmet(result), {}, {}
  for _, name in ipairs(text and result.asked or {}) do
    local q = result.quantities[name]
    if not q.row then all[#all + 1] = q end
    if not q.met and not q.row then open[#open + 1] = q end
  end
  if result.model and #open == 0 then open = all end -- the model leaves out too much
  if #open == 0 then return nil end
  local mark = unread.note(("softworld: note: %s is ok, but %s; see .met of its result: %s"):format(what,
    text, result.advice), ("tolerance: %s"):format(text))
  for _, q in ipairs(open) do unread.hide(q, mark, "error", "met") end
  return mark
end

return bars
