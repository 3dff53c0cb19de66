-- SPDX-License-Identifier: GPL-3.0-or-later
-- Natural frequencies of joined wires, of one wire while the others stay where they are, against beams.
local sw = require "softworld"
local t = require "spec.physics.tools"

local EI, MASS, LENGTH = 0.01, 0.03, 0.5
local UNIT = (EI / (MASS * LENGTH ^ 4)) ^ 0.5 / (2 * math.pi) -- unit of omega sqrt(m L^4/EI) [Hz]

-- Two wires in a row, joined in the middle and clamped at their other ends.
local function row(rigid, segments)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local function wire(from, to)
    return scene:wire { EA = 1e6 * EI, EI = EI, mass_per_length = MASS, radius = 0.002, segments = segments,
      from = { from, 0, 0 }, to = { to, 0, 0 } }
  end
  local a, b = wire(0, LENGTH), wire(LENGTH, 2 * LENGTH)
  scene:clamp(a, { s = 0 })
  scene:clamp(b, { s = LENGTH })
  scene:join { ends = { { a, s = LENGTH }, { b, s = 0 } }, rigid = rigid }
  t.fine(scene:settle())
  return a, b
end

local function first(wire) return wire:frequencies { modes = 1, alone = true }[1] / UNIT end

describe("frequencies of a joined wire while the others stay", function()
  -- Roots of the characteristic equations. The other wire's end gives way: by the stiffness of half of its
  -- edge in a rigid join, and by the spring between both. The error is of the size of an edge.
  for word, case in pairs { ["clamped and pinned, where it turns freely"] = { false, 15.41820570 },
    ["clamped at both ends, in a rigid join"] = { true, 22.37328545 } } do
    it("are a beam's, " .. word, function()
      local errors = {}
      for _, n in ipairs { 20, 40, 80 } do
        local a, b = row(case[1], n)
        errors[n] = math.abs(first(a) / case[2] - 1)
        t.share(first(a), first(b), 1e-6, "the other wire's")
      end
      print(("measured: %.2g, %.2g, %.2g off"):format(errors[20], errors[40], errors[80]))
      assert.is_true(errors[80] < 0.6 * errors[40] and errors[40] < 0.6 * errors[20])
      assert.is_true(errors[80] < 1.5 / 80)
    end)
  end

  it("are higher than those of both wires together", function()
    local a = row(true, 40)
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local both = scene:wire { EA = 1e6 * EI, EI = EI, mass_per_length = MASS, radius = 0.002, segments = 80,
      from = { 0, 0, 0 }, to = { 2 * LENGTH, 0, 0 } }
    scene:clamp(both, { s = 0 })
    scene:clamp(both, { s = 2 * LENGTH })
    t.fine(scene:settle())
    assert.is_true(first(a) > both:frequencies { modes = 1 }[1] / UNIT)
  end)

  it("are those of wire:frequencies without alone where nothing is joined", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local w = scene:wire { EA = 1e6 * EI, EI = EI, mass_per_length = MASS, radius = 0.002, segments = 20,
      from = { 0, 0, 0 }, to = { LENGTH, 0, 0 } }
    scene:clamp(w, { s = 0 })
    t.fine(scene:settle())
    assert.equal(w:frequencies { modes = 1 }[1], w:frequencies { modes = 1, alone = true }[1])
  end)
end)
