-- SPDX-License-Identifier: GPL-3.0-or-later
--- Tells whether a rung takes more iterations than the next one.
-- @module softworld.model.dearer
local probe = require "softworld.model.probe"

local dearer = {}

local GROWTH = 2 -- least iterations of a run over those of the level before [-]

--- Returns the rungs with another one for a choice.
function dearer.with(rungs, name, rung)
  local copy = {}
  for key, value in pairs(rungs) do copy[key] = value end
  copy[name] = rung
  return copy
end

-- Returns the rungs with the next one of a choice.
local function above_of(state, rungs) return dearer.with(rungs, state.choice.name, state.rung + 1) end

--- Returns the least iterations that the next rung of a choice needs on level k, from known computations, or
-- from one on the coarsest level; nil: it cannot be computed.
function dearer.iterations(context, state, rungs, k)
  local up = above_of(state, rungs)
  for j = k, 2, -1 do
    local above = probe.known(context, up, j)
    if above and above.ok then return GROWTH ^ (k - j) * above.iterations end
  end
  local above = probe.of(context, up, 1)
  return above.ok and GROWTH ^ (k - 1) * above.iterations or nil
end

--- True if the next rung of a choice needs no fewer iterations on level k than the given number. Wide steps
-- may show that at once, as they need fewer still.
function dearer.is_next(context, state, rungs, k, iterations)
  local up = above_of(state, rungs)
  local wide = state.choice.widen and probe.glance(context, up, 1, state.choice, iterations)
  if wide and GROWTH ^ (k - 1) * (wide.iterations or 0) >= iterations then return true end
  local above = dearer.iterations(context, state, rungs, k)
  return above ~= nil and above >= iterations
end

return dearer
