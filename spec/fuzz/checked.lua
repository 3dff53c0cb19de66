-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs the calls of a case and checks the effects of each: useless error messages, objects left half
-- changed, numbers that are not finite after a run that says ok, calls that take long.
local sw = require "softworld"
local core = sw.core
local hostile = require "fuzz.hostile"
local lfs = require "lfs"

local checked = {}

local function kind_of(object)
  local kind = core.type(object)
  if kind then return kind end
  local meta = type(object) == "table" and getmetatable(object)
  return type(meta) == "table" and type(rawget(meta, "__name")) == "string" and rawget(meta, "__name") or nil
end
checked.kind_of = kind_of

--- Names of an object's members, sorted.
function checked.names_of(object)
  local meta, names = getmetatable(object), {}
  if type(meta) ~= "table" then return names end
  local list = rawget(meta, "__names")
  if type(list) == "function" then names = list(object)
  else
    local index = rawget(meta, "__index")
    for name in pairs(type(index) == "table" and index or meta) do
      if type(name) == "string" and name:sub(1, 2) ~= "__" then names[#names + 1] = name end
    end
    for name, value in pairs(object) do
      if type(name) == "string" and type(value) ~= "function" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  return names
end

-- --- errors ---------------------------------------------------------------------------

local raw = { "attempt to ", "bad argument #%-?%d+ to '%?'", "bad argument #%-?%d+ to 'for ",
  "stack overflow",
  "invalid order function", "has no integer representation", "'for' ", "assertion failed",
  "table index is", "invalid value %(at index", "wrong number of arguments", "invalid option",
  "must return a string", "invalid conversion", "malformed", "too many results", "string length overflow",
  "invalid key to", "error in error handling", "cannot resume", "%(null%)" }

local library = { tostring = true, ipairs = true, pairs = true, next = true, insert = true, concat = true,
  unpack = true, max = true, min = true, rep = true, sub = true, find = true, match = true, gsub = true,
    format = true,
  setmetatable = true, getmetatable = true, type = true, select = true, sort = true, write = true,
  move = true, rawget = true, rawset = true, floor = true, tonumber = true, remove = true, gmatch = true,
    read = true,
  lines = true, byte = true, char = true, error = true }

-- Returns why an error message is useless, or nil.
local function poor(message, asked_memory)
  if message == hostile.marked then return nil end
  if type(message) ~= "string" then return "an error that is a " .. type(message) end
  if message:find("raised by the caller", 1, true) then return nil end
  if message:find "^case:%d+: attempt" or message:find "^%[string \"case\"%]" then return nil end
  if message:find "fuzz/hostile%.lua:%d+: attempt" then return nil end -- errors of the callbacks themselves
  for _, pattern in ipairs(raw) do
    if message:find(pattern) then return "a raw error" end
  end
  local name = message:match "bad argument #%-?%d+ to '([^']*)'"
  if name and library[name] and message:find "softworld/" then return "a raw error" end
  if message:find "not enough memory" and not asked_memory then return "out of memory" end
  if #message < 12 then return "an error that tells nothing" end
  if message:find "softworld/[%w_/]+%.lua:%d+:" then return "placed in the library" end
end

-- --- numbers --------------------------------------------------------------------------

-- Returns the first number within value that is not a number, as "[key].x = nan".
local function wrong_number(value, path, infinite, depth)
  if type(value) == "number" then
    if value ~= value then return path .. " = nan" end
    if not infinite and (value == math.huge or value == -math.huge) then return path .. " = inf" end
  elseif type(value) == "table" and depth < 6 and not (getmetatable(value) or {}).__index then
    local keys = {}
    for key in next, value do keys[#keys + 1] = key end
    table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
    for _, key in ipairs(keys) do
      local inside = infinite or type(key) == "string" and (key:find "radius" or key:find "limit"
        or key:find "smallest" or key == "error") -- an error bar where the data give none
      local found = wrong_number(rawget(value, key), ("%s.%s"):format(path, type(key) == "number" and "#"
        or tostring(key)), inside, depth + 1)
      if found then return found end
    end
  end
end

local no_reading = { close = true, release = true, remove = true, restore = true, run = true, settle = true,
  advance = true, snapshot = true, clear_frames = true, process = true, gripper = true, push = true,
    follow = true,
  open = true, open_jaws = true, remodel = true, frequencies = true, save = true, freeze = true, thaw = true,
  close_jaws = true, rotate = true, finish = true, series = true, step = true, hold = true,
    force_limit = true,
  calibration = true, triangles = true, cable = true, pressure_map = true, frame = true, names = true,
  jaws = true, scene = true, evaluate = true, resume = true, clip = true, watch = true, log = true,
    document = true, wire_contact = true, summary = true, wait = true, retreat = true }

local of_body = { wire = true, particles = true }

-- Reads every number that an object gives.
local function read_outs(object, kind)
  for _, name in ipairs(checked.names_of(object)) do
    if not no_reading[name] then
      local infinite = name:find "radius" or name:find "limit" or name == "stable_dt"
      local fine, value = pcall(function() return object[name] end)
      if fine and type(value) == "function" then
        local known, length = pcall(function() return object.length end)
        local results = table.pack(pcall(value, object))
        if not results[1] and kind == "wire" and known then results = table.pack(pcall(value, object,
          0.4 * length)) end
        value = results[1] and { table.unpack(results, 2, results.n) } or nil
      end
      local found = fine and value ~= nil and wrong_number(value, name, infinite, 0)
      if found then return ("%s: %s"):format(kind, found) end
    end
  end
end

-- --- one case --------------------------------------------------------------------------

local Case = {}
Case.__index = Case

--- A case; report(kind, text) receives the findings. files: a folder for the case alone.
function checked.new(files, report)
  local self = setmetatable({ v = {}, slow = 6, written = setmetatable({}, { __mode = "k" }) }, Case)
  function self.report(kind, text) report(kind, ("%s, in: %s"):format(text, self.doing)) end
  local T, F = hostile.make(self.v)
  self.v.dir = files
  lfs.link("/dev/full", files .. "/full", true) -- a link, so that the device is not replaced by mistake
  local function try(f, ...)
    local results = table.pack(pcall(f, ...))
    if results[1] then return table.unpack(results, 2, results.n) end
    local why = poor(results[2], self.memory)
    if why then self.report("error", ("%s: %s"):format(why, tostring(results[2]))) end
  end
  self.env = setmetatable({ v = self.v, T = T, F = F, nan = 0 / 0, huge = math.huge, long = ("x"):rep(300),
    dir = files,
    sw = sw, core = core, try = try, print = function() end }, { __index = _G })
  return self
end

local function objects(self)
  local list, keys = {}, {}
  for key in pairs(self.v) do
    if math.type(key) == "integer" then keys[#keys + 1] = key end
  end
  table.sort(keys)
  for _, key in ipairs(keys) do
    local kind = kind_of(self.v[key])
    if kind then list[#list + 1] = { object = self.v[key], kind = kind, key = key } end
  end
  return list
end

local function flat(value)
  if type(value) ~= "table" then return tostring(value) end
  local list = {}
  for i, item in ipairs(value) do list[i] = flat(item) end
  return table.concat(list, " ")
end

-- The visible state of all scenes, as a list of texts.
local function picture(self)
  local list = {}
  local function add(label, f, ...)
    local fine, value = pcall(f, ...)
    list[#list + 1] = label .. " " .. (fine and flat(value) or "gone")
  end
  for _, entry in ipairs(objects(self)) do
    local object = entry.object
    local label = ("v[%d] (%s)"):format(entry.key, entry.kind)
    if entry.kind == "scene" then
      add(label .. " parts", core.items, object)
      add(label .. " time", function() return object.time end)
      add(label .. " frames", function() return object:frame_count() end)
    elseif of_body[entry.kind] then
      add(label .. " positions", function() return object:positions() end)
      add(label .. " velocities", function() return object:velocities() end)
    elseif entry.kind == "clamp" or entry.kind == "obstacle" then
      add(label .. " pose", function() return { object:pose() } end)
    end
  end
  return list
end

-- Calls that may do part of their work before they fail.
local going = { "run", "settle", "advance", "restore", "resume", "close", "F%.", "process", "v%[%d+%] = nil",
  "core%.", "handover", "thaw", "freeze", "finish", "collect", "%.load", "clear" }

local function whole(text)
  for _, word in ipairs(going) do
    if text:find(word) then return false end
  end
  return true
end

-- Members that give no numbers of the state.
local PLAIN = { run = true, ledger = true, process = true, snapshot = true, shape = true, trajectory = true }

local function check_run(self, result)
  if not (kind_of(result) == "run" and result.ok) then return end
  for _, entry in ipairs(objects(self)) do
    -- ledgers are checked below; scripts may write into other tables
    if not PLAIN[entry.kind] then
      local mine = true
      if entry.kind == "scene" then mine = entry.object == result.scene end
      local found = mine and not self.written[entry.object] and read_outs(entry.object, entry.kind)
      if found then self.report("number", "after a run that is ok: " .. found) end
    end
  end
end

local function sum_of(list)
  local sum, size = 0, 0
  for _, value in next, list do sum, size = sum + value, size + math.abs(value) end
  return sum, size
end

-- Checks the energy ledger of a run that says ok: finite and closed, with no energy out of nowhere.
local function check_ledger(self, result)
  if not (kind_of(result) == "run" and result.ok) then return end
  local book = result:ledger()
  local wrong = wrong_number(setmetatable(table.move({ book.total, book.at_start, book.gap, book.play,
    book.gained,
    book.kinetic, book.stored, book.gravity }, 1, 8, 1, {}), nil), "ledger", false, 0)
    or wrong_number(book.work, "ledger.work", false, 0) or wrong_number(book.lost, "ledger.lost", false, 0)
  if wrong then return self.report("ledger", wrong) end
  local work, worked = sum_of(book.work)
  local lost, gone = sum_of(book.lost)
  local size = worked + gone + math.abs(book.total) + math.abs(book.at_start) + math.abs(book.gap)
  local open = book.total - book.at_start - work + lost - book.gap
  if math.abs(open) > 1e-6 * size then
    self.report("ledger", ("open by %.3g J of %.3g J"):format(open, size))
  end
  if book.gained > 0.05 * book.play then -- a run that says ok must not gain this much
    self.report("ledger", ("%.3g J gained, %.3g J in play"):format(book.gained, book.play))
  end
end

--- Runs one call, given as text. Returns pcall's results.
function Case:call(text)
  local chunk, why = load(text, "=case", "t", self.env)
  if not chunk then return false, why end
  self.memory = text:find "fail_allocation" or text:find "e1[25]" or text:find "2%^" or text:find "integer"
    or text:find "1e300" or text:find "long" or text:find "huge"
  self.doing = text:sub(1, 300)
  local written = tonumber(text:match "^v%[(%d+)%]%.[%w_]+ = ")
  if written then self.written[self.v[written] or 0] = true end -- the case may write anything, also nan
  local before, acted = whole(text) and picture(self), hostile.acted
  local began = os.clock()
  local results = table.pack(pcall(chunk))
  core.fail_allocation(0)
  local took = os.clock() - began
  if took > self.slow then self.report("slow", ("%.1f s"):format(took)) end
  if not results[1] then
    local message = results[2]
    local bad = poor(message, self.memory)
    if bad then self.report("error", ("%s: %s"):format(bad, tostring(message))) end
    if before and hostile.acted == acted then -- otherwise a callback of the script changed it
      local after = picture(self)
      for i = 1, #after < #before and 0 or #after do -- a callback may drop its objects
        if before[i] ~= after[i] then
          self.report("changed", ("an error, and yet changed: %s (%s)"):format(
            tostring(before[i]):match "^[^)]*%) %a+", tostring(message)))
          break
        end
      end
    end
  else
    local n = tonumber(text:match "^v%[(%d+)%] = ")
    local result = results[2]
    if n then result = self.v[n] end
    check_run(self, result)
    check_ledger(self, result)
  end
  return table.unpack(results, 1, results.n)
end

--- At the end: the memory left when nothing is used any more.
function Case:finish()
  for key in pairs(self.v) do self.v[key] = nil end
  self.env = nil
  collectgarbage()
  collectgarbage()
end

return checked
