-- SPDX-License-Identifier: GPL-3.0-or-later
--- Ensures that one process at a time works on a journal with tasks on a cluster, even across machines whose
-- locks may not see one another. A file made by O_EXCL names the owner, who writes a new number into it every
-- few seconds. Another process takes over if the owner was a process of this machine that is gone, or if the
-- number of another machine's owner has not changed for a while. If two processes write all the same (after
-- the file system was away for long), nothing is lost: both write the same bits, and the one that finds the
-- other's name stops.
-- @module softworld.study.owner
local core = require "softworld.core"
local sends = require "softworld.study.sends"

local owner = {}
owner.__index = owner

local BEAT = 5      -- time between two numbers [s]
owner.PATIENCE = 30 -- longest time without a new number [s]

local function fail(text, ...) error(text:format(...), 0) end

-- Returns when a process was started, in the system's ticks; nil: it is gone.
local function birth(pid)
  local file = io.open(("/proc/%s/stat"):format(pid))
  local text = file and file:read "a"
  if file then file:close() end
  if not text then return nil end
  local at, born = 0, nil
  for word in text:match "^.*%)(.*)$":gmatch "%S+" do -- after the name
    at = at + 1
    if at == 1 and word == "Z" then return nil end
    if at == 20 then born = word end
  end
  return born
end

local function text_of(self) return ("%s %s %d\n"):format(self.who, self.born, self.beats) end

-- True if the owner named by a text is certainly gone.
local function is_gone(text, host)
  local his, pid, born = text:match "^(%S+)%.(%d+) (%d+) %d+\n$"
  if not his then return false end
  return his == host and birth(pid) ~= born
end

-- Waits whether the number changes: true if it did not.
local function is_silent(self, text)
  local started = core.clock()
  io.stderr:write(("study '%s': %s says that process %s works on it; looking for %d s whether it is alive\n")
    :format(self.name, self.path, text:match "^%S*", owner.PATIENCE))
  while core.clock() - started < owner.PATIENCE do
    core.ready({}, 0.5)
    if sends.text(self.path) ~= text then return false end
  end
  return true
end

-- Renames the file of an owner that is gone. If others try the same, the one that succeeds in renaming
-- continues.
local function put_away(self, text)
  local aside = self.path .. "." .. self.who
  if not os.rename(self.path, aside) then return end
  if sends.text(aside) ~= text and not core.kind(self.path) then -- a new owner's: too late
    os.rename(aside, self.path)
  end
  os.remove(aside)
end

--- Makes this process the owner, or raises an error. folder: that of the study's sends.
function owner.claim(name, folder)
  local who = sends.who()
  local host, pid = who:match "^(.*)%.(%d+)$"
  local self = setmetatable({ name = name, path = folder .. "/owner", who = who, born = birth(pid) or "0",
    beats = 0 }, owner)
  for _ = 1, 5 do
    local made, why = core.create(self.path, text_of(self))
    if made then
      self.at = core.clock()
      return self
    end
    if why ~= "busy" then fail("study '%s': cannot write %s: %s", name, self.path, why) end
    local text = sends.text(self.path)
    if text and text ~= "" then
      if not is_gone(text, host) and (text:match "^(.*)%.%d+ " == host or not is_silent(self, text)) then
        fail("study '%s': process %s already works with its journal; let it end first, or cancel", name,
          text:match "^%S*")
      end
      put_away(self, text)
    else
      core.ready({}, 0.2) -- the file is being made, or has gone
    end
  end
  fail("study '%s': cannot lock %s; remove the file if no other process works on this study", name,
    self.path)
end

--- Shows now and then that this process is alive. Raises an error if another one has taken over.
function owner:beat()
  if core.clock() - self.at < BEAT then return end
  if sends.text(self.path) ~= text_of(self) then
    self.lost = true
    fail("study '%s': another process has taken over its journal (%s)", self.name, self.path)
  end
  self.beats, self.at = self.beats + 1, core.clock()
  sends.put(self.path, text_of(self))
end

--- Gives up the ownership.
function owner:release()
  if not self.lost and sends.text(self.path) == text_of(self) then os.remove(self.path) end
end

return owner
