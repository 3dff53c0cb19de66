-- SPDX-License-Identifier: GPL-3.0-or-later
--- The summary of a run for the terminal.
-- @module softworld.output.summary

local number = require "softworld.output.number"
local sink = require "softworld.output.sink"

local summary = {}

local function plain(text)
  return (tostring(text):gsub("%c", " "))
end

local function status(run)
  local time = number.text(run.time or 0 / 0, "s")
  if run.ok then
    local line = string.format("%s: ok, %s after %s",
      plain(run.name or "run"), plain(run.reason or "ended"), time)
    if run.steps then line = line .. ", " .. number.count(run.steps, "step") end
    if run.wall then line = line .. ", took " .. number.duration(run.wall) end
    if run.model then line = line .. "\n  " .. plain(run.model:match "^[^\n]*")
      .. "; run:why() tells more" end
    if run.unmet then line = line .. "\n  ! " .. plain(run.unmet) end
    return line
  end
  local reason = plain(run.reason or "no reason given"):gsub("^at t = [^:]*: ", "") -- the time is there
  return string.format("%s: DIVERGED at t = %s: %s", plain(run.name or "run"), time, reason)
end

-- Returns label, value, unit, place, time and note of an entry. The note is what is in brackets at the end of
-- `where`; it is long, and stands last.
local function cells(entry)
  local value, unit, where = entry.value, "", plain(entry.where or "")
  if type(value) == "number" then value, unit = number.engineering(value, entry.unit) end
  local place, note = where:match "^([^(]*)(%(.*%))$"
  local at = (place or where):gsub("%s+$", "")
  local time = entry.when and "t = " .. number.text(entry.when, "s") or ""
  return { plain(entry.label), value, unit, at, time, note or "" }
end

local function pad(text, width, right)
  local gap = string.rep(" ", width - number.columns(text))
  return right and gap .. text or text .. gap
end

local function widths_of(rows)
  local widths = { 0, 0, 0, 0, 0, 0 }
  for _, row in ipairs(rows) do
    for c, text in ipairs(row) do widths[c] = math.max(widths[c], number.columns(text)) end
  end
  return widths
end

local most_events = 12 -- lines of events

-- Adds the first events, and the number of the others.
local function add_events(lines, events)
  for i, e in ipairs(events) do
    if i > most_events and #events > most_events + 1 then
      lines[#lines + 1] = ("  ! and %d more events, see run.events"):format(#events - most_events)
      return
    end
    local times = e.count > 1
      and (" (%d times until t = %s)"):format(e.count, number.text(e.last, "s")) or ""
    lines[#lines + 1] = ("  ! t = %s: %s%s"):format(number.text(e.time, "s"), plain(e.text), times)
  end
end

--- Returns the summary as text.
-- First the state of the run, then one aligned row per entry: label, value
-- with four significant digits, unit, place, time and note; last the events. A run
-- that diverged gives its reason and no numbers.
-- @tparam table run with `name, ok, reason, time [s], steps, wall [s], events, unmet, model` and
-- `summary = { { label=, value= number or text, unit=, where=, when= [s] }, ... }`
-- @treturn string lines, each ended by a newline
function summary.text(run)
  if type(run) ~= "table" or run.ok == nil then sink.fail("summary: a run is expected") end
  local lines = { status(run) }
  if run.ok then
    local rows = {}
    for i, entry in ipairs(run.summary or {}) do rows[i] = cells(entry) end
    local widths = widths_of(rows)
    for _, row in ipairs(rows) do
      local padded = {}
      for c, text in ipairs(row) do padded[c] = pad(text, widths[c], c == 2) end
      padded[2] = padded[2] .. " " .. table.remove(padded, 3)
      lines[#lines + 1] = ("  " .. table.concat(padded, "  ")):gsub("%s+$", "")
    end
  else
    lines[#lines + 1] = "  no results are given for a run that diverged"
  end
  add_events(lines, run.events or {})
  return table.concat(lines, "\n") .. "\n"
end

--- Prints the summary.
-- @tparam table run see summary.text
-- @param[opt=io.stdout] stream an open file
function summary.print(run, stream)
  (stream or io.stdout):write(summary.text(run))
end

return summary
