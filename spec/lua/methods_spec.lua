-- SPDX-License-Identifier: GPL-3.0-or-later
-- Every method of every object, called with wrong arguments and on a wrong object: the error names the
-- call, and is no raw Lua error from inside the library.
local sw = require "softworld"
local core = sw.core

local function zoo()
  local scene = sw.scene { name = "zoo" }
  local wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 20, from = { 0, 0, 0 },
    to = { 1, 0, 0 } }
  local tube = scene:wire { model = "tube", E = 5e7, density = 1500, radius = 0.005, from = { 0, 1, 0 },
    to = { 0.06, 1, 0 } }
  local a = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 10, from = { 0, 0, 3 },
    to = { 0.5, 0, 3 } }
  local b = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 10, from = { 0.5, 0, 3 },
    to = { 1, 0, 3 } }
  local objects = { scene = scene, wire = wire,
    obstacle = scene:obstacle { shape = "plane", friction = 0.3, at = { 0, 0, -0.2 } },
    clamp = scene:clamp(wire, { s = 0 }), gripper = scene:gripper { name = "hand" },
    force = scene:force { kind = "drag", linear = 0.1 },
    clip = scene:clip { at = { 0.5, 0.1, 0 }, width = 0.01, insertion = 8, retention = 25, friction = 0.25 },
    channel = scene:channel { points = { { 0, 2, 0 }, { 1, 2, 0 } }, width = 0.02, depth = 0.02 },
    tie = scene:tie(wire, { s = 0.9, to = { 0.9, 0, 0.1 }, slack = 0.2 }),
    particles = scene:particles { positions = { { 0, 0, 5 }, { 0.1, 0, 5 } }, masses = 0.1, radius = 0.01 },
    join = scene:join { ends = { { a, s = 0.5 }, { b, s = 0 } } }, snapshot = scene:snapshot(),
    trajectory = sw.trajectory { points = { { 0, 0, 0 }, { 1, 0, 0 } }, speed = 0.1 },
    process = scene:process(function(p) p:wait(0.001) end),
    study = sw.study { name = "zoo", workers = 0, parameters = { x = { 0, 1 } },
      evaluate = function(p) return { y = p.x } end },
    shape = sw.shape { shape = "box", size = { 1, 1, 1 } }, cable = sw.cable "GXL 1.5" }
  objects.run = scene:run { duration = 0.002, dt = 0.001, frame = 0.001 }
  objects.section = tube:section(0.03)
  return objects
end

local function methods_of(object)
  local found, names = {}, {}
  local meta = getmetatable(object)
  local index = type(object) == "table" and type(meta.__index) == "table" and meta.__index
  for _, list in ipairs { core.class[core.type(object)] or meta, index or {} } do
    for name, f in pairs(list) do
      if type(name) == "string" and name:sub(1, 2) ~= "__" and type(f) == "function" then found[name] = f end
    end
  end
  for name in pairs(found) do names[#names + 1] = name end
  table.sort(names)
  return found, names
end

-- Checks that an error is no raw one of Lua, and long enough to say something.
local function check(label, ok, message)
  if ok then return end
  message = tostring(message)
  for _, raw in ipairs { "attempt to ", "bad argument", "stack overflow", "no integer representation" } do
    assert.is_nil(message:find(raw, 1, true), label .. ": " .. message)
  end
  assert.is_true(#message > 15, label .. ": " .. message)
end

local WRONG = { { 5 }, { 0.5 }, { "text" }, { true }, { {} }, { { 1, 2, 3 } }, { print }, { { x = {} } },
  { io.stdout }, { 0 / 0 }, { -1 }, { "" }, { 5, 5 }, { "a", "b" }, { {}, {} }, { 0.1, "x" }, { "x", {} },
  { {}, 5 }, { 1, 2, "z" }, { print, 5 }, { { 0, 0, 0 }, 5 } }

describe("methods", function()
  local quiet, write = print, io.write
  before_each(function() print, io.write = function() end, function() end end) -- luacheck: ignore
  after_each(function() print, io.write = quiet, write end) -- luacheck: ignore

  -- some of the wrong arguments are valid names of files
  local files, there = { "a", "text", "x" }, {}
  setup(function()
    for _, name in ipairs(files) do
      local file = io.open(name)
      if file then file:close() end
      there[name] = file ~= nil
    end
  end)
  teardown(function()
    for _, name in ipairs(files) do
      if not there[name] then os.remove(name) end
    end
  end)

  for kind in pairs(zoo()) do
    it("of " .. kind .. " called with wrong arguments name the call", function()
      local count = 0
      local found, names = methods_of(zoo()[kind])
      for _, name in ipairs(names) do
        local objects = zoo()
        for _, arguments in ipairs(WRONG) do
          if not (kind == "run" and name == "summary" and arguments[1] == io.stdout) then
            check(kind .. ":" .. name, pcall(found[name], objects[kind], table.unpack(arguments)))
            count = count + 1
          end
        end
        pcall(objects.scene.close, objects.scene)
      end
      assert.is_true(count >= #WRONG)
    end)

    it("of " .. kind .. " called on something else say what they are", function()
      local objects = zoo()
      local found, names = methods_of(objects[kind])
      for _, name in ipairs(names) do
        for _, self in ipairs { 5, "x", {}, objects.gripper, objects.scene, objects.shape, objects.run,
          false } do
          if kind ~= (core.type(self) or self == objects[kind] and kind) and name ~= "solids" then
            local ok, message = pcall(found[name], self or nil)
            assert.is_false(ok, kind .. ":" .. name)
            check(kind .. "." .. name, ok, message)
            local what = kind == "clamp" and message:find "clamp" or message:find(kind, 1, true)
            assert.truthy(what, kind .. ":" .. name .. ": " .. message)
            assert.truthy(message:find(name, 1, true) or message:find "expected", message)
          end
        end
      end
    end)
  end

  it("give clear messages in cases that once did not", function()
    local objects = zoo()
    local function says(text, f, ...)
      local ok, message = pcall(f, ...)
      assert.is_false(ok)
      assert.truthy(message:find(text, 1, true), message)
    end
    local function call(name, method, ...) return objects[name][method](objects[name], ...) end
    says("channel:moment takes one table of parameters, got number", call, "channel", "moment", 5)
    says("scene:frame: the number of the frame must be an integer, got 0.5", call, "scene", "frame", 0.5)
    says("clamp:log: t1 must be a time [s], got string", call, "clamp", "log", "x")
    says("run:save expects the name of a .csv or .json file, got nil", call, "run", "save")
    says("run:chart takes one table of parameters, got number", call, "run", "chart", 5)
    says("run:chart: path must be a string, got a table", call, "run", "chart", { path = {} })
    local entry = sw.cable "GXL 1.5"
    says("bend_limit: diameter = table", entry.bend_limit, entry, "fixed", {})
    says("bend_limit: diameter = -1 is not allowed; it must be a number above 0 m", entry.bend_limit,
      entry, "fixed", -1)
    says("cable.bend_limit: must get a cable from sw.cable", sw.cable.bend_limit, { use = "fixed" })
    says("trajectory:save: the number of samples = 1 must be", call, "trajectory", "save", "x", 1)
    says("gripper:move is a method: call it with a colon", objects.gripper.move)
    says("wire:position is a method: call it with a colon (wire expected, got nothing)",
      objects.wire.position)
    says("trajectory: a table of parameters, a function or a trajectory is needed", sw.trajectory)
  end)
end)
