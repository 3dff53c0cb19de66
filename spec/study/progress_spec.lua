-- SPDX-License-Identifier: GPL-3.0-or-later
-- The progress line of a study: on terminals only, with the best result that meets the constraints.
local program = require "host.program"
local progress = require "softworld.study.progress"

local own = { name = "grip", parameters = { { name = "x" } }, constraints = { { name = "m", max = 1 } } }

local function record(number, y, m)
  local results = y and { y = y, m = m }
  return { number = number, values = { 0.5 }, results = results, failed = not y and "lost" or nil }
end

-- A line of progress with a clock that the spec sets.
local function new(o)
  local now, texts = 0, {}
  o.clock = function() return now end
  o.stream = { write = function(_, ...) texts[#texts + 1] = table.concat { ... } end, flush = function() end }
  o.terminal, o.width = true, o.width or 200
  local bar = progress.new(own, o.method or "minimise y", o)
  return bar, function(time) now = time end, function() return table.concat(texts) end
end

describe("progress of a study", function()
  teardown(program.clean)

  it("gives rate, time left, failures and the best result that meets the constraints", function()
    local bar, at, text = new { result = "y", total = 40, most = true }
    at(0.5)
    bar:update(record(1, 3, 2)) -- breaks the constraints
    assert.equal("", text()) -- too early to be shown
    at(2)
    bar:update(record(2))
    assert.truthy(text():find("grip: minimise y  2 of at most 40  none meets the constraints yet, 1 failed, "
      .. "1/s, left 38.0 s\27[K", 1, true), text())
    bar:update(record(3, 5, 0), true) -- from the journal: it does not count for the rate
    bar:update(record(4, 4, 0.5), true)
    bar:update(record(5, 1, 1.5), true)
    at(4)
    bar:update(record(6, 4.5, 0.5))
    assert.truthy(text():find("\rgrip: minimise y  6 of at most 40  best 4 (no. 4), 1 failed, 45/min, "
      .. "left 45.3 s\27[K", 1, true), text())
  end)

  it("is drawn at most ten times a second, and cleared at the end", function()
    local bar, at, text = new { method = "sweep", total = 10 }
    at(2)
    bar:update(record(1, 1, 0))
    at(2.05)
    bar:update(record(2, 1, 3))
    assert.equal(1, select(2, text():gsub("\r", "")))
    at(2.2)
    bar:update(record(3, 1, 0))
    assert.truthy(text():find("grip: sweep  3 of 10  2 pass, 1.36/s, left 5.1 s\27%[K$"), text())
    bar:clear()
    assert.truthy(text():find "\r\27%[K$")
    bar:clear()
    assert.equal(3, select(2, text():gsub("\r", "")))
  end)

  it("is no wider than the terminal", function()
    for width = 5, 80 do
      local bar, at, text = new { result = "y", total = 40, width = width }
      at(2)
      bar:update(record(1, 1, 0))
      assert.is_true(#text():gsub("\r", ""):gsub("\27%[K", "") < width)
    end
  end)

  local SCRIPT = [[
local sw = require "softworld"
local study = sw.study { name = "slow", parameters = { x = { 0, 1 } }, workers = 2,
  evaluate = function(p) os.execute "sleep 0.2" return { y = p.x } end }
study:sweep { count = 20 }
print "done"
]]

  it("appears on a terminal, and nowhere else", function()
    local out, err = program.script(SCRIPT)
    assert.equal("done\n", out)
    assert.equal("", err)
    if not program.has_terminals() then
      print "not tested here: progress on a terminal, there is none"
      return
    end
    local script = program.write(program.folder() .. "/script.lua", SCRIPT)
    out = program.shell(("TERM=xterm script -qec '%s %s' /dev/null </dev/null"):format(program.path, script))
    assert.truthy(out:find("\rslow: sweep  %d+ of 20  [%d.]+/s, left [%d.]+ m?s\27%[K"), out)
    assert.truthy(out:find "\r\27%[Kdone\r\n$", out)
  end)
end)
