-- SPDX-License-Identifier: GPL-3.0-or-later
-- Places beyond 1e100 m and jaws beyond 1 km are refused where they are given, and nothing changes. Before, a
-- tie to a point at 1e300 m had an infinite distance, with a run that was ok.
local sw = require "softworld"

local FAR = 1e300

local function scene_of()
  local scene = sw.scene {}
  local wire = scene:wire { name = "w", E = 1e7, density = 1000, radius = 0.003, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 }, segments = 10 }
  return scene, wire, scene:clamp(wire, { s = 0, name = "c" })
end

local cases = {
  ["wire: to: x = 1e+300 m"] = function(s)
    s:wire { cable = "GXL 1.5", from = { 0, 0, 0 }, to = { FAR, 0, 0 } }
  end,
  ["wire: path, point 2: y = -1e+300 m"] = function(s)
    s:wire { cable = "GXL 1.5", path = { { 0, 0, 0 }, { 0, -FAR, 0 } } }
  end,
  ["obstacle sphere: at: z = 1e+300 m"] = function(s)
    s:obstacle { shape = "sphere", radius = 1, at = { 0, 0, FAR } }
  end,
  ["force pull: to: z = 1e+300 m"] = function(s, w)
    s:force { kind = "pull", on = w, s = 0, to = { 0, 0, FAR }, stiffness = 1 }
  end,
  ["tie 'tie1': to: x = -1e+300 m"] = function(s, w)
    s:tie(w, { s = 0, to = { -FAR, 0, 0 }, slack = 0.1 })
  end,
  ["clip 'clip1': at: z = 1e+300 m"] = function(s) s:clip { at = { 0, 0, FAR }, radius = 0.003 } end,
  ["scene:gripper: at: z = 1e+300 m"] = function(s) s:gripper { at = { 0, 0, FAR } } end,
  ["clamp:follow: way-point 2: x = 1e+300 m"] = function(_, _, c)
    c:follow { points = { { 0, 0, 0.1 }, { FAR, 0, 0 } }, duration = 1 }
  end,
  ["clamp:pose: position: x = 1e+300 m"] = function(_, _, c) c:pose { FAR, 0, 0 } end,
}

describe("A place that is too far", function()
  for text, call in pairs(cases) do
    it("is refused: " .. text, function()
      local scene, wire, clamp = scene_of()
      local before = scene:names()
      local fine, why = pcall(call, scene, wire, clamp)
      assert.is_false(fine)
      assert.truthy(why:find(text .. " is not allowed; it must be in [-1e+100, 1e+100] m", 1, true), why)
      assert.same(before, scene:names())
      assert.is_true(scene:run { duration = 0.01 }.ok)
    end)
  end

  it("may be 1e100 m away at most", function()
    local scene, wire = scene_of()
    local tie = scene:tie(wire, { s = 0, to = { -1e100, 0, 0.1 } })
    assert.equal(1e100, tie:distance())
  end)
end)

describe("Jaws", function()
  it("are not opened or closed to more than 1 km, nor faster than 1 km/s; nothing changes", function()
    local scene, wire = scene_of()
    local hand = scene:gripper { name = "hand", at = { 0.15, 0, 0.1 } }
    local before = scene:names()
    for method, args in pairs { open_jaws = { distance = 2 ^ 53 }, close_jaws = { distance = 1e4 } } do
      local fine, why = pcall(hand[method], hand, args)
      assert.is_false(fine)
      assert.truthy(why:find("distance = ", 1, true), why)
      assert.truthy(why:find("at least 0 m and at most 1000 m", 1, true), why)
    end
    local fine, why = pcall(hand.open_jaws, hand, { speed = 1e5 })
    assert.is_false(fine)
    local text = "speed = 100000 m/s is not allowed; it must be above 0 m/s and at most 1000 m/s"
    assert.truthy(why:find(text, 1, true), why)
    assert.same(before, scene:names())
    assert.equal("w", wire.name)
  end)
end)
