-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes the file of `softworld --log FILE`: what was run, when, and how it ended, with remarks and errors.
-- Lines are appended, each with the time of day, and reach the file at once.
-- @module softworld.program.log
local counted = require "softworld.output.number".count

local log = {}

local file, path

--- Writes one entry; its further lines are indented. A full disk is reported once, and the program goes on.
function log.line(text)
  if not file then return end
  text = tostring(text):gsub("\n+$", ""):gsub("\n", "\n    ")
  local fine, why = file:write(os.date "%Y-%m-%d %H:%M:%S", "  ", text, "\n")
  if fine then fine, why = file:flush() end
  if fine then return end
  file:close()
  file = nil
  io.stderr:write(("softworld: cannot write the log %s: %s\n"):format(path, tostring(why)))
end

local function told(what, fine, ...)
  if not fine then
    log.line(("%s: %s"):format(what, tostring((...))))
    error((...), 0)
  end
  return ...
end

-- Logs how a run ended. It does not read run.ok, which would count as the script's look at a failure.
local function ended(run)
  local sealed = require "softworld.sealed"
  local own = sealed.fields(run)
  local reason = own.failure and own.failure.reason or own.reason
  log.line(("run of '%s': %s (%s), t = %.6g s, %s, %.3g s of computing"):format(own.name,
    own.failure and "FAILED" or "ok", reason, own.time, counted(own.steps, "step"), own.cpu))
end

local function follow(class, name, finish)
  local method = class[name]
  class[name] = function(scene, ...)
    local what = "scene:" .. name
    local fine, called = pcall(function() return ("%s of '%s', from t = %.6g s"):format(what, scene.name,
      scene.time) end)
    log.line(fine and called or what)
    local result = table.pack(told(what, pcall(require("softworld.scene.build").through, method, scene, ...)))
    finish(result[1])
    return table.unpack(result, 1, result.n)
  end
end

local function settled(result)
  local reason = type(result) == "table" and require("softworld.unread").peek(result, "reason")
  log.line(("settle: %s"):format(tostring(reason or result)))
end

--- Opens the log; from then on it gets what the program does.
function log.open(name, script)
  local why
  file, why = io.open(name, "a")
  path = name
  if not file then error(("softworld: cannot write the log: %s"):format(why), 0) end
  local sw = require "softworld"
  log.line(("%s, SoftWorld %s"):format(script, sw.version))
  follow(sw.core.class.scene, "run", ended)
  follow(sw.core.class.scene, "settle", settled)
  local remarks = require "softworld.remarks"
  local write = remarks.write
  function remarks.write(at, text)
    write(at, text)
    log.line(("%s: remark: %s"):format(at, text))
  end
end

return log
