-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C inside the core: one error for each, and a scene that still works.
local program = require "host.program"

-- Shells start background jobs with SIGINT ignored; env undoes that.
local NORMAL = "env --default-signal=INT"
local ONCE = { before = NORMAL, signals = { 0.4 } }
local SLOW = os.getenv "SOFTWORLD_PRELOAD" and 6 or 1 -- sanitizers are slow [-]
-- two within 1 s would end the program
local TWICE = { before = NORMAL, signals = { 0.4 * SLOW, 1.2 * SLOW } }

local SCENE = [[
local sw = require "softworld"
local scene = sw.scene{}
local wire = scene:wire{ EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
  segments = 40, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
local clamp = scene:clamp(wire, { s = 0 })
local function try(f)
  local ok, message = pcall(f)
  print(ok, (tostring(message):match "interrupted"))
end
local function works()
  local t = scene.time
  local run = scene:run{ duration = 0.1 }
  assert(run.ok and math.abs(scene.time - t - 0.1) < 1e-9)
  assert(#wire:positions() == 123 and wire:max_tension() > 0)
  scene:restore(scene:snapshot())
  scene:pin(wire, { s = 0.5 }):release()
  print "works"
end
]]

local RUNS = {
  ["a run"] = "scene:run{ duration = 1e6, dt = 1e-4 }",
  ["an explicit run"] = "scene:run{ duration = 1e6, dt = scene:stable_dt() / 2, integrator = 'rk4' }",
  ["one call of the core"] = "scene:advance({ dt = 1e-4 }, 1e6)",
  ["an adaptive run"] = "scene:run{ duration = 1e6, tolerance = 1e-9, dt = 1e-3 }",
  ["a run with error bars"] = "scene:run{ duration = 1e6, dt = 1e-4, tolerance = { tip = 1e-9 } }",
  ["a settling with error bars"] = [[
    scene:settle{ levels = 12, tolerance = { { name = 'slow', value = 1, of = function()
      local stop = os.clock() + 0.2
      while os.clock() < stop do end
      return math.random() * 1e3 end } } }]],
  ["a run with a process"] = [[
    scene:process(function(p) while true do p:wait(0.001) end end)
    scene:run()]],
  ["a run with a function as a force"] = [[
    local force <close> = setmetatable({ scene:force{ kind = function(_, _, v, f)
      for i = 1, #f do f[i] = -0.01 * v[i] end end, on = wire } },
      { __close = function(t) t[1]:release() end })
    scene:run{ duration = 1e6, dt = 1e-3 }]],
  ["poses at which jaws obey a force"] = [[
    local g = scene:gripper{ pads = { opening = 0.012 } }
    local held <close> = setmetatable({ g:grasp(wire, { s = 0.5, approach = "plates", force = 1 }) },
      { __close = function() g:release() end })
    scene:run{ duration = 1e6, dt = 0.01, quasistatic = true }]],
  ["a settling without end"] = [[
    local k = 0
    local force <close> = setmetatable({ scene:force{ kind = function(_, _, _, f)
      k = k + 1
      f[#f] = k % 7 end, on = wire } }, { __close = function(t) t[1]:release() end })
    scene:settle{ max_iterations = 1e9 }]],
}

-- No springs can do that; finding this out takes long.
RUNS["a calibration"] = [[
    sw.calibrate{ mesh = "cubic", section = "rectangle", width = 4e-3, height = 5e-2, across = 5, EA = 1e4,
      EI = 1, EI2 = 1e-6, GJ = 1e-9 }]]

local names = {}
for name in pairs(RUNS) do names[#names + 1] = name end
table.sort(names)

-- Returns what the program wrote as errors. Where Ctrl-C stops a whipping wire depends on the
-- machine; the run after it may have a note about a sharp bend.
local function errors(err) return (err:gsub("softworld: note: [^\n]*\n", "")) end

describe("Ctrl-C", function()
  after_each(program.clean)

  for _, name in ipairs(names) do
    it("ends " .. name .. ", again and again", function()
      local body = "try(function() " .. RUNS[name] .. " end)\nworks()\n"
      local out, err, code = program.script(SCENE .. body .. body, nil, TWICE)
      assert.equal("", errors(err))
      assert.equal(("false\tinterrupted\nworks\n"):rep(2), out)
      assert.equal(0, code)
    end)
  end

  it("in the middle of a step leaves the scene with the same bits as without it", function()
    local out, err, code = program.script([[
      local sw = require "softworld"
      local function make()
        local scene = sw.scene{}
        local wire = scene:wire{ EA = 6000, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
          segments = 20000, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
        scene:clamp(wire, { s = 0 })
        return scene, wire
      end
      local scene, wire = make()
      local k, stops = 1, 0
      while stops < 2 do
        local ok, message = pcall(function()
          while true do
            scene:advance({ dt = 1e-3 }, k * 1e-3)
            k = k + 1
          end
        end)
        assert(message:match "interrupted", message)
        stops = stops + 1
      end
      scene:advance({ dt = 1e-3 }, k * 1e-3)
      local other, same = make()
      for i = 1, k do other:advance({ dt = 1e-3 }, i * 1e-3) end
      local a, b, different = wire:positions(), same:positions(), 0
      for i = 1, #a do if a[i] ~= b[i] then different = different + 1 end end
      print(#a, different)
    ]], nil, TWICE)
    assert.equal("", err)
    assert.equal("60003\t0\n", out)
    assert.equal(0, code)
  end)

  it("names the line that ran if nobody catches the error", function()
    local _, err, code = program.script(SCENE .. "scene:run{ duration = 1e6, dt = 1e-4 }", nil, ONCE)
    local line = select(2, SCENE:gsub("\n", "")) + 1
    assert.equal(130, code)
    assert.matches("script.lua:" .. line .. ": interrupted", err:match "[^\n]*")
  end)

  it("names the script's line if it comes inside a function of the library", function()
    local _, err, code = program.script("local sw = require 'softworld'\n"
      .. "while true do sw.cable 'GXL 1.5' end", nil, ONCE)
    assert.equal(130, code)
    assert.matches("^[^:]*script.lua:2: interrupted$", err:match "[^\n]*")
  end)
end)

describe("a Ctrl-C whose error the script's own function catches", function()
  after_each(program.clean)

  -- Sends one to the program itself, and catches its error.
  local CATCH = "local function catch() pcall(function() io.popen('kill -s INT $PPID'):close() "
    .. "for _ = 1, 1e8 do end end) end\n"

  it("ends a search of tune.minimise", function()
    for _, where in ipairs { "from = 0, to = 1", "start = 0.5" } do
      local out, err, code = program.script("local sw = require 'softworld'\n" .. CATCH .. [[
        local found = sw.tune.minimise { ]] .. where .. [[, f = function(x)
          print "call"
          catch()
          return x
        end }
        print(found)]], nil, { before = NORMAL })
      assert.equal("call\n", out)
      assert.matches("interrupted", err)
      assert.equal(130, code)
    end
  end)

  it("ends a study, which does not keep that evaluation", function()
    local file = program.folder() .. "/caught.study"
    local text = "local sw = require 'softworld'\n" .. [[
      local number = 0
      local study = sw.study { name = "caught", file = arg[1], parameters = { a = { 0, 1 } },
        evaluate = function(p)
          number = number + 1
          if number == 3 and not io.open(arg[1] .. ".caught") then
            io.open(arg[1] .. ".caught", "w"):close()
            pcall(function() io.popen("kill -s INT $PPID"):close() for _ = 1, 1e8 do end end)
            return { y = 1e9 }
          end
          return { y = p.a }
        end }
      study:sweep { grid = 5, workers = 0 }
      print(number)]]
    local _, err, code = program.script(text, { file }, { before = NORMAL })
    assert.matches("study 'caught' was interrupted", err)
    assert.equal(130, code)
    local out, _, again = program.script(text, { file }, { before = NORMAL })
    assert.equal("3\n", out) -- two were kept; the third is evaluated again
    assert.equal(0, again)
  end)
end)
