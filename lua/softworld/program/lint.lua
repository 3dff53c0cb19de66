-- SPDX-License-Identifier: GPL-3.0-or-later
--- The command `softworld lint SCRIPT [ARGUMENTS]`: lets the script build its scenes without running
-- anything, and prints what is probably not meant, with the line of the script that made it. Runs return a
-- placeholder that accepts every call. If the script needs a number from the placeholder, or waits for one in
-- a loop, it ends there, and lint says so.
-- @module softworld.program.lint
local advise = require "softworld.model.advise"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local nothing = require "softworld.program.nothing"
local place = require "softworld.place"
local remarks = require "softworld.remarks"
local vec = require "softworld.vec"

local lint = {}

local least_modulus, most_modulus = 1e4, 2e12 -- usual moduli of wires [Pa]
local step = 0.25                             -- distance of points checked along a wire, over its radius [-]
local most_points = 20000
local deep = 0.5 -- share of the radius: a centre line nearer than this to the surface is inside [-]

-- --- findings -----------------------------------------------------------------------------

local found, known = {}, {}

local function tell(at, text)
  at = at or "?"
  local key = at .. text
  if known[key] then return end
  known[key] = true
  found[#found + 1] = { at = at, text = text, line = tonumber(at:match ":(%d+)$") or 0, number = #found }
end

local itself = nothing.itself

local SCENES = 500 -- most scenes whose runs are left out; a loop that makes more waits for a result

-- --- what scenes are made of -------------------------------------------------------------------

local scenes = {} -- in order: { scene =, wires =, obstacles =, holds = }
local by_data = setmetatable({}, { __mode = "k" })

local function record_of(scene)
  local data = build.data(scene)
  if not by_data[data] then
    by_data[data] = { scene = scene, data = data, wires = {}, obstacles = {}, holds = {} }
    scenes[#scenes + 1] = by_data[data]
  end
  return by_data[data]
end

local function follow(class, name, note)
  local method = class[name]
  class[name] = function(scene, ...)
    local at = place.of_caller()
    local function done(...)
      note(at, scene, ...)
      return ...
    end
    return done(build.through(method, scene, ...))
  end
end

local function follow_scenes(class)
  follow(class, "wire", function(at, scene, wire)
    local list = record_of(scene).wires
    list[#list + 1] = { object = wire, at = at }
  end)
  follow(class, "obstacle", function(at, scene, obstacle)
    local list, data = record_of(scene).obstacles, build.data(scene)
    list[#list + 1] = { object = obstacle, at = at, entry = data.obstacles[#data.obstacles] }
  end)
  for _, kind in ipairs { "clamp", "pin", "feed" } do
    local method = class[kind]
    class[kind] = function(scene, wire, args)
      local at, hold = place.of_caller(), build.through(method, scene, wire, args)
      local data = build.data(scene)
      local entry = data.holds[#data.holds]
      local list = record_of(scene).holds
      list[#list + 1] = { wire = wire, s = args and args.s, width = entry.width or 0, name = entry.name,
        kind = kind, at = at }
      return hold
    end
  end
end

-- --- checks ---------------------------------------------------------------------------------------

-- Walks along a wire in steps no longer than the free distance to the obstacle, or `step` radii if larger.
-- Returns arc length, point and distance of the first point inside the obstacle, or nil.
local function walk(wire, radius, obstacle)
  local at, q = obstacle:pose()
  local back, shape = vec.conjugate(q), obstacle.shape
  local x, s, count = wire:positions(), 0, 0
  for i = 1, #x - 5, 3 do
    local a, b = { x[i], x[i + 1], x[i + 2] }, { x[i + 3], x[i + 4], x[i + 5] }
    local length, t = vec.norm(vec.sub(b, a)), 0
    while t < length and count < most_points do
      local here = vec.add(a, vec.scale(vec.sub(b, a), t / length))
      local gap = shape:distance(vec.rotate(back, vec.sub(here, at)))
      if not gap then return end
      if gap < deep * radius then return s + t, here, gap end
      t, count = t + math.max(step * radius, gap - deep * radius), count + 1
    end
    s = s + length
  end
end

local function check_through(w, o)
  local wire, obstacle = w.object, o.object
  if not core.exists(obstacle) or not obstacle.present then return end
  local s, p, gap = walk(wire, wire.radius, obstacle)
  if not s then return end
  tell(w.at, ("wire '%s' goes through '%s': at s = %.4g m, (%.4g, %.4g, %.4g) m, it reaches %.3g mm into "
    .. "it"):format(wire.name, o.entry.name, s, p[1], p[2], p[3], 1e3 * (wire.radius - gap)))
end

-- Warns of edges longer than a box is thick, if the wire may come to lie on it.
local function check_edges(w, o)
  local wire, entry = w.object, o.entry
  local edge = wire.length / wire.segments
  local is_box = entry.shape == "box" and type(entry.size) == "table"
  local thickness = is_box and math.min(table.unpack(entry.size))
  local at, q = o.object:pose()
  local start = vec.rotate(vec.conjugate(q), vec.sub(wire:position(0), at))
  local gap = thickness and o.object.shape:distance(start)
  if gap and gap < wire.length and edge > 1.001 * thickness then -- within reach
    tell(w.at, ("wire '%s': its edges of %.3g mm are longer than '%s' is thick, %.3g mm; segments = %d makes "
      .. "them as short"):format(wire.name, 1e3 * edge, entry.name, 1e3 * thickness,
      math.ceil(wire.length / thickness - 1e-9)))
  end
end

-- Warns of EA or EI unlike that of a full round section of usual modulus.
local function check_stiffness(w)
  local wire = w.object
  local fine, beam = pcall(function() return wire.beam end)
  if not fine then return end
  local r = beam.radius
  local area, inertia = math.pi * r ^ 2, math.pi * r ^ 4 / 4
  local bending = type(beam.EI) == "table" and math.max(table.unpack(beam.EI)) or beam.EI
  local known_modulus = false -- E has a remark already
  for _, f in ipairs(found) do
    known_modulus = known_modulus or f.at == w.at and f.text:find(": E = ", 1, true) ~= nil
  end
  for name, case in pairs { EA = { beam.EA, area, "pi r^2", "N" },
    EI = { bending, inertia, "pi r^4 / 4", "N m2" } } do
    local value, of, words, unit = table.unpack(case)
    local modulus = not known_modulus and type(value) == "number" and value > 0 and value / of
    if modulus and (modulus < least_modulus or modulus > most_modulus) then
      local soft = modulus < least_modulus
      tell(w.at, ("wire '%s': %s = %.4g %s with a radius of %.3g mm is a modulus of %.2g Pa (%s / (%s)), %s "
        .. "%g Pa; soft rubber has 1e6 Pa, steel 2e11 Pa"):format(wire.name, name, value, unit, 1e3 * r,
        modulus, name, words, soft and "below" or "above", soft and least_modulus or most_modulus))
    end
  end
  local density = beam.mass_per_length / area
  if density < 5 or density > 25000 then
    tell(w.at, ("wire '%s': %.4g kg/m with a radius of %.3g mm is a density of %.3g kg/m3; steel has "
      .. "7850 kg/m3"):format(wire.name, beam.mass_per_length, 1e3 * r, density))
  end
end

local function check_two_holds(a, b)
  local room, apart = (a.width + b.width) / 2, math.abs(a.s - b.s)
  local function say(how, more)
    tell(a.at, ("%s '%s' at s = %.4g m %s %s '%s' at s = %.4g m%s"):format(a.kind, a.name, a.s, how, b.kind,
      b.name, b.s, more))
  end
  if apart < room or apart == 0 then
    say("overlaps", room > 0 and (", which together are %.3g mm wide"):format(1e3 * 2 * room) or "")
  elseif core.exists(a.wire) and apart - room < 2 * a.wire.radius then
    say("is beside", (", nearer than the wire is thick, %.3g mm"):format(1e3 * 2 * a.wire.radius))
  end
end

local function check_holds(holds)
  for i, a in ipairs(holds) do
    for k = 1, i - 1 do
      local b = holds[k]
      if a.wire == b.wire and type(a.s) == "number" and type(b.s) == "number" then check_two_holds(a, b) end
    end
  end
end

local function check_scene(record)
  if record.checked or not pcall(function() return record.scene.name end) then return end
  for _, w in ipairs(record.wires) do
    if core.exists(w.object) and w.object.radius > 0 then
      for _, o in ipairs(record.obstacles) do
        check_through(w, o)
        check_edges(w, o)
      end
      check_stiffness(w)
    end
  end
  check_holds(record.holds)
  for _, item in ipairs(advise.spare(record.scene)) do
    for _, w in ipairs(record.wires) do
      if w.object == item.wire then tell(w.at, item.text) end
    end
  end
  record.checked = true
end

-- --- the script -----------------------------------------------------------------------------------

local left = 0 -- scenes that were to be run

-- Checks a scene that is to be run, since lint cannot follow it further.
local function leave_scene(record)
  if not record.left then left = left + 1 end
  record.left = true
  check_scene(record)
end

-- Replaces runs by the placeholder.
local function leave_out(class)
  for _, name in ipairs { "run", "settle", "advance", "resume" } do
    class[name] = function(scene)
      nothing.use()
      if core.type(scene) == "scene" then pcall(leave_scene, record_of(scene)) end
      if left > SCENES then
        nothing.stop(("a loop seems to wait for the result of a run; it ran %d scenes"):format(SCENES))
      end
      return nothing.it
    end
  end
  core.class.wire.frequencies = itself
  for _, name in ipairs { "picture", "save", "script", "view" } do class[name] = itself end
end

-- Evaluates nothing, but lets setup build its scene.
local function study_of(args)
  nothing.use()
  if type(args) == "table" and type(args.setup) == "function" then args.setup() end
  return nothing.it
end

-- Reads the measurements, but computes no wires for them: these are not the script's.
local function calibration_of(args)
  require("softworld.calibration.calibration").check(args)
  nothing.use()
  return nothing.it
end

local function prepare()
  local sw = require "softworld"
  follow_scenes(core.class.scene)
  leave_out(core.class.scene)
  for _, name in ipairs { "report", "plot", "calibrate" } do rawset(sw, name, itself) end
  rawset(sw, "tune", nothing.it)
  rawset(sw, "study", study_of)
  rawset(sw, "calibration", calibration_of)
  function remarks.write(at, text) tell(at, text) end
  local early = remarks.early
  -- Runs that were left out count as run.
  function remarks.early(what) return not nothing.used and early(what) end
  rawset(_G, "print", function() end)
  rawset(_G, "ipairs", nothing.ipairs)
  rawset(os, "exit", function() error(nothing.it, 0) end)
end

-- Runs the script. Returns nil, or the error that stopped it.
local function go(path, ...)
  local chunk, why = loadfile(path, "t")
  if not chunk then return why end
  local fine, problem = xpcall(chunk, function(e)
    return type(e) == "string" and e or e == nothing.it and e or tostring(e)
  end, ...)
  if fine or problem == nothing.it then return nil end
  return problem
end

local function report(path, problem)
  for _, record in ipairs(scenes) do
    local fine, why = pcall(check_scene, record)
    if not fine then problem = problem or why end
  end
  table.sort(found, function(a, b)
    if a.line ~= b.line then return a.line < b.line end
    return a.number < b.number
  end)
  for _, f in ipairs(found) do io.write(f.at, ": ", f.text, "\n") end
  local stopped = problem and nothing.used -- it may only have needed a number from a run
  if stopped then
    io.write(("%s: looked at as far as here, since runs were left out (%s)\n"):format(
      problem:match "^([^\n]-:%d+):" or path, (problem:gsub("^[^\n]-:%d+: ", ""):gsub("\n.*", ""))))
  elseif problem then
    io.stderr:write("softworld: ", problem, "\n")
  end
  local count = #found == 1 and "1 warning" or ("%d warnings"):format(#found)
  io.write(("%s: %s, %d %s\n"):format(path, count, #scenes, #scenes == 1 and "scene" or "scenes"))
  return (problem and not stopped or #found > 0) and 1 or 0
end

--- Returns the exit status: 0 if there is nothing to report, 1 for warnings or an error, 2 for a wrong call.
function lint.run(path, ...)
  if not path then
    io.stderr:write "softworld: lint wants a script; usage: softworld lint SCRIPT [ARGUMENTS]\n"
    return 2
  end
  if core.kind(path) ~= "file" then
    io.stderr:write(("softworld: cannot read '%s': %s\n"):format(path, core.kind(path) and "it is a "
      .. core.kind(path) or "No such file or directory"))
    return 1
  end
  local write = io.stdout
  arg = { [0] = path, ... } -- luacheck: globals arg
  local exit = os.exit
  prepare()
  function nothing.give_up(why)
    io.output(write)
    exit(report(path, ("%s: %s"):format(place.of_caller() or path, why)))
  end
  local problem = go(path, ...)
  io.output(write)
  local code = report(path, problem)
  if problem and problem:find "interrupted$" then error(problem, 0) end -- Ctrl-C: the program ends so
  return code
end

return lint.run
