-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a script makes and no run uses: processes after the last run, observers that no run is long enough
-- for, jaws that close on nothing outside of processes, clips that a wire did not go into.
require "softworld"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script

local made = [[
local sw = require "softworld"
local scene = sw.scene{ name = "made", gravity = { 0, 0, 0 } }
local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
local function wait(p) p:wait(0.1) end
]]

describe("what no run uses is told:", function()
  after_each(program.clean)

  it("a process after the last run of its scene", function()
    local _, err = script(made .. "scene:process(wait) scene:run{}\nscene:process(wait)")
    assert.truthy(err:find("script.lua:6: remark: this process never ran", 1, true), err)
    for _, last in ipairs{ "scene:run{}", "scene:settle()", "" } do
      local again = last ~= "" and "scene:process(wait)" or ""
      _, err = script(made .. "scene:process(wait) scene:run{}\n" .. again .. last)
      assert.is_nil(err:find("never ran", 1, true), err)
    end
    _, err = script(made .. "scene:process(wait)\nlocal r = scene:run{ tolerance = { max_tension = 1 } }\n"
      .. "print(r.ok)")
    assert.is_nil(err:find("never ran", 1, true), err)
  end)

  it("a process of a scene that never ran beside another that did", function()
    local _, err = script(made .. "local other = sw.scene{}\nother:process(wait)\nscene:process(wait) "
      .. "scene:run{}")
    assert.truthy(err:find("script.lua:6: remark: this process never ran", 1, true), err)
  end)

  it("no process that a process or an observer makes in a run", function()
    for _, maker in ipairs{ "scene:process(function(p) p:wait(0.01) scene:process(wait) p:wait(0.2) end)",
      "scene:process(wait) scene:observe{ every = 0.05, call = function(o)\n"
        .. "if not again then again = true o:change(function() scene:process(wait) end) end end }" } do
      local _, err = script(made .. maker .. "\nprint(scene:run{ dt = 0.01 }.ok)")
      assert.is_nil(err:find("never ran", 1, true), err)
      assert.is_nil(err:find("error", 1, true), err)
    end
  end)

  it("a call that takes no time, because its gripper is of another scene", function()
    local _, err = script(made .. "local other = sw.scene{ name = 'other' }\n"
      .. "local hand = other:gripper{ name = 'hand', at = { 0, 0, 0 } }\nscene:process(function(p)\n"
      .. "hand:move{ by = { 0, 0, 0.1 }, speed = 0.1 } p:wait(0.1) end)\nprint(scene:run{ dt = 0.01 }.ok)")
    assert.truthy(err:find("script.lua:8: remark: gripper:move returns at once: it is of scene 'other', and "
      .. "this is a process of scene 'made'", 1, true), err)
  end)

  it("an event that is told while no run is under way", function()
    local _, err = script(made .. "scene:tell{ kind = 'note', text = 'a' }")
    assert.truthy(err:find("script.lua:5: remark: scene:tell: no run is under way", 1, true), err)
    _, err = script(made .. "scene:process(function() scene:tell{ kind = 'note', text = 'a' } end)\n"
      .. "scene:remove(wire)\nprint(#scene:run{}.events)")
    assert.equal("", err)
  end)

  it("wires that pass through each other, unless they touch or are joined", function()
    local other = "local o = scene:wire{ name = 'o', cable = 'GXL 1.5', from = { 0.1, %s, 0 }, "
      .. "to = { 0.1, 0.1, %g } }\n%s\nscene:run{ duration = 0.01 }"
    local _, err = script(made .. other:format("-0.1", 0, ""))
    assert.truthy(err:find("remark: wires 'wire1' and 'o' pass through each other near (0.09, 0, 0) m at t = "
      .. "0.01 s: they touch only after scene:wire_contact{}", 1, true), err)
    for _, fine in ipairs{ other:format("-0.1", 0, "scene:wire_contact{}"), other:format("0.004", 0, ""),
      other:format("0", 0, "scene:join{ ends = { { wire, s = 0.1 }, { o, s = 0 } } }") } do
      _, err = script(made .. fine)
      assert.is_nil(err:find("pass through", 1, true), err)
    end
  end)

  it("lengths in mm that are read as m", function()
    for code, text in pairs{
      ["scene:run{ duration = 0.01, tolerance = 1 }"] = "tolerance = 1 m is above 0.02 m",
      ["scene:obstacle{ shape = 'box', size = { 100, 1, 1 }, at = { 0, 0, 9 } }"] =
        "size = 100 m is above 50 m",
      ["scene:obstacle{ shape = 'sphere', radius = 5, at = { 0, 0, 9 } }"] =
        "radius = 5 m is above 4 m" } do
      local _, err = script(made .. code)
      assert.truthy(err:find(text .. "; did you mean sw.units.mm(", 1, true), err)
    end
  end)

  it("an observer", function()
    local _, err = script(made .. "scene:observe{ every = 50, call = print }\nscene:run{ duration = 0.1 }")
    assert.truthy(err:find("note: the observer at script.lua:5 was never called: every = 50 s is longer than "
      .. "the run of 'made', 0.1 s", 1, true), err)
    for _, rest in ipairs{ "scene:run{ duration = 60 }", "o:remove()" } do
      _, err = script(made .. "local o = scene:observe{ every = 50, call = function() end }\n"
        .. "scene:run{ duration = 0.1 } " .. rest)
      assert.is_nil(err:find("never called", 1, true), err)
    end
  end)

  it("jaws that close on nothing", function()
    local hand = "local hand = scene:gripper{ name = 'hand', at = { 0, 0, 1 }, pads = { opening = 0.01 } }\n"
      .. "hand:close_jaws{ force = 2 }\nscene:run{ duration = 2 }\n"
    local _, err = script(made .. hand)
    assert.truthy(err:find("gripper 'hand' closed on nothing at t = ", 1, true), err)
    _, err = script(made .. hand .. "print(#hand.events)")
    assert.is_nil(err:find("note:", 1, true), err)
  end)

  it("a wire that did not go into a clip, unless the script asks the clip", function()
    local clip = [[
local clip = scene:clip{ name = "c", at = { 0.1, 0, -0.02 }, width = 0.04, insertion = 80, retention = 200 }
local hand = scene:gripper{ name = "hand" }
scene:process(function()
  hand:grasp(wire, { s = 0.11 })
  hand:clip{ into = clip, speed = 0.1, max_force = 1, fail = false }
end)
scene:run{ dt = 0.01 }
]]
    local _, err = script(made .. clip)
    assert.truthy(err:find("is ok, but has 1 event; see run.events: unreached: gripper 'hand': clip: wire "
      .. "not in 'c': the force reached", 1, true), err)
    _, err = script(made .. clip .. "print(clip:seated())")
    assert.is_nil(err:find("note:", 1, true), err)
  end)
end)
