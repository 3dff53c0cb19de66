-- SPDX-License-Identifier: GPL-3.0-or-later
--- Compares runs that choose their model with every fixed model and with far finer runs of the most expensive
-- model. The scenes are drawn at random, each with a tolerance of 10, 3 or 1 %.
-- @module bench.auto
local autoguided = require "bench.autoguided"
local autohandled = require "bench.autohandled"
local autoharness = require "bench.autoharness"
local autopressed = require "bench.autopressed"
local autosteady = require "bench.autosteady"
local autotruth = require "bench.autotruth"
local draw = require "bench.autodraw"
local sw = require "softworld"

local auto = {}

-- --- scenes: of(random) -> build(options) -> scene, names of quantities, duration [s] ----------------------

local between, pick, wire_of = draw.between, draw.pick, draw.wire_of
local made, finish = draw.made, draw.finish

auto.scenes = {
  { name = "hung", of = function(random)
    local section, duration = wire_of(random), pick(random, { 1, 3, 10, 40 })
    local span, near = between(random, 0.4, 0.8), between(random, 0.3, 0.7)
    return function(options)
      local scene = sw.scene{ name = "hung" }
      local w = made(scene, section, options, { name = "w", from = { 0, 0, 0 }, to = { span, 0, 0 } })
      scene:clamp(w, { s = 0, name = "left" })
      local right = scene:clamp(w, { s = span, name = "right" })
      right:follow{ points = { { span, 0, 0 }, { span * near, 0.1, 0.05 } }, duration = duration }
      return finish(scene, options), { "right.force", "min_bend_radius" }, duration
    end
  end },
  { name = "lifted", of = function(random)
    local section, duration = wire_of(random), pick(random, { 0.5, 2, 8, 30 })
    local mu, side = between(random, 0, 0.5), between(random, -0.15, 0.15)
    return function(options)
      local scene = sw.scene{ name = "lifted" }
      local r = section.radius
      scene:obstacle{ name = "table", shape = "plane", friction = mu < 0.1 and 0 or mu }
      local w = made(scene, section, options, { name = "w", from = { 0, 0, r }, to = { 0.6, 0, r } })
      local hand = scene:clamp(w, { s = 0, name = "hand" })
      hand:follow{ points = { { 0, 0, r }, { 0.05, side, 0.12 } }, duration = duration }
      return finish(scene, options), { "hand.force", "tip" }, duration
    end
  end },
  { name = "turned", of = function(random)
    local section, duration = wire_of(random), pick(random, { 1, 4 })
    local mu, turn = between(random, 0, 0.6), between(random, 0.3, 2.5)
    return function(options)
      local scene = sw.scene{ name = "turned" }
      local r = section.radius
      scene:obstacle{ name = "table", shape = "plane", friction = mu < 0.1 and 0 or mu }
      local w = made(scene, section, options, { name = "w", from = { 0, 0, r }, to = { 0.4, 0, r } })
      local hand = scene:clamp(w, { s = 0, name = "hand" })
      hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true, turn = { axis = { 1, 0, 0 },
        angle = turn },
        duration = duration }
      return finish(scene, options), { "hand.moment", "tip" }, duration
    end
  end },
  { name = "crossed", of = function(random)
    local section, duration = wire_of(random), pick(random, { 1, 4 })
    local gap, down = between(random, 0.02, 0.1), between(random, 0.03, 0.09)
    return function(options)
      local scene = sw.scene{ name = "crossed" }
      local a = made(scene, section, options, { name = "a", from = { -0.2, 0, 0 }, to = { 0.2, 0, 0 } })
      local b = made(scene, section, options, { name = "b", from = { 0, -0.2, gap }, to = { 0, 0.2, gap } })
      for k, w in ipairs{ a, b } do
        for i, s in ipairs{ 0, 0.4 } do
          local c = scene:clamp(w, { s = s, name = ("%s%d"):format(k == 1 and "a" or "b", i) })
          if k == 2 then
            c:follow{ points = { { 0, 0, 0 }, { 0, 0, -down } }, relative = true, duration = duration }
          end
        end
      end
      return finish(scene, options), { "b1.force", "a1.force" }, duration
    end
  end },
  { name = "dropped", of = function(random)
    local section, height = wire_of(random), between(random, 0.005, 0.05)
    local mu = pick(random, { 0, 0.3 })
    return function(options)
      local scene = sw.scene{ name = "dropped" }
      scene:obstacle{ name = "table", shape = "plane", friction = mu }
      local z = section.radius + height
      local w = made(scene, section, options, { name = "w", from = { 0, 0, z }, to = { 0.5, 0, z } })
      local hand = scene:clamp(w, { s = 0, name = "hand" })
      hand:follow{ points = { { 0, 0, 0 }, { 0, 0.03, 0 } }, relative = true, duration = 0.4 }
      return finish(scene, options), { "table.mean_force", "tip" }, 0.5
    end, true
  end },
  { name = "looped", of = function(random)
    local section, duration = wire_of(random), pick(random, { 1, 8 })
    local past = between(random, -0.05, 0.08)
    return function(options)
      local scene = sw.scene{ name = "looped" }
      local w = made(scene, section, options, { name = "w", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
        segments = 32 })
      scene:clamp(w, { s = 0, name = "left" })
      local off = 2.2 * section.radius
      scene:clamp(w, { s = 0.5, name = "right" }):follow{ relative = true, duration = duration,
        points = { { 0, 0, 0 }, { -0.25, 0.12, off }, { -0.5 - past, 0.02, off } },
        turn = { axis = { 0, 0, 1 }, angle = 1.5 * math.pi } }
      return finish(scene, options), { "min_bend_radius", "tip" }, duration
    end
  end },
}

for _, list in ipairs { autohandled.scenes, autoguided.scenes, autoharness.scenes, autopressed.scenes } do
  for _, kind in ipairs(list) do auto.scenes[#auto.scenes + 1] = kind end
end

-- --- one scene -------------------------------------------------------------------------------

-- Time to find the true values; above it, fixed models that say nothing about the chosen one are skipped [s].
local SLOW = 5

local run = autotruth.run

local function near(a, b)
  if type(a) == "number" then return math.abs(a - b) end
  local sum = 0
  for i, x in ipairs(a) do sum = sum + near(x, b[i]) ^ 2 end
  return sum ^ 0.5
end

local function size(a) return type(a) == "number" and math.abs(a) or near(a, { 0, 0, 0 }) end

local letters = { round = "o", springs = "s", elements = "e" }

-- Returns the word for a chosen model: letters for motion, twist, contact and section, as in fixed.
local function rungs_of(model)
  return (model.motion == "poses" and "p" or "d") .. (model.twist == "rolling" and "r" or "h")
    .. (model.contact == "wires" and "w" or "n") .. letters[model.section]
end

local fixed = {}
for _, m in ipairs{ "p", "d" } do
  for _, t in ipairs{ "h", "r" } do
    for _, c in ipairs{ "n", "w" } do fixed[#fixed + 1] = m .. t .. c .. "o" end
  end
end

local rank = { p = 1, d = 2, h = 1, r = 2, n = 1, w = 2, o = 1, s = 2, e = 3 }

-- Returns true if model a is cheaper than b in one choice, and more expensive in none.
local function cheaper(a, b)
  for k = 1, #a do
    if rank[a:sub(k, k)] > rank[b:sub(k, k)] then return false end
  end
  return a ~= b
end

-- Returns the fixed models to compute: all; for slow scenes only the chosen one and cheaper ones. flat: no
-- models that roll, unless cheaper or chosen, because the true values are known without them.
local function fixed_of(rungs, took, flat)
  local list = {}
  for _, word in ipairs(fixed) do
    local told = took < SLOW and not (flat and word:sub(2, 2) == "r")
    if told or word == rungs or cheaper(word, rungs) then list[#list + 1] = word end
  end
  return list
end

local function one(kind, random, share)
  local build, moves, known = kind.of(random)
  local truth, why, took = { quantities = known }, nil, SLOW
  if not known then
    truth, why, took = autotruth.values(build, moves, share * (kind.truth or 1 / 8), kind)
  end
  if not truth then return nil, why end
  for name, t in pairs(truth.quantities) do
    if t.error > share * size(t.value) / 2 then return nil, name .. " is not known to the tolerance" end
  end
  local r, reason, cost = run(build, { auto = true, settle = not moves }, share)
  if not r then return { failed = reason } end
  local out = { held = 0, rows = 0, model = r.model, rungs = rungs_of(r.model), cost = r.model.run_cost,
    probes = r.model.cost,
    enough = {}, met = r.met, wall = cost, times = {}, away = {} }
  for name, q in pairs(r.quantities) do
    local t = truth.quantities[name]
    out.rows = out.rows + 1
    local off = near(q.value, t.value)
    local bar = q.error + t.error
    out.held = out.held + (off <= bar and 1 or 0)
    out.off = math.max(out.off or 0, off / bar)
  end
  out.steady = not kind.pressed and autosteady.look(r, rungs_of, near, size, function(options)
    options.settle = not moves
    return (run(build, options, share))
  end) or nil
  local twice = out.steady and out.steady.model or r.model -- take the shorter time of two runs
  out.probes, out.cost = math.min(out.probes, twice.cost), math.min(out.cost, twice.run_cost)
  out.finest = (kind.pressed or not known) and autopressed.finest(build, moves) or nil -- on a peg: minutes
  for _, word in ipairs(kind.pressed and autopressed.fixed or {}) do
    local asked = word == out.rungs or cheaper(word, out.rungs) -- others are slow, and not comparable
    if asked and word:sub(4) == "o" then out.enough[word], out.times[word] = false, 0 -- lines have no squeeze
    elseif asked then out.enough[word], out.times[word] = autopressed.suffices(build, word, share, known) end
  end
  for _, word in ipairs(kind.pressed and {} or fixed_of(out.rungs, took, kind.flat or kind.joined)) do
    local options = { rolls = word:sub(2, 2) == "r", contact = word:sub(3, 3) == "w", settle = not moves }
    local static = word:sub(1, 1) == "p" or nil
    local plain = run(build, options, share, nil, static) -- with the tolerance of the choice
    local f = run(build, options, share / 4, 5, static) or plain -- poses may fail with finer edges
    local enough, away = f ~= nil, 0
    for name, q in pairs(f and f.quantities or {}) do
      local t = truth.quantities[name]
      local most = share * size(t.value) -- allowed error; longer error bars do not raise it
      local off = near(q.value, t.value)
      enough = enough and off <= most + math.min(q.error, most / 4) + t.error
      away = math.max(away, off / most)
    end
    out.enough[word], out.times[word], out.away[word] = enough, plain and plain.cpu or 0, away
  end
  return out
end

-- Rates a row: was the chosen model too cheap, or more expensive than needed? row.some is false if no model
-- suffices and the run said so; then there was nothing to choose.
local function rate(row)
  row.too_cheap = row.met and not row.enough[row.rungs]
  row.some = row.met
  for _, enough in pairs(row.enough) do row.some = row.some or enough end
  row.cheapest = row.enough[row.rungs] or false
  for word in pairs(row.enough) do
    if row.enough[word] and cheaper(word, row.rungs) and row.times[word] < (row.times[row.rungs] or 0) then
      row.cheapest, row.better = false, word
    end
  end
end

--- Draws scenes by a seed until the true values of count scenes are known well enough. Returns a list of
-- { name =, share =, rungs =, held =, rows =, cheapest =, too_cheap =, cost =, probes = }. kinds: a set of
-- names, or nil for all. Each scene has its own random numbers, so it does not depend on other scenes.
function auto.draw(count, seed, tell, kinds)
  local design, list = require "softworld.study.design", {}
  local k, known, drawn = 0, 0, 0
  while known < count and drawn < 4 * count do
    k = k + 1
    local kind, round = auto.scenes[1 + (k - 1) % #auto.scenes], (k - 1) // #auto.scenes
    if not kinds or kinds[kind.name] then
      local share = ({ 0.1, 0.03, 0.01 })[1 + (k - 1 + round) % 3] -- a kind gets another one in each round
      local row, why = one(kind, design.generator(seed, 17, k), share)
      row = row or { failed = tostring(why), no_truth = true }
      row.name, row.share = kind.name, share
      if not row.no_truth then known = known + 1 end
      if row.enough then rate(row) end
      drawn, list[drawn + 1] = drawn + 1, row
      if tell then tell(row) end
    end
  end
  return list
end

-- Aims: share of error bars that hold, share of chosen models that are the cheapest, share of models that are
-- too cheap; cost of choosing over the chosen model's run (20 ms are always allowed); cost of the most
-- expensive model over choosing and running.
auto.aims = { held = 0.95, cheapest = 0.9, too_cheap = 0.02, choosing = 0.3, gain = 10 }

--- Returns true if the choice cost more than allowed.
function auto.is_over(row) return row.probes > math.max(0.02, auto.aims.choosing * row.cost) end

--- Returns the sums of a list of rows.
function auto.figures(list)
  local f = { scenes = 0, choices = 0, rows = 0, held = 0, cheapest = 0, too_cheap = 0, choosing = 0, run = 0,
    rods = 0, finest = 0, failed = 0, over = 0, looked = 0, same = 0, choice = 0, near = 0, near_rows = 0 }
  for _, r in ipairs(list) do
    if r.failed then f.failed = f.failed + 1
    else
      f.scenes, f.rows, f.held = f.scenes + 1, f.rows + r.rows, f.held + r.held
      f.choices = f.choices + (r.some and 1 or 0)
      f.cheapest, f.too_cheap = f.cheapest + (r.cheapest and 1 or 0), f.too_cheap + (r.too_cheap and 1 or 0)
      f.choosing, f.run = f.choosing + r.probes, f.run + r.cost
      local rods, meshes = r.times.drwo or r.times.dhwo or 0, r.times.phne or 0
      f.rods, f.finest = f.rods + rods, f.finest + math.max(r.finest or 0, rods, meshes)
      if auto.is_over(r) then f.over = f.over + 1 end
      if r.steady then
        f.looked, f.near, f.near_rows = f.looked + 1, f.near + r.steady.held, f.near_rows + r.steady.rows
        f.same, f.choice = f.same + (r.steady.same and 1 or 0), f.choice + (r.steady.choice and 1 or 0)
      end
    end
  end
  return f
end

-- Prints how often each fixed model suffices and what all its runs cost, and the same for the chosen models.
local function print_front(list)
  local chosen, good = 0, 0
  for _, r in ipairs(list) do
    if r.enough then chosen, good = chosen + r.probes + r.cost, good + (r.too_cheap and 0 or 1) end
  end
  local function line(name, count, cost) print(("    %-32s %3d     %.3g s"):format(name, count, cost)) end
  print "    model                        suffices   cost"
  line("chosen, with choosing", good, chosen)
  for _, word in ipairs(fixed) do
    local count, cost = 0, 0
    for _, r in ipairs(list) do
      if r.enough then count, cost = count + (r.enough[word] and 1 or 0), cost + (r.times[word] or 0) end
    end
    line(("%s, %s, %s"):format(word:sub(1, 1) == "p" and "poses" or "dynamic",
      word:sub(2, 2) == "h" and "held" or "rolling", word:sub(3, 3) == "n" and "none" or "wires"), count,
        cost)
  end
end

local function verdict(met) return met and "met" or "missed" end

-- Prints a line for a scene in which an aim is missed.
local function print_missed(r)
  if r.failed then return print(("    %-8s %g: %s"):format(r.name, r.share, r.failed)) end
  local words = {}
  if not r.cheapest and r.some then
    local away = r.better and r.away[r.better]
    words[1] = ("dear, enough is %s%s"):format(r.better or "another",
      away and (", %.2f of the tolerance away"):format(away) or "")
  end
  if r.too_cheap then words[#words + 1] = "too cheap" end
  if r.held < r.rows then words[#words + 1] = ("%.2g bars off"):format(r.off) end
  if auto.is_over(r) then
    words[#words + 1] = ("choosing %.0f ms, the run %.0f ms"):format(1e3 * r.probes, 1e3 * r.cost)
  end
  if r.steady and not r.steady.same then words[#words + 1] = "other bits" end
  if r.steady and not r.steady.choice then words[#words + 1] = "another model where 1 % stiffer" end
  if #words > 0 then
    print(("    %-8s %g, %s: %s"):format(r.name, r.share, r.rungs, table.concat(words, "; ")))
  end
end

local function print_aims(f)
  local aims = auto.aims
  print(("  %.1f %% of %d bars hold (aim %g: %s); %.1f %% the cheapest that suffices (aim %g: %s), %.1f %% "
    .. "too cheap (aim %g: %s)"):format(100 * f.held / f.rows, f.rows, 100 * aims.held,
    verdict(f.held >= aims.held * f.rows), 100 * f.cheapest / f.choices,
    100 * aims.cheapest, verdict(f.cheapest >= aims.cheapest * f.choices),
    100 * f.too_cheap / f.scenes, 100 * aims.too_cheap, verdict(f.too_cheap <= aims.too_cheap * f.scenes)))
  local gain = f.finest / (f.choosing + f.run)
  print(("  choosing %.3g s, over 20 ms and 0.3 of the run in %d scenes; the runs %.3g s; the finest model "
    .. "everywhere at least %.3g times as much (aim %g: %s)"):format(f.choosing, f.over, f.run, gain,
    aims.gain, verdict(gain >= aims.gain)))
  print(("  the same bits twice in %d of %d scenes; 1 %% stiffer, the same model in %d, %d of %d values "
    .. "within their bars and 2 %%"):format(f.same, f.looked, f.choice, f.near, f.near_rows))
end

local function check_kinds(kinds)
  for name in pairs(kinds or {}) do
    local found
    for _, kind in ipairs(auto.scenes) do found = found or kind.name == name end
    if not found then error(("bench: there is no kind '%s' of scenes"):format(name), 0) end
  end
end

--- Draws count scenes (default 20) by each of two seeds, or by the given seed, and prints the results. kinds:
-- a set of names, or nil for all.
function auto.print(seed, kinds, count)
  check_kinds(kinds)
  for k = 1, seed and 1 or 2 do
    local number = seed or k
    print(("\nruns that choose their model, seed %d"):format(number))
    local list = auto.draw(count or 20, number, print_missed, kinds)
    local f = auto.figures(list)
    print(("  %d scenes (%d not known well enough)"):format(f.scenes, f.failed))
    if f.scenes > 0 then
      print_aims(f)
      print_front(list)
    end
  end
end

return auto
