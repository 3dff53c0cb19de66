-- SPDX-License-Identifier: GPL-3.0-or-later
--- Remarks on values that are allowed but probably not meant: a radius of 2.5 m, a modulus of 50 Pa, a wire
-- that begins inside an obstacle. The host program prints each once per line of the script on stderr;
-- sw.remarks = false silences them.
-- @module softworld.remarks
local core = require "softworld.core"
local checks = require "softworld.checks"
local place = require "softworld.place"
local roundness = require "softworld.scene.roundness"
local units = require "softworld.units"
local vec = require "softworld.vec"

local remarks = {}

-- Usual range for each kind of thing: key = { unit, low, high, units that may have been meant }. Values
-- outside get a remark.
local rules = {
  wire = {
    radius = { "m", 2e-5, 0.1, "mm", "um" }, E = { "Pa", 1e4, 2e12, "MPa", "GPa", "kPa" },
    density = { "kg/m3", 5, 25000, "g_per_cm3" }, mass_per_length = { "kg/m", 1e-7, 100, "g_per_m" },
    EI = { "N m2", 1e-13, 1e5, "Nmm2" }, EA = { "N", 1e-2, 1e10 },
    length = { "m", 1e-4, 300, "mm" },
  },
  obstacle = { friction = { "", 0, 3 }, kinetic_friction = { "", 0, 3 }, at = { "m", 0, 50, "mm" },
    radius = { "m", 1e-5, 4, "mm" }, length = { "m", 1e-5, 100, "mm" }, size = { "m", 1e-6, 50, "mm" } },
  wire_contact = { friction = { "", 0, 3 } },
  pads = { friction = { "", 0, 3 }, width = { "m", 1e-4, 0.5, "mm" }, opening = { "m", 1e-5, 1, "mm" } },
  rating = { force = { "N", 1e-2, 1e5, "mN" },
    moment = { "N m", 1e-4, 1e4 }, stroke = { "m", 1e-4, 1, "mm" } },
  grasp = { force = { "N", 1e-4, 1e4, "mN" }, speed = { "m/s", 1e-6, 20, "mm_per_s" } },
  move = { speed = { "m/s", 1e-6, 20, "mm_per_s" }, duration = { "s", 1e-4, 1e5, "ms" },
    by = { "m", 0, 20, "mm" }, to = { "m", 0, 20, "mm" } },
  clip = { friction = { "", 0, 3 }, width = { "m", 1e-4, 0.5, "mm" }, insertion = { "N", 1e-3, 1e4, "mN" },
    retention = { "N", 1e-3, 1e4, "mN" }, radius = { "m", 1e-5, 0.2, "mm" } },
  feed = { speed = { "m/s", 0, 20, "mm_per_s" }, length = { "m", 0, 50, "mm" } },
  press = { distance = { "m", 0, 5, "mm" }, speed = { "m/s", 1e-6, 20, "mm_per_s" },
    force = { "N", 1e-4, 1e4, "mN" } },
  channel = { friction = { "", 0, 3 }, width = { "m", 1e-4, 5, "mm" }, depth = { "m", 1e-4, 5, "mm" } },
  tie = { slack = { "m", 0, 10, "mm" }, strength = { "N", 1e-3, 1e6, "mN" } },
  run = { duration = { "s", 0, 1e7 }, dt = { "s", 0, 1, "ms" }, tolerance = { "m", 0, 0.02, "mm" } },
}
local known = { density = "steel has 7850 kg/m3, PVC 1400 kg/m3", E = "steel has 2e11 Pa, soft rubber 1e6 Pa",
  friction = "rubber on steel has 0.8" }

local told = {}
local ANSWERS = 1000 -- most places kept with their remark
local count = 0

--- True if remarks are on.
function remarks.wanted()
  local sw, host = package.loaded["softworld"], package.loaded["softworld.host"]
  return host ~= nil and not (type(sw) == "table" and rawget(sw, "remarks") == false)
end

--- Writes a remark; softworld.program.lint and softworld.program.log replace this function.
function remarks.write(at, text)
  io.stdout:flush()
  io.stderr:write(at, ": remark: ", text, "\n")
end

-- Writes a remark, once per topic and line of the script. Lines typed at the prompt have no line numbers, so
-- there the text counts instead of the topic.
local function tell(topic, text)
  local at = place.of_caller() or "?"
  local key = at .. " " .. (at:find "^input:" and text or topic)
  if told[key] or count >= ANSWERS then return end
  told[key], count = true, count + 1
  remarks.write(at, text)
end
remarks.tell = tell

--- Remarks that a method reads the loads of a scene that was never run.
function remarks.early(what)
  tell("early " .. what, what .. ": nothing has run yet, so there is no record and the loads are 0; first "
    .. "call scene:run or scene:settle")
end

--- Remarks that wires lie in each other. at: a place [m]; time [s].
function remarks.passing(a, b, at, time)
  tell("passing", ("wires '%s' and '%s' pass through each other near (%.4g, %.4g, %.4g) m at t = %.4g s: "
    .. "they touch only after scene:wire_contact{}"):format(a, b, at[1], at[2], at[3], time))
end

--- Remarks that a script tells an event while no run is under way.
function remarks.untold()
  if not remarks.wanted() then return end
  tell("untold", "scene:tell: no run is under way, so no run has this event; tell it in a process or an "
    .. "observer")
end

-- Returns the first unit in which the value would be usual, as a question.
local function question(value, rule)
  for i = 4, #rule do
    local meant = math.abs(units[rule[i]](value))
    if meant >= rule[2] and meant <= rule[3] then
      return ("; did you mean sw.units.%s(%g)?"):format(rule[i], value)
    end
  end
  return ""
end

local function check(what, key, value, rule)
  if type(value) ~= "number" or value - value ~= 0 or value <= 0 and rule[2] > 0 then return end
  if math.abs(value) >= rule[2] and math.abs(value) <= rule[3] then return end
  local unit = rule[1] ~= "" and " " .. rule[1] or ""
  local usual = value < -rule[3] and ("below %g%s"):format(-rule[3], unit)
    or value < rule[2] and ("below %g%s"):format(rule[2], unit) or ("above %g%s"):format(rule[3], unit)
  tell(key, ("%s: %s = %g%s is %s%s%s"):format(what, key, value, unit, usual,
    question(value, rule), known[key] and (" (%s)"):format(known[key]) or ""))
end

local TURNS = 7 -- whole numbers from here on are hardly radians: more than a turn, and no share of pi [rad]

-- Remarks on a rotation { axis =, angle = } whose angle may be in degrees.
local function check_angle(what, rotation)
  local angle = checks.field(rotation, "angle")
  if math.type(angle) == nil or checks.field(rotation, "axis") == nil then return end
  if not (math.abs(angle) >= TURNS and math.abs(angle) < 1e6) or angle % 1 ~= 0 then return end
  tell("angle", ("%s: angle = %g rad is %.3g turns; did you mean sw.units.deg(%g)?"):format(what, angle,
    math.abs(angle) / (2 * math.pi), angle))
end

-- Remarks on a friction coefficient that is larger while things slide than while they stick.
local function check_sliding(what, args)
  local still, sliding = checks.field(args, "friction"), checks.field(args, "kinetic_friction")
  if type(still) ~= "number" or type(sliding) ~= "number" or sliding <= still then return end
  tell("sliding", ("%s: kinetic_friction = %g is above friction = %g: things would slide less easily than "
    .. "they start to"):format(what, sliding, still))
end

local sorted = {} -- kind -> its keys in order

local function keys_of(kind)
  sorted[kind] = sorted[kind] or checks.sorted(rules[kind])
  return sorted[kind]
end

--- Remarks on unusual values in the arguments of a kind of thing; `what` is its name in the text.
function remarks.on(kind, what, args)
  if type(args) ~= "table" or not remarks.wanted() then return end
  for _, key in ipairs(keys_of(kind)) do
    local value, rule = checks.field(args, key), rules[kind][key]
    if type(value) == "number" then check(what, key, value, rule) end
    for i = 1, type(value) == "table" and rawlen(value) or 0 do -- ipairs may never end
      check(what, key, rawget(value, i), rule)
    end
  end
  check_angle(what, checks.field(args, "rotation"))
  check_angle(what, checks.field(args, "turn"))
  check_sliding(what, args)
end

local JERK = 10 -- largest pull of a new tie without a remark [N]

--- Remarks on a tie between places this far apart [m]; args: slack [m], stiffness [N/m], strength [N].
function remarks.tie(what, apart, args)
  local pull = args.stiffness * (apart - args.slack)
  if pull <= math.min(JERK, args.strength or JERK) or not remarks.wanted() then return end
  local breaks = args.strength and pull > args.strength and ", and breaks" or ""
  tell("tie", ("%s: the places are %.4g mm apart and the slack is %.4g mm: the tie pulls them together with "
    .. "%.3g N at once%s. Its pull at rest is right; its pull before and its peaks depend on the time step. "
    .. "Without `slack` its length is the present distance"):format(what, 1e3 * apart,
      1e3 * args.slack, pull, breaks))
end

local MOST_GRAVITY = 50 -- largest component without a remark [m/s2]

--- Remarks on gravity, a vector [m/s2].
function remarks.gravity(g)
  if type(g) ~= "table" or not remarks.wanted() then return end
  local up = checks.field(g, 3) or checks.field(g, "z")
  if type(up) == "number" and up > 9.7 and up < 9.9 then
    tell("up", ("scene: gravity = %g m/s2 along z points up; did you mean %g?"):format(up, -up))
  end
  for k, axis in ipairs{ "x", "y", "z" } do
    local value = checks.field(g, k) or checks.field(g, axis)
    if type(value) == "number" then
      check("scene", "gravity", math.abs(value), { "m/s2", 0, MOST_GRAVITY, "mm_per_s2" })
    end
  end
end

-- --- wires inside of obstacles ---------------------------------------------------------

local SAMPLES = 24 -- intervals along a straight wire
local MOST = 400 -- points of a path that are looked at, about
local DEEP = 0.5 -- share of the radius: a centre line nearer than this to the surface is inside [-]

local things = setmetatable({}, { __mode = "k" }) -- a scene's data -> its wires' points

-- Returns points of a path, or both ends of a straight wire.
local function points_of(args)
  local list = {}
  if type(args.path) == "table" then
    for i = 1, #args.path, math.max(1, #args.path // MOST) do list[#list + 1] = args.path[i] end
  elseif type(args.from) == "table" and type(args.to) == "table" then
    for k, axis in ipairs{ "x", "y", "z" } do
      local a, b = args.from[k] or args.from[axis], args.to[k] or args.to[axis]
      if type(a) ~= "number" or type(b) ~= "number" then return {} end
      list[1], list[2] = list[1] or {}, list[2] or {}
      list[1][k], list[2][k] = a, b
    end
  end
  return list
end

-- Returns the centre of the box round a wire's points and their largest distance from it.
local function ball(wire)
  if wire.middle then return wire.middle, wire.reach end
  local low, high, far = { 1 / 0, 1 / 0, 1 / 0 }, { -1 / 0, -1 / 0, -1 / 0 }, 0
  for _, p in ipairs(wire.points) do
    local here = { p[1] or p.x, p[2] or p.y, p[3] or p.z }
    for k = 1, 3 do low[k], high[k] = math.min(low[k], here[k]), math.max(high[k], here[k]) end
  end
  wire.middle = { 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]), 0.5 * (low[3] + high[3]) }
  for _, p in ipairs(wire.points) do
    far = math.max(far, vec.norm(vec.sub({ p[1] or p.x, p[2] or p.y, p[3] or p.z }, wire.middle)))
  end
  wire.reach = far
  return wire.middle, wire.reach
end

-- True if a wire is so far from an obstacle that none of its points is inside. Always false for a mesh: an
-- open mesh has no clear inside, so distance proves nothing.
local function is_far(wire, shape, at, back)
  if shape:kind() == "mesh" or #wire.points == 0 then return false end
  local middle, reach = ball(wire)
  local gap = shape:distance(vec.rotate(back, vec.sub(middle, at)))
  return gap and gap > reach + DEEP * wire.radius
end

-- Returns the wire's points; a straight wire gets points between its ends.
local function along(wire)
  if not wire.straight or #wire.points ~= 2 then return wire.points end
  local a, b, list = wire.points[1], wire.points[2], {}
  for i = 0, SAMPLES do
    local u = i / SAMPLES
    list[i + 1] = { (1 - u) * a[1] + u * b[1], (1 - u) * a[2] + u * b[2], (1 - u) * a[3] + u * b[3] }
  end
  wire.points = list
  return list
end

local function look(wire, obstacle)
  if not core.exists(obstacle.object) or not obstacle.object.present then return end
  local at, q = obstacle.object:pose()
  local back, shape = vec.conjugate(q), obstacle.object.shape
  if is_far(wire, shape, at, back) then return end
  local x, y, z, clear = 0, 0, 0, -1 -- last point measured; points nearer to it than clear are outside
  local least, deepest, start = DEEP * wire.radius, nil, false
  for i, p in ipairs(along(wire)) do
    local here = { p[1] or p.x, p[2] or p.y, p[3] or p.z }
    local dx, dy, dz = here[1] - x, here[2] - y, here[3] - z
    local skip = clear > 0 and dx * dx + dy * dy + dz * dz < clear * clear
    local gap = not skip and shape:distance(vec.rotate(back, vec.sub(here, at)))
    if gap then
      x, y, z = here[1], here[2], here[3]
      clear = shape:kind() == "mesh" and -1 or gap - DEEP * wire.radius
    end
    if gap and gap < least then least, deepest, start = gap, here, i == 1 end
  end
  if not deepest then return end
  tell("inside", ("wire '%s' begins inside '%s': it reaches %.4g mm into it at (%.4g, %.4g, %.4g) m, %s")
    :format(wire.name, obstacle.name, 1e3 * (wire.radius - least), deepest[1], deepest[2], deepest[3],
    start and "at its start" or "along its path"))
end

--- Remarks on a place that a wire cannot get to: the seat of a clip inside an obstacle.
function remarks.seat(data, what, at)
  if not remarks.wanted() then return end
  for _, obstacle in ipairs(data.obstacles) do
    local object = obstacle.object
    if core.exists(object) and object.present and object.shape:kind() ~= "mesh" then -- a mesh may be open
      local place_of, q = object:pose()
      local gap = object.shape:distance(vec.rotate(vec.conjugate(q), vec.sub(at, place_of)))
      if gap and gap < 0 then
        tell("seat", ("%s: its seat is %.4g mm inside '%s', where no wire can lie"):format(what, -1e3 * gap,
          obstacle.name))
      end
    end
  end
end

local round = { cylinder = true, capsule = true, mesh = true, hull = true }

-- Remarks on edges too long for a peg's radius. A wire goes round a peg as a polygon: with edges as long as
-- the radius the capstan pull is right to 5 % (mu 0.3, half a turn), with half of that to 1 %
-- (spec/contact/capstan_spec).
local function look_round(wire, obstacle)
  local radius = round[obstacle.shape] and roundness.of(obstacle)
  if type(radius) ~= "number" or not wire.edge or wire.edge <= radius + wire.radius then return end
  tell("round", ("wire '%s': its edges of %.3g mm are longer than the radius of '%s', %.3g mm, so the wire "
    .. "goes round it as a polygon, and its pull may be wrong by 5 %% or more; segments = %d makes edges "
    .. "half as long as the radius"):format(wire.name, 1e3 * wire.edge, obstacle.name, 1e3 * radius,
    math.min(1e6, math.ceil(2 * wire.length / radius))))
end

local function wires_of(data)
  things[data] = things[data] or {}
  return things[data]
end

local function length_of(points)
  local sum = 0
  for i = 2, #points do
    local a, b = points[i - 1], points[i]
    sum = sum + vec.norm{ (b[1] or b.x) - (a[1] or a.x), (b[2] or b.y) - (a[2] or a.y),
      (b[3] or b.z) - (a[3] or a.z) }
  end
  return sum
end

local LONG = 0.5 -- longer edges show nothing of what is done with hands [m]

--- Checks a new wire of the scene's data, made with args.
function remarks.wire(data, wire, args)
  if not remarks.wanted() then return end
  local what = ("wire '%s'"):format(args.name)
  remarks.on("wire", what, args)
  local mine = { name = args.name, points = points_of(args), straight = args.path == nil,
    radius = args.radius or wire.radius }
  mine.length = length_of(mine.points)
  mine.edge = mine.length > 0 and mine.length / wire.segments or nil
  check(what, "length", mine.length, rules.wire.length)
  local thick = type(mine.radius) == "number" and mine.radius > rules.wire.radius[3] -- told already
  if (mine.edge or 0) > LONG and mine.length <= rules.wire.length[3] and not thick then
    tell("edge", ("%s is %.4g m long, with edges of %.3g m; did you mean %.4g mm? Else give more segments")
      :format(what, mine.length, mine.edge, mine.length))
  end
  local wires = wires_of(data)
  wires[#wires + 1] = mine
  for _, obstacle in ipairs(data.obstacles) do
    look(mine, obstacle)
    look_round(mine, obstacle)
  end
end

local paused = false

local MANY = 10000 -- particles of a wire that get a remark; a step then takes some tenths of a second

--- Remarks on a wire that became a mesh of very many particles.
function remarks.mesh(wire)
  if not remarks.wanted() or wire.model == "rod" or wire.model == "string" then return end
  local particles = #wire:calibration().particles * (wire.segments + 1) -- reading places builds the scene
  if particles > MANY then
    tell("mesh", ("wire '%s' as %s has %d particles in %d slices, so steps will be slow; to have fewer, give "
      .. "a larger spacing [m], or start as a rod and remodel only a region = {s1, s2} [m]")
      :format(wire.name, wire.model, particles, wire.segments + 1))
  end
end

--- Calls f(...) without remarks on the obstacles it makes, such as grippers' pads.
function remarks.without(f, ...)
  paused = true
  local result = table.pack(pcall(f, ...))
  paused = false
  if not result[1] then error(result[2], 0) end
  return table.unpack(result, 2, result.n)
end

local usual_mesh = { 1e-3, 20 } -- usual range of the largest side of an obstacle [m]

-- Remarks on a mesh of unusual size. Mesh files have no unit: mm read as m are a thousand times too large.
local function look_at_size(entry)
  if entry.shape ~= "mesh" and entry.shape ~= "hull" or type(entry.vertices) ~= "table" then return end
  local v, size = entry.vertices, 0
  for c = 1, 3 do
    local low, high = math.huge, -math.huge
    for i = c, #v, 3 do low, high = math.min(low, v[i]), math.max(high, v[i]) end
    size = math.max(size, high - low)
  end
  if size >= usual_mesh[1] and size <= usual_mesh[2] then return end
  local scale = type(entry.scale) == "number" and entry.scale or 1
  local better = size > usual_mesh[2] and 1e-3 * scale or 1e3 * scale
  tell("size", ("obstacle '%s' is %.4g m long; is the length unit of its file right? with scale = %g it is "
    .. "%.4g m long"):format(
    entry.name, size, better, size * better / scale))
end

--- Checks a new obstacle, an entry of the scene's data; time of the scene [s].
function remarks.obstacle(data, entry, time)
  if not remarks.wanted() or paused then return end
  remarks.on("obstacle", ("obstacle '%s'"):format(entry.name), entry)
  look_at_size(entry)
  if time > 0 then return end -- wires have moved since they were made
  for _, wire in ipairs(wires_of(data)) do
    look(wire, entry)
    look_round(wire, entry)
  end
end

return remarks
