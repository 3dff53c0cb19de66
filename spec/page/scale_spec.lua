-- SPDX-License-Identifier: GPL-3.0-or-later
-- One blow does not make a chart flat: its peaks are cut, marked with their values, and shown at a click.
local stage = require "spec.page.stage"
local sw = require "softworld"

-- Returns a run in which a gripper pushes a wire on a table; down: time in which it goes there [s].
local function push(down)
  local scene = sw.scene{ name = "push" }
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025,
    from = { 0, 0, 0.0025 }, to = { -0.5, 0, 0.0025 } }
  local hand = scene:gripper{ name = "hand" }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.03 })
    hand:move{ by = { 0.2, 0, 0.1 }, speed = 0.25 }
    hand:move{ by = { 0, 0, -0.1 }, duration = down, law = down < 0.1 and "linear" or nil }
    p:wait(0.2)
  end)
  return scene:run{ dt = 1e-3 }
end

-- JavaScript: the chart of forces, its range, and which share of the time each visible curve is beyond it.
local look = [[
  const chart = player.charts.list.find((c) => c.group.unit === "N");
  const curves = chart.group.curves.filter((c) => c.on), [low, high] = chart.graph.yAxisRange();
  let most = -Infinity, above = 0, below = 0;
  for (const c of curves) {
    const t = c.run.series.time, whole = t[t.length - 1] - t[0], beyond = { up: 0, down: 0 };
    c.values.forEach((x, i) => {
      const w = ((t[i + 1] ?? t[i]) - (t[i - 1] ?? t[i])) / 2;
      if (x > most) most = x;
      if (x > high) beyond.up += w; else if (x < low) beyond.down += w;
    });
    above = Math.max(above, beyond.up / whole); below = Math.max(below, beyond.down / whole);
  }
  const button = chart.element.querySelector(".scale");
  const marks = [...chart.element.querySelectorAll(".peak")];
]]

describe("the scale of a chart", function()
  local page, folder

  setup(function() page, folder = stage.open() end)
  teardown(stage.close)

  it("cuts a blow, says how high it is, and shows all of it at a click", function()
    push(0.03):report(folder .. "/blow.html")
    page:go(stage.address "blow.html")
    local seen = page:run(look .. "return { text: marks.map((m) => m.ariaLabel), "
      .. "hidden: button.hidden, all: [most, low, high, above, below] };")
    local most, low, high, above, below = table.unpack(seen.all)
    assert.is_false(seen.hidden)
    assert.is_true(most > 2 * high, most .. " " .. high)
    -- at most 1 % of the time of a curve is beyond either end, half a step more for the row at the quantile
    assert.is_true(above <= 0.012 and below <= 0.012, above .. " " .. below)
    assert.is_true(low < 0)
    local told = false
    for _, text in ipairs(seen.text) do told = told or text:find("table.contact_force: ", 1, true) ~= nil end
    assert.is_true(told and #seen.text >= 1)
    local whole = page:run(look .. "button.click(); return [most, chart.graph.yAxisRange()[1], "
      .. "chart.element.querySelectorAll('.peak').length];")
    assert.is_true(whole[2] >= whole[1], whole[2] .. " " .. whole[1])
    assert.equal(0, whole[3])
    local again = page:run(look .. "button.click(); return chart.graph.yAxisRange()[1];")
    assert.is_near(high, again, 1e-9)
    -- a mark is a button: it goes to the peak
    local time = page:run(look .. [[
      const m = marks[marks.length - 1], c = curves.find((c) => m.ariaLabel.startsWith(c.label + ":"));
      m.click();
      let best = 0;
      c.values.forEach((x, i) => { if (Math.abs(x) > Math.abs(c.values[best])) best = i; });
      return [player.state.get("time"), c.run.series.time[best] ];]])
    assert.is_near(time[2], time[1], 1e-9)
    -- zoomed to the blow, which is then most of what is in view, it is whole
    local zoomed = page:run(look .. [[
      const t = player.state.get("time");
      chart.graph.updateOptions({ dateWindow: [t - 2e-4, t + 2e-4] });
      return [chart.graph.yAxisRange()[1], most, button.hidden];]])
    assert.is_true(zoomed[1] >= zoomed[2], zoomed[1] .. " " .. zoomed[2])
    stage.assert_calm()
  end)

  it("stays as it is without a blow", function()
    push(1):report(folder .. "/calm.html")
    page:go(stage.address "calm.html")
    local seen = page:run(look .. "return [most, high, marks.length, button.hidden ? 1 : 0];")
    assert.is_true(seen[2] >= seen[1])
    assert.same({ 0, 1 }, { seen[3], seen[4] })
  end)
end)
