-- SPDX-License-Identifier: GPL-3.0-or-later
-- The sharpest bend of a wire is at its clamp, where the ring of a mesh is held. A slice of the mesh has its
-- bend in its middle, and beside a held ring it bends too little.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

local r, L = 0.003, 0.12

local function hung(args)
  local scene = sw.scene{}
  args.E, args.nu, args.density, args.radius = 5e6, 0.4, 1200, r
  args.from, args.to = { 0, 0, 0 }, { L, 0, 0 }
  local wire = scene:wire(args)
  local clamp = scene:clamp(wire, { s = 0 })
  assert(scene:settle().ok)
  local M = clamp:moment()
  return wire, wire.beam.EI / math.sqrt(M[1] ^ 2 + M[2] ^ 2 + M[3] ^ 2)
end

describe("smallest bend radius of a mesh of springs that hangs from a clamp", function()
  -- The reference is EI over the clamp's own moment; that of a rod with 400 edges is the same within 0.1 %.
  -- Tolerances are about 1.3 times what is left: the second and third slices also feel the held ring.
  for _, case in ipairs{ { 0.01, { model = "tube" } }, { 0.01, { model = "tube", core = false } },
    { 0.03, { model = "radial" } }, { 0.05, { model = "cubic" } } } do
    local within, args = case[1], case[2]
    it("is that at the clamp: " .. args.model .. (args.core == false and ", hollow" or ""), function()
      local wire, wanted = hung(args)
      local radius, place = wire:min_bend_radius{ now = true }
      local strain, at = wire:max_strain{ now = true }
      print(("measured: %.4g of EI/M"):format(radius / wanted))
      assert.is_near(wanted, radius, within * wanted)
      assert.is_near(r / wanted, strain, (within + 0.01) * r / wanted)
      assert.are.equal(0, place)
      assert.are.equal(0, at)
    end)
  end

  it("comes nearer with more slices", function()
    local wire, wanted = hung{ model = "cubic", segments = 174 } -- twice as many as by default
    assert.is_near(wanted, (wire:min_bend_radius{ now = true }), 0.015 * wanted)
  end)
end)
