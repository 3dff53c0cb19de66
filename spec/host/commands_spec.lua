-- SPDX-License-Identifier: GPL-3.0-or-later
-- softworld new, softworld lint, softworld --log FILE.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local lfs = require "lfs"
local quote = program.quote

local path = program.path:find "^/" and program.path or lfs.currentdir() .. "/" .. program.path

local function run(folder, words)
  -- the limit [s] is for programs that hang
  return program.shell(("cd %s && timeout 300 %s %s"):format(quote(folder), quote(path), words))
end

local function lint(text)
  local folder = program.folder()
  program.write(folder .. "/s.lua", text)
  return run(folder, "lint s.lua")
end

local start = 'local sw = require "softworld"\nlocal s = sw.scene{}\n'
local wire = "local w = s:wire{ name = 'w', E = 5e7, density = 1500, radius = 0.0025, from = {0, 0, 0.1}, "
  .. "to = {1, 0, 0.1}, segments = %d }\n"

describe("softworld new", function()
  after_each(program.clean)

  it("writes a script that runs and passes lint without warnings", function()
    local folder = program.folder()
    local name = "it's \"my\" lay $x"
    local out, err, code = run(folder, "new " .. quote(name))
    assert.same({ 0, "" }, { code, err })
    assert.truthy(out:find("wrote " .. name .. ".lua", 1, true))
    out, err, code = run(folder, "lint " .. quote(name .. ".lua"))
    assert.same({ 0, "", name .. ".lua: 0 warnings, 1 scene\n" }, { code, err, out })
    out, err, code = run(folder, quote(name .. ".lua"))
    assert.equal(0, code, err)
    assert.truthy(out:find "peak force of the gripper: [%d.]+ N")
    for _, kind in ipairs { ".png", ".html" } do
      assert.truthy(#program.read(folder .. "/" .. name .. kind) > 10000)
    end
  end)

  it("never overwrites a file, and reports wrong names", function()
    local folder = program.folder()
    program.write(folder .. "/a.lua", "mine")
    local _, err, code = run(folder, "new a")
    assert.equal(1, code)
    assert.truthy(err:find("a.lua is there already", 1, true), err)
    assert.equal("mine", program.read(folder .. "/a.lua"))
    for words, wanted in pairs { [""] = { 2, "wants a name" }, ["a b"] = { 2, "one name" },
      ["no/b"] = { 1, "No such file" }, ["'x\ny'"] = { 2, "control characters" },
      ["-x"] = { 2, "no option '-x'" }, ["--"] = { 2, "no option '--'" } } do
      _, err, code = run(folder, "new " .. words)
      assert.equal(wanted[1], code)
      assert.truthy(err:find(wanted[2], 1, true), err)
    end
  end)
end)

describe("softworld new, doc, lint", function()
  after_each(program.clean)

  it("show the program's help on request, and write nothing", function()
    local folder = program.folder()
    for _, words in ipairs { "new --help", "new -h", "doc --help", "lint -h" } do
      local out, err, code = run(folder, words)
      assert.same({ 0, "" }, { code, err })
      assert.truthy(out:find("usage: softworld", 1, true))
    end
    for name in lfs.dir(folder) do assert.truthy(name == "." or name == "..", name) end
  end)
end)

describe("softworld lint", function()
  after_each(program.clean)

  local thin = "s:obstacle{ name = 'wall', shape = 'box', size = {%g, 1, 0.4}, at = {0.53, 0, 0} }\n"
  local cases = {
    { "a wire through a wall thinner than any two points of it are apart", wire:format(1000)
      .. thin:format(0.002),
      "s.lua:3: wire 'w' goes through 'wall': at s = 0.52" },
    { "edges longer than a wall is thick",
      "s:obstacle{ name = 'wall', shape = 'box', size = {0.01, 1, 0.02}, "
      .. "at = {0.5, 0, 0} }\n" .. wire:format(20),
        "s.lua:4: wire 'w': its edges of 50 mm are longer than 'wall' "
      .. "is thick, 10 mm; segments = 100" },
    { "edges longer than the radius of a peg", wire:format(20) .. "s:obstacle{ name = 'peg', "
      .. "shape = 'cylinder', radius = 0.01, length = 1, at = {0.5, 0, -1} }",
        "longer than the radius of 'peg'" },
    { "a bending stiffness that no material has", "s:wire{ EI = 1, EA = 1e4, mass_per_length = 0.03, "
      .. "radius = 0.0025, from = {0, 0, 0}, to = {1, 0, 0} }",
        "EI = 1 N m2 with a radius of 2.5 mm is a modulus of "
      .. "3.3e+10 Pa", false },
    { "an axial stiffness that no material has", "s:wire{ EI = 1e-3, EA = 1e9, mass_per_length = 0.03, "
      .. "radius = 0.0025, from = {0, 0, 0}, to = {1, 0, 0} }",
        "s.lua:3: wire 'wire1': EA = 1e+09 N with a radius of "
      .. "2.5 mm is a modulus of 5.1e+13 Pa" },
    { "a mass that no material has", "s:wire{ EI = 1e-3, EA = 1e5, mass_per_length = 30, "
      .. "radius = 0.0025, from = {0, 0, 0}, to = {1, 0, 0} }",
        "30 kg/m with a radius of 2.5 mm is a density" },
    { "holds side by side", wire:format(100) .. "s:clamp(w, { s = 0, name = '50%s' })\n"
      .. "s:pin(w, { s = 0.001 })", "s = 0.001 m is beside clamp '50%s' at s = 0 m, nearer than" },
    { "wires that roll where nothing rubs", "s:wire{ E = 5e7, density = 1500, radius = 0.0025, rolls = true, "
      .. "from = {0, 0, 9}, to = {1, 0, 9} }", "s.lua:3: wire 'wire1': rolls = true costs twice as much" },
    { "units", "s:wire{ E = 5e7, density = 1500, radius = 2.5, from = {0, 0, 9}, to = {50, 0, 9} }",
      "s.lua:3: wire 'wire1': radius = 2.5 m is above 0.1 m; did you mean sw.units.mm(2.5)?" },
  }
  for _, case in ipairs(cases) do
    it("warns of " .. case[1], function()
      local out, err, code = lint(start .. case[2])
      if case[4] == false then -- stiff, but not stiffer than steel
        return assert.is_nil(out:find(case[3], 1, true), out)
      end
      assert.same({ 1, "" }, { code, err })
      assert.truthy(out:find(case[3], 1, true), out)
    end)
  end

  it("has no warning for a wire that lies on a table beside a wall", function()
    local out, err, code = lint(start .. wire:format(100):gsub("0%.1}", "0.0025}")
      .. "s:obstacle{ shape = 'plane' }\n"
      .. "s:obstacle{ shape = 'box', size = {1, 0.1, 0.1}, at = {0.5, 0.0525, 0.05} }\n")
    assert.same({ 0, "", "s.lua: 0 warnings, 1 scene\n" }, { code, err, out })
  end)

  it("runs nothing, and continues after the calls of run", function()
    local started = os.clock()
    local out, err, code = lint(start .. wire:format(100) .. [[
local run = s:run{ duration = 1e6, dt = 1e-4 }
assert(run.ok, run.reason)
print(run.time + 1, #run.events, run:series().time[1] < 2)
run:save "run.csv"
local two = sw.scene{}
two:wire{ E = 5, density = 1500, radius = 0.0025, from = {0, 0, 0}, to = {1, 0, 0} }
sw.plot{ run, path = "x.svg" }
]])
    assert.is_true(os.clock() - started < 60)
    assert.same({ 1, "" }, { code, err })
    assert.truthy(out:find("s.lua:9: wire 'wire1': E = 5 Pa", 1, true), out)
    assert.truthy(out:find("1 warning, 2 scenes", 1, true), out)
    assert.is_nil(out:find("nil", 1, true))
  end)

  it("says where it had to stop, and reports errors of the script", function()
    local out, err, code = lint(start .. wire:format(100)
      .. "local run = s:run{ duration = 1 }\nlocal x = ('%g'):format(run.time)\n")
    assert.same({ 0, "" }, { code, err })
    assert.truthy(out:find("s.lua:5: looked at as far as here", 1, true), out)
    out, err, code = lint(start .. "s:wire{ radios = 1 }")
    assert.equal(1, code, out)
    assert.truthy(err:find("s.lua:3: ", 1, true) and err:find("did you mean 'radius'?", 1, true), err)
    out, err, code = lint "this is no Lua"
    assert.equal("", (out:gsub("^s.lua: 0 warnings, 0 scenes\n$", "")))
    assert.equal(1, code)
    assert.truthy(err:find("s.lua:1: ", 1, true), err)
    local folder = program.folder()
    for words, wanted in pairs { ["lint"] = 2, ["lint none.lua"] = 1, ["lint ."] = 1 } do
      assert.equal(wanted, (select(3, run(folder, words))), words)
    end
  end)

  it("has no warning for the examples", function()
    local examples, count = lfs.currentdir() .. "/examples/", 0
    for name in lfs.dir(examples) do
      if name:find "%.lua$" then
        local out, err, code = run(program.folder(), "lint " .. quote(examples .. name))
        assert.same({ 0, "" }, { code, err }, name .. out)
        assert.truthy(out:find(": 0 warnings, %d scene"), out)
        count = count + 1
      end
    end
    assert.is_true(count >= 25)
  end)

  it("still reads the measurements of a calibration, whose wires are not the script's", function()
    local call = "sw.calibration { outer_diameter = 0.004, mass_per_length = 0.02, %s = "
      .. "{ length = 1, to = { 0.9, 0 }, points = { { 0.3, -0.1 }, { 0.5, -0.2 }, { 0.6, -0.2 } } } }\n"
    local out, err, code = lint(start .. call:format "sag" .. wire:format(100))
    assert.same({ 0, "", "s.lua: 0 warnings, 1 scene\n" }, { code, err, out })
    err, code = select(2, lint(start .. call:format "sags"))
    assert.equal(1, code)
    assert.truthy(err:find("s.lua:3: ", 1, true) and err:find("did you mean 'sag'?", 1, true), err)
  end)

  describe("in loops over results of runs", function()
    local bad = "sw.scene{}:wire{ E = 5, density = 1500, radius = 0.0025, from = {0, 0, 0}, "
      .. "to = {1, 0, 0} }\n"
    local run_it = start .. wire:format(100) .. "local run = s:run{ duration = 1 }\n"

    it("goes once over a list, and continues", function()
      local out, err, code = lint(run_it .. "local n = 0\n"
        .. "for k, e in ipairs(run.events) do n = n + 1 print(k, e.text) end assert(n == 1)\n"
        .. "for k, x in ipairs { 4, 5 } do assert(x == k + 3) end\n"
        .. "for i = 1, #run.events do print(run.events[i].text) end\n" .. bad)
      assert.same({ 1, "" }, { code, err })
      assert.truthy(out:find("s.lua:9: wire 'wire1': E = 5 Pa", 1, true), out)
    end)

    local loops = {
      { "repeat local x = 1 until run.time < x", 5 },
      { "while run do local x = run.events[1] end", 5 },
      { "for x in run:series() do print(x) end", 5 },
      { "while s.time < 1 do s:advance{ duration = 0.1 } end", 5 },
      { "repeat\nlocal t = sw.scene{} t:wire{ E = 5e7, density = 1500, radius = 0.0025, from = {0, 0, 0}, "
        .. "to = {1, 0, 0} }\nuntil t:run{ duration = 1 }.time < 1", 7 },
      { "repeat local fine = pcall(function() assert(run.time < 1) end) until fine", 5 }, -- swallows errors
      { "local v = s:view{} v:wait() repeat until v.pages < 1", 5 },
    }
    for _, case in ipairs(loops) do
      it("ends " .. case[1]:sub(1, 40), function()
        local folder = program.folder()
        program.write(folder .. "/s.lua", bad:gsub("^sw", "require 'softworld'") .. run_it .. case[1] .. "\n")
        local out, err, code = run(folder, "lint s.lua")
        assert.same({ 1, "" }, { code, err }, out)
        assert.truthy(out:find("s.lua:1: wire 'wire1': E = 5 Pa", 1, true), out)
        assert.truthy(out:find(("s.lua:%d: looked at as far as here, since runs were left out (a loop "
          .. "seems to wait for the result of a run; it "):format(case[2] + 1), 1, true), out)
      end)
    end

    it("is stopped by Ctrl-C, with what was found until then", function()
      local folder = program.folder()
      program.write(folder .. "/s.lua", bad:gsub("^sw", "require 'softworld'") .. "while true do end\n")
      local out, err, code = program.run({ "lint", folder .. "/s.lua" },
        { before = "env --default-signal=INT", signals = { 0.3 } })
      assert.equal(130, code)
      assert.truthy(err:find("s.lua:2: interrupted", 1, true), err)
      assert.truthy(out:find("E = 5 Pa", 1, true), out)
    end)
  end)
end)

describe("softworld --log", function()
  after_each(program.clean)

  it("appends each run and its end, with remarks and errors", function()
    local folder = program.folder()
    program.write(folder .. "/s.lua", start .. wire:format(10) .. [[
s:obstacle{ shape = "plane", friction = 30, at = {0, 0, -9} }
s:clamp(w, { s = 0 })
print "printed"
s:settle()
local run = s:run{ duration = 0.01, dt = 0.01 }
local failed = s:run{ duration = 1, dt = 1.2 * s:stable_dt(), integrator = "velocity-verlet",
  unstable = true }
]])
    local _, plain, code_without = run(folder, "s.lua")
    local out, err, code = run(folder, "--log log s.lua")
    assert.equal("printed\n", out)
    assert.same({ code_without, plain }, { code, err }) -- the failed run is reported as before
    run(folder, "--log log -e 'error \"two\\nlines\"'")
    local text = program.read(folder .. "/log")
    for line in text:gmatch "[^\n]+" do
      assert.truthy(line:find "^%d+%-%d%d%-%d%d %d%d:%d%d:%d%d  " or line:find "^    ", line)
    end
    for _, wanted in ipairs { "s.lua, SoftWorld ", "remark: obstacle 'plane1': friction = 30",
      "scene:settle of 'scene'",
      "scene:run of 'scene', from t = 0 s", "run of 'scene': ok (", "run of 'scene': FAILED (",
      "the script did not look at run.ok", "-e:1: two\n    lines" } do
      assert.truthy(text:find(wanted, 1, true), wanted .. "\n" .. text)
    end
  end)

  it("reports when the file cannot be written", function()
    local folder = program.folder()
    local _, err, code = run(folder, "--log no/log -e 'print(1)'")
    assert.equal(1, code)
    assert.truthy(err:find("cannot write the log: no/log: No such file", 1, true), err)
    local out
    out, err, code = run(folder, "--log /dev/full -e 'print(1)'") -- continues without the log
    assert.same({ "1\n", 0 }, { out, code })
    assert.truthy(err:find("cannot write the log /dev/full: No space left", 1, true), err)
    assert.equal(2, (select(3, run(folder, "--log"))))
    out = run(folder, "--log -e -e 'print(2)'")
    assert.equal("2\n", out)
    assert.truthy(program.read(folder .. "/-e"):find "SoftWorld")
  end)
end)
