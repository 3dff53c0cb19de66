-- SPDX-License-Identifier: GPL-3.0-or-later
--- Calls a script's function that reads a run which has ended. The scene must not run meanwhile: what is read
-- after it would be of another motion.
-- @module softworld.run.reading
local build = require "softworld.scene.build"

local reading = {}

--- Returns what pcall(f, ...) returns; raises an error if f tried to run the scene. what: of what f is the
-- function `of`, and what to read instead of another run, for reading.check.
function reading.call(scene, what, instead, f, ...)
  local data = build.data(scene)
  local before, now = data.read, { what = what, instead = instead }
  data.read = now
  local results = table.pack(pcall(f, ...))
  data.read = before
  if now.refused then error(results[1] and now.refused or results[2], 0) end
  return table.unpack(results, 1, results.n)
end

--- Raises an error if such a function is being called.
function reading.check(scene)
  local read = build.data(scene).read
  if not read then return end
  read.refused = ("scene:run: scene '%s' cannot be run inside the function `of` of %s: that function reads a "
    .. "run that has ended; %s"):format(scene.name, read.what, read.instead)
  error(read.refused, 0)
end

return reading
