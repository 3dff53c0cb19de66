-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:settle that fails, or whose events say that a number may be wrong: a script that does not look at its
-- result is told at its end.
require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- A cable that is held or free, and pulled at its end.
local pulled = [[
local sw = require "softworld"
local function settle(force, free, args)
  local scene = sw.scene{ name = "pull" }
  local wire = scene:wire{ cable = "GXL 1.5", from = {0, 0, 0}, to = {0.1, 0, 0}, segments = 20 }
  if not free then scene:clamp(wire, { s = 0 }) end
  scene:force{ kind = "point", on = wire, s = wire.length, force = { force, 0, 0 } }
  local result = scene:settle(args)
  return result
end
]]

describe("a settle that fails", function()
  after_each(program.clean)

  it("fails the script that does not look at it", function()
    local _, err, code = script(pulled .. "local r = settle(1, true)\nprint(1)")
    assert.truthy(err:find("softworld: scene:settle of 'pull' at script.lua:7 FAILED: wire 'wire1', which "
      .. "nothing holds, is carried away", 1, true), err)
    assert.equal(1, code)
  end)

  for what, code in pairs{ ok = "print(r.ok)", reason = "print(r.reason)", print = "print(r)" } do
    it("does not, once the script looked at it: " .. what, function()
      local _, err, status = script(pulled .. "local r = settle(1, true)\n" .. code)
      assert.equal("", err)
      assert.equal(0, status)
    end)
  end

  it("is in the log, which is no look", function()
    local log = os.tmpname()
    local name = program.write(program.folder() .. "/script.lua", pulled .. "settle(1, true)")
    local _, err, code = program.run{ "--log", log, name }
    local file = assert(io.open(log))
    local text = file:read "a"
    file:close()
    os.remove(log)
    assert.truthy(text:find("settle: wire 'wire1', which nothing holds, is carried away", 1, true), text)
    assert.truthy(err:find("FAILED", 1, true))
    assert.equal(1, code)
  end)
end)

describe("events of a settle", function()
  after_each(program.clean)

  it("are told at the end of a script that did not look at them; the script succeeds", function()
    local _, err, code = script(pulled .. "assert(settle(1000).ok)")
    assert.truthy(err:find("softworld: note: scene:settle of 'pull' at script.lua:7 is ok, but has 1 event; "
      .. "see .events of its result: breaking: wire 'wire1' is pulled by 1000 N", 1, true), err)
    assert.equal(0, code)
  end)

  it("stand in its print", function()
    local out, err = script(pulled .. "print(settle(1000))")
    assert.truthy(out:find("^at rest after %d+ iterations; wire 'wire1' is pulled by 1000 N"), out)
    assert.equal("", err)
  end)

  it("are a list of those that are new", function()
    local out, err = script(pulled .. [[
      local scene = sw.scene{}
      local wire = scene:wire{ cable = "GXL 1.5", from = {0, 0, 0}, to = {0.1, 0, 0}, segments = 20 }
      scene:clamp(wire, { s = 0 })
      local load = scene:force{ kind = "point", on = wire, s = wire.length, force = { 1000, 0, 0 } }
      print(#scene:settle().events)
      load:set{ force = { 1, 0, 0 } }
      print(#scene:settle().events)
      print(#settle(1, false, { tolerance = { max_tension = 0.1 } }).events,
        #settle(1000, false, { tolerance = { max_tension = 0.1 } }).events)]])
    assert.equal("1\n0\n0\t1\n", out)
    assert.equal("", err)
  end)

  it("are not told of equilibria that the library seeks for itself", function()
    local _, err, code = script(pulled .. [[
      local scene = sw.scene{}
      local wire = scene:wire{ cable = "GXL 1.5", from = {0, 0, 0}, to = {0.1, 0, 0}, segments = 24 }
      scene:clamp(wire, { s = 0 })
      scene:force{ kind = "point", on = wire, s = wire.length, force = { 1000, 0, 0 } }
      print(#scene:run{ duration = 0.05, dt = 0.01, tolerance = { max_tension = 100 } }.events)]])
    assert.equal("", err)
    assert.equal(0, code)
  end)
end)

describe("the progress of a settle", function()
  after_each(program.clean)

  -- The clock of the line goes on by 1.2 s whenever it is read.
  local clock = [[
local core = require "softworld.core"
local now = 0
core.clock = function()
  now = now + 1.2
  return now
end
]]

  local function on_terminal(code)
    if not program.has "script" then error "the program script is needed" end
    local name = program.write(program.folder() .. "/script.lua", clock .. pulled .. code)
    return program.shell(("TERM=xterm script -qec %s /dev/null </dev/null"):format(
      program.quote(program.quote(program.path) .. " " .. program.quote(name))))
  end

  it("is one line on a terminal, after a second, and goes away", function()
    local out = on_terminal "print(settle(1).ok)"
    assert.truthy(out:find "\r[^\r\n]*pull [|/\\-]  settling for %d[%d.]* s\27%[K", out)
    assert.truthy(out:find "\r\27%[Ktrue\r?\n$", out)
    assert.falsy(on_terminal "print(settle(1, false, { progress = false }).ok)":find("settling", 1, true))
  end)

  it("names the level of one with error bars", function()
    local out = on_terminal "print(settle(1, false, { tolerance = { max_tension = 0.1 } }).ok)"
    assert.truthy(out:find "\r[^\r\n]*pull, level 2, %d+ segments [|/\\-]  settling for ", out)
    assert.truthy(out:find "\r\27%[Ktrue\r?\n$", out)
  end)

  it("is written without a terminal only when asked for", function()
    local out, err = script(pulled .. "print(settle(1).ok)")
    assert.same({ "true\n", "" }, { out, err })
    out, err = script(pulled .. "print(settle(1, false, { progress = true }).ok)")
    assert.equal("true\n", out)
    assert.truthy(err:find "^pull: at rest, %d+ iterations?\n$", err)
    out, err = script(clock .. pulled .. "print(settle(1, false, { progress = true }).ok)")
    assert.equal("true\n", out)
    assert.truthy(err:find "^pull |  settling for %d[%d.]* s\n", err)
    err = select(2, script(pulled .. "settle(1, false, { progress = 1 })"))
    assert.truthy(err:find("script.lua:7: scene:settle: progress must be true or false, got 1", 1, true), err)
  end)
end)
