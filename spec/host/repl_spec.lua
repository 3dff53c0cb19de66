-- SPDX-License-Identifier: GPL-3.0-or-later
-- The prompt, through a pipe and at a terminal.

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local run = program.run

-- Output of a session through a pipe; the library may be missing, and the prompt then says so.
local function session(text, arguments)
  local out, err, code = run(arguments or { "-i" }, { stdin = text })
  return out, err:gsub("note: softworld cannot be loaded:[^\n]*\n", ""), code
end

local function prints(expected, text)
  local out, err, code = session(text)
  assert.equal("", err)
  assert.equal(expected, out)
  assert.equal(0, code)
end

describe("the prompt through a pipe", function()
  after_each(program.clean)

  it("prints the values of expressions", function()
    prints("3\nnil\n1\t2\nx\n", "1 + 2\nnil\n1, 2\n'x'\n")
    prints("5\n6\n", "=5\nx = 6\n= x")
  end)

  it("prints nothing for statements, calls without values and empty lines", function()
    prints("", "x = 1\n\n   \n-- a comment\n;\n(function() end)()\nlocal y = 2\n")
  end)

  it("ends at exit and quit, unless these are variables", function()
    for _, word in ipairs { "exit", "quit()", " exit() ", "quit" } do
      prints("1\n", ("1\n%s\n2\n"):format(word))
    end
    prints("5\n3\n", "exit = 5\nexit\nquit = function() return 3 end\nquit()\n")
    prints("nil\n1\n", "exits\n1\n")
  end)

  it("names a wrong call only once", function()
    local _, err = session "string.rep()\n"
    assert.matches("^input:1: bad argument #1 to 'rep'[^\n]*\n$", err)
    _, err = session "function f()\nstring.rep()\nend\nf()\n"
    assert.matches("called from:\n.*in the function at line 1\n", err)
  end)

  it("waits for the rest of a statement", function()
    prints("1\n2\n", "for i = 1, 2 do\nprint(i)\nend\n")
    prints("a\nb\n", "[[a\nb]]\n")
    prints("3\n", "1 +\n2\n")
    prints("3\n", "=1 +\n2\n")
    prints("{ 1, 2 }\n", "{\n1,\n2\n}\n")
  end)

  it("continues after errors, and gives the right line", function()
    local out, err, code = session "error 'boo'\nx = = 1\nfor i = 1, 2 do\nx = )\n1\n'abc\n2\n"
    assert.equal("1\n2\n", out)
    assert.equal("input:1: boo\ninput:1: unexpected symbol near '='\n"
      .. "input:2: unexpected symbol near ')'\ninput:1: unfinished string near ''abc'\n", err)
    assert.equal(0, code)
  end)

  it("says what is missing at the end of input", function()
    local _, err = session "for i = 1, 2 do\nx = 1"
    assert.equal("input:3: 'end' expected (to close 'for' at line 1) near <eof>\n", err)
  end)

  it("accepts long lines and zero bytes", function()
    prints("200003\n", "#'" .. ("x"):rep(200000) .. "\0yz'\n")
  end)

  it("follows -e and a script, also one that failed", function()
    local name = program.write(program.folder() .. "/s.lua", "a = 5 error('no', 0)")
    local out, err, code = session("a, b\n", { "-i", "-e", "b = 6", name })
    assert.equal("5\t6\n", out)
    assert.matches("^no\n", err)
    assert.equal(1, code)
    out, err, code = session("os.exit(b)\n", { "-i", "-e", "b = 6" })
    assert.equal("", out .. err)
    assert.equal(6, code)
  end)

  it("presets sw and help when the library has them", function()
    local folder = program.folder()
    program.write(folder .. "/s.lua", [[
      package.loaded.softworld = { help = function() return "helped" end, name = "sw" }
    ]])
    local out = session("sw.name, help()\n", { "-i", folder .. "/s.lua" })
    assert.equal("sw\thelped\n", out)
    out = session("sw, print(1)\n", { "-i", "-e", "package.preload.softworld = function() error 'x' end" })
    assert.equal("1\nnil\n", out)
  end)

  it("keeps the last result as _", function()
    prints("5\n10\nnil\n10\n", "5\n_ * 2\nnil\n_\n")
  end)

  it("shows help for ?", function()
    local out, err = session "?clip\nscene = sw.scene{}\n?scene\n?scene:clamp\n?no_such_topic\n"
    assert.matches("scene:clip{", out)
    assert.matches("\nscene 'scene' at t = 0 s\n", out)
    assert.matches("\n  scene:clamp%(wire", out)
    assert.matches("no help on 'no_such_topic'", out .. err)
    prints((session "help()\n"), "?\n")
  end)

  it("times a call, and returns its values", function()
    local out = session "time(math.max, 3, 4)\ntime(error, 'boo')\n1\n"
    assert.matches("^[%d.e-]+ s, [%d.e-]+ s of computing\n4\n1\n$", out)
  end)

  it("shows an object's parts, its state and its extremes", function()
    local out = session [[
      scene = sw.scene{}
      wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      clamp = scene:clamp(wire, { s = 0 })
      run = scene:run{ duration = 0.1 }
      wire
      scene
      scene:obstacle{ name = "floor", shape = "plane", at = { 0, 0, -2 } }
    ]]
    assert.matches("\n  rod, radius 1%.5%d* mm, cable 'GXL 1%.5', EI [%d.]+ N m2, [%d.]+ kg/m\n", out)
    assert.matches("\n  from %(0, 0, 0%) to %([%d.]+, 0, %-0%.%d+%) m\n", out)
    assert.matches("\n  smallest bend radius so far [%d.]+ %a+ %(s = ", out)
    assert.matches("\n  largest tension so far [%d.]+ m?N %(s = ", out)
    assert.matches("\n  wires: w\n  holds: clamp1\n", out)
    assert.matches("plane 'floor'[^\n]*\n  at %(0, 0, %-2%) m\n", out)
  end)

  it("says when a result cannot be shown", function()
    prints("<table whose __tostring fails>\n1\n", "setmetatable({}, { __tostring = error })\n1\n")
  end)
end)

describe("the prompt at a terminal", function()
  after_each(program.clean)
  local possible = program.has_terminals()
  if not possible then
    print "not tested here: the prompt at a terminal, for there is no /dev/pts"
    it("gives the same results through a pipe where there are no terminals", function()
      local out, _, code = program.run({}, { stdin = "print(6 * 7)" })
      assert.equal("42\n", out)
      assert.equal(0, code)
    end)
  end

  local at_terminal = program.terminal
  local terminal_it = possible and it or function() end

  terminal_it("greets, runs and leaves on Ctrl-D", function()
    local out, code = at_terminal { "6 * 7\n", "\4" }
    assert.matches("^SoftWorld %d", out)
    assert.matches("\n> 6 %* 7\n42\n> \n$", out)
    assert.equal(0, code)
  end)

  terminal_it("shows another prompt for the rest of a chunk", function()
    local out = at_terminal { "for i = 1, 2 do\n", "print(i * 11)\n", "end\n", "\4" }
    assert.matches("\n>> print%(i %* 11%)\n>> end\n11\n22\n> ", out)
  end)

  terminal_it("gives up the line, or the chunk, on Ctrl-C", function()
    local out, code = at_terminal { "x = 1 +", "\3", "if true then\n", "x = 2", "\3", "x\n", "\4" }
    assert.matches("%^C\n> if true then\n>> .*%^C\n> x\nnil\n> ", out)
    assert.equal(0, code)
  end)

  terminal_it("stops running code on Ctrl-C and goes on", function()
    local out, code = at_terminal { "while true do end\n", 0.3, "\3", "'on' .. 'wards'\n", "\4" }
    assert.matches("input:1: interrupted\n> 'on' .. 'wards'\nonwards\n", out)
    assert.equal(0, code)
  end)

  terminal_it("dies of two quick Ctrl-C when code swallows the first", function()
    local loop = "while true do pcall(function() while true do end end) end\n"
    local out, code = at_terminal { loop, 0.3, "\3", "\3" }
    assert.matches("%^C%^C$", out)
    assert.equal(130, code)
  end)

  terminal_it("completes names", function()
    local out = at_terminal { "mat\t", ".flo\t", "(2.5)\n", "\4" }
    assert.matches("> math.floor%(2.5%)\n2\n", out)
    out = at_terminal { "f = io.stdout\n", "f:w\t", "('out' .. 'put\\n')\n", "\4" }
    assert.matches("> f:write%('out' .. 'put\\n'%)\noutput\n", out)
  end)

  terminal_it("hints once at what becomes of locals", function()
    local out = at_terminal { "local x = 1\n", "local y = 1\n", "\4" }
    assert.equal(1, select(2, out:gsub("note: at the prompt a local ends", "")))
  end)

  terminal_it("remembers lines from session to session", function()
    local state = program.folder() .. "/new/state"
    at_terminal({ "x = 'first'\n", "x = 'second'\n", "  \n", "\4" }, { state = state })
    assert.equal("x = 'first'\nx = 'second'\n", program.read(state .. "/softworld/history"))
    local out = at_terminal({ "\16", "\16", "\n", "x\n", "\4" }, { state = state })
    assert.matches("\nfirst\n", out)
  end)

  terminal_it("remembers a chunk of several lines as one entry, typed or pasted", function()
    local state = program.folder() .. "/several/state"
    at_terminal({ "for i = 1, 2 do\n", "  print('row', i)\n", "end\n",
      "\27[200~a = 3\nb = 4\27[201~\n", "x = {\n", "1,\n", "\3", "\4" }, { state = state })
    assert.equal("for i = 1, 2 do\30  print('row', i)\30end\na = 3\30b = 4\nx = {\0301,\n",
      program.read(state .. "/softworld/history"))
    local out = at_terminal({ "\16\16\16\n", "\16\16\16\n", "a * b\n", "\4" }, { state = state })
    assert.matches("\nrow\t1\nrow\t2\n", (out:gsub(" +1\n", "\t1\n"):gsub(" +2\n", "\t2\n")))
    assert.matches("\n12\n", out)
  end)

  terminal_it("does without a history file when it cannot be made", function()
    local out, code = at_terminal({ "1 + 1\n", "\16\n", "\4" }, { state = "/dev/null/x" })
    assert.matches("\n2\n> 1 %+ 1\n2\n", out)
    assert.equal(0, code)
  end)
end)
