-- SPDX-License-Identifier: GPL-3.0-or-later
-- Sliders together with other features, and where they are refused.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local beads = require "spec.link.beads"

local bead, circle = beads.bead, beads.circle
local G = 9.81

-- Checks that call raises an error with all these words.
local function refuses(call, ...)
  local fine, message = pcall(call)
  assert.is_false(fine)
  for _, word in ipairs{ ... } do
    assert(message:find(word, 1, true), ("'%s' is not in: %s"):format(word, message))
  end
end

describe("a slider with other features", function()
  local function swing(o)
    local scene = sw.scene{ gravity = { 0, 0, -G } }
    local args = { E = 5e6, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 0.6, 0, 0 },
      segments = 30 }
    for k, v in pairs(o.wire or {}) do args[k] = v end
    local wire = scene:wire(args)
    scene:clamp(wire, { s = 0 })
    if o.twist then
      scene:clamp(wire, { s = 0.6 }):follow{ turn = { axis = { 1, 0, 0 }, angle = o.twist },
        points = { { 0, 0, 0 }, { -0.1, 0.05, 0 } }, relative = true, duration = 0.2 }
    end
    local slider = scene:slider(wire, { s = 0.3, direction = { 1, 0, -0.2 } })
    if o.more then o.more(scene, wire, slider) end
    local run = scene:run{ duration = 0.25, dt = 2e-3 }
    assert.is_true(run.ok, run.reason)
    return wire:position(0.3), slider:force(), run, slider, wire
  end

  local function on_rail(p) t.near(0, 0.2 * (p[1] - 0.3) + p[3], 1e-12, "off the rail") end

  -- Frames change nothing for a straight wire of one stiffness, although the matrix is another one.
  it("acts the same with frames", function()
    local p, f = swing{}
    local q, g = swing{ wire = { rolls = true } }
    on_rail(p)
    on_rail(q)
    for k = 1, 3 do
      t.near(p[k], q[k], 1e-6)
      t.near(f[k], g[k], 1e-3)
    end
  end)

  -- The slider lets the wire turn: a twist of 3 rad is on both sides of it.
  it("lets twist pass, with and without frames", function()
    local p, _, run, _, wire = swing{ twist = 3 }
    on_rail(p)
    t.below(2e-2, run:ledger().gap / run:ledger().play, "gap, as without a slider")
    t.near(wire:twist_moment(0.15), wire:twist_moment(0.45), 1e-3 * math.abs(wire:twist_moment(0.15)) + 1e-12)
    local q = swing{ twist = 3, wire = { rolls = true } }
    on_rail(q)
  end)

  it("works with joins, and with contact of wires and of obstacles", function()
    for _, rolls in ipairs{ false, true } do
      local p, _, run = swing{ wire = { rolls = rolls }, more = function(scene, wire)
        local branch = scene:wire{ E = 5e6, density = 1200, radius = 0.003, from = { 0.2, 0, 0 },
          to = { 0.2, 0.3, 0 }, segments = 15 }
        scene:join{ ends = { { wire, s = 0.2 }, { branch, s = 0 } } }
        scene:obstacle{ shape = "box", size = { 1, 1, 0.02 }, at = { 0.3, 0, -0.08 }, friction = 0.2 }
        local other = scene:wire{ E = 5e6, density = 1200, radius = 0.003, from = { 0.45, -0.2, 0.01 },
          to = { 0.45, 0.2, 0.01 }, segments = 15 }
        scene:wire_contact{ between = { wire, other }, friction = 0.2 }
      end }
      on_rail(p)
      t.below(1e-2, run:ledger().gap / run:ledger().play, "gap")
    end
  end)

  it("is saved, restored and goes on with the same bits", function()
    local scene, wire, slider = bead{ direction = { 1, 0, -1 }, friction = 0.2, to = 0.3 }
    scene:run{ duration = 0.1, dt = 0.005 }
    local snapshot = scene:snapshot()
    local path = os.tmpname()
    scene:save(path)
    local function on(s, w, l)
      s:run{ duration = 0.2, dt = 0.005 }
      local p, place, speed, force = w:position(0.05), l:place()
      return { p[1], p[2], p[3], place, speed, force }
    end
    local first = on(scene, wire, slider)
    scene:restore(snapshot)
    assert.are.same(first, on(scene, wire, slider))
    local other = sw.load(path)
    os.remove(path)
    assert.are.same(first, on(other, other:find "wire1", other:find "slider1"))
  end)

  it("keeps its place and speed when the scene is edited", function()
    local scene, wire, slider = bead{ direction = { 1, 0, -1 } }
    scene:run{ duration = 0.1, dt = 0.005 }
    local place, speed = slider:place()
    scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0, 0, -50 } }
    scene:run{ duration = 0.1, dt = 0.005 }
    local a = G / math.sqrt(2)
    local later, faster = slider:place()
    t.near(place + 0.1 * speed + 0.005 * a, later, 1e-9)
    t.near(speed + 0.1 * a, faster, 1e-9)
    assert.are.equal("slider", slider.kind)
    assert.is_true(#wire:position(0.05) == 3)
  end)

  it("is described, written as Lua and changed between steps", function()
    local scene, _, slider = bead{ direction = { 1, 0, -1 }, friction = 0.9 }
    local item = scene:describe().holds[1]
    assert.are.equal("slider", item.now.kind)
    assert.are.same({ 1, 0, -1 }, item.given.direction)
    local again = assert(load(scene:script()))()
    assert.are.equal(0.9, again:find("slider1"):get().friction)
    again:run{ duration = 0.1, dt = 0.01 }
    scene:run{ duration = 0.1, dt = 0.01 }
    assert.are.equal((slider:place()), (again:find("slider1"):place()))
    assert.are.equal(0.9, slider:get().friction)
    slider:set{ friction = 0 }
    scene:run{ duration = 0.1, dt = 0.01 }
    t.near(0.1 * G / math.sqrt(2), select(2, slider:place()), 0.15)
    refuses(function() slider:set{ friction = -1 } end, "friction")
    refuses(function() slider:set{ direction = { 1, 0, 0 } } end, "direction")
  end)
end)

describe("a slider is refused", function()
  local function refuses_args(args, ...)
    local scene = sw.scene{}
    local wire = scene:wire{ E = 1e9, density = 1000, radius = 0.002, from = { 0, 0, 0 },
      to = { 1, 0, 0 } }
    refuses(function() scene:slider(wire, args) end, ...)
    assert.are.equal(0, #sw.core.data(scene).holds)
  end

  it("without a rail, with two, or with an invalid one", function()
    refuses_args({ s = 0.5 }, "direction", "path")
    refuses_args({ s = 0.5, direction = { 0, 0, 0 } }, "direction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, path = circle(1, 8) },
      "give either direction or path, not both")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, closed = true }, "closed goes with path")
    refuses_args({ s = 0.5, path = { { 0, 0, 0 }, { 1, 0, 0 } } }, "2 points")
    refuses_args({ s = 0.5, path = { { 0, 0, 0 }, { 0.5, 0, 0 }, { 0.5, 0, 0 } } },
      "away from the one before")
    refuses_args({ s = 0.5, path = circle(1, 16), closed = true }, "away from the path")
    refuses_args({ s = 0.5, path = "round" }, "path")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, frction = 1 }, "friction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, friction = -1 }, "friction")
    refuses_args({ s = 0.5, direction = { 1, 0, 0 }, to = -1 }, "to")
    refuses_args({ s = 2, direction = { 1, 0, 0 } }, "s = 2")
  end)

  it("on a mesh and at a held place; with it a wire cannot become a mesh", function()
    local scene = sw.scene{}
    local tube = scene:wire{ model = "tube", E = 1e6, density = 1000, radius = 0.01, from = { 0, 0, 0 },
      to = { 0.1, 0, 0 } }
    refuses(function() scene:slider(tube, { s = 0, direction = { 1, 0, 0 } }) end, "slider")
    local wire = scene:wire{ E = 1e6, density = 1000, radius = 0.01, from = { 0, 1, 0 }, to = { 0.3, 1, 0 } }
    local slider = scene:slider(wire, { s = 0.1, direction = { 1, 0, 0 } })
    refuses(function() scene:slider(wire, { s = 0.1, direction = { 0, 0, 1 } }) end, "slider")
    refuses(function() scene:clamp(wire, { s = 0.1 }) end, "slider1")
    refuses(function() wire:remodel{ model = "radial" } end, "slides along", "slider1")
    refuses(function() wire:frequencies{ modes = 2 } end, "slides along")
    refuses(function() slider:fed() end, "has no fed; holds of scene:feed have it")
    local clamp = scene:clamp(wire, { s = 0.3 })
    refuses(function() clamp:place() end, "has no place; holds of scene:slider have it")
    slider:release()
    refuses(function() slider:place() end, "released")
  end)

  it("by integrators that cannot have it", function()
    local scene = bead{ direction = { 1, 0, 0 } }
    refuses(function() scene:run{ duration = 0.1, integrator = "velocity-verlet" } end, "slider1")
    scene = bead{ direction = { 1, 0, 0 }, friction = 0.1 }
    refuses(function() scene:run{ duration = 0.1, integrator = "implicit-midpoint" } end, "slider1")
  end)
end)
