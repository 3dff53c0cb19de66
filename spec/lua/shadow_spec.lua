-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scripts whose global variables have names of Lua's own: table = scene:obstacle{...}.
require "softworld"
local program = require "host.program"

-- Does a bit of everything, with each standard global replaced by an obstacle.
local SCRIPT = [[
local sw = require "softworld"
local pcall, print, tostring, open = pcall, print, tostring, io.open
local real, names = {}, {}
for name, value in pairs(_G) do
  real[name] = value
  if name ~= "_G" and name ~= "print" then names[#names + 1] = name end
end
local G, folder = _G, ...

local function all()
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 10 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:gripper{ name = "hand", at = { 0.2, 0, 0 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.2 })
    hand:move{ by = { 0, 0, 0.01 }, speed = 0.1 }
    p:wait(0.01)
  end)
  local run = scene:run{}
  local check = run:check{}
  tostring(check)
  sw.compare(check, check)
  run:summary(open("/dev/null", "w"))
  run:save(folder .. "/a.csv")
  run:report(folder .. "/a.html")
  scene:save(folder .. "/a.sws")
  sw.load(folder .. "/a.sws")
  scene:describe()
  scene:settle()
  sw.study{ name = "s", workers = 2, parameters = { x = { 0, 1 } }, evaluate = function(p)
    return { y = p.x }
  end }:sweep{ count = 3 }
  return run.ok
end

local table_of = sw.scene{}:obstacle{ name = "table", shape = "plane" }
for i = 1, #names do
  local name = names[i]
  G[name] = table_of
  local fine, why = pcall(all)
  G[name] = real[name]
  if not fine then print(name, why) end
end
print(#names > 20, "end")
]]

describe("a global variable of a script", function()
  teardown(program.clean)

  it("may have the name of a standard one", function()
    local name = program.write(program.folder() .. "/script.lua", SCRIPT)
    local out = program.run{ name, program.folder() }
    assert.equal("true\tend\n", out)
  end)
end)
