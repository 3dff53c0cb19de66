-- SPDX-License-Identifier: GPL-3.0-or-later
-- Events of a run that is ok say that a number may be wrong. A script that prints numbers and does not look
-- at run.events gets a note at its end.
require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- A wire that is pulled beyond its breaking load, or only held.
local pulled = [[
local sw = require "softworld"
local function pull(way)
  local scene = sw.scene{ name = "pull" }
  local wire = scene:wire{ cable = "GXL 1.5", from = {0, 0, 0}, to = {0.3, 0, 0}, segments = 20 }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = wire.length }):follow{ points = { {0, 0, 0}, {way or 0.01, 0, 0} }, duration = 0.1,
    relative = true }
  return scene:run{ duration = 0.1, dt = 0.01 }
end
]]

describe("a run with events", function()
  after_each(program.clean)

  it("is told at the end of a script that did not look at them; the script succeeds", function()
    local out, err, code = script(pulled .. "local run = pull()\nprint(run.ok)")
    assert.equal("true\n", out)
    assert.truthy(err:find("softworld: note: the run of 'pull' at script.lua:10 is ok, but has 1 event; see "
      .. "run.events: breaking: wire 'wire1' is pulled by ", 1, true), err)
    assert.equal(0, code)
  end)

  for what, code in pairs{ events = "print(#run.events)", summary = "run:summary()",
    check = "run:check{ use = 'movement' }" } do
    it("is not told when the script looked: " .. what, function()
      local _, err, status = script(pulled .. "local run = pull()\n" .. code)
      assert.is_nil(err:find("note:", 1, true), err)
      assert.equal(0, status)
    end)
  end

  it("is not told without events, and within tuning", function()
    local _, err = script(pulled .. [[
      pull(1e-6)
      assert(sw.tune.minimise{ from = 0, to = 1, max_iterations = 3,
        f = function(x) pull() return x * x end }.reason)]])
    assert.equal("", err)
  end)

  it("is told five times at most, with the number of the others", function()
    local _, err = script(pulled .. [[
      for k = 1, 8 do
        local run = pull()
        if k == 2 then print(#run.events) end
      end]])
    local _, count = err:gsub("is ok, but has", "")
    assert.equal(5, count)
    local others = "softworld: note: 2 more runs with events that the script did not look at"
    assert.truthy(err:find(others, 1, true), err)
  end)

  it("says their number when it is printed", function()
    local out = script(pulled .. "print(pull())")
    assert.truthy(out:find("s of computing, 1 event (run.events)\n", 1, true), out)
  end)
end)

-- A wire that is pulled out of its clip. Asking the clip is a look at this event, and at no other.
describe("the event of a wire that came out of its clip", function()
  local out_of_clip = [[
local sw = require "softworld"
local scene = sw.scene{ name = "pull" }
local wire = scene:wire{ cable = "GXL 1.5", from = {0, 0, 0.05}, to = {0.3, 0, 0.05}, segments = 80 }
scene:force{ kind = "damping", mass = 2, stiffness = 2e-3 }
local clip = scene:clip{ name = "c", at = {0.15, 0, 0.02}, width = 0.01, insertion = 2, retention = 4 }
local hand = scene:gripper{ pads = { width = 0.006 } }
scene:process(function(p)
  hand:grasp(wire, { s = 0.15 })
  hand:clip{ into = clip }
  hand:move{ by = {0, 0, 0.03}, speed = 0.05 }
end)
]]
  after_each(program.clean)

  it("is told if the script does not ask the clip", function()
    local _, err, code = script(out_of_clip .. "scene:run{}\nprint(clip.inserted.time)")
    assert.truthy(err:find("is ok, but has 1 event; see run.events: out: clip 'c', wire 'wire1': the wire "
      .. "comes out, at", 1, true), err)
    assert.equal(0, code)
  end)

  for _, look in ipairs{ "clip.pulled_out.time", "clip:seated()", "clip:state()", "clip.wire" } do
    it("is not told after " .. look, function()
      local _, err = script(out_of_clip .. "scene:run{}\nprint(" .. look .. ")")
      assert.equal("", err)
    end)
  end

  it("is not told of a clip that the script asks while it runs", function()
    local _, err = script(out_of_clip:gsub("speed = 0.05 }", "speed = 0.05 }\n  print(clip:state())")
      .. "scene:run{}")
    assert.equal("", err)
  end)
end)
