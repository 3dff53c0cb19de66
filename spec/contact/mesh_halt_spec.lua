-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mesh of springs slides on a table, and its hold slows down evenly, at a, until it rests. The hold pulls
-- with friction less m a, and so it does at rest, as a rod does (spec/contact/halt_spec). Only particles at
-- the bottom touch; with the inertia of these alone it pulled with 0.83 for 0.29 of mu m g, at any step.
local sw = require "softworld"
local t = require "physics.tools"

local LENGTH, TIME = 0.2, 0.3 -- [m], [s]

-- Returns the pull on the hold over mu m g as it slows down and at rest.
local function pulls(o, dt)
  local scene, r = sw.scene{}, sw.cable(o.cable).outer_diameter.value / 2
  local c, s = math.cos(o.turn), math.sin(o.turn)
  local far = { LENGTH * c, LENGTH * s, r }
  scene:obstacle{ shape = "plane", friction = o.mu }
  local wire = scene:wire{ model = o.model, cable = o.cable, from = o.swapped and far or { 0, 0, r },
    to = o.swapped and { 0, 0, r } or far, segments = o.segments }
  scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
  local hold = scene:clamp(wire, { s = o.swapped and LENGTH or 0 })
  scene:settle()
  hold:follow{ relative = true, duration = TIME, law = "trapezoidal",
    points = { { 0, 0, 0 }, { -o.way * c, -o.way * s, 0 } } }
  local function share()
    local f = hold:force()
    return -(c * f[1] + s * f[2]) / (o.mu * 9.81 * wire.beam.mass_per_length * LENGTH)
  end
  t.fine(scene:run{ dt = dt, duration = TIME - 0.02 })
  local before = share()
  t.fine(scene:run{ dt = dt, duration = 0.2 })
  local after = share()
  scene:close()
  return before, after
end

describe("a mesh that slides on a table and is slowed down evenly", function()
  for k, o in ipairs{ { model = "tube", cable = "FLRY-B 2.5", mu = 0.3, way = 0.04 },
    { model = "radial", cable = "GXL 1.5", mu = 0.4, way = 0.03 },
    { model = "tube", cable = "FLRY-B 10", mu = 0.25, way = 0.02 } } do
    it(("keeps friction less its inertia: %s, %s"):format(o.model, o.cable), function()
      o.turn, o.swapped = 0.7 * (k - 1), k == 2
      for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
        local before, after = pulls(o, dt)
        print(("measured: %g ms %.3f for %.3f"):format(1e3 * dt, after, before))
        -- The mesh between its hold and the first section that touches has an inertia too: 0.03.
        t.near(before, after, 0.05, ("%g ms: pull over mu m g"):format(1e3 * dt))
      end
    end)
  end

  -- Its sections still move by 1e-5 to 1e-3 m/s then: it kept 0.87 of mu m g at 20 ms and -0.35 at 2 ms.
  it("has an event if it has just landed", function()
    for _, height in ipairs{ 0, 0.01 } do
      local scene, r = sw.scene{}, sw.cable("FLRY-B 10").outer_diameter.value / 2
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local wire = scene:wire{ model = "tube", cable = "FLRY-B 10", from = { 0, 0, r },
        to = { -LENGTH, 0, r } }
      scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
      local hold = scene:clamp(wire, { s = 0 })
      if height == 0 then scene:settle() end
      hold:follow{ relative = true, duration = TIME, law = "trapezoidal",
        points = { { 0, 0, 0 }, { 0.02, 0, height }, { 0.04, 0, 0 } } }
      local told = 0
      for _, e in ipairs(t.fine(scene:run{ dt = 0.01, duration = 0.4 }).events) do
        if e.kind == "coarse" and e.text:find("forces at rest may be off", 1, true) then told = told + 1 end
      end
      scene:close()
      assert.equal(height > 0, told > 0)
    end
  end)
end)
