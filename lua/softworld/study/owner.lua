-- SPDX-License-Identifier: GPL-3.0-or-later
--- One process at a time works on a journal whose tasks are on a cluster, also from several machines, whose
-- locks may not know of one another. A file made by O_EXCL says who it is; he writes a new number into it
-- every few seconds. It is taken over from a process of this machine that is gone, and from another
-- machine's when the number has not changed for a while. Should two of them write all the same (the file
-- system was away for long), nothing is lost: both write the same bits, and the one that finds the other's
-- name stops.
-- @module softworld.study.owner
local core = require "softworld.core"
local sends = require "softworld.study.sends"

local owner = {}
owner.__index = owner

local BEAT = 5      -- between two numbers [s]
owner.PATIENCE = 30 -- without a new number [s]

local function fail(text, ...) error(text:format(...), 0) end

-- When a process was begun, in the system's ticks; nil: it is gone.
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

-- Is the one that a text tells certainly gone?
local function is_gone(text, host)
  local his, pid, born = text:match "^(%S+)%.(%d+) (%d+) %d+\n$"
  if not his then return false end
  return his == host and birth(pid) ~= born
end

-- Wait whether the number changes: true if it did not.
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

-- Put away the file of one that is gone. Another one may do the same: who renames it is the one.
local function put_away(self, text)
  local aside = self.path .. "." .. self.who
  if not os.rename(self.path, aside) then return end
  if sends.text(aside) ~= text and not core.kind(self.path) then -- a new one: it was too late
    os.rename(aside, self.path)
  end
  os.remove(aside)
end

--- Become the owner, or raise. folder: that of the study's sends.
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
      core.ready({}, 0.2) -- it is being made, or has gone
    end
  end
  fail("study '%s': cannot lock %s; remove the file if no other process works on this study", name,
    self.path)
end

--- Say that this process is alive, now and then. Raises where another one has taken over.
function owner:beat()
  if core.clock() - self.at < BEAT then return end
  if sends.text(self.path) ~= text_of(self) then
    self.lost = true
    fail("study '%s': another process has taken over its journal (%s)", self.name, self.path)
  end
  self.beats, self.at = self.beats + 1, core.clock()
  sends.put(self.path, text_of(self))
end

--- Be it no more.
function owner:release()
  if not self.lost and sends.text(self.path) == text_of(self) then os.remove(self.path) end
end

return owner
