-- SPDX-License-Identifier: GPL-3.0-or-later
-- A wire that slips out of pads: the run is ok, the process is not. A script that does not look is told.
require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

-- Smooth pads grip a cable on a table with a force, and lift it.
local lifted = [[
local sw = require "softworld"
local function lift(force, options)
  local scene = sw.scene{ name = "lifted" }
  scene:obstacle{ shape = "plane", friction = 0.3 }
  scene:force{ kind = "damping", mass = 2, stiffness = 1e-3 }
  local z = 0.0014
  local wire = scene:wire{ cable = "GXL 1.5", segments = 30, from = { 0, 0, z }, to = { 0.3, 0, z } }
  local hand = scene:gripper{ name = "hand",
    pads = { width = 0.02, height = 0.016, thickness = 0.004, friction = 0.05, opening = 0.009 } }
  local watched
  scene:process(function(p)
    local on_slip = options and options.on_slip
    hand:grasp(wire, { s = 0.15, force = force, approach = "plates", on_slip = on_slip })
    hand:move{ by = { 0, 0, 0.05 }, duration = 0.5 }
    p:wait(0.2)
    if options and options.asks then watched = hand.slip_event ~= nil end
  end)
  local run = scene:run{ dt = 0.005 }
  return run, hand, watched
end
]]

describe("a wire that slips out of the pads", function()
  after_each(program.clean)

  it("is told at the end of a script that did not look", function()
    local out, err, code = script(lifted .. "local run, hand = lift(0.1)\nprint(run.ok)")
    assert.equal("true\n", out)
    assert.truthy(err:find("softworld: note: the run of 'lifted' at script.lua:18 is ok, but gripper 'hand': "
      .. "nothing is left between the pads at t = ", 1, true), err)
    assert.equal(0, code)
  end)

  for what, code in pairs{ events = "print(#hand.events)", slip_event = "print(hand.slip_event)",
    state = "print(hand:state().margin)", peak_margin = "print(hand.peak_margin)", summary = "run:summary()",
    check = "run:check{ use = 'movement' }", page = "run:report(os.tmpname() .. '.html')" } do
    it("is not told when it did: " .. what, function()
      local _, err, status = script(lifted .. "local run, hand = lift(0.1)\n" .. code)
      assert.is_nil(err:find("note:", 1, true), err)
      assert.equal(0, status)
    end)
  end

  it("is in run.events if it was lost; if it only slipped, a note tells it", function()
    local list = "\nfor _, e in ipairs(run.events) do print(e.kind, e.object) end"
    local out, err = script(lifted .. "local run = lift(0.1)" .. list)
    assert.same({ "lost\thand\n", "" }, { out, err })
    out, err = script(lifted .. "local run = lift(0.7)" .. list)
    assert.equal("", out)
    assert.truthy(err:find("gripper 'hand': the wire slips, ", 1, true), err)
  end)

  it("is not told when the process looks, or something reacts", function()
    local _, err = script(lifted .. "lift(0.1, { asks = true })")
    assert.equal("", err)
    _, err = script(lifted .. "lift(0.1, { on_slip = 'warn' })")
    assert.is_nil(err:find("note:", 1, true), err)
    assert.truthy(err:find("the wire slips", 1, true), err)
    _, err = script(lifted .. "lift(0.1, { on_slip = function() end })")
    assert.equal("", err)
  end)

  it("is not told when it did not slip", function()
    local out, err = script(lifted .. "local run, hand = lift(5)\nprint(run.ok)")
    assert.equal("true\n", out)
    assert.equal("", err)
  end)

  it("is an event of a study's evaluation", function()
    local out, err = script(lifted .. [[
      local study = sw.study{ name = "s", workers = 0, parameters = { force = { 0.1, 5 } },
        evaluate = function(p)
          local run, hand = lift(p.force)
          return { peak = hand.peak_force }
        end }
      local rows = study:sweep{ grid = 2 }
      print(rows[1].events:match "nothing is left", rows[2].events)]])
    assert.equal("nothing is left\tnil\n", out)
    assert.equal("", err)
  end)
end)
