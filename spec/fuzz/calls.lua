-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments of the calls that need more than one guess: what a method takes, as Lua text. What is
-- not listed here gets guesses of all kinds.
local sw = require "softworld"
local words = require "fuzz.words"
local samples = require "contract.samples"

local calls = {}
local params = samples.registry.params

local function join_rows(...)
  local all = {}
  for _, list in ipairs{ ... } do table.move(list, 1, #list, #all + 1, all) end
  return all
end

local function rows_but(rows, ...)
  local without, list = {}, {}
  for _, name in ipairs{ ... } do without[name] = true end
  for _, row in ipairs(rows) do
    if not without[row.name] then list[#list + 1] = row end
  end
  return list
end

local function member(family, name)
  for _, entry in ipairs(samples.registry[family]) do
    if entry.name == name then return entry end
  end
end

local function place(r) return r.of{ "0", "0.05", "0.1", "0.2", "0.2501", "0.3", r.between(0, 0.4) } end

local starts = { "{ 0, 0, 0.1 }", "{ 0, 0, 0.1 }", "{ 0, 0.05, 0.05 }", "{ 0, 0, 0.003 }", "{ 0, 0, 0.1 }" }
local ends = { "{ 0.4, 0, 0.1 }", "{ 0.4, 0, 0.1 }", "{ 0.3, 0.05, 0.1 }", "{ 0, 0.3, 0.003 }",
  "{ 0.2, 0, -0.2 }" }

local function wire(r)
  local fixed, model = {}, words.value(r, "model")
  local function fix(key, text) fixed[#fixed + 1] = { key, words.or_hostile(r, text) } end
  local mesh = model:find "tube" or model:find "radial" or model:find "cubic" or model:find "composite"
  fix("model", model)
  if mesh then
    fix("E", "1e7") fix("density", "1000") fix("radius", "0.012")
    fix("segments", ("%d"):format(r.whole(4, 20)))
    fix("from", "{ 0, 0, 0.1 }") fix("to", "{ 0.2, 0, 0.1 }")
    local rows = join_rows(params.wire_mesh, params["calibrate_" .. model:match "%a+"] or {})
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
  return words.table_of(r, join_rows(params.wire, params.section), 0.03, fixed)
end

local function particles(r)
  local fixed = { { "positions", words.value(r, "positions") }, { "masses", words.value(r, "masses") },
    { "radius", words.or_hostile(r, "0.01") } }
  if r.chance(0.7) then fixed[#fixed + 1] = { "links", words.value(r, "links") } end
  return words.table_of(r, params.particles, 0.15, fixed)
end

local function obstacle(r)
  local shape = r.of(samples.registry.shapes)
  local fixed = { { "shape", words.or_hostile(r, "'" .. shape.name .. "'") } }
  for name, text in samples.written(shape) do fixed[#fixed + 1] = { name, words.or_hostile(r, text) } end
  return words.table_of(r, join_rows(shape.params, params.obstacle), 0.3, fixed)
end

local function hold(kind)
  return function(r)
    local entry = member("holds", kind)
    return ("%s, %s"):format(r.pick "wire", words.table_of(r, entry and entry.params or {}, 0.15,
      { { "s", words.or_hostile(r, place(r)) } }))
  end
end

local function force(r)
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

-- Every run ends: it has few steps, whatever else it is given.
local function run(r)
  local fixed = {}
  if r.chance(0.75) then fixed[1] = { "duration", words.or_hostile(r, r.size(-2.5, -0.5)) } end
  if r.chance(0.12) then
    fixed[#fixed + 1] = { "tolerance", tolerance(r) }
    if fixed[#fixed][2]:find "{" then fixed[#fixed + 1] = { "levels", "3" } end
  end
  local rows = rows_but(params.run, "duration", "tolerance", "max_steps", "frame")
  fixed[#fixed + 1] = { "max_steps", ("%d"):format(r.whole(1, 60)) }
  local text = words.table_of(r, rows, 0.1, fixed)
  if text:find "quasistatic = true" then text = text:gsub("max_steps = %d+", "max_steps = 8") end
  return text
end

local function settle(r)
  local fixed = { { "max_iterations", ("%d"):format(r.whole(1, 60)) } }
  if r.chance(0.2) then
    fixed[2] = { "tolerance", tolerance(r) }
    if fixed[2][2]:find "{" then fixed[3] = { "levels", "3" } end
  end
  return words.table_of(r, {}, 0, fixed)
end

local function grasp(r)
  local fixed, approach = { { "s", words.or_hostile(r, place(r)) } }, r.of{ "imposed", "plates", "plates",
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

local function move(r)
  local fixed = { { r.of{ "by", "by", "by", "to", "points", "turn", "path" }, nil } }
  fixed[1][2] = words.value(r, fixed[1][1])
  fixed[2] = r.chance(0.6) and { "speed", words.or_hostile(r, r.size(-1.5, 0.3)) }
    or { "duration", words.or_hostile(r, r.size(-2, -0.7)) }
  return words.table_of(r, { "law", "blend", "on_slip", "acceleration", "relative", "rotation", "stop" },
    0.07, fixed)
end

local function trajectory(r)
  local fixed = { { r.of{ "points", "points", "func", "path" }, nil } }
  fixed[1][2] = words.value(r, fixed[1][1])
  fixed[2] = { r.of{ "speed", "duration" }, words.or_hostile(r, r.size(-2, 0)) }
  return words.table_of(r, sw.core.trajectory_parameters(), 0.1, fixed)
end

local function follow(r)
  if r.chance(0.2) then return r.of{ r.pick "trajectory", "nil", words.callback(r) } end
  if r.chance(0.2) then return ("F.way, { duration = %s }"):format(words.or_hostile(r, "0.05")) end
  return trajectory(r)
end

local function condition(r)
  return r.of{ words.callback(r), "F.predicate", ("{ force = %s, on = %s }"):format(words.or_hostile(r,
    "0.1"),
    r.pick(r.of{ "gripper", "obstacle", "clamp" })), ("{ slip = 1e-4, on = %s }"):format(r.pick "gripper"),
    ("{ contact = %s }"):format(r.pick "obstacle"),
    ("{ distance = 0.1, between = { %s, { %s, s = 0.1 } } }"):format(r.pick "gripper", r.pick "wire") }
end

local function at_place(r) return r.chance(0.9) and words.or_hostile(r, place(r)) or "" end

local function table_with(share, ...)
  local names = { ... }
  return function(r) return words.table_of(r, names, share) end
end

local function section_words(r)
  return words.table_of(r, join_rows(params.calibrate, params["calibrate_" .. r.of{ "tube", "radial", "cubic",
    "composite" }]), 0.05, { { "mesh", words.value(r, "mesh") }, { "cable", words.value(r, "cable") } })
end

-- A study of few evaluations, of one number or of a scene.
local function study(r)
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

local function few(name, count)
  return { name, ("%d"):format(count) }
end

-- A picture or a film of a few pixels, into the case's folder; none that other programs draw for minutes.
local function drawing(name, ...)
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

local function export(ending)
  return function(r) return words.or_hostile(r, r.of{ ("dir .. '/x.%s'"):format(ending), words.file(r) }) end
end

--- Arguments by "kind.method".
local by_call = {
  ["scene.wire"] = wire, ["scene.particles"] = particles, ["scene.obstacle"] = obstacle,
  ["scene.clamp"] = hold "clamp", ["scene.pin"] = hold "pin", ["scene.grip"] = hold "grip",
  ["scene.feed"] = hold "feed", ["scene.force"] = force, ["scene.run"] = run, ["scene.settle"] = settle,
  ["scene.hold"] = function(r) return ("%s, %s"):format(r.pick "particles", words.table_of(r, { "at",
    "name" }, 0.1,
    { { "particles", words.value(r, "particles") } })) end,
  ["scene.join"] = function(r) return words.table_of(r, rows_but(params.join, "ends"), 0.2,
    { { "ends", words.value(r, "ends") } }) end,
  ["scene.wire_contact"] = function(r) return words.table_of(r, params.wire_contact, 0.3) end,
  ["scene.clip"] = function(r) return words.table_of(r, { "name", "direction", "axis", "radius", "friction",
    "way",
    "stiffness", "snap", "on" }, 0.1, { { "at", words.or_hostile(r, "{ 0.2, 0, 0.08 }") },
    { "width", words.value(r, "width") }, { "insertion", words.or_hostile(r, r.size(-1, 2)) },
    { "retention", words.or_hostile(r, r.size(-1, 2)) } }) end,
  ["scene.channel"] = function(r) return words.table_of(r, { "thickness", "up", "friction", "restitution",
    "name" }, 0.1,
    { { "points", words.value(r, "points") }, { "width", words.or_hostile(r, "0.02") },
    { "depth", words.or_hostile(r, "0.02") } }) end,
  ["scene.tie"] = function(r) return ("%s, %s"):format(r.pick "wire", words.table_of(r, { "to", "slack",
    "strength" }, 0.3,
    { { "s", words.or_hostile(r, place(r)) } })) end,
  ["scene.gripper"] = table_with(0.15, "name", "pads", "at", "rotation", "slip_tolerance", "arm", "on_crash"),
  ["scene.restore"] = function(r) return r.pick "snapshot" end,
  ["scene.save"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["scene.resume"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["scene.evaluate"] = function(r) return ("%s, %s"):format(r.pick "wire", words.table_of(r, { "rate",
    "statics",
    "positions", "velocities", "direction" }, 0.1)) end,
  ["scene.advance"] = function(r) return ("{ dt = %s, max_steps = 5 }, %s"):format(words.or_hostile(r,
    "0.01"),
    words.or_hostile(r, r.size(-3, -1))) end,
  ["scene.frame"] = function(r) return words.or_hostile(r, tostring(r.whole(0, 4))) end,
  ["wire.remodel"] = function(r) return words.table_of(r, join_rows(rows_but(params.remodel, "model"),
    params.wire_mesh),
    0.08, { { "model", words.or_hostile(r, r.of{ "'rod'", "'string'", "'tube'", "'tube'",
      "'radial'" }) } }) end,
  ["wire.frequencies"] = function(r) return words.table_of(r, params.frequencies, 0.4) end,
  ["wire.set_velocity"] = function(r) return words.vector(r, 1) end,
  ["wire.width"] = function(r) return ("%s, %s"):format(place(r), words.value(r, "direction")) end,
  ["particles.set_velocity"] = function(r) return words.vector(r, 1) end,
  ["gripper.grasp"] = grasp, ["gripper.move"] = move,
  ["gripper.move_to"] = function(r) return ("%s, { speed = %s }"):format(words.vector(r),
    words.or_hostile(r, "0.5")) end,
  ["gripper.rotate"] = function(r) return words.table_of(r, {}, 0, { { "axis", words.value(r, "axis") },
    { "angle", words.or_hostile(r, r.between(-2, 2)) }, { "duration", words.or_hostile(r, "0.05") } }) end,
  ["gripper.press"] = table_with(0.5, "force", "speed", "distance", "direction"),
  ["gripper.close_jaws"] = table_with(0.5, "force", "speed", "distance"),
  ["gripper.open_jaws"] = table_with(0.3, "speed", "distance"),
  ["gripper.release"] = table_with(0.1, "speed", "distance"),
  ["gripper.handover"] = function(r) return ("%s, { s = %s }"):format(r.pick "gripper", place(r)) end,
  ["gripper.clip"] = function(r) return words.table_of(r, { "speed", "max_force", "approach_speed", "align",
    "overtravel",
    "fail" }, 0.3, { { "into", words.value(r, "into") } }) end,
  ["gripper.force"] = table_with(0.2, "axes", "finger"), ["gripper.moment"] = table_with(0.2, "axes",
    "finger", "at"),
  ["gripper.over"] = function(r) return r.of{ "", "0, 0.1", words.or_hostile(r, "0.01") .. ", 0.02",
    "0, 1, " .. words.vector(r) } end,
  ["gripper.pressure_map"] = table_with(0.4, "cell"),
  ["clamp.follow"] = follow, ["obstacle.follow"] = follow, ["tool.follow"] = follow,
  ["clamp.pose"] = function(r) return r.of{ "", words.vector(r), words.vector(r) .. ", " .. words.value(r,
    "rotation") } end,
  ["obstacle.pose"] = function(r) return r.of{ "", words.vector(r), words.vector(r) .. ", "
    .. words.value(r, "rotation") } end,
  ["clamp.feed"] = function(r) return words.table_of(r, { "duration", "acceleration", "law" }, 0.1,
    { { "length", words.value(r, "length") }, { "speed", words.value(r, "speed") } }) end,
  ["process.wait"] = function(r) return words.or_hostile(r, r.size(-4, -1)) end,
  ["process.wait_until"] = function(r) return ("%s, { timeout = %s }"):format(condition(r), words.value(r,
    "timeout")) end,
  ["process.feed"] = function(r) return ("%s, { length = %s, speed = %s }"):format(r.pick "clamp",
    words.value(r, "length"), words.value(r, "speed")) end,
  ["run.save"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/a.csv'", "dir .. '/a.json'",
    "dir .. '/full'", words.file(r) }) end,
  ["run.vtk"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/a.pvd'", words.file(r) }) end,
  ["run.chart"] = function(r) return words.table_of(r, { "title", "columns" }, 0.2,
    { { "path", words.or_hostile(r, r.of{ "dir .. '/a.svg'", words.file(r) }) } }) end,
  ["run.picture"] = drawing("run", "camera", "t", "count", "height"),
  ["scene.picture"] = drawing("scene", "camera", "height"),
  ["run.film"] = function(r) return export "gif"(r) .. ", " .. words.table_of(r, { "speed", "rate" }, 0.2,
    { { "width", "100" }, { "frames", "3" } }) end,
  ["run.gltf"] = export "glb", ["run.obj"] = export "obj", ["run.stl"] = export "stl",
  ["run.report"] = export "html",
  ["sw.plot"] = function(r) return ("{ %s, path = %s, log = %s }"):format(r.chance(0.5) and r.pick "run"
    or words.or_hostile(r, "{ x = { 1, 2, 3 }, y = { 1, 4, 9 } }"), words.or_hostile(r, "dir .. '/p.svg'"),
    words.or_hostile(r, r.of{ "nil", "'x'", "'xy'" })) end,
  ["sw.study"] = study,
  ["study.sweep"] = function(r) return words.table_of(r, { "kind" }, 0.3,
    { r.chance(0.5) and few("count", r.whole(1, 6)) or { "grid", words.or_hostile(r, "3") } }) end,
  ["study.minimise"] = function(r) return ("%s, %s"):format(
    words.or_hostile(r, r.of{ "'r'", "'q'", "'x'" }),
    words.table_of(r, { "method", "tolerance", "starts" }, 0.2, { few("evaluations", r.whole(1, 12)) })) end,
  ["study.spread"] = function(r) return words.table_of(r, {}, 0, { few("count", r.whole(1, 8)) }) end,
  ["study.fit"] = function(r)
    local data = r.of{ "{ r = 0.3 }", "{ r = { 0.3, sigma = 0.01 }, q = { 0.1, weight = 2 } }",
      "{ q = { { 0.1, 0.2 }, sigma = 1e-3 } }" }
    return words.table_of(r, { "tolerance", "step", "starts" }, 0.2,
      { { "data", words.or_hostile(r, data) }, few("evaluations", r.whole(1, 15)) })
  end,
  ["study.pareto"] = function(r) return words.or_hostile(r, ("{ %s, %s, evaluations = %d }"):format(
    words.or_hostile(r, "'r'"), words.or_hostile(r, "'q'"), r.whole(1, 20))) end,
  ["study.front"] = function(r) return words.or_hostile(r, "{ 'r', 'q' }") end,
  ["study.advise"] = function(r) return words.or_hostile(r, r.of{ "'r'", "'q'" }) end,
  ["study.again"] = function(r) return words.or_hostile(r, r.of{ "1", "2", "1, 2", "7" }) end,
  ["study.report"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/s.html'", words.file(r) }) end,
  ["study.run"] = function(r) return words.table_of(r, { "tasks", "seconds" }, 0.5,
    { { "on", words.or_hostile(r, "'here'") } }) end,
  ["scene.remove"] = function(r) return words.or_hostile(r, r.pick(r.of{ "wire", "gripper", "obstacle",
    "force", "clamp", "particles" })) end,
  ["sw.calibration"] = function(r)
    return words.table_of(r, { "name", "source" }, 0.2, { { "outer_diameter", words.or_hostile(r, "0.003") },
      { "mass_per_length", words.or_hostile(r, "{ 0.02, sigma = 1e-4 }") },
      { "EI", words.or_hostile(r, "{ 2e-3, sigma = 1e-4 }") },
      { "twist", words.or_hostile(r, ("{ length = %s, angle = %s, sigma = %s, tension = %s }"):format(
        words.or_hostile(r, "0.3"), words.or_hostile(r, "12"), words.or_hostile(r, "0.2"),
        words.or_hostile(r, "2"))) },
      r.chance(0.5) and { "pull", words.or_hostile(r, ("{ length = 0.5, points = { { 1, 1e-5 }, { 2, 2e-5 }, "
        .. "{ %s, %s } } }"):format(words.or_hostile(r, "3"), words.or_hostile(r, "3e-5"))) } or nil })
  end,
  ["study.best"] = function(r) return words.or_hostile(r, r.of{ "'r'", "'q'", "'z'" }) end,
  ["study.csv"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/s.csv'", words.file(r) }) end,
  ["study.json"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/s.json'", words.file(r) }) end,
  ["study.chart"] = function(r) return words.table_of(r, { "log" }, 0.2,
    { { "x", words.or_hostile(r, "'x'") }, { "y", words.or_hostile(r, r.of{ "'r'", "'q'" }) },
    { "path", words.or_hostile(r, "dir .. '/s.svg'") } }) end,
  ["scene.observe"] = function(r) return words.table_of(r, { "every", "wall" }, 0.4,
    { { "call", words.callback(r) } }) end,
  ["scene.view"] = function(r) return words.table_of(r, { "port" }, 0.1, { { "open", "false" } }) end,
  ["scene.slider"] = function(r) return ("%s, %s"):format(r.pick "wire", words.table_of(r,
    rows_but(member("holds", "slider").params, "s", "from", "to"), 0.15,
    { { "s", words.or_hostile(r, place(r)) },
    r.chance(0.8) and { "direction", words.or_hostile(r, r.of{ "{ 1, 0, 0 }", "{ 0, 1, 1 }" }) }
      or { "path", words.value(r, "points") } })) end,
  ["run.summary"] = function(r) return words.or_hostile(r, "io.stderr") end,
  ["channel.contains"] = function(r) return r.pick "wire" end,
  ["channel.moment"] = function(r) return r.of{ "", ("{ at = %s }"):format(words.vector(r)) } end,
  ["clamp.push"] = function(r) return words.or_hostile(r, r.size(-1, 1)) end,
  ["clamp.speed"] = function(r) return r.of{ "", words.or_hostile(r, r.size(-2, 0)) } end,
  ["clamp.force_limit"] = function(r) return words.or_hostile(r, r.size(-1, 2)) end,
  ["gripper.approach"] = function(r) return ("%s, %s"):format(r.pick "wire", words.table_of(r, { "direction",
    "speed", "slow", "distance" }, 0.2, { { "s", words.or_hostile(r, place(r)) } })) end,
  ["gripper.retreat"] = table_with(0.4, "distance", "speed", "direction"),
  ["gripper.wait"] = function(r) return words.or_hostile(r, r.size(-3, -1)) end,
  ["gripper.squeeze"] = function(r) return r.of{ "", "", words.hostile(r) } end,
  ["gripper.state"] = function() return "" end,
  ["join.force"] = function(r) return words.or_hostile(r, tostring(r.whole(0, 3))) end,
  ["join.moment"] = function(r) return words.or_hostile(r, tostring(r.whole(0, 3))) end,
  ["particles.particle"] = function(r) return words.or_hostile(r, tostring(r.whole(0, 6))) end,
  ["scene.find"] = function(r) return words.or_hostile(r, r.of{ "'wire1'", "'clamp1'", "'gripper1'", "'a'",
    "'plane1'", "'wier1'" }) end,
  ["scene.tell"] = function(r) return words.table_of(r, { "s", "value", "text", "time" }, 0.4,
    { { "kind", words.or_hostile(r, "'note'") }, { "object", words.or_hostile(r, "'wire1'") } }) end,
  ["scene.stable_dt"] = function(r) return r.of{ "", "", "'velocity-verlet'", words.hostile(r) } end,
  ["tool.limit"] = function(r) return words.or_hostile(r, r.between(0, 1)) end,
  ["tool.pads_on"] = function(r) return words.or_hostile(r, r.of{ "true", "false" }) end,
  ["tool.hold"] = function(r) return r.of{ "", r.pick "clamp" } end,
  ["tool.freeze"] = function(r) return r.pick "wire" end,
  ["tool.watch"] = function(r) return words.or_hostile(r, "1e-4") .. ", " .. r.of{ "true", "false" } end,
  ["shape.distance"] = function(r) return words.vector(r) .. r.of{ "", ", 0.5" } end,
  ["shape.segment"] = function(r)
    return words.vector(r) .. ", " .. words.vector(r) .. r.of{ "", ", 0.5" }
  end,
  ["shape.sweep"] = function(r) return ("%s, %s, %s, %s, 0.01"):format(words.vector(r), words.vector(r),
    words.vector(r), words.vector(r)) end,
  ["trajectory.sample"] = function(r) return words.or_hostile(r, tostring(r.whole(1, 30))) end,
  ["trajectory.save"] = function(r) return words.or_hostile(r, "dir .. '/way.csv'") end,
  ["wire.bend_limit"] = function(r) return words.table_of(r, { "use", "now" }, 0.3) end,
  ["wire.max_ovalisation"] = function(r) return r.of{ "", "{ now = true }" } end,
  ["wire.max_torsion"] = function(r) return r.of{ "", "{ now = true }" } end,
  ["clip.force"] = function(r) return r.of{ "", r.pick "wire" } end,
  ["sw.scene"] = table_with(0.3, "name", "gravity"), ["trajectory.new"] = trajectory,
  ["sw.load"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["trajectory.read"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["sw.cable"] = function(r) return words.or_hostile(r, words.value(r, "cable")) end,
  ["sw.calibrate"] = section_words,
  ["tune.minimise"] = function(r) return words.table_of(r, { "tolerance", "step" }, 0.2, { { "f",
    words.value(r, "f") },
    { "max_iterations", "20" }, r.chance(0.5) and { "start", words.value(r, "start") }
    or { "from", words.or_hostile(r, "0.01") }, r.chance(0.5) and { "to", words.or_hostile(r, "1") }
      or nil }) end,
  ["cable.define"] = function(r) return words.table_of(r, { "EA", "EI", "GJ", "friction", "source", "flag",
    "spread",
    "bend", "construction", "temperature" }, 0.3, { { "name", "'own'" }, { "outer_diameter",
      words.or_hostile(r, "0.003") },
    { "mass_per_length", words.value(r, "mass_per_length") } }) end,
}
for _, name in ipairs{ "position", "velocity", "acceleration", "rotation", "angular_velocity",
  "angular_acceleration", "delayed" } do
  by_call["trajectory." .. name] = function(r) return words.or_hostile(r, r.size(-3, 0)) end
end
for _, name in ipairs{ "position", "tangent", "curvature", "tension", "strain", "stress", "velocity", "spin",
  "twist_moment", "section", "contact_pressure", "von_mises" } do
  by_call["wire." .. name] = at_place
end

-- How often a method is called among those of its kind; 1 when not listed.
calls.weights = { ["scene.run"] = 14, ["scene.settle"] = 3, ["scene.wire"] = 3, ["scene.gripper"] = 3,
  ["scene.process"] = 12, ["scene.clamp"] = 3, ["scene.pin"] = 2, ["scene.grip"] = 2, ["scene.feed"] = 2,
  ["scene.obstacle"] = 2, ["scene.force"] = 5, ["scene.close"] = 0.05, ["scene.clip"] = 2,
    ["scene.channel"] = 1.5,
  ["scene.tie"] = 2, ["scene.join"] = 3, ["scene.wire_contact"] = 1.5, ["scene.snapshot"] = 2,
    ["scene.restore"] = 2,
  ["scene.save"] = 2, ["scene.resume"] = 1, ["wire.remodel"] = 4, ["wire.frequencies"] = 0.7,
    ["gripper.grasp"] = 5,
  ["gripper.move"] = 4, ["gripper.release"] = 1.5, ["run.pictures"] = 0, ["run.chart"] = 0.15,
    ["clamp.release"] = 0.7,
  ["obstacle.remove"] = 0.7, ["scene.tool"] = 0.5, ["clamp.follow"] = 4, ["obstacle.follow"] = 2,
    ["wire.set_velocity"] = 2,
  ["study.chart"] = 0.1, ["study.cancel"] = 0, ["study.report"] = 0.2,
  ["scene.remove"] = 0.7,
  ["gripper.leave"] = 0, ["view.wait"] = 0, ["scene.view"] = 0.3, ["run.film"] = 0.05, ["sw.plot"] = 0.1,
  ["run.picture"] = 0.3, ["scene.picture"] = 0.3, ["run.report"] = 0.3, ["scene.slider"] = 2,
  ["process.wait"] = 0.1, ["process.wait_until"] = 0.1, ["process.feed"] = 0.1, ["process.step"] = 0.1,
  ["gripper.wait"] = 0.2, ["gripper.press"] = 0.2, ["gripper.clip"] = 0.2, ["gripper.approach"] = 0.3,
  ["run.vtk"] = 0.3, ["run.summary"] = 0.3, ["trajectory.close"] = 0.2, ["shape.close"] = 0.2 }

local function guess(r, learned)
  local kind = r.whole(1, 9)
  local keys = {}
  for i = 1, r.whole(1, 3) do keys[i] = r.of(learned or words.names) end
  local fields = words.table_of(r, keys, 1)
  if kind == 1 then return "" end
  if kind <= (learned and 5 or 3) then return fields end
  if kind == 6 then return words.or_hostile(r, place(r)) end
  if kind == 7 then return r.pick "any" end
  if kind == 8 then return words.vector(r) end
  return r.of{ words.callback(r), words.hostile(r), r.pick "any" .. ", " .. fields, "'a'" }
end

--- Text of the arguments of a call; learned: names of parameters that its errors told.
function calls.arguments(r, call, learned)
  if r.chance(0.1 * r.hostility) then return words.hostile(r) .. ", " .. words.hostile(r) end
  local make = by_call[call]
  if make then return make(r) end
  return guess(r, learned)
end

return calls
