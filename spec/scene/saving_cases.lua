-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scenes of all kinds that specs save and read again: { name, build(scene), before, after }, with what is
-- done before and after saving.
local sw = require "softworld"
local samples = require "contract.samples"

local L, R = 0.4, 0.003
local function wire(scene, more)
  local p = { name = "a", E = 1e8, nu = 0.3, density = 1200, radius = R, from = { 0, 0, R },
    to = { L, 0, R } }
  if not more or not more.model then p.segments = 20 end
  for k, v in pairs(more or {}) do p[k] = v end
  if p.path then p.from, p.to = nil, nil end
  return scene:wire(p)
end

local function run(duration, more)
  return function(scene)
    local args = { duration = duration, dt = 0.004, frame = 0.02 }
    for k, v in pairs(more or {}) do args[k] = v or nil end
    local r = scene:run(args)
    assert(r.ok, r.reason)
  end
end

local function plane(scene, friction)
  return scene:obstacle{ name = "table", shape = "plane", friction = friction or 0.4 }
end

local function lift(scene, more)
  local hold = scene:clamp(scene:find "a", { name = "tool", s = 0.02 })
  local move = { points = { { 0, 0, 0 }, { 0.03, 0.02, 0.05 } }, duration = 0.12, relative = true }
  for k, v in pairs(more or {}) do move[k] = v end
  hold:follow(move)
end

-- name, build(scene), before, after: what is done before and after saving
local cases = {}
local function case(name, build, before, after)
  cases[#cases + 1] = { name = name, before = before or run(0.06),
    after = after or run(0.06), build = function()
      local scene = sw.scene{ name = "saved" }
      build(scene)
      return scene
    end }
end

case("a rod in contact with friction, lifted", function(s) plane(s) wire(s) lift(s) end)
case("a string", function(s) plane(s) wire(s, { model = "string" }) lift(s) end)
case("a scene that nothing was done with", function(s) plane(s) wire(s) lift(s) end, function() end)
case("a settled scene", function(s) wire(s) s:clamp(s:find "a", { s = 0 }) end,
  function(s) assert(s:settle().ok) end)

for _, model in ipairs{ { model = "tube" }, { model = "tube", core = false }, { model = "radial" },
  { model = "radial", body = "solid" }, { model = "composite", core = "line" },
  { model = "composite", core = "line", bonded = false, friction = 0.3 }, { model = "cubic" } } do
  local words = {}
  for k, v in pairs(model) do words[#words + 1] = k .. " = " .. tostring(v) end
  table.sort(words)
  case("a mesh, " .. table.concat(words, ", "), function(s)
    plane(s)
    local p = { radius = 0.01, to = { 0.2, 0, 0.01 }, from = { 0, 0, 0.01 }, E = 1e7 }
    for k, v in pairs(model) do p[k] = v end
    local w = wire(s, p)
    s:obstacle{ name = "ball", shape = "sphere", radius = 0.02, at = { 0.15, 0, 0.041 } }
    s:clamp(w, { s = 0, name = "end" })
  end, run(0.02), run(0.02))
end

case("a tube whose springs yield", function(s)
  local w = wire(s, { model = "tube", radius = 0.01, to = { 0.2, 0, 0.003 }, E = 1e6 })
  s:force{ kind = "plastic_springs", on = w, yield = 0.01, hardening = 0.1 }
  s:clamp(w, { s = 0 })
end)
case("plastic bending, released just before", function(s)
  local w = wire(s)
  s:force{ kind = "plastic", on = w, yield_moment = 2e-4, hardening = 1e-3 }
  s:clamp(w, { s = 0, name = "root" })
  s:clamp(w, { s = 0.2, name = "middle" })
end, function(s)
  run(0.08)(s)
  s:find "middle":release() -- the scene is edited, and saved before it is built again
end)
case("stick-slip bending and drag", function(s)
  local w = wire(s)
  s:force{ kind = "stick_slip", on = w, EI_stick = 0.02, friction_moment = 2e-4 }
  s:force{ kind = "drag", on = w }
  s:force{ kind = "point", on = w, s = 0.3, force = { 0, 0.01, 0 } }
  s:clamp(w, { s = 0 })
end)
local pushes = setmetatable({}, { __mode = "k" })
case("a removed force, an added clamp, other gravity", function(s)
  plane(s)
  wire(s)
  s:clamp(s:find "a", { s = 0, name = "root" })
  pushes[s] = s:force{ kind = "line", on = s:find "a", force = { 0, 0.05, 0 } }
end, function(s)
  run(0.04)(s)
  pushes[s]:release()
  s:gravity{ 0, 1, -5 }
  s:clamp(s:find "a", { s = 0.137, name = "later" }) -- moves a node in contact
end)
case("a twisted wire with frames, that rolls", function(s)
  plane(s)
  local w = wire(s, { rolls = true })
  s:clamp(w, { s = L, name = "far" })
  s:clamp(w, { s = 0, name = "near" }):follow{ turn = { axis = { 1, 0, 0 }, angle = 2 },
    points = { { 0, 0, 0 }, { 0.01, 0, 0.02 } }, relative = true, duration = 0.1 }
end)
case("sliders on a line and on a curve, with friction", function(s)
  local w = wire(s)
  s:slider(w, { s = 0.02, direction = { 1, 0, -1 }, friction = 0.2, to = 0.05, name = "line" })
  local p, points = w:position(0.3), {}
  for i = 0, 23 do
    local a = i * math.pi / 12
    points[i + 1] = { p[1] + 0.1 * math.sin(a), p[2] + 0.05 * (1 - math.cos(a)), p[3] - 0.1 * math.sin(a) }
  end
  s:slider(w, { s = 0.3, path = points, closed = true, name = "ring" })
end)
case("a twisted wire without frames", function(s)
  local w = wire(s)
  s:clamp(w, { s = L, name = "far" })
  s:clamp(w, { s = 0, name = "near" }):follow{ turn = { axis = { 1, 0, 0 }, angle = 2 },
    points = { { 0, 0, 0 }, { 0.02, 0, 0 } }, relative = true, duration = 0.1 }
end)
case("natural curvature and two stiffnesses", function(s)
  local path = {}
  for i = 0, 20 do path[i + 1] = { 0.1 * math.sin(i / 10), 0.1 * math.cos(i / 10), 0.01 * i } end
  local w = wire(s, { path = path, rest = "path", rest_twist = 3,
    EI = { 0.001, 0.004 }, GJ = 0.002, normal = { 0, 0, 1 } })
  s:clamp(w, { s = 0 })
end)
case("a feed that pushes", function(s)
  plane(s, 0.2)
  local w = wire(s, { from = { 0, 0, 0.02 }, to = { L, 0, 0.02 } })
  s:feed(w, { name = "rolls", s = 0.2, speed = 0.5 })
end)
case("a feed that slips, of a wire with frames", function(s)
  local w = wire(s, { rest_twist = 2, normal = { 0, 0, 1 }, EI = { 0.001, 0.002 },
    GJ = 0.001 })
  s:feed(w, { name = "rolls", s = 0.1, force_limit = 0.05 })
  s:find "rolls":feed{ length = 0.05, duration = 0.1 }
end)
case("joined wires", function(s)
  plane(s)
  local a = wire(s)
  local b = wire(s, { name = "b", from = { L, 0, R }, to = { L, 0.3, 0.1 } })
  s:join{ name = "node", ends = { { a, s = L }, { b, s = 0 } }, rigid = true }
  lift(s)
end)
case("wires that touch each other", function(s)
  plane(s)
  wire(s)
  wire(s, { name = "b", from = { 0.2, -0.2, 0.012 }, to = { 0.2, 0.2, 0.012 } })
  s:wire_contact{ friction = 0.3 }
  lift(s)
end)
case("adaptive steps", function(s) plane(s) wire(s) lift(s) end,
  run(0.08, { dt = false, tolerance = 1e-5 }), run(0.08, { dt = false, tolerance = 1e-5 }))
for _, method in ipairs{ { "bdf2", 0.004 }, { "sdirk2", 0.004 }, { "velocity-verlet", 2e-5 } } do
  case("integrator " .. method[1], function(s) wire(s) lift(s, { duration = 0.05 }) end,
    run(0.02, { integrator = method[1], dt = method[2] }),
    run(0.02, { integrator = method[1], dt = method[2] }))
end
case("quasi-static steps", function(s) plane(s) wire(s) lift(s) end,
  run(0.06, { quasistatic = true, dt = 0.01 }), run(0.06, { quasistatic = true, dt = 0.01 }))
local function squeezed(s)
  s:run{ duration = 0.1, dt = 0.01, quasistatic = true }
end
case("jaws that obey a force in quasi-static steps", function(s)
  plane(s)
  local hand = s:gripper{ name = "hand", pads = { opening = 0.012 } }
  hand:grasp(wire(s), { s = 0.1, approach = "plates", force = 0.5, speed = 0.05 })
end, squeezed, squeezed)
case("a remodelled wire", function(s)
  wire(s, { radius = 0.006, E = 2e7, to = { 0.3, 0, 0.003 } })
  s:clamp(s:find "a", { s = 0 })
end, function(s)
  run(0.02)(s)
  s:find "a":remodel{ model = "tube", region = { 0.1, 0.16 } }
  run(0.01)(s)
end, run(0.02))
case("particles", function(s)
  plane(s)
  s:particles{ name = "cloth", positions = { 0, 0, 0.02, 0.05, 0, 0.02, 0, 0.05, 0.02, 0.05, 0.05, 0.02 },
    masses = 0.01, radius = 0.002, repel = { distance = 0.01, stiffness = 100 },
    links = { { 1, 2, k = 500, yield = 0.05, hardening = 0.1 }, { 2, 4, k = 500 }, { 4, 3, k = 500 },
      { 3, 1, k = 500 }, { 1, 4, k = 200 } } }
  s:hold(s:find "cloth", { name = "corner", particles = { 1 } })
  s:force{ kind = "push", on = s:find "cloth", particles = { 4, 2 }, force = { 0.3, 0, 0 } }
end)

local cube = "OFF\n8 12 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n"
  .. "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n"
  .. "3 3 0 4\n3 3 4 7\n"
case("obstacles of all shapes, on trajectories of all laws", function(s)
  wire(s, { from = { 0, 0, 0.05 }, to = { L, 0, 0.05 } })
  s:clamp(s:find "a", { s = 0 })
  local flat = { friction = 0.3, at = { 0.1, 0, 0.02 } }
  local function obstacle(shape, at, law, more)
    local p = { name = shape, shape = shape, at = at, friction = 0.2 }
    for k, v in pairs(more) do p[k] = v end
    s:obstacle(p):follow{ points = { { 0, 0, 0 }, { 0, 0, 0.01 }, { 0, 0, 0.03 } }, duration = 0.1,
      relative = true, law = law }
  end
  obstacle("box", { 0.1, 0, 0.02 }, "linear", { size = { 0.03, 0.1, 0.03 } })
  obstacle("cylinder", { 0.2, 0, 0.02 }, "trapezoidal", { radius = 0.01, length = 0.1 })
  obstacle("capsule", { 0.3, 0, 0.02 }, "minimum-jerk", { radius = 0.01, length = 0.1 })
  obstacle("hull", { 0.25, 0, 0.02 }, "spline",
    { points = { -0.02, -0.05, 0, 0.02, -0.05, 0, 0, 0.05, 0, 0, 0, 0.02 } })
  obstacle("mesh", { 0.38, 0, 0.02 }, "spline", { data = cube, format = "off", scale = 0.01 })
  flat.name, flat.shape = "sphere", "sphere"
  flat.radius = 0.01
  s:obstacle(flat)
end)
for _, kind in ipairs(samples.registry.shapes) do
  case("a wire lifted by a " .. kind.name, function(s)
    wire(s, { from = { 0, 0, 0.05 }, to = { L, 0, 0.05 } })
    s:clamp(s:find "a", { s = 0 })
    local args = samples.obstacle(kind)
    local _, high = sw.core.shape(args):bounds()
    args.at, args.friction = { L / 2, 0, 0.02 - (kind.flat and 0 or high[3]) }, 0.2
    s:obstacle(args):follow{ points = { { 0, 0, 0 }, { 0, 0, 0.03 } }, duration = 0.1, relative = true }
  end)
end
case("a clip and a tie", function(s)
  local a = wire(s, { from = { 0, 0, 0.01 }, to = { L, 0, 0.01 } })
  local b = wire(s, { name = "b", from = { 0, 0.004, 0.01 }, to = { L, 0.004, 0.01 } })
  s:clip{ name = "snap", at = { 0.2, 0, 0.006 }, axis = { 1, 0, 0 }, width = 0.006, insertion = 0.2,
    retention = 1, friction = 0.3, on = a }
  s:join{ name = "bundle", ends = { { a, s = 0.3 }, { b, s = 0.3 } }, slack = 0.001, stiffness = 1e3 }
  s:clamp(a, { s = 0 })
end)
case("a function of time that is over", function(s)
  wire(s)
  s:clamp(s:find "a", { s = 0, name = "root" }):follow{ duration = 0.03, step = 1e-4,
    func = function(time) return { 0.1 * time, 0, R } end }
end)

return cases
