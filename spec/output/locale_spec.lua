-- SPDX-License-Identifier: GPL-3.0-or-later
-- Numbers have a decimal point in all output and input, also in locales with a decimal comma.
local program = require "host.program"

-- A locale "comma" that differs from the usual one only in its numbers: glibc's file of this category, six
-- texts behind their offsets. So the spec needs no locale of the system.
local function make_locale()
  local folder = program.folder()
  os.execute("mkdir " .. program.quote(folder .. "/comma"))
  local texts = { ",\0", ".\0", "\3\3\0\0", string.pack("<I4", 44), string.pack("<I4", 46),
    "ANSI_X3.4-1968\0" }
  program.write(folder .. "/comma/LC_NUMERIC", string.pack("<I4I4I4I4I4I4I4I4", 0x20031114, 6, 32, 34, 36,
    40, 44, 48) .. table.concat(texts))
  return "LOCPATH=" .. program.quote(folder)
end

-- Everything that writes or reads numbers, into the folder of the first argument.
local WORK = [[
local folder, locale, when = ...
if locale and when == "before" then assert(os.setlocale(locale, "numeric")) end
local sw = require "softworld"
if locale and when == "after" then assert(os.setlocale(locale, "numeric") == locale) end
local function put(name, text)
  local file = assert(io.open(folder .. "/" .. name, "wb"))
  file:write(text)
  file:close()
end
local trajectory = sw.trajectory{ points = { { 0, 0, 0 }, { 0.3, 0.25, 0 } }, speed = 0.2 }
trajectory:save(folder .. "/path.csv", 5)
local again = sw.trajectory{ path = folder .. "/path.csv" }
local scene = sw.scene{ name = "numbers" }
scene:obstacle{ shape = "plane", friction = 0.3 }
local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.0015 }, to = { 0.25, 0, 0.0015 }, segments = 10 }
local hand = scene:gripper{ name = "hand" }
scene:process(function(p)
  hand:grasp(wire, { s = 0.03 })
  hand:move{ by = { 0.05, 0, 0.0125 }, speed = 0.2 }
end)
local run = scene:run{ dt = 0.0125, frame = 0.05 }
run:save(folder .. "/run.csv")
run:save(folder .. "/run.json")
run:vtk(folder .. "/run.pvd")
run:chart{ path = folder .. "/run.svg" }
put("chart.txt", run:chart())
run:pictures{ path = folder .. "/run.png", count = 1, draft = true, width = 300 }
scene:save(folder .. "/scene.sws")
local loaded = sw.load(folder .. "/scene.sws")
put("texts.txt", table.concat({ tostring(sw.cable "GXL 1.5"), tostring(sw.cables()), tostring(wire),
  tostring(scene), tostring(loaded:names()[1]), tostring(run.time), 1.5 .. "", ("%.3f %g"):format(2.5, 0.125),
  tostring(tonumber "2.5"), (select(2, pcall(scene.wire, scene, { radius = -0.125 })):gsub("^.-:%d+: ", "")),
  again:sample(3).position[4] }, "\n"))
]]

describe("numbers in a locale with a decimal comma", function()
  after_each(program.clean)

  local function work(...)
    local folder = program.folder()
    local out, err, code = program.script(WORK, { folder, ... }, { before = make_locale() })
    assert.equal("", err)
    assert.equal(0, code)
    return folder, out
  end

  it("are the same as elsewhere, in every file and text", function()
    local usual, said = work()
    local names = program.shell(("cd %s && find . -type f"):format(program.quote(usual)))
    assert.matches("run.csv", names)
    assert.matches("run.vtk/wires", names)
    for _, when in ipairs { "before", "after" } do
      local folder, out = work("comma", when)
      assert.equal(said, out)
      for name in names:gmatch "[^\n]+" do
        local a, b = program.read(usual .. "/" .. name), program.read(folder .. "/" .. name)
        -- POV-Ray's rays are slightly random: only the sizes of pictures are compared. It cannot read a
        -- comma
        if name:find "%.png$" then a, b = a:match "IHDR........", b:match "IHDR........" end
        -- a saved scene has clock times; the script itself has read it back
        if not name:find "%.sws$" then
          a, b = a:gsub('"[cw][pa][ul]l?":[%d.e-]+', ""), b:gsub('"[cw][pa][ul]l?":[%d.e-]+', "")
          assert.is_true(a == b, name .. " with the locale set " .. when)
        end
      end
    end
  end)

  it("leave os.setlocale unchanged for everything else", function()
    local out, err = program.script([[
      local core = require "softworld.core"
      print(os.setlocale("comma", "numeric"), os.setlocale(nil, "numeric"), 1.5, os.setlocale("no such"))
      print(os.setlocale("C"), os.setlocale(), tonumber "1.5", tonumber "1,5", pcall(os.setlocale, {}))
      print(os.setlocale("C.UTF-8", "ctype") or "C.UTF-8", 2.5)
    ]], nil, { before = make_locale() })
    assert.equal("", err)
    assert.matches("^comma\tcomma\t1.5\tnil\nC\tC\t1.5\tnil\tfalse\tbad argument #1 [^\n]*\n"
      .. "C.UTF%-8\t2.5\n$", out)
  end)

  it("are the same in the stock interpreter", function()
    assert.is_true(program.has "lua5.4", "the package lua5.4 is missing")
    local folder = program.path:match "^(.*)/" or "."
    local sanitizer = os.getenv "SOFTWORLD_PRELOAD"
    local out, err = program.script([[
      assert(os.setlocale("comma", "numeric"))
      io.write(1.5, " ")
      local sw = require "softworld"
      print(1.5, tostring(sw.cable "GXL 1.5"):find("%d%.%d") ~= nil)
    ]], nil, { path = "lua5.4", before = ("%s LUA_CPATH=%s LUA_PATH=%s %s"):format(make_locale(),
      program.quote(folder .. "/lib/?.so"), program.quote(program.root .. "/lua/?.lua;" .. program.root
      .. "/lua/?/init.lua"), sanitizer and "ASAN_OPTIONS=detect_leaks=0 LD_PRELOAD="
      .. program.quote(sanitizer) or "") })
    assert.equal("", err)
    assert.equal("1,5 1.5\ttrue\n", out)
  end)
end)
