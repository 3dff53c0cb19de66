-- SPDX-License-Identifier: GPL-3.0-or-later
-- Valid scenes for random calls to start from: put(text) does "v[n] = text" and returns "v[n]".
local samples = require "contract.samples"
local words = require "fuzz.words"

local scenes = {}

-- A horizontal wire along x from x = 0, thick enough for any gripper.
local function wire(put, s, r, more)
  return put(("%s:wire{ E = %s, density = 1400, radius = 0.003, from = { 0, 0, %s }, to = { 0.3, 0, %s }, "
    .. "segments = %d%s }"):format(s, r.size(6.5, 8), more and more.z or "0.1", more and more.z or "0.1",
    r.whole(6, 15), more and more.text or ""))
end

local function run(put, s, r, more)
  return put(("%s:run{ duration = %s, max_steps = %d%s }"):format(s, r.size(-2, -0.7), r.whole(5, 40),
    more or ""))
end

local function process(put, s, ...)
  local lines = { s .. ":process(function(p)" }
  for _, line in ipairs{ ... } do lines[#lines + 1] = "  " .. line end
  lines[#lines + 1] = "end)"
  return put(table.concat(lines, "\n"))
end

local ways = { "", ", approach = 'imposed'", ", approach = 'plates', force = 5, speed = 0.1",
  ", approach = 'plates', force = 20, speed = 0.5", ", approach = 'plates', distance = 0.002, speed = 0.1",
  ", approach = 'plates', force = 8, speed = 0.2",
  ", approach = 'plates', distance = 0.003, speed = 0.2", ", approach = 'mixed', force = 8, speed = 0.2" }

local function handling(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r)
  local table_ = put(s .. ":obstacle{ shape = 'plane', friction = 0.3 }")
  local g = put(("%s:gripper{ at = { 0.05, 0, 0.15 }, pads = { width = 0.02, friction = 0.8, opening = "
    .. "0.01 }, on_crash = %s }"):format(s, r.of{ "'record'", "'stop'", words.callback(r), "F.number" }))
  local h = put(("%s:gripper{ name = 'other', on_crash = F.number }"):format(s))
  process(put, s, ("%s:grasp(%s, { s = 0.05%s, on_slip = %s })"):format(g, w, r.of(ways),
    r.of{ "'record'", "F.number", words.callback(r) }),
    ("try(function() %s:move{ by = { 0.01, 0, 0.01 }, speed = 0.3 } end)"):format(g),
    r.of{ "p:wait(0.02)", ("%s:rotate{ axis = { 0, 0, 1 }, angle = 0.2, duration = 0.03 }"):format(g),
      ("try(function() %s:handover(%s, { s = 0.06 }) end)"):format(g, h),
      ("try(function() %s:press{ force = 0.1, speed = 0.1, distance = 0.01 } end)"):format(g),
      ("try(function() %s:freeze() %s:thaw() end)"):format(g, g),
      ("p:wait_until({ force = 0.1, on = %s }, { timeout = 0.03 })"):format(g) },
    ("try(function() %s:release() end)"):format(g),
    ("try(function() %s:retreat{ distance = 0.02 } end)"):format(g),
    ("try(function() %s:approach(%s, { s = 0.1 }) end)"):format(g, w))
  put(("%s:run{ max_steps = %d, dt = %s }"):format(s, r.whole(20, 250), r.of{ "4e-3", "0.01", "2e-3" }))
  return table_
end

local function mixed(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r)
  local g = put(s .. ":gripper{ pads = { width = 0.01, friction = 0.8, opening = 0.01 } }")
  put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  process(put, s, ("%s:grasp(%s, { s = 0.1, approach = 'mixed', force = %s, speed = 0.2, spacing = 0.002, "
    .. "region = 0.02, freeze = %s })"):format(g, w, r.of{ "4", "8" },
    r.of{ "true", "false" }),
    r.of{ ("try(function() %s:freeze() end)"):format(g), ("p:wait_until(%s, { timeout = 0.05 })"):format(
      words.callback(r)), ("v.snapshot = %s:snapshot()"):format(s) },
    ("try(function() %s:move{ by = { 0, 0, %s }, speed = 0.2 } end)"):format(g, r.between(-0.03, 0.03)),
    r.of{ ("try(function() %s:thaw() end)"):format(g), ("try(function() %s:pressure_map() end)"):format(g),
      ("try(function() %s:squeeze() %s:state() end)"):format(g, g) },
    ("%s:release()"):format(g))
  put(("%s:run{ dt = 4e-3, max_steps = %d }"):format(s, r.whole(20, 150)))
end

local function clipping(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r, { z = "0.03", text = "" })
  local clip = put(("%s:clip{ at = { 0.1, 0, 0.02 }, width = 0.01, insertion = %s, retention = 20 }")
    :format(s, r.between(2, 20)))
  local keeper, guide = put(s .. ":gripper{}"), put(s .. ":gripper{ pads = { width = 0.005 } }")
  process(put, s, ("%s:grasp(%s, { s = 0.19 })"):format(keeper, w),
    ("%s:grasp(%s, { s = 0.11 })"):format(guide, w),
    ("try(function() %s:clip{ into = %s, speed = 0.1, max_force = 100, fail = false } end)"):format(guide,
      clip))
  put(s .. ":run{ dt = 4e-3, max_steps = 250 }")
end

local function feeding(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r)
  local f = put(("%s:feed(%s, { s = 0.1 })"):format(s, w))
  put(f .. r.of{ ":feed{ length = 0.02, speed = 0.2 }", ":speed(0.1)", ":push(0.5)", ":force_limit(2)" })
  if r.chance(0.5) then process(put, s, ("p:feed(%s, { length = 0.02, speed = 0.5 })"):format(f)) end
  run(put, s, r)
  put(f .. ":fed()")
  put(f .. ":drive_force()")
end

local function tying(put, r)
  local s = put "sw.scene{}"
  local a = wire(put, s, r)
  local b = put(("%s:wire{ E = 1e7, density = 1400, radius = 0.003, from = { 0.3, 0, 0.1 }, "
    .. "to = { 0.6, 0, 0.1 }, segments = 8 }"):format(s))
  put(("%s:clamp(%s, { s = 0 })"):format(s, a))
  put(("%s:pin(%s, { s = 0.2 })"):format(s, b))
  put(("%s:tie(%s, { s = 0.2, to = { 0.2, 0, 0.2 }, strength = %s })"):format(s, a, r.size(-2, 1)))
  put(("%s:tie(%s, { s = 0.1, to = { %s, s = 0.1 } })"):format(s, a, b))
  local j = put(("%s:join{ ends = { { %s, s = 0.3 }, { %s, s = 0 } }, stiffness = 1e3 }"):format(s, a, b))
  put(("%s:wire_contact{ friction = 0.3 }"):format(s))
  run(put, s, r)
  put(("%s:force(%d)"):format(j, r.whole(1, 2)))
  put(("%s:moment(%d)"):format(j, r.whole(1, 2)))
end

local function trough(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r, { z = "0.008" })
  local c = put(("%s:channel{ points = { { -0.1, 0, 0 }, { 0.2, 0, 0 }, { 0.4, 0, %s } }, width = 0.02, "
    .. "depth = 0.02, lid = %s }"):format(s, r.of{ "0", "0", "-0.02" }, r.of{ "true", "false" }))
  run(put, s, r)
  put(("%s:contains(%s)"):format(c, w))
  put(c .. ":close()")
  put(c .. ":open()")
end

local function meshed(put, r)
  local s = put "sw.scene{}"
  local w = put(("%s:wire{ model = '%s', E = 1e7, density = 1000, radius = 0.012, from = { 0, 0, 0.05 }, "
    .. "to = { 0.15, 0, 0.05 } }"):format(s, r.of{ "tube", "radial", "cubic" }))
  put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  put(("%s:obstacle{ shape = 'plane', friction = 0.3 }"):format(s))
  put(("%s:run{ duration = 0.02, max_steps = 4 }"):format(s))
  local section = put(w .. ":section(0.05)")
  put(section .. ":width({ 0, 0, 1 })")
  put(section .. ":chart{ path = dir .. '/section.svg' }")
  put(w .. ":calibration()")
  put(w .. ":contact_pressure()")
end

local function remodelled(put, r)
  local s = put "sw.scene{}"
  local w = put(("%s:wire{ E = 1e7, density = 1000, radius = 0.01, segments = 12, from = "
    .. "{ 0, 0, 0.05 }, to = { 0.2, 0, 0.05 } }"):format(s))
  put(("%s:%s(%s, { s = 0.1 })"):format(s, r.of{ "clamp", "pin", "grip" }, w))
  put(("%s:run{ duration = 0.02, max_steps = 4 }"):format(s))
  put(("%s:remodel{ model = '%s' }"):format(w, r.of{ "tube", "radial", "string", "rod" }))
  put(("%s:run{ duration = 0.02, max_steps = 3 }"):format(s))
  put(("%s:remodel{ model = 'rod' }"):format(w))
end

local function web(put, r)
  local s = put "sw.scene{}"
  local p = put(("%s:particles{ positions = { 0, 0, 1, 0.1, 0, 1, 0.2, 0, 1, 0.3, 0.1, 1, 0.1, 0.2, 1 }, "
    .. "masses = 0.01, radius = 0.01, links = { { pairs = { 1, 2, 2, 3, 3, 4, 4, 5 }, k = %s } }, "
    .. "folds = { { 1, 2, 3, stiffness = 0.01 } } }"):format(s, r.size(0, 3)))
  put(("%s:hold(%s, { particles = { 1, %d } })"):format(s, p, r.whole(2, 5)))
  put(("%s:force{ kind = 'drag', on = %s, linear = 0.1 }"):format(s, p))
  put(("%s:force{ kind = 'damping', on = %s, mass = 5 }"):format(s, p))
  put(("%s:obstacle{ shape = 'sphere', radius = 0.05, at = { 0.2, 0, 0.9 } }"):format(s))
  run(put, s, r)
  put(("%s:set_velocity({ 0, 0, 1 })"):format(p))
  put(("%s:particle(%d)"):format(p, r.whole(1, 5)))
end

local function moving(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r)
  local c = put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  local o = put(("%s:obstacle{ shape = 'box', size = { 0.05, 0.1, 0.02 }, at = { 0.15, 0, 0.05 }, friction "
    .. "= 0.4 }"):format(s))
  local t = put(("sw.trajectory.new{ points = { { 0, 0, 0 }, { 0.02, 0, 0.02 }, { 0.04, 0.01, 0 } }, "
    .. "relative = true, speed = %s, law = '%s' }"):format(r.size(-1, 0), r.of{ "linear", "trapezoidal",
      "minimum-jerk" }))
  put(("%s:follow(%s)"):format(c, t))
  put(("%s:follow(%s)"):format(o, r.of{ "{ points = { { 0, 0, 0 }, { 0, 0, 0.06 } }, relative = true, speed "
    .. "= 0.3 }", "{ func = F.way, duration = 0.1, relative = true }", "{ func = " .. words.callback(r)
      .. ", duration = 0.1, relative = true }" }))
  put(("%s:force{ kind = %s, on = %s }"):format(s, r.of{ "F.number", "F.number", words.callback(r) }, w))
  run(put, s, r, r.of{ "", ", tolerance = 1e-4", ", integrator = 'bdf2'" })
  for _, name in ipairs{ "position", "velocity", "acceleration", "rotation", "angular_velocity",
    "angular_acceleration", "delayed" } do
    if r.chance(0.4) then put(("%s:%s(%s)"):format(t, name, r.size(-3, 0))) end
  end
  put(t .. ":sample(" .. r.whole(2, 9) .. ")")
  put(t .. ":save(dir .. '/way.csv')")
  put "sw.trajectory.read(dir .. '/way.csv')"
end

local function saving(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r)
  put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  local g = put(s .. ":gripper{ name = 'hand' }")
  process(put, s, ("p:step('a', function() %s:grasp(%s, { s = 0.1 }) p:wait(0.02) return 1 end)")
      :format(g, w),
    ("p:step('b', function() %s:move{ by = { 0, 0, 0.01 }, speed = 0.5 } end)"):format(g),
    ("p:step('c', function() %s:release() end)"):format(g))
  put(("%s:run{ save = dir .. '/a.sws', max_steps = %d }"):format(s, r.whole(1, 150)))
  put(("%s:save(dir .. '/b.sws')"):format(s))
  local loaded = put "sw.load(dir .. '/a.sws')"
  put(loaded .. ":names()")
  put(("%s:find('%s')"):format(loaded, r.of{ "wire1", "hand", "clamp1" }))
  local snapshot = put(s .. ":snapshot()")
  run(put, s, r)
  put(("%s:restore(%s)"):format(s, snapshot))
end

local function resting(put, r)
  local s = put "sw.scene{}"
  local w = wire(put, s, r, { z = "0.02" })
  put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  put(("%s:obstacle{ shape = 'cylinder', radius = 0.02, length = 0.1, at = { 0.2, 0, -0.05 }, rotation = "
    .. "{ axis = { 1, 0, 0 }, angle = 1.57 } }"):format(s))
  put(("%s:settle{ max_iterations = 60%s }"):format(s, r.of{ "", "",
    ", tolerance = { tip = 1e-3 }, levels = 3" }))
  put(w .. ":frequencies{ modes = 2 }")
  put(("%s:run{ duration = 0.05, quasistatic = true, max_steps = %d }"):format(s, r.whole(1, 5)))
  local result = put(("%s:run{ duration = 0.02, tolerance = { ['tip'] = 1e-2 }, levels = 3 }"):format(s))
  put(result .. ":error_bars()")
  put(("%s:advise{ tolerance = %s, duration = 1 }"):format(s, r.of{ "0.1", "1e-9", "1" }))
  result = put(("%s:run{ duration = 0.02, model = 'auto', tolerance = { tip = { relative = %s } }, levels "
    .. "= 3 }")
    :format(s, r.of{ "0.5", "1e-3", "1e-12" }))
  put(result .. ":why()")
end

local function written(put, r)
  local s = put "sw.scene{}"
  local w = put(("%s:wire{ cable = '%s', from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 }, segments = 10 }")
    :format(s, r.of{ "GXL 1.5", "H07V-K 1.5", "FLRY-B 0.5" }))
  put(("%s:clamp(%s, { s = 0 })"):format(s, w))
  local result = put(("%s:run{ duration = 0.1, dt = 5e-3, max_steps = 30, frame = 0.02 }"):format(s))
  put(result .. ":save(dir .. '/a.csv')")
  put(result .. ":save(dir .. '/a.json')")
  put(result .. ":vtk(dir .. '/a.pvd')")
  if r.chance(0.1) then put(result .. ":chart{ path = dir .. '/a.svg' }") end
  put(result .. ":series()")
  put(result .. ":ledger()")
  put(s .. ":events()")
  put(result .. ":document()")
  put(result .. ":summary()")
end

local function shapes(put, r)
  local kind = r.of(samples.registry.shapes)
  local s = put(("core.shape{ shape = '%s', %s }"):format(kind.name, kind.sample))
  local function v() return words.vector(r, 0.3) end
  put(("%s:distance(%s)"):format(s, v()))
  put(("%s:distance(%s, 0.5)"):format(s, v()))
  put(("%s:segment(%s, %s, 0.5)"):format(s, v(), v()))
  put(("%s:sweep(%s, %s, %s, %s, 0.01)"):format(s, v(), v(), v(), v()))
  for _, name in ipairs{ "bounds", "triangles", "kind", "close" } do put(("%s:%s()"):format(s, name)) end
end

scenes.list = { handling, handling, handling, handling, mixed, clipping, feeding, feeding, tying, trough,
  meshed, remodelled, web, moving, moving, saving, resting, written, shapes }

return scenes
