-- SPDX-License-Identifier: GPL-3.0-or-later
-- A small part of the work that scripts/fuzz_files.lua does for hours: damaged files of every kind.
local program = require "host.program"

local SCRIPT = program.root .. "/scripts/fuzz_files.lua"

describe("damaged files", function()
  for _, seed in ipairs { 1, 2, 3 } do
    it("load, or give an error that names them: seed " .. seed, function()
      local out, _, code = program.run { SCRIPT, "--seed", tostring(seed), "--bytes", "6e5", "--quiet" }
      assert.equal(0, code, out)
      local cases, bytes, refused = out:match "(%d+) cases, (%d+) bytes, (%d+) refused, 0 found\n$"
      assert.is_true(tonumber(cases) > 20, out)
      assert.is_true(tonumber(bytes) >= 6e5)
      assert.is_true(tonumber(refused) > 10 and tonumber(refused) < tonumber(cases))
    end)
  end

  it("are made again from their seed and number", function()
    local folder = program.folder()
    for k = 1, 2 do
      local out, err, code = program.shell(("cd %s && %s %s --seed 5 --case 7"):format(program.quote(folder),
        program.quote((io.popen("realpath " .. program.quote(program.path)):read "l")),
        program.quote((io.popen("realpath " .. program.quote(SCRIPT)):read "l"))))
      assert.equal("", err)
      assert.equal(0, code, out)
      assert.matches("bytes, re", out)
      program.shell(("mv %s/fuzz_case.* %s/kept%d"):format(folder, folder, k))
    end
    assert.is_true(program.read(folder .. "/kept1") == program.read(folder .. "/kept2"))
    assert.is_true(#program.read(folder .. "/kept1") > 0)
    program.clean()
  end)

  it("are reported when they end the program", function()
    local folder = program.folder()
    local text, count = program.read(SCRIPT):gsub("math%.randomseed%(seed, number%)",
      "%0\n  if number == 9 then os.exit(3, true) end")
    assert.equal(1, count)
    program.write(folder .. "/fuzz_corpus.lua", program.read(program.root .. "/scripts/fuzz_corpus.lua"))
    local out, _, code = program.run { program.write(folder .. "/f.lua", text), "--bytes", "6e4", "--quiet" }
    assert.equal(1, code)
    assert.matches("FOUND %-%-seed 1 %-%-case 9 %(%a+%): the program ended with exit 3\n", out)
    assert.matches("1 found\n$", out)
    program.clean()
  end)
end)
