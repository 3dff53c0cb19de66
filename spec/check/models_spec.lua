-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check of wires whose model changes during the run, and of meshes whose rings are not equally far apart.
local sw = require "softworld"

local L, RADIUS = 0.06, 0.002

describe("run:check of torsion and ovalisation after wire:remodel", function()
  -- One end turns by ANGLE and back between t = 0.3 and 0.5 s. The wire has the model from 0.2 to 0.51 s, and
  -- is a rod before and after. Torsion: ANGLE / L = 20 rad/m. Meshes are calibrated to GJ within 0.1 %.
  local ANGLE = 1.2
  local function turned(model)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", E = 5e7, density = 1500, radius = RADIUS, from = { 0, 0, 0 },
      to = { L, 0, 0 }, segments = 12 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = L }):follow{ duration = 0.6, func = function(t)
      local angle = t > 0.3 and t < 0.5 and ANGLE * math.sin(math.pi * (t - 0.3) / 0.2) or 0
      return { L, 0, 0 }, { axis = { 1, 0, 0 }, angle = angle }
    end }
    scene:process(function(p)
      p:wait(0.2)
      if model then wire:remodel{ model = model } end
      p:wait(0.31)
      if model then wire:remodel{ model = "rod" } end
      p:wait(0.09)
    end)
    return scene:run{ dt = 0.01, quasistatic = true, frame = 1 }
  end

  for _, model in ipairs{ "rod", "radial", "tube" } do
    it("keeps the torsion of all steps: " .. model, function()
      local run = turned(model ~= "rod" and model)
      local row = run:check{ limits = { max_torsion = 19 } }:row "max_torsion"
      assert.equal("FAIL", row.verdict)
      assert.is_near(ANGLE / L, row.value, 1e-3 * ANGLE / L)
      assert.is_near(0.4, row.time, 1e-9)
    end)
  end

  it("keeps the ovalisation from the time as a mesh, and has none of a rod", function()
    local row = turned "tube":check{ limits = { max_ovalisation = 0.5 } }:row "max_ovalisation"
    assert.equal("PASS", row.verdict)
    assert.is_true(row.time >= 0.2 and row.time <= 0.51, row.time)
    row = turned():check{ limits = { max_ovalisation = 0.5 } }:row "max_ovalisation"
    assert.is_nil(row.value)
  end)
end)

describe("run:check of a mesh in a region of a wire", function()
  -- Rings are 0.7 mm apart in the region and 4 mm elsewhere. A peg presses on the wire at x = 0.14 m, so the
  -- place is that, to within one ring.
  it("finds the place of the pressure", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", E = 5e7, density = 1500, radius = 0.0015, from = { 0, 0, 0 },
      to = { 0.2, 0, 0 }, segments = 20 }
    scene:obstacle{ shape = "cylinder", radius = 0.01, length = 0.3, at = { 0.14, 0, -0.0115 },
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.2 }):follow{ points = { { 0, 0, 0 }, { -0.005, 0, -0.02 } }, relative = true,
      duration = 0.3 }
    wire:remodel{ model = "radial", region = { 0.02, 0.06 } }
    local row = scene:run{ duration = 0.3, dt = 0.005 }:check{}:row "max_sidewall"
    assert.is_true(row.value > 0)
    assert.is_near(0.14, row.s, 0.0045)
  end)
end)

describe("run:check of fatigue without a record of each step", function()
  local given = { fatigue = { curve = { { 1, 1e6 }, { 100, 10 } } } }
  local function row_of(change)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local other = scene:wire{ name = "a", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local wire = scene:wire{ name = "b", cable = "GXL 1.5", from = { 0, 1, 0 }, to = { 0.2, 1, 0 } }
    scene:process(function(p)
      p:wait(0.02)
      change(scene, other, wire)
      p:wait(0.02)
    end)
    return scene:run{ dt = 0.01 }:check(given):row "b.fatigue"
  end

  it("is open where frames do not tell, and says why", function()
    local row = row_of(function(scene, other) scene:remove(other) end)
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("a wire was removed", 1, true), row.note)
    row = row_of(function(_, _, wire) wire:remodel{ model = "radial" } end)
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("nodes are not the same", 1, true), row.note)
  end)
end)
