-- SPDX-License-Identifier: GPL-3.0-or-later
-- Outlines of sections as a chart.
local program = require "spec.host.program"
local sw = require "softworld"

describe("section:chart", function()
  teardown(program.clean)

  it("draws several outlines in one chart", function()
    local scene = sw.scene{}
    local wire = scene:wire{ model = "tube", particles = 8, E = 1e7, density = 1000, radius = 0.005,
      from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }
    local section, path = wire:section(0.05), program.folder() .. "/s.svg"
    assert.equal(path, section:chart{ path = path, name = "one", with = { { "two", wire:section(0.02) } } })
    local text = program.read(path)
    assert.matches("one", text)
    assert.matches("two", text)
    assert.error_matches(function() section:chart{} end, "section:chart takes")
    assert.error_matches(function() section:chart{ path = path, with = { section } } end, "with, item 1")
    for says, options in pairs{ ["with must be a list of { name, section }, got 3"] = { with = 3 },
      ["title must be a string, got 7"] = { title = 7 },
      ["name must be a string, got a table"] = { name = {} },
      ["there is no parameter 'titel'; did you mean 'title'?"] = { titel = "t" } } do
      options.path = path
      local fine, why = pcall(section.chart, section, options)
      assert.is_false(fine)
      assert.is_truthy(why:find("section:chart: " .. says, 1, true), why)
    end
  end)
end)
