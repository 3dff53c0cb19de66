-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of a run in which a wire passed a clip's lips askew (event `askew`): the lips took less than the
-- given force, because they yield place by place. Lips that yield only together take all of it. No error bar
-- contains this.
-- @module softworld.check.askew
local askew = {}

local BENDS = 2 -- peaks of a wire pressed in beside a clip grow with up to this power of the lips' force [-]

-- True if the run has such an event of this clip.
local function has_event(run, clip)
  for _, e in ipairs(run.events) do
    if e.kind == "askew" and e.object == clip.name then return true end
  end
  return false
end

-- Returns given force over the one that the lips took, 1 or more. passage: clip.inserted or clip.pulled_out.
local function ratio(given, passage, run)
  if not passage or passage.time <= run.start or passage.peak_force <= 0 then return 1 end
  return math.max(1, given / passage.peak_force)
end

--- Returns what the row of a clip says if its wire passed the lips askew, or nil.
function askew.why(clip, run)
  if not has_event(run, clip) then return nil end
  return ("a wire passed the lips askew (event 'askew'): lips that yield only together take up to %.4g N on "
    .. "the way in and %.4g N on the way out"):format(clip.insertion, clip.retention)
end

-- Returns by how much the lips may take more force than they did, of all clips that the wire passed; of any
-- wire if none is given. 1: no more.
local function most(context, wire)
  local run, factor = context.run, 1
  for _, entry in ipairs(context.objects.clip) do
    local clip, there = entry.object, not entry.released
    local into, out = there and clip.inserted, there and clip.pulled_out
    if has_event(run, entry) then
      local is_in, is_out = into and (not wire or into.wire == wire), out and (not wire or out.wire == wire)
      factor = math.max(factor, is_in and ratio(clip.insertion, into, run) or 1,
        is_out and ratio(clip.retention, out, run) or 1)
    end
  end
  return factor
end

--- Widens the peaks of wires that passed lips askew, and those of grippers: with lips that yield as one they
-- are worse. A wire that is pressed in beside the clip bends more sharply than in proportion
-- (spec/check/askew_spec). value.inside: see softworld.check.edges.
function askew.widen(value, member, entry, context)
  if not member.peaks or (member.on ~= "wire" and member.on ~= "gripper") then return value end
  local factor = most(context, member.on == "wire" and entry.object or nil)
  if factor <= 1 or value.value ~= value.value then return value end
  local share, inside = factor ^ BENDS, value.inside or 0
  if member.side == "min" then
    value.low = ((value.low or value.value) + inside) / share - inside
  else
    value.high = (value.high or value.value) * share
  end
  value.note = ("%sa wire passed a clip askew (event 'askew'): lips that yield only together take %.3g times "
    .. "the force"):format(value.note and value.note .. "; " or "", factor)
  return value
end

return askew
