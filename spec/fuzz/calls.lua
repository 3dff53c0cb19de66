-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments, as Lua text, of the methods that need more than one guess. Other methods get guesses of all
-- kinds.
local o = require "fuzz.objects"
local words = require "fuzz.words"
local samples = require "contract.samples"

local calls = {}
local params = samples.registry.params

--- Arguments by "kind.method".
local by_call = {
  ["scene.wire"] = o.wire, ["scene.particles"] = o.particles, ["scene.obstacle"] = o.obstacle,
  ["scene.clamp"] = o.hold "clamp", ["scene.pin"] = o.hold "pin", ["scene.grip"] = o.hold "grip",
  ["scene.feed"] = o.hold "feed", ["scene.force"] = o.force, ["scene.run"] = o.run,
  ["scene.settle"] = o.settle,
  ["scene.hold"] = function(r) return ("%s, %s"):format(r.pick "particles", words.table_of(r, { "at",
    "name" }, 0.1,
    { { "particles", words.value(r, "particles") } })) end,
  ["scene.join"] = function(r) return words.table_of(r, o.rows_but(params.join, "ends"), 0.2,
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
    { { "s", words.or_hostile(r, o.place(r)) } })) end,
  ["scene.gripper"] = o.table_with(0.15, "name", "pads", "at", "rotation", "slip_tolerance", "arm",
  "on_crash"),
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
  ["wire.remodel"] = function(r) return words.table_of(r, o.join_rows(o.rows_but(params.remodel, "model"),
    params.wire_mesh),
    0.08, { { "model", words.or_hostile(r, r.of{ "'rod'", "'string'", "'tube'", "'tube'",
      "'radial'" }) } }) end,
  ["wire.frequencies"] = function(r) return words.table_of(r, params.frequencies, 0.4) end,
  ["wire.set_velocity"] = function(r) return words.vector(r, 1) end,
  ["wire.width"] = function(r) return ("%s, %s"):format(o.place(r), words.value(r, "direction")) end,
  ["particles.set_velocity"] = function(r) return words.vector(r, 1) end,
  ["gripper.grasp"] = o.grasp, ["gripper.move"] = o.move,
  ["gripper.move_to"] = function(r) return ("%s, { speed = %s }"):format(words.vector(r),
    words.or_hostile(r, "0.5")) end,
  ["gripper.rotate"] = function(r) return words.table_of(r, {}, 0, { { "axis", words.value(r, "axis") },
    { "angle", words.or_hostile(r, r.between(-2, 2)) }, { "duration", words.or_hostile(r, "0.05") } }) end,
  ["gripper.press"] = o.table_with(0.5, "force", "speed", "distance", "direction"),
  ["gripper.close_jaws"] = o.table_with(0.5, "force", "speed", "distance"),
  ["gripper.open_jaws"] = o.table_with(0.3, "speed", "distance"),
  ["gripper.release"] = o.table_with(0.1, "speed", "distance"),
  ["gripper.handover"] = function(r) return ("%s, { s = %s }"):format(r.pick "gripper", o.place(r)) end,
  ["gripper.clip"] = function(r) return words.table_of(r, { "speed", "max_force", "approach_speed", "align",
    "overtravel",
    "fail" }, 0.3, { { "into", words.value(r, "into") } }) end,
  ["gripper.force"] = o.table_with(0.2, "axes", "finger"), ["gripper.moment"] = o.table_with(0.2, "axes",
    "finger", "at"),
  ["gripper.over"] = function(r) return r.of{ "", "0, 0.1", words.or_hostile(r, "0.01") .. ", 0.02",
    "0, 1, " .. words.vector(r) } end,
  ["gripper.pressure_map"] = o.table_with(0.4, "cell"),
  ["clamp.follow"] = o.follow, ["obstacle.follow"] = o.follow, ["tool.follow"] = o.follow,
  ["clamp.pose"] = function(r) return r.of{ "", words.vector(r), words.vector(r) .. ", " .. words.value(r,
    "rotation") } end,
  ["obstacle.pose"] = function(r) return r.of{ "", words.vector(r), words.vector(r) .. ", "
    .. words.value(r, "rotation") } end,
  ["clamp.feed"] = function(r) return words.table_of(r, { "duration", "acceleration", "law" }, 0.1,
    { { "length", words.value(r, "length") }, { "speed", words.value(r, "speed") } }) end,
  ["process.wait"] = function(r) return words.or_hostile(r, r.size(-4, -1)) end,
  ["process.wait_until"] = function(r) return ("%s, { timeout = %s }"):format(o.condition(r), words.value(r,
    "timeout")) end,
  ["process.feed"] = function(r) return ("%s, { length = %s, speed = %s }"):format(r.pick "clamp",
    words.value(r, "length"), words.value(r, "speed")) end,
  ["run.save"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/a.csv'", "dir .. '/a.json'",
    "dir .. '/full'", words.file(r) }) end,
  ["run.vtk"] = function(r) return words.or_hostile(r, r.of{ "dir .. '/a.pvd'", words.file(r) }) end,
  ["run.chart"] = function(r) return words.table_of(r, { "title", "columns" }, 0.2,
    { { "path", words.or_hostile(r, r.of{ "dir .. '/a.svg'", words.file(r) }) } }) end,
  ["run.picture"] = o.drawing("run", "camera", "t", "count", "height"),
  ["scene.picture"] = o.drawing("scene", "camera", "height"),
  ["run.film"] = function(r) return o.export "gif"(r) .. ", " .. words.table_of(r, { "speed", "rate" }, 0.2,
    { { "width", "100" }, { "frames", "3" } }) end,
  ["run.gltf"] = o.export "glb", ["run.obj"] = o.export "obj", ["run.stl"] = o.export "stl",
  ["run.report"] = o.export "html",
  ["sw.plot"] = function(r) return ("{ %s, path = %s, log = %s }"):format(r.chance(0.5) and r.pick "run"
    or words.or_hostile(r, "{ x = { 1, 2, 3 }, y = { 1, 4, 9 } }"), words.or_hostile(r, "dir .. '/p.svg'"),
    words.or_hostile(r, r.of{ "nil", "'x'", "'xy'" })) end,
  ["sw.study"] = o.study,
  ["study.sweep"] = function(r) return words.table_of(r, { "kind" }, 0.3,
    { r.chance(0.5) and o.few("count", r.whole(1, 6)) or { "grid", words.or_hostile(r, "3") } }) end,
  ["study.minimise"] = function(r) return ("%s, %s"):format(
    words.or_hostile(r, r.of{ "'r'", "'q'", "'x'" }),
    words.table_of(r, { "method", "tolerance", "starts" }, 0.2, { o.few("evaluations", r.whole(1,
      12)) })) end,
  ["study.spread"] = function(r) return words.table_of(r, {}, 0, { o.few("count", r.whole(1, 8)) }) end,
  ["study.fit"] = function(r)
    local data = r.of{ "{ r = 0.3 }", "{ r = { 0.3, sigma = 0.01 }, q = { 0.1, weight = 2 } }",
      "{ q = { { 0.1, 0.2 }, sigma = 1e-3 } }" }
    return words.table_of(r, { "tolerance", "step", "starts" }, 0.2,
      { { "data", words.or_hostile(r, data) }, o.few("evaluations", r.whole(1, 15)) })
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
    o.rows_but(o.member("holds", "slider").params, "s", "from", "to"), 0.15,
    { { "s", words.or_hostile(r, o.place(r)) },
    r.chance(0.8) and { "direction", words.or_hostile(r, r.of{ "{ 1, 0, 0 }", "{ 0, 1, 1 }" }) }
      or { "path", words.value(r, "points") } })) end,
  ["run.summary"] = function(r) return words.or_hostile(r, "io.stderr") end,
  ["channel.contains"] = function(r) return r.pick "wire" end,
  ["channel.moment"] = function(r) return r.of{ "", ("{ at = %s }"):format(words.vector(r)) } end,
  ["clamp.push"] = function(r) return words.or_hostile(r, r.size(-1, 1)) end,
  ["clamp.speed"] = function(r) return r.of{ "", words.or_hostile(r, r.size(-2, 0)) } end,
  ["clamp.force_limit"] = function(r) return words.or_hostile(r, r.size(-1, 2)) end,
  ["gripper.approach"] = function(r) return ("%s, %s"):format(r.pick "wire", words.table_of(r, { "direction",
    "speed", "slow", "distance" }, 0.2, { { "s", words.or_hostile(r, o.place(r)) } })) end,
  ["gripper.retreat"] = o.table_with(0.4, "distance", "speed", "direction"),
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
  ["sw.scene"] = o.table_with(0.3, "name", "gravity"), ["trajectory.new"] = o.trajectory,
  ["sw.load"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["trajectory.read"] = function(r) return words.or_hostile(r, words.file(r)) end,
  ["sw.cable"] = function(r) return words.or_hostile(r, words.value(r, "cable")) end,
  ["sw.calibrate"] = o.section_words,
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
  by_call["wire." .. name] = o.at_place
end

-- How often a method is called among the methods of its kind; 1 when not listed.
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
  if kind == 6 then return words.or_hostile(r, o.place(r)) end
  if kind == 7 then return r.pick "any" end
  if kind == 8 then return words.vector(r) end
  return r.of{ words.callback(r), words.hostile(r), r.pick "any" .. ", " .. fields, "'a'" }
end

--- Text of a call's arguments; learned: names of parameters that its error messages gave.
function calls.arguments(r, call, learned)
  if r.chance(0.1 * r.hostility) then return words.hostile(r) .. ", " .. words.hostile(r) end
  local make = by_call[call]
  if make then return make(r) end
  return guess(r, learned)
end

return calls
