-- SPDX-License-Identifier: GPL-3.0-or-later
-- Units: conversions to and from SI, and refusals.
local units = require "softworld.units"

describe("units", function()
  it("convert to SI exactly", function()
    assert.are.equal(0.005, units.mm(5))
    assert.are.equal(0.035, units.mm(35))
    assert.are.equal(0.0254, units.inch(1))
    assert.are.equal(0.0123, units.g_per_m(12.3))
    assert.are.equal(2100, units.kN(2.1))
    assert.are.equal(2.1e11, units.GPa(210))
    assert.are.equal(3e5, units.bar(3))
    assert.are.equal(90, units.min(1.5))
    assert.are.equal(math.pi, units.deg(180))
    assert.is_true(math.abs(units.rpm(60) - 2 * math.pi) < 1e-14)
    assert.are.same({ 0.3, 0, 0.002 }, units.mm { 300, 0, 2 })
  end)

  it("convert back", function()
    for _, name in ipairs { "mm", "cm", "um", "g", "kg", "deg", "rpm", "kN", "N", "MPa", "GPa", "ms", "min",
      "inch", "bar", "g_per_m" } do
      assert.is_true(math.abs(units.to[name](units[name](7.3)) - 7.3) < 1e-14)
    end
    assert.are.equal(5, units.to.mm(0.005))
  end)

  it("refuse a wrong name and a wrong value", function()
    assert.error_matches(function() return units.Mpa end, "no unit 'Mpa'; did you mean 'MPa'")
    assert.error_matches(function() return units.to.mmm end,
      "units.to: there is no unit 'mmm'; did you mean 'mm'")
    assert.error_matches(function() return units.furlong end, "known are")
    local self = {}
    self[1] = self
    assert.error_matches(function() units.mm(self) end, "units.mm: the table holds itself")
    assert.error_matches(function() units.mm "5" end,
      "units.mm takes a number or a table of numbers, got string")
  end)
end)
