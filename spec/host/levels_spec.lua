-- SPDX-License-Identifier: GPL-3.0-or-later
-- Progress of calls that are several runs: on a terminal they share one line, which appears when the call,
-- not one of its runs, has taken a second, and is removed at the end.
local program = require "host.program"

-- Its clock goes on by 0.3 s whenever a bar is made.
local SCRIPT = [[
  local core = require "softworld.core"
  local progress = require "softworld.output.progress"
  local sw = require "softworld"
  local now, new = 0, progress.new
  core.clock = function() return now end
  progress.new = function(o)
    local after = o.after and ("%%.1f"):format(o.after)
    io.stdout:write(("%%s: quiet %%s, after %%s\n"):format(o.name, o.quiet, after))
    now = now + 0.3
    return new(o)
  end
  local scene = sw.scene { name = "mine" }
  scene:clamp(scene:wire { E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 },
    segments = 24 }, { s = 0 })
  assert(scene:run { duration = 0.01, %s }.events)
  assert(scene:run { duration = 0.01 }.events)
]]
local BARS = "tolerance = { tip = 1 }"

-- Returns what a script writes on a terminal.
local function on_terminal(more)
  if not program.has "script" then error "the program script is needed" end
  local name = program.write(program.folder() .. "/s.lua", SCRIPT:format(more))
  return program.shell(("TERM=xterm script -qec %s /dev/null </dev/null"):format(
    program.quote(program.quote(program.path) .. " " .. program.quote(name))))
end

-- Returns the time that each bar of a level was still to wait [s], and that of the plain run behind them.
local function waits(out)
  local list, plain = {}, nil
  for name, after in out:gmatch "(mine[^:\r\n]*): quiet false, after ([%d.nil]+)" do
    if name:find "level" then list[#list + 1] = tonumber(after) else plain = tonumber(after) end
  end
  return list, plain
end

describe("error bars on a terminal", function()
  teardown(program.clean)

  it("show a line once all levels together have taken a second", function()
    local out = on_terminal(BARS)
    local list, plain = waits(out)
    assert.is_true(#list >= 5, out)
    for k, after in ipairs(list) do assert.is_near(math.max(0, 1 - 0.3 * (k - 1)), after, 0.01) end
    assert.equal(1, plain)
    assert.truthy(out:find("\r[^\r\n]*mine, level 3, 24 segments[^\r\n]*t = "), out)
    assert.falsy(out:find("\r[^\r\n]*mine, level 1, 6 segments[^\r\n]*t = "), out)
  end)

  it("remove that line at the end", function()
    local out = on_terminal(BARS)
    assert.falsy(out:find("steps in", 1, true), out)
    assert.falsy(out:find "t = [^\r\n]*\r?\n", out)
    assert.truthy(out:find "\r\27%[K[^\r]*mine: quiet", out)
  end)

  it("write a line for each level when asked, as before", function()
    local out = on_terminal(BARS .. ", progress = true")
    for k, segments in ipairs { 6, 12, 24 } do
      local line = ("mine, level %d, %d segments: t = 10.00 ms, "):format(k, segments)
      assert.truthy(out:find(line, 1, true), out)
    end
  end)

  it("show nothing with progress = false", function()
    assert.falsy(on_terminal(BARS .. ", progress = false"):find "t = ")
  end)
end)

it("error bars show nothing where there is no terminal", function()
  local out, err, code = program.script(SCRIPT:format(BARS))
  assert.equal(0, code, err)
  assert.equal("", err)
  assert.truthy(out:find("mine, level 3, 24 segments: quiet true", 1, true), out)
  program.clean()
end)
