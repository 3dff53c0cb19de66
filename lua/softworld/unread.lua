-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs that failed, and whether anybody has looked: the host program tells of the others when the
-- script is over.
-- @module softworld.unread
local unread = {}

local MOST = 20 -- texts that are kept, and told
local texts, kept, last = {}, 0, 0
local more = 0 -- failures beyond those kept

--- Remember a failure; gives its mark.
function unread.add(text)
  last = last + 1
  local mark = { number = last }
  if kept < MOST then
    texts[last], kept = text, kept + 1
  else
    more = more + 1
  end
  return mark
end

--- Somebody looked.
function unread.seen(mark)
  if mark.seen then return end
  mark.seen = true
  if texts[mark.number] then
    texts[mark.number], kept = nil, kept - 1
  elseif more > 0 then
    more = more - 1
  end
end

--- Call f and return its results. Failures within it need no look: f judges its runs by other means.
function unread.excused(f, ...)
  local before, more_before = last, more
  local function done(...)
    for number in pairs(texts) do
      if number > before then texts[number], kept = nil, kept - 1 end
    end
    more = math.min(more, more_before)
    return ...
  end
  return done(f(...))
end

--- At the end of a script: the text to be told, or nil. Forgets it.
function unread.finish()
  local numbers, lines = {}, {}
  for number in pairs(texts) do numbers[#numbers + 1] = number end
  table.sort(numbers)
  for i, number in ipairs(numbers) do lines[i] = texts[number] end
  if more > 0 then lines[#lines + 1] = ("softworld: and %d more"):format(more) end
  texts, kept, more = {}, 0, 0
  return #lines > 0 and table.concat(lines, "\n") or nil
end

return unread
