-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C stops scripts wherever they are. The host replaces coroutine.resume and coroutine.wrap for this;
-- they still behave as in the stock interpreter.

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- Shells start background jobs with SIGINT ignored; env undoes that.
local NORMAL = "env --default-signal=INT"
local ONCE = { before = NORMAL, signals = { 0.3 } }
local TWICE = { before = NORMAL, signals = { 0.3, again = true } }

local function interrupted(text, line)
  local out, err, code = script(text, nil, ONCE)
  assert.equal(130, code)
  assert.matches("script.lua:" .. line .. ": interrupted$", err:match "[^\n]*")
  return out, err
end

describe("Ctrl-C", function()
  after_each(program.clean)

  it("stops a loop", function()
    interrupted("local n = 0\nwhile true do n = n + 1 end", 2)
  end)

  it("stops a loop in a coroutine", function()
    interrupted("local co = coroutine.create(function()\nwhile true do end\nend)\n"
      .. "error(select(2, coroutine.resume(co)), 0)", 2)
    interrupted("local function f() coroutine.wrap(function()\nwhile true do end\nend)() end\n"
      .. "coroutine.wrap(f)()", 2)
  end)

  it("stops the caller when the coroutine has finished by then", function()
    interrupted("local f = coroutine.wrap(function() while true do coroutine.yield() end end)\n"
      .. "while true do f() end", "%d")
  end)

  it("stops a call that waits in a C function", function()
    local pipe = program.folder() .. "/pipe"
    os.execute("mkfifo " .. pipe)
    local out, err, code = program.run({ "-e", "io.read() x = 1" },
      { before = NORMAL, signals = { 0.3 }, input = "<>" .. pipe })
    assert.equal("", out)
    assert.equal("-e:1: interrupted\n", err)
    assert.equal(130, code)
  end)

  it("is not lost when it comes during the last call", function()
    local pipe = program.folder() .. "/pipe"
    os.execute("mkfifo " .. pipe)
    local _, err, code = program.run({ "-e", "return io.read()" },
      { before = NORMAL, signals = { 0.3 }, input = "<>" .. pipe })
    assert.equal("interrupted\n", err)
    assert.equal(130, code)
  end)

  it("raises one error, which a script may catch", function()
    local out, err, code = script([[
      local ok, message = pcall(function() while true do end end)
      print(ok, message:match "interrupted")
      for _ = 1, 1e6 do end
      print "saved"
    ]], nil, ONCE)
    assert.equal("false\tinterrupted\nsaved\n", out)
    assert.equal("", err)
    assert.equal(0, code)
  end)

  it("ends a script that swallows errors, when pressed twice within a second", function()
    local _, _, code = script("while true do pcall(function() while true do end end) end", nil, TWICE)
    assert.equal(130, code)
  end)

  it("counts once when pressed twice at the same time", function()
    -- on a busy machine more than 50 ms may pass between the two, which then count as two
    for attempt = 1, 8 do
      local out, err, code = script([[
        pcall(function() while true do end end)
        local t = os.clock() while os.clock() - t < 0.3 do end
        print "once"
      ]], nil, { before = NORMAL, signals = { 0.3, 0 } })
      assert.equal("", err)
      if code == 130 and attempt < 8 then goto again end
      assert.equal("once\n", out)
      assert.equal(0, code)
      do return end
      ::again::
    end
  end)

  it("does not stop jobs that a shell started with SIGINT ignored", function()
    local out, _, code = script("local t = os.clock() while os.clock() - t < 1 do end print 'done'", nil,
      { signals = { 0.3 } })
    assert.equal("done\n", out)
    assert.equal(0, code)
  end)
end)

describe("coroutines in the host", function()
  after_each(program.clean)

  -- Each line must print the same in both interpreters.
  local CASES = [[
    local function closing(e)
      return setmetatable({}, { __close = function(_, x) print("close", x) if e then error(e, 0) end end })
    end
    print(coroutine.resume(coroutine.running()))
    local w = coroutine.wrap(function() local _ <close> = closing() error("boo", 0) end)
    print(pcall(w)) print(pcall(w))
    print(pcall(coroutine.wrap(function() local _ <close> = closing "second" error("first", 0) end)))
    w = coroutine.wrap(function() return w() end) print(pcall(w))
    print(coroutine.resume(coroutine.create(function(...) return select("#", ...), ... end), 1, nil, nil))
    local co = coroutine.create(function(a) local b = coroutine.yield(a + 1) error({ b }) end)
    print(coroutine.resume(co, 1)) print((coroutine.resume(co, 5)), coroutine.status(co))
    print(coroutine.resume(co)) print(pcall(coroutine.wrap, 1))
    local outer outer = coroutine.create(function()
      print(coroutine.resume(coroutine.create(function() return coroutine.resume(outer, 1) end)))
    end)
    coroutine.resume(outer)
    print(pcall(coroutine.wrap(function() string.rep() end)))
    print(#table.pack(coroutine.wrap(function() return table.unpack({}, 1, 5000) end)()))
    for i in coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i) end end) do print(i) end
  ]]

  it("behave as in the stock interpreter", function()
    if not program.has "lua5.4" then return pending "no lua5.4" end
    local name = program.write(program.folder() .. "/co.lua", CASES)
    local stock, stock_err = program.shell("lua5.4 " .. name)
    assert.equal("", stock_err)
    assert.equal(stock, (program.run { name }))
    assert.is_true(select(2, stock:gsub("\n", "")) > 15)
  end)
end)
