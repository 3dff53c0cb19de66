-- SPDX-License-Identifier: GPL-3.0-or-later
-- What the specs of saved scenes share: all that can be read of a scene, and files.
local sw = require "softworld"
local sink = require "softworld.output.sink"

local saving = { cases = require "scene.saving_cases" }

--- Returns a new name for a file.
function saving.file() return os.tmpname() end

function saving.read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read "a"
end

function saving.write(path, bytes)
  local file <close> = assert(io.open(path, "wb"))
  assert(file:write(bytes))
end

local function add(all, value)
  if type(value) == "number" then
    all[#all + 1] = value == value and value or "nan"
  elseif type(value) == "table" then
    local keys = {}
    for key in pairs(value) do keys[#keys + 1] = key end
    table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
    for _, key in ipairs(keys) do add(all, value[key]) end
  else
    all[#all + 1] = tostring(value)
  end
end

local readers = {
  wire = function(all, wire)
    for _, list in ipairs{ (wire:positions()), (wire:velocities()) } do add(all, list) end
    for k = 0, 7 do
      local known, moment = pcall(wire.twist_moment, wire, wire.length * k / 7) -- not of strings
      add(all, { wire:tension(wire.length * k / 7), known and moment or 0 })
    end
    add(all, { wire:min_bend_radius() })
    add(all, { wire:max_tension() })
    add(all, { wire:max_tension{ raw = true } })
  end,
  particles = function(all, object)
    add(all, (object:positions()))
    add(all, (object:velocities()))
    add(all, object:energy())
  end,
  clamp = function(all, clamp)
    add(all, { clamp:pose() })
    add(all, (clamp:log()))
    if clamp.held then add(all, { clamp:force(), clamp:moment() }) end
    if clamp.held and clamp.kind == "feed" then add(all, { clamp:fed(), clamp:drive_force() }) end
  end,
  obstacle = function(all, obstacle)
    if obstacle.present then add(all, { obstacle:pose() }) end
    add(all, { obstacle.present and obstacle:force(), (obstacle:log()) })
  end,
  join = function(all, join) if join.held then add(all, { join:force(1), join:moment(2) }) end end,
  tie = function(all, tie) add(all, { tie:exists() }) end,
  clip = function(all, clip) add(all, { clip:exists(), clip:force() }) end,
  gripper = function(all, gripper)
    add(all, gripper:over())
    add(all, gripper:series())
  end,
}

--- Returns everything that can be read of a scene, as one list of numbers and words.
function saving.all(scene)
  local all = { scene.name }
  add(all, scene.time)
  for _, name in ipairs(scene:names()) do
    local object = scene:find(name)
    all[#all + 1] = name
    readers[sw.core.type(object) or getmetatable(object).__name](all, object)
  end
  add(all, scene:energy())
  add(all, { scene:penetration() })
  add(all, scene:contacts())
  for i = 1, scene:frame_count() do add(all, scene:frame(i)) end
  return all
end

--- Returns where two lists of saving.all differ first; nil: nowhere.
function saving.difference(a, b)
  if #a ~= #b then return ("%d and %d values"):format(#a, #b) end
  for i = 1, #a do
    if a[i] ~= b[i] then return ("value %d of %d: %s and %s"):format(i, #a, a[i], b[i]) end
  end
end

-- --- what the specs of files share ------------------------------------------------------

local files = {}
--- Returns a name for a file that saving.clean removes after the test.
function saving.temporary()
  files[#files + 1] = saving.file()
  return files[#files]
end

function saving.clean()
  for _, name in ipairs(files) do os.remove(name) end
  files = {}
end

--- Checks that f raises an error with all these texts in it; returns the error.
function saving.fails(texts, f, ...)
  local fine, message = pcall(f, ...)
  assert(not fine, "no error")
  message = tostring(message)
  for _, text in ipairs(type(texts) == "table" and texts or { texts }) do
    assert(message:find(text, 1, true), ("'%s' is not in: %s"):format(text, message))
  end
  return message
end

--- Checks that two lists of saving.all are the same.
function saving.same(a, b)
  local where = saving.difference(a, b)
  assert(not where, where)
end

--- Returns a script: its scene, objects and processes. more(p, c) runs at the end of the first process.
function saving.script(more)
  local c = { log = {}, scene = sw.scene{ name = "laying" } }
  c.scene:obstacle{ shape = "plane", friction = 0.3 }
  c.wire = c.scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.0021 }, to = { 0.6, 0, 0.0021 },
    segments = 30 }
  c.left = c.scene:gripper{ name = "left" }
  local function step(p, name, work)
    return p:step(name, function()
      c.log[#c.log + 1] = name
      return work()
    end)
  end
  c.scene:process(function(p)
    step(p, "grasp", function() c.left:grasp(c.wire, { s = 0.02 }) end)
    c.end_of_lift = step(p, "lift", function()
      c.left:move{ by = { 0.05, 0, 0.1 }, duration = 0.3 }
      return c.wire:position(0.6), c.left
    end)
    step(p, "back", function()
      c.left:move{ by = { 0, 0.05, -0.05 }, duration = 0.15 }
      p:wait(0.05)
    end)
    step(p, "release", function() c.left:release() end)
    step(p, "again", function()
      c.left:grasp(c.wire, { s = 0.3 })
      c.left:move{ by = { 0, 0, 0.05 }, duration = 0.1 }
    end)
    if more then more(p, c, step) end
  end)
  return c
end

--- Runs the scene; returns the files that the run wrote, one after each step, and the run.
function saving.files_of(c, args)
  local written, write = {}, sink.write_file
  sink.write_file = function(path, bytes)
    written[#written + 1] = bytes
    return write(path, bytes)
  end
  local fine, done = pcall(c.scene.run, c.scene, args)
  sink.write_file = write
  assert(fine, done)
  return written, done
end

return saving
