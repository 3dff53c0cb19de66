-- SPDX-License-Identifier: GPL-3.0-or-later
-- Every parameter of every object refuses invalid values: the error names object, parameter, value, unit
-- and range, and nothing has changed or leaked.
local sw = require "softworld"
local samples = require "contract.samples"
local core = sw.core

local huge, nan = math.huge, 0 / 0

local function in_use()
  collectgarbage()
  collectgarbage()
  return (core.allocated())
end

-- Each object: { name in errors, rows, good arguments, make(args) -> object or result }.
local scene, wire, sheet
local function fresh()
  scene = sw.scene{ name = "under test", gravity = { 0, 0, 0 } }
  wire = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 6,
    from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  sheet = samples.sheet(scene)
end


local function objects()
  local r, list = samples.registry, {}
  local function add(name, rows, good, make)
    list[#list + 1] = { name = name, rows = rows, good = good, make = make }
  end
  add("scene", r.params.scene, {}, function(args) return sw.scene(args) end)
  local rows = table.move(r.params.section, 1, #r.params.section, #r.params.wire + 1,
    table.move(r.params.wire, 1, #r.params.wire, 1, {}))
  add("wire", rows, { EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 4,
    from = { 0, 0, 1 }, to = { 1, 0, 1 } }, function(args) return scene:wire(args) end)
  add("particles", r.params.particles, { positions = { 0, 0, 1, 0.1, 0, 1 }, masses = 0.1 },
    function(args)
      args.radius = args.radius or 0.01
      return scene:particles(args)
    end)
  for _, hold in ipairs(r.holds) do
    add("hold " .. hold.name, hold.params, samples.hold(hold), function(args)
      return scene[hold.name](scene, wire, args)
    end)
  end
  for _, shape in ipairs(r.shapes) do
    local good = samples.obstacle(shape)
    local all = table.move(r.params.obstacle, 1, #r.params.obstacle, #shape.params + 1,
      table.move(shape.params, 1, #shape.params, 1, {}))
    add("obstacle " .. shape.name, all, good, function(args) return scene:obstacle(args) end)
  end
  for i, force in ipairs(r.forces) do
    if not force.inner then
      add("force " .. force.name, force.params, samples.force(force, i), function(args)
        args.on = force.of_web and sheet or wire
        return scene:force(args)
      end)
    end
  end
  add("run", r.params.run, { duration = 0.01 }, function(args) return scene:run(args) end)
  add("settle", r.params.settle, {}, function(args) return scene:settle(args) end)
  add("trajectory", core.trajectory_parameters(),
    { points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 2 }, sw.trajectory.new)
  return list
end

local function with(good, key, value)
  local args = {}
  for k, v in pairs(good) do args[k] = v end
  if key ~= nil then args[key] = value end
  return args
end

-- Returns values that a row must refuse, each with texts of which the error must have one.
local function refused(row)
  local list = {}
  local function add(value, ...) list[#list + 1] = { value = value, texts = { ... } } end
  local numeric = row.type == "number" or row.type == "integer"
  if numeric then
    add(nan, "nan", "must be")
    add(huge, "inf")
    add(-huge, "-inf")
    add("12", "string")
    add(true, "boolean")
    add({}, "table")
    if row.min then
      local below = row.above and row.min or row.min - math.max(1, math.abs(row.min))
      add(below, ("%.6g"):format(below), "at least", "above", "in ")
    end
    if row.max then
      local beyond = row.below and row.max or row.max + math.max(1, math.abs(row.max))
      add(beyond, ("%.6g"):format(beyond), "at most", "below", "in ")
    end
    if row.type == "integer" then add((row.min or 0) + 1.5, "whole") end
  elseif row.type == "vector" then
    add({ 0, 0 }, "item 3")
    add({ 0, 0, nan }, "item 3", "finite")
    add({ 0, huge, 0 }, "item 2", "finite")
    add({ 0, 0, "1" }, "item 3", "number")
    add({ 0, 0, 0, 0 }, "3 numbers")
    add(1, "number")
    add("x", "string")
    if row.min then add({ row.min - 1, 1, 1 }, ("%.6g"):format(row.min - 1)) end
  elseif row.type == "choice" then
    add("no such thing", "'no such thing'", row.choices[1])
    add(1, "number")
  elseif row.type == "boolean" then
    add(1, "true or false")
    add("yes", "true or false")
  elseif row.type == "text" then
    add(12, "string")
    add(("x"):rep(64), "too long")
    add("a\0b", "zero byte")
    add("a\nb", "line end")
  elseif row.type == "rotation" then
    add({ 0, 0, 0, 0 }, "zero")
    add({ axis = { 0, 0, 0 }, angle = 1 }, "zero")
    add({ axis = { 0, 0, 1 } }, "angle")
    add({ 1, 0, 0 }, "item 4")
    add(3, "number")
  end
  return list
end

local function mentions_one(message, texts)
  for _, text in ipairs(texts) do
    if message:find(text, 1, true) then return true end
  end
  return false
end

-- Everything that can be seen of the scene, as a text.
local function picture()
  local data = core.data(scene)
  return table.concat({ scene.time, #(data.wires or {}), #(data.holds or {}),
    #(data.obstacles or {}), table.concat(wire:positions(), " "), scene:energy().total,
    scene:frame_count() }, ";")
end

local function check_refused(object, args, row, texts)
  local before, bytes = picture(), in_use()
  local ok, message = pcall(object.make, args)
  assert.is_false(ok, ("%s: %s was accepted"):format(object.name, row.name))
  assert.are.equal("string", type(message))
  assert.is_truthy(message:find(row.name, 1, true), message)
  assert.is_true(mentions_one(message, texts), message)
  assert.is_truthy(message:find(object.name:match "^%a+", 1, true)
    or message:find(object.name:match "%a+$", 1, true), message)
  assert.are.equal(before, picture())
  assert.are.equal(bytes, in_use(), message)
  return message
end

for _, object in ipairs(objects()) do
  describe("arguments of " .. object.name, function()
    before_each(fresh)

    it("are accepted as this spec gives them", function()
      object.make(with(object.good))
    end)

    it("are refused out of range and of wrong type", function()
      for _, row in ipairs(object.rows) do
        for _, bad in ipairs(refused(row)) do
          local message = check_refused(object, with(object.good, row.name, bad.value), row, bad.texts)
          if type(bad.value) == "number" and (row.type == "number") and row.unit ~= "-" then
            assert.is_truthy(message:find(row.unit, 1, true), message)
          end
        end
      end
    end)

    it("are required where the rows say so", function()
      for _, row in ipairs(object.rows) do
        if row.required then
          check_refused(object, with(object.good, row.name, nil), row, { "required" })
        end
      end
    end)

    it("are refused when misspelt, with the right name", function()
      for _, row in ipairs(object.rows) do
        if #row.name > 3 then
          local typo = row.name:sub(1, -3) .. row.name:sub(-1) .. row.name:sub(-2, -2)
          if typo ~= row.name then
            local ok, message = pcall(object.make, with(object.good, typo, object.good[row.name] or 1))
            assert.is_false(ok)
            assert.is_truthy(message:find("'" .. typo .. "'", 1, true), message)
            assert.is_truthy(message:find("did you mean", 1, true), message)
          end
        end
      end
      local ok, message = pcall(object.make, with(object.good, "qqqqqqqqqqqq", 1))
      assert.is_false(ok)
      assert.is_truthy(message:find("known are", 1, true), message)
    end)

    it("must be one table with names", function()
      for _, wrong in ipairs{ 12, "text", true, print } do
        if not (object.name == "trajectory" and type(wrong) == "function")
          and not object.name:find "^force" then
          local ok, message = pcall(object.make, wrong)
          assert.is_false(ok)
          assert.is_truthy(message:find(type(wrong), 1, true), message)
        end
      end
      for _, key in ipairs{ 1, 1.5, true } do
        local ok, message = pcall(object.make, with(object.good, key, 1))
        assert.is_false(ok)
        assert.is_truthy(message:find("parameters have names", 1, true), message)
      end
    end)
  end)
end

describe("arguments that are far too large", function()
  before_each(fresh)

  it("are errors, not crashes", function()
    local bytes = in_use()
    for _, segments in ipairs{ 1000000000, 1e15, 2 ^ 53, math.maxinteger } do
      local ok, message = pcall(scene.wire, scene, { EA = 1, EI = 1, mass_per_length = 1, radius = 1,
        from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = segments })
      assert.is_false(ok)
      assert.is_truthy(message:find("segments", 1, true))
    end
    assert.is_false(pcall(scene.frame, scene, math.maxinteger + 1.0))
    assert.is_nil(scene:frame(math.maxinteger))
    assert.is_nil(scene:frame(0))
    assert.are.equal(bytes, in_use())
  end)

  it("may be huge numbers: the run says that it diverged", function()
    for _, x in ipairs{ 1e150, 1e300 } do
      local far = sw.scene{}
      local ok, w = pcall(far.wire, far, { EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
        from = { 0, 0, 0 }, to = { x, 0, 0 }, segments = 4 })
      if ok then
        far:clamp(w, { s = 0 })
        local run = far:run{ duration = 0.1 }
        assert.are.equal(run.ok, (pcall(far.settle, far)))
      end
      far:close()
    end
  end)
end)

describe("other calls", function()
  before_each(fresh)

  it("check their arguments too", function()
    local clamp = scene:clamp(wire, { s = 0 })
    local plane = scene:obstacle{ shape = "plane", at = { 0, 0, -9 } }
    for _, call in ipairs{
      function() wire:position() end, function() wire:position "0.5" end,
      function() wire:position(nan) end, function() wire:set_velocity() end,
      function() wire:set_velocity{ nan, 0, 0 } end, function() wire:set_velocity({ 0, 0, 0 }, 3) end,
      function() wire:max_tension{ then_ = true } end, function() wire:max_tension(3) end,
      function() clamp:pose{ 0, nan, 0 } end, function() clamp:pose({ 0, 0, 0 }, { 0, 0, 0, 0 }) end,
      function() clamp:follow() end, function() clamp:follow(12) end,
      function() clamp:follow{ points = {} } end, function() clamp:moment{ at = 3 } end,
      function() clamp:moment{ about = { 0, 0, 0 } } end, function() clamp:log "x" end,
      function() plane:pose "here" end, function() plane:follow(wire) end,
      function() scene:gravity(9.81) end, function() scene:gravity{ 0, 0, huge } end,
      function() scene:advance({}, nan) end, function() scene:advance({}, huge) end,
      function() scene:advance({}) end, function() scene:frame() end, function() scene:frame "x" end,
      function() scene:restore() end, function() scene:restore(wire) end,
      function() scene:process() end, function() scene:gripper{ pads = 3 } end,
      function() scene:gripper{ at = 3 } end, function() scene:gripper{ at = { 0, 0, nan } } end,
      function() scene:gripper{ name = 3 } end, function() scene:gripper{ pads = { width = -1 } } end,
      function() scene:gripper{ pads = { width = nan } } end, function() scene:gripper(3) end,
      function() scene:gripper{}:grasp() end, function() scene:gripper{}:grasp(wire) end,
      function() scene:gripper{}:grasp(wire, { s = 5 }) end, function() scene:gripper{}:move{} end,
      function() scene:gripper{}:grasp(wire, { s = 0.5, approach = "plates" }) end,
      function() scene:evaluate(clamp) end, function() scene:evaluate(wire, { positions = { 1 } }) end,
      function() scene:evaluate(wire, { direction = 3 }) end,
      function() scene:evaluate(wire, { rate = -1 }) end,
      function() return scene.nonsense end, function() return wire[1] end, function() wire.x = 1 end,
      function() scene.wire{ radius = 1 } end, function() scene.run() end,
      function() scene:clamp(plane, { s = 0 }) end, function() scene:clamp(nil, { s = 0 }) end,
      function() scene:force{ kind = "point", on = plane, s = 0, force = { 0, 0, 0 } } end,
      function() scene:force{ kind = "bend" } end, function() scene:force{} end,
      function() scene:force() end, function() scene:force{ kind = 3 } end,
      function() scene:force{ kind = print, s = 3 } end,
    } do
      local ok, message = pcall(call)
      assert.is_false(ok, debug.getinfo(call, "S").linedefined)
      assert.are.equal("string", type(message))
      assert.is_true(#message > 20, message)
    end
    assert.is_true(scene:run{ duration = 0.01 }.ok)
  end)

  it("to move grippers check theirs, and leave the caller's tables alone", function()
    local left = scene:gripper{ name = "left" }
    left:grasp(wire, { s = 0.5 })
    for _, args in ipairs{ { to = 3 }, { to = { 0, 0 } }, { by = { 0, 0, nan } },
      { by = { 0, 0, 1 }, sped = 1 },
      { points = 3 }, { points = { 1, 2 } }, { to = { 0, 0, 0 }, speed = -1 },
      { by = { 0, 0, 1 }, rotation = { 1, 0, 0, 0 } } } do
      assert.is_false(pcall(left.move, left, args))
    end
    assert.is_false(pcall(left.move, left))
    assert.is_false(pcall(left.rotate, left))
    local points = { { 0.6, 0, 0 }, { 0.6, 0, 0.1 } }
    left:move{ points = points, speed = 0.1 }
    assert.are.equal(2, #points)
  end)

  it("put the caller's line into errors", function()
    local line = debug.getinfo(1, "l").currentline
    local ok, message = pcall(function() scene:wire{} end)
    assert.is_false(ok)
    assert.is_truthy(message:find("arguments_spec.lua:" .. line + 1 .. ":", 1, true), message)
    ok, message = pcall(function() scene:run{ duration = 1, integrator = "bdf2", tolerance = 1 } end)
    assert.is_false(ok)
    assert.is_truthy(message:find("arguments_spec.lua:" .. line + 4 .. ":", 1, true), message)
  end)
end)
