-- SPDX-License-Identifier: GPL-3.0-or-later
--- The energy ledger of a run: work, stored energy, losses, and the gap that nothing explains.
-- @module softworld.run.ledger
local core = require "softworld.core"
local number = require "softworld.output.number"

local ledger = {}

local Ledger = { __name = "ledger" }
Ledger.__index = Ledger

local works = { "holds", "obstacles", "feeds", "forces", "changes" }
local losses = { "damping", "friction", "plasticity", "impact", "contact", "integrator", "jumps" }
local retries = { "redone", "halved", "accepted" }

local function listed(t, names)
  local parts = {}
  for _, name in ipairs(names) do
    if t[name] ~= 0 then parts[#parts + 1] = ("%s %s"):format(name, number.text(t[name], "J")) end
  end
  return #parts > 0 and table.concat(parts, ", ") or "none"
end

--- Returns the ledger as lines of text.
function Ledger:__tostring()
  local function text(x) return number.text(x, "J") end
  local lines = {
    ("energy at the start %s, now %s (kinetic %s, stored %s, gravity %s)"):format(text(self.at_start),
      text(self.total), text(self.kinetic), text(self.stored), text(self.gravity)),
    "  work of " .. listed(self.work, works),
    "  lost to " .. listed(self.lost, losses),
    ("  from nowhere %s; in play %s"):format(text(self.gap), text(self.play)),
  }
  for _, name in ipairs(retries) do
    local r = self[name]
    if r.count > 0 then
      lines[#lines + 1] = ("  %d of %s %s, the worst made %s at t = %s in %s near s = %.4g m"):format(
        r.count, number.count(self.steps, "step"), name, text(r.largest), number.text(r.time, "s"), r.object,
        r.s)
    end
  end
  return table.concat(lines, "\n")
end

--- Returns the ledger of a run [J]: kinetic, stored, gravity, total (now), at_start; work = { holds,
-- obstacles, feeds, forces, changes }; lost = { damping, friction, plasticity, impact, contact, integrator,
-- jumps }; gap (energy that nothing explains, summed over single steps), gained (beyond the work), play
-- (energy in play); steps; redone, halved, accepted = { count, largest, time [s], object, s [m] }.
function ledger.of(run)
  return run.books
end

--- Called at the end of a run: adds its ledger and events, and decides whether the run can be believed.
function ledger.close(run)
  local scene = run.scene
  if run.ok then
    local fine, why = core.end_run(scene)
    if not fine then run.ok, run.reason = false, why end
  end
  run.events = scene:events()
  run.books = setmetatable(core.ledger(scene), Ledger)
end

--- Adds the ledger's columns to the series.
function ledger.add(run, series, index)
  local rows, count = core.energy_log(run.scene)
  local columns = {}
  for k, name in ipairs{ "kinetic", "stored", "gravity", "gap", "lost" } do
    columns[k] = { name = "energy." .. name, unit = "J", values = {} }
  end
  for i = 0, count - 1 do
    local at = index[rows[6 * i + 1]]
    if at then
      for k, c in ipairs(columns) do c.values[at] = rows[6 * i + 1 + k] end
    end
  end
  for _, c in ipairs(columns) do series.columns[#series.columns + 1] = c end
end

--- Adds the ledger's line to the summary.
function ledger.report(run, add)
  local l = run.books
  add(("energy from nowhere (of %s in play)"):format(number.text(l.play, "J")), l.gap, "J")
end

return ledger
