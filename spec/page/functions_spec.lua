-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lua functions typed in a page of the live view: forces, paths, conditions, observers. A view accepts them
-- only if the program allowed it, whatever its pages say. A typed function is checked with its line number,
-- is in the saved script, and gives the same numbers.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local draft = require "softworld.view.draft"
local functions = require "softworld.view.functions"
local kinds = require "softworld.view.kinds"
local orders = require "softworld.view.orders"
local program = dofile "spec/host/program.lua"
local saving = require "spec.scene.saving"
local viewing = require "softworld.view.view"
local visitor = require "spec.page.visitor"
local websocket = require "spec.page.websocket"

local function add(d, class, kind, values)
  return d:change{ what = "add", class = class, kind = kind, values = values,
    process = class == "step" and 1 or nil }
end

local function refused(text, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine, text)
  assert(tostring(why):find(text, 1, true), tostring(why))
end

local WIRE = { name = "cord", E = 5e7, density = 1500, radius = 0.003, segments = 12, from = { 0, 0, 0.1 },
  to = { 0.3, 0, 0.1 } }

local function a_draft()
  local d = draft.new(true)
  add(d, "wire", "rod", WIRE)
  add(d, "gripper", "gripper", { name = "hand", at = { 0, 0, 0.1 } })
  return d
end

describe("a function typed in a form", function()
  it("becomes a force, path, condition or observer of the script, which gives the same bits", function()
    local d = a_draft()
    add(d, "force", "function", { on = "cord",
      func = "for i = 3, #f, 3 do\n  f[i] = f[i] + 0.01 * math.sin(20 * t)\nend" })
    add(d, "observer", "observe", { every = 0.01,
      call = 'if observer.scene.time > 0.25 then\n  observer:stop "late"\nend' })
    add(d, "step", "grasp", { _by = "hand", _on = "cord", s = 0 })
    add(d, "step", "move_by_function", { _by = "hand", func = "return { 0, 0, 0.1 * t }", duration = 0.1 })
    add(d, "step", "wait_until", { timeout = 1,
      condition = 'return scene:find("hand"):force()[3] ~= 0 and scene.time > 0.15' })
    add(d, "step", "move", { _by = "hand", by = { 0, 0, 0.1 }, duration = 1 })
    local scene = d:build()
    local run = scene:run{ dt = 0.002 }
    assert.is_true(run.ok)
    assert.equal("late", run.reason)
    assert.near(0.26, run.time, 0.0101)
    -- 10 mm by the function until 0.1 s, and from 0.15 s on part of the 0.1 m in 1 s
    local went = scene:find("hand"):position()[3] - 0.11
    assert.is_true(went > 0 and went < 0.05, tostring(went))
    local text = d:script()
    assert.truthy(text:find("wait_until(function()\nreturn scene:find", 1, true), text)
    local again = assert(load(text .. "return scene"))() -- with everything that a script has
    again:run{ dt = 0.002 }
    assert.is_nil(saving.difference(saving.all(scene), saving.all(again)))
  end)

  -- The nodes' forces add up to 13 * 0.01 N sin(20 t): the centre of mass gains 13 * 0.01 (1 - cos 2) / 20 /
  -- m in 0.1 s, m = density pi r^2 L. An end node has half the mass of an inner one.
  it("adds its forces to each node", function()
    local function speed(func)
      local d = a_draft()
      if func then add(d, "force", "function", { on = "cord", func = func }) end
      local scene = d:build()
      assert.is_true(scene:run{ duration = 0.1, dt = 0.002 }.ok)
      local v, sum = scene:find("cord"):velocities(), 0
      for k = 0, 12 do sum = sum + (k % 12 == 0 and 0.5 or 1) * v[3 * k + 3] end
      return sum / 12
    end
    local mass = 1500 * math.pi * 0.003 ^ 2 * 0.3
    local gained = speed "for i = 3, #f, 3 do f[i] = f[i] + 0.01 * math.sin(20 * t) end" - speed()
    assert.near(13 * 0.01 * (1 - math.cos(2)) / 20 / mass, gained, 1e-3 * gained)
  end)

  it("becomes a check, by which the view and the saved script judge the run alike", function()
    local page = visitor.open(viewing.nothing{ open = false, functions = true })
    page:add("wire", "rod", WIRE)
    -- the wire falls freely for 0.1 s: v = 0.981 m/s at its end
    local speed = "local v = scene:find('cord'):velocity(0.1)\nreturn -v[3]"
    page:add("check", "check", { name = "slow", unit = "m/s", of = speed, max = 0.5 })
    page:add("check", "check", { name = "fast", unit = "m/s", of = speed, min = 0.5 })
    page:add("check", "check", { name = "wrong", unit = "-", of = "\nreturn run.nothing.at" })
    page:ask{ ["do"] = "start", values = { duration = 0.1, dt = 0.005 } }
    page:hear(0.5)
    local state, script = page.got.state, page.got.lines.script
    local found = {}
    for _, r in ipairs(state.check.rows) do found[r.name] = r end
    assert.same({ "FAIL", "FAIL", "PASS" }, { state.check.verdict, found.slow.verdict, found.fast.verdict })
    assert.near(0.981, found.fast.value, 1e-6)
    assert.truthy(found.wrong.note:find "its function raised: line 2: ", found.wrong.note)
    local printed = {}
    local names = { print = function(x) printed[#printed + 1] = tostring(x) end }
    setmetatable(names, { __index = _G })
    assert(load(script, "=script", "t", names))()
    assert.truthy(printed[#printed]:find("slow", 1, true) and printed[#printed]:find("FAIL", 1, true), script)
    page:close()
  end)

  it("is refused with the line of its body, and nothing changes", function()
    local d = a_draft()
    local before = d:script()
    local function typed(body, words, class, kind, name)
      refused(words, add, d, class or "force", kind or "function", { on = "cord", [name or "func"] = body })
      assert.equal(before, d:script())
    end
    typed("f[3] = 1\nf[6] = = 2", "function.func: line 2: unexpected symbol near '='")
    typed("if t > 1 then", "function.func: line 1: 'end' expected near <eof>")
    typed("", "the body of the function is missing")
    typed("-- only\n--[[ words", "line 2: unfinished long comment")
    typed("f[3] = ...", "line 1: cannot use '...' outside a vararg function")
    -- text that would end the function and continue outside it
    typed("end, on = scene:find('cord'), x = (function()", "line 1: ")
    typed("return end } os.exit(3) scene:force { kind = function()", "line 1: ")
    typed(("x"):rep(20001), "20000 bytes at most")
    typed({ 1 }, "must be the body of a Lua function")
    typed("\27Lua", "line 1: ")
    refused("func is required", add, d, "force", "function", { on = "cord" })
    refused("which gripper", add, d, "step", "move_by_function", { func = "return {}", duration = 1 })
  end)

  it("reports an error at run time with its own line and the line of the script", function()
    local d = a_draft()
    add(d, "step", "wait_until", { condition = "local x\n\nreturn x.y" })
    local scene = d:build()
    local fine, why = pcall(scene.run, scene, { dt = 0.002 })
    assert.is_false(fine)
    local words = d:plain(why)
    local line = words:match "^line 3 of condition of wait until %(line (%d+) of the script%): attempt to"
    assert(line, words)
    local count = 0
    for text in d:script():gmatch "([^\n]*)\n" do
      count = count + 1
      if count == tonumber(line) then assert.equal("return x.y", text) end
    end
  end)

  it("has the functions that scripts use for numbers, and not the library's own tables", function()
    local d = a_draft()
    add(d, "observer", "observe", { call = "math.sin, string.format = nil, nil\n"
      .. "for _, x in ipairs { 1 } do\n"
      .. "  assert(tostring(x) == '1' and pcall(type, x) and not os and not io)\n"
      .. "end" })
    assert.is_true(d:build():run{ duration = 0.01, dt = 0.005 }.ok)
    assert.is_function(math.sin)
    assert.is_function(string.format)
  end)
end)

describe("an object with the same name as a library function", function()
  it("replaces neither that function nor anything the script calls", function()
    for _, name in ipairs{ "_ENV", "print", "assert", "math", "string", "run" } do
      local d = draft.new(true)
      local values = {}
      for key, value in pairs(WIRE) do values[key] = value end
      values.name = name
      add(d, "wire", "rod", values)
      add(d, "hold", "clamp", { _on = name, s = 0 }) -- refers to it
      add(d, "observer", "observe", { call = "assert(math.pi > 3 and string.rep and print)" })
      add(d, "check", "check", { unit = "m", of = "return math.pi" })
      assert.is_true(d:build():run{ duration = 0.01, dt = 0.005 }.ok)
      local text = orders.script(d:build(), {}, { { duration = 0.01, dt = 0.005 } }, d:script(), d:checks())
      local printed
      local names = setmetatable({ print = function() printed = true end }, { __index = _G })
      assert(load(text, "=script", "t", names))()
      assert.is_true(printed)
    end
  end)
end)

describe("a view that was not allowed to take functions", function()
  local LUA = {}
  for _, kind in ipairs(functions.kinds) do LUA[#LUA + 1] = kind end

  it("has no forms for them", function()
    local function count_of(fields) -- also in tables
      local count = 0
      for _, field in ipairs(fields) do
        count = count + (field.type == "function" and 1 or 0) + count_of(field.rows or {})
      end
      return count
    end
    for _, kind in ipairs(kinds.all().kinds) do assert.equal(0, count_of(kind.fields), kind.kind) end
    local count = 0
    for _, kind in ipairs(kinds.all(true).kinds) do count = count + count_of(kind.fields) end
    assert.equal(#LUA, count)
  end)

  it("refuses each of them, before and during a run, and any code put into one", function()
    for _, kind in ipairs(LUA) do
      local values = { on = "cord", func = "os.exit(3)", condition = "os.exit(3)", call = "os.exit(3)" }
      refused("accepts no Lua functions from pages", add, draft.new(), kind.class, kind.kind, values)
      local scene = sw.scene()
      refused("accepts no Lua functions from pages", orders.line, scene,
        { ["do"] = "add", class = kind.class, kind = kind.kind, values = values, serial = 1 })
    end
    local d = draft.new(true)
    add(d, "observer", "observe", { call = "local x" })
    d.may = false
    refused("accepts no Lua functions", d.change, d,
      { what = "put", id = 1, values = { call = "os.exit(3)" } })
    refused("accepts no Lua functions", d.change, d,
      { what = "change", id = 1, class = "observer", kind = "observe", values = { call = "os.exit(3)" } })
  end)

  -- The page claims to be allowed; only the program's option counts.
  it("refuses a page over its socket, while an allowed view accepts it", function()
    for _, may in ipairs{ false, true } do
      local view = viewing.nothing{ open = false, functions = may or nil }
      local page = visitor.open(view)
      page:ask({ ["do"] = "draft", what = "add", class = "observer", kind = "observe", functions = true,
        may = true, values = { call = "local x = 1" } }, "a")
      page:add("wire", "rod", WIRE)
      page:hear(0.3)
      local answer = page.answers.a
      assert.equal(may, answer.ok, answer.text)
      assert.equal(may and 2 or 1, #page.got.draft.items)
      if not may then assert.equal(functions.REFUSED, answer.text) end
      local port, path = view.address:match "^http://127%.0%.0%.1:(%d+)(/%x+/)$"
      -- no other client has a socket at all: without the token, or from another site
      assert.is_nil(websocket.open(math.tointeger(port), path .. "s", { Origin = "http://evil.example" }))
      assert.is_nil(websocket.open(math.tointeger(port), "/0123456789abcdef0123456789abcdef/s"))
      page:close()
    end
  end)

  it("is allowed only by an option of the program, together with --view", function()
    local _, err, code = program.run{ "--functions" }
    assert.equal(2, code)
    assert.truthy(err:find "%-%-view is missing beside '%-%-functions'")
    local out = program.run{ "--help" }
    assert.truthy(out:find "%-%-functions  with %-%-view: pages may type Lua functions")
  end)
end)
