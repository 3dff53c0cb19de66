-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of grip: the wire rigidly held by the gripper, held by the friction of pads, or squeezed first.
-- It applies to grasps with approach = "auto", and to those that give a force and no approach.
-- @module softworld.model.grip
local change = require "softworld.model.change"
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local quantity = require "softworld.quantity"
local section = require "softworld.model.section"

local NONE = 0 / 0 -- value of a check's row that a computation lacks
local HELD = 0.5 -- largest load over what pads hold: below, force and moment together cause no slip [-]

-- Pads let a wire turn a little between them; a wire that also lies on something, or is held, then hangs less
-- far. Where the pads bear less than HELD, an imposed grip leaves out at most these shares of moments, forces
-- and bends: 0.25, 0.03 and 0.14 of the value in 150 random lifts (spec/model/auto_grip_spec). Edges longer
-- than half the pads, as coarse levels have, hide it, so that no comparison can tell [-].
local MOMENT, FORCE, BEND = 0.3, 0.04, 0.16
local BENDS = { min_bend_radius = true, max_strain = true, max_stress = true }

-- Returns the share of a quantity that an imposed grip leaves out [-].
local function left_of(q)
  if BENDS[q.name:match "[^.]*$"] then return BEND end
  return q.unit == "N m" and MOMENT or q.unit == "N" and FORCE or 0
end

local grip = { name = "grip", rungs = {
  { name = "imposed", as = "an imposed grip", leaves = "slip, and the wire's turning between the pads" },
  { name = "plates", as = "pads", leaves = "flattening between the pads" },
  { name = "mixed", as = "mixed handling", leaves = "flattening elsewhere" } } }

function grip.apply(context, rung)
  context.data.auto = { approach = grip.rungs[rung].name, asked = {} }
end

-- Returns the friction of both fingers together [-].
local function friction(gripper)
  local mu = gripper.pads.friction
  if type(mu) == "table" then return mu[1] + mu[2] end
  return 2 * mu
end

-- Returns the load of one grasp over what its pads hold, and the flattening; nil if no force was given.
local function of_grasp(asked, start)
  local gripper, wire = asked.gripper, asked.wire
  if not asked.force then return nil end
  local m = gripper:over(start)
  local load = (m.peak_force or 0) + 2 * (m.peak_moment or 0) / gripper.pads.width
  return load / (friction(gripper) * asked.force), section.flattening(wire, asked.force / gripper.pads.width)
end

function grip.look(context, run)
  local f = { count = 0, load = 0, flat = 0 }
  for _, asked in ipairs(context.data.auto and context.data.auto.asked or {}) do
    f.count = f.count + 1
    local load, flat = of_grasp(asked, run.start)
    if not load then f.blind = asked.gripper.name
    elseif load > f.load then f.load, f.gripper = load, asked.gripper.name end
    if not flat then f.unknown = asked.wire.name
    elseif flat > f.flat then f.flat, f.wire, f.force = flat, asked.wire.name, asked.force end
  end
  return f
end

function grip.idle(f) return f.count == 0 end

function grip.free(_, rung, f, share)
  if rung == 1 then
    if f.blind then return nil, ("the script does not give the grip force of '%s'"):format(f.blind) end
    if f.unknown or f.flat > share then return nil end
    if f.load > HELD then return nil end
    local text = "the pads of '%s' bear %s of what their friction holds (limit %s), and flatten the wire by "
      .. "%s of its width (limit %s)"
    return text:format(f.gripper, facts.percent(f.load), facts.percent(HELD), facts.percent(f.flat),
      facts.percent(share)), left_of
  end
  if rung > 2 then return nil end
  if f.unknown then
    return nil, ("the stiffness of the section of '%s' is not known: give E"):format(f.unknown)
  end
  if f.flat > share then return nil end
  return ("a force of %s flattens '%s' by %s of its width (limit %s)"):format(number.text(f.force or 0, "N"),
    f.wire
    or "?",
    facts.percent(f.flat), facts.percent(share))
end

--- Returns why the rung leaves out too much of a quantity, whatever a comparison would tell, or nil.
function grip.lacks(context, rung, f, values)
  if rung > 1 or f.blind then return nil end
  for _, q in ipairs(context.job.quantities) do
    local value = values[q.name] or NONE
    local left = left_of(q) * quantity.size(value)
    if left > change.MODEL * quantity.asked(q, value) then -- false for NaN
      return ("a wire turns a little between pads, which may change %s by %s, more than the allowed %s")
        :format(q.name, number.text(left, q.unit),
          number.text(change.MODEL * quantity.asked(q, value), q.unit))
    end
  end
end

--- Returns why the rung no longer suffices, by what the run showed so far, or nil.
function grip.broken(f, share, rung)
  if rung == 1 and f.load > HELD then
    return ("the pads of '%s' bore %s of what their friction holds (limit %s)"):format(f.gripper,
      facts.percent(f.load), facts.percent(HELD))
  elseif f.flat > share then
    return ("pads flattened '%s' by %s of its width (limit %s)"):format(f.wire, facts.percent(f.flat),
      facts.percent(share))
  end
end

return grip
