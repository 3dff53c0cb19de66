-- SPDX-License-Identifier: GPL-3.0-or-later
--- Shows the progress of a study's method on one line of a terminal; nothing elsewhere, and nothing for
-- methods that end within a second.
--
--     grip: minimise time  120 of at most 400  best 1.234 (no. 87), 3 failed, 52/s, left 5 s
-- @module softworld.study.progress
local bar = require "softworld.output.progress"
local core = require "softworld.core"
local judge = require "softworld.study.judge"
local number = require "softworld.output.number"

local progress = {}
progress.__index = progress

local AFTER = 1  -- time before anything is shown [s]
local GAP = 0.1  -- time between two drawings [s]
local WIDTH = 2  -- time between two queries of the terminal's width [s]

--- Returns a progress line. o: total (evaluations), most (true: at most this many), result (that is
-- minimised); stream, terminal, clock, width for specs.
function progress.new(own, method, o)
  local self = setmetatable({ own = own, method = method, total = o.total, most = o.most, result = o.result,
    stream = o.stream or io.stderr, terminal = o.terminal, clock = o.clock or core.clock,
    width = o.width, count = 0, failed = 0, passed = 0, computed = 0 }, progress)
  self.start = self.clock()
  return self
end

local function note_best(self, record)
  if not self.result or not judge.pass(self.own, record) then return end
  local value = judge.value(self.own, self.result, record)
  if not value or self.best and value >= self.best then return end
  self.best, self.best_number = value, record.number
end

local function facts(self, now)
  local parts, elapsed = {}, now - self.start
  if self.best then parts[1] = ("best %.5g (no. %d)"):format(self.best, self.best_number)
  elseif self.result and #self.own.constraints > 0 then parts[1] = "none meets the constraints yet"
  elseif #self.own.constraints > 0 and not self.result then parts[1] = ("%d pass"):format(self.passed) end
  if self.failed > 0 then parts[#parts + 1] = ("%d failed"):format(self.failed) end
  -- on a cluster the first says nothing: it was computed here
  if self.computed > (self.own.on == "slurm" and 1 or 0) and elapsed > 0 then
    local rate = self.computed / elapsed
    parts[#parts + 1] = rate >= 1 and ("%.3g/s"):format(rate) or ("%.3g/min"):format(60 * rate)
    if self.total and self.count < self.total then
      parts[#parts + 1] = "left " .. number.duration((self.total - self.count) / rate)
    end
  end
  return parts
end

--- Returns the line in at most `columns`; the last facts are left out first.
function progress:line(now, columns)
  local of = self.total and (self.most and " of at most %d" or " of %d"):format(self.total) or ""
  local head = ("%s: %s  %d%s"):format(self.own.name:gsub("%c", " "), self.method, self.count, of)
  local parts = facts(self, now)
  while #parts > 0 do
    local line = head .. "  " .. table.concat(parts, ", ")
    if number.columns(line) < columns then return line end
    table.remove(parts)
  end
  return head:sub(1, (utf8.offset(head, columns) or #head + 1) - 1)
end

--- Counts a record, if one is given, and shows the line. known: it was in the journal.
function progress:update(record, known)
  if record then
    self.count = self.count + 1
    if not known then self.computed = self.computed + 1 end
    if record.failed then self.failed = self.failed + 1 end
    if judge.pass(self.own, record) then self.passed = self.passed + 1 end
    note_best(self, record)
  end
  if self.terminal == false then return end
  local now = self.clock()
  if now - self.start < AFTER or self.shown and now - self.shown < GAP then return end
  if self.terminal == nil then self.terminal = bar.is_terminal() end
  if not self.terminal then return end
  if not self.columns or now - self.measured > WIDTH then
    self.columns, self.measured = self.width or bar.terminal_width(), now
  end
  self.stream:write("\r", self:line(now, self.columns), "\27[K")
  self.stream:flush()
  self.shown, self.drawn = now, true
end

--- Removes the line, so that something else can be printed.
function progress:clear()
  if not self.drawn then return end
  self.stream:write "\r\27[K"
  self.stream:flush()
  self.drawn, self.shown = false, nil
end

return progress
