-- SPDX-License-Identifier: GPL-3.0-or-later
--- What is true of a scene of bench.auto.
-- @module bench.autotruth
local sw = require "softworld"

local autotruth = {}

local COARSE, FINE = 4, 6 -- levels: of a first look at how long it takes to know, and to know [-]
local LONGEST = 120       -- that it may take [s]

local function tolerance(names, share)
  local t = {}
  for _, name in ipairs(names) do t[name] = { relative = share } end
  return t
end

--- A run of build(options) with that share of its quantities as tolerance; else nil and why. Also its
-- time [s].
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

--- What is true, by far finer runs of the dearest model; nil where that would take too long, and why. flat: a
-- single wire that stays in a plane; there friction does not twist it, and one that does not roll meets pegs
-- by its curve, of which far coarser edges tell as much.
function autotruth.values(build, moves, share, flat)
  local options = { rolls = not flat, contact = not flat, settle = not moves }
  local truth, why, took = autotruth.run(build, options, share, COARSE)
  if not truth or truth.met then return truth, why, took end
  local n = #truth.levels -- fewer than COARSE, where those would not tell
  local last, before = truth.levels[n].cpu, truth.levels[n - 1].cpu
  local growth, expected = last / math.max(before, 1e-3), 0
  for k = 1, FINE - n do expected = expected + last * growth ^ k end
  if expected > LONGEST then return nil, ("to know what is true would take about %.0f s"):format(expected) end
  return autotruth.run(build, options, share, FINE)
end

return autotruth
