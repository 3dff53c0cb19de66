-- SPDX-License-Identifier: GPL-3.0-or-later
--- Records when the named steps of processes (p:step) happened, so that times can be named by them.
-- @module softworld.run.stages
local build = require "softworld.scene.build"

local stages = {}

--- Called when a step begins; its `to` is set when it ends. Steps of a repeated run are forgotten.
function stages.begin(scene, number, name)
  local data, list = build.data(scene), {}
  for _, stage in ipairs(data.stages or {}) do
    if stage.to and stage.to <= scene.time then list[#list + 1] = stage end
    if not stage.to and stage.from <= scene.time and stage.number ~= number then list[#list + 1] = stage end
  end
  local stage = { number = number, name = name, from = scene.time }
  list[#list + 1] = stage
  data.stages = list
  return stage
end

--- Returns the names of the steps at a time, or nil. A step includes the time at which it ends.
function stages.at(scene, time)
  local names = {}
  for _, stage in ipairs(build.data(scene).stages or {}) do
    if time > stage.from and time <= (stage.to or math.huge) then names[#names + 1] = stage.name end
  end
  return #names > 0 and table.concat(names, " + ") or nil
end

return stages
