-- SPDX-License-Identifier: GPL-3.0-or-later
--- The quantities that an error bar can be asked for: those of a scene's objects, by
-- name, and the user's own as functions.
-- @module softworld.quantity
local blame = require "softworld.scene.blame"
local checks = require "softworld.checks"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local inherited = require "softworld.inherited"
local reading = require "softworld.run.reading"
local window = require "softworld.run.window"

local quantity = {}

local DEEPEST = 8 -- lists inside one another in a value of a quantity
local places = 40 -- number of stretches of a wire; positions are compared at their ends

local function positions(wire)
  local list, length = {}, wire.length
  for i = 0, places do list[i + 1] = wire:position(length * (i / places)) end
  return list
end

local measured -- while quantities are read together: object -> its loads

-- Returns the loads of an object since `start`. Several quantities of it may want them, and a long run has
-- many steps.
local function loads_of(object, start)
  local m = measured and measured[object] or object:over(start)
  if measured then measured[object] = m end
  return m
end

local function over(name)
  return function(object, start) return loads_of(object, start)[name] end
end

local function over_at(name)
  return function(object, start)
    local m = loads_of(object, start)
    return m[name], nil, m[name .. "_time"], m[name .. "_note"]
  end
end

-- Kind of object -> name -> unit and how to read it: value, where [m], when [s].
-- plain: values of edges and the like, whose errors fall with the first power of the edge length, not the
-- second. vanishes: the exact value is 0, so the value itself is an error and its bar is at least as large.
-- named: known only with the object's name in front.
quantity.known = {
  wire = {
    tip = { unit = "m", of = function(w) return w:position(w.length) end },
    position = { unit = "m", of = positions },
    max_tension = { unit = "N", plain = true, of = function(w, _, scene)
      return window.tension(scene, w)
    end },
    min_bend_radius = { unit = "m", plain = true, of = function(w) return w:min_bend_radius() end },
    max_strain = { unit = "", plain = true, of = function(w) return w:max_strain() end },
    max_stress = { unit = "Pa", plain = true, of = function(w) return w:max_stress() end },
  },
  hold = {
    force = { unit = "N", of = function(h) return h:force() end },
    moment = { unit = "N m", of = function(h) return h:moment() end },
    peak_force = { unit = "N", plain = true, named = true, of = over_at "peak_force" },
    mean_force = { unit = "N", named = true, of = over "mean_force" },
    peak_moment = { unit = "N m", plain = true, named = true, of = over_at "peak_moment" },
    mean_moment = { unit = "N m", named = true, of = over "mean_moment" },
    impulse = { unit = "N s", named = true, of = over "impulse" },
  },
  gripper = {
    force = { unit = "N", of = function(g) return g:force() end },
    moment = { unit = "N m", of = function(g) return g:moment() end },
    peak_force = { unit = "N", plain = true, of = over_at "peak_force" },
    mean_force = { unit = "N", of = over "mean_force" },
    peak_moment = { unit = "N m", plain = true, of = over_at "peak_moment" },
    mean_moment = { unit = "N m", of = over "mean_moment" },
    impulse = { unit = "N s", of = over "impulse" },
  },
  obstacle = {
    force = { unit = "N", of = function(o) return o:force() end },
    peak_force = { unit = "N", plain = true, named = true, of = over_at "peak_force" },
    mean_force = { unit = "N", named = true, of = window.mean_force },
    impulse = { unit = "N s", named = true, of = over "impulse" },
  },
  tie = {
    peak_force = { unit = "N", plain = true, named = true, of = over_at "peak_force" },
    mean_force = { unit = "N", named = true, of = over "mean_force" },
    impulse = { unit = "N s", named = true, of = over "impulse" },
  },
  scene = {
    energy = { unit = "J", of = function(s) return s:energy().total end },
    penetration = { unit = "m", plain = true, vanishes = true, of = function(s)
      local depth, at, time = s:penetration()
      return depth, at, time
    end },
  },
}

-- Returns { name =, kind =, object = } for everything in the scene that has quantities.
local function objects_of(scene)
  local data, list, theirs = build.data(scene), {}, {}
  local function add(kind, entry)
    list[#list + 1] = { kind = kind, name = entry.name, object = rawget(entry, "object") or entry }
  end
  for _, w in ipairs(data.wires) do add("wire", w) end
  for _, g in ipairs(data.grippers) do
    add("gripper", g)
    for _, hold in ipairs(g.past) do theirs[hold] = true end
  end
  for _, h in ipairs(data.holds) do
    if not theirs[h.object] then add("hold", h) end
  end
  for _, o in ipairs(data.obstacles) do add("obstacle", o) end
  for _, f in ipairs(data.fixings) do
    if checks.kind(f.fixing) == "tie" and f.fixing:exists() then
      list[#list + 1] = { kind = "tie", name = f.name, object = f.fixing }
    end
  end
  list[#list + 1] = { kind = "scene", object = scene }
  return list
end

-- Returns a table of name -> quantities with this name, and the names. "left.force" is one quantity;
-- "force" may be several.
local function directory(scene)
  local found, names = {}, {}
  local function add(name, entry)
    if not found[name] then
      found[name] = {}
      names[#names + 1] = name
    end
    table.insert(found[name], entry)
  end
  for _, o in ipairs(objects_of(scene)) do
    for key, def in pairs(quantity.known[o.kind]) do
      local full = o.name and o.name .. "." .. key or key
      local entry = { full = full, unit = def.unit, plain = def.plain, vanishes = def.vanishes,
        of = function(start) return def.of(o.object, start, scene) end }
      add(full, entry)
      if o.name and not def.named then add(key, entry) end
    end
  end
  table.sort(names)
  return found, names
end

-- Returns the names without an object in front; most misspelt names are of this kind.
local function short_names(names)
  local list = {}
  for _, name in ipairs(names) do
    if not name:find(".", 1, true) then list[#list + 1] = name end
  end
  return list
end

local function find(name, found, names, what)
  local list = found[name]
  if not list then
    local near = core.nearest(name, short_names(names)) or core.nearest(name, names)
    error(("%s: tolerance: there is no quantity '%s'; %s"):format(what, name, near
      and ("did you mean '%s'?"):format(near)
      or "known are: " .. table.concat(short_names(names), " ")
        .. ", with the object's name and a dot in front, or { name =, value =, unit =, of = function }"), 0)
  end
  if #list > 1 then
    local full = {}
    for i, entry in ipairs(list) do full[i] = entry.full end
    error(("%s: tolerance: '%s' may be any of: %s"):format(what, name, table.concat(full, " ")), 0)
  end
  return list[1]
end

local function check_value(what, name, value, unit)
  if type(value) ~= "number" or not (value > 0 and value < math.huge) then
    local is_number = type(value) == "number" and unit ~= ""
    error(("%s: tolerance: %s = %s%s is not allowed; it must be a number above 0%s"):format(what, name,
      checks.shown(value), is_number and " " .. unit or "", unit ~= "" and " " .. unit or ""), 0)
  end
end

-- Sets the tolerance of a quantity: a number in its unit, or { relative = share of the value }.
local function take(what, q, value)
  if checks.kind(value) ~= "table" or next(value) == nil then
    check_value(what, q.name, value, q.unit)
    q.tolerance = value
    return q
  end
  for key in pairs(value) do
    if key ~= "relative" then
      error(("%s: tolerance: %s: there is no parameter '%s'; it must be a number%s, or { relative = share }")
        :format(what, q.name, checks.shown(key), q.unit ~= "" and " " .. q.unit or ""), 0)
    end
  end
  local share = value.relative
  if type(share) ~= "number" or not (share > 0 and share < 1) then
    error(("%s: tolerance: %s: relative = %s is not allowed; it must be a number above 0 and below 1"):format(
      what, q.name, checks.shown(share)), 0)
  end
  q.relative = share
  return q
end

local own_keys = { name = "string", value = "number", unit = "string", of = "function", at = "number",
  relative = "number" }
local own_names = { "name", "value", "relative", "unit", "of", "at" }

-- Returns a quantity of the user's own: { name =, value =, unit =, of = function, at = [s] }.
local function own(scene, what, number, given)
  local label = ("%s: tolerance: quantity %d"):format(what, number)
  if checks.kind(given) ~= "table" then
    error(("%s must be a table { name =, value =, unit =, of = function }, got %s"):format(label,
      checks.kind(given)), 0)
  end
  for key, value in pairs(inherited.flat(given, own_keys)) do
    if not own_keys[key] then
      local near = core.nearest(checks.shown(key), own_names)
      error(("%s: there is no parameter '%s'; %s"):format(label, checks.shown(key), near
        and ("did you mean '%s'?"):format(near) or "known are: " .. table.concat(own_names, " ")), 0)
    end
    if type(value) ~= own_keys[key] then
      error(("%s: %s must be a %s, got %s"):format(label, key, own_keys[key], type(value)), 0)
    end
  end
  for _, key in ipairs{ "name", "of" } do
    if given[key] == nil then error(("%s: %s is missing"):format(label, key), 0) end
  end
  if (given.value == nil) == (given.relative == nil) then
    error(("%s: %s"):format(label, given.value and "value or relative, not both" or "value is missing"), 0)
  end
  if given.at and not (given.at >= 0 and given.at < math.huge) then
    error(("%s: at = %s s is not allowed; it must be a time of at least 0 s after the start")
      :format(label, checks.shown(given.at)), 0)
  end
  local q = { name = given.name, unit = given.unit or "", of = given.of, at = given.at, own = true,
    scene = scene }
  return take(what, q, given.value or { relative = given.relative })
end

--- Returns the quantities that tolerance = {...} asks for, in order. Raises an error without a
-- place if something is wrong with them.
-- @treturn table list of { name, unit, tolerance, of, at, plain, vanishes }
function quantity.list(scene, tolerance, what)
  local found, names = directory(scene)
  local list, taken, words = {}, {}, {}
  for key, value in pairs(inherited.flat(tolerance)) do
    if type(key) == "string" then
      words[#words + 1] = key
    elseif math.type(key) ~= "integer" or key < 1 or key > #tolerance then
      error(("%s: tolerance: the key %s names no quantity"):format(what, checks.shown(key)), 0)
    else
      list[key] = own(scene, what, key, value)
    end
  end
  table.sort(words)
  for _, word in ipairs(words) do
    local entry = find(word, found, names, what)
    list[#list + 1] = take(what, { name = word, unit = entry.unit, of = entry.of, plain = entry.plain,
      vanishes = entry.vanishes },
      tolerance[word])
  end
  for _, q in ipairs(list) do
    if taken[q.name] then
      error(("%s: tolerance: '%s' is asked for twice"):format(what, q.name), 0)
    end
    taken[q.name] = true
  end
  if #list == 0 then
    error(what .. ": tolerance is a table that names no quantity, such as { tip = 1e-3 }; help 'tolerance' "
      .. "lists them", 0)
  end
  return list
end

-- --- values ---------------------------------------------------------------------------

-- Returns what is wrong with a value, or nil: it must be a number, or a list without gaps of such values.
-- depth: lists around it.
local function fault_of(v, depth)
  if type(v) == "number" then return v ~= v and "nan" or nil end
  if type(v) ~= "table" then return core.type(v) or type(v) end
  if depth > DEEPEST then return "too many lists, one inside the other" end
  if next(v) == nil then return "an empty list" end
  for key in next, v do
    if math.type(key) ~= "integer" or key < 1 or key > #v then
      return ("a list with the key '%s'"):format(checks.shown(key))
    end
  end
  for i = 1, #v do
    local fault = fault_of(rawget(v, i), depth + 1)
    if fault then return ("%s as item %d"):format(fault, i) end
  end
end

local INSTEAD = "read the scene as the run left it, for example wire:position(s) or hold:force()"

-- Calls the function of a quantity of the script. Its error is the script's fault in any model, unless it
-- asks for something that this model of the wire does not have.
local function own_value(q)
  local unlike, fine, value = reading.call(q.scene, ("the quantity '%s'"):format(q.name), INSTEAD, q.of)
  if not fine then (unlike and error or blame.fault)(value, 0) end
  return value
end

--- Reads a quantity. Returns { value, where [m], when [s], note }. start: when the run began [s].
function quantity.read(q, start)
  local value, s, t, note
  if q.own then value = own_value(q) else value, s, t, note = q.of(start) end
  local fault = fault_of(value, 1)
  if fault then
    local words = "quantity '%s': its function must return a number or a list of numbers, got %s"
    local raise = q.own and blame.fault or error
    raise(words:format(q.name, fault), 0)
  end
  return { value = value, where = s, when = t, note = note }
end

--- Reads quantities after a run. Returns their values by their names.
function quantity.read_all(list, start)
  local found = {}
  measured = {}
  local fine, raised = pcall(function()
    for _, q in ipairs(list) do found[q.name] = q.sample or quantity.read(q, start) end
  end)
  measured = nil
  if not fine then error(raised, 0) end
  return found
end

local function is_vector(v) return type(v) == "table" and type(v[1]) == "number" end

--- Returns the distance of two values of the same shape: difference of numbers, norm for vectors, largest
-- for lists of vectors. NaN is infinitely far from any number, and at distance 0 from NaN.
function quantity.distance(a, b)
  if type(a) == "number" then
    if a ~= a or b ~= b then return a ~= a and b ~= b and 0 or math.huge end
    return a == b and 0 or math.abs(a - b)
  end
  local sum, most = 0, 0
  for i, x in ipairs(a) do
    local d = quantity.distance(x, b[i])
    sum, most = sum + d * d, math.max(most, d)
  end
  return is_vector(a) and sum ^ 0.5 or most
end

--- Returns the tolerance of a quantity in its unit; a relative one is taken of this value.
function quantity.asked(q, value)
  if q.relative then
    local size = quantity.size(value)
    q.tolerance = size < math.huge and q.relative * size or 0
  end
  return q.tolerance
end

--- True if both values have the same shape.
function quantity.alike(a, b)
  if type(a) ~= type(b) then return false end
  if type(a) == "number" then return true end
  if #a ~= #b then return false end
  for i, x in ipairs(a) do
    if not quantity.alike(x, b[i]) then return false end
  end
  return true
end

--- Returns the size of a value, in the norm of `distance`.
function quantity.size(a)
  if type(a) == "number" then return math.abs(a) end
  local sum, most = 0, 0
  for _, x in ipairs(a) do
    local d = quantity.size(x)
    sum, most = sum + d * d, math.max(most, d)
  end
  return is_vector(a) and sum ^ 0.5 or most
end

--- Returns a - b, for values of the same shape.
function quantity.minus(a, b)
  if type(a) == "number" then return a - b end
  local list = {}
  for i, x in ipairs(a) do list[i] = quantity.minus(x, b[i]) end
  return list
end

--- Returns the scalar product of the changes a to b and b to c; it is below 0 when the value turns back.
function quantity.agreement(a, b, c)
  if type(a) == "number" then return (b - a) * (c - b) end
  local sum = 0
  for i = 1, #a do sum = sum + quantity.agreement(a[i], b[i], c[i]) end
  return sum
end

return quantity
