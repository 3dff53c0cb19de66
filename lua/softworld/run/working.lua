-- SPDX-License-Identifier: GPL-3.0-or-later
--- The progress bar of a run. Of several runs inside one call (error bars, model = "auto") each may be short:
-- their time counts from the start of the call, and they share one line, which is removed at the end.
-- @module softworld.run.working
local core = require "softworld.core"
local progress = require "softworld.output.progress"

local working = {}

local AFTER = 1 -- computing time before the bar is shown [s]
local since     -- when the call with several runs began, nil outside of such a call [s]
local choice    -- its progress: true, false, or nil

--- Begins a call with several runs; close what it returns. chosen: its progress: true, false, or nil.
function working.several(chosen)
  local outer, outer_choice = since, choice
  since, choice = since or core.clock(), chosen
  return setmetatable({}, { __close = function() since, choice = outer, outer_choice end })
end

-- Returns whether a bar is shown, and whether that is not the script's choice: then only on a terminal, for
-- work that takes long.
local function is_wanted(wanted, host)
  if wanted ~= nil then return wanted, false end
  return host and host.terminal and os.getenv "TERM" ~= "dumb", true
end

local function name_of(scene, level)
  return level and ("%s, %s"):format(scene.name, level) or scene.name
end

--- Returns { show =, clear =, name = } of a settle; show() shows how long it has taken, once the call has
-- taken a second; nil: it shows nothing. Close what it returns. level: its name if it is one of several.
function working.settles(wanted, scene, level)
  local host = package.loaded["softworld.host"]
  local line, start, self = nil, since or core.clock(), { name = name_of(scene, level) }
  local shown = is_wanted(wanted, host)
  if wanted == nil and choice ~= nil then shown = false end -- the lines of the call's runs are enough
  function self.show()
    if core.clock() - start < AFTER then return end
    line = line or progress.new{ name = self.name, timeless = "settling", since = start, clock = core.clock,
      terminal = host and host.terminal or nil, width = host and host.columns or nil }
    line:update()
  end
  function self.clear()
    if line then line:clear() end
  end
  if not shown then self.show = nil end
  return setmetatable(self, { __close = self.clear })
end

--- Returns the bar of a run. level: its name if it is one of several.
function working.bar(args, scene, level)
  local host = package.loaded["softworld.host"]
  local wanted, usual = is_wanted(args.progress, host)
  local shared = usual and level and since
  local after = shared and math.max(0, since + AFTER - core.clock()) or usual and AFTER or nil
  return progress.new{ total = args.duration and args.duration > 0 and args.duration or nil,
    name = name_of(scene, level), quiet = not wanted, long = usual,
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
