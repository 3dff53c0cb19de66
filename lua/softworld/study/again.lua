-- SPDX-License-Identifier: GPL-3.0-or-later
--- Computes an evaluation of a study again in this process, with the same bits, so that one can look at it.
-- @module softworld.study.again
local build = require "softworld.scene.build"
local campaign = require "softworld.study.campaign"
local checks = require "softworld.checks"
local core = require "softworld.core"
local evaluation = require "softworld.study.evaluation"
local output = require "softworld.study.output"
local parts = require "softworld.study.parts"
local rows = require "softworld.rows"
local sealed = require "softworld.sealed"
local unread = require "softworld.unread"

local again = {}

rows.calls{
  { "study:again", "number, part", "computes an evaluation again in this process, with the same bits; give a "
    .. "row of the table, or number and part (part only if several have the number)",
    "results of evaluate, and the last run of a scene in it",
    example = 'local _, run = study:again(12)' },
}

local function fail(text, ...) error(text:format(...), 0) end

local function check(value, what)
  if math.type(value) == "integer" and value > 0 then return value end
  fail("study:again: %s = %s is not allowed; it must be an integer of 1 or more, or a row of study:table()",
    what, checks.got(value))
end

--- Returns the record given by a row, or by number and part.
function again.find(own, number, part)
  if type(number) == "table" then
    number, part = checks.field(number, "number"), checks.field(number, "part")
  end
  check(number, "number")
  if part ~= nil then check(part, "part") end
  local found, where = nil, {}
  for _, record in ipairs(output.records(own, part)) do
    if record.number == number then
      found = record
      where[#where + 1] = tostring(record.part)
    end
  end
  if not found then
    fail("study '%s': there is no evaluation %s%d", own.name, part and part .. "." or "", number)
  end
  if #where > 1 then
    fail("study '%s': evaluation %d is in the parts %s; give the part: study:again(%d, %s)", own.name, number,
      table.concat(where, " "), number, where[1])
  end
  return found
end

-- Calls f(...). Returns the last run of a scene within it, and the results.
local function with_run(f, ...)
  local class, run = core.class.scene, nil
  local real = class.run
  local function keep(...)
    run = ...
    return ...
  end
  class.run = function(...) return keep(real(...)) end
  local found = table.pack(pcall(f, ...))
  class.run = real
  if not found[1] then error(found[2], 0) end
  return run, table.unpack(found, 2, found.n)
end

local function stream_of(own, part)
  if own.asked[part] then return own.asked[part].stream end
  local name = own.journal:name(part)
  if not name then fail("study '%s': its journal does not say what part %d is", own.name, part) end
  return parts.stream(name)
end

local function compare(own, record, status, text)
  local now = campaign.record(record.part, record.number, record.values, status, text)
  local before, after = record.results, now and now.results
  if not before or record.machine then return end -- it had failed
  for name, value in pairs(before) do
    if not after or after[name] ~= value then
      fail("study '%s': evaluation %d.%d gives another result: %s is %s and was %.17g; evaluate depends on "
        .. "more than its parameters and the seed", own.name, record.part, record.number, name,
        after and ("%.17g"):format(after[name] or 0 / 0) or "not there, since " .. text, value)
    end
  end
end

--- Same as study:again, without the place of the call in errors.
function again.compute(self, number, part)
  local own = sealed.fields(self)
  if own.busy then fail("study '%s': evaluate cannot start other evaluations", own.name) end
  if own.task then return nil end
  local record = again.find(own, number, part)
  campaign.build(own)
  local before = own.stream
  own.stream, own.busy = stream_of(own, record.part), true
  local fine, run, status, text, given = pcall(with_run, unread.uncounted, evaluation.again, own,
    record.number, record.values)
  own.stream, own.busy = before, false
  if not fine then error(run, 0) end
  compare(own, record, status, text)
  if status == "ok" then return given, run end
  io.stderr:write(("study '%s': evaluation %d.%d failed: %s\n"):format(own.name, record.part, record.number,
    text))
  return nil, run
end

--- study:again(number, part): returns what evaluate returned (nil if it fails), and the last run.
function again.again(self, number, part) return build.call(3, again.compute, self, number, part) end

return again
