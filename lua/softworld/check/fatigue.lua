-- SPDX-License-Identifier: GPL-3.0-or-later
--- Fatigue: the share of its life that the wire loses, at the place where it loses most. Cycles of tension
-- and of bending are counted there by rainflow and summed by Miner's rule, times repeats, with the S-N curves
-- of the script, else of the cable, else of its copper strands, whose spread is wide.
--
-- With scene:run{ wear = true } all steps count, tensions as means over the run's window (help "peaks"):
-- those of single steps grow as steps get shorter. Bending is then that of the fibres all round the wire:
-- bending to and fro is one cycle of the whole range, and rolling a bent wire counts as bending. Without it
-- only the tensions of the stored frames count, and no bending, because curvature is stored without its sign.
-- @module softworld.check.fatigue
local checks = require "softworld.checks"
local core = require "softworld.core"
local counted = require "softworld.output.number".count
local rainflow = require "softworld.check.rainflow"
local stored = require "softworld.check.stored"
local tension = require "softworld.check.tension"
local worn = require "softworld.check.worn"
local window = require "softworld.run.window"

local WAYS = 12 -- directions in which bending is counted [-]

-- Returns Miner's sum over a flat list of range, mean, number, and the largest range. strength: Goodman's
-- [N].
local function damage(cycles, curve, strength)
  local sum, most = 0, 0
  for i = 1, #cycles, 3 do
    local range, mean, count = cycles[i], cycles[i + 1], cycles[i + 2]
    most = math.max(most, range)
    if strength and mean > 0 then range = mean < strength and range / (1 - mean / strength) or math.huge end
    if range > 0 then sum = sum + count / rainflow.life(curve, range) end
  end
  return sum, most
end

-- Returns the largest sum over all directions, by the parabola through the logarithms of the largest and its
-- neighbours. For bends in one plane its error is below 1e-4.
local function around(sums)
  local best = 1
  for k = 2, #sums do if sums[k] > sums[best] then best = k end end
  local a, b, c = sums[best > 1 and best - 1 or #sums], sums[best], sums[best < #sums and best + 1 or 1]
  if not (a > 0 and c > 0 and b < math.huge) then return b end
  local before, after = math.log(b / a), math.log(b / c)
  if before + after <= 0 then return b end
  return b * math.exp((before - after) ^ 2 / (8 * (before + after)))
end

-- Returns Miner's sum of a run that is gone through several times in sequence. residue: the reversals whose
-- ranges count as half cycles in a single run. All other cycles close within each run. Those of the residue
-- are counted in one and in two of it in sequence: after the first, each adds what the second adds, because
-- the widest range is open from then on.
local function repeated(cycles, residue, given, curve, strength)
  local once, most = damage(cycles, curve, strength)
  if given.repeats <= 1 then return once * given.repeats, most end
  local single = damage(rainflow.flat(residue), curve, strength)
  local double, wider = damage(rainflow.flat(rainflow.repeated(residue, 2)), curve, strength)
  if once == math.huge then return once, most end
  return once + (given.repeats - 1) * (once - 2 * single + double), math.max(most, wider)
end

-- Returns the damage at one place by tension plus bending, and the largest range of each.
local function of_place(object, k, given, strength)
  local pull, pull_range, bend, bend_range = 0, 0, 0, 0
  if given.curve then
    local cycles, residue = core.worn_cycles(object, k, 0)
    pull, pull_range = repeated(cycles, residue, given, given.curve, strength)
  end
  if given.bending then
    local sums = {}
    for way = 1, WAYS do
      local range
      local cycles, residue = core.worn_cycles(object, k, way)
      sums[way], range = repeated(cycles, residue, given, given.bending)
      bend_range = math.max(bend_range, range)
    end
    bend = around(sums)
  end
  return pull + bend, pull_range, bend_range
end

local BLOW = 1.5 -- raw tension over its mean, from which a blow is told [-]

-- Returns how the largest tension was measured, if a step had much more: the cycles do not count that.
local function blow(entry, context)
  local value, _, _, note = window.tension(context.scene, entry.object)
  local raw = entry.object:max_tension{ raw = true }
  return raw > BLOW * math.max(0, value) and "tension: " .. note or nil
end

local function of_steps(entry, given, places, strength)
  local best = { value = 0 }
  for k, place in ipairs(places) do
    local sum, pull, bend = of_place(entry.object, k, given, strength)
    if sum > best.value then
      local ranges = {}
      if given.curve then ranges[1] = ("%.4g N"):format(pull) end
      if given.bending then ranges[#ranges + 1] = ("%.4g 1/m"):format(bend) end
      best = { value = sum, s = place.s, bend = bend,
        note = "ranges up to " .. table.concat(ranges, " and ") }
    end
  end
  return best
end

-- Returns the tensions of each node over the frames, and their number; nil if the nodes of the wire changed.
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

local REMOVED = "a wire was removed, and frames cannot tell wires apart then"
local CHANGED = "the wire's nodes are not the same in all frames"

local function of_frames(entry, context, strength, given)
  local list, places, count = histories(context, entry)
  if not count then return worn.at_least({ value = 0, note = REMOVED }, worn.HOW) end
  if not list then return worn.at_least({ value = 0, note = CHANGED }, worn.HOW) end
  local best = { value = 0 }
  for k, history in ipairs(list) do
    local sum, range = repeated(rainflow.flat(history), history, given, given.curve, strength)
    if sum > best.value then
      best = { value = sum, s = places[k], note = ("ranges up to %.4g N"):format(range) }
    end
  end
  if not stored.whole(context, count) then
    worn.at_least(best, ("of %s, the steps between are not known: %s"):format(counted(count, "frame"),
      worn.HOW))
  end
  return best
end

-- Returns Goodman's strength [N]; nil if the rule is not used; false if it is used but the strength is not
-- known.
local function strength_of(entry, given)
  if given.mean ~= "goodman" then return nil end
  local load = tension.limit(entry)
  return given.strength or load and (load.low or load.value) or false
end

-- Returns the S-N curves of a wire: of the script, else of its cable, else of its strands; or nil.
local function curves_of(entry, given)
  if given.curve or given.bending then return given, given.source or "of the script" end
  local known = entry.object:cable()
  local own = known and known.fatigue
  if type(own) == "table" and (own.curve or own.bending) then return own, own.source end
end

-- Returns curves with the other arguments, as of_steps takes them.
local function with(curves, given)
  return { curve = curves.curve, bending = curves.bending, repeats = given.repeats }
end

local function at_curves(entry, context, given, strength)
  local places = worn.places(entry)
  if places then
    local best = of_steps(entry, given, places, strength)
    local told = best.note and given.curve and blow(entry, context)
    best.note = told and best.note .. "; " .. told or best.note
    return best
  end
  if given.bending then return worn.missing() end
  return of_frames(entry, context, strength, given)
end

-- Adds the range of the sum: by the curves' factor, or by the curves of least and most damage.
local function add_spread(best, entry, curves, given, strength)
  local places = worn.places(entry)
  if curves.high and places then
    best.low = of_steps(entry, with(curves.low, given), places, strength).value
    best.high = of_steps(entry, with(curves.high, given), places, strength).value
    local bend = 100 * (best.bend or 0)
    best.note = ("%s: strain of strands %.2g %% if they slip, %.2g %% if they stick"):format(best.note
      or "no cycles", curves.strain[1] * bend, curves.strain[2] * bend)
  elseif (curves.spread or 1) > 1 and best.value == best.value then
    best.low, best.high = best.value / curves.spread, best.high or best.value * curves.spread
  else
    return
  end
  best.share = true
  best.note = ("%s; %.3g to %.3g with the curves' spread"):format(best.note or "no cycles", best.low,
    best.high)
end

local TWISTED = 1e-3 -- shear of the outermost fibres from which torsion counts, if it is also [-]
local OVER_BEND = 0.5 -- this share of the largest range of bending [-]

-- Marks the sum as a lower bound where torsion, which is not counted, is not small beside bending.
local function add_torsion(best, entry)
  local wire = entry.object
  if not (wire.beam.GJ and wire.beam.GJ > 0) then return end
  local known, torsion = pcall(wire.max_torsion, wire)
  if not known and checks.is_interrupt(torsion) then error(torsion, 0) end
  if not known then return end -- it has been a string, which bears none
  if torsion * wire.radius <= TWISTED or torsion <= OVER_BEND * (best.bend or 0) then return end
  worn.at_least(best, ("torsion of up to %.3g rad/m is not counted"):format(torsion))
end

local NONE = "its S-N curve is missing: the wire's strands are not known; give fatigue = { curve = { { range "
  .. "[N], cycles } } } or { bending = { { range [1/m], cycles } } }"

local function value(entry, context)
  local given = context.fatigue or { repeats = 1 }
  local curves, source = curves_of(entry, given)
  if not curves then return { value = 0 / 0, note = NONE } end
  local strength = strength_of(entry, given)
  if strength == false then
    return { value = 0 / 0, note = "mean = 'goodman' needs the wire's breaking load: give strength [N]" }
  end
  local best = at_curves(entry, context, with(curves, given), strength)
  add_spread(best, entry, curves, given, strength)
  add_torsion(best, entry)
  local known = curves.flag and ", " .. curves.flag or curves.source and "" or ", its source is not given"
  local from = ("S-N curve: %s%s"):format(source, known)
  best.note = best.note and best.note .. "; " .. from or from
  return best
end

return { name = "fatigue", repeated = repeated, unit = "-", side = "max", on = "wire", asked = true,
  label = "share of the life lost by cycles of load", missing = "allowed share of life", value = value,
  wanted = function(context) return context.fatigue ~= nil end,
  limit = function() return { value = 1, from = "definition", source = "Miner's sum at failure" } end,
  reference = function() return 1 end }
