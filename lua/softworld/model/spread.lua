-- SPDX-License-Identifier: GPL-3.0-or-later
--- Uncertainty of the cables themselves: how far the quantities move if EI takes its bounds of the catalogue.
-- A more accurate model is wasted.
-- @module softworld.model.spread
local number = require "softworld.output.number"
local probe = require "softworld.model.probe"
local quantity = require "softworld.quantity"

local spread = {}
spread.__index = spread

local FINE = 0.3 -- shortest useful bar, over the spread [-]

--- Finds the wires of the catalogue, with the factors of EI.
function spread.new(context)
  local self = setmetatable({ context = context, low = {}, high = {}, names = {}, changes = {} }, spread)
  for _, w in ipairs(context.data.wires) do
    local entry, EI = w.object:cable(), w.object:get().EI
    if entry and w.object.model == "rod" and EI == entry.EI.value and entry.EI.low < entry.EI.high then
      self.low[w.object], self.high[w.object] = entry.EI.low / EI, entry.EI.high / EI
      self.names[#self.names + 1] = ("EI of '%s' (%s) is between %.3g and %.3g N m2"):format(w.name,
        entry.name,
        entry.EI.low, entry.EI.high)
    end
  end
  return self
end

--- Computes both bounds with the chosen rungs; base: the result between them.
function spread:look(rungs, base)
  if #self.names == 0 then return end
  for _, word in ipairs { "low", "high" } do
    local r = probe.of(self.context, rungs, 1, self[word], word)
    if r.ok then
      for name, value in pairs(r.values) do
        local d = quantity.alike(value, base.values[name]) and quantity.distance(value, base.values[name])
          or 0
        if d == d then self.changes[name] = math.max(self.changes[name] or 0, d) end
      end
    else
      self.failed = ("with the %sest EI there is no result: %s"):format(word, r.reason)
    end
  end
end

--- Returns the shortest useful bar of a quantity, in its unit.
function spread:floor(q)
  local d = self.changes[q.name] or 0
  return d > q.tolerance and d < math.huge and FINE * d or 0
end

--- Returns a sentence about the quantities that the spread moves by more than the tolerance; nil: none.
function spread:text()
  local parts = {}
  for _, q in ipairs(self.context.job.quantities) do
    local d = self.changes[q.name] or 0
    if d > (q.tolerance or math.huge) then -- nil: the value is not known
      parts[#parts + 1] = ("%s by %s"):format(q.name, number.text(d, q.unit))
    end
  end
  if #parts == 0 then return nil end
  return ("%s, which changes %s: no model can repair that; measure the cable (help 'calibration')"):format(
    table.concat(self.names, "; "), table.concat(parts, ", "))
end

return spread
