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

-- True if the wire can be made to roll.
local function may_roll(wire) return wire.model == "rod" and not wire:get().spin_inertia end

function twist.given(context)
  local why, rung = "there is no rod", 1
  for _, w in ipairs(context.data.wires) do
    if may_roll(w.object) then return nil end
    if w.object:get().spin_inertia then why, rung = ("as the script says, '%s' rolls"):format(w.name), 2 end
  end
  return why, rung
end

function twist.apply(context, rung, _, rungs)
  if rung ~= 2 then return end
  for _, w in ipairs(context.data.wires) do
    local mesh = section.takes(context, rungs.section, w.object) -- meshes roll by themselves
    if may_roll(w.object) and not mesh then core.redraw(w.object, true) end
  end
end

function twist.look(context, run)
  local met = context.data.touching and #context.scene:touches() > 0
  local f = { rubs = facts.rubbing(context.scene, run.start, context.seen), met = met, rods = 0, lever = 0 }
  f.flat = met or #f.rubs > 0
  for i, w in ipairs(context.data.wires) do
    if core.exists(w.object) and w.object.model == "rod" then
      f.rods, f.flat = f.rods + 1, f.flat and facts.flat(i)
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

--- Returns why wires must roll from here on, by what the run showed so far, or nil.
function twist.broken(f)
  if f.rods == 0 or f.flat then return nil end -- meshes roll by themselves
  if #f.rubs > 0 then return ("'%s' rubs"):format(f.rubs[1]) end
  return f.met and "wires touch each other" or nil
end

--- Lets wires roll from here on; raises an error for twisted wires, which would lose their twist.
function twist.onward(context)
  for _, w in ipairs(context.data.wires) do
    if may_roll(w.object) then core.redraw(w.object, true) end
  end
end

return twist
