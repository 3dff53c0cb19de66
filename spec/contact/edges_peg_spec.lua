-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable hangs over a peg, clamped at one end and pulled at the other, and gets other edges: by a clamp or
-- a pin made on it between nodes, or by a remodel. Nothing moves then, so the peg bears what it bore, and the
-- new hold nothing. The new chords are up to 0.08 mm deeper in the peg, or 0.01 mm outside; that is due to
-- the edges. With the fault they were pushed out: the peg bore 14 to 18 N instead of 6, 16 instead of 8, and
-- the steps made energy from nowhere.
local sw = require "softworld"
local t = require "spec.physics.tools"

local R, PULL = 0.02, 3 -- radius of the peg [m], pull at the free end [N]

local function over_peg(cable, change, dt, fed)
  local scene, points = sw.scene{}, {}
  local a = R + sw.cable(cable).outer_diameter.value / 2
  points[1] = { -a, 0, -0.2 }
  for k = 0, 36 do
    local angle = math.pi * (1 - k / 36)
    points[#points + 1] = { a * math.cos(angle), 0, a * math.sin(angle) }
  end
  points[#points + 1] = { a, 0, -0.2 }
  local wire = scene:wire{ name = "w", cable = cable, path = points, segments = 100 }
  scene:force{ kind = "damping", on = wire, mass = 8 }
  scene:force{ kind = "point", on = wire, s = wire.length, force = { 0, 0, -PULL } }
  local peg = scene:obstacle{ name = "peg", shape = "cylinder", radius = R, length = 0.1, friction = 0.3,
    rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
  if fed then scene:feed(wire, { s = 0 }) else scene:clamp(wire, { s = 0 }) end
  local out = {}
  scene:process(function(p)
    p:wait(0.5)
    out.before = t.norm(peg:force())
    local hold = change(scene, wire)
    p:wait(dt)
    out.soon = t.norm(peg:force())
    p:wait(0.3)
    out.after, out.hold = t.norm(peg:force()), hold and t.norm(hold:force()) or 0
  end)
  return out, t.fine(scene:run{ dt = dt })
end

local function clamp(scene, wire) return scene:clamp(wire, { s = 0.5137 * wire.length }) end
local function pin(scene, wire) return scene:pin(wire, { s = 0.5137 * wire.length }) end
local function remodel(_, wire) wire:remodel{ model = "rod", segments = 131 } end

describe("a cable round a peg that gets other edges", function()
  for _, o in ipairs{ { "GXL 1.5", clamp, 0.004 }, { "GXL 1.5", clamp, 0.002 }, { "GXL 1.5", clamp, 0.001 },
    { "GXL 1.5", pin, 0.002 }, { "GXL 1.5", remodel, 0.002 }, { "FLRY-B 0.5", clamp, 0.002 },
    { "FLRY-B 0.5", pin, 0.002 }, { "FLRY-B 0.5", remodel, 0.002 }, { "GXL 1.5", clamp, 0.002, "fed" },
    { "GXL 1.5", pin, 0.001, "fed" }, { "FLRY-B 0.5", pin, 0.002, "fed" } } do
    local what = o[2] == clamp and "clamp" or o[2] == pin and "pin" or "remodel"
    local from = o[4] and ", from a feed at rest" or ""
    it(("presses as before: %s, %s%s, steps of %g s"):format(o[1], what, from, o[3]), function()
      local got, run = over_peg(o[1], o[2], o[3], o[4])
      t.share(got.before, got.soon, 0.1, "force of the peg at once [N]")
      t.share(got.before, got.after, 0.1, "force of the peg later [N]")
      t.below(0.1 * got.before, got.hold, "force of the new hold [N]")
      assert.equal(0, #t.events(run, "energy"))
      t.below(1e-3, run:ledger().gained / run:ledger().play, "energy from nowhere")
    end)
  end

  -- Two or three edges touch the peg; one of them is the clamp's.
  it("presses nearly as before: H07V-K 4, whose edges are coarse", function()
    local got, run = over_peg("H07V-K 4", clamp, 0.002)
    t.below(1.5 * got.before, got.after, "force of the peg later [N]")
    assert.equal(0, #t.events(run, "energy"))
    t.below(1e-3, run:ledger().gained / run:ledger().play, "energy from nowhere")
  end)
end)
