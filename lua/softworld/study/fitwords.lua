-- SPDX-License-Identifier: GPL-3.0-or-later
--- Says in words what data cannot tell apart: "EI and weight enter as EI / weight only".
--
-- In such a direction parameters change together and no measured value changes. For a parameter above 0 the
-- change is relative to its value, for others absolute.
-- @module softworld.study.fitwords
local fitwords = {}

--- Returns the remark on an interval that was cut off at an end of the range of a parameter.
function fitwords.cut(name) return ("the interval of %s reaches an end of its range"):format(name) end

--- Returns the remark on a parameter whose best value is at an end of its range.
function fitwords.at_end(name)
  return ("%s is at the end of its range; intervals of the others treat it as known"):format(name)
end

--- The remark on a fit whose parameters are all held at ends of their ranges.
fitwords.NONE_FREE = "no parameter is free, so there are no intervals"

--- Returns the change of a parameter, relative to its value if above 0, for a change of its place by 1.
function fitwords.rate(p, value)
  if p.log then return math.log(p.high / p.low) end
  return (p.high - p.low) / (p.low > 0 and value or 1)
end

-- Formats an exponent, 2, 0.5, 1.33; one near a whole or half number is rounded to it.
local function exponent(x)
  local half = math.floor(2 * x + 0.5) / 2
  if math.abs(x - half) < 0.02 * math.max(1, math.abs(x)) then x = half end
  return x, ("%.3g"):format(x)
end

-- For two parameters above 0: a power of one times one of the other stays constant.
local function product(a, b)
  if math.abs(a.change) < 0.98 * math.abs(b.change) then a, b = b, a end
  local k, text = exponent(a.change / b.change) -- a / b^k
  local power = math.abs(k) == 1 and "" or "^" .. text:gsub("^-", "")
  return { name = ("%s %s %s%s"):format(a.name, k > 0 and "/" or "*", b.name, power),
    powers = { [a.i] = 1, [b.i] = -k }, value = a.value * b.value ^ -k }
end

local function difference(a, b)
  local k = a.change / b.change -- a - k b
  return { name = ("%s %s %.4g %s"):format(a.name, k > 0 and "-" or "+", math.abs(k), b.name),
    powers = { [a.i] = 1, [b.i] = -k }, value = a.value - k * b.value }
end

local function several(parts)
  local most, texts = 0, {}
  for _, part in ipairs(parts) do most = math.max(most, math.abs(part.change)) end
  for k, part in ipairs(parts) do
    texts[k] = part.share and ("%s by %+.3g %%"):format(part.name, part.change / most)
      or ("%s by %+.3g"):format(part.name, part.change / most / 100)
  end
  return table.concat(texts, ", ")
end

--- Returns the meaning of a direction of places (u): { parameters = names, text =, name =, powers =, value =,
-- share = }, the last four if it leaves one combination of two parameters.
function fitwords.direction(own, values, direction)
  local parts, names = {}, {}
  for i, p in ipairs(own.parameters) do
    if direction[i] ~= 0 then
      parts[#parts + 1] = { name = p.name, i = i, value = values[i], share = p.low > 0,
        change = direction[i] * fitwords.rate(p, values[i]) }
      names[#names + 1] = p.name
    end
  end
  local a, b = parts[1], parts[2]
  if #parts == 1 then
    return { parameters = names, text = ("the data do not depend on %s"):format(a.name) }
  end
  if #parts > 2 or a.share ~= b.share then
    return { parameters = names, text = ("the data do not distinguish %s: changing %s together changes no "
      .. "result")
      :format(table.concat(names, ", "), several(parts)) }
  end
  local found = a.share and product(a, b) or difference(a, b)
  found.parameters, found.share = names, a.share
  found.text = ("the data depend on %s and %s only through %s"):format(a.name, b.name, found.name)
  return found
end

return fitwords
