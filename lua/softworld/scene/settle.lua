-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:settle with error bars.
-- @module softworld.scene.settle
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local kept = require "softworld.run.kept"
local counted = require "softworld.output.number".count
local process = require "softworld.run.process"
local trust = require "softworld.run.trust"
local unread = require "softworld.unread"

local Settled = { __name = "settled" }

function Settled.__index(result, key)
  if key == "error_bars" then return trust.error_bars end
  return trust.refuse(result, key)
end

function Settled:__tostring()
  if not self.ok then return ("not settled: %s"):format(self.reason) end
  local unmet = trust.unmet(self)
  return ("settled on %s%s\n%s"):format(counted(#self.levels, "level"), unmet and ", " .. unmet or "",
    tostring(self:error_bars()))
end

local Rest = { __name = "rest" }
Rest.__index = checks.fields("the result of scene:settle",
  "ok reason iterations residual unstable transient jumped",
  "kinked held steps rejected evaluations quantities met levels advice error_bars where refused asked start")

function Rest:__tostring()
  if not self.ok then return self.reason end
  local unstable = self.unstable > 0 and ", unstable in " .. counted(self.unstable, "direction") or ""
  local kinked, held = self.kinked and "; " .. self.kinked or "", self.held and "; " .. self.held or ""
  return ("at rest after %s%s%s%s"):format(counted(self.iterations, "iteration"), unstable, kinked, held)
end

local core_settle = core.class.scene.settle
local TOLD = { kink = "kinked", held = "held" } -- fields of the result with the text of such an event

-- Returns the last event of each object of these kinds; its count tells how often it was reported.
local function events(scene)
  local found = {}
  for _, e in ipairs(scene:events()) do if TOLD[e.kind] then found[e.kind .. " " .. e.object] = e end end
  return found
end

local function settle(scene, args)
  build.check(scene, "scene:settle", 4)
  local before, data = events(scene), build.data(scene)
  kept.begin(scene)
  data.runs = (data.runs or 0) + 1 -- peaks start again, as in a run
  local rest = build.call(3, core_settle, scene, args)
  for key, e in pairs(rest.ok and events(scene) or {}) do
    if not before[key] or before[key].count < e.count then rest[TOLD[e.kind]] = e.text end
  end
  return setmetatable(rest, Rest)
end

local function with_bars(scene, given)
  local args = {}
  for k, v in pairs(given) do args[k] = v end
  local job = trust.job(scene, "scene:settle", args)
  local shown = args.progress
  if shown ~= nil and type(shown) ~= "boolean" then
    error("scene:settle: progress must be true or false, got " .. type(shown), 0)
  end
  args.progress = nil
  for _, q in ipairs(job.quantities) do
    if q.at then
      error(("scene:settle: tolerance: quantity '%s': at is a time of a run, and settling has none; leave it "
        .. "out"):format(q.name), 0)
    end
  end
  job.advice = "hold wires that can move freely, use smaller moves, or give a larger max_iterations"
  core.check_settle(args)
  local iterations = 0
  local result = trust.once(job, function(_, level)
    local r = settle(scene, args)
    if shown then
      io.stderr:write(("%s, %s: %s, %s\n"):format(scene.name, level, r.reason,
        counted(r.iterations, "iteration")))
    end
    iterations = iterations + r.iterations
    r.start = scene.time
    return r
  end)
  job.begin_processes() -- settling did not start any of them
  result.iterations = iterations
  return setmetatable(result, Settled)
end

--- Static equilibrium: { tolerance = [m], max_iterations = }. Jaws of grippers that hold with a
-- force keep that force; others keep their opening. With a table of quantities as tolerance
-- the result has error bars, see help "tolerance"; progress = true then prints every level.
function core.class.scene.settle(scene, args)
  process.guard "scene:settle"
  unread.used()
  if not trust.wanted(args) then return settle(scene, args) end
  build.check(scene, "scene:settle", 3)
  return build.call(3, with_bars, scene, args)
end

return settle
