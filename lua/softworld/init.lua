-- SPDX-License-Identifier: GPL-3.0-or-later
--- SoftWorld: simulation of the handling of wires, cables and flexible tubes.
--
--     local sw = require "softworld"
--     local scene = sw.scene{ name = "first" }
--     local wire = scene:wire{ E = 1e9, density = 1400, radius = 0.002,
--                              from = {0, 0, 0}, to = {1, 0, 0} }
--     scene:clamp(wire, { s = 0 })
--     scene:settle()
--     print(wire:position(wire.length).z)
--
-- SI units throughout; sw.units converts. sw.help() lists what there is.
-- @module softworld
-- First: it loads the others with these globals.
local _ENV = require "softworld.own" -- luacheck: ignore _ENV

local checks = require "softworld.checks"
local core = require "softworld.core"
local counts = require "softworld.calls.counts"
local inherited = require "softworld.inherited"
local build = require "softworld.scene.build" -- adds to the classes: names, files, drawing data
local methods = require "softworld.methods"
local record = require "softworld.scene.record" -- of calls, for scene:script and scene:describe
local remarks = require "softworld.remarks"
local rows = require "softworld.rows"
require "softworld.vector" -- fills the classes of the core's vectors

local sw = {
  version = core.version,
  core = core,
  units = require "softworld.units",
  trajectory = require "softworld.trajectory",
  cable = require "softworld.cable",
  shape = core.shape,
  remarks = true, -- false: no remarks on unusual values
}

require "softworld.wire.section"  -- wire:section and what belongs to it
require "softworld.run.process"  -- scene:process
require "softworld.run.window"   -- obstacle:over
local made = {
  gripper = require "softworld.grip.gripper", -- scene:gripper
  run = require "softworld.run.run",         -- scene:run
  clip = require "softworld.link.clip",       -- scene:clip
  channel = require "softworld.link.channel", -- scene:channel
  tie = require "softworld.link.tie",         -- scene:tie
}
require "softworld.link.clipping" -- gripper:clip
require "softworld.scene.settle"   -- scene:settle with error bars
require "softworld.scene.changes"  -- get and set of scenes and grippers
require "softworld.scene.leave"    -- scene:remove
require "softworld.scene.zone"     -- scene:zone
require "softworld.scene.find"     -- scene:find, scene:names, scene:wires, ...
local save = require "softworld.scene.save" -- scene:save, scene:resume

--- Returns a new scene. Parameters: { name =, gravity = {x, y, z} [m/s2] }
function sw.scene(args)
  if type(args) == "table" then remarks.gravity(rawget(args, "gravity")) end
  args = inherited.flat(args)
  local scene = build.call(3, core.scene, args)
  record.begin(scene, args)
  return scene
end

--- Returns the scene that scene:save, or a run with save = file, has written to a file.
function sw.load(file) return save.load(file) end

--- Writes one page that shows several runs moving, overlaid: { run1, run2, path = "x.html", title = }.
function sw.report(args)
  return require("softworld.run.files").report(args)
end

--- Returns the names of all cables of the catalogue; print shows them as a table.
function sw.cables() return sw.cable.list() end

rows.later(core.class.scene, "softworld.scene.script", "script")
rows.later(core.class.scene, "softworld.scene.describe", "describe")
rows.later(core.class.scene, "softworld.model.advise", "advise")
rows.later(core.class.scene, "softworld.run.pictures", "picture")
rows.later(core.class.scene, "softworld.view.view", "view")
rows.later(sw, "softworld.run.plot", "plot")
rows.later(sw, "softworld.study.study", "study")
rows.later(sw, "softworld.calibration.calibration", "calibration")
rows.later(sw, "softworld.check.compare", "compare")
rows.told("softworld.calls.scene softworld.calls.wire softworld.calls.obstacle softworld.calls.hold "
  .. "softworld.calls.trajectory softworld.calls.sw") -- rows of the core's own calls, and of sw's
counts.install()
record.install(made)

counts.guard("sw", sw)
counts.guard("sw.cable", sw.cable)
counts.guard("sw.trajectory", sw.trajectory)
for kind, class in pairs(made) do methods.guard_table(kind, class) end
methods.guard_core()

-- Modules that are loaded when first asked for.
local lazy = { tune = "softworld.run.tune", material = "softworld.wire.material",
  calibrate = "softworld.wire.calibrate", help = "softworld.prompt.help" }

local function unknown(self, key)
  local names = {}
  for _, list in ipairs { self, lazy } do
    for name in pairs(list) do names[#names + 1] = name end
  end
  table.sort(names)
  error(checks.lacks("softworld", key, names), 3)
end

return setmetatable(sw, { __index = function(self, key)
  if not lazy[key] then unknown(self, key) end
  local module = require(lazy[key])
  module = type(module) == "table" and counts.guard("sw." .. key, module)
    or counts.guarded(self, key, "sw." .. key, module)
  rawset(self, key, module)
  return module
end })
