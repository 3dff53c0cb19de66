-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:script: writes Lua that builds a scene again, bit for bit.
--
--     print(scene:script())       -- the text
--     scene:script "place.lua"    -- a file; local scene = dofile "place.lua" builds the scene
--
-- The text has the calls that made and changed the scene until its first step, with their arguments. Later
-- calls appear as comments; scene:save stores a scene at any time.
-- @module softworld.scene.script
local core = require "softworld.core"
local build = require "softworld.scene.build"
local cable = require "softworld.cable"
local literal = require "softworld.scene.literal"
local record = require "softworld.scene.record"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local sink = require "softworld.output.sink"

local script = {}
local MOST_LOCALS = 150 -- Lua allows 200 in a function

rows.calls{
  { "scene:script", "file", "writes the Lua that builds the scene again, as it was before its first step",
    "its text", example = 'scene:script "place.lua"' },
}

-- --- objects ----------------------------------------------------------------------------------

-- Returns, by object, the number of the call that made it.
local function makers(log)
  local made = {}
  for i, call in ipairs(log) do
    for k = 1, call.results.n do
      local value = call.results[k]
      local kind = type(value)
      if (kind == "userdata" or kind == "table") and made[value] == nil then made[value] = i end
    end
  end
  return made
end

-- Returns the numbers of the calls whose object a later call needs.
local function needed(log, made)
  local list, seen = {}, {}
  local function walk(value)
    if type(value) ~= "table" and type(value) ~= "userdata" or seen[value] then return end
    seen[value] = true
    if made[value] then list[made[value]] = true end
    local of = record.trajectory(value)
    if of then
      walk(of.self)
      for k = 1, of.args.n do walk(of.args[k]) end
    end
    if type(value) ~= "table" or getmetatable(value) ~= nil then return end
    for _, item in next, value do walk(item) end
  end
  for _, call in ipairs(log) do
    walk(call.self)
    for k = 1, call.args.n do walk(call.args[k]) end
  end
  return list
end

local function name_of(object)
  local fine, name = pcall(function()
    return type(object) == "table" and rawget(sealed.fields(object), "name") or object.name
  end)
  return fine and type(name) == "string" and name or nil
end

local taken_words = { scene = true, sw = true, made = true, cables = true }

-- Returns a name for a local variable, from the object's name.
local function word_for(object, call, words)
  local base = (name_of(object) or call.method):gsub("[^%w_]+", "_"):gsub("^_+", ""):gsub("_+$", "")
  if base == "" or base:find "^%d" then base = call.method .. "_" .. base end
  if not literal.is_name(base) then base = base .. "_" end
  local word, count = base, 1
  while words[word] or taken_words[word] do
    count = count + 1
    word = ("%s_%d"):format(base, count)
  end
  words[word] = true
  return word
end

-- --- text -------------------------------------------------------------------------------------

-- Returns the source of a cable: its name, or a variable that the head of the text defines. cables: the lines
-- of the definitions, and by entry the variables.
local function of_cable(entry, path, cables)
  if cables[entry] then return cables[entry] end
  local fine, given = pcall(cable.source, entry)
  if not fine then
    error(("%s is the cable '%s', and %s; make it with sw.cable.define"):format(path, entry.name, given), 0)
  end
  if not given then return ("sw.cable %q"):format(entry.name) end
  cables[entry] = ("cables[%d]"):format(#cables + 1)
  local text = literal.of(given, function()
    error(("%s is the cable '%s', whose fields cannot be written as Lua"):format(path, entry.name), 0)
  end, "cable", "")
  cables[#cables + 1] = ("%s = sw.cable.read %s"):format(cables[entry], text)
  return cables[entry]
end

-- Returns arguments in which a cable that a script has put into the catalogue is not named, but given.
local function with_cables(args)
  local name = type(args[1]) == "table" and getmetatable(args[1]) == nil and args[1].cable
  local fine, entry = pcall(cable.get, type(name) == "string" and name or nil)
  if not fine or not select(2, pcall(cable.source, entry)) then return args end
  local first = {}
  for key, value in next, args[1] do first[key] = value end
  first.cable = entry
  local list = table.move(args, 1, args.n, 1, { n = args.n })
  list[1] = first
  return list
end

local function is_cable(value)
  return type(value) == "table" and (getmetatable(value) or {}).__name == "cable"
end

local function call_text(self, method, args, object, path)
  local list = {}
  for k = 1, args.n do
    list[k] = literal.of(args[k], object, args.n == 1 and path or ("%s: argument %d"):format(path, k))
  end
  if #list == 1 and list[1]:find '^[{"]' then
    return ("%s:%s %s"):format(self, method, list[1])
  end
  return ("%s:%s(%s)"):format(self, method, table.concat(list, ", "))
end

-- Returns a function that gives the source of an object: the variable it was given, or a call.
local function namer(scene, words, cables)
  local function object(value, path)
    if rawequal(value, scene) then return "scene" end
    if words[value] then return words[value] end
    local of = record.trajectory(value)
    if of and of.self then return call_text(object(of.self, path), of.method, of.args, object, path) end
    if of then return "sw.trajectory " .. literal.of(of.args[1], object, path) end
    if is_cable(value) then return of_cable(value, path, cables) end
    if value == record.a_function then
      error(path .. " is a Lua function, which cannot be written as Lua", 0)
    end
    error(("%s is a %s that was not made in this scene"):format(path,
      core.type(value) or (getmetatable(value) or {}).__name or type(value)), 0)
  end
  return object
end

local function line_of(call, k, list, words, object)
  local self = object(call.self, call.method)
  local kind = core.type(call.self) or (getmetatable(call.self) or {}).__name
  local args = with_cables(call.args)
  local text = call_text(self, call.method, args, object, ("%s:%s"):format(kind, call.method))
  if not list[k] then return text end
  local result = call.results[1]
  local word = words.of[k]
  words[result] = word
  return ("%s = %s"):format(words.locals[k] and "local " .. word or word, text)
end

-- Returns the variables of the needed objects: locals first, then items of a table.
local function words_of(log, list)
  local words, used, count = { of = {}, locals = {} }, {}, 0
  for k, call in ipairs(log) do
    if list[k] then
      count = count + 1
      words.locals[k] = count <= MOST_LOCALS
      words.of[k] = words.locals[k] and word_for(call.results[1], call, used) or ("made[%d]"):format(k)
    end
  end
  return words, count > MOST_LOCALS
end

local function commented(text) return "-- " .. text:gsub("\n", "\n-- ") end

local function body(log, lines, list, words, object)
  for k, call in ipairs(log) do
    if call.late then
      local fine, text = pcall(line_of, call, k, list, words, object)
      lines[#lines + 1] = commented(fine and text or ("%s: %s"):format(call.method, text))
    else
      lines[#lines + 1] = line_of(call, k, list, words, object)
    end
    if not call.late and log[k + 1] and log[k + 1].late then
      lines[#lines + 1] = "\n-- After the first step; these lines build nothing:"
    end
  end
end

-- Writes the gravity that the scene was made with; later changes have their own lines.
local function head(scene)
  local made = record.made_as(scene)
  if not made then
    error(("scene:script: scene '%s' was read from a file; use the script that saved it"):format(
      scene.name), 0)
  end
  local lines = { "-- Builds the scene '" .. scene.name:gsub("[\r\n]", " ")
    .. "' as it was before its first step; written by SoftWorld " .. core.version .. ".",
    'local sw = require "softworld"', "" }
  lines[#lines + 1] = "local scene = sw.scene "
    .. literal.of(made, function() error("scene: this cannot be written", 0) end, "scene")
  return lines
end

local function text_of(scene)
  local log = record.of(scene)
  if log.missed > 0 and not log[#log].late then
    error(("scene:script: scene '%s' was changed %d times, and only the first %d changes are "
      .. "recorded"):format(scene.name,
      #log + log.missed, #log), 0)
  end
  local lines, list, cables = head(scene), needed(log, makers(log)), {}
  local words, many = words_of(log, list)
  if many then lines[#lines + 1] = "local made = {}" end
  local place = #lines + 1
  body(log, lines, list, words, namer(scene, words, cables))
  if #cables > 0 then table.insert(lines, place, "local cables = {}\n" .. table.concat(cables, "\n")) end
  if build.data(scene).process_count then
    lines[#lines + 1] = "\n-- The steps of its processes are Lua functions, which are not written."
  end
  lines[#lines + 1] = "\nreturn scene\n"
  return table.concat(lines, "\n")
end

local function scene_name(scene) return scene.name end

local function write(scene, file)
  if core.type(scene) ~= "scene" then error("scene:script is a method: call it with a colon", 0) end
  build.call(3, scene_name, scene) -- raises if the scene is closed
  if file ~= nil and (type(file) ~= "string" or file == "") then
    error(("scene:script: the name of a file is wanted, got %s"):format(file == "" and "''" or type(file)), 0)
  end
  local fine, text = pcall(text_of, scene)
  if not fine then error(text, 0) end
  if file then sink.write_file(file, text) end
  return text
end

--- scene:script(file) -> text: see help "scene:script". Lua functions cannot be written: an error names the
-- first one, and no file is written.
script.script = build.placed(write)

return script
