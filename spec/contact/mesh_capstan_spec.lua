-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable that is a mesh is drawn over a peg, a quarter turn. Friction acts at its surface, so the pulls have
-- the ratio exp(mu phi R / (R + r)), not exp(mu phi) as those of a rod that does not roll.
local sw = require "softworld"
local t = require "spec.physics.tools"

local MU, PEG, PULL, WAY = 0.3, 0.03, 30, 0.004
local RADIUS = sw.cable "GXL 1.5".outer_diameter.value / 2

-- 20 mm of cable down beside the peg, a quarter turn over it, 20 mm along x.
local function path()
  local around, list = PEG + RADIUS, {}
  for i = 0, 9 do list[#list + 1] = { -around, 0, -0.02 + 0.002 * i } end
  for i = 0, 400 do
    local a = i / 400 * math.pi / 2
    list[#list + 1] = { -around * math.cos(a), 0, around * math.sin(a) }
  end
  for i = 1, 10 do list[#list + 1] = { 0.002 * i, 0, around } end
  return list
end

-- Returns the cable drawn by WAY, its hand and the mean pull of the hand while it slides. A side of the
-- polygon lies on the peg: its corners are half of 45 degrees aside.
local function drawn(model, run)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local side = math.rad(22.5)
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", model = model, path = path(),
    normal = model ~= "rod" and { -math.cos(side), math.sin(side), 0 } or nil }
  scene:obstacle{ shape = "cylinder", radius = PEG, length = 0.1, at = { 0, 0, 0 }, friction = MU,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  scene:force{ kind = "point", on = wire, s = 0, force = { 0, 0, -PULL } }
  if not run.quasistatic then scene:force{ kind = "damping", mass = 30 } end
  local hand = scene:clamp(wire, { s = wire.length })
  t.fine(scene:settle())
  hand:follow{ points = { { 0, 0, 0 }, { WAY, 0, 0 } }, relative = true, duration = 0.4 }
  local sum, count = 0, 0
  scene:observe{ every = 0.01, call = function()
    if scene.time > 0.2 then sum, count = sum + hand:force()[1], count + 1 end
  end }
  run.duration = 0.4
  t.fine(scene:run(run))
  return sum / count
end

describe("a cable drawn over a peg", function()
  local surface = PULL * math.exp(MU * math.pi / 2 * PEG / (PEG + RADIUS))

  for _, model in ipairs{ "tube", "radial" } do
    -- the cable's bend makes the angle of contact up to half a degree smaller: 0.25 % of the pull
    it("has as a " .. model .. " the friction of its surface, in poses", function()
      t.share(surface, drawn(model, { dt = 0.02, quasistatic = true }), 5e-3, "pull")
    end)

    -- Slices leave the peg one by one and shake the mesh by up to 3 %; the mean is that of poses.
    it("has it as a " .. model .. " in motion, in whole steps", function()
      t.share(surface, drawn(model, { dt = 0.01, parts = false }), 5e-3, "mean pull")
    end)
  end

  it("has as a rod the friction of its axis", function()
    t.share(PULL * math.exp(MU * math.pi / 2), drawn("rod", { dt = 0.02, quasistatic = true }), 5e-3, "pull")
  end)
end)
