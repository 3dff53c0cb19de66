-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scripts, options, arguments and exit codes.

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local run, script = program.run, program.script

describe("softworld script.lua", function()
  after_each(program.clean)

  it("gives the script its arguments", function()
    local out, err, code = script("print(..., #arg, arg[2], arg[-1] ~= nil)", { "a b", "c" })
    assert.equal("a b\t2\tc\ttrue\n", out)
    assert.equal("", err)
    assert.equal(0, code)
  end)

  it("numbers arg as the stock interpreter does", function()
    local name = program.folder() .. "/s.lua"
    program.write(name, "print(arg[0], arg[1], arg[-1], arg[-2], arg[-3])")
    local out = run({ "-e", "x = 1", name, "one" })
    assert.equal(("%s\tone\tx = 1\t-e\t%s\n"):format(name, program.path), out)
  end)

  it("skips a first line with #!", function()
    local out, err, code = script "#!/usr/bin/env softworld\nprint 'here' error 'there'"
    assert.equal("here\n", out)
    assert.equal("script.lua:2: there\n", err)
    assert.equal(1, code)
  end)

  it("finds modules beside the script", function()
    local folder = program.folder()
    program.write(folder .. "/beside.lua", "return 'found'")
    local name = program.write(folder .. "/s.lua", "print((require 'beside'))")
    assert.equal("found\n", (run { name }))
  end)

  it("finds its own library before one beside the script", function()
    local folder = program.folder()
    os.execute("mkdir -p " .. folder .. "/softworld/prompt")
    program.write(folder .. "/softworld/prompt/pretty.lua", "return 'wrong'")
    local name = program.write(folder .. "/s.lua", "print(type(require 'softworld.prompt.pretty'))")
    assert.equal("function\n", (run { name }))
  end)

  it("accepts very long lines and zero bytes", function()
    local text = ("x"):rep(300000)
    local out, _, code = script("local s = '" .. text .. "\0'  print(#s)")
    assert.equal("300001\n", out)
    assert.equal(0, code)
  end)

  it("reports a missing file, a folder and binary code", function()
    local _, err, code = run { "/no/such.lua" }
    assert.equal("softworld: cannot run '/no/such.lua': No such file or directory\n", err)
    assert.equal(1, code)
    local name = program.write(program.folder() .. "/cell.lua", "print(1)"):gsub("%.lua$", "")
    _, err = run { name }
    assert.equal(("softworld: cannot run '%s': No such file or directory; did you mean 'softworld %s.lua'?\n")
      :format(name, name), err)
    _, err = run { "docs" }
    assert.matches("did you mean 'softworld doc'%?\n$", err)
    _, err, code = run { "/" }
    assert.equal("softworld: cannot run '/': it is a directory\n", err)
    assert.equal(1, code)
    _, err, code = script(string.dump(function() return 1 end))
    assert.matches("^softworld: cannot run '[^']*script%.lua': it is compiled Lua; run its source\n$", err)
    assert.equal(1, code)
  end)

  it("ends with the code given to os.exit", function()
    local _, _, code = script "os.exit(7)"
    assert.equal(7, code)
    _, _, code = script "os.exit(9, true)"
    assert.equal(9, code)
    _, _, code = script "os.exit(true, true)"
    assert.equal(0, code)
  end)

  it("fails when its output cannot be written", function()
    local _, err, code = program.shell(program.quote(program.path) .. " -e 'print(1)' >/dev/full")
    assert.equal("softworld: cannot write the output: No space left on device\n", err)
    assert.equal(1, code)
  end)

  -- ulimit -f counts blocks of 512 or 1024 B; the page of a run has more than 1 MB.
  it("goes on after a file that grew beyond the limit of files, and leaves nothing of it", function()
    local folder = program.folder()
    local name = program.write(folder .. "/s.lua", [[
      local scene = require "softworld".scene{}
      local wire = scene:wire{ E = 1e7, density = 1000, radius = 0.002, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      local run = scene:run{ duration = 0.02 }
      local fine, why = pcall(run.report, run, ... .. "/page.html")
      print(fine, why:match "page.html: (.*)")
    ]])
    local out, err, code = program.shell(("ulimit -f 8; %s %s %s"):format(program.quote(program.path),
      program.quote(name), program.quote(folder)))
    assert.equal("false\tFile too large\n", out)
    assert.same({ "", 0 }, { err, code })
    assert.equal("s.lua\n", (program.shell("ls " .. program.quote(folder))))
  end)
end)

describe("softworld options", function()
  after_each(program.clean)

  it("run -e codes in order, then the script", function()
    local name = program.write(program.folder() .. "/s.lua", "print(x, ...)")
    local out, _, code = run { "-e", "x = 1", "-ex = x + 1", name, "-e" }
    assert.equal("2\t-e\n", out)
    assert.equal(0, code)
  end)

  it("stop at the first -e that fails", function()
    local out, err, code = run { "-e", "error 'no'", "-e", "print 'never'" }
    assert.equal("", out)
    assert.equal("-e:1: no\n", err)
    assert.equal(1, code)
  end)

  it("read a script from standard input", function()
    local source = "print('in', ...)"
    assert.equal("in\n", (run({}, { stdin = source })))
    assert.equal("in\ta\n", (run({ "-", "a" }, { stdin = source })))
    local _, err, code = run({}, { stdin = "\n\nx = = 1" })
    assert.equal("stdin:3: unexpected symbol near '='\n", err)
    assert.equal(1, code)
  end)

  it("end at --", function()
    local folder = program.folder()
    program.write(folder .. "/-e", "print 'a file called -e'")
    local out = program.shell(("cd %s && %s -- -e"):format(folder,
      program.path:find "^/" and program.quote(program.path)
        or '"$OLDPWD"/' .. program.quote(program.path)))
    assert.equal("a file called -e\n", out)
  end)

  it("have the nearest name proposed", function()
    for typo, name in pairs{ ["--chek"] = "--check", ["--veiw"] = "--view", ["--hlep"] = "--help" } do
      local _, err, code = run { typo }
      assert.equal(("softworld: there is no option '%s'; did you mean '%s'?\n"):format(typo, name), err)
      assert.equal(2, code)
    end
  end)

  it("print the version and the usage", function()
    local out, _, code = run { "-v" }
    assert.matches("^SoftWorld %d+%.%d+%.%d+ %(Lua 5%.4%.%d+%)\n$", out)
    assert.equal(0, code)
    assert.equal(out, (run { "--version" }))
    assert.matches("^usage: softworld", (run { "--help" }))
    assert.equal("1\n", (run({ "-v", "-" }, { stdin = "print(1)" })):match "\n(.*)")
  end)

  it("are refused with code 2 when wrong", function()
    for _, arguments in ipairs { { "-x" }, { "--verbose" }, { "-e" }, { "-i", "-e" } } do
      local out, err, code = run(arguments)
      assert.equal("", out)
      assert.matches("^softworld: .*'%-.*usage: ", err)
      assert.equal(2, code)
    end
  end)
end)

describe("softworld.host", function()
  after_each(program.clean)

  it("gives the way in which the program runs", function()
    local out = script [[
      local host = package.loaded["softworld.host"]
      print(host.executable:match "[^/]*$", host.interactive, host.terminal, host.columns())
    ]]
    assert.equal(program.path:match "[^/]*$" .. "\tfalse\tfalse\t80\n", out)
    out = run({ "-e", "print(package.loaded['softworld.host'].columns())" }, { before = "COLUMNS=123" })
    assert.equal("123\n", out)
  end)

  it("is found beside share/lua/5.4 when installed", function()
    local folder = program.folder()
    program.shell(("cd %s && mkdir -p bin share/lua/5.4/softworld"):format(folder))
    program.write(folder .. "/share/lua/5.4/softworld/here.lua", "return 'installed'")
    program.shell(("cp %s %s/bin/softworld"):format(program.quote(program.path), folder))
    local out = run({ "-e", "print((require 'softworld.here'))" }, { path = folder .. "/bin/softworld" })
    assert.equal("installed\n", out)
    out = run({ "-e", "print(package.loaded['softworld.host'].executable)" },
      { before = "PATH=" .. folder .. "/bin:$PATH", path = "softworld" })
    assert.equal(folder .. "/bin/softworld\n", out)
  end)

  it("has the core built in", function()
    local out = run { "-e", "print(type(require('softworld.core').version))" }
    assert.equal("string\n", out)
  end)
end)

describe("softworld.core for the stock interpreter", function()
  local folder = program.path:match "^(.*)/" or "."

  it("loads, and has the same version", function()
    assert.is_true(program.has "lua5.4", "the package lua5.4 is missing")
    local code = "print(require('softworld.core').version)"
    -- A core built with sanitizers needs their library loaded first in a program without them. Leaks of the
    -- stock interpreter do not count.
    local sanitizer = os.getenv "SOFTWORLD_PRELOAD"
    local preload = sanitizer and ("LD_PRELOAD=%s ASAN_OPTIONS=detect_leaks=0 ")
      :format(program.quote(sanitizer)) or ""
    local out, err = program.shell((preload .. "LUA_CPATH=%s lua5.4 -e %s"):format(
      program.quote(folder .. "/lib/?.so"), program.quote(code)))
    assert.equal("", err)
    assert.equal(run { "-e", code }, out)
  end)
end)
