-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks whether runs that choose their model give the same bits twice, and the same model for a wire that
-- is 1 % stiffer.
-- @module bench.autosteady
local autosteady = {}

local CHANGE = 0.01 -- relative change of the stiffness [-]
local MORE = 2      -- allowed relative change of a value over CHANGE [-]

local function bits(run)
  local text = tostring(run:why()):gsub(" took [%d.e-]+ s; the run took [%d.e-]+ s", "")
  return tostring(run:error_bars()) .. text
end

--- Compares the run `first` with two more runs by run_of(options). Returns { same = same bits, choice = same
-- model if stiffer, held = number of values within their error bars, rows = number of values, model = of the
-- repeated run }; nil if a run fails.
function autosteady.look(first, rungs_of, distance, size, run_of)
  local again, other = run_of { auto = true }, run_of { auto = true, stiffer = 1 + CHANGE }
  if not again or not other then return nil end
  local out = { same = bits(first) == bits(again), choice = rungs_of(first.model) == rungs_of(other.model),
    held = 0, rows = 0, model = again.model }
  for name, q in pairs(first.quantities) do
    local p = other.quantities[name]
    local within = p and distance(p.value, q.value) <= p.error + q.error + MORE * CHANGE * size(q.value)
    out.rows, out.held = out.rows + 1, out.held + (within and 1 or 0)
  end
  return out
end

return autosteady
