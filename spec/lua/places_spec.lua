-- SPDX-License-Identifier: GPL-3.0-or-later
-- Errors have the line of the calling script, whatever part of the library raises them, and leave nothing
-- half made.
local sw = require "softworld"

local function world()
  local scene = sw.scene{}
  local wire = scene:wire{ E = 1e8, density = 1400, radius = 0.002, from = { 0, 0, 0.1 }, to = { 0.4, 0,
    0.1 },
    segments = 8 }
  return scene, wire, scene:gripper{ at = { 0.2, 0, 0.3 } }
end

describe("an error", function()
  local scene, wire, gripper = world()
  local empty, closed = sw.scene{}, sw.scene{}
  closed:close()
  local way = sw.trajectory{ points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 1 }
  local path = sw.trajectory{ points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 1 }
  path:close()
  local clip = scene:clip{ at = { 0.2, 0, 0.5 }, width = 0.01, insertion = 5, retention = 9 }
  local tie = scene:tie(wire, { s = 0.1 })
  tie:release()
  scene:force{ kind = function() end }
  local wild = sw.scene{} -- diverges in an advance after a run that was ok
  wild:clamp(wild:wire{ E = 1e9, density = 1e3, segments = 30, radius = 2e-3, from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 } }, { s = 0 })
  local earlier = wild:run{ duration = 0.01 }
  wild:advance({ dt = 0.02, integrator = "rk4", unstable = true }, 0.5)
  local judged, tube_section = {}
  do
    local other, tube = world()
    local check = other:run{ duration = 0.001 }:check{}
    judged.check, judged.both = check, sw.compare(check, check)
    tube:remodel{ model = "radial" }
    tube_section = tube:section(0.1)
  end

  for name, call in pairs{
    ["settle without wires"] = function() empty:settle() end,
    ["a run of a scene that diverged"] = function() return earlier and wild:run{ duration = 0.01 } end,
    ["settle of a scene that diverged"] = function() return earlier and wild:settle() end,
    ["a scene that is closed"] = function() closed:wire{} end,
    ["save of a closed scene"] = function() closed:save "x.sws" end,
    ["a trajectory that is closed"] = function() path:save "x.csv" end,
    ["a file that is none"] = function() way:save {} end,
    ["gravity of a new scene"] = function() sw.scene{ gravity = 3 } end,
    ["a function in a file"] = function() scene:save "x.sws" end,
    ["a state without pads"] = function() gripper:state() end,
    ["an opening that is none"] = function() gripper:close_jaws{ force = {} } end,
    ["a fixing that is gone"] = function() tie:tension() end,
    ["a wire that is none"] = function() clip:force(12) end,
    ["a scene that is none"] = function() scene.settle({}) end,
    ["a gripper that is nowhere"] = function()
      local other = world()
      local hand = other:gripper{}
      other:process(function(p) p:wait_until{ distance = 1, between = { hand, { 0, 0, 0 } } } end)
      other:run{ dt = 0.005 }
    end,
    ["a run as a direction"] = function()
      local other, tube = world()
      tube:remodel{ model = "radial" }
      tube:section(0.1):width(other:run{ duration = 0.001 })
    end,
    ["a run as options of a section's chart"] = function()
      local other, tube = world()
      tube:remodel{ model = "radial" }
      tube:section(0.1):chart(other:run{ duration = 0.001 })
    end,
    ["the library as a table of parameters"] = function() sw.scene(sw) end,
    ["a check as a file that cannot be"] = function() local _ = judged.check:csv "/nowhere/c.csv" end,
    ["a check as JSON on a full disk"] = function() local _ = judged.check:json "/dev/full" end,
    ["a check as XML under no name"] = function() local _ = judged.check:junit "" end,
    ["a comparison as a folder"] = function() local _ = judged.both:csv "/" end,
    ["a comparison as a number"] = function() local _ = judged.both:json(3) end,
    ["a section's chart on no disk"] = function()
      local _ = tube_section:chart{ path = "/nowhere/c.svg" }
    end,
    ["way-points of no file"] = function() local _ = sw.trajectory.read "/nowhere/w.csv" end,
    ["a value that cannot say what it is"] = function()
      gripper:close_jaws{ force = setmetatable({}, { __tostring = function() return {} end }) }
    end,
  } do
    it("has the caller's place: " .. name, function()
      local lines = debug.getinfo(call, "S")
      local ok, message = pcall(call)
      assert.is_false(ok)
      local line = tonumber(message:match "places_spec%.lua:(%d+): ")
      assert.is_true(line ~= nil and line >= lines.linedefined and line <= lines.lastlinedefined, message)
      assert.is_nil(message:find "softworld/[%w_]+%.lua", message)
      assert.is_nil(message:find("attempt to", 1, true), message)
      assert.is_nil(message:find("bad argument", 1, true), message)
    end)
  end

  it("in a condition has the place of the waiting process", function()
    local other, _, hand = world()
    local line, message
    other:process(function(p)
      line = debug.getinfo(1, "l").currentline + 1
      local _, why = pcall(function() p:wait_until{ slip = 1e-3, on = hand } end)
      message = why
      p:wait(0.01)
    end)
    assert.is_true(other:run{ dt = 0.005 }.ok)
    assert.is_truthy(message:find("places_spec.lua:" .. line .. ": ", 1, true), message)
  end)

  it("of the script itself stays as it is", function()
    local other, w = world()
    other:force{ kind = function() error("my own", 0) end, on = w }
    for _, call in ipairs{ function() other:settle() end, function() other:run{ duration = 0.1 } end } do
      local ok, message = pcall(call)
      assert.is_false(ok)
      assert.equal("my own", message)
    end
  end)

  it("of a run without steps says that the scene diverged before", function()
    local other, w = world()
    local clamp = other:clamp(w, { s = 0 })
    other:clamp(w, { s = 0.25 })
    clamp:pose{ -0.5, 0, -0.5 } -- far more than the wire can follow
    assert.is_false(other:run{ duration = 0.05 }.ok)
    other:process(function() end)
    local ok, message = pcall(function() other:run() end)
    assert.is_false(ok)
    assert.is_truthy(message:find "places_spec.lua:%d+: .*the last run diverged", message)
  end)

  it("names what is wanted instead of another object or an endless table", function()
    local other, w = world()
    local process = other:process(function() end)
    local endless = setmetatable({}, { __index = function(_, key) return key end })
    local mute = setmetatable({}, { __tostring = function() return {} end })
    for text, call in pairs{ ["scene:gripper: at must be"] = function() other:gripper{ at = process } end,
      ["name is missing"] = function() sw.cable.define(process) end,
      ["there is no material 'a table'"] = function() sw.material(mute) end,
      ["there is no use 'a table'"] = function() sw.cable "GXL 1.5":bend_limit(mute) end,
      ["at is required"] = function() other:clip{ width = endless } end } do
      local ok, message = pcall(call)
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
      assert.is_nil(message:find("softworld/", 1, true), message)
    end
    local write = print
    print = function() end -- luacheck: ignore
    local fine, why = pcall(sw.help, mute)
    print = write -- luacheck: ignore
    assert.is_true(fine, why)
    local said = {}
    local run = other:run{ duration = 0.01 }
    for _, condition in ipairs{ { force = 1, on = process }, { slip = 1, on = run },
      { distance = 1, between = { run, { w, s = 0.1 } } } } do
      other:process(function(p) said[#said + 1] = select(2, pcall(p.wait_until, p, condition)) end)
    end
    other:run{ duration = 0.01 }
    for i, text in ipairs{ "force needs on =", "slip needs on =", "between: a place must be" } do
      assert.is_truthy(said[i]:find(text, 1, true), said[i])
    end
  end)

  it("in a channel leaves no part of it, and its name free", function()
    local other = sw.scene{}
    local args = { name = "c", width = 0.02, depth = 0.02, points = { { 0, 0, 0 }, { 0.2, 0, 0 }, { 1e9,
      0.1, 0 } } }
    local before = table.concat(other:names(), " ")
    assert.has_error(function() other:channel(args) end)
    assert.equal(before, table.concat(other:names(), " "))
    args.points[3] = { 0.4, 0.1, 0 }
    assert.equal("c", other:channel(args).name)
  end)
end)

describe("waiting for a distance", function()
  it("takes grippers, obstacles and points", function()
    local scene, wire, gripper = world()
    local ball = scene:obstacle{ shape = "sphere", radius = 0.01, at = { 0.3, 0, 0.5 } }
    local seen = 0
    scene:process(function(p)
      gripper:grasp(wire, { s = 0.2 })
      for _, between in ipairs{ { gripper, ball }, { gripper, { 0.2, 0, 0.1 } }, { { wire, s = 0.2 },
        gripper } } do
        if p:wait_until({ distance = 1, between = between }, { timeout = 0.01 }) then seen = seen + 1 end
      end
    end)
    assert.is_true(scene:run{ dt = 0.005 }.ok)
    assert.equal(3, seen)
  end)
end)
