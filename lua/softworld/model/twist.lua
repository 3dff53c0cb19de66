-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of twist: in equilibrium between the wires' holds, or driven by friction too.
-- @module softworld.model.twist
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local section = require "softworld.model.section"

local twist = { name = "twist", rungs = {
  { name = "held", as = "no rolling", leaves = "rolling, and twist by friction: friction acts on the axis" },
  { name = "rolling", as = "rolling", leaves = "nothing" } } }

-- The lever of friction along a wire is told if it changes the tension by more than this share of the
-- tolerance [-]. It is no reason to roll: a rod means friction at the axis, as in the capstan equation.
local TOLD = 0.5

-- True if the script does not say how the wire rolls.
local function is_open(wire) return wire.model == "rod" and not wire:get().spin_inertia end

-- Returns a rigid joint through which the wire and another one pass twist on; nil: there is none. Wires that
-- roll turn freely about their axes there: rolling would take more away than it adds.
local function joint_of(context, wire)
  for _, join in ipairs(context.data.joins) do
    local mine, others = false, 0
    local holds = join.rigid and core.exists(join.object) and join.object.held
    for _, w in ipairs(holds and join.wires or {}) do
      mine = mine or w == wire
      if w ~= wire and core.exists(w) and is_open(w) then others = others + 1 end
    end
    if mine and others > 0 then return join.name end
  end
end

-- True if the wire can be made to roll.
local function may_roll(context, wire) return is_open(wire) and not joint_of(context, wire) end

function twist.given(context)
  local why, rung = "there is no rod", 1
  for _, w in ipairs(context.data.wires) do
    if is_open(w.object) then return nil end
    if w.object:get().spin_inertia then why, rung = ("as the script says, '%s' rolls"):format(w.name), 2 end
  end
  return why, rung
end

function twist.apply(context, rung, _, rungs)
  if rung ~= 2 then return end
  for _, w in ipairs(context.data.wires) do
    local mesh = section.takes(context, rungs.section, w.object) -- meshes roll by themselves
    if may_roll(context, w.object) and not mesh then core.redraw(w.object, true) end
  end
end

function twist.look(context, run)
  local met = context.data.touching and #context.scene:touches() > 0
  local f = { rubs = facts.rubbing(context.scene, run.start, context.seen), met = met, rods = 0, able = 0,
    lever = 0 }
  f.flat = met or #f.rubs > 0
  for i, w in ipairs(context.data.wires) do
    if core.exists(w.object) and w.object.model == "rod" then
      f.rods, f.flat = f.rods + 1, f.flat and facts.flat(i)
      f.joint = f.joint or joint_of(context, w.object)
      if not joint_of(context, w.object) then f.able = f.able + 1 end
      if f.flat and #f.rubs > 0 and facts.lever(i) > f.lever then f.lever, f.wire = facts.lever(i), w.name end
    end
  end
  return f
end

function twist.free(_, rung, f, share)
  if rung == 1 and f.rods == 0 then return "the wires are meshes, which roll by themselves" end
  if rung == 1 and #f.rubs == 0 and not f.met then
    return "no friction torque: nothing with friction touches a wire"
  end
  if rung == 1 and f.flat then
    local text = "no friction torque: each wire and the forces on it stay in a plane, nothing turns out of "
      .. "that plane"
    if f.lever <= TOLD * share then return text end
    return ("%s. Friction along '%s' acts at its axis; at its surface, which rolls = true has, its lever "
      .. "would change the tension by about %s"):format(text, f.wire, facts.percent(f.lever))
  end
end

--- Returns why rolling is not computed, or nil.
function twist.skip(_, rung, f)
  if rung > 1 or f.able > 0 then return nil end
  return ("wires that roll pass no twist on through a rigid joint such as '%s', so they do not roll")
    :format(f.joint)
end

--- Returns why wires must roll from here on, by what the run showed so far, or nil.
function twist.broken(f)
  if f.able == 0 or f.flat then return nil end -- meshes roll by themselves
  if #f.rubs > 0 then return ("'%s' rubs"):format(f.rubs[1]) end
  return f.met and "wires touch each other" or nil
end

--- Lets wires roll from here on; raises an error for twisted wires, which would lose their twist.
function twist.onward(context)
  for _, w in ipairs(context.data.wires) do
    if may_roll(context, w.object) then core.redraw(w.object, true) end
  end
end

return twist
