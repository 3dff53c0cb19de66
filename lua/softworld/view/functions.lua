-- SPDX-License-Identifier: GPL-3.0-or-later
--- Forms with a Lua function: its body is typed, its arguments are given. A view accepts such forms only if
-- its user allows them (softworld --view --functions, scene:view { functions = true }): who types a function
-- can do whatever the user of the program can.
-- @module softworld.view.functions
local checks = require "softworld.checks"

local functions = {}

local LONGEST = 20000 -- longest body [B]

local function fail(text, ...) error(text:format(...), 0) end

functions.REFUSED = "this view accepts no Lua functions from pages; start it with softworld --view "
  .. "--functions, or scene:view { functions = true }"

-- --- bodies ------------------------------------------------------------------------------------------

-- Returns a copy, so that a function cannot change the library for others.
local function copy_of(library)
  local copy = {}
  for key, value in pairs(library) do copy[key] = value end
  return copy
end

--- Returns what functions see besides their arguments and the script's names: a new table each time.
function functions.names()
  local names = { math = copy_of(math), string = copy_of(string), table = copy_of(table) }
  for word in ("assert error ipairs next pairs pcall print select tonumber tostring type"):gmatch "%a+" do
    names[word] = _G[word]
  end
  return names
end

--- Checks a typed body. Errors are texts without a place, with the line of the body.
function functions.read(what, field, body)
  if type(body) ~= "string" or #body > LONGEST or body:find "\0" then
    fail("%s must be the body of a Lua function, of %d bytes at most", what, LONGEST)
  end
  body = body:gsub("\r\n?", "\n"):gsub("%s+$", "")
  if not body:find "%S" then fail("%s: the body of the function is missing", what) end
  -- alone first, so that the body cannot end the function and continue outside of it
  local head = field.args == "" and "" or ("local %s; "):format(field.args)
  local chunk, why = load(head .. body, "=line", "t", {})
  local before = chunk and 1 or 0 -- lines of the head
  if chunk then chunk, why = load("return " .. functions.source(field, body), "=line", "t", {}) end
  if chunk then return body end
  fail("%s: %s", what, (why:gsub("^line:(%d+):", function(n) return ("line %d:"):format(n - before) end)))
end

--- Returns the function as source. The first line of the body is the line after the head.
function functions.source(field, body)
  return ("function(%s)\n%s\nend"):format(field.args, body)
end

-- --- forms -------------------------------------------------------------------------------------------

local Word = {}

local function word(field, body) return setmetatable({ text = functions.source(field, body) }, Word) end

local function need(values, kind, name)
  if values[name] == nil then fail("%s: %s is required", kind, name) end
  return values[name]
end

local function a_function(name, args, doc)
  return { name = name, type = "function", unit = "-", args = args, doc = doc, required = true }
end

local force = a_function("func", "t, x, v, f", "adds forces to f [N]; f, the positions x [m] and the "
  .. "velocities v [m/s] are flat lists with three numbers for each node; t is the time [s]; returns nothing")
local condition = a_function("condition", "", "called once per step; returns true when the process goes on")
local way = a_function("func", "t", "returns the displacement { x, y, z } [m] at t [s] after the start of "
  .. "the move; { 0, 0, 0 } at t = 0")
local look = a_function("call", "observer", "called between two steps; observer:stop(why) ends the run, "
  .. "observer:change(function() ... end) changes the scene")

local function row(name, kind, unit, doc, more)
  local one = { name = name, type = kind, unit = unit, doc = doc }
  for key, value in pairs(more or {}) do one[key] = value end
  return one
end

local function write_force(values, refer, source)
  return "scene:force " .. source{ kind = word(force, need(values, "function", "func")),
    on = refer(need(values, "function", "on")) }
end

local function write_wait(values, _, source)
  local more = values.timeout and (", { timeout = %s }"):format(source(values.timeout)) or ""
  local asked = word(condition, need(values, "wait_until", "condition"))
  return ("p:wait_until(%s%s)"):format(source(asked), more)
end

local function write_move(values, refer, source)
  local by = refer(values._by or fail "move_by_function: which gripper?")
  return ("%s:move %s"):format(by.text, source{ func = word(way, need(values, "move_by_function", "func")),
    duration = need(values, "move_by_function", "duration"), relative = true })
end

local function write_observe(values, _, source)
  local call = word(look, need(values, "observe", "call"))
  return "scene:observe " .. source{ every = values.every, call = call }
end

local value = a_function("of", "run", "returns a number for the finished run, in the given unit; the scene "
  .. "is in its state at the end")

local function write_check(values, _, source)
  return (source{ name = values.name, unit = need(values, "check", "unit"), max = values.max,
    min = values.min, of = word(value, need(values, "check", "of")) })
end

local ending = " Objects by their names: scene:find \"name\"."

--- The kinds, as special.kinds; `lua`: only in views that accept functions.
functions.kinds = {
  { class = "force", kind = "function", method = "force", write = write_force, first = "on func",
    lua = true, doc = "a force of your own, computed by a Lua function at every evaluation." .. ending,
    own = { on = { of = "wire particles" } },
    rows = { row("on", "wire", "-", "the wire or object of particles", { required = true }), force } },
  { class = "step", kind = "wait_until", method = "wait_until", self = "p", write = write_wait,
    lua = true, first = "condition timeout", doc = "waits until a Lua function returns true." .. ending,
    rows = { condition, row("timeout", "number", "s", "goes on after this time in any case",
      { min = 0, above = true, usual = "none" }) } },
  { class = "step", kind = "move_by_function", method = "move", self = "gripper", lua = true,
    write = write_move, first = "func duration",
    doc = "moves a gripper along a path given by a Lua function.",
    rows = { way, row("duration", "number", "s", "of the move",
      { required = true, min = 0, above = true }) } },
  { class = "observer", kind = "observe", method = "observe", write = write_observe,
    lua = true, first = "call every", doc = "calls a function during the run." .. ending,
    rows = { look, row("every", "number", "s", "between two calls",
      { min = 0, above = true, usual = "each step" }) } },
  { class = "check", kind = "check", method = "check", write = write_check, lua = true,
    first = "name unit of min max",
    doc = "judges each run by a number of your own, as help \"check\"." .. ending,
    rows = { row("name", "text", "-", "of its row"),
      row("unit", "text", "-", "of the value, - for none", { required = true }), value,
      row("min", "number", "-", "the value must not be below it"),
      row("max", "number", "-", "the value must not be above it") } },
}

--- Initial values of new forms.
functions.starts = {
  ["force function"] = { func = "-- a swinging push along z, on the first node\n"
    .. "f[3] = f[3] + 0.01 * math.sin(20 * t)" },
  ["step wait_until"] = { condition = "return scene.time > 0.1" },
  ["step move_by_function"] = { duration = 0.5,
    func = "return { 0, 0.02 * math.sin(20 * t), 0.1 * t }" },
  ["check check"] = { unit = "N", of = "return (scene:find(\"wire1\"):max_tension())", max = 10 },
  ["observer observe"] = { every = 0.1, call = "print(scene.time, scene:energy().kinetic)" },
}

-- --- checks ------------------------------------------------------------------------------------------

-- Replaces lines of the list by lines of the function that they are in.
local function own_lines(message, text)
  return (tostring(message):gsub("checks:(%d+): ", function(number)
    local count, head = 0, 0
    for line in text:gmatch "([^\n]*)\n?" do
      count = count + 1
      if count < tonumber(number) and line:find "function%(run%)$" then head = count end
    end
    return ("line %d: "):format(number - head)
  end))
end

--- Judges a run by a list of checks, given as source. Returns { verdict, rows = { { name, value, unit,
-- verdict, note } } }.
function functions.judge(run, text)
  local names = functions.names()
  names.scene = run.scene
  local fine, check = pcall(function()
    return run:check{ checks = assert(load("return " .. text, "=checks", "t", names))() }
  end)
  if not fine and checks.is_interrupt(check) then error(check, 0) end
  if not fine then
    local why = { name = "check", verdict = "FAIL", note = own_lines(check, text) }
    return { verdict = "FAIL", rows = { why } }
  end
  local result = { verdict = check.verdict, rows = {} }
  for i, r in ipairs(check.rows) do
    local finite = type(r.value) == "number" and r.value - r.value == 0
    result.rows[i] = { name = r.name, value = finite and r.value or nil, unit = r.unit,
      verdict = r.verdict, note = r.note and own_lines(r.note, text) }
  end
  return result
end

return functions
