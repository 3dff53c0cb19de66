-- SPDX-License-Identifier: GPL-3.0-or-later
-- How the prompt shows values, and which names its completion offers.

package.path = "lua/?.lua;lua/?/init.lua;" .. package.path
local pretty = require "softworld.prompt.pretty"
local repl = require "softworld.prompt.repl"

describe("pretty()", function()
  it("shows plain values as print does", function()
    assert.equal("1", pretty(1))
    assert.equal("0.33333333333333", pretty(1 / 3))
    assert.equal("a\nb", pretty "a\nb")
    assert.equal("nil", pretty(nil))
    assert.equal("true", pretty(true))
  end)

  it("shows short tables on one line with sorted keys", function()
    assert.equal("{}", pretty {})
    assert.equal('{ 1, 2.5, "x", a = true, b = {}, ["c d"] = 1, ["end"] = 2 }',
      pretty { 1, 2.5, "x", b = {}, a = true, ["end"] = 2, ["c d"] = 1 })
    assert.equal("{ [-1] = 1, [0.5] = 2, a = 4, [true] = 3 }",
      pretty { [-1] = 1, [0.5] = 2, [true] = 3, a = 4 })
    assert.equal("{ { 0.0, 0.3333333, 1e+20 } }", pretty { { 0.0, 1 / 3, 1e20 } })
    assert.equal([[{ "a\n\"\000" }]], pretty { 'a\n"\0' })
  end)

  it("shows long tables with one item per line", function()
    local points = {}
    for i = 1, 3 do points[i] = { i + 0.5, i / 3, 0.123456789 } end
    assert.equal("{\n  { 1.5, 0.3333333, 0.1234568 },\n  { 2.5, 0.6666667, 0.1234568 },\n"
      .. "  { 3.5, 1.0, 0.1234568 },\n}", pretty(points, { width = 60 }))
  end)

  it("keeps to the width", function()
    local t = { name = ("n"):rep(300), list = {}, deep = { { { { { 1 } } } } } }
    for i = 1, 500 do t.list[i] = i end
    local text = pretty(t, { width = 60 })
    for line in text:gmatch "[^\n]+" do assert.is_true(#line <= 64, line) end
    assert.matches("list = { 500 items }", text, 1, true)
    assert.matches("300 bytes", text)
  end)

  it("stops at the largest allowed number of items", function()
    local t = {}
    for i = 1, 1000 do t[i] = i end
    local text = pretty(t, { items = 10 })
    assert.equal(13, select(2, (text .. "\n"):gsub("\n", "")))
    assert.matches("... 990 more", text, 1, true)
  end)

  it("is safe with cycles, deep tables and hostile metatables", function()
    local t = { 1 }
    t.self, t.inner = t, { up = t }
    assert.equal("{ 1, inner = { up = <cycle> }, self = <cycle> }", pretty(t))
    local deep = {}
    for _ = 1, 1e5 do deep = { deep } end
    assert.equal("{ { { { { 1 item } } } } }", (pretty(deep)))
    local wild = setmetatable({ 1, a = 2 }, { __index = error, __len = error, __pairs = error })
    assert.equal("{ 1, a = 2 }", pretty(wild))
    assert.equal("me", pretty(setmetatable({}, { __tostring = function() return "me" end })))
    assert.matches("__tostring fails", pretty(setmetatable({}, { __tostring = error })))
    assert.equal("{ <table whose __tostring fails> }", pretty { setmetatable({}, { __tostring = error }) })
  end)

  it("says where functions are defined", function()
    assert.equal("{ print = function (built in) }", pretty { print = print })
    assert.matches("^function %(.*pretty_spec.lua:%d+%)$", pretty(function() end))
  end)

  it("shows a table with a million items within 5 s", function()
    local t = {}
    for i = 1, 1e6 do t[i], t[-i] = i, i end
    local start = os.clock()
    assert.matches("... 1999900 more", pretty(t), 1, true)
    assert.is_true(os.clock() - start < 5)
  end)
end)

describe("completion", function()
  local object = setmetatable({ own = 1, run = print }, { __index = { inherited = print, field = 1 } })
  local listed = setmetatable({}, { __index = function(_, k) return k == "part" and object or nil end,
    __names = function() return { "part", "peak" } end })
  local names = { object = object, other = { object, ["a b"] = 1, ["end"] = 2, fine = 3 }, listed = listed,
    file = io.stdout, text = "x", strange = setmetatable({}, { __index = error }) }

  local function offers(expected, line)
    local before, word = line:match "^(.-)([%w_]*)$"
    assert.equal(expected, table.concat(repl.complete(before, word, names), " "))
  end

  it("offers globals", function()
    offers("object other", "o")
    offers("object other", "print(o")
    offers("object other", "'x' .. o")
    offers("", "nothing")
  end)

  it("offers fields that are names", function()
    offers("field inherited own run", "object.")
    offers("own", "x = object.o")
    offers("fine", "other.")
    offers("own", "other[1].o")
  end)

  it("offers methods after a colon", function()
    offers("inherited run", "object:")
    offers("upper", "text:up")
    offers("seek setvbuf", "file:s")
  end)

  it("uses the metamethod __names", function()
    offers("part peak", "listed.")
    offers("run", "listed.part.r")
  end)

  it("offers nothing where it would have to run calls", function()
    offers("", "f().o")
    offers("", "strange.x.y")
    offers("", "missing.")
    offers("", "object.own.x")
  end)
end)
