-- SPDX-License-Identifier: GPL-3.0-or-later
-- Events: the list of what happened in a run.
local sw = require "softworld"

local function scene()
  local s = sw.scene{ gravity = { 0, 0, 0 } }
  s:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 10 }
  return s
end

describe("events", function()
  it("of a run are those since its start", function()
    local s = scene()
    s:tell{ kind = "old", text = "before the run" }
    s:process(function(p)
      p:wait(0.1)
      s:tell{ kind = "new", object = "hand", s = 0.2, value = 3, text = "in it" }
    end)
    local run = s:run{}
    assert.equal(1, #run.events)
    local e = run.events[1]
    assert.same({ "new", "hand", "in it", 1 }, { e.kind, e.object, e.text, e.count })
    assert.near(0.1, e.time, 1e-12)
    assert.same({ 0.2, 3 }, { e.s, e.value })
  end)

  it("repeated within a short time are merged into one, with count, largest value and its place", function()
    local s = scene()
    s:process(function(p)
      for k = 1, 9 do
        s:tell{ kind = "slip", object = "a", s = k / 10, value = -(5 - math.abs(k - 5)), text = "slip " .. k }
        p:wait(0.02)
      end
      p:wait(1)
      s:tell{ kind = "slip", object = "a", value = 1, text = "later" }
      s:tell{ kind = "slip", object = "b", value = 1, text = "another" }
    end)
    local list = s:run{}.events
    assert.equal(3, #list)
    assert.same({ 9, -5, 0.5, "slip 5" }, { list[1].count, list[1].value, list[1].s, list[1].text })
    assert.near(0.16, list[1].last, 1e-9)
    assert.near(0.08, list[1].time, 1e-9)
  end)

  it("are limited to 512; the others are counted as dropped", function()
    local s = scene()
    for k = 1, 2000 do s:tell{ kind = "k" .. k, text = "one" } end
    local list, dropped = s:events()
    assert.equal(512, #list)
    assert.equal(2000 - 512, dropped)
  end)

  -- A text has at most 223 bytes, three of them dots if it is cut. "ü" has two bytes; eight reach beyond.
  it("with a text that is too long end with three dots, after a whole letter", function()
    local s = scene()
    for k, start in ipairs{ 216, 217 } do
      local text = ("a"):rep(start) .. ("ü"):rep(8)
      s:tell{ kind = "long" .. k, text = text }
      s:tell{ kind = "fits" .. k, text = text:sub(1, start + (k == 1 and 6 or 4)) }
    end
    local list = s:events()
    assert.same({ ("a"):rep(216) .. "üü...", ("a"):rep(216) .. "üüü" }, { list[1].text, list[2].text })
    assert.same({ ("a"):rep(217) .. "ü...", ("a"):rep(217) .. "üü" }, { list[3].text, list[4].text })
  end)

  it("told after a snapshot are gone once it is restored", function()
    local s = scene()
    s:run{ duration = 0.1 }
    s:tell{ kind = "kept", text = "kept" }
    local before = s:snapshot()
    s:process(function(p) p:wait(0.5) s:tell{ kind = "gone", text = "gone" } end)
    s:run{}
    s:restore(before)
    for _, e in ipairs((s:events())) do assert.not_equal("gone", e.kind) end
  end)

  it("may be told of an earlier time", function()
    local s = scene()
    s:process(function(p)
      p:wait(0.5)
      s:tell{ kind = "early", text = "seen late", time = 0.2 }
      s:tell{ kind = "early", text = "seen late, too", time = 0.25 }
      s:tell{ kind = "early", text = "another", time = 0.45 }
      assert.has_error(function() s:tell{ kind = "x", text = "y", time = 0.6 } end,
        "scene:tell: time = 0.6 s lies ahead; it must be at most the scene's 0.5 s")
    end)
    local list = s:run{}.events
    assert.equal(2, #list)
    assert.same({ 0.2, 0.2, 0.25, 2 }, { list[1].time, list[1].first, list[1].last, list[1].count })
    assert.same({ 0.45, "another" }, { list[2].time, list[2].text })
  end)

  it("may be told again for their time, with a larger value", function()
    local s = scene()
    s:process(function(p)
      for k = 1, 5 do
        p:wait(0.2)
        s:tell{ kind = "grows", text = ("value %d"):format(k), value = k, time = 0.2 }
      end
    end)
    local list = s:run{}.events
    assert.equal(1, #list)
    assert.same({ 0.2, 0.2, 1, 5, "value 5" },
      { list[1].time, list[1].last, list[1].count, list[1].value, list[1].text })
  end)

  it("refuse missing and unknown parameters", function()
    local s = scene()
    assert.has_error(function() s:tell{ kind = "x" } end, "scene:tell: text is required [-]: one sentence")
    assert.has_error(function() s:tell{ kind = "", text = "x" } end,
      "scene:tell: kind is empty; it is a word")
    assert.has_error(function() s:tell{ knd = "x", text = "" } end,
      "scene:tell: there is no parameter 'knd'; did you mean 'kind'?")
  end)

  it("are in the summary", function()
    local s = scene()
    s:process(function(p)
      p:wait(0.1)
      s:tell{ kind = "new", text = "the wire did something" }
    end)
    local run, text = s:run{}, {}
    run:summary{ write = function(_, t) text[#text + 1] = t end }
    assert.matches("! t = 100%.0 ms: the wire did something", table.concat(text))
  end)
end)
