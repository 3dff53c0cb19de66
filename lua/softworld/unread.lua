-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs that failed, and whether anybody has looked: the host program tells of the others when the
-- script is over.
-- @module softworld.unread
local unread = {}

local MOST = 20 -- texts that are kept, and told
local texts, kept, last = {}, 0, 0
local more = 0 -- failures beyond those kept
local bad = 0  -- runs that failed or were stopped, whether anybody looked or not
local verdicts = { PASS = 0, FAIL = 0, OPEN = 0 } -- of checks

--- Remember a failure; gives its mark.
function unread.add(text)
  last, bad = last + 1, bad + 1
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

--- A run was stopped before its end.
function unread.cut() bad = bad + 1 end

--- A run was checked, with this verdict.
function unread.judged(verdict) verdicts[verdict] = verdicts[verdict] + 1 end

--- Of `softworld --check`, at the end of a script: its exit code and a line that tells why.
function unread.exit()
  local made = verdicts.PASS + verdicts.FAIL + verdicts.OPEN
  local text = ("softworld: %d checks: %d pass, %d fail, %d open"):format(made, verdicts.PASS, verdicts.FAIL,
    verdicts.OPEN)
  if bad > 0 then text = ("%s; %d runs failed or were cut short"):format(text, bad) end
  if verdicts.FAIL > 0 or bad > 0 then return 3, text end
  if verdicts.OPEN > 0 then return 4, text end
  if made == 0 then return 2, "softworld: no check was made; run:check{} makes one" end
  return 0, text
end

--- For `softworld --check`: a script that leaves by os.exit leaves with what its checks found, unless it
-- fails by itself.
function unread.guard_exit()
  local leave = os.exit
  function os.exit(code, close) -- luacheck: ignore 122
    local status, text = unread.exit()
    io.stderr:write(text, "\n")
    local fails = code == false or math.type(code) == "integer" and code ~= 0
    leave(fails and code or status, close)
  end
end

--- Call f and return its results. Failures within it need no look: f judges its runs by other means. Nor do
-- checks within it count.
function unread.excused(f, ...)
  local before, more_before, bad_before = last, more, bad
  local counted = { PASS = verdicts.PASS, FAIL = verdicts.FAIL, OPEN = verdicts.OPEN }
  local function done(...)
    bad, verdicts = bad_before, counted
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
