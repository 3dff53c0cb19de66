-- SPDX-License-Identifier: GPL-3.0-or-later
--- Ties: keep a place of a wire at a fixed point, or at a place of another wire, up to a slack, until the
-- pull exceeds the tie's strength.
--
--     local tie = scene:tie(wire, { s = 0.3, to = { 0.3, 0, 0.05 }, strength = 80 })
--     local pair = scene:tie(wire, { s = 0.5, to = { other, s = 0.5 } })
--     print(tie:tension(), pair.peak_force, tie.broken and tie.broken.time)
--
-- In the core it is the force `tether`, or a join with slack.
-- @module softworld.link.tie
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local core = require "softworld.core"
local fixing = require "softworld.link.fixing"
local loads = require "softworld.run.loads"
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
local window = require "softworld.run.window"
local vec = require "softworld.vec"
local vector = require "softworld.vector"

local properties = {}
local Tie = fixing.class("tie", properties, { "other", "strength", "ended" })
local STIFFNESS = 1e5 -- default, of a nylon tie round a few millimetres [N/m]

local new = rows.call("scene:tie", "wire, {...}", "keeps a place of a wire at a point or at another wire", {
  gives = "a tie", example = "scene:tie(wire, { s = 0.5, to = { 0, 0, 0.1 }, strength = 80 })",
  { "name", "text", "-", "name in messages", usual = "tie1, ..." },
  { "s", "number", "m", "place along the wire", min = 0, required = true },
  { "to", "point or { wire, s = }", "m", "the other end: a point, or a place of another wire (rod or string)",
    usual = "where it is now" },
  { "slack", "number", "m", "distance below which it does not pull", min = 0, usual = "the present one" },
  { "stiffness", "number", "N/m", "beyond the slack", min = 0, above = true, max = 1e12,
    default = STIFFNESS },
  { "strength", "number", "N", "pull at which it breaks", min = 0, above = true, usual = "never" },
})
local other_end = rows.list{
  { 1, "wire", "-", "the other one" },
  { "s", "number", "m", "place along it", min = 0, required = true },
}

rows.calls{
  { "tie:tension", "", "its pull now; 0 while it is slack or broken", "N" },
  { "tie:distance", "", "of the tied places", "m" },
  { "tie:force", "", "on the wire that was tied", "{x, y, z} [N]" },
  { "tie:release", "", "cuts it" },
  { "tie.name", nil, "name in messages" },
  { "tie:exists", "", "whether it is still in the scene", "true or false" },
  { "tie.peak_force", nil, "largest mean of its pull over the run's window, so far", "N" },
  { "tie.raw_peak_force", nil, "largest pull of a single step so far; its strength is compared with this",
    "N" },
  { "tie.strength", nil, "pull at which it breaks", "N, or nil: never" },
  { "tie.broken", nil, "how it broke", "nil, or time [s], force [N]" },
}

local over = rows.call("tie:over", "t1, t2, {...}",
  "its pull between two times [s]; without times, of the whole series", {
  gives = "peak_force, mean_force [N], impulse, impulse_size [N s], duration, times of the peaks [s]; "
    .. "raw_peak_force, ... of single steps; see help 'peaks'",
  { "window", "number", "s", "time over which the mean is taken whose peak is given", min = 0,
    usual = "that of the run" },
})

-- Returns the place that a tie holds: on the chord between two nodes. wire:position is on the curve through
-- them, by k h^2/8 further out for a curvature k and edges h; a tie of that length would begin with a pull.
local function place(what, wire, s, whose)
  if s > wire.length * (1 + 1e-12) then
    error(("%s: %ss = %.6g m is beyond the end of wire '%s' at %.6g m"):format(what, whose, s, wire.name,
      wire.length), 0)
  end
  return core.chord(wire, math.min(s, wire.length))
end

-- Reads to = { wire, s = }: returns the wire, s and its position.
local function other_wire(scene, what, to)
  other_end:read(to, what .. ": to", what .. ": to.")
  local other = fixing.wire(scene, what, "to[1]", to[1])
  return other, to.s, place(what, other, to.s, "to.")
end

local function checked(scene, wire, args)
  local what
  if core.type(args) == "wire" then
    error("scene:tie takes a wire and one table of parameters; another wire is in it: to = { wire, s = 0.2 }",
      0)
  end
  fixing.wire(scene, "scene:tie", "the first argument", wire)
  args, what = fixing.arguments(scene, new, "tie", args)
  local here = place(what, wire, args.s, "")
  local there
  if type(args.to) == "table" and (type(args.to[1]) == "userdata" or args.to.s ~= nil) then
    args.other, args.other_s, there = other_wire(scene, what, args.to)
  else
    args.to = checks.vector(what .. ": to", args.to == nil and here or args.to, "m", 0)
    there = args.to
  end
  local apart = vec.norm(vec.add(here, there, -1))
  args.slack = args.slack or apart
  remarks.tie(what, apart, args)
  return args
end

--- scene:tie(wire, { s =, to = {x, y, z} or { wire, s = }, slack =, strength = }): see help "tie".
fixing.made(Tie, function(scene, wire, given)
  local a = checked(scene, wire, given)
  local self = { name = a.name, wire = wire, s = a.s, other = a.other, strength = a.strength }
  if a.other then
    local fine, made = pcall(scene.join, scene, { ends = { { wire, s = a.s }, { a.other, s = a.other_s } },
      slack = a.slack, stiffness = a.stiffness, strength = a.strength, name = a.name })
    if not fine then error(made:gsub("scene:join: ", ("tie '%s': "):format(a.name), 1), 0) end
    self.object = made
  else
    self.object = scene:force{ kind = "tether", on = wire, s = a.s, to = a.to, slack = a.slack,
      stiffness = a.stiffness, strength = a.strength }
  end
  return self
end)

function Tie:exists() return core.exists(self.object) and self.object.held end

local function reading(self)
  fixing.check(self)
  if self.other then return self.object:read() end
  return self.object:read(self.wire)
end

--- Returns the pull of the tie [N]; 0 while it is slack and after it broke.
function Tie:tension() return reading(self).tension end

--- Returns the distance of the tied places [m].
function Tie:distance() return reading(self).distance end

--- Returns the force on the wire that was tied (not on the other one) [N].
function Tie:force()
  if self.other then return self.object:force(1) end
  local r = reading(self)
  return vector.of{ r.force_x, r.force_y, r.force_z }
end

--- Cuts the tie. What it has measured stays.
function Tie:release()
  require("softworld.check.released").note(self, "tie")
  local r = reading(self)
  local broken = r.broken > 0 and { time = r.broken_time, force = r.broken_force } or false
  self.ended = { broken = broken, raw_peak_force = r.peak,
    peak_force = build.data(self.scene).began and self:over().peak_force or r.peak }
  self.object:release()
end

-- Returns what the tie had measured when it was released, or nil: it was not, or it is back with a snapshot.
local function ended(self) return not self:exists() and self.ended or nil end

--- Returns the pull between two times; see help "peaks".
function Tie:over(t1, t2, options)
  fixing.check(self)
  options = options == nil and {} or over:read(options)
  t1, t2 = window.interval(self.scene, t1, t2, "tie:over", 2)
  local log, spans = loads.forces(self.object:log(t1, t2))
  return (loads.over(log, spans, { t1 = t1, t2 = t2, forces_only = true,
    width = window.of(self.scene, options.window, "tie:over", 2) }))
end

--- Largest mean of the pull over the run's window so far [N].
function properties.peak_force(self)
  local last = ended(self)
  return last and last.peak_force or self:over().peak_force
end

--- Largest pull of a single step so far, which is compared with the strength [N].
function properties.raw_peak_force(self)
  local last = ended(self)
  return last and last.raw_peak_force or reading(self).peak
end

--- { time = [s], force = [N] } once it broke, or nil.
function properties.broken(self)
  local last = ended(self)
  if last then return last.broken or nil end
  local r = reading(self)
  return r.broken > 0 and { time = r.broken_time, force = r.broken_force } or nil
end

--- Adds rows to a run's summary.
function Tie:report(add)
  local broken = self.broken
  if broken then
    add(self.name .. ": BROKE at", broken.force, "N", nil, broken.time)
  else
    local m = self:over()
    add(self.name .. ": largest pull", m.peak_force, "N", self.s, m.peak_force_time, m.peak_force_note)
  end
end

function Tie:__tostring()
  if not self:exists() then return ("tie '%s' (released)"):format(self.name) end
  local ok, r = pcall(reading, self)
  return ("tie '%s' of '%s' at s = %.4g m%s%s"):format(self.name, self.wire.name, self.s,
    self.other and (" to '%s'"):format(self.other.name) or "",
    ok and (r.broken > 0 and ", broken" or (": %.4g N"):format(r.tension)) or "")
end

return Tie
