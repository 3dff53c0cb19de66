-- SPDX-License-Identifier: GPL-3.0-or-later
local number = require "softworld.output.number"
local progress = require "softworld.output.progress"
local scene = require "spec.output.scene"
local summary = require "softworld.output.summary"

-- A stream that keeps its text, and a clock that is set by the test.
local function recorder()
  local kept = {}
  function kept:write(...)
    for _, text in ipairs { ... } do self[#self + 1] = text end
    return self
  end
  function kept.flush() end
  function kept:text() return table.concat(self) end
  return kept
end

local function clock()
  local time = 0
  return function() return time end, function(t) time = t end
end

describe("number", function()
  it("gives four digits and a suitable prefix", function()
    local cases = {
      { 1.23456, "N", "1.235 N" }, { 0.0012345, "N", "1.234 mN" }, { -12345.678, "J", "-12.35 kJ" },
      { 999.96, "N", "1.000 kN" }, { 0.99996, "N", "1.000 N" }, { 0.03123, "m", "31.23 mm" },
      { 1234.5, "m", "1234 m" }, { 0.0, "N", "0 N" }, { 3, nil, "3" }, { 0.12345, "1/m", "0.1235 1/m" },
      { 1e-30, "N", "1.000e-30 N" }, { 0 / 0, "N", "nan N" }, { 1 / 0, "Pa", "inf Pa" },
      { 12345678.0, "1/m2", "1.235e7 1/m2" }, { 0.0000999951, "N m", "100.0 uN m" },
    }
    for _, case in ipairs(cases) do assert.equal(case[3], number.text(case[1], case[2])) end
  end)

  it("gives durations", function()
    assert.same({ "0.03 s", "12.4 s", "3 min 20 s", "2 h 05 min", "1 min 00 s" }, {
      number.duration(0.03), number.duration(12.4), number.duration(200), number.duration(7500),
      number.duration(59.96) })
  end)
end)

describe("summary", function()
  it("aligns its columns", function()
    local run = scene.run { frames = 2 }
    run.summary[2] = { label = "µ: radius", value = 0.03, unit = "m" }
    -- a note stands behind the time, so that a long one does not push the times away
    run.summary[3] = { label = "right: force", value = 2, unit = "N",
      where = "s = 0.1 m (10 ms mean; raw 2 N)", when = 0.5 }
    run.summary[4] = { label = "bar", value = 2, unit = "N", where = "+- 0.1 N (10 ms mean)" }
    local text = summary.text(run)
    assert.equal("laying: ok, end of the processes after 5.000 s, 500 steps, took 0.03 s\n"
      .. "  left: peak force  1.234 N   s = 0.2 m  t = 1.250 s\n"
      .. "  µ: radius         30.00 mm\n"
      .. "  right: force      2.000 N   s = 0.1 m  t = 500.0 ms  (10 ms mean; raw 2 N)\n"
      .. "  bar               2.000 N   +- 0.1 N                 (10 ms mean)\n", text)
  end)

  it("gives the reason and no numbers for a run that diverged", function()
    local run = scene.run { frames = 2 }
    run.ok, run.reason, run.time = false, "Newton did not converge\nat 100 %d", 0.25
    local text = summary.text(run)
    assert.truthy(text:find("laying: DIVERGED at t = 250.0 ms: Newton did not converge at 100 %d", 1, true))
    assert.is_nil(text:find("1.234", 1, true))
    assert.error_matches(function() summary.text {} end, "a run is expected")
  end)
end)

describe("progress", function()
  it("draws a bar at most ten times a second, within the width", function()
    local stream, now, set = recorder(), clock()
    local bar = progress.new {
      total = 5.0, stream = stream, terminal = true, width = 60, clock = now, name = "läying",
    }
    for i = 1, 1000 do
      set(i / 1000)
      bar:update(i / 400, i)
    end
    local _, drawings = stream:text():gsub("\r", "")
    assert.is_true(drawings >= 9 and drawings <= 11, tostring(drawings))
    for line in stream:text():gmatch("\r([^\r]*)\27%[K") do
      assert.is_true(utf8.len(line) < 60, line)
      assert.truthy(line:find("läying", 1, true))
    end
    assert.truthy(stream:text():find("45 %% .*t = 2%.2"))
    assert.truthy(stream:text():find("%[#+%-+%]"))
    set(1.5)
    bar:finish()
    local last = "\r\27[Kläying: t = 2.500 s, 1000 steps in 1.5 s\n"
    assert.equal(last, stream:text():sub(-#last))
    bar:update(3, 4)
    bar:finish()
    assert.equal(last, stream:text():sub(-#last))
  end)

  it("gives rate and time left when there is room, and never exceeds the width", function()
    for width = 1, 200 do
      local stream, now, set = recorder(), clock()
      local bar = progress.new { total = 5.0, stream = stream, terminal = true, width = width, clock = now }
      set(2)
      bar:update(1.0, 10)
      local line = stream:text():match("\r(.*)\27%[K")
      assert.is_true(utf8.len(line) < width)
      if width > 100 then assert.truthy(line:find("0.500 x real time, left 8.0 s", 1, true), line) end
    end
  end)

  it("prints few plain lines where there is no terminal", function()
    local stream, now, set = recorder(), clock()
    local bar = progress.new { total = 10.0, stream = stream, clock = now }
    for i = 0, 100 do
      set(i / 10)
      bar:update(i / 10, i)
    end
    bar:finish()
    local text = stream:text()
    local _, lines = text:gsub("\n", "")
    assert.equal(5, lines) -- at 0, 3, 6 and 9 s, and at the end
    assert.is_nil(text:find("[\r\27]"))
    assert.truthy(text:find("^  0 %%  t = 0 s of 10.00 s, 0 steps\n"))
    assert.truthy(text:find("t = 10.00 s, 100 steps in 10.0 s\n$"))
  end)

  -- Left = elapsed (total / done - 1): at 1/100 after 10 s another 990 s, at 1/50 another 490 s.
  it("says once that a run without a bar takes many minutes", function()
    local function told(rate, options)
      local stream, now, set = recorder(), clock()
      options.stream, options.clock, options.total, options.name = stream, now, 1000, "long"
      local bar = progress.new(options)
      for i = 0, 300 do
        set(i / 10)
        bar:update(rate * i / 10, i)
      end
      bar:finish()
      return stream:text()
    end
    assert.equal("long: 10.00 s computed in 10.0 s; the rest of 1000 s takes about 16 min 30 s; progress = "
      .. "true shows how far it is\n", told(1, { quiet = true, long = true }))
    assert.equal("", told(2, { quiet = true, long = true }))
    assert.equal("", told(1, { quiet = true }))
    assert.is_nil(told(1, { long = true }):find("progress = true", 1, true)) -- the bar is there
  end)

  it("clears its line after an error, and is silent on request", function()
    local stream, now = recorder(), clock()
    pcall(function()
      local options = { total = 1, stream = stream, terminal = true, width = 80, clock = now }
      local bar <close> = progress.new(options)
      bar:update(0.5, 1)
      error "boom"
    end)
    assert.equal("\r\27[K", stream[#stream])
    local quiet = recorder()
    do
      local bar <close> = progress.new { total = 1, stream = quiet, terminal = true, quiet = true }
      bar:update(0.5, 1)
      bar:fail "reason"
    end
    assert.equal("", quiet:text())
    local failing = recorder()
    local bar = progress.new { stream = failing, terminal = false, clock = now }
    bar:update(0.5, 7)
    bar:fail "Newton gave up"
    assert.truthy(failing:text():find("stopped at t = 500.0 ms after 7 steps: Newton gave up\n", 1, true))
    assert.error_matches(function() progress.new { total = -1 } end, "total must be a positive time")
  end)
end)
