-- SPDX-License-Identifier: GPL-3.0-or-later
--- When the named steps of processes were (p:step), so that a time can be told by them.
-- @module softworld.run.stages
local build = require "softworld.scene.build"

local stages = {}

--- A step begins; its `to` is set when it has ended. Those of a run that is repeated are forgotten.
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

--- Names of the steps that a time belongs to, or nil. The time at which one ends is its own.
function stages.at(scene, time)
  local names = {}
  for _, stage in ipairs(build.data(scene).stages or {}) do
    if time > stage.from and time <= (stage.to or math.huge) then names[#names + 1] = stage.name end
  end
  return #names > 0 and table.concat(names, " + ") or nil
end

return stages
