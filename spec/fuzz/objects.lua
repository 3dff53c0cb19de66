-- SPDX-License-Identifier: GPL-3.0-or-later
-- Random arguments for the parts of a scene: wires, holds, obstacles, forces, runs, moves.
local sw = require "softworld"
local words = require "fuzz.words"
local samples = require "contract.samples"

local objects = {}
local params = samples.registry.params

function objects.join_rows(...)
  local all = {}
  for _, list in ipairs{ ... } do table.move(list, 1, #list, #all + 1, all) end
  return all
end

function objects.rows_but(rows, ...)
  local without, list = {}, {}
  for _, name in ipairs{ ... } do without[name] = true end
  for _, row in ipairs(rows) do
    if not without[row.name] then list[#list + 1] = row end
  end
  return list
end

function objects.member(family, name)
  for _, entry in ipairs(samples.registry[family]) do
    if entry.name == name then return entry end
  end
end

function objects.place(r) return r.of{ "0", "0.05", "0.1", "0.2", "0.2501", "0.3", r.between(0, 0.4) } end

local starts = { "{ 0, 0, 0.1 }", "{ 0, 0, 0.1 }", "{ 0, 0.05, 0.05 }", "{ 0, 0, 0.003 }", "{ 0, 0, 0.1 }" }
local ends = { "{ 0.4, 0, 0.1 }", "{ 0.4, 0, 0.1 }", "{ 0.3, 0.05, 0.1 }", "{ 0, 0.3, 0.003 }",
  "{ 0.2, 0, -0.2 }" }

function objects.wire(r)
  local fixed, model = {}, words.value(r, "model")
  local function fix(key, text) fixed[#fixed + 1] = { key, words.or_hostile(r, text) } end
  local mesh = model:find "tube" or model:find "radial" or model:find "cubic" or model:find "composite"
  fix("model", model)
  if mesh then
    fix("E", "1e7") fix("density", "1000") fix("radius", "0.012")
    fix("segments", ("%d"):format(r.whole(4, 20)))
    fix("from", "{ 0, 0, 0.1 }") fix("to", "{ 0.2, 0, 0.1 }")
    local rows = objects.join_rows(params.wire_mesh, params["calibrate_" .. model:match "%a+"] or {})
    return words.table_of(r, rows, 0.1 * r.share(), fixed)
  end
  fix("segments", ("%d"):format(r.whole(1, 24)))
  local kind = r.whole(1, 4)
  if kind == 1 then fix("cable", words.value(r, "cable"))
  elseif kind == 2 then fix("E", r.size(7, 10)) fix("density", "1400") fix("radius", r.size(-3, -2.3))
  else
    fix("EA", r.size(1, 5)) fix("EI", r.size(-4, -2)) fix("mass_per_length", "0.05") fix("radius", "0.002")
    if r.chance(0.5) then fix("GJ", r.size(-4, -2)) end
    if kind == 4 and r.chance(0.5) then fix("rolls", "true") end
  end
  if r.chance(0.85) then
    fix("from", r.of(starts)) fix("to", r.of(ends))
  else fix("path", words.value(r, "path")) end
  return words.table_of(r, objects.join_rows(params.wire, params.section), 0.03, fixed)
end

function objects.particles(r)
  local fixed = { { "positions", words.value(r, "positions") }, { "masses", words.value(r, "masses") },
    { "radius", words.or_hostile(r, "0.01") } }
  if r.chance(0.7) then fixed[#fixed + 1] = { "links", words.value(r, "links") } end
  return words.table_of(r, params.particles, 0.15, fixed)
end

function objects.obstacle(r)
  local shape = r.of(samples.registry.shapes)
  local fixed = { { "shape", words.or_hostile(r, "'" .. shape.name .. "'") } }
  for name, text in samples.written(shape) do fixed[#fixed + 1] = { name, words.or_hostile(r, text) } end
  return words.table_of(r, objects.join_rows(shape.params, params.obstacle), 0.3, fixed)
end

function objects.hold(kind)
  return function(r)
    local entry = objects.member("holds", kind)
    return ("%s, %s"):format(r.pick "wire", words.table_of(r, entry and entry.params or {}, 0.15,
      { { "s", words.or_hostile(r, objects.place(r)) } }))
  end
end

function objects.force(r)
  local entry = r.of(samples.registry.forces)
  if r.chance(0.25) then
    return ("{ kind = %s, on = %s }"):format(words.or_hostile(r, words.callback(r)), r.pick "wire")
  end
  local on = entry.of_web and r.pick "particles" or r.pick(r.of{ "wire", "wire", "wire", "particles" })
  local fixed = { { "kind", words.or_hostile(r, "'" .. entry.name .. "'") }, { "on", words.or_hostile(r,
    on) } }
  return words.table_of(r, entry.params or {}, 0.4, fixed)
end

local quantities = { "tip", "position", "max_tension", "max_stress", "max_strain", "min_bend_radius", "force",
  "moment", "energy", "penetration", "gripper1.peak_force", "gripper1.mean_moment", "clamp1.force" }

local function tolerance(r)
  if r.chance(0.6) then return words.or_hostile(r, r.size(-7, -3)) end
  if r.chance(0.3) then
    return ("{ { name = 'own', value = %s, unit = 'm', of = %s } }"):format(words.or_hostile(r, "0.1"),
      words.value(r, "of"))
  end
  return ("{ ['%s'] = %s }"):format(r.of(quantities), words.or_hostile(r, r.size(-3, 1)))
end

-- Every run ends, because it has few steps; its other arguments are random.
function objects.run(r)
  local fixed = {}
  if r.chance(0.75) then fixed[1] = { "duration", words.or_hostile(r, r.size(-2.5, -0.5)) } end
  if r.chance(0.12) then
    fixed[#fixed + 1] = { "tolerance", tolerance(r) }
    if fixed[#fixed][2]:find "{" then fixed[#fixed + 1] = { "levels", "3" } end
  end
  local rows = objects.rows_but(params.run, "duration", "tolerance", "max_steps", "frame")
  fixed[#fixed + 1] = { "max_steps", ("%d"):format(r.whole(1, 60)) }
  local text = words.table_of(r, rows, 0.1, fixed)
  if text:find "quasistatic = true" then text = text:gsub("max_steps = %d+", "max_steps = 8") end
  return text
end

function objects.settle(r)
  local fixed = { { "max_iterations", ("%d"):format(r.whole(1, 60)) } }
  if r.chance(0.2) then
    fixed[2] = { "tolerance", tolerance(r) }
    if fixed[2][2]:find "{" then fixed[3] = { "levels", "3" } end
  end
  return words.table_of(r, {}, 0, fixed)
end

function objects.grasp(r)
  local fixed, approach = { { "s", words.or_hostile(r, objects.place(r)) } }, r.of{ "imposed", "plates",
    "plates",
    "mixed" }
  if r.chance(0.15) then fixed = {} end
  if approach ~= "imposed" or r.chance(0.1) then
    fixed[#fixed + 1] = { "approach", words.or_hostile(r, "'" .. approach .. "'") }
    fixed[#fixed + 1] = { r.of{ "force", "force", "distance" }, words.or_hostile(r, r.size(-1, 1)) }
    if r.chance(0.5) then fixed[#fixed + 1] = { "speed", "0.1" } end
  end
  return ("%s, %s"):format(r.pick "wire", words.table_of(r, { "on_slip", "region", "margin", "freeze",
    "section" }, 0.05,
    fixed))
end

function objects.move(r)
  local fixed = { { r.of{ "by", "by", "by", "to", "points", "turn", "path" }, nil } }
  fixed[1][2] = words.value(r, fixed[1][1])
  fixed[2] = r.chance(0.6) and { "speed", words.or_hostile(r, r.size(-1.5, 0.3)) }
    or { "duration", words.or_hostile(r, r.size(-2, -0.7)) }
  return words.table_of(r, { "law", "blend", "on_slip", "acceleration", "relative", "rotation", "stop" },
    0.07, fixed)
end

function objects.trajectory(r)
  local fixed = { { r.of{ "points", "points", "func", "path" }, nil } }
  fixed[1][2] = words.value(r, fixed[1][1])
  fixed[2] = { r.of{ "speed", "duration" }, words.or_hostile(r, r.size(-2, 0)) }
  return words.table_of(r, sw.core.trajectory_parameters(), 0.1, fixed)
end

function objects.follow(r)
  if r.chance(0.2) then return r.of{ r.pick "trajectory", "nil", words.callback(r) } end
  if r.chance(0.2) then return ("F.way, { duration = %s }"):format(words.or_hostile(r, "0.05")) end
  return objects.trajectory(r)
end

function objects.condition(r)
  return r.of{ words.callback(r), "F.predicate", ("{ force = %s, on = %s }"):format(words.or_hostile(r,
    "0.1"),
    r.pick(r.of{ "gripper", "obstacle", "clamp" })), ("{ slip = 1e-4, on = %s }"):format(r.pick "gripper"),
    ("{ contact = %s }"):format(r.pick "obstacle"),
    ("{ distance = 0.1, between = { %s, { %s, s = 0.1 } } }"):format(r.pick "gripper", r.pick "wire") }
end

function objects.at_place(r) return r.chance(0.9) and words.or_hostile(r, objects.place(r)) or "" end

function objects.table_with(share, ...)
  local names = { ... }
  return function(r) return words.table_of(r, names, share) end
end

function objects.section_words(r)
  return words.table_of(r, objects.join_rows(params.calibrate, params["calibrate_" .. r.of{ "tube",
    "radial", "cubic",
    "composite" }]), 0.05, { { "mesh", words.value(r, "mesh") }, { "cable", words.value(r, "cable") } })
end

-- A study with few evaluations, of a number or of a scene.
function objects.study(r)
  local evaluate = r.of{ "function(p) return { r = p.x, q = p.x * p.x } end",
    "function(p, s) return { r = p.x, q = s and s.time or 0 } end",
    "function(p) if p.x > 0.5 then p.give_up 'far' end; return { r = p.x, q = p.random() } end",
    "function(p) return { r = { p.x, 2 * p.x }, q = 1 / (p.x - 0.5) } end",
    r.of{ "F.raise", "F.nothing", "F.nonsense", "F.nans", "F.number", "F.collect" } }
  local setup = r.chance(0.3) and { "setup", words.or_hostile(r, r.of{ words.callback(r),
    ("function() return %s end"):format(r.pick "scene") }) } or nil
  local fixed = { { "name", words.or_hostile(r, r.of{ "'a'", "'b'", "'c d'" }) },
    { "parameters", words.or_hostile(r, r.of{ "{ x = { 0, 1 } }",
      "{ x = { 1e-3, 10, log = true, unit = 'N' } }",
      "{ x = { 1, 9, integer = true }, y = { choices = { 'rod', 'tube' } } }",
      ("{ x = { %s, %s } }"):format(words.or_hostile(r, "0"), words.or_hostile(r, "2")) }) },
    { "evaluate", words.or_hostile(r, evaluate) },
    { "workers", words.or_hostile(r, r.of{ "0", "0", "1", "2" }) }, { "cpu", "5" } }
  if setup then fixed[#fixed + 1] = setup end
  if r.chance(0.3) then
    fixed[#fixed + 1] = { "constraints", words.or_hostile(r, "{ q = { max = 0.5 } }") }
  end
  if r.chance(0.4) then
    fixed[#fixed + 1] = { "file", words.or_hostile(r, r.of{ "dir .. '/a.study'", words.file(r) }) }
  end
  return words.table_of(r, { "seed", "memory" }, 0.1, fixed)
end

function objects.few(name, count)
  return { name, ("%d"):format(count) }
end

-- A picture or film of a few pixels, written to the case's folder; no external program draws for minutes.
function objects.drawing(name, ...)
  local keys = { ... }
  return function(r)
    local path = r.of{ ("dir .. '/%s.png'"):format(name), ("dir .. '/%s.svg'"):format(name), words.file(r) }
    local technique = r.of{ "'shaded'", "'wireframe'", "'particles'" }
    local colour = r.chance(0.3) and r.of{ "'curvature'", "'tension'", "'model'" }
    return words.table_of(r, keys, 0.15, { { "path", words.or_hostile(r, path) },
      { "width", words.or_hostile(r, "200") }, { "technique", words.or_hostile(r, technique) },
      colour and { "colour", words.or_hostile(r, colour) } or nil })
  end
end

function objects.export(ending)
  return function(r) return words.or_hostile(r, r.of{ ("dir .. '/x.%s'"):format(ending), words.file(r) }) end
end

return objects
