-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of twist: in equilibrium between what holds the wires, or driven by friction too.
-- @module softworld.model.twist
local core = require "softworld.core"
local facts = require "softworld.model.facts"

local twist = { name = "twist", rungs = {
  { name = "held", as = "no rolling", leaves = "rolling, and twist by friction: it acts on the axis" },
  { name = "rolling", as = "rolling", leaves = "nothing" } } }

-- Can it be made one that rolls?
local function may_roll(wire) return wire.model == "rod" and not wire:get().spin_inertia end

function twist.given(context)
  local why, rung = "there is no rod", 1
  for _, w in ipairs(context.data.wires) do
    if may_roll(w.object) then return nil end
    if w.object:get().spin_inertia then why, rung = ("as the script says, '%s' rolls"):format(w.name), 2 end
  end
  return why, rung
end

function twist.apply(context, rung)
  if rung ~= 2 then return end
  for _, w in ipairs(context.data.wires) do
    if may_roll(w.object) then core.redraw(w.object, true) end
  end
end

function twist.look(context, run)
  local met = context.data.touching and #context.scene:touches() > 0
  return { rubs = facts.rubbing(context.scene, run.start), met = met }
end

function twist.free(_, rung, f)
  if rung == 1 and #f.rubs == 0 and not f.met then
    return "no friction torque: nothing with friction touches a wire"
  end
end

return twist
