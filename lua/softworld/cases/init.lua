-- SPDX-License-Identifier: GPL-3.0-or-later
--- Named scenes with known answers, for specs, benchmarks and examples.
--
--     local cases = require "softworld.cases"
--     local c = cases.release{ segments = 20, gamma = 10 }
--     local run = c.run{ dt = 0.005 }
--     print(run.cpu, c.error())
--
-- Every case is a function of options that returns a table:
--   name, scene, wire, clamp      what was built
--   run(options)                  computes it: scene:settle or scene:run options
--   error()                       one number, [-] (over the length unless said otherwise)
--   exact                         reference values and their source
--   measured()                    the same quantities as computed (static cases)
-- Options of every case: segments, model, gravity = {x, y, z} [m/s2] (the scene is
-- turned so that it hangs along it), rotation = {w, x, y, z} (turn of the whole
-- scene, gravity included), at = {x, y, z} [m].
-- @module softworld.cases
local cases = {}
for _, name in ipairs{ "droop", "end_load", "release", "transport", "catenary", "lift", "column",
  "incline", "push", "cord", "laying", "arc" } do
  cases[name] = setmetatable({}, { __call = function(_, options)
    return require("softworld.cases." .. name)(options or {})
  end })
end

--- Returns the names of all cases, sorted.
function cases.names()
  local list = {}
  for name, case in pairs(cases) do
    if type(case) == "table" then list[#list + 1] = name end
  end
  table.sort(list)
  return list
end

return cases
