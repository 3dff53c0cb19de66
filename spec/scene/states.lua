-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scenes for the spec of tapes beyond those of saved scenes: every force, every clamp, grippers in every
-- state, moments in mid-blow.
local sw = require "softworld"
local samples = require "contract.samples"

local states = { cases = {} }

local R = 0.003
local function case(name, build, before, after, more)
  local made = more or {}
  made.name, made.before, made.after = name, before, after
  function made.build()
    local scene = sw.scene{ name = "states" }
    build(scene)
    return scene
  end
  states.cases[#states.cases + 1] = made
end

local function run(duration, more)
  return function(scene)
    local args = { duration = duration, dt = 0.004, frame = 0.02 }
    for key, value in pairs(more or {}) do args[key] = value end
    local r = scene:run(args)
    assert(r.ok, r.reason)
  end
end

local function rod(scene, more)
  local p = { name = "a", E = 1e8, nu = 0.3, density = 1200, radius = R, from = { 0, 0, R },
    to = { 0.4, 0, R }, segments = 20 }
  for key, value in pairs(more or {}) do p[key] = value end
  return scene:wire(p)
end

-- Forces that act on particles get some particles of an object, all others get a wire.
for index, force in ipairs(samples.registry.forces) do
  if not force.inner and force.name ~= "callback" then
    case("the force " .. force.name, function(s)
      local args = samples.force(force, index)
      args.on = force.of_web and samples.sheet(s) or rod(s, { E = 2e8, radius = 0.005, from = { 0, 0, 0 },
        to = { 1, 0, 0 } })
      if force.of_web then
        s:hold(args.on, { particles = { 1 } })
      else
        s:clamp(args.on, { s = 0 })
      end
      s:force(args)
    end, run(0.008, { dt = 0.0005 }), run(0.008, { dt = 0.0005 }))
  end
end

case("what wears a wire, and zones", function(s)
  s:zone{ name = "cold", shape = "box", size = { 0.1, 0.1, 0.01 }, at = { 0.2, 0, 0.02 }, temperature = -20 }
  s:zone{ shape = "sphere", radius = 0.02, at = { 0.1, 0.05, 0 } }
  s:obstacle{ shape = "plane", friction = 0.3 }
  local w = rod(s)
  s:clamp(w, { s = 0 })
  s:clamp(w, { s = 0.4 }):follow{ points = { { 0, 0, 0 }, { -0.02, 0, 0.01 }, { 0, 0, 0 } }, relative = true,
    duration = 0.1 }
end, run(0.08, { wear = true }), run(0.02, { wear = true }))

case("what wears a mesh of which parts are lines", function(s)
  s:obstacle{ shape = "plane", friction = 0.3 }
  local w = rod(s)
  s:clamp(w, { s = 0 })
  s:clamp(w, { s = 0.4 }):follow{ points = { { 0, 0, 0 }, { -0.01, 0, 0.01 }, { 0, 0, 0 } }, relative = true,
    duration = 0.06 }
  w:remodel{ model = "tube", region = { 0.19, 0.22 } }
end, run(0.04, { wear = true }), run(0.02, { wear = true }))

case("a force that is a function", function(s)
  local w = rod(s)
  s:clamp(w, { s = 0 })
  s:force{ kind = function(_, x, _, f)
    for i = 3, #x, 3 do f[i] = f[i] - x[i] end
  end, on = w }
end, run(0.04), run(0.04), { functions = true })

for _, kind in ipairs{ "clamp", "pin", "grip" } do
  case("a " .. kind .. " under way", function(s)
    local hold = s[kind](s, rod(s), { name = "hold", s = 0.1, width = kind == "grip" and 0.05 or nil })
    hold:follow{ points = { { 0, 0, 0 }, { 0, 0.02, 0.05 } }, duration = 0.1, relative = true }
  end, run(0.05), run(0.1))
end

case("a clamp that was let go", function(s)
  s:clamp(rod(s), { name = "hold", s = 0.1 })
end, function(s)
  run(0.04)(s)
  s:find "hold":release()
  run(0.04)(s)
end, run(0.05))

case("a wire drawn without the twist that it has unloaded", function(s)
  local w = rod(s, { rest_twist = 20, EI = { 0.001, 0.002 }, GJ = 0.001, normal = { 0, 0, 1 } })
  s:clamp(w, { s = 0 })
  s:clamp(w, { s = 0.4 })
end, function() end, run(0.02, { dt = 0.001 }))

-- --- what happens on the way -------------------------------------------------------------

case("in the middle of a blow", function(s)
  s:obstacle{ name = "table", shape = "plane", friction = 0.3, restitution = 0.5 }
  local w = rod(s, { from = { 0, 0, 0.0102 }, to = { 0.4, 0, 0.0142 } })
  w:set_velocity{ 0, 0, -1 }
end, run(0.009, { dt = 0.0005 }), run(0.02, { dt = 0.0005 }))

case("ties that break one after the other", function(s)
  local a = rod(s, { from = { 0, 0, 0.1 }, to = { 0.4, 0, 0.1 } })
  local b = rod(s, { name = "b", from = { 0, 0.01, 0.1 }, to = { 0.4, 0.01, 0.1 } })
  for i, at in ipairs{ 0.1, 0.2, 0.3 } do
    s:join{ name = "tie" .. i, ends = { { a, s = at }, { b, s = at } }, slack = 0.011, stiffness = 1e3,
      strength = 0.02 * i }
  end
  s:clamp(a, { s = 0 })
  s:clamp(b, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0, 0.02, -0.03 } }, duration = 0.2,
    relative = true }
end, run(0.1, { dt = 0.002 }), run(0.15, { dt = 0.002 }))

case("wires that stick and slip on each other and an obstacle", function(s)
  s:obstacle{ name = "table", shape = "plane", friction = 0.5, kinetic_friction = 0.3 }
  local a = rod(s)
  rod(s, { name = "b", from = { 0.2, -0.15, 0.0091 }, to = { 0.2, 0.15, 0.0091 } })
  s:wire_contact{ friction = 0.4 }
  s:clamp(a, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0.03, 0, 0 } }, duration = 0.1,
    relative = true }
end, run(0.06, { dt = 0.002 }), run(0.06, { dt = 0.002 }))

-- --- what is taken away ------------------------------------------------------------------

-- Three wires that lie across each other on a table, one of them joined, tied, held, pulled and damped.
local function pile(s)
  s:obstacle{ name = "table", shape = "plane", friction = 0.5 }
  local a = rod(s)
  local b = rod(s, { name = "b", from = { 0.2, -0.15, 0.0091 }, to = { 0.2, 0.15, 0.0091 } })
  local c = rod(s, { name = "c", from = { 0.1, -0.15, 0.0091 }, to = { 0.1, 0.15, 0.0091 } })
  samples.sheet(s)
  s:wire_contact{ between = { a, b, c }, friction = 0.4 }
  s:wire_contact{ between = b, friction = 0.2 }
  s:clamp(a, { name = "hold", s = 0 }):follow{ points = { { 0, 0, 0 }, { 0.03, 0, 0 } }, duration = 0.1,
    relative = true }
  s:pin(b, { name = "pin", s = 0.15 })
  s:tie(b, { name = "tie", s = 0, to = { c, s = 0 } })
  s:force{ kind = "plastic", on = c, yield_moment = 1e-3 }
  s:force{ kind = "point", on = b, s = 0.1, force = { 0, 0, 0.1 } }
end

local settled = run(0.02, { dt = 0.002 })
case("a wire taken away from others that it touches", pile, function(s)
  settled(s)
  s:remove "b"
end, settled)
case("wires taken away, with steps in between", pile, function(s)
  settled(s)
  s:remove "a"
  settled(s)
  s:remove "c"
  rod(s, { name = "d", from = { 0, 0.05, 0.0151 }, to = { 0.4, 0.05, 0.0151 } })
  settled(s)
end, function(s)
  s:remove "d"
  settled(s)
end)

case("an object that lies on a wire when one made before it leaves", function(s)
  s:obstacle{ name = "table", shape = "plane", friction = 0.5 }
  rod(s, { from = { 0, 0.2, R }, to = { 0.4, 0.2, R } })
  rod(s, { name = "b" })
  s:particles{ name = "net", radius = 0.002, masses = 0.01, links = { { pairs = { 1, 2, 2, 3 }, k = 100 } },
    positions = { 0.2, -0.03, 0.0079, 0.2, 0, 0.0079, 0.2, 0.03, 0.0079 } }
  s:wire_contact{ friction = 0.3 }
end, function(s)
  settled(s)
  s:remove "a"
  s:snapshot() -- builds the system: touches are remembered by other numbers of bodies
  assert(#s:touches() > 0)
end, settled)

-- --- grippers ---------------------------------------------------------------------------

local function table_and_wire(s, without)
  s:obstacle{ name = "table", shape = "plane", friction = 0 }
  local wire = rod(s, { E = 2e7, nu = 0.4, to = { 0.24, 0, R }, segments = 24 })
  s:force{ kind = "damping", mass = 8 }
  s:gripper{ name = "hand", pads = not without and { width = 0.02, friction = 0.7, opening = 3 * R } or nil }
  return wire
end

local function process(work, more)
  return function(s)
    s:process(function(p) work(s:find "hand", s:find "a", p) end)
    local args = { dt = 0.01, frame = 0.1 }
    for key, value in pairs(more or {}) do args[key] = value end
    local r = s:run(args)
    assert(r.ok, r.reason)
  end
end

local function grasp(approach)
  return process(function(g, wire)
    g:grasp(wire, { s = 0.12, approach = approach, force = approach ~= "imposed" and 20 or nil })
  end)
end
local lift = process(function(g, _, p)
  g:move{ by = { 0, 0, 0.03 }, duration = 0.2 }
  p:wait(0.05)
end)
local function lift_and_let_go(s)
  lift(s)
  process(function(g, _, p)
    g:release()
    p:wait(0.03)
  end)(s)
end

local function no_pads(s) return table_and_wire(s, true) end
case("an open gripper", table_and_wire, run(0.02), grasp "plates")
for approach, make in pairs{ imposed = no_pads, plates = table_and_wire, mixed = table_and_wire } do
  case("a gripper that holds, " .. approach, make, grasp(approach), lift_and_let_go)
  case("a gripper that moves, " .. approach, make, function(s)
    grasp(approach)(s)
    s:find "hand":move{ by = { 0, 0, 0.03 }, duration = 0.2 }
    run(0.1, { dt = 0.01 })(s)
  end, run(0.15, { dt = 0.01 }))
  case("a gripper that has let go, " .. approach, make, function(s)
    grasp(approach)(s)
    lift_and_let_go(s)
  end, grasp(approach))
end

case("a gripper taken away that holds", table_and_wire, function(s)
  grasp "plates"(s)
  s:remove "hand"
end, run(0.03, { dt = 0.01 }))
case("a wire taken away from a gripper that froze it", function(s)
  table_and_wire(s)
  rod(s, { name = "b", from = { 0, 0.1, R }, to = { 0.4, 0.1, R } })
end, function(s)
  grasp "mixed"(s)
  s:remove "a"
end, run(0.03, { dt = 0.01 }))
case("a gripper that thaws after another wire has left", function(s)
  rod(s, { name = "b", from = { 0, 0.1, R }, to = { 0.4, 0.1, R } })
  table_and_wire(s)
end, function(s)
  grasp "mixed"(s)
  s:remove "b"
end, process(function(g, _, p)
  g:thaw()
  p:wait(0.05)
end))

case("a gripper that thaws what it froze", table_and_wire, function(s)
  grasp "mixed"(s)
  lift(s)
end, process(function(g, _, p)
  g:thaw()
  p:wait(0.05)
end))

return states
