-- SPDX-License-Identifier: GPL-3.0-or-later
-- Settling wires that lie on each other.
local scenes = require "spec.contact.scenes"

local core = require "softworld.core"

local R, G, MASS = scenes.wire.radius, 9.81, scenes.wire.mass_per_length

-- Seven wires of 0.4 m between two rails: three below, two in their gaps with a third
-- against a rail, one on top.
local function bundle(friction)
  local s = core.scene{}
  local plane, rails = scenes.railed(s, R, friction)
  local wires = {}
  for i, p in ipairs{ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0.5, 1 }, { 1.5, 1 }, { 1, 2 }, { 0.2, 2 } } do
    local y, z = 2 * R * p[1], R * (1 + 1.7322 * p[2]) + 1e-5 * i
    wires[i] = scenes.add_wire(s, { 0, y, z }, { 0.4, y, z }, 20)
  end
  s:wire_contact{ friction = friction }
  return s, wires, plane, rails
end

describe("settling", function()
  for _, friction in ipairs{ 0, 0.3 } do
    it("lays a bundle of seven wires between two rails: friction " .. friction, function()
      local s, wires, plane, rails = bundle(friction)
      local r = s:settle()
      assert.is_true(r.ok, r.reason)
      assert.is_true(r.iterations < 1500, r.iterations .. " iterations")
      local carried = -plane:force()[3] - rails[1]:force()[3] - rails[2]:force()[3]
      local weight = 7 * 0.4 * MASS * G
      assert.is_true(math.abs(carried / weight - 1) < 0.01, carried .. " N of " .. weight)
      local across = rails[1]:force()[2] + rails[2]:force()[2] + plane:force()[2]
      assert.is_true(math.abs(across) < 0.01 * weight, "pushed aside by " .. across)
      assert.is_true(s:penetration() < 1e-4)
      for _, w in ipairs(wires) do assert.is_true(w:position(0.2)[3] > R - 1e-4) end
      local x0 = wires[6]:position(0.2)
      assert.is_true(s:advance({ dt = 0.005 }, 0.2).ok)
      local x1 = wires[6]:position(0.2)
      for k = 2, 3 do assert.is_true(math.abs(x1[k] - x0[k]) < 1e-4, "moves on") end
    end)
  end

  it("lays a wire across two others on a plane", function()
    for _, n in ipairs{ 10, 20, 40 } do
      local s = core.scene{}
      local plane = s:obstacle{ shape = "plane", friction = 0.3 }
      scenes.add_wire(s, { 0.15, -0.1, R }, { 0.15, 0.1, R }, n)
      scenes.add_wire(s, { 0.35, -0.1, R }, { 0.35, 0.1, R }, n)
      local top = scenes.add_wire(s, { 0, 0, 3 * R + 1e-4 }, { 0.5, 0, 3 * R + 1e-4 }, n + 5)
      s:wire_contact{ friction = 0.3 }
      local r = s:settle()
      assert.is_true(r.ok, r.reason)
      assert.is_true(r.iterations < 400, r.iterations .. " iterations")
      local weight = 0.9 * MASS * G
      assert.is_true(math.abs(-plane:force()[3] / weight - 1) < 1e-3)
      for _, at in ipairs{ 0.15, 0.35 } do
        assert.is_true(math.abs(top:position(at)[3] - 3 * R) < 2e-4, "lies on the lower ones")
      end
    end
  end)
end)
