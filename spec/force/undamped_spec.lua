-- SPDX-License-Identifier: GPL-3.0-or-later
-- The `stiffness` of a damping damps edges and springs, but no solid elements: an event says so.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, L = 0.004, 0.12 -- [m]

-- A clamp swings a rubber wire; returns the events `undamped`.
local function swung(model, damping, o)
  o = o or {}
  local scene, c, s = sw.scene{}, math.cos(o.turn or 0), math.sin(o.turn or 0)
  local args = { name = "w", E = 5e6, density = 1200, radius = R, from = { 0, 0, 0 },
    to = { L * c, L * s, 0 } }
  for key, value in pairs(model) do args[key] = value end
  local wire = scene:wire(args)
  damping.kind = "damping"
  local force = scene:force(damping)
  scene:clamp(wire, { s = 0 }):follow{ relative = true, points = { { 0, 0, 0 }, { 0, 0, 0.02 } },
    duration = 0.1 }
  if o.set then force:set(o.set) end
  if o.become then wire:remodel(o.become) end
  local run = t.fine(scene:run{ duration = 0.05, dt = o.dt or 0.01, quasistatic = o.quasistatic })
  local told = {}
  for _, e in ipairs(run.events) do if e.kind == "undamped" then told[#told + 1] = e end end
  return told
end

local radial = { model = "radial", section = "solid" }
local cubic = { model = "cubic", section = "solid" }

describe("damping by stiffness", function()
  for name, model in pairs{ radial = radial, cubic = cubic } do
    for _, o in ipairs{ { dt = 0.01 }, { dt = 0.005, turn = 0.7 } } do
      it(("of solid elements is told: %s at %g ms"):format(name, 1e3 * o.dt), function()
        local told = swung(model, { stiffness = 2e-3 }, o)
        assert.equal(1, #told)
        assert.equal("w", told[1].object)
        assert.equal(2e-3, told[1].value)
        assert.truthy(told[1].text:find("0.002 s, does not damp solid elements: 'w'", 1, true), told[1].text)
      end)
    end
  end

  it("of a wire that becomes such a mesh, or is damped later, is told", function()
    assert.equal(1, #swung({}, { stiffness = 1e-3 }, { become = { model = "radial", body = "solid" } }))
    assert.equal(1, #swung(radial, { mass = 2 }, { set = { stiffness = 1e-3 } }))
  end)

  it("is not told where it damps, is not given, or nothing moves", function()
    for _, model in ipairs{ {}, { model = "string" }, { model = "tube" }, { model = "radial" } } do
      assert.equal(0, #swung(model, { stiffness = 1e-3 }))
    end
    assert.equal(0, #swung(radial, { mass = 5 }))
    assert.equal(0, #swung(radial, { mass = 5, stiffness = 1e-3 }, { set = { stiffness = 0 } }))
    assert.equal(0, #swung({ segments = 20 }, { stiffness = 1e-3 }, { quasistatic = true }))
  end)

  it("leaves peaks of the wire in doubt", function()
    for _, case in ipairs{ { radial, 2e-3, true }, { radial, 0, false }, { {}, 2e-3, false } } do
      local scene, args = sw.scene{}, { name = "w", E = 5e6, density = 1200, radius = R, from = { 0, 0, 0 },
        to = { L, 0, 0 } }
      for key, value in pairs(case[1]) do args[key] = value end
      local wire = scene:wire(args)
      scene:clamp(wire, { s = 0 })
      scene:force{ kind = "damping", mass = 5, stiffness = case[2] }
      local run = t.fine(scene:run{ duration = 0.03, dt = 0.01 })
      local row = run:check{ limits = { max_tension = { max = 100, sure = true } } }:row "w.max_tension"
      assert.equal(case[3], tostring(row.note):find("'undamped'", 1, true) ~= nil, row.note)
      if case[3] then assert.equal("OPEN", row.verdict) end
    end
  end)
end)
