-- SPDX-License-Identifier: GPL-3.0-or-later
--- The placeholder that `softworld lint` gives for the result of a run: it accepts every call, index and
-- operation, and the result is the placeholder again. Loops that wait for a result would never end with it,
-- so the number of its uses is limited.
-- @module softworld.program.nothing
local place = require "softworld.place"

local nothing = {}

local MOST = 100000 -- uses of the placeholder in a script, and runs
local REPEATED = 1000 -- errors about that, before lint takes the script to swallow them

nothing.MOST = MOST
nothing.used = false -- true once a run was left out

local Nothing = { __name = "result of a run that lint leaves out" }
local it = setmetatable({}, Nothing)
nothing.it = it

local ipairs = ipairs -- lint replaces the global one
local count = 0

--- Called when a script goes on although it was told to stop; it must not return.
function nothing.give_up() os.exit(1) end

--- Stops the script with an error that says why.
function nothing.stop(why)
  count = math.max(count, MOST) + 1
  if count > MOST + REPEATED then nothing.give_up(why) end
  error(("%s: %s"):format(place.of_caller() or "?", why), 0)
end

--- Counts a use; raises an error beyond the limit.
function nothing.use()
  nothing.used = true
  count = count + 1
  if count > MOST then
    nothing.stop(("a loop seems to wait for the result of a run; it was used %d times"):format(MOST))
  end
end

local use = nothing.use

--- Returns the placeholder, for any arguments.
function nothing.itself()
  use()
  return it
end

for _, event in ipairs { "add", "sub", "mul", "div", "mod", "pow", "unm", "idiv", "index", "call",
  "concat" } do
  Nothing["__" .. event] = nothing.itself
end
function Nothing.__lt()
  use()
  return false
end
function Nothing.__le()
  use()
  return true
end
function Nothing.__len() return 0 end
function Nothing.__newindex() end
function Nothing.__tostring() return "?" end

local function once(_, k)
  if k == 0 then return 1, it end
end

--- An ipairs that goes once through the placeholder; without it the loop never ended, as no item is nil.
function nothing.ipairs(...)
  if rawequal((...), it) then return once, it, 0 end
  return ipairs(...)
end

return nothing
