-- SPDX-License-Identifier: GPL-3.0-or-later
--- The journal of a study: a text file to which one line is added for each evaluation.
--
--     softworld study 1 <sum>
--     s "name" <key of the definition> "what it is" <sum>
--     p <part> "the method with its options" <sum>
--     e <part> <number> <values> ok time=1.5 margin=0.25 <sum>
--     e <part> <number> <values> ok time=1.5 margin=0.25 "an event of its runs" <sum>
--     e <part> <number> <values> failed "why" <sum>
--     t <sum>
--
-- <sum> is the checksum of the line before it, 16 hexadecimal digits. Evaluations belong to the definition
-- above them. t says that the line above was torn, because a process was killed while it wrote. Other lines
-- without a correct sum are reported. Each line is one write to the end of the file, by the one process that
-- has its lock; the file is synced every second.
-- @module softworld.study.journal
local checks = require "softworld.checks"
local core = require "softworld.core"
local sink = require "softworld.output.sink"

local journal = {}
journal.__index = journal

local FIRST = "softworld study 1"
local SYNC = 1 -- time between two syncs [s]
local MOST = 1 << 53 -- largest number of a part

local function fail(text, ...) error(text:format(...), 0) end

local function summed(body) return ("%s %016x\n"):format(body, core.checksum(body)) end

-- Returns a text in quotes, on one line.
local function quoted(text)
  return '"' .. text:gsub('[%c"\\]', function(c) return ("\\%03d"):format(c:byte()) end) .. '"'
end

local function unquoted(text)
  return (text:gsub("\\(%d%d%d)", function(d) return string.char(tonumber(d) % 256) end))
end

--- Returns a journal at a path; nil path: nothing is stored. definition: { name =, key =, text = }.
function journal.new(path, definition)
  return setmetatable({ path = path, definition = definition, size = 0, parts = {} }, journal)
end

-- --- reading -----------------------------------------------------------------------------------

local function forget(self)
  self.parts, self.others, self.other, self.text = {}, 0, nil, nil
  self.bad, self.first_bad, self.current, self.torn = 0, nil, nil, false
  self.names, self.last = {}, 0
end

local function read_definition(self, body, at)
  local name, key, text = body:match '^s "([^"]*)" (%x+) "([^"]*)"$'
  if not name then fail("study '%s': %s:%d is not a line of a journal", self.definition.name, self.path,
    at) end
  name, self.current = unquoted(name), key
  if name ~= self.definition.name then
    fail("study '%s': file = '%s' is the journal of another study, '%s'; give this one a file of its own",
      self.definition.name, self.path, checks.shown(name))
  end
  if key ~= self.definition.key then self.other = unquoted(text) end
end

-- Adds a line to those of a number: a place in the file's text, or the text of an added line.
local function put(self, part, number, line)
  local list = self.parts[part]
  if not list then
    list = {}
    self.parts[part], self.last = list, math.max(self.last, part)
  end
  local before = list[number]
  if not before then
    list[number] = line
  elseif type(before) == "table" then
    before[#before + 1] = line
  else
    list[number] = { before, line }
  end
end

local function name_part(self, part, text)
  self.names[text], self.last = part, math.max(self.last, part)
end

local function read_part(self, body)
  local part, text = body:match '^p (%d+) "([^"]*)"$'
  part = math.tointeger(part)
  if not part or part < 1 or part > MOST then return false end
  name_part(self, part, unquoted(text))
  return true
end

local function damaged(self, line_number)
  self.bad, self.first_bad = self.bad + 1, self.first_bad or line_number
  self.bad_at = line_number
end

-- Handles a "t" line: the line above was torn and does not count as damaged.
local function excuse(self, line_number)
  if self.bad_at ~= line_number - 1 then return end
  self.bad, self.bad_at = self.bad - 1, nil
  if self.bad == 0 then self.first_bad = nil end
end

-- Reads all lines from a place on; returns where the last whole one ends.
local function read_lines(self, text, at)
  local line_number, ours, line = 1, false, core.journal_line
  while true do
    local after, kind, part, number = line(text, at)
    if not after then return at end
    line_number = line_number + 1
    if kind == "e" and part > 0 and number > 0 then
      if ours then put(self, part, number, at) else self.others = self.others + 1 end
    elseif kind == "s" then
      read_definition(self, text:sub(at, after - 19), line_number)
      ours = self.current == self.definition.key
    elseif kind == "t" then
      excuse(self, line_number)
    elseif kind ~= "p" or ours and not read_part(self, text:sub(at, after - 19)) then
      damaged(self, line_number)
    end
    at = after
  end
end

local function check_kind(self)
  local kind, why = core.kind(self.path)
  if why then
    fail("study '%s': cannot read %s: %s", self.definition.name, sink.shown(self.path), why)
  end
  if kind and kind ~= "file" then
    fail("study '%s': file = '%s' is a %s, not a file", self.definition.name, self.path, kind)
  end
  return kind
end

local function size_of(path)
  local file = io.open(path)
  local size = file and file:seek "end"
  if file then file:close() end
  return size
end

--- Reads the file, unless this process has read or written all of it.
function journal:read()
  if not self.path or not check_kind(self) then
    if self.size > 0 then forget(self) end
    self.size = 0
    if not self.bad then forget(self) end
    return
  end
  if self.bad and size_of(self.path) == self.size then return end
  local text = sink.read_file(self.path)
  forget(self)
  self.size = #text
  if text == "" then return end
  local first = text:match "^([^\n]*)\n"
  if first ~= summed(FIRST):sub(1, -2) then
    if not first and summed(FIRST):sub(1, #text) == text then self.torn = true return end
    fail("study '%s': file = '%s' is not a journal of a study; the file is left as it is, give another name",
      self.definition.name, self.path)
  end
  self.text = text
  self.torn = read_lines(self, text, #first + 2) <= #text
end

local function items(text)
  local list, set = {}, {}
  for item in text:gmatch "[^\n]+" do
    list[#list + 1], set[item] = item, true
  end
  return list, set
end

--- Returns the differences between two definitions, as lines.
function journal.differences(before, now)
  local old, in_old = items(before)
  local new, in_new = items(now)
  local list = {}
  for _, item in ipairs(old) do
    if not in_new[item] then list[#list + 1] = "before: " .. item end
  end
  for _, item in ipairs(new) do
    if not in_old[item] then list[#list + 1] = "now:    " .. item end
  end
  return list
end

--- Returns lines for the user about what the journal has besides evaluations of this definition.
function journal:remarks()
  local list = {}
  if self.others > 0 then
    list[1] = ("%s has %d evaluation%s of another definition, which are kept apart; new in this "
      .. "definition:"):format(
      self.path, self.others, self.others == 1 and "" or "s")
    for _, difference in ipairs(journal.differences(self.other or "", self.definition.text)) do
      list[#list + 1] = "  " .. difference
    end
  end
  if self.bad > 0 then
    list[#list + 1] = ("%s: %d damaged line%s (the first is line %d) contribute%s nothing"):format(
      self.path, self.bad, self.bad == 1 and "" or "s", self.first_bad, self.bad == 1 and "s" or "")
  end
  return list
end

--- Returns values, status and rest of a line about an evaluation, without its sum; nil for other lines.
function journal.parse(line)
  local word, status, rest = line:match "^e %d+ %d+ (%S+) (%l+) (.*)$"
  if status ~= "ok" and status ~= "failed" and status ~= "machine" then return nil end
  if status ~= "ok" then rest = unquoted(rest:match '^"(.*)"$' or "") end
  return word, status, rest
end

local function parse(self, line)
  if type(line) == "number" then line = self.text:sub(line, (core.journal_line(self.text, line)) - 19) end
  return journal.parse(line)
end

--- Returns status, rest and values of an evaluation with these values (a word), or without word of the last
-- one with this number; nil if there is none.
function journal:find(part, number, word)
  local lines = (self.parts[part] or {})[number]
  if not lines then return nil end
  lines = type(lines) == "table" and lines or { lines }
  for i = #lines, 1, -1 do
    local values, status, rest = parse(self, lines[i])
    if status and (not word or values == word) then return status, rest, values end
  end
end

--- Returns the numbers of a part's evaluations in the journal, as keys of a table.
function journal:numbers(part) return self.parts[part] or {} end

-- --- writing -----------------------------------------------------------------------------------

local function write(self, text)
  local fine, why = self.stream:write(text)
  if fine then
    self.size = self.size + #text
    return
  end
  self.size = -1 -- read it again
  fail("study '%s': cannot write to %s: %s; its content so far is kept, and the same script goes on from "
    .. "there",
    self.definition.name, self.path, (tostring(why):gsub("^.*: ", "")))
end

--- Opens the journal for writing, unless it is read-only. Raises an error if another process writes or nobody
-- can.
function journal:open()
  if not self.path or self.reader then return self:read() end
  local name = self.definition.name
  check_kind(self)
  local lock, why = core.lock(self.path)
  if why == "busy" then
    fail("study '%s': another process, or another study of this one, works with %s; let it end first", name,
      self.path)
  elseif not lock then
    fail("study '%s': cannot write %s: %s", name, self.path, why)
  end
  self.lock = lock
  self:read()
  self.stream, why = io.open(self.path, "ab")
  if not self.stream then fail("study '%s': cannot write %s: %s", name, self.path, why) end
  self.stream:setvbuf "no"
  self.synced = core.clock()
  if self.size == 0 then write(self, summed(FIRST))
  elseif self.torn then self:mend() end
  if self.current ~= self.definition.key then
    local d = self.definition
    write(self, summed(('s %s %s %s'):format(quoted(d.name), d.key, quoted(d.text))))
    self.current = d.key
  end
end

-- Mends a torn last line; a file that has only part of its first line is completed.
function journal:mend()
  if self.size < #summed(FIRST) then
    write(self, summed(FIRST):sub(self.size + 1))
  else
    write(self, "\n" .. summed "t")
  end
  self.torn = false
end

--- Returns the number of a part by the text of its method; a new part is added.
function journal:part(text)
  if not self.names[text] then
    name_part(self, self.last + 1, text)
    if self.stream then write(self, summed(("p %d %s"):format(self.last, quoted(text)))) end
  end
  return self.names[text]
end

--- Returns the line about an evaluation, without its sum.
function journal.body(part, number, word, status, rest)
  return ("e %d %d %s %s %s"):format(part, number, word, status, status == "ok" and rest or quoted(rest))
end

--- Returns the method of a part; nil if the journal does not have it.
function journal:name(part)
  for text, number in pairs(self.names) do
    if number == part then return text end
  end
end

--- Adds an evaluation: status "ok" with results as text, or "failed" or "machine" with a reason.
function journal:add(part, number, word, status, rest)
  local body = journal.body(part, number, word, status, rest)
  if self.stream then write(self, summed(body)) end
  put(self, part, number, body)
  if self.stream and core.clock() - self.synced > SYNC then self:sync() end
end

function journal:sync()
  core.sync(self.path)
  self.synced = core.clock()
end

--- Ends writing, so that another process may write.
function journal:close()
  local stream, lock = self.stream, self.lock
  self.stream, self.lock = nil, nil
  if stream then
    stream:close()
    core.sync(self.path)
  end
  if lock then lock() end
end

--- Called in a worker: gives up the lock, which is its parent's.
function journal:leave()
  if self.lock then self.lock() end
end

journal.summed, journal.quoted, journal.unquoted = summed, quoted, unquoted

return journal
