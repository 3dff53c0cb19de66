-- SPDX-License-Identifier: GPL-3.0-or-later
--- The progress bar of a run. Of several runs inside one call (error bars, model = "auto") each may be short:
-- their time counts from the start of the call, and they share one line, which is removed at the end.
-- @module softworld.run.working
local core = require "softworld.core"
local progress = require "softworld.output.progress"

local working = {}

local AFTER = 1 -- computing time before the bar is shown [s]
local since     -- when the call with several runs began, nil outside of such a call [s]

--- Begins a call with several runs; close what it returns.
function working.several()
  local outer = since
  since = since or core.clock()
  return setmetatable({}, { __close = function() since = outer end })
end

--- Returns the bar of a run. level: its name if it is one of several.
function working.bar(args, scene, level)
  local host = package.loaded["softworld.host"]
  local wanted = args.progress
  local usual = wanted == nil -- on a terminal, for runs that take long
  if usual then wanted = host and host.terminal and os.getenv "TERM" ~= "dumb" end
  local shared = usual and level and since
  local after = shared and math.max(0, since + AFTER - core.clock()) or usual and AFTER or nil
  return progress.new{ total = args.duration and args.duration > 0 and args.duration or nil,
    name = level and ("%s, %s"):format(scene.name, level) or scene.name, quiet = not wanted, long = usual,
    after = after, passing = shared and true or nil,
    terminal = host and host.terminal or nil,
    clock = core.clock, width = host and host.columns or nil }
end

--- Shows the line while one of several runs is prepared: meshes, the equilibrium at its start. Close what it
-- returns.
function working.prepares(args, scene, level)
  local bar = working.bar(args, scene, level)
  if not bar.passing then return nil end
  bar:update(0, 0)
  return bar
end

return working
