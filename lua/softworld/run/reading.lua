-- SPDX-License-Identifier: GPL-3.0-or-later
--- Calls a script's function that reads a run which has ended. The scene must not run meanwhile: what is read
-- after it would be of another motion.
-- @module softworld.run.reading
local build = require "softworld.scene.build"

local reading = {}

--- Returns what pcall(f, ...) returns. what: of what f is the function `of`, and what to read instead of
-- another run, for reading.check.
function reading.call(scene, what, instead, f, ...)
  local data = build.data(scene)
  local before = data.read
  data.read = { what = what, instead = instead }
  local results = table.pack(pcall(f, ...))
  data.read = before
  return table.unpack(results, 1, results.n)
end

--- Raises an error if such a function is being called.
function reading.check(scene)
  local read = build.data(scene).read
  if not read then return end
  error(("scene:run: scene '%s' cannot be run inside the function `of` of %s: that function reads a run that "
    .. "has ended; %s"):format(scene.name, read.what, read.instead), 0)
end

return reading
