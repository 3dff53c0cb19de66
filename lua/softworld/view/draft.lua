-- SPDX-License-Identifier: GPL-3.0-or-later
--- A scene that forms put together: a list of objects and steps, each of which is one line of Lua. The script
-- of these lines is what is built, run, shown and saved. Every change makes a new list, so that undoing takes
-- an older one.
--
-- A list: { scene = values, run = values, items = { { id =, kind =, name =, values =, process = } } }.
-- @module softworld.view.draft
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local fill = require "softworld.view.fill"
local functions = require "softworld.view.functions"
local kinds = require "softworld.view.kinds"
local json = require "softworld.output.json"
local remarks = require "softworld.remarks"
local written = require "softworld.view.written"

local draft = {}
local Draft = {}
Draft.__index = Draft

local MOST_ITEMS = 400
local MOST_UNDONE = 200

local function fail(text, ...) error(text:format(...), 0) end

--- True if Ctrl-C raised this error, see checks.is_interrupt.
draft.is_interrupt = checks.is_interrupt

--- Returns an empty scene; may: pages may type Lua functions.
function draft.new(may)
  return setmetatable({ may = may or false, places = {},
    now = { scene = { name = "scene" }, run = {}, items = {} },
    past = {}, future = {}, ids = 0, builds = 0 }, Draft)
end

-- --- the script ------------------------------------------------------------------------------------

--- Returns the script that builds the scene.
function Draft:script() return self.text end

-- --- building --------------------------------------------------------------------------------------

-- Calls f and returns its remarks as well, for the page. Each build has another chunk name, so that remarks
-- come again.
local function with_remarks(f)
  local said, write = {}, remarks.write
  remarks.write = function(_, text) said[#said + 1] = text end
  local fine, result = pcall(f)
  remarks.write = write
  return fine, result, said
end

local function plain(message) return (build.plain(message):gsub("^scene%d+:%d+: ", "")) end

--- Returns the text of a run's error with lines as the page shows them: of the script, or of a typed
-- function.
function Draft:plain(message)
  return (tostring(message):gsub("scene%d+:(%d+): ", function(number)
    for _, place in ipairs(self.places) do
      local line = tonumber(number) - place.from + 1
      if line >= 1 and tonumber(number) <= place.to then
        return ("line %d of %s (line %s of the script): "):format(line, place.what, number)
      end
    end
    return ("line %s of the script: "):format(number)
  end))
end

-- Builds the scene of a script. Errors are texts without a place.
local function build_text(self, text)
  self.builds = self.builds + 1
  local names = functions.names()
  names.require = function() return package.loaded["softworld"] end
  local chunk = assert(load(text .. "return scene\n", ("=scene%d"):format(self.builds), "t", names))
  local fine, scene, said = with_remarks(chunk)
  if not fine then
    if draft.is_interrupt(scene) then error(scene, 0) end
    error(plain(scene), 0)
  end
  return scene, said
end

--- Builds the scene anew, in its state at the start.
function Draft:build()
  local scene, said = build_text(self, self.text)
  self.remarks = said
  return scene
end

-- Takes a list if a scene can be built from it; else everything stays, and the error is raised.
local function try(self, now)
  local text, texts, places = written.script(now)
  local scene, said = build_text(self, text)
  self.now, self.text, self.texts, self.places, self.remarks = now, text, texts, places, said
  return scene
end

local function commit(self, now)
  local before = self.now
  local scene = try(self, now)
  self.past[#self.past + 1], self.future = before, {}
  if #self.past > MOST_UNDONE then table.remove(self.past, 1) end
  return scene
end

-- --- changes -----------------------------------------------------------------------------------------

local function copied(now)
  local items = table.move(now.items, 1, #now.items, 1, {})
  return { scene = now.scene, run = now.run, items = items }
end

local function place_of(now, id)
  for i, item in ipairs(now.items) do
    if item.id == id then return i, item end
  end
  fail "this item no longer exists"
end

local function is_taken(now, but)
  return function(name)
    for _, item in ipairs(now.items) do
      if item ~= but and item.name == name then return true end
    end
    return false
  end
end

-- Returns the name in the values, or a new one; nil for forces, which have none.
local function named(now, kind, values, but)
  if not fill.has_name(kind) then return nil end
  if values.name == nil or values.name == "" then
    values.name = but and but.name or fill.name(kind, is_taken(now, but))
  elseif is_taken(now, but)(values.name) then
    fail("there is already something named '%s'", values.name)
  end
  return values.name
end

local function process_of(kind, m)
  if kind.class ~= "step" then return nil end
  local number = m.process == nil and 1 or m.process
  if math.type(number) ~= "integer" or number < 1 or number > written.processes then
    fail("process must be an integer from 1 to %d", written.processes)
  end
  return number
end

local function read(self, m)
  local kind, values = fill.read(m.class, m.kind, m.values, self.may)
  if not written.rank[kind.class] then fail("a %s cannot be added", kind.class) end
  if kind.class == "step" then fill.check(kind, values) end
  return kind, values
end

local change = {}

--- { class =, kind =, values =, process = }: adds an item.
function change.add(self, now, m)
  if #now.items >= MOST_ITEMS then fail("there are %d things already", MOST_ITEMS) end
  local kind, values = read(self, m)
  local item = { kind = kind, values = values, process = process_of(kind, m) }
  item.name = named(now, kind, values)
  self.ids = self.ids + 1
  item.id = self.ids
  now.items[#now.items + 1] = item
end

-- Replaces an object's old name by the new one in items that refer to it.
local function rename(now, old, new)
  if not old or old == new then return end
  for i, item in ipairs(now.items) do
    for _, name in ipairs(fill.names(item.kind, item.values)) do
      if name == old then
        local copy = {}
        for key, value in pairs(item) do copy[key] = value end
        copy.values = fill.renamed(item.kind, item.values, old, new)
        now.items[i] = copy
        break
      end
    end
  end
end

--- { id =, class =, kind =, values = }: replaces an item.
function change.change(self, now, m)
  local at, old = place_of(now, m.id)
  local kind, values = read(self, m)
  if kind.class ~= old.kind.class then fail("a %s cannot become a %s", old.kind.class, kind.class) end
  local item = { kind = kind, values = values, id = old.id, process = process_of(kind, m) }
  item.name = named(now, kind, values, old)
  now.items[at] = item
  rename(now, old.name, item.name)
end

--- { id =, values = }: changes some values only, such as a place.
function change.put(self, now, m)
  local at, old = place_of(now, m.id)
  local _, given = fill.read(old.kind.class, old.kind.kind, m.values, self.may)
  local values = {}
  for key, value in pairs(old.values) do values[key] = value end
  for key, value in pairs(given) do values[key] = value end
  local item = { kind = old.kind, values = values, id = old.id, process = old.process }
  item.name = named(now, old.kind, values, old)
  now.items[at] = item
  rename(now, old.name, item.name)
end

--- { id = }: removes an item and the items that refer to it.
function change.remove(_, now, m)
  local at = place_of(now, m.id)
  local gone = { table.remove(now.items, at) }
  local k = 1
  while gone[k] do
    for i = #now.items, 1, -1 do
      for _, name in ipairs(fill.names(now.items[i].kind, now.items[i].values)) do
        if gone[k].name and name == gone[k].name then
          gone[#gone + 1] = table.remove(now.items, i)
          break
        end
      end
    end
    k = k + 1
  end
  local also = {}
  for i = 2, #gone do also[i - 1] = gone[i].name or gone[i].kind.kind end
  return #also > 0 and ("with %s these were removed too: %s"):format(gone[1].name or gone[1].kind.kind,
    table.concat(also, ", "))
    or nil
end

--- { id =, by = 1 or -1 }: moves a step later or earlier in its process.
function change.shift(_, now, m)
  local at, item = place_of(now, m.id)
  if m.by ~= 1 and m.by ~= -1 then fail "by must be 1 or -1" end
  local to = at + m.by
  while now.items[to] and (now.items[to].kind.class ~= "step" or now.items[to].process ~= item.process) do
    to = to + m.by
  end
  if not now.items[to] then fail "it is the last one there" end
  now.items[at], now.items[to] = now.items[to], now.items[at]
end

--- { values = { name =, gravity = } }: changes the scene itself.
function change.scene(_, now, m)
  local _, values = fill.read("scene", "scene", m.values)
  if not values.name or values.name == "" then values.name = now.scene.name end
  now.scene = values
end

--- True if the word is a change of the list.
function Draft.knows(word) return change[word] ~= nil or word == "undo" or word == "redo" end

--- Makes a change. Returns the new scene at its start, and words about the change. If it fails, everything
-- stays as before, and a text without a place is raised.
function Draft:change(m)
  local word = m.what
  if word == "undo" or word == "redo" then
    local from, to = self.past, self.future
    if word == "redo" then from, to = to, from end
    local now = from[#from] or fail("there is nothing to %s", word)
    local before = self.now
    local scene = try(self, now)
    from[#from], to[#to + 1] = nil, before
    return scene
  end
  local now = copied(self.now)
  local words = (change[word] or fail("there is no order '%s'", checks.shown(word)))(self, now, m)
  return commit(self, now), words
end

--- Sets the arguments of the run: { duration =, dt =, ... }. Returns the table of scene:run.
function Draft:set_run(values)
  local kind, given = fill.read("run", "run", values)
  fill.check(kind, given)
  self.now.run = given
  return given
end

local function plain_copy(values)
  local copy = {}
  for key, value in pairs(values) do copy[key] = value end
  return copy
end

--- Returns the list of checks of the runs, as source; nil: there are none.
function Draft:checks()
  local list = {}
  for _, item in ipairs(self.now.items) do
    if item.kind.class == "check" then list[#list + 1] = "  " .. self.texts[item.id] .. ",\n" end
  end
  return #list > 0 and "{\n" .. table.concat(list) .. "}" or nil
end

--- Returns what pages show of the list.
function Draft:shown()
  local items = {}
  for i, item in ipairs(self.now.items) do
    items[i] = { id = item.id, class = item.kind.class, kind = item.kind.kind, name = item.name,
      values = json.object(plain_copy(item.values)), process = item.process, text = self.texts[item.id] }
  end
  return { items = items, scene = self.now.scene, run = json.object(plain_copy(self.now.run)),
    undo = #self.past > 0, redo = #self.future > 0, remarks = self.remarks, processes = written.processes }
end

--- Returns the table of scene:run; nil if the run would have no end.
function Draft:run()
  local ends = self.now.run.duration ~= nil
  for _, item in ipairs(self.now.items) do ends = ends or item.kind.class == "step" end
  return ends and self.now.run or nil
end

local unbuilt = draft.new

--- Returns an empty scene with its script, ready to be shown.
function draft.new(may)
  local self = unbuilt(may)
  self.text, self.texts, self.places = written.script(self.now)
  return self
end

draft.kinds = kinds

return draft
