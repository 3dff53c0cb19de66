-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments that a call does not take. spec/contract/calls_spec.lua gives one more to each call with a row.
local sw = require "softworld"
local mm = sw.units.mm

local function has(text, part) assert.truthy(text and text:find(part, 1, true), tostring(text)) end

describe("an argument that a call does not take", function()
  it("is refused with its number and value, by functions of sw and by readings", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "GXL 1.5", segments = 10, from = { 0, 0, 0 }, to = mm{ 300, 0, 0 } }
    local hand = scene:gripper{}
    local clamp = scene:clamp(wire, { s = 0.3 })
    local entry = sw.cable "GXL 1.5"
    for text, call in pairs{
      ["sw.load takes (file), got 3 too, as argument 2"] = function() sw.load("a.sws", 3) end,
      ["sw.scene takes ({...}), got 'x' too, as argument 2"] = function() sw.scene({}, "x") end,
      ["sw.cables takes no arguments, got 'GXL' as argument 1"] = function() sw.cables "GXL" end,
      ["sw.cable takes (name), got 'slip' too, as argument 2"] = function() sw.cable("GXL 1.5", "slip") end,
      ["sw.shape takes ({...}), got 0.1 too"] = function() sw.shape({}, 0.1) end,
      ["sw.trajectory takes ({...}), got a table too"] = function() sw.trajectory({}, {}) end,
      ["sw.calibrate takes ({...}), got 1 too"] = function() sw.calibrate({}, 1) end,
      ["sw.tune.minimise takes ({ f =, ... }), got 1 too"] = function() sw.tune.minimise({}, 1) end,
      ["sw.material takes (name), got 1 too"] = function() sw.material("copper", 1) end,
      ["cable:section takes (stiffness), got 1 too, as argument 2"] = function() entry:section("slip", 1) end,
      ["units.mm takes (value), got 2 too, as argument 2; several values are a table: mm{ 1, 2, 3 }"] =
        function() return mm(1, 2, 3) end,
      ["units.mm takes a number or a table of numbers, got nil"] = function() return (mm(nil)) end,
      ["wire:max_tension takes ({ window =, now = }), got 2 too, as argument 3"] = function()
        wire:max_tension({}, nil, 2)
      end,
      ["clamp:moment takes ({ at = }), got a wire too"] = function() clamp:moment({}, wire) end,
      ["clamp:read takes no arguments, got 'force' as argument 1"] = function() clamp:read "force" end,
      ["wire:log takes (t1, t2), got 1 too, as argument 3"] = function() wire:log(0, 1, 1) end,
      ["scene:snapshot takes no arguments, got 'x' as argument 1"] = function() scene:snapshot "x" end,
      ["gripper:position takes no arguments, got 0.1"] = function() hand:position(0.1) end } do
      local fine, why = pcall(call)
      assert.is_false(fine, text)
      has(why, "extra_spec.lua:")
      has(why, text)
    end
    has(select(2, pcall(wire.position, wire, 0.1, nil, 0 / 0)),
      "wire:position takes (s), got nan too, as argument 3")
    assert.same(wire:position(0.1), wire:position(0.1, nil, nil))
  end)
end)
