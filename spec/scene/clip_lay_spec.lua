-- SPDX-License-Identifier: GPL-3.0-or-later
-- What gripper:clip says where the wire does not go in because it lies tilted, or beside the clip.
local sw = require "softworld"

-- Returns the error of pressing a wire into a clip. how: tilt of the wire over the clip [deg]; beside: how
-- far it lies beside it [m]; at: the clip's place along it [m]; align.
local function refused(how)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local angle, y = math.rad(how.tilt or 0), how.beside or 0
  local c, s = 0.1 * math.cos(angle), 0.1 * math.sin(angle)
  local wire = scene:wire{ name = "w", E = 1e9, density = 1200, radius = 0.003, segments = 40,
    from = { -c, y - s, 0.008 }, to = { c, y + s, 0.008 } }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
  local clip = scene:clip{ name = "c", at = { how.at or 0, 0, 0 }, width = 0.008, insertion = 10,
    retention = 30 }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function()
    hand:grasp(wire, { s = 0.11 })
    hand:clip{ into = clip, align = how.align, max_force = how.max_force }
  end)
  local ok, why = pcall(scene.run, scene, { dt = 4e-3 })
  assert.is_false(ok)
  print("measured: " .. why)
  return why
end

local function has(text, part) assert.truthy(text:find(part, 1, true), text) end

describe("gripper:clip of a wire that does not go in", function()
  for _, tilt in ipairs{ 17, 30 } do
    it(("names its tilt: %d deg"):format(tilt), function()
      local why = refused{ tilt = tilt, max_force = 14 }
      has(why, ("lay over the mouth tilted by %d deg to the clip's axis: turn the gripper"):format(tilt))
      assert.falsy(why:find("beside the clip", 1, true), why)
    end)
  end

  it("names how far it lies beside the clip", function()
    has(refused{ beside = 0.02, align = false }, "wire 'w' lay 20.00 mm beside the clip's middle: move the "
      .. "gripper across")
    has(refused{ beside = 0.006, align = false }, "wire 'w' lay 6.000 mm beside the clip's middle")
  end)

  it("names how far it is from a clip that it does not pass", function()
    has(refused{ at = 0.12 }, "no wire passes 'c'; the nearest place of wire 'w', s = 0.2 m, is 20.00 mm off "
      .. "along its axis and 0 m across")
  end)

  it("names no tilt where there is none", function()
    local why = refused{ max_force = 5 }
    assert.falsy(why:find("tilted", 1, true) or why:find("beside", 1, true), why)
  end)
end)
