-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that is curved at rest rolls in a clip, which does not squeeze it: an event tells it.
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A cable in a bow, flat or hanging, in a clip at its middle. Returns its events and how far its end hangs.
local function held(o)
  local scene = sw.scene{ name = "spooled" }
  local path, R = {}, 0.15
  for k = 0, 40 do
    local a = (k / 40 - 0.5) * 0.3 / R
    local up = R * (1 - math.cos(a))
    path[k + 1] = { R * math.sin(a), o.hangs and 0 or up, o.hangs and 0.1 - up or 0.1 }
  end
  local wire = scene:wire{ name = "wire", cable = "FLRY-B 2.5", path = path,
    rest = not o.bent and "path" or nil, segments = 40, rolls = o.rolls }
  scene:force{ kind = "damping", on = wire, mass = 8, stiffness = 0.001 }
  scene:clip{ name = "clip", at = { 0, 0, 0.1 }, width = 0.01, insertion = 8, retention = 25,
    friction = 0.25 }
  if o.clamp then scene:clamp(wire, { s = 0.15 }) end
  scene:process(function(p)
    for k = 1, 2 do p:step("part " .. k, function()
      if k == o.cut then error("power cut", 0) end
      p:wait(0.3 * k)
    end) end
  end)
  local file = o.file
  if o.cut then
    assert.is_false(pcall(scene.run, scene, { dt = 0.01, save = file }))
    return
  end
  local run = t.fine(scene:run{ dt = o.dt or 0.01, resume = file })
  local told = {}
  for _, e in ipairs(run.events) do
    if e.kind == "rolled" then told[#told + 1] = e end
  end
  return told, 0.1 - wire:position(0).z
end

describe("a wire that is curved at rest, in a clip", function()
  it("rolls, which is told", function()
    for _, rolls in ipairs{ false, true } do
      local told, sag = held{ rolls = rolls or nil }
      assert.equal(1, #told)
      assert.matches("^wire 'wire', which is curved at rest, has rolled in clip 'clip' by [%d.]+ degrees",
        told[1].text)
      t.above(0.5, told[1].value, "angle")
      t.above(0.07, sag, "sag")
    end
  end)

  -- The angle was that of the first look beyond 0.5 rad: 57 degrees of 111 at 1 ms.
  it("is told with the angle that it has rolled in the end", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.001 } do
      local told = held{ dt = dt }
      assert.equal(1, #told)
      assert.equal(1, told[1].count)
      t.share(1.93, told[1].value, 0.02, ("angle at %g s [rad]"):format(dt))
    end
  end)

  it("is told after a resume", function()
    local file = os.tmpname()
    held{ cut = 2, file = file }
    local told = held{ file = file }
    os.remove(file)
    assert.equal(1, #told)
  end)

  it("is silent if it does not roll", function()
    for _, o in ipairs{ { hangs = true }, { clamp = true }, { bent = true } } do
      assert.equal(0, #held(o))
    end
  end)
end)
