-- SPDX-License-Identifier: GPL-3.0-or-later
--- The rows of a run's summary: loads of grippers, bending and tension of wires, fixings, energies and error
-- bars.
-- @module softworld.run.summary
local core = require "softworld.core"
local build = require "softworld.scene.build"
local fixing = require "softworld.link.fixing"
local ledger = require "softworld.run.ledger"
local number = require "softworld.output.number"
local sealed = require "softworld.sealed"
local window = require "softworld.run.window"

local summary = {}

-- Events of grippers that the summary shows, with their time.
local told = {
  slip = function() return "the wire SLIPS since" end,
  lost = function() return "the wire is LOST since" end,
  crash = function(e) return ("%s RUNS INTO %s at"):format(e.part, e.obstacle) end,
}

-- Adds the rows of grippers; add(label, value, unit, s, t, note) adds one row.
local function sum_up_grippers(self, data, add)
  for _, g in ipairs(data.grippers) do
    local m = g:over(self.start, self.time)
    add(g.name .. ": peak force", m.peak_force, "N", nil, m.peak_force_time, m.peak_force_note)
    add(g.name .. ": mean force", m.mean_force, "N")
    add(g.name .. ": peak moment", m.peak_moment, "N m", nil, m.peak_moment_time, m.peak_moment_note)
    add(g.name .. ": mean moment", m.mean_moment, "N m")
    if m.peak_squeeze then add(g.name .. ": largest squeeze per finger", m.peak_squeeze, "N") end
    if m.peak_margin then
      add(g.name .. ": largest share of the pads' friction (1: slips)", m.peak_margin, "", nil,
        m.peak_margin_time)
    end
    for _, e in ipairs(g.events) do
      if told[e.kind] and e.time >= self.start and e.time <= self.time then
        add(("%s: %s"):format(g.name, told[e.kind](e)), e.time, "s", e.s, e.time)
      end
    end
  end
end

local STRAIGHT = 1e6 -- a radius of more lengths than this is rounding [-]

local function sum_up_wires(self, data, add)
  for _, w in ipairs(data.wires) do
    local radius, s, t = w.object:min_bend_radius()
    local label = w.name .. ": smallest bend radius of the centre line"
    if w.object:cable() then
      local allowed = w.object:bend_limit()
      label = ("%s (limit %s, %s%s)"):format(label, number.text(allowed.limit, "m"), allowed.use,
        allowed.ok and "" or ", EXCEEDED")
    end
    if radius > STRAIGHT * w.object.length then add(label, "straight", "")
    else add(label, radius, "m", s, t) end
    local tension, note
    tension, s, t, note = window.tension(self.scene, w.object)
    add(w.name .. ": largest tension", tension, "N", s, t, note)
    s, t = w.object:folded()
    if s then
      add(w.name .. ": section FOLDED through itself, its forces are wrong since", t, "s", s, t)
    end
  end
end

local function bar_of(q)
  local is_number = type(q.value) == "number"
  return { label = q:label(), value = is_number and q.value or q:text(), unit = is_number and q.unit or "",
    where = ("+- %s%s"):format(number.text(q.error, q.unit), q.met and "" or " (NOT as asked)")
      .. (q.note and (" (%s)"):format(q.note) or "") }
end

--- Returns rows { label, value, unit, where, when } of a run, as long as its scene stays as it is.
function summary.of(self)
  local data, rows = build.data(self.scene), {}
  local function add(label, value, unit, s, t, note)
    local where = s and ("s = %.4g m"):format(s) or nil
    if note then where = ("%s(%s)"):format(where and where .. " " or "", note) end
    rows[#rows + 1] = { label = label, value = value, unit = unit, where = where, when = t }
  end
  sum_up_grippers(self, data, add)
  local settled = sealed.fields(self).settled
  if settled then add("scene:settle: peaks of wires are of the time after", settled, "s") end
  sum_up_wires(self, data, add)
  if #data.obstacles > 0 then
    local depth, s, t = self.scene:penetration()
    add("deepest penetration", depth, "m", s, t)
  end
  for _, f in ipairs(fixing.all(self.scene)) do f:report(add) end
  ledger.report(self, add)
  local thinned = core.frames_thinned(self.scene)
  if thinned > 1 then
    add("frames: one of this many is kept, to save memory", thinned, "-", nil, nil,
      "see frames = { memory = }")
  end
  for _, q in ipairs(self.quantities and self:error_bars() or {}) do rows[#rows + 1] = bar_of(q) end
  return rows
end

return summary
