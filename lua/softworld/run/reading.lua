-- SPDX-License-Identifier: GPL-3.0-or-later
--- Calls a script's function that reads a run which has ended. The scene must not run or change meanwhile:
-- what is read after it would be of another motion or another scene.
-- @module softworld.run.reading
local blame = require "softworld.scene.blame"
local build = require "softworld.scene.build"
local core = require "softworld.core"

local reading = {}

-- Raises an error, which also goes to the caller of the function. call: the name of the refused call.
local function refuse(read, scene, call)
  read.refused = ("%s: scene '%s' cannot be %s inside the function `of` of %s: that function reads a "
    .. "run that has ended; %s"):format(call, scene.name, call == "scene:run" and "run" or "changed",
    read.what, read.instead)
  error(read.refused, 0)
end

--- Returns true if only another model of a wire has something that f asked for, then what pcall(f, ...)
-- returns; raises an error if f tried to run or change the scene. what: of what f is the function `of`, and
-- what to read instead. Methods of the library are refused by build.check, with their names; the core refuses
-- every other change.
function reading.call(scene, what, instead, f, ...)
  local data = build.data(scene)
  local before, now = data.read, { what = what, instead = instead }
  function now.refuse(call) refuse(now, scene, call) end
  core.begin_review(scene, what, instead)
  data.read = now
  local results = table.pack(pcall(f, ...))
  data.read = before
  local refused, unlike = core.end_review(scene)
  refused = refused or now.refused
  if refused then blame.fault(results[1] and refused or results[2]) end
  return unlike, table.unpack(results, 1, results.n)
end

return reading
