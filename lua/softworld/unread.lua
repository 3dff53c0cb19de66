-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs that failed, and whether anybody has looked: the host program tells of the others when the
-- script is over.
-- @module softworld.unread
local unread = {}

local texts, last = {}, 0
local MOST = 20 -- that are told

--- Remember a failure; gives its number.
function unread.add(text)
  last = last + 1
  texts[last] = text
  return last
end

--- Somebody looked.
function unread.seen(number) texts[number] = nil end

--- What f(...) returns; of failures within it that nobody looked at nothing is told: it judges runs by
-- other means.
function unread.excused(f, ...)
  local before = last
  local function done(...)
    for number = before + 1, last do texts[number] = nil end
    return ...
  end
  return done(f(...))
end

--- For the end of a script: what is to be told, or nil. Forgets it.
function unread.finish()
  local numbers, lines = {}, {}
  for number in pairs(texts) do numbers[#numbers + 1] = number end
  if #numbers == 0 then return nil end
  table.sort(numbers)
  for i = 1, math.min(MOST, #numbers) do lines[i] = texts[numbers[i]] end
  if #numbers > MOST then lines[#lines + 1] = ("softworld: and %d more"):format(#numbers - MOST) end
  texts = {}
  return table.concat(lines, "\n")
end

return unread
