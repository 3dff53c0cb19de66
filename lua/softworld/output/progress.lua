-- SPDX-License-Identifier: GPL-3.0-or-later
--- Shows the progress of a run: a bar on a terminal, plain lines elsewhere.
--
--    local bar <close> = progress.new{ total = 5.0 }   -- [s] simulated
--    bar:update(t, steps)                              -- as often as you like
--    bar:finish()
--
-- If an error leaves the block, the close metamethod clears the bar.
-- @module softworld.output.progress

local checks = require "softworld.checks"
local number = require "softworld.output.number"
local sink = require "softworld.output.sink"

local progress = {}
progress.__index = progress
progress.__name = "softworld progress"

local redraw_gap = 0.1 -- [s] between two drawings of the bar
local line_gap = 3.0   -- [s] between two plain lines
local width_gap = 2.0  -- [s] between two queries of the terminal's width
local long_after = 10  -- [s] after which a bar that is not shown tells once that much is left
local long_left = 600  -- [s] left, from which on it does

-- A clock for plain Lua, which has whole seconds of real time and fine processor time. Together
-- they never run ahead of real time in a single thread.
local function fallback_clock()
  local wall, cpu = os.time(), os.clock()
  return function() return math.max(os.clock() - cpu, os.difftime(os.time(), wall) - 1) end
end

--- True if stderr is a terminal that can show a bar.
function progress.is_terminal()
  return os.getenv("TERM") ~= "dumb" and os.execute("test -t 2") == true
end

--- Returns the terminal's width [columns].
function progress.terminal_width()
  local pipe = io.popen("stty size <&2 2>/dev/null", "r")
  local text = pipe and pipe:read("a") or ""
  if pipe then pipe:close() end
  local columns = tonumber(text:match("%d+%s+(%d+)")) or tonumber(os.getenv("COLUMNS"))
  return columns and columns > 0 and columns or 80
end

--- Starts to show progress.
-- @tparam[opt] table options
-- `after` real time before anything is shown; runs that end sooner show nothing [s];
-- `total` simulated time to reach [s], nil if the processes decide;
-- `name` shown in front; `word` name of the steps; `quiet = true` shows nothing;
-- `long = true` a quiet one says once if many minutes are left;
-- `passing = true` the line is only removed at the end, for one of several runs;
-- `timeless` what is done, for work whose share done is not known: `update()` shows how long it takes;
-- `since` when it began, by the clock, default now [s];
-- `stream` (default io.stderr); `terminal` true or false (default: asked of
-- the system for stderr, false for another stream);
-- `width` columns or a function giving them; `clock` a function giving real time [s]
-- @treturn table with update, finish, fail
function progress.new(options)
  options = options or {}
  if options.total ~= nil and not (type(options.total) == "number" and options.total > 0) then
    sink.fail("progress: total must be a positive time [s], got %s", checks.shown(options.total))
  end
  local self = setmetatable({}, progress)
  self.total, self.name, self.quiet = options.total, options.name, options.quiet or false
  self.passing, self.timeless = options.passing or false, options.timeless
  self.long = self.quiet and options.long and self.total ~= nil
  self.stream = options.stream or io.stderr
  self.clock = options.clock or fallback_clock()
  self.word = options.word or "steps"
  self.start, self.time, self.steps = options.since or self.clock(), 0.0, 0
  self.after = options.after or 0
  self.early = self.after > 0
  self.terminal = options.terminal
  if self.terminal == nil and not self.quiet then
    self.terminal = self.stream == io.stderr and progress.is_terminal()
  end
  self.width = options.width or progress.terminal_width
  return self
end

local function columns_of(self, now)
  if type(self.width) == "number" then return self.width end
  if not self.columns or now - self.columns_at >= width_gap then
    self.columns, self.columns_at = self.width(), now
  end
  return self.columns
end

-- Returns the share done, or nil if the total is unknown.
local function share_of(self)
  return self.total and math.max(0, math.min(1, self.time / self.total))
end

local function facts(self, now)
  local elapsed = now - self.start
  if self.timeless then return { ("%s for %s"):format(self.timeless, number.duration(elapsed)) } end
  local parts = { number.text(self.time, "s") }
  if self.total then parts[1] = string.format("t = %s of %s", parts[1], number.text(self.total, "s"))
  else parts[1] = "t = " .. parts[1] end
  parts[#parts + 1] = string.format("%d %s", self.steps, self.word)
  if elapsed > 0 and self.time > 0 then
    parts[#parts + 1] = number.digits(self.time / elapsed, 3) .. " x real time"
    local share = share_of(self)
    if share and share < 1 then
      parts[#parts + 1] = "left " .. number.duration(elapsed * (1 - share) / share)
    end
  end
  return parts
end

local spin = { "|", "/", "-", "\\" }

local function front(self)
  local share = share_of(self)
  local label = self.name and self.name:gsub("%c", " ") .. " " or ""
  if share then return label .. string.format("%3d %%", math.floor(share * 100)) end
  self.turn = (self.turn or 0) % #spin + 1
  return label .. spin[self.turn]
end

-- Returns the line with as many facts as fit; the bar takes the rest, from 10 to 40 columns.
local function bar_line(self, now, columns)
  local room = columns - 1
  local head, parts = front(self), facts(self, now)
  local tail = table.concat(parts, ", ")
  while #parts > 1 and number.columns(head .. tail) + (self.total and 15 or 2) > room do
    table.remove(parts)
    tail = table.concat(parts, ", ")
  end
  local length = math.min(40, room - number.columns(head .. tail) - 5)
  if self.total and length >= 5 then
    local filled = math.floor(share_of(self) * length)
    head = head .. " [" .. string.rep("#", filled) .. string.rep("-", length - filled) .. "]"
  end
  local line = head .. "  " .. tail
  if number.columns(line) <= room then return line end
  return line:sub(1, (utf8.offset(line, math.max(room, 0) + 1) or #line + 1) - 1)
end

local function draw(self, now)
  self.stream:write("\r", bar_line(self, now, columns_of(self, now)), "\27[K")
  self.stream:flush()
  self.drawn = true
end

local function say(self, now)
  self.stream:write(front(self), "  ", table.concat(facts(self, now), ", "), "\n")
  self.stream:flush()
end

-- Says once how long a run without a bar will take, if that is long.
local function tell_long(self, time)
  local elapsed = self.clock() - self.start
  if elapsed < long_after or time <= 0 then return end
  self.long = false
  local left = elapsed * (self.total / time - 1)
  if left < long_left then return end
  self.stream:write(("%s: %s computed in %s; the rest of %s takes about %s; progress = true shows how far it "
    .. "is\n"):format((self.name or "run"):gsub("%c", " "), number.text(time, "s"), number.duration(elapsed),
    number.text(self.total, "s"), number.duration(left)))
  self.stream:flush()
end

--- Updates how far the run is. Cheap: draws at most ten times a second on a
-- terminal and prints at most one line every few seconds elsewhere.
-- @tparam number time simulated so far [s]
-- @tparam ?integer steps so far
function progress:update(time, steps)
  if self.long then tell_long(self, time) end
  if self.quiet or self.ended then return end
  self.time, self.steps = time or 0, math.tointeger(steps) or self.steps
  local now = self.clock()
  if self.early and now - self.start < self.after then return end
  self.early = false
  if self.shown and now - self.shown < (self.terminal and redraw_gap or line_gap) then return end
  self.shown = now
  if self.terminal then draw(self, now) else say(self, now) end
end

--- Removes the bar from the terminal, so that something else can be printed;
-- the next update draws it again.
function progress:clear()
  if self.drawn then
    self.stream:write("\r\27[K")
    self.stream:flush()
  end
  self.drawn = false
  if self.terminal then self.shown = nil end
end

local function last_line(self, format, ...)
  if self.quiet or self.ended or self.early then return end
  self:clear()
  self.ended = self.passing
  if self.passing then return end
  local label = self.name and self.name:gsub("%c", " ") .. ": " or ""
  self.stream:write(label, string.format(format, ...), "\n")
  self.stream:flush()
  self.ended = true
end

--- Ends a successful run: clears the bar and prints one last line.
function progress:finish()
  last_line(self, "t = %s, %d %s in %s", number.text(self.time, "s"), self.steps, self.word,
    number.duration(self.clock() - self.start))
end

--- Ends a failed run: clears the bar and prints why.
-- @tparam string reason
function progress:fail(reason)
  last_line(self, "stopped at t = %s after %d %s: %s", number.text(self.time, "s"), self.steps, self.word,
    (tostring(reason):gsub("%c", " ")))
end

--- Leaves the block: an error clears the bar without a message (the error
-- has its own), an ordinary end finishes the bar.
function progress:__close(failure)
  if failure ~= nil then
    if not self.quiet then self:clear() end
    self.ended = true
  else
    self:finish()
  end
end

return progress
