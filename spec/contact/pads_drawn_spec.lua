-- SPDX-License-Identifier: GPL-3.0-or-later
-- Meshes drawn out of closed pads: their slices glide past the pads' rims.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local MU, FORCE, L, r = 0.5, 10, 0.08, 0.003

-- Pads draw a rubber wire that is clamped at its start. Returns the largest pull of the clamp once the pads
-- have closed, and the pull at the end [N]; the run; the largest moment of the clamp [N m]. With turn they
-- turn about the wire instead [rad].
local function drawn(mesh, dt, more)
  local o = more or {}
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  scene:force { kind = "damping", mass = 8, stiffness = 1e-3 }
  local args = { E = 1e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, 0 }, to = { L, 0, 0 } }
  for key, value in pairs(mesh) do args[key] = value end
  local wire = scene:wire(args)
  local clamp = scene:clamp(wire, { s = 0 })
  local hand = scene:gripper { name = "hand", at = { 0.06, 0, 0 }, pads = { width = 0.012, height = 0.016,
    friction = MU, opening = 4 * r } }
  local began
  scene:process(function(p)
    hand:grasp(wire, { s = 0.06, approach = "plates", force = o.force or FORCE })
    p:wait(0.1)
    began = scene.time
    if o.turn then hand:rotate { axis = { 1, 0, 0 }, angle = o.turn, duration = 1 }
    else hand:move { by = { o.way or 0.015, 0, 0 }, speed = 0.03 } end
  end)
  local run = t.fine(scene:run { dt = dt, frames = false })
  return clamp:over(began, run.time).peak_force, -clamp:force()[1], run,
    clamp:over(began, run.time).peak_moment
end

describe("a mesh drawn out of closed pads", function()
  -- The pull of a wire that slides is 2 mu N. A slice that passes a rim adds and takes some percent.
  local meshes = { { model = "tube" }, { model = "radial" }, { model = "radial", body = "solid" } }
  for _, mesh in ipairs(meshes) do
    for _, dt in ipairs { 5e-3, 2e-3 } do
      it(("is held by friction only: %s %s, %g s"):format(mesh.model, mesh.body or "springs", dt), function()
        local peak, last = drawn(mesh, dt)
        local most = 2 * MU * FORCE
        print(("measured: peak %.3f, at the end %.3f of 2 mu N"):format(peak / most, last / most))
        t.above(0.97 * most, peak, "largest pull")
        t.below(1.15 * most, peak, "largest pull")
        t.near(most, last, 0.1 * most, "pull at the end")
      end)
    end
  end

  -- Returns the hardest event, or nil. Those in quick succession are one.
  local function caught(run)
    local most
    for _, e in ipairs(run.events) do
      if e.kind == "caught" and not (most and most.value > e.value) then most = e end
    end
    return most
  end

  -- Elements that are squeezed by a seventh wedge on the rims and stretch by a quarter.
  it("tells of a pull that friction does not explain", function()
    local solid = { model = "radial", body = "solid" }
    local peak, _, run = drawn(solid, 5e-3, { force = 40, way = 0.03 })
    local event = caught(run)
    t.above(1.25 * 2 * MU * 40, peak, "largest pull")
    assert.is_truthy(event)
    assert.equal("hand", event.object)
    t.near(peak, event.value, 0.1 * peak, "force of the event")
    assert.is_falsy(run:check { limits = { peak_force = 1e9 } }.ok)
    assert.is_falsy(caught(select(3, drawn(solid, 5e-3))))
  end)

  it("tells of corners that resist a turn as those of a nut do", function()
    local _, _, run, moment = drawn({ model = "radial", body = "solid" }, 5e-3, { turn = 2 * math.pi })
    local event = caught(run)
    t.above(1.25 * 2 * MU * FORCE * r, moment, "largest moment")
    assert.is_truthy(event and event.text:find("Corners", 1, true))
  end)
end)
