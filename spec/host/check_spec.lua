-- SPDX-License-Identifier: GPL-3.0-or-later
-- softworld --check SCRIPT: the exit code gives the verdict of the script's checks.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")

local start = [[
local sw = require "softworld"
local scene = sw.scene{ name = "s" }
local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 }, segments = 8 }
local none = { max_sidewall = false }
local function own(max) return { { name = "x", unit = "m", of = function() return 1 end, max = max } } end
local function run(args)
  args = args or { duration = 0.02 }
  args.dt = 0.01
  return scene:run(args)
end
]]

local function check(text, arguments)
  local name = program.write(program.folder() .. "/script.lua", start .. text)
  return program.run{ "--check", name, table.unpack(arguments or {}) }
end

describe("softworld --check", function()
  after_each(program.clean)

  for _, case in ipairs{
    { "all pass", 0, "run():check{ limits = none, checks = own(2) }", "1 check: 1 pass, 0 fail, 0 open" },
    { "a row fails", 3, "run():check{ limits = none, checks = own(0.5) }", "1 check: 0 pass, 1 fail" },
    { "a row is open", 4, "run():check{ limits = none, checks = own() }", "0 fail, 1 open" },
    { "one fails, one is open", 3, "run():check{ limits = none, checks = own() }\n"
      .. "run():check{ limits = none, checks = own(0.5) }", "2 checks: 0 pass, 1 fail, 1 open" },
    { "no check", 2, "run()", "no check was made" },
    { "no check and not even the library", 2, "print 'x'", "no check was made" },
    { "a script error", 1, "run():check{ limits = none, checks = own(2) }\nerror 'mine'", "mine" },
    { "wrong arguments of a check", 1, "run():check{ limit = 1 }", "did you mean 'limits'?" },
    { "a run cut short", 3, "run{ duration = 1, max_steps = 3 }:check{}", "1 fail" },
    { "a run cut short beside a check that passes", 3, "run{ duration = 1, max_steps = 3 }\n"
      .. "run():check{ limits = none }", "1 run failed or was cut short" },
    { "a row fails, and the script leaves early", 3, "run():check{ limits = none, checks = own(0.5) }\n"
      .. "os.exit(0)", "1 fail" },
    { "a row fails, and the script leaves as one that is well", 3,
      "run():check{ limits = none, checks = own(0.5) }\nos.exit(true, true)", "1 fail" },
    { "the script leaves with a code of its own", 7, "run():check{ limits = none }\nos.exit(7)", "1 pass" },
    { "a check that is a trial", 2, "run():check{ trial = true, checks = own(0.5) }", "no check was made" },
    { "a trial, then one that counts", 0, "run():check{ trial = true, checks = own(0.5) }\n"
      .. "run():check{ limits = none, checks = own(2) }", "1 check: 1 pass" },
  } do
    it(("exits with %d: %s"):format(case[2], case[1]), function()
      local _, err, code = check(case[3])
      assert.equal(case[2], code, err)
      assert.truthy(err:find(case[4], 1, true), err)
    end)
  end

  local wild = [[
local bad = sw.scene{ name = "wild" }
local b = bad:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = {0, 0, 0.1},
  to = {0.5, 0, 0.1} }
bad:clamp(b, { s = 0 })
local r = bad:run{ duration = 1, dt = 1.2 * bad:stable_dt(), integrator = "velocity-verlet", unstable = true }
]]

  it("exits with 3 when a run failed, whether or not the script looked at it or checked it", function()
    for _, rest in ipairs{ "", "assert(not r.ok)", "print(r:check{})" } do
      local _, err, code = check(wild .. rest .. "\nrun():check{ limits = none, checks = own(2) }")
      assert.equal(3, code, err)
    end
    local _, err, code = check(wild .. "assert(not r.ok)")
    assert.equal(3, code, err)
  end)

  it("does not count the checks of runs that a search tries", function()
    local _, err, code = check([[
      sw.tune.minimise{ from = 0, to = 1, max_iterations = 3, f = function(x)
        run():check{ limits = none, checks = own(x - 1) }
        return x * x
      end }
      run():check{ limits = none, checks = own(2) }]])
    assert.equal(0, code, err)
    assert.truthy(err:find("1 check: 1 pass", 1, true), err)
  end)

  it("keeps the exit code unchanged without the option", function()
    local name = program.write(program.folder() .. "/script.lua", start
      .. "run():check{ limits = none, checks = own(0.5) }")
    local _, err, code = program.run{ name }
    assert.same({ 0, "" }, { code, err })
  end)

  it("passes the arguments to the script", function()
    local out, _, code = check("print(arg[1])\nrun():check{ limits = none }", { "--check" })
    assert.same({ 0, "--check\n" }, { code, out })
  end)

  it("needs a script, and refuses the prompt and the view", function()
    for words, wanted in pairs{ ["--check"] = "a script is missing after", ["--check -e 'x=1'"] =
      "a script is missing after", ["--check -i a.lua"] = "neither -i nor --view goes with",
      ["--check --view a.lua"] = "neither -i nor --view goes with" } do
      local _, err, code = program.shell(program.quote(program.path) .. " " .. words .. " </dev/null")
      assert.equal(2, code)
      assert.truthy(err:find(wanted, 1, true), err)
    end
  end)
end)
