-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs that fail: reported at the end of a script that did not look at them; their frames, pictures and
-- progress.
local sw = require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- Explicit steps slightly too long: the wire is torn apart after a while.
local failing = [[
local sw = require "softworld"
local function fail()
  local scene = sw.scene{ name = "wild" }
  local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = {0, 0, 0.1},
    to = {0.5, 0, 0.1} }
  scene:clamp(wire, { s = 0 })
  local dt = 1.2 * scene:stable_dt()
  local run = scene:run{ duration = 1, dt = dt, integrator = "velocity-verlet", unstable = true,
    frame = 0.001 }
  return run
end
]]

describe("a run that failed", function()
  after_each(program.clean)

  it("is reported at the end of a script that did not look at it, and the script fails", function()
    local out, err, code = script(failing .. "local run = fail()\nprint 'done'")
    assert.equal("done\n", out)
    assert.truthy(err:find("run of 'wild' at script.lua:8 FAILED at t = ", 1, true), err)
    assert.truthy(err:find("; try ", 1, true), err)
    assert.equal(1, code)
  end)

  for what, code in pairs{ ok = "assert(not run.ok)", reason = "print(run.reason)", print = "print(run)",
    summary = "run:summary()", use = "print(pcall(run.series, run))" } do
    it("is not reported when the script looked: " .. what, function()
      local _, err, status = script(failing .. "local run = fail()\n" .. code)
      assert.equal("", err)
      assert.equal(0, status)
    end)
  end

  it("counts as looked at within tuning and error bars", function()
    local _, err, status = script(failing .. [[
      assert(sw.tune.minimise{ from = 0, to = 1, max_iterations = 3,
        f = function(x) fail() return x * x end }.reason)]])
    assert.equal("", err)
    assert.equal(0, status)
  end)

  it("is reported with error bars when the script does not look at the result", function()
    local _, err, status = script [[
      local sw = require "softworld"
      local scene = sw.scene{ name = "bars" }
      local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = {0, 0, 0.1},
        to = {0.5, 0, 0.1} }
      scene:clamp(wire, { s = 0 })
      scene:run{ duration = 0.3, dt = 0.01, integrator = "velocity-verlet", unstable = true,
        tolerance = { tip = 1e-3 } }]]
    assert.truthy(err:find("run of 'bars'", 1, true), err)
    local _, count = err:gsub("FAILED", "")
    assert.equal(1, count)
    assert.equal(1, status)
  end)

  it("is reported for code of -e too", function()
    local _, err, code = program.run{ "-e", failing .. "fail()" }
    assert.truthy(err:find("FAILED", 1, true), err)
    assert.equal(1, code)
  end)
end)

-- Peaks start anew with each run and settle; the results of an earlier run stay.
describe("a run before the last one", function()
  local function hanging()
    local scene = sw.scene{}
    scene:force{ kind = "damping", mass = 30 }
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    return scene
  end

  for what, go_on in pairs{ run = function(scene) scene:run{ duration = 3 } end,
    settle = function(scene) scene:settle() end,
    ["error bars"] = function(scene) scene:run{ duration = 0.5, tolerance = { tip = 1e-2 } } end } do
    it("keeps its summary and its series after another " .. what, function()
      local scene = hanging()
      local run = scene:run{ duration = 0.3 }
      local summary, series = run:document().summary, run:series()
      go_on(scene)
      assert.same(summary, run:document().summary)
      local after = run:series()
      assert.same(series.time, after.time)
      assert.equal(#series.columns, #after.columns)
      assert.equal(0.3, after.time[#after.time])
    end)
  end

  -- A run holds its scene, and only the script holds runs; the list of runs keeps neither alive.
  for what, go_on in pairs{ nothing = function() end, ["another run"] = function(scene)
    return scene:run{ duration = 0.1 }
  end, ["a settle"] = function(scene) scene:settle() end,
    ["error bars"] = function(scene) return scene:run{ duration = 0.1, tolerance = { tip = 1e-2 } } end,
    ["a process cut short"] = function(scene)
      scene:process(function(p) p:wait(1) end)
      return scene:run{ duration = 0.01 }
    end,
    ["a run that failed"] = function(scene)
      scene:force{ on = scene:find "w", kind = function(_, _, _, f) f[#f] = 1e20 end }
      local run = scene:run{ duration = 0.1 }
      assert.is_false(run.ok)
      return run
    end } do
    it("is collected with its scene when the script drops both, after " .. what, function()
      local function made()
        local scene = hanging()
        local run = scene:run{ duration = 0.1 }
        run:document()
        local last = go_on(scene) or run
        return setmetatable({ scene, run, last, scene:find "w" }, { __mode = "v" })
      end
      collectgarbage()
      collectgarbage()
      local before = sw.core.allocated()
      local left = made()
      assert.truthy(next(left))
      assert.is_true(sw.core.allocated() > before)
      collectgarbage()
      collectgarbage()
      assert.is_nil(next(left))
      assert.equal(before, (sw.core.allocated()))
    end)
  end

  it("keeps its scene for as long as the script has the run", function()
    local function made() return (hanging():run{ duration = 0.1 }) end
    local run = made()
    local rows = run:document().summary
    collectgarbage()
    collectgarbage()
    assert.same(rows, run:document().summary)
    run.scene:run{ duration = 0.1 }
    assert.same(rows, run:document().summary)
  end)
end)

describe("frames of a run that failed", function()
  local run

  setup(function()
    run = load(failing .. "return fail()")()
    assert.is_false(run.ok)
  end)

  it("are kept, with the last good state", function()
    local frames = run:frames()
    assert.is_true(#frames > 3)
    assert.is_true(frames[#frames].t <= run.time)
    assert.is_true(run.time - frames[#frames].t < 0.0021)
  end)

  it("are written for ParaView, while series, charts and tables are refused", function()
    local folder = program.folder()
    run:vtk(folder .. "/wild.pvd")
    assert.truthy(program.read(folder .. "/wild.pvd"):find("wires_00003", 1, true))
    for _, f in ipairs{ run.series, run.chart, run.save } do
      local fine, why = pcall(f, run, f == run.save and folder .. "/x.csv" or { path = folder .. "/x.svg" })
      assert.is_false(fine)
      assert.truthy(why:find("failed", 1, true), why)
    end
    program.clean()
  end)

  it("give pictures of the last frames, with a note of the failure", function()
    local folder = program.folder()
    local made = run:pictures{ path = folder .. "/x.png", count = 2, draft = true, width = 300 }
    assert.truthy(made.note:find("FAILED at t = ", 1, true), made.note)
    program.clean()
  end)
end)

describe("what to try next", function()
  local advice = require "softworld.run.advice"
  local cases = {
    { "wire 'w' is torn apart", { integrator = "rk4" }, "scene:stable_dt()" },
    { "no convergence in 30 iterations", { dt = 0.02 }, "dt = 5 ms" },
    { "a wire is fed too fast for the steps", {}, "a slower feed" },
    { "no convergence in 30 iterations", { quasistatic = true, dt = 0.1 }, "without quasistatic" },
    { "the tolerance needs steps below 1e-09 s", { tolerance = 1e-9 }, "a larger tolerance" },
  }
  for _, case in ipairs(cases) do
    it("matches the reason: " .. case[1], function()
      local text = advice.of(case[1], case[2])
      assert.truthy(text:gsub("%.0+ ", " "):find(case[3], 1, true), text)
    end)
  end
end)

describe("progress", function()
  local progress = require "softworld.output.progress"

  local function bar_after(time)
    local now, lines = 0, {}
    local stream = { write = function(_, ...) lines[#lines + 1] = table.concat{ ... } end,
      flush = function() end }
    local bar = progress.new{ total = 1, name = "x", stream = stream, terminal = true, width = 80, after = 1,
      clock = function() return now end }
    while now < time do
      now = now + 0.2
      bar:update(now / 10, 1)
    end
    bar:finish()
    return table.concat(lines)
  end

  it("shows nothing for short runs", function() assert.equal("", bar_after(0.7)) end)
  it("is shown for long runs", function()
    assert.truthy(bar_after(3):find("%", 1, true))
    assert.truthy(bar_after(3):find("steps in", 1, true))
  end)

  it("is shown on a terminal by default, not elsewhere", function()
    if not program.has "script" then error "the program script is needed" end
    local folder = program.folder()
    local name = program.write(folder .. "/s.lua", [[
      package.loaded["softworld.host"].slow = true
      local sw = require "softworld"
      local progress = require "softworld.output.progress"
      local new = progress.new
      progress.new = function(o)
        io.stdout:write("quiet ", tostring(o.quiet), " after ", tostring(o.after), "\n")
        return new(o)
      end
      local scene = sw.scene{}
      scene:wire{ E = 5e6, density = 1500, radius = 0.0025, from = {0, 0, 0}, to = {1, 0, 0} }
      scene:run{ duration = 0.01 }]])
    local out = program.run{ name }
    assert.truthy(out:find("quiet true", 1, true), out)
    out = program.shell(("TERM=xterm script -qec %s /dev/null </dev/null"):format(
      program.quote(program.quote(program.path) .. " " .. program.quote(name))))
    assert.truthy(out:find("quiet false after 1", 1, true), out)
    program.clean()
  end)
end)

it("the list of unread failures shows the first ones and counts the rest", function()
  local unread = require "softworld.unread"
  unread.finish()
  for i = 1, 30 do unread.add("failure " .. i) end
  local text = unread.finish()
  assert.truthy(text:find("failure 1\n", 1, true))
  assert.truthy(text:find("and 10 more", 1, true))
  assert.is_nil(unread.finish())
  assert.is_table(sw)
end)
