-- SPDX-License-Identifier: GPL-3.0-or-later
-- Error texts point at the user's line and list the user's calls.

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

local function errors(text, options)
  local _, err, code = script(text, nil, options)
  assert.equal(1, code)
  return err
end

-- A call that fails inside a file of the library.
local LIBRARY = "local pretty = require 'softworld.prompt.pretty'\n"
local FAILING = "pretty({}, { width = {} })"

describe("an error", function()
  after_each(program.clean)

  it("in the main chunk gives one line", function()
    assert.equal("script.lua:2: boo\n", errors "\nerror 'boo'")
    assert.equal("script.lua:3: unexpected symbol near '='\n", errors "\n\nx = = 1")
  end)

  it("in a function lists the calls", function()
    local text = errors "local function f() error 'boo' end\nlocal function g() f() end\ng()"
    assert.equal("script.lua:1: boo\ncalled from:\n\tscript.lua:1: in upvalue 'f'\n"
      .. "\tscript.lua:2: in local 'g'\n\tscript.lua:3: in main chunk\n", text)
  end)

  it("in a C function called by the user names this function", function()
    local text = errors "string.rep()"
    assert.matches("^script.lua:1: bad argument #1 to 'rep'", text)
    assert.matches("\n\t%[C%]: in [%a ]+'[%a.]*rep'\n\tscript.lua:1: in main chunk\n$", text)
  end)

  it("inside the library points at the user's line", function()
    local text = errors(LIBRARY .. "\n" .. FAILING)
    assert.matches("^script.lua:3: [^/]*\n$", text)
    text = errors(LIBRARY .. "local function f()\n  " .. FAILING .. "\nend\nf()")
    assert.matches("^script.lua:3: [^/]*\ncalled from:\n\tscript.lua:3: in local 'f'\n"
      .. "\tscript.lua:5: in main chunk\n$", text)
  end)

  it("inside the library points at the user's line in a coroutine, too", function()
    local text = errors(LIBRARY .. "local co = coroutine.create(function()\n  " .. FAILING
      .. "\nend)\nprint(error((select(2, coroutine.resume(co))), 0))")
    assert.matches("^script.lua:3: [^/]*\n", text)
  end)

  it("shows the whole traceback on request", function()
    local text = errors(LIBRARY .. FAILING, { before = "SOFTWORLD_TRACEBACK=full" })
    assert.matches("/softworld/prompt/pretty.lua:%d+: .*\nstack traceback:\n", text)
    assert.matches("traceback:\n.*/softworld/prompt/pretty.lua:.*%[C%]: in %?", text)
  end)

  it("may be any value", function()
    local function first(text) return errors(text):match "[^\n]*" end
    local object = "error(setmetatable({}, { __tostring = function() %s end }))"
    assert.equal("hi from me", first(object:format "return 'hi from me'"))
    assert.equal("(the error value is a table: { code = 3 })", first "error { code = 3 }")
    assert.equal("(the error value is nil)", first "error()")
    assert.equal("(the error value is a boolean: false)", first "error(false)")
    assert.equal("42", first "error(42)")
    assert.equal("(the error value is a table whose __tostring fails)",
      first(object:format "error 'again'"))
    assert.equal("script.lua:1: a\0b", first "error 'a\\0b'")
  end)

  it("in a runaway recursion gives a short text", function()
    local text = errors "local function f() return 1 + f() end\nf()"
    assert.matches("^script.lua:1: stack overflow", text)
    assert.matches("\n\t... %(%d+ calls in between%)\n", text)
    assert.matches("\n\tscript.lua:2: in main chunk\n$", text)
    assert.is_true(select(2, text:gsub("\n", "")) < 30)
  end)
end)
