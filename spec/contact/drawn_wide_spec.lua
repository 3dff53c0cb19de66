-- SPDX-License-Identifier: GPL-3.0-or-later
-- A mesh of elements drawn at the height of its radius over a table would begin in it by what its section is
-- wider over its corners: 2.7 % of the radius. Coming out by 5 mm/s took it 8 ms; pads that closed meanwhile
-- held it there, and what was left of the depth turned into force, up to the pads' friction: FLRY-B 2.5 in
-- pads of 3 N pushed its table with 1.4 to 2.97 N for 0.62 N of later pads; no event said so. Now it begins
-- where it only touches.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH = 0.06 -- [m]
-- Touches are ten sections stiff or more, see squeezed_mesh_spec: 1 - 1/(1 + 1/10)
local SHARE = 1 - 1 / 1.1

local function radius_of(o) return o.radius or sw.cable(o.cable).outer_diameter.value / 2 end

-- Returns the push on the table of a wire whose pads come at a time, without the wire's weight [N].
local function push(o, later, dt)
  local scene, turn, r = sw.scene{}, o.turn or 0, radius_of(o)
  local function table_now() scene:obstacle{ name = "table", shape = "plane", friction = 0.3 } end
  if not o.table_last then table_now() end
  scene:force{ kind = "damping", mass = 2 }
  local x, y = o.x or 0, o.y or 0
  local wire = scene:wire{ cable = o.cable, E = o.E, nu = o.E and 0.4, density = o.E and 1200, radius = r,
    model = o.model or "radial", section = "solid", segments = o.segments, from = { x, y, r },
    to = { x + LENGTH * math.cos(turn), y + LENGTH * math.sin(turn), r } }
  if o.table_last then table_now() end
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, opening = 2.06 * r + 1e-4 } }
  scene:process(function(p)
    if later > 0 then p:wait(later) end
    hand:grasp(wire, { s = o.s or LENGTH / 2, approach = "plates", force = o.force })
    p:wait(0.01)
  end)
  assert.equal(0, #t.fine(scene:run{ dt = dt }).events)
  local force = -hand:force()[3]
  scene:close()
  return force
end

describe("pads that come to a mesh of elements drawn at the height of its radius", function()
  for k, o in ipairs{
    { cable = "FLRY-B 2.5", force = 3 },
    { cable = "GXL 1.5", force = 2, turn = 0.7, s = 0.02, x = 0.3, y = -1.7 },
    { cable = "H07V-K 10", force = 8, turn = 2, table_last = true },
    { cable = "FLRY-B 2.5", force = 3, model = "cubic", turn = 3 },
    { E = 1e7, radius = 0.003, model = "cubic", segments = 10, force = 8, turn = 2 },
    { E = 5e6, radius = 0.004, segments = 10, force = 2, turn = 1, x = -0.2 },
  } do
    it(("push it as hard at any time: %d, %s"):format(k, o.cable or o.model or "radial"), function()
      local after = push(o, 0.05, 0.0025)
      for _, later in ipairs{ 0, 0.002 } do
        for _, dt in ipairs{ 0.01, 0.001 } do
          t.share(after, push(o, later, dt), SHARE, ("push, %g s later, at %g ms"):format(later, 1e3 * dt))
        end
      end
    end)
  end
end)

-- Returns a wire that was drawn `sunk` deep in what a function makes, after no time; and how far it rose [m].
local function begun(make, sunk, more)
  local scene, r = sw.scene{}, 0.004
  make(scene, r)
  local z = more.z and more.z(r) - sunk or r - sunk
  local wire = scene:wire{ E = 5e6, density = 1200, radius = r, model = more.model or "radial",
    section = "solid", from = { -0.05, 0, z }, to = { 0.05, 0, z } }
  if more.hold then scene:clamp(wire, { s = 0 }) end
  t.fine(scene:run{ dt = 1e-6, duration = 1e-6 })
  local rise = wire:position(0.05)[3] - z
  local wider = 0.5 * wire:width(0.05, { 0, 0, 1 }) - r
  scene:close()
  return rise, wider
end

local function plane(scene) scene:obstacle{ shape = "plane" } end
-- a step moves a free wire by g dt^2 and by 5 mm/s at most
local MOVES = 1e-8 -- [m]

describe("a mesh of elements", function()
  it("begins where it only touches a plane, a box or a round bar", function()
    local function box(scene)
      scene:obstacle{ shape = "box", size = { 0.02, 1, 0.1 }, at = { 0, 0, -0.05 } }
    end
    local function bar(scene)
      scene:obstacle{ shape = "cylinder", radius = 0.01, length = 0.1, at = { 0, 0, -0.01 },
        rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    end
    for _, make in ipairs{ plane, box, bar } do
      for _, model in ipairs{ "radial", "cubic" } do
        local rise, wider = begun(make, 0, { model = model })
        t.near(wider, rise, MOVES, "way out [m]")
      end
    end
  end)

  it("begins in a groove where it touches both sides", function()
    local half = math.sqrt(0.5)
    local function groove(scene)
      for _, side in ipairs{ -1, 1 } do
        scene:obstacle{ shape = "plane", normal = { 0, side * half, half } }
      end
    end
    -- the walls meet flanks at 45 degrees to its upright corner, where the octagon has corners too
    local rise, wider = begun(groove, 0, { z = function(r) return r / half end })
    t.near(wider / half, rise, 10 * MOVES, "way out [m]")
  end)

  it("stays where it was drawn deep, or is held", function()
    local r = 0.004
    t.below(MOVES, (begun(plane, 0.05 * r, {})), "way out of a deep one [m]")
    t.below(MOVES, (begun(plane, 0, { hold = true })), "way out of a held one [m]")
  end)
end)
