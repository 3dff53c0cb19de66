-- SPDX-License-Identifier: GPL-3.0-or-later
-- A flat wall strikes a weightless wire along its whole length and carries it along. After that nothing
-- presses, and forces of touches are rounding.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local L, FROM = 0.3, 0.04 -- length of the wire, distance of the wall from it [m]

local function carried(name, angle, dt, speed, integrator)
  local cable = scenes.cable(name)
  local c, sn = math.cos(angle), math.sin(angle)
  local function turned(x, y) return { c * x - sn * y, sn * x + c * y, 0 } end
  local s = core.scene{ gravity = { 0, 0, 0 } }
  local w = s:wire{ EA = cable.EA, EI = cable.EI, mass_per_length = cable.mass_per_length,
    radius = cable.radius, from = { 0, 0, 0 }, to = turned(L, 0), segments = 30 }
  local wall = s:obstacle{ shape = "plane", friction = 0.2, at = turned(L / 2, -FROM),
    rotation = { axis = { c, sn, 0 }, angle = -math.pi / 2 } }
  wall:follow{ points = { { 0, 0, 0 }, turned(0, 2 * FROM) }, times = { 0, 2 * FROM / speed },
    relative = true, law = "linear" }
  local run = s:advance({ dt = dt, integrator = integrator }, 2 * FROM / speed)
  assert.is_true(run.ok, run.reason)
  local place, v = w:position(L / 3), w:velocity(L / 3)
  return -sn * place[1] + c * place[2] - cable.radius - FROM, -sn * v[1] + c * v[2]
end

describe("a weightless wire that a wall carries along", function()
  for _, name in ipairs{ "GXL 1.5", "FLRY-B 10", "identified white" } do
    it("lies on the wall and has its speed in a scene turned by any angle: " .. name, function()
      for _, angle in ipairs{ 0, 0.1, 0.3, 0.9, 2.3, 3 } do
        for _, dt in ipairs{ 0.01, 0.001 } do
          for _, speed in ipairs{ 1, 2, 5 } do
            local off, v = carried(name, angle, dt, speed, angle == 0.9 and "sdirk2" or nil)
            assert.near(0, off, 1e-8)
            assert.near(speed, v, 1e-6)
          end
        end
      end
    end)
  end
end)
