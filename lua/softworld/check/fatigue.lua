-- SPDX-License-Identifier: GPL-3.0-or-later
--- Fatigue by tension: the share of its life that the wire loses, at the node where that is most: a rainflow
-- count of the stored frames' tensions, Miner's sum by the S-N curve that the script gives, times repeats.
-- Curvature is not counted: it is stored without its sign, and a bend to and fro would count as two of half
-- the range.
-- @module softworld.check.fatigue
local rainflow = require "softworld.check.rainflow"
local stored = require "softworld.check.stored"

-- Tensions of each node over the frames, and their number; nil where a wire has not always the same nodes.
local function histories(context, entry)
  local list, places, nodes = {}, {}, nil
  local same = true
  local count = stored.each(context, entry, function(values, k, _, s)
    nodes = nodes or #values.tension
    same = same and #values.tension == nodes
    list[k] = list[k] or {}
    list[k][#list[k] + 1], places[k] = values.tension[k], s
  end)
  return same and count and list or nil, places, count
end

local function value(entry, context)
  local given = context.fatigue
  if not given then
    return { value = 0 / 0, note = "its curve is missing: fatigue = { curve = { { range [N], cycles } } }" }
  end
  local list, places, count = histories(context, entry)
  if not list then return { value = 0 / 0, note = "the wire has not the same nodes in all frames" } end
  local best = { value = 0 }
  for k, history in ipairs(list) do
    local sum, range = rainflow.damage(history, given.curve)
    if sum * given.repeats > best.value then
      best = { value = sum * given.repeats, s = places[k], note = ("ranges up to %.4g N"):format(range) }
    end
  end
  if not stored.whole(context, count) then
    best.low, best.high = best.value, math.huge
    local of = ("of %d frames, the steps between are not known: scene:run{ frame = } as short as a step")
      :format(count)
    best.note = best.note and best.note .. "; " .. of or of
  end
  return best
end

return { name = "fatigue", unit = "-", side = "max", on = "wire", asked = true,
  label = "share of the life lost by changes of tension", missing = "allowed share of life", value = value,
  wanted = function(context) return context.fatigue ~= nil end,
  limit = function() return { value = 1, from = "definition", source = "Miner's sum at failure" } end,
  reference = function() return 1 end }
