-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pads that touch a cable with one ridge each, such as those of a mesh file. Both touches are at one place of
-- the axis, so they show no turn of the cable between the pads, and its slip is the way of that place.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Way of the hand along the cable. Most of it slips; before, friction that sticks gives by 0.02 to 0.08 mm
-- [m].
local way = 1e-3

-- Writes a finger whose ridge is the line x = y = 0 of height 20 mm; returns the file's name.
local function ridge()
  local name = os.tmpname() .. ".obj"
  local out = assert(io.open(name, "w"))
  for _, z in ipairs{ -10, 10 } do out:write(("v 0 0 %d\nv 4 3 %d\nv -4 3 %d\n"):format(z, z, z)) end
  out:write "f 1 3 2\nf 4 5 6\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\nf 3 1 4\nf 3 4 6\n"
  out:close()
  return name
end

-- Fingers grip a cable between two clamps at `s`, lift it, and draw it along until it slips. Returns the slip
-- that the gripper tells of, and that of the place on the cable [m].
local function draw(cable, file, s, o)
  local scene = sw.scene{ gravity = t.turned({ 0, 0, -9.81 }, o.turn) }
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = t.turned({ 0.2, 0, 0 }, o.turn),
    segments = o.segments or 50 }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 0.003 }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = wire.length })
  local hand = scene:gripper{ pads = { shape = "mesh", file = file, scale = 1e-3, opening = 0.008 } }
  local along, up = t.turned({ 1, 0, 0 }, o.turn), t.turned({ 0, 0, 1 }, o.turn)
  local told, real
  scene:process(function(p)
    hand:approach(wire, { s = s })
    hand:grasp(wire, { s = s, approach = "plates", force = 5 })
    local before = wire:position(s):dot(along)
    hand:move{ by = { up[1] * 0.002, up[2] * 0.002, up[3] * 0.002 }, speed = 0.02 }
    hand:move{ by = { along[1] * way, along[2] * way, along[3] * way }, speed = 0.01 }
    p:wait(0.1)
    told, real = hand:state().slip, way - (wire:position(s):dot(along) - before)
  end)
  t.fine(scene:run{ dt = o.dt or 0.005, quasistatic = o.poses })
  return told, real
end

describe("the slip of a cable between two ridges", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it(("is the way of the place that they hold: %s"):format(cable), function()
      local file = ridge()
      local cases = { { 0.11, {} }, { 0.11, { poses = true } }, { 0.1115, {} }, { 0.112, { dt = 0.0025 } },
        { 0.112, { poses = true } }, { 0.11, { segments = 67 } }, { 0.11, { turn = 0.7 } } }
      for _, case in ipairs(cases) do
        local told, real = draw(cable, file, case[1], case[2])
        t.above(0.8 * way, real, "way [m]")
        t.share(real, told, 0.1, "slip")
      end
      os.remove(file)
    end)
  end
end)
