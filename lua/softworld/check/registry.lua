-- SPDX-License-Identifier: GPL-3.0-or-later
--- The checks of run:check, in the order of its rows: one file per check, one line here.
--
-- A member: { name =, unit =, side = "min" or "max", label =, on = "wire", "gripper", "clip", "tie" or
-- "run", edges =, peaks =, places =, asked =, missing =, value =, limit =, terms =, reference =, wanted = }.
-- asked: judged only if the script gives a limit, or wanted(context) is true. missing: name of the missing
-- value if no limit is known. edges: "low", "high" or "both", the side to which the value may be off where a
-- wire's edges are too long for a bend (softworld.check.edges). peaks: true if the value is a peak of the
-- motion, which an event may doubt (softworld.check.doubted); places: true if it is a place, or the shape
-- there.
-- Functions take the object's entry { name =, object = } and the context { run =, scene =, use =, ... }:
--   value: { value =, s = [m], time = [s], note =, low =, high = }; low and high bound the value if it is
--     not known exactly; nil if there is nothing to judge
--   limit: { value =, low =, high =, from = "catalogue", "standard" or "definition", source = }, or nil
--   terms: size of the terms whose difference the value is [unit], see softworld.check.terms
--   reference: a usual limit of this kind, to detect limits in other units
-- @module softworld.check.registry
local registry = {}

local files = { "bend_radius", "end_bend_radius", "tension", "strain", "stress", "sidewall", "torsion",
  "ovalisation", "fatigue", "friction_work", "wear_depth", "landing", "clearance", "max_temperature",
  "min_temperature", "frequency_gap", "vibration_amplitude",
  "peak_force", "peak_moment", "mean_force", "slip", "pad_load", "opening",
  "insertion_force", "retention_used", "seated", "strength_used",
  "penetration", "kinks", "spoilt", "cycle_time" }

registry.list, registry.by_name = {}, {}
for i, file in ipairs(files) do
  local member = require("softworld.check." .. file)
  registry.list[i], registry.by_name[member.name] = member, member
end

return registry
