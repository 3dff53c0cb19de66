-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire in a clip comes to rest (settle) under a force.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"

-- Equilibria from the seat and from above. The floor bears 500 N, the lips 8 N on the way in and 25 N on
-- the way out. Regression: an equilibrium below the clip's floor was accepted, with ok, from 1 N on.
describe("a wire in a clip that comes to rest under a force", function()
  local function pressed(cable, force, height, hold)
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local w = s:wire{ cable = cable, segments = 20, from = { -0.05, 0, height }, to = { 0.05, 0, height } }
    local clip = s:clip{ at = { 0, 0, 0 }, width = 0.01, insertion = 8, retention = 25 }
    hold(s, w)
    s:force{ kind = "point", on = w, s = 0.05, force = { 0, 0, force } }
    local r = s:settle()
    assert.is_true(r.ok, r.reason)
    return clip, w:position(0.05)[3]
  end
  local holds = {
    clamp = function(s, w) s:clamp(w, { s = 0.1 }) end,
    pin = function(s, w) s:pin(w, { s = 0.1 }) end,
  }

  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10" } do
    for name, hold in pairs(holds) do
      it(("stays in its seat below what floor and lips bear: %s, %s"):format(cable, name), function()
        for _, force in ipairs{ -100, -20, -4, -1, -0.1, 1, 10, 20 } do
          local clip, z = pressed(cable, force, 0, hold)
          local what = ("%g N: z = %g m"):format(force, z)
          assert.is_true(clip:seated(), what)
          -- the hold bears less than 2 %, through the bending of 50 mm of wire
          assert.is_true(math.abs(clip:force()[3] + force) < 0.02 * math.abs(force), what)
        end
        assert.is_false((pressed(cable, 30, 0, hold)):seated())
      end)
    end
  end

  it("passes the lips from above with more than their 8 N, not with less", function()
    local function guided(s, w)
      for _, place in ipairs{ 0, 0.05, 0.1 } do s:slider(w, { s = place, direction = { 0, 0, 1 } }) end
    end
    for _, force in ipairs{ 2, 7, 7.9 } do
      assert.is_false((pressed("FLRY-B 10", -force, 0.03, guided)):seated(), force .. " N")
    end
    for _, force in ipairs{ 8.2, 12 } do
      assert.is_true((pressed("FLRY-B 10", -force, 0.03, guided)):seated(), force .. " N")
    end
  end)
end)
