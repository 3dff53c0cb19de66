-- SPDX-License-Identifier: GPL-3.0-or-later
-- An error of a script in a run for error bars names the level and its edges: on coarse edges a script may
-- fail that does not fail on its own.
local sw = require "softworld"

local function run_of(raises, options)
  local scene = sw.scene{ name = "l" }
  local wire = scene:wire{ name = "w", cable = "GXL 2.5", from = { 0, 0, 0 }, to = { 0.4, 0, 0 },
    segments = 32 }
  scene:clamp(wire, { s = 0 })
  scene:process(function(p)
    p:wait(0.01)
    raises(#(wire:positions()) // 3 - 1)
  end)
  options.dt = 0.01
  return scene:run(options)
end

describe("an error in a run for error bars", function()
  local bars = { tolerance = { max_tension = 1e3 }, levels = 3 }

  it("names the level and its edges", function()
    local fine, why = pcall(run_of, function(n) if n < 10 then error "too coarse for me" end end, bars)
    assert.is_false(fine)
    print("measured: " .. why)
    assert.matches("spec.lua:%d+: too coarse for me %(in scene:run for error bars: on level 1,", why)
    assert.truthy(why:find("wire 'w' has edges of 50.00 mm, where the script asks for 12.50 mm)", 1, true))
    fine, why = pcall(run_of, function(n) if n > 10 then error "too fine" end end, bars)
    assert.is_false(fine)
    assert.truthy(why:find("on level 2, wire 'w' has edges of 25.00 mm", 1, true), why)
  end)

  it("stays as it is without levels, and if it is no text", function()
    local _, why = pcall(run_of, function() error "no" end, {})
    assert.truthy(why:find "no$", why)
    local thing = {}
    _, why = pcall(run_of, function() error(thing) end, bars)
    assert.equal(thing, why)
  end)
end)
