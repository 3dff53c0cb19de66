-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments of random calls as Lua text: plausible values by name or parameter row, and hostile values that
-- may replace any other.
local sw = require "softworld"
local core = sw.core
local samples = require "contract.samples"

local words = {}

--- The random source of a case: whole numbers, shares, members of lists. `hostility` is the share of hostile
-- arguments. `pick(kind)` gives the text of an object of a kind.
function words.source(seed, hostility, pick)
  local random = samples.random(seed)
  for _ = 1, 8 do random(0, 1) end -- nearby seeds start alike
  local r = { hostility = hostility, pick = pick }
  function r.share() return random(0, 1) end
  function r.chance(p) return random(0, 1) < p end
  function r.whole(low, high) return math.min(high, low + math.floor(random(0, 1) * (high - low + 1))) end
  function r.of(list) return list[r.whole(1, #list)] end
  function r.between(low, high) return ("%.4g"):format(random(low, high)) end
  function r.size(low, high) return ("%.3g"):format(10 ^ random(low, high)) end -- log-uniform
  return r
end

local hostile = { "nan", "huge", "-huge", "1e300", "-1e300", "1e-300", "5e-324", "-5e-324", "0", "-1",
  "-0.0", "1.5", "2^53", "math.maxinteger", "math.mininteger", "1e15", "''", "'x'", "long", "'a\\0b'",
    "'%s%n'",
  "'\\xff\\xfe'", "{}", "true", "false", "nil", "print", "T.raise", "T.self", "T.names", "T.long", "T.string",
  "{ nan, nan, nan }", "{ huge, 0, 0 }", "{ 1e200, 1e200, 0 }", "{ 0, 0, 0 }", "{ 0, 0 }",
  "{ 1, 2, 3, 4 }", "{ x = 1 }", "{ '1', '2', '3' }", "{ {}, {} }", "{ T.raise, T.raise }", "sw", "io.stdout",
  "coroutine.create(print)", "v", "{ axis = { 0, 0, 0 }, angle = 1 }", "{ 0, 0, 0, 0 }", "F.raise", "F.yield",
  "F.nothing", "F.nonsense", "F.nans", "F.collect", "\"2\"", "2^31", "-2^31", "1e-12", "1e12" }

--- Text of a value that hardly fits anywhere.
function words.hostile(r)
  if r.chance(0.15) then return r.pick "any" end
  return r.of(hostile)
end

-- The given text, or sometimes a hostile one.
local function or_hostile(r, text)
  if r.chance(r.hostility) then return words.hostile(r) end
  return text
end
words.or_hostile = or_hostile

function words.vector(r, size)
  size = size or 0.3
  return ("{ %s, %s, %s }"):format(or_hostile(r, r.between(-size, size)),
    or_hostile(r, r.between(-size, size)), or_hostile(r, r.between(-size, size)))
end

local function direction(r)
  return r.of{ "{ 1, 0, 0 }", "{ 0, 1, 0 }", "{ 0, 0, 1 }", "{ 0, 0, -1 }", "{ -1, 0, 0 }", "{ 1, 1, 0.5 }",
    "{ x = 0, y = 1, z = 1 }" }
end

local function rotation(r)
  return r.of{ "{ 1, 0, 0, 0 }", "{ 0.7, 0, 0.7, 0 }", "{ axis = { 0, 0, 1 }, angle = 0.5 }",
    "{ axis = { 1, 1, 0 }, angle = -3 }", "{ 0, 0, 0, 1 }" }
end

-- A list of points along x.
local function points(r)
  local list = {}
  for i = 1, r.whole(2, 5) do
    list[i] = ("{ %s, %s, %s }"):format(or_hostile(r, ("%.3g"):format(0.2 * i)), r.between(-0.1, 0.1),
      r.between(-0.05, 0.15))
  end
  return "{ " .. table.concat(list, ", ") .. " }"
end

local function list_of(r, count, make)
  local list = {}
  for i = 1, count do list[i] = or_hostile(r, make(i)) end
  return "{ " .. table.concat(list, ", ") .. " }"
end

local function indices(r) return list_of(r, r.whole(1, 4), function() return tostring(r.whole(1, 7)) end) end

-- Values of arguments without a row, or whose row does not give a sensible range.
local by_name = {
  s = function(r) return r.between(0, 0.6) end,
  from = function(r) return words.vector(r, 0.2) end,
  to = function(r) return r.chance(0.8) and words.vector(r, 0.5) or ("{ %s, s = %s }"):format(r.pick "wire",
    r.between(0, 0.5)) end,
  at = function(r) return words.vector(r, 0.3) end,
  by = function(r) return words.vector(r, 0.1) end,
  about = function(r) return words.vector(r) end,
  point = function(r) return words.vector(r) end,
  direction = direction, axis = direction, normal = direction, up = direction,
  rotation = rotation,
  path = points, points = points,
  size = function(r) return ("{ %s, %s, %s }"):format(r.size(-2, 0), r.size(-2, 0), r.size(-2, -0.5)) end,
  on = function(r) return r.pick(r.of{ "wire", "wire", "wire", "particles", "gripper", "obstacle" }) end,
  into = function(r) return r.pick "clip" end,
  between = function(r) return ("{ %s, %s }"):format(r.pick "wire", r.pick "wire") end,
  ends = function(r) return list_of(r, 2, function() return ("{ %s, s = %s }"):format(r.pick "wire",
    r.of{ "0", "0.1", r.between(0, 0.5) }) end) end,
  name = function(r) return r.of{ "'a'", "'b'", "'c d'", "'%d'", "'\"q'", "'../x'" } end,
  cable = function(r) return r.of{ "'GXL 1.5'", "'H07V-K 1.5'", "'gxl'", "'FLRY-B 0.5'",
    "sw.cable 'GXL 0.5'" } end,
  stiffness = function(r) return r.chance(0.5) and r.size(-1, 4) or r.of{ "'slip'", "'stick'",
    "'default'" } end,
  use = function(r) return r.of{ "'fixed'", "'movement'", "'load'", "'reeling'" } end,
  model = function(r) return r.chance(0.85) and r.of{ "'rod'", "'rod'", "'rod'", "'string'" }
    or r.of{ "'tube'", "'radial'", "'cubic'", "'composite'" } end,
  section = function(r) return r.of{ "'solid'", "'springs'", "'circle'", "'annulus'", "'rectangle'" } end,
  segments = function(r) return tostring(r.whole(1, 24)) end,
  region = function(r) return ("{ %s, %s }"):format(r.between(0, 0.2), r.between(0.1, 0.5)) end,
  EI = function(r) return r.chance(0.8) and r.size(-5, -1) or "{ 1e-3, 2e-3 }" end,
  EA = function(r) return r.size(1, 5) end, GJ = function(r) return r.size(-5, -1) end,
  E = function(r) return r.size(6, 11) end, density = function(r) return r.size(2.5, 4) end,
  mass_per_length = function(r) return r.size(-3, 0) end,
  radius = function(r) return r.size(-3, -1.7) end,
  width = function(r) return r.size(-2.3, -1) end, depth = function(r) return r.size(-2.3, -1) end,
  length = function(r) return r.chance(0.8) and r.size(-2, -0.5) or "-" .. r.size(-2, -0.5) end,
  speed = function(r) return r.size(-2, 0) end, duration = function(r) return r.size(-2, -0.7) end,
  timeout = function(r) return r.size(-3, -1) end, force = function(r)
    return r.chance(0.5) and r.size(-2, 2) or words.vector(r, 1) end,
  distance = function(r) return r.size(-3, -1) end,
  integrator = function(r) return "'" .. r.of(samples.registry.integrators).name .. "'" end,
  dt = function(r) return r.size(-5, -1.5) end,
  tolerance = function(r) return r.size(-7, -3) end,
  progress = function() return "false" end,
  positions = function(r) return r.chance(0.5)
    and "{ 0, 0, 1, 0.1, 0, 1, 0.2, 0, 1, 0.3, 0.1, 1, 0.1, 0.2, 1 }"
    or list_of(r, 15, function() return r.between(-0.3, 0.3) end) end,
  masses = function(r) return r.chance(0.6) and r.size(-3, -1) or "{ 0.1, 0.1, 0.2, 0.1, 0.1 }" end,
  links = function(r) return ("{ { pairs = { 1, 2, 2, 3, 3, 4, %s, %s }, k = %s } }"):format(
    or_hostile(r, "4"), or_hostile(r, "5"), r.size(0, 4)) end,
  folds = function(r) return ("{ { 1, 2, %s, stiffness = %s } }"):format(or_hostile(r, "3"), r.size(-3,
    0)) end,
  elements = function(r) return ("{ { 1, 2, 3, 4, 5, 5, 5, %s, E = 1e5, nu = 0.3 } }"):format(or_hostile(r,
    "5")) end,
  surface = function(r) return ("{ 1, 2, %s }"):format(or_hostile(r, "3")) end,
  repel = function(r) return ("{ distance = %s, stiffness = %s }"):format(r.size(-3, -1), r.size(0, 4)) end,
  particles = function(r) return r.chance(0.7) and indices(r) or tostring(r.whole(4, 12)) end,
  data = function(r) return r.of{ "T.obj", "T.obj", "T.stl", "'v 0 0 0\\n'" } end,
  format = function(r) return r.of{ "'obj'", "'obj'", "'stl'", "'ply'" } end,
  file = function(r) return words.file(r) end, save = function(r) return words.file(r) end,
  resume = function(r) return words.file(r) end,
  approach = function(r) return r.of{ "'imposed'", "'plates'", "'plates'", "'mixed'" } end,
  on_slip = function(r) return r.of{ "'record'", "'warn'", "'stop'", words.callback(r) } end,
  on_crash = function(r) return r.of{ "'record'", "'warn'", "'stop'", words.callback(r) } end,
  of = function(r) return r.chance(0.7) and "F.number" or words.callback(r) end,
  f = function(r) return r.chance(0.7) and "F.parabola" or words.callback(r) end,
  func = function(r) return r.chance(0.7) and "F.way" or words.callback(r) end,
  turn = function(r) return ("{ axis = %s, angle = %s }"):format(direction(r), r.between(-3, 3)) end,
  law = function(r) return r.of{ "'linear'", "'quintic'", "'trapezoid'", "'cubic'" } end,
  pads = function(r) return r.of{ "{}", "{ shape = 'v' }", "{ shape = 'round', opening = 0.01 }",
    "{ fingers = 3 }", "{ width = 0.01, friction = 0.8, opening = 0.02 }", "{ fingers = 1 }",
    words.table_of(r, { "shape", "width", "height", "thickness", "below", "opening", "radius", "angle",
      "scale", "restitution", "fingers", "friction", "kinetic_friction" }, 0.2) } end,
  arm = function(r) return ("{ radius = %s, length = %s }"):format(r.size(-3, -1), r.size(-2, 0)) end,
  fingers = function(r) return tostring(r.whole(1, 4)) end,
  friction = function(r) return r.between(0, 1) end,
  rest = function(r) return r.of{ "'straight'", "'path'" } end,
  start = function(r) return r.of{ "0.1", "1e-3", "0.05", "{ 0.1, 0.2 }" } end,
  levels = function() return "3" end, max_iterations = function(r) return tostring(r.whole(1, 30)) end,
  modes = function(r) return tostring(r.whole(1, 4)) end,
  mesh = function(r) return r.of{ "'tube'", "'radial'", "'cubic'", "'composite'" } end,
  across = function(r) return tostring(r.whole(2, 6)) end, layers = function(r) return tostring(r.whole(1,
    3)) end,
  cell = function(r) return ("{ %s, %s }"):format(r.size(-3, -1.5), r.size(-3, -1.5)) end,
  axes = function(r) return r.of{ "'gripper'", "'world'" } end,
    finger = function(r) return tostring(r.whole(1, 3)) end,
  fail = function() return "false" end, freeze = function() return "false" end,
  spacing = function(r) return r.size(-3, -1) end, columns = function() return "{ 'clamp1.force' }" end,
  title = function(r) return r.of{ "'a title'", "'\"quoted\"'", "long" } end,
  now = function() return "true" end, quasistatic = function() return "true" end,
  gravity = function(r) return r.of{ "{ 0, 0, -9.81 }", "{ 0, 0, 0 }", words.vector(r, 10) } end,
  restitution = function(r) return r.between(0, 1) end, frame = function(r) return r.size(-3, 0) end,
  times = function() return "{ 0, 0.1 }" end, law_ = function() return "'linear'" end,
}

--- Text of a callback.
function words.callback(r)
  local name = r.of{ "raise", "raise_table", "yield", "nonsense", "nans", "collect", "nothing", "number",
    "way",
    "predicate", "run", "settle", "release", "close", "restore", "clear", "change", "recurse", "snapshot",
      "save" }
  local object = r.of{ "scene", "wire", "clamp", "gripper", "obstacle", "force", "join", "snapshot", "any" }
  if name == "run" or name == "settle" or name == "save" or name == "change"
    or name == "snapshot" then object = "scene" end
  if name == "release" or name == "close" or name == "change" or name == "run" or name == "settle"
    or name == "restore" or name == "save" or name == "snapshot" then
    return ("F.%s(%s)"):format(name .. "_it", r.pick(object))
  end
  return "F." .. name
end

function words.file(r)
  return r.of{ "dir .. '/a.sws'", "dir .. '/a.sws'", "dir .. '/b.sws'", "dir .. '/a.csv'", "dir .. '/a.json'",
    "dir .. '/a.pvd'", "dir .. '/a.svg'", "dir .. '/none/a.csv'", "dir", "dir .. '/full'", "dir .. '/t.obj'",
    "dir .. '/' .. long" }
end

local function by_row(r, row)
  local low, high = row.min, row.max
  if row.type == "boolean" then return r.of{ "true", "false" } end
  if row.type == "choice" then return ("'%s'"):format(r.of(row.choices)) end
  if row.type == "vector" then return words.vector(r) end
  if row.type == "rotation" then return rotation(r) end
  if row.type == "text" then return by_name.name(r) end
  if row.type == "integer" then
    low = math.max(low or 0, -100)
    return ("%d"):format(r.whole(low, math.min(high or low + 8, low + 8)))
  end
  if row.type == "number" then
    if low and high and high - low <= 100 and r.chance(0.7) then return r.between(low, high) end
    local size = r.size(-4, 1)
    if r.chance(0.05) and low then size = ("%.17g"):format(low) end
    if r.chance(0.05) and high then size = ("%.17g"):format(high) end
    return size
  end
  return by_name.point(r)
end

-- Every row by name; several tables may have a row of the same name.
local rows = {}
local function learn(list)
  for _, row in ipairs(list) do
    rows[row.name] = rows[row.name] or {}
    table.insert(rows[row.name], row)
  end
end
local names = {}
for name in pairs(samples.registry.params) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do learn(samples.registry.params[name]) end
for _, family in ipairs{ "forces", "holds", "shapes" } do
  for _, entry in ipairs(samples.registry[family]) do learn(entry.params) end
end
learn(core.trajectory_parameters())

--- Text of a possible value for a parameter of this name.
function words.value(r, name, row)
  local text
  if by_name[name] and not (row and row.type == "vector" and name == "force") then text = by_name[name](r)
  elseif row then text = by_row(r, row)
  elseif rows[name] then text = by_row(r, r.of(rows[name]))
  else text = r.of{ "true", "0.01", "1", words.vector(r) } end
  if row and row.type == "vector" and not text:find "^{" then text = words.vector(r) end
  if row and row.type == "number" and (text:find "^{" or text:find "'") then text = by_row(r, row) end
  return or_hostile(r, text)
end

local function key_text(key) return key:find "^%a[%w_]*$" and key or ("[%q]"):format(key) end

--- A table constructor with some of the keys (each with probability `share`), and always the keys of `fixed`,
-- a list of { key, text }.
function words.table_of(r, keys, share, fixed)
  local list, has = {}, {}
  for _, pair in ipairs(fixed or {}) do
    has[pair[1]] = true
    list[#list + 1] = key_text(pair[1]) .. " = " .. pair[2]
  end
  for _, key in ipairs(keys) do
    local name, row = key, nil
    if type(key) == "table" then name, row = key.name, key end
    if not has[name] and (r.chance(share) or row and row.required) then
      has[name] = true
      list[#list + 1] = key_text(name) .. " = " .. words.value(r, name, row)
    end
  end
  if r.chance(r.hostility * 0.2) then list[#list + 1] = ("[%s] = 1"):format(r.of{ "1", "1.5", "true",
    "'no such key'",
    "print", "T.raise" }) end
  if #list == 0 then return "{}" end
  return "{ " .. table.concat(list, ", ") .. " }"
end

--- Names of existing parameters.
words.names = {}
for name in pairs(by_name) do words.names[#words.names + 1] = name end
for name in pairs(rows) do
  if not by_name[name] then words.names[#words.names + 1] = name end
end
table.sort(words.names)

return words
