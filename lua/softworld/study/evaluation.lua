-- SPDX-License-Identifier: GPL-3.0-or-later
--- Computes one evaluation: the arguments of evaluate, and the use of its results. It depends only on the
-- parameters' values, the study's seed, the method with its options, and the number within it.
-- @module softworld.study.evaluation
local build = require "softworld.scene.build"
local check_results = require "softworld.check.results"
local checks = require "softworld.checks"
local core = require "softworld.core"
local counts = require "softworld.calls.counts"
local judge_results = require "softworld.study.judge"
local counted = require "softworld.output.number".count
local parameters = require "softworld.study.parameters"
local rows = require "softworld.rows"
local vector = require "softworld.vector"

local evaluation = {}

rows.calls{
  { "evaluation:random", "low, high", "a random number like math.random, from a sequence of this evaluation "
    .. "alone",
    "a number", example = "local mu = 0.3 + 0.05 * (2 * p.random() - 1)" },
  { "evaluation:give_up", "reason", "ends the evaluation, which then counts as failed for this reason" },
  { "evaluation:broken", "results", "the first constraint that these results break; for results that only "
    .. "grow, such as the peak so far", "its name, or nil",
    example = 'if p.broken { peak = hand.peak_force } then observer:stop "too hard" end' },
  { "evaluation.number", nil, "of the evaluation within its sweep, search or spread", "a number" },
}

local LONGEST = 300   -- longest reason [characters]
local MOST = 2000     -- most results of an evaluation
local GIVEN_UP = {}   -- raised by give_up

local random, seed = math.random, math.randomseed

-- Seeds Lua's generator at the start of an evaluation.
local function seed_with(own, number)
  local mark = string.pack("<i8i8i8", own.seed, own.stream, number)
  seed(core.checksum(mark), core.checksum("softworld" .. mark))
end

-- Returns p of evaluate(p, scene).
local function given_for(own, number, values)
  local p, names = {}, { "random", "give_up", "broken", "number" }
  for i, parameter in ipairs(own.parameters) do
    p[parameter.name] = parameters.shown(parameter, values[i])
    names[#names + 1] = parameter.name
  end
  p.number = number
  local function add(name, f) -- calls may have a dot or a colon
    local checked = counts.guarded(nil, name, "evaluation:" .. name, f)
    p[name] = function(a, ...)
      if a == p then return checked(...) end
      return checked(a, ...)
    end
  end
  add("random", function(low, high)
    if low == nil then return random() end
    if high == nil then return build.call(3, random, low) end
    return build.call(3, random, low, high)
  end)
  add("give_up", function(reason)
    error({ GIVEN_UP, reason == nil and "given up" or checks.shown(reason):sub(1, LONGEST) }, 0)
  end)
  add("broken", function(results) return judge_results.broken(own, results) end)
  return setmetatable(p, { __name = "evaluation",
    __index = checks.fields("evaluation", table.concat(names, " ")) })
end

local function line_of(f)
  local info = debug.getinfo(f, "S")
  return ("%s:%d"):format(info.short_src, info.linedefined)
end

local function wrong(own, text, ...)
  return "mistake", ("%s: evaluate %s"):format(line_of(own.evaluate), text:format(...))
end

local function number_of(value)
  if type(value) == "boolean" then return value and 1.0 or 0.0 end
  return type(value) == "number" and value + 0.0 or nil
end

-- Adds a list of numbers as results name_1, name_2, ...
local function add_list(own, flat, name, list)
  local count = 0
  for _ in pairs(list) do count = count + 1 end
  if count == 0 or count ~= #list then
    return wrong(own, "returned %s = %s; it must be a number, a list of numbers, true or false", name,
      count == 0 and "an empty table" or "a table that is not a list")
  end
  for i = 1, count do flat[#flat + 1] = { name .. "_" .. i, list[i] } end
end

-- Returns all results as a list { { name, value }, ... } in the order of names.
local function flatten(own, results)
  local flat = {}
  for name, value in pairs(results) do
    local fine, why = pcall(parameters.check_name, "the result", name)
    if not fine then return nil, wrong(own, "returned %s", why) end
    if own.by_name[name] then return nil, wrong(own, "returned '%s', which is a parameter", name) end
    if vector.is_plain(value) then
      local bad, text = add_list(own, flat, name, value)
      if bad then return nil, bad, text end
    else
      flat[#flat + 1] = { name, value }
    end
  end
  table.sort(flat, function(a, b) return a[1] < b[1] end)
  return flat
end

-- Returns "ok" and the results as text, or what is wrong with them.
local function read(own, results, ...)
  if select("#", ...) > 0 then return wrong(own, "returned more than one value; it must return one table") end
  if checks.kind(results) == "check" then
    local numbers, reason = check_results.of(results, own.by_name)
    if not numbers then return "failed", reason:match "^[^\n]*":sub(1, LONGEST) end
    results = numbers
  end
  if type(results) ~= "table" then
    return wrong(own, "returned %s; it must return a table of results, such as { time = 1.5 }, or a check",
      results == nil and "nothing" or checks.got(results))
  end
  local flat, status, why = flatten(own, results)
  if not flat then return status, why end
  if #flat == 0 or #flat > MOST then return wrong(own, "returned %d results, not 1 to %d", #flat, MOST) end
  local texts = {}
  for i, result in ipairs(flat) do
    local name, value = result[1], number_of(result[2])
    if not value then
      return wrong(own, "returned %s = %s; it must be a number, true or false", name, checks.got(result[2]))
    end
    if i > 1 and name == flat[i - 1][1] then return wrong(own, "returned '%s' twice", name) end
    if value - value ~= 0 then
      return "failed", ("%s is %s"):format(name, value ~= value and "nan" or "infinite")
    end
    texts[i] = name .. "=" .. parameters.text(value)
  end
  return "ok", table.concat(texts, " ")
end

--- Returns the reason of an evaluation that took too much memory.
function evaluation.memory_reason(memory) return ("took more than %.9g B of memory"):format(memory) end

-- Returns what an error means. Lua's own messages are mostly mistakes in the script.
local function judge(own, message)
  if type(message) == "table" and rawget(message, 1) == GIVEN_UP then return "failed", message[2] end
  local text = checks.shown(message)
  local first = text:match "^[^\n]*":sub(1, LONGEST)
  if text:find "not enough memory" or text:find "out of memory" then
    return "machine", own.memory and evaluation.memory_reason(own.memory) or "out of memory: " .. first
  end
  local plain = first:gsub("^[^\n]-:%d+: ", "")
  local mistake = plain:find "^attempt to " or plain:find "^bad argument #"
  return mistake and "mistake" or "failed", first
end

--- Returns the reason of an evaluation that took too many steps.
function evaluation.steps_reason(steps) return "took more than " .. counted(steps, "step") end

-- interrupts: how often Ctrl-C was pressed when the evaluation began. The script's own pcall may have caught
-- the error of one since: the results are then of a run that did not end.
local function finish(own, interrupts, fine, ...)
  local limited = core.limit_steps(0)
  if not fine and checks.is_interrupt(...) then error((...), 0) end -- says nothing about the model
  core.stop_since(interrupts)
  if limited then return "failed", evaluation.steps_reason(own.steps) end
  for _, kept in ipairs(own.kept) do
    if not core.exists(kept[1]) then return wrong(own, "closed the scene that setup had built") end
  end
  if fine then return read(own, ...) end
  return judge(own, ...)
end

--- Called before the first evaluation: stores the scenes from setup, whose state each evaluation restores.
function evaluation.keep(own)
  local list = {}
  for i = 1, own.built.n do
    local value = own.built[i]
    local many = vector.is_plain(value) and value or { value }
    for _, v in pairs(many) do
      if core.type(v) == "scene" then list[#list + 1] = { v, v:snapshot() } end
    end
  end
  own.kept = list
end

local function all(own, p)
  for _, kept in ipairs(own.kept) do kept[1]:restore(kept[2], true) end
  return own.evaluate(p, table.unpack(own.built, 1, own.built.n))
end

local function once(own, number, values)
  seed_with(own, number)
  core.limit_steps(own.steps or 0)
  return pcall(all, own, given_for(own, number, values))
end

--- Returns "ok" with results as text; "failed", "machine" or "mistake" with a reason.
function evaluation.run(own, number, values)
  return finish(own, core.interrupts(), once(own, number, values))
end

--- Same in this process, to look at it. Returns status and text as run does, and what evaluate returned, or
-- the error that it raised.
function evaluation.again(own, number, values)
  local again, more = math.random(0), math.random(0)
  local interrupts = core.interrupts()
  local fine, given = once(own, number, values)
  math.randomseed(again, more)
  local status, text = finish(own, interrupts, fine, given)
  return status, text, given
end

return evaluation
