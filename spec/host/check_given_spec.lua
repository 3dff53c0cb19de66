-- SPDX-License-Identifier: GPL-3.0-or-later
-- softworld --check SCRIPT: checks that are given to runs, and those of evaluations that are computed again.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")

local start = [[
local sw = require "softworld"
local function own(max) return { { name = "x", unit = "m", of = function() return 1 end, max = max } } end
local function given(max, trial)
  return { limits = { min_bend_radius = false, max_tension = 9 }, checks = own(max), trial = trial }
end
local function run(args)
  local scene = sw.scene{ name = "s" }
  local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, mass_per_length = 0.03, radius = 0.002,
    from = { 0, 0, 1 }, to = { 0, 0, 0.8 }, segments = 4 }
  scene:clamp(wire, { s = 0 })
  args.duration, args.dt, args.quasistatic = 0.02, not args.check and 0.01 or nil, true
  return scene:run(args), scene
end
local function study(max)
  local study = sw.study{ name = "q", parameters = { L = { 0, 1 } },
    evaluate = function() return (run{}:check(given(max))) end }
  study:sweep{ grid = 2 }
  return study
end
]]

local function check(text)
  local name = program.write(program.folder() .. "/script.lua", start .. text)
  return program.run{ "--check", name }
end

describe("softworld --check", function()
  after_each(program.clean)

  for _, case in ipairs{
    { "a failing one that nothing asks for", 3, "run{ check = given(0.5) }", "1 check: 0 pass, 1 fail" },
    { "a passing one that nothing asks for", 0, "run{ check = given(2) }", "1 check: 1 pass" },
    { "a failing one beside one that passes", 3, "run{ check = given(0.5) }\nrun{}:check(given(2))",
      "2 checks: 1 pass, 1 fail" },
    { "one that the script makes too", 3, "run{ check = given(0.5) }:check()", "1 check: 0 pass, 1 fail" },
    { "one that the script makes twice", 3, "local r = run{ check = given(0.5) }\nr:check()\nr:check()",
      "1 check: 0 pass, 1 fail" },
    { "one that the script makes with the same table", 3,
      "local c = given(0.5)\nlocal r = run{ check = c }\nr:check(c)", "1 check: 0 pass, 1 fail" },
    { "one beside another of the same run", 3, "run{ check = given(0.5) }:check(given(2))",
      "2 checks: 1 pass, 1 fail" },
    { "a trial", 2, "run{ check = given(0.5, true) }", "no check was made" },
    { "two runs of a scene", 3, "local _, scene = run{ check = given(0.5) }\n"
      .. "scene:run{ duration = 0.01, dt = 0.01 }:check(given(2))", "2 checks: 1 pass, 1 fail" },
    { "one in a search", 0, "sw.tune.minimise{ from = 0, to = 1, max_iterations = 3, f = function(x)\n"
      .. "  run{ check = given(0.5) }\n  return x * x\nend }\nrun{}:check(given(2))", "1 check: 1 pass" },
  } do
    it(("counts checks given to runs once, exit code %d: %s"):format(case[2], case[1]), function()
      local _, err, code = check(case[3])
      assert.equal(case[2], code, err)
      assert.truthy(err:find(case[4], 1, true), err)
    end)
  end

  it("still tells of events that the script did not look at", function()
    local _, err, code = check [[
local scene = sw.scene{ name = "soft" }
local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-7, mass_per_length = 0.03, radius = 0.002,
  from = { 0, 0, 1 }, to = { 0.2, 0, 1 }, segments = 6 }
scene:clamp(wire, { s = 0 })
scene:run{ duration = 0.02, quasistatic = true, check = given(2) }]]
    assert.equal(0, code, err)
    assert.truthy(err:find("has 1 event; see run.events: edges", 1, true), err)
  end)

  it("does not count checks of evaluations that study:again computes", function()
    local _, err, code = check "study(0.5):again(1)\nrun{}:check(given(2))"
    assert.equal(0, code, err)
    assert.truthy(err:find("1 check: 1 pass", 1, true), err)
  end)

  it("counts a check of the run that study:again returns", function()
    local _, err, code = check "local _, r = study(2):again(1)\nr:check(given(0.5))"
    assert.equal(3, code, err)
    assert.truthy(err:find("1 check: 0 pass, 1 fail", 1, true), err)
  end)

  for _, case in ipairs{
    { "a process", 3, "scene:process(function() error 'robot fault' end)",
      "scene:run{ duration = 0.02, dt = 0.01 }" },
    { "an observer", 3, "scene:observe{ every = 0.01, call = function() error 'mine' end }",
      "scene:run{ duration = 0.02, dt = 0.01 }" },
    { "a quantity", 3, "local q = { name = 'q', value = 1, of = function() error 'mine' end }",
      "scene:run{ duration = 0.02, quasistatic = true, tolerance = { q } }" },
    { "its arguments", 0, "", "scene:run{ duration = 'long' }" },
  } do
    it("counts a run that ends with an error, also in the script's pcall: of " .. case[1], function()
      local _, err, code = check(("local r, scene = run{}\nr:check(given(2))\n%s\n"
        .. "assert(not pcall(function() %s end))"):format(case[3], case[4]))
      assert.equal(case[2], code, err)
      assert.equal(case[2] == 3, err:find("1 run failed or was cut short", 1, true) ~= nil, err)
    end)
  end

  it("does not count such a run within an evaluation of a study", function()
    local _, err, code = check [[
local study = sw.study{ name = "q", parameters = { L = { 0, 1 } }, evaluate = function()
  local _, scene = run{}
  scene:process(function() error "robot fault" end)
  assert(not pcall(scene.run, scene, { duration = 0.02, dt = 0.01 }))
  return { x = 1 }
end }
study:sweep{ grid = 2 }
run{}:check(given(2))]]
    assert.equal(0, code, err)
  end)
end)
