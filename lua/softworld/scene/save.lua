-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes in files: scene:save, scene:resume, sw.load.
--
--     scene:process(function(p)
--       p:step("grasp", function() left:grasp(wire, { s = 0.02 }) end)
--       p:step("lay", function() left:move{ by = {0.3, 0, 0}, speed = 0.2 } end)
--     end)
--     scene:run{ save = "laying.sws", resume = "laying.sws" }
--
-- writes the scene after every step. If the script is killed and started again, it builds the scene, takes
-- the state from the file, skips the steps already done and continues with the same bits.
-- @module softworld.scene.save
local core = require "softworld.core"
local build = require "softworld.scene.build"
local keep = require "softworld.scene.keep"
local process = require "softworld.run.process"
local settings = require "softworld.run.settings"
local turns = require "softworld.run.turns"
local unread = require "softworld.unread"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"

local save = {}
local class = core.class

-- Fields of build.data that the file's data leaves out; the file stores the origin separately.
local passing = { origin = true }
for key in pairs(build.passing) do passing[key] = true end

-- --- what a script has made -----------------------------------------------------------

-- Returns every object and every table of a class within the data, by class and number or name.
local function known(data)
  local found = keep.instances(data)
  local seen = {}
  local function walk(t)
    if seen[t] then return end
    seen[t] = true
    for key, value in next, sealed.fields(t) do
      if type(value) == "table" and key ~= "processes" then walk(value) end
      if type(value) == "userdata" and core.type(value) ~= "scene" then
        local kind, slot, generation = core.number(value)
        if kind then found[("%s %d %d"):format(kind, slot, generation)] = value end
      end
    end
  end
  walk(data)
  return found
end

--- Returns what the scene is made of when its first run begins: { name, sum, name, sum, ... }.
function save.origin(scene)
  local data = build.data(scene)
  if data.origin then return data.origin end
  local list = core.items(scene)
  local instances, names = keep.instances(data), {}
  for name in pairs(instances) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    local fine, text = keep.may(instances[name], scene, name)
    list[#list + 1] = name:gsub(" (.*)$", " '%1'")
    list[#list + 1] = fine and text or 0
  end
  list[#list + 1], list[#list + 2] = "gravity", keep.pack(scene:gravity(), scene, "gravity")
  return list
end

-- --- writing ---------------------------------------------------------------------------

-- Returns the obstacles without triangles; reading makes them again from the shapes.
local function without_triangles(obstacles)
  local list = {}
  for i, entry in ipairs(obstacles) do
    list[i] = {}
    for key, value in pairs(entry) do
      if key ~= "vertices" and key ~= "indices" then list[i][key] = value end
    end
  end
  return list
end

-- Returns the Lua data of each object, such as its cable.
local function beside(data)
  local list = {}
  for _, name in ipairs{ "wires", "particles", "obstacles", "holds" } do
    for _, entry in ipairs(data[name]) do
      local own = core.data(entry.object)
      if next(own) ~= nil then list[#list + 1] = { object = entry.object, own = own } end
    end
  end
  return list
end

local function note_of(scene, run)
  local data, kept = build.data(scene), {}
  for key, value in pairs(data) do
    if not passing[key] then kept[key] = value end
  end
  kept.obstacles = without_triangles(data.obstacles)
  return keep.pack({ origin = save.origin(scene), data = kept, beside = beside(data), run = run,
    closed = core.frames_closed(scene) or nil }, scene, ("scene '%s'"):format(scene.name))
end

-- Stores the frame of a run's end again, which files leave out. Lua functions as forces are missing yet.
local function close_frames(scene, note)
  if note.closed then pcall(core.close_frames, scene) end
end

--- Writes the scene to a file, whole or not at all, even if the computer goes down; run: the
-- totals of a run under way.
function save.write(scene, file, run)
  return sink.write_file(file, build.call(3, core.save, scene, note_of(scene, run)), { safe = true })
end

-- Raises an error if a process is under way: its state is in a coroutine, which cannot be saved.
local function check_processes(scene)
  for _, p in ipairs(build.data(scene).processes) do
    if p.begun and coroutine.status(p.thread) ~= "dead" then
      error(("scene '%s' cannot be saved: %s is under way; run it to its end, or let the run write the scene "
        .. "after every step: scene:run{ save = 'file' }"):format(scene.name, tostring(p)), 0)
    end
  end
end

local function check_file(what, file)
  if type(file) ~= "string" or file == "" then
    error(("%s: the name of a file is wanted, got %s"):format(what, file == "" and "''" or type(file)), 0)
  end
end

-- Refuses to save during a run; seen: true in an observer's function.
local function refuse(scene, seen)
  error(("scene:save: a run of scene '%s' is under way, and a scene can be saved only between runs: call it "
    .. "after scene:run has returned%s; scene:run{ save = 'file' } writes the scene after every step "
    .. "(process:step) of its processes"):format(scene.name, seen and ". To save the state of this moment, "
    .. "take a scene:snapshot() here, and scene:restore it after the run" or ""), 0)
end

local function save_now(scene, file)
  check_file("scene:save", file)
  local data = build.data(scene)
  if data.running then refuse(scene, false) end
  check_processes(scene)
  data.origin = save.origin(scene)
  return save.write(scene, file, data.going)
end

--- scene:save(file): writes the whole state of the scene, for scene:resume and sw.load.
function class.scene.save(scene, file)
  if core.type(scene) == "scene" then
    local busy, seen = build.call(3, core.busy, scene)
    if busy then build.call(3, refuse, scene, seen) end
  end
  build.check(scene, "scene:save", 3)
  unread.used(build.data(scene))
  return build.call(3, save_now, scene, file)
end

-- --- reading ---------------------------------------------------------------------------

local function read(what, file)
  check_file(what, file)
  return sink.read_file(file)
end

-- Calls f and rewrites its errors. Errors of the core say "it is ...".
local function tell(what, file, f, ...)
  local fine, result = pcall(f, ...)
  if fine then return result end
  error(("%s: '%s' cannot be read: %s"):format(what, file, (tostring(result):gsub("^[^\n:]+:%d+: ", ""))), 0)
end

local lists = { "wires", "particles", "obstacles", "holds", "grippers", "joins" }

local function expect(good, what)
  if not good then error(("its content is damaged (%s)"):format(what), 0) end
end

local function is_list(t) return type(t) == "table" and getmetatable(t) == nil end

local function check_lists(data)
  for _, name in ipairs(lists) do
    expect(is_list(data[name]), name)
    for _, entry in ipairs(data[name]) do
      expect(type(entry) == "table" and type(rawget(sealed.fields(entry), "name")) == "string", name)
      if name ~= "grippers" then expect(type(rawget(entry, "object")) == "string", name) end
    end
  end
end

local function check_steps(data)
  expect(data.ended == nil or is_list(data.ended), "processes")
  expect(data.done == nil or is_list(data.done), "steps")
  for number, done in pairs(data.done or {}) do
    expect(math.type(number) == "integer" and is_list(done), "steps")
    for _, step in ipairs(done) do
      expect(is_list(step) and type(step.name) == "string" and is_list(step.results)
        and math.type(step.count) == "integer" and step.count >= 0 and step.count < 1000
        and type(step.from) == "number" and type(step.to) == "number", "steps")
    end
  end
end

local totals = { "steps", "rejected", "iterations", "evaluations", "jumps", "smallest_dt", "time",
  "start", "wall", "cpu" }

-- Checks the Lua side's part of the file. Objects are still texts there, because the scene has none yet.
local function check_note(note)
  expect(is_list(note) and is_list(note.data) and is_list(note.beside) and is_list(note.origin), "note")
  for key in pairs(note.data) do expect(not passing[key], "note") end
  check_lists(note.data)
  check_steps(note.data)
  for _, entry in ipairs(note.beside) do
    expect(is_list(entry) and type(entry.object) == "string" and is_list(entry.own), "note")
  end
  for k, value in ipairs(note.origin) do expect(k % 2 == 0 or type(value) == "string", "note") end
  expect(note.run == nil or is_list(note.run) and type(note.run.ok) == "boolean", "run")
  for _, name in ipairs(note.run and totals or {}) do expect(type(note.run[name]) == "number", "run") end
  expect(note.run == nil or settings.fit(note.run.settings), "run")
  expect(note.closed == nil or note.closed == true, "note")
end

local kinds = { wire = true, particles = true, clamp = true, obstacle = true, force = true, join = true,
  tool = true }

-- Returns the note and its text after checks that exclude failures further on.
local function note_from(bytes, scene)
  local text = core.saved_note(bytes)
  local note = keep.unpack(text, scene, function(kind, slot, generation)
    expect(kinds[kind], kind)
    return ("%s %d %d"):format(kind, slot, generation)
  end)
  check_note(note)
  return text, note
end

-- Returns the note with the scene's objects by number: those the script has made, or new ones.
local function realise(text, scene, have)
  local function object(kind, slot, generation)
    local key = ("%s %d %d"):format(kind, slot, generation)
    if not have[key] then have[key] = core.numbered(scene, kind, slot, generation) end
    return have[key]
  end
  return keep.unpack(text, scene, object, function(kind, name) return have[kind .. " " .. name] end)
end

local function add_triangles(entry, old)
  if old then
    entry.vertices, entry.indices = old.vertices, old.indices
  elseif core.exists(entry.object) then
    solid.keep(entry, core.shape_of(entry.object))
  end
end

-- Takes the scene's data from a note.
local function take(scene, text)
  local data = build.data(scene)
  local have, old = known(data), {}
  for _, entry in ipairs(data.obstacles) do old[entry.object] = entry end
  local note = realise(text, scene, have)
  for key, value in pairs(data) do -- lists stay lists, even if the file lacks them
    if not passing[key] then data[key] = is_list(value) and {} or nil end
  end
  for key, value in pairs(note.data) do data[key] = value end
  for _, entry in ipairs(data.obstacles) do add_triangles(entry, old[entry.object]) end
  for _, entry in ipairs(note.beside) do
    local own = core.data(entry.object)
    for key, value in pairs(entry.own) do
      if own[key] == nil then own[key] = value end
    end
  end
  return note
end

-- True if a list { name, content, ... } has a name.
local function has(list, name)
  for i = 1, #list, 2 do
    if list[i] == name then return true end
  end
  return false
end

-- Raises an error unless the script's scene is the same as the file's was before its first run.
local function compare(scene, note, file)
  local now, then_ = save.origin(scene), note.origin
  for i = 1, math.max(#now, #then_), 2 do
    local a, b = now[i], then_[i]
    if a ~= b or now[i + 1] ~= then_[i + 1] then
      local what = a == b and ("%s differs from the file"):format(a)
        or b and not has(now, b) and ("%s of the file is missing in the script"):format(b)
        or a and not has(then_, a) and ("%s of the script is not in the file"):format(a)
        or ("%s comes before %s in the script, and after it in the file"):format(a, b)
      error(("scene:resume: '%s' is of another scene: %s. A script must build the same scene before it goes "
        .. "on; remove the file to start from the beginning, or read it with sw.load")
        :format(file, what), 0)
    end
  end
end

local function check_before(scene)
  local data = build.data(scene)
  if data.running then
    error(("scene:resume: a run of scene '%s' is under way"):format(scene.name), 0)
  end
  for _, p in ipairs(data.processes) do
    if p.begun then
      error(("scene:resume: %s has begun already; resume before the run"):format(tostring(p)), 0)
    end
  end
end

-- Returns false if there is no such file. Where that cannot be told, a script that began anew would write
-- over what the file holds.
local function is_there(file)
  local kind, why = core.kind(file)
  if why then error(("scene:resume: cannot read %s: %s"):format(sink.shown(file), why), 0) end
  return kind ~= nil
end

--- Continues from a file; returns false if there is none. args: those of the run that goes on, if they are
-- known.
function save.resume(scene, file, args)
  check_file("scene:resume", file)
  check_before(scene)
  if not is_there(file) then return false end
  local bytes = read("scene:resume", file)
  local text, note
  tell("scene:resume", file, function() text, note = note_from(bytes, scene) end)
  compare(scene, note, file)
  if args and note.run then settings.check(note.run.settings, args, file) end
  tell("scene:resume", file, core.resume, scene, bytes)
  local data = build.data(scene)
  note = take(scene, text)
  data.origin, data.going, data.from_file = note.origin, note.run, file
  data.restores = data.restores + 1
  turns.take_up(scene)
  close_frames(scene, note)
  return true
end

--- scene:resume(file) -> true, or false if there is no such file: restores the scene, built by
-- the same script, to its state when the file was written.
function class.scene.resume(scene, file)
  build.check(scene, "scene:resume", 3)
  return build.call(3, save.resume, scene, file, nil)
end

local function load(file)
  local bytes = read("sw.load", file)
  return tell("sw.load", file, function()
    local text = note_from(bytes)
    local scene = core.load(bytes)
    local note = take(scene, text)
    local data = build.data(scene)
    data.origin, data.done, data.ended = note.origin, nil, nil -- the processes are not in the file
    close_frames(scene, note)
    return scene
  end)
end

--- sw.load(file) -> the saved scene; scene:find(name) returns its objects.
function save.load(file) return build.call(3, load, file) end

-- --- steps -----------------------------------------------------------------------------

local function all(...) return ... end

-- While the steps of processes are kept, these methods may be called only inside steps.
for kind, methods in pairs{ clamp = { "follow", "release", "feed" },
  obstacle = { "follow", "remove" }, force = { "release" }, join = { "release" },
  wire = { "remodel" }, tool = { "follow", "hold", "pads_on", "jaws", "freeze", "thaw" } } do
  for _, name in ipairs(methods) do
    local method = class[kind][name]
    class[kind][name] = function(object, ...)
      process.guard(kind .. ":" .. name)
      return all(build.call(3, method, object, ...))
    end
  end
end

return save
