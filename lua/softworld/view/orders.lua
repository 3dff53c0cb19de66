-- SPDX-License-Identifier: GPL-3.0-or-later
--- The orders that pages of a live view may give. Each change becomes a line of Lua; this line is what is
-- run, shown and saved. Only numbers, names in quotes, and function bodies that the view's user allows get
-- from a message into it.
-- @module softworld.view.orders
local core = require "softworld.core"
local checks = require "softworld.checks"
local build = require "softworld.scene.build"
local literal = require "softworld.scene.literal"
local fill = require "softworld.view.fill"
local leaving = require "softworld.view.leaving"
local record = require "softworld.scene.record"
local rows = require "softworld.rows"

local orders = {}

local MOST_NUMBERS = 4

local function fail(text, ...) error(text:format(...), 0) end

-- --- what can be changed -------------------------------------------------------------------------

local function changeable(list)
  local some = {}
  for _, row in ipairs(list) do
    if row.changes then some[#some + 1] = row end
  end
  return some
end

local registry

-- Returns the rows of an object's set.
local function rows_of(object)
  registry = registry or core.registry()
  local kind = core.type(object)
  if kind == "scene" then return rows.of "scene:set" end
  if kind == "obstacle" then return changeable(registry.params.obstacle) end
  if type(object) == "table" and (getmetatable(object) or {}).__name == "gripper" then
    return rows.of "gripper:set"
  end
  return nil
end

local function is_told(row)
  return row.type == "number" or row.type == "vector" or row.type == "choice" or row.type == "reaction"
end

local function value_of(row, value)
  local kind = type(value)
  if kind == "number" or kind == "string" then return value end
  if kind == "table" and row.type == "vector" then return { value[1], value[2], value[3] } end
  return nil
end

--- Returns what can be changed in a scene: { { name, kind, rows = { { name, unit, doc, type, min, max, above,
-- choices, value } } } }; the scene itself has the name "".
function orders.forms(scene)
  local list = {}
  local function add(name, kind, object)
    local known = rows_of(object)
    if not known then return end
    local now, form = object:get(), { name = name, kind = kind, rows = {} }
    for _, row in ipairs(known) do
      if is_told(row) then
        form.rows[#form.rows + 1] = { name = row.name, unit = row.unit, doc = row.doc, type = row.type,
          min = row.min and row.min > -1e300 and row.min or nil,
          max = row.max and row.max < 1e300 and row.max or nil,
          above = row.above, choices = row.choices, value = value_of(row, now[row.name]) }
      end
    end
    list[#list + 1] = form
  end
  add("", "scene", scene)
  for _, o in ipairs(build.data(scene).obstacles) do
    if core.exists(o.object) and o.object.present then add(o.name, "obstacle", o.object) end
  end
  for _, g in ipairs(build.data(scene).grippers) do
    if not g.gone and not g.left then add(g.name, "gripper", g) end
  end
  return list
end

-- --- lines -----------------------------------------------------------------------------------------

local function text_of(what, value)
  if type(value) ~= "string" or #value > 200 then fail("%s is not a name", what) end
  return value
end

local function number_of(what, value)
  if type(value) ~= "number" or value - value ~= 0 then fail("%s is not a number", what) end
  return value
end

local function positive(what, value)
  return checks.number(what, number_of(what, value), 0, "", 0, nil, true)
end

local function vector_of(what, value)
  if type(value) ~= "table" then fail("%s is not a list of 3 numbers", what) end
  for k = 1, 3 do number_of(what, value[k]) end
  return { value[1], value[2], value[3] }
end

local function source(value)
  return literal.of(value, function() fail "this cannot be written" end, "value")
end

local function reference(name) return name == "" and "scene" or ("scene:find(%s)"):format(source(name)) end

local function object_of(scene, name)
  if name == "" then return scene end
  return scene:find(name)
end

-- Checks a value with the words of the object itself. Asking the object would leave the run.
local function check_range(name, row, value)
  if row.type == "vector" then
    if type(value) ~= "table" or #value ~= 3 then fail("%s must be 3 numbers", name) end
  elseif row.type == "number" then
    checks.number(name, value, row.min or -math.huge, row.unit == "-" and "" or " " .. row.unit, 0, row.max,
      row.above)
  else
    checks.word(name, value, checks.set(table.concat(row.choices or {}, " ")), 0)
  end
end

local function plain_value(name, value)
  if type(value) ~= "table" then return value end
  if #value < 1 or #value > MOST_NUMBERS then fail("%s is not a list of numbers", name) end
  local copy = {}
  for k = 1, #value do copy[k] = number_of(name, value[k]) end
  return copy
end

local make = {}

local function same(a, b)
  if type(a) ~= "table" or type(b) ~= "table" then return a == b end
  for k = 1, math.max(#a, #b) do
    if a[k] ~= b[k] then return false end
  end
  return true
end

-- Returns a function for the line that restores what a change has changed, side effects included; it may give
-- nil.
local function undoing(name, object, known, before)
  return function()
    local now, differs = object:get(), {}
    for key in pairs(known) do
      if before[key] ~= nil and not same(before[key], now[key]) then differs[key] = before[key] end
    end
    return next(differs) ~= nil and ("%s:set %s"):format(reference(name), source(differs)) or nil
  end
end

--- { object =, values = { row = value } }: object:set{...}.
function make.set(scene, m)
  local name = text_of("object", m.object)
  if type(m.values) ~= "table" then fail "values is not a table" end
  local object, given, known = object_of(scene, name), {}, {}
  for _, row in ipairs(rows_of(object) or fail("'%s' has nothing to set", name)) do
    known[row.name] = is_told(row) and row or nil
  end
  for key, value in pairs(m.values) do
    if not known[key] then fail("'%s' has no '%s' to set", name, tostring(key)) end
    given[key] = plain_value(key, value)
    check_range(("%s.%s"):format(name == "" and "scene" or name, key), known[key], given[key])
  end
  return ("%s:set %s"):format(reference(name), source(given)), undoing(name, object, known, object:get())
end

--- { wire =, s =, to =, force =, stiffness = }: a hand takes hold of a place of a wire.
function make.pull(scene, m)
  local wire = scene:find(text_of("wire", m.wire))
  if core.type(wire) ~= "wire" then fail("'%s' is not a wire", m.wire) end
  local s = math.max(0, math.min(number_of("s", m.s), wire.length))
  local line = 'hand = scene:force { kind = "pull", on = %s, s = %s, to = %s, force = %s, stiffness = %s }'
  return line:format(reference(m.wire), source(s), source(vector_of("to", m.to)),
    source(positive("force", m.force)), source(positive("stiffness", m.stiffness)))
end

--- { to = }: moves the hand.
function make.reach(_, m) return ("hand:set { to = %s }"):format(source(vector_of("to", m.to))) end

--- The hand lets go.
function make.let() return "hand:release()" end

-- --- objects that come and go ------------------------------------------------------------------------

local function word_in(scene)
  return function(name)
    scene:find(name)
    return reference(name)
  end
end

local function is_taken(scene)
  local known = {}
  for _, name in ipairs(scene:names()) do known[name] = true end
  return function(name) return known[name] end
end

--- { class =, kind =, values =, serial = }: adds an object by a form; serial: a unique number.
function make.add(scene, m, may)
  local kind, values = fill.read(m.class, m.kind, m.values, may)
  if checks.set "step run scene observer check"[kind.class] then
    fail("%s cannot be added while a run is under way", kind.class == "observer" and "an observer"
      or "a " .. kind.class)
  end
  fill.check(kind, values)
  local taken, inverse = is_taken(scene), nil
  if fill.has_name(kind) then
    if values.name == nil or values.name == "" then values.name = fill.name(kind, taken) end
    if taken(values.name) then fail("there is already something named '%s'", values.name) end
  end
  local line = fill.line(kind, values, word_in(scene))
  if kind.class == "force" then
    inverse = ("made[%d]:release()"):format(m.serial)
    line = ("made[%d] = %s"):format(m.serial, line)
  elseif kind.class == "obstacle" or kind.class == "hold" then
    inverse = ("%s:%s()"):format(reference(values.name), kind.class == "hold" and "release" or "remove")
  elseif fill.has_name(kind) then
    inverse = ("scene:remove %s"):format(source(values.name))
  end
  return line, inverse and function() return inverse end
end

--- { object = name }, { made = serial of a force } or { force = number of the script's }: removes it.
function make.remove(scene, m) return leaving.line(scene, m) end

-- --- grippers that are led by hand --------------------------------------------------------------------

local function gripper_of(scene, m)
  local gripper = scene:find(text_of("gripper", m.gripper))
  if type(gripper) ~= "table" or (getmetatable(gripper) or {}).__name ~= "gripper" then
    fail("'%s' is not a gripper", m.gripper)
  end
  if gripper.left then fail("gripper '%s' was taken away", m.gripper) end
  return gripper
end

--- { gripper =, to =, speed = }: moves it there on a straight line, at most at this speed.
function make.lead(scene, m)
  local to, speed = vector_of("to", m.to), positive("speed", m.speed)
  local here, way = gripper_of(scene, m):position() or fail("gripper '%s' has no place yet", m.gripper), 0
  for k = 1, 3 do way = way + (to[k] - here[k]) ^ 2 end
  if way < 1e-12 then return ("%s:stop()"):format(reference(m.gripper)) end
  return ('%s:move { to = %s, speed = %s, law = "linear" }'):format(reference(m.gripper), source(to),
    source(speed))
end

--- { gripper = }: stops it where it is.
function make.leave(scene, m)
  gripper_of(scene, m)
  return ("%s:stop()"):format(reference(m.gripper))
end

--- Returns the line of an order, and a function (or nil) that gives the line to undo it once it is done.
-- Errors are texts without a place. may: Lua functions are accepted.
function orders.line(scene, m, may)
  return (make[m["do"]] or fail("there is no order '%s'", tostring(m["do"])))(scene, m, may)
end

--- True if the order changes the scene.
function orders.changes(m) return make[m["do"]] ~= nil end

-- --- saving ------------------------------------------------------------------------------------------

local follow = [[
  local next = 1
  local function due() return changes[next] and scene.time >= changes[next][1] end
  while due() do
    if changes[next][2] then changes[next][2]() end
    next = next + 1
  end
  scene:observe { call = function(observer)
    while due() do
      if changes[next][2] then observer:change(changes[next][2]) else observer:stop() end
      next = next + 1
    end
  end }
]]

local function changes_of(lines)
  local list, made = { "  local hand" }, false
  for _, line in ipairs(lines) do made = made or line.text and line.text:find("^made%[") ~= nil end
  if made then list[2] = "  local made = {}" end
  list[#list + 1] = "  local changes = {"
  for _, line in ipairs(lines) do
    local time = literal.number(line.time)
    list[#list + 1] = line.text == "" and ("    { %s, function() end }, -- it was left here"):format(time)
      or line.text and ("    { %s, function() %s end },"):format(time, line.text)
      or ("    { %s }, -- the run is ended"):format(time)
  end
  list[#list + 1] = "  }"
  return table.concat(list, "\n") .. "\n" .. follow
end

-- Returns the lines of the runs; nil if one has arguments that cannot be written.
local function runs_of(runs, judged)
  local list = {}
  for i, args in ipairs(runs) do
    local own = {}
    for key, value in pairs(args) do
      if key ~= "progress" then own[key] = value end
    end
    local fine, text = pcall(source, own)
    if not fine then return nil end
    list[i] = (i == 1 and "local run = scene:run " or "run = scene:run ") .. text .. "\n"
  end
  list[#list + 1] = "run:summary()\n"
  if judged then list[#list + 1] = ("print(run:check { checks = %s })\n"):format(judged) end
  return table.concat(list)
end

-- Returns the script that builds the scene; nil if it cannot be written.
local function head_of(scene)
  if build.data(scene).process_count or record.has_late(scene) then return nil end
  local fine, text = pcall(scene.script, scene)
  return fine and text:gsub("\n*return scene%s*$", "\n") or nil
end

--- Returns a script that repeats the runs with the changes made by hand. If processes are functions, which
-- cannot be written, it is only the part to run before scene:run. lines: { { time =, text = or nil: the run
-- was ended } }; runs: arguments of scene:run; head: the script that built the scene, if known; judged:
-- source of the list of checks of the run, or nil.
function orders.script(scene, lines, runs, head, judged)
  head = head or head_of(scene)
  local tail = #runs > 0 and runs_of(runs, judged)
  if head and (tail or #runs == 0) then
    local by_hand = #lines > 0
      and "\n-- What was changed by hand, and when.\ndo\n" .. changes_of(lines) .. "end\n"
    return head .. (by_hand or "") .. (tail and "\n" .. tail or "")
  end
  if #lines == 0 then return nil end
  return ("-- What was changed by hand in the run of '%s', and when: before scene:run,\n"
    .. '--   dofile "by_hand.lua" (scene)\nreturn function(scene)\n'):format(scene.name:gsub("[\r\n]", " "))
    .. changes_of(lines) .. "end\n"
end

return orders
