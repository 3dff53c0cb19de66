-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds the true values of a scene of bench.auto.
-- @module bench.autotruth
local sw = require "softworld"

local autotruth = {}

local COARSE, FINE = 4, 6 -- levels of a first run, to estimate the time; levels of the final run [-]
local LONGEST = 120       -- longest allowed time [s]

local function tolerance(names, share)
  local t = {}
  for _, name in ipairs(names) do t[name] = { relative = share } end
  return t
end

--- Runs build(options) with the relative tolerance share for each quantity. Returns the run, its reason and
-- its time [s]; nil and the reason if it fails.
function autotruth.run(build, options, share, levels, static)
  local scene, names, duration = build(options)
  if options.settle ~= false then scene:settle() end
  local clock = sw.core.clock()
  local fine, r = pcall(scene.run, scene, { duration = duration, tolerance = tolerance(names, share),
    levels = levels,
    quasistatic = static, dt = static and 0.04 or nil })
  if not fine then return nil, r end
  return r.ok and r or nil, r.reason, sw.core.clock() - clock
end

--- Returns the true values, from far finer runs of the most expensive model; nil and the reason if that would
-- take too long. kind.joined: wires do not roll, because such wires pass no twist at joints. kind.flat: a
-- single wire that stays in a plane. There friction does not twist it, and a wire that does not roll touches
-- pegs with a smooth curve, so much coarser edges are enough.
function autotruth.values(build, moves, share, kind)
  local options = { rolls = not (kind.flat or kind.joined), contact = not kind.flat, settle = not moves }
  local truth, why, took = autotruth.run(build, options, share, COARSE)
  if not truth or truth.met then return truth, why, took end
  local n = #truth.levels -- fewer than COARSE if the run ended early
  local last, before = truth.levels[n].cpu, truth.levels[n - 1].cpu
  local growth, expected = last / math.max(before, 1e-3), 0
  for k = 1, FINE - n do expected = expected + last * growth ^ k end
  if expected > LONGEST then return nil, ("to know what is true would take about %.0f s"):format(expected) end
  return autotruth.run(build, options, share, FINE)
end

return autotruth
