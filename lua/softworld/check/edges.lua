-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of wires whose edges are too long for their sharpest bend (event `edges`), or coarse for it, or whose
-- sharpest bend is a corner of the path that they were drawn along (event `corner`). Such values are known
-- roughly only, which leaves verdicts near a limit open.
-- @module softworld.check.edges
local number = require "softworld.output.number"

local edges = {}

-- The bend of a wire at rest may be sharper and wider by the shares that wire:bend_sharpness gives. In
-- motion it may be sharper by SHARE of `uneven`, the second difference of the curvature from node to node
-- over the curvature: in runs with eight times as many segments landings were by up to 1.11, wires laid by
-- an end and gripped loops by up to 0.8 [-].
local SHARE = 1.25
-- In motion it may be wider by `uneven`, at most by this share: up to 0.037 was measured, beside grips and
-- clamps [-].
local WIDER = 0.04
-- A bend counts as one in motion if the acceleration of the nodes there makes 1/MOVING of `uneven`; if it
-- makes less, in proportion [-].
local MOVING = 2
-- Share by which the bend of a wire on a round obstacle may seem sharper than that of the obstacle [-].
local ROUND = 0.05
-- Below SMOOTH edges are fine for the bend. From ZIGZAG on, curvature alternates between nodes: bends were
-- up to ten times sharper, so SHARPER times are taken [-].
local SMOOTH, ZIGZAG, SHARPER = 0.02, 1.5, 12

-- A radius of more lengths of the wire is a straight wire and rounding, which is never even: such a bend is
-- 1/8000 of the length off a line [-].
local STRAIGHT = 1e3

-- Returns the event of a wire of this kind, or nil.
local function event_of(run, name, kind)
  for _, e in ipairs(run.events) do
    if e.kind == kind and e.object == name then return e end
  end
end

local function add_note(value, text)
  value.note = value.note and value.note .. "; " .. text or text
end

-- Returns by which factor a bend may be sharper, at most: where a round obstacle presses on the wire, not
-- more than the obstacle.
local function limited(factor, sharp)
  if not (sharp and sharp.round > 0) then return factor end
  return math.min(factor, math.max(1, sharp.round) * (1 + ROUND))
end

-- Returns by which factors the curvature of a bend may be larger, and the radius.
local function factors(sharp)
  local moves = math.min(1, MOVING * sharp.swings / sharp.uneven)
  local more = sharp.uneven < ZIGZAG and 1 + math.max(sharp.more, moves * SHARE * sharp.uneven) or SHARPER
  local wider = 1 / (1 - math.min(sharp.less, 0.5))
  return limited(more, sharp), math.max(wider, 1 + moves * math.min(sharp.uneven, WIDER))
end

-- Widens the range of a bend radius that has value.sharp; returns why, or nil.
local function widen_bend(value, entry)
  local sharp, inside, wire = value.sharp, value.inside, entry.object
  if not (sharp and sharp.uneven > SMOOTH and value.value < math.huge) then return nil end
  if value.value > STRAIGHT * wire.length then return nil end
  local axis, more, wider = value.value + inside, factors(sharp)
  value.low = math.max(0, math.min(value.low or value.value, axis / more - inside))
  value.high = math.max(value.high or value.value, axis * wider - inside)
  local most = number.text(value.high, "m")
  if wire.model ~= "rod" and wire.model ~= "string" then
    return ("between %s and %s: slices of a mesh do not show the bend at a hold; take a rod")
      :format(number.text(value.low, "m"), most)
  end
  return ("between %s and %s: edges of %s are coarse for this bend; take more segments, or tolerance")
    :format(number.text(value.low, "m"), most, number.text(wire.length / wire.segments, "m"))
end

-- Widens the range of a bend radius that is that of a corner of the wire's path (event `corner`), up to that
-- of a smooth curve through the path's points.
local function widen_corner(value, entry, run)
  local event = value.sharp and event_of(run, entry.name, "corner")
  if not event or event.value - value.inside <= (value.high or value.value) then return end
  value.high = event.value - value.inside
  add_note(value, ("the wire's path has a corner there: %s if it is meant to be smooth"):format(
    number.text(value.high, "m")))
end

--- Returns the results of wire:bend_sharpness as a table.
function edges.sharpness(wire, options)
  local uneven, swings, more, less, round = wire:bend_sharpness(options)
  return { uneven = uneven, swings = swings, more = more, less = less, round = round }
end

--- Widens the range of a value. A bend of radius R in edges of length h may be sharper by h / (0.4 R), as
-- many times as more segments are needed; a tension may be off by this factor to either side. A value with
-- an error bar keeps it. value.inside: what the value is less than the radius of the centre line, to which
-- the factor applies [m]. value.sharp: how sharp a bend is for its edges, see edges.sharpness.
-- @tparam table value { value =, low =, high = }
-- @tparam string way "low", "high" or "both": the side to which the value may be off; nil: it does not
-- depend on bends
function edges.widen(value, way, entry, run)
  if not way or value.error or value.value ~= value.value then return value end
  local event, low, inside = event_of(run, entry.name, "edges"), value.low or value.value, value.inside or 0
  local why = widen_bend(value, entry)
  widen_corner(value, entry, run)
  if not event then
    if why then add_note(value, why) end
    return value
  end
  local factor = limited(math.max(1, event.value / entry.object.segments), value.sharp)
  if way ~= "high" then value.low = math.min(value.low or low, (low + inside) / factor - inside) end
  if way ~= "low" then value.high = (value.high or value.value) * factor end
  add_note(value, ("edges are too long for a bend: take segments = %.0f, or tolerance"):format(
    event.value))
  return value
end

return edges
