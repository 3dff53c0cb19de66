-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of wires whose edges are too long for their sharpest bend (event `edges`). Such values are known
-- roughly only, which leaves verdicts near a limit open.
-- @module softworld.check.edges
local edges = {}

-- Returns the event of a wire, or nil.
local function event_of(run, name)
  for _, e in ipairs(run.events) do
    if e.kind == "edges" and e.object == name then return e end
  end
end

--- Widens the range of a value. A bend of radius R in edges of length h may be sharper by h / (0.4 R), as
-- many times as more segments are needed; a tension may be off by this factor to either side. A value with
-- an error bar keeps it. value.inside: what the value is less than the radius of the centre line, to which
-- the factor applies [m].
-- @tparam table value { value =, low =, high = }
-- @tparam string way "low", "high" or "both": the side to which the value may be off; nil: it does not
-- depend on bends
function edges.widen(value, way, entry, run)
  local event = way and not value.error and value.value == value.value and event_of(run, entry.name)
  if not event then return value end
  local factor, inside = math.max(1, event.value / entry.object.segments), value.inside or 0
  if way ~= "high" then value.low = ((value.low or value.value) + inside) / factor - inside end
  if way ~= "low" then value.high = (value.high or value.value) * factor end
  value.note = ("%sedges are too long for a bend: segments = %.0f, or tolerance, would tell"):format(
    value.note and value.note .. "; " or "", event.value)
  return value
end

return edges
