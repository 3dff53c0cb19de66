-- SPDX-License-Identifier: GPL-3.0-or-later
-- The vertical range of charts over time: what a blow, rounding and a straight wire do to it.
local sw = require "softworld"
local files = require "spec.output.files"
local range = require "softworld.output.range"
local sink = require "softworld.output.sink"

-- A wave of size 1 for 1 s, 1000 samples, with spikes of the given height in the samples from 500 on.
local function wave(spikes, height)
  local time, values = {}, {}
  for i = 1, 1000 do
    time[i] = i / 1000
    values[i] = i >= 500 and i < 500 + spikes and height or math.sin(20 * time[i])
  end
  return time, values
end

local function svg_of(run)
  local folder = files.folder()
  local text = sink.read_file(run:chart{ path = folder .. "/run.svg" })
  files.remove(folder)
  return text
end

describe("the range of a chart over time", function()
  it("leaves out a peak of less than 1 % of the time, and names it", function()
    local time, values = wave(5, 50)
    local low, high, peaks = range.of(time, { { name = "hand.force", values = values } })
    -- the sine is above 0.9995 for 1 % of its time; a quarter of its span of 2 is added where it is cut
    assert.near(-1, low, 1e-3)
    assert.near(1.5, high, 0.01)
    assert.equal(1, #peaks)
    assert.equal("beyond: hand.force 50 N at 0.5 s", range.beyond(peaks, "N"))
  end)

  it("shows peaks whole that last longer or reach less far", function()
    for _, case in ipairs{ { 25, 50 }, { 5, 4 } } do
      local time, values = wave(case[1], case[2])
      local _, high, peaks = range.of(time, { { name = "a", values = values } })
      assert.equal(case[2], high)
      assert.equal(0, #peaks)
      assert.equal("", range.beyond(peaks, "N"))
    end
  end)

  it("weighs samples by their time: the many short steps of a blow are little time", function()
    local time, values = {}, {}
    for i = 1, 100 do time[i], values[i] = i / 100, math.sin(i) end
    for i = 1, 300 do time[100 + i], values[100 + i] = 1 + i * 1e-5, 70 end
    for i = 1, 100 do time[400 + i], values[400 + i] = 1.003 + i / 100, math.sin(i) end
    local _, high = range.of(time, { { name = "a", values = values } })
    assert.is_true(high < 2)
  end)

  it("takes values that are not finite for gaps, and none for nothing to draw", function()
    assert.is_nil(range.of({ 1, 2 }, { { name = "a", values = { 0 / 0, math.huge } } }))
    local low, high = range.of({ 1, 2, 3 }, { { name = "a", values = { 0 / 0, 2, 3 } } })
    assert.same({ 2, 3 }, { low, high })
  end)

  it("is the same as in the player, of which it is a copy in Lua", function()
    local text = assert(io.open "lua/softworld/page/scale.js"):read "a"
    assert.truthy(text:find("SHARE = 0.01", 1, true))
    assert.truthy(text:find("MANY = 3", 1, true))
    assert.truthy(text:find("ROOM = 0.25", 1, true))
  end)
end)

describe("a chart of a wire that hangs straight down", function()
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0, 0, -0.5 }, segments = 20 }
  local top = scene:clamp(wire, { s = 0, name = "top" })
  top:follow{ relative = true, duration = 0.2, points = { { 0, 0, 0 }, { 0, 0, 0.05 } } }
  local text = svg_of(scene:run{ duration = 0.2 })

  it("has no panel of bend radii, which are rounding", function()
    assert.is_nil(text:find("bend_radius", 1, true))
    assert.truthy(text:find("tension", 1, true))
  end)

  it("shows no digits of moments that are rounding", function()
    assert.truthy(text:find("top.moment", 1, true))
    assert.is_nil(text:find(">%s*%-?[%d.]+e%-1%d"))
  end)
end)

describe("a chart of a wire that falls on a table", function()
  it("names the peak beyond its range", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 }, segments = 40 }
    local hand = scene:gripper{ name = "left" }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.02 })
      hand:move{ by = { 0.1, 0, 0.05 }, duration = 1 }
      p:wait(0.2)
    end)
    assert.truthy(svg_of(scene:run()):find "beyond: [%w_.]+ %-?[%d.]+ N at 0%.%d+ s")
  end)
end)
