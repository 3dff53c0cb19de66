-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs a script up to the first step of its first scene, builds the scene again from scene:script, and runs
-- both for three steps: softworld rebuilt.lua SCRIPT [arguments]
local sw = require "softworld"
local core = sw.core

local file = table.remove(arg, 1)
rawset(arg, 0, file)
local run = core.class.scene.run
local last

-- Positions and velocities of all wires and particles, with their bits.
local function state(scene)
  local made = run(scene, { duration = 0.003, dt = 0.001 })
  local values = { made.ok, scene.time }
  for _, kind in ipairs{ "wires", "particles" } do
    for _, entry in ipairs(core.data(scene)[kind]) do
      for _, list in ipairs{ entry.object:positions(), entry.object:velocities() } do
        table.move(list, 1, #list, #values + 1, values)
      end
    end
  end
  for i, value in ipairs(values) do
    values[i] = type(value) == "number" and ("%a"):format(value) or tostring(value)
  end
  return table.concat(values, "\n"), #values
end

local function same(scene)
  core.data(scene).processes = {}
  local text = scene:script()
  local again = assert(load(text, "=rebuilt"))()
  local one, count = state(scene)
  print(("%s: %d values, %s"):format(scene.name, count, one == state(again) and "THE SAME" or "DIFFERENT"))
  os.exit(true)
end

for _, name in ipairs{ "run", "advance" } do
  core.class.scene[name] = function(scene) same(scene) end
end
local new = sw.scene
sw.scene = function(args)
  last = new(args)
  return last
end
local study = sw.study
sw.study = function(args) -- so that its scenes are made in this process
  args.workers = 0
  return study(args)
end
assert(loadfile(file))(table.unpack(arg))
same(last)
