-- SPDX-License-Identifier: GPL-3.0-or-later
-- Files of scenes: reading them, their faults, and files with false contents.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local core = sw.core
local fails, script, files_of = saving.fails, saving.script, saving.files_of
local file, same = saving.temporary, saving.same

after_each(saving.clean)

describe("a file that may be there", function()
  it("is an error for scene:resume: a script that began anew would write over it", function()
    local loop = file()
    os.remove(loop)
    os.execute(("ln -s '%s' '%s'"):format(loop, loop)) -- a link to itself: nobody can tell
    local scene = sw.scene {}
    fails({ "scene:resume: cannot read " .. loop, "Too many levels of symbolic links" }, scene.resume, scene,
      loop)
    fails({ "scene:resume: cannot read", "zero byte in the path" }, scene.resume, scene, "a\0b")
    os.remove(loop)
    assert.is_false(scene:resume(loop))
  end)
end)

describe("sw.load", function()
  it("gives a scene whose objects are found by name, and which runs and settles", function()
    local path, c = file(), script()
    files_of(c, { dt = 0.005, save = path })
    local scene = sw.load(path)
    assert.are.equal("left left#2 plane1 wire1", table.concat(scene:names(), " "))
    local wire, left = scene:find "wire1", scene:find "left"
    assert.are.equal("gripper", getmetatable(left).__name)
    assert.are.equal(c.left.peak_force, left.peak_force)
    assert.are.equal(c.wire:cable().name, wire:cable().name)
    assert.are.equal(c.wire:bend_limit().limit, wire:bend_limit().limit)
    left:move{ by = { 0, 0, 0.01 }, duration = 0.1 }
    assert.is_true(scene:run{ duration = 0.1, dt = 0.005 }.ok)
    left:release()
    assert.is_true(scene:settle().ok)
    local called = 0
    scene:process(function(p) p:step("grasp", function() called = called + 1 end) end)
    scene:run() -- not a step of the file's process
    assert.are.equal(1, called)
    fails({ "nothing named 'lef'", "did you mean 'left'?" }, scene.find, scene, "lef")
    fails("expects a name", scene.find, scene)
  end)

  it("gives meshes to draw", function()
    local path = file()
    local scene = sw.scene{}
    scene:obstacle{ shape = "hull", points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 } }
    scene:wire{ E = 1e8, density = 1e3, radius = 0.01, from = { 0, 0, 2 }, to = { 1, 0, 2 } }
    scene:save(path)
    local loaded = sw.load(path)
    local a = scene:run{ duration = 0.01, dt = 0.01 }:document().obstacles[1]
    local b = loaded:run{ duration = 0.01, dt = 0.01 }:document().obstacles[1]
    assert.are.same(a.vertices, b.vertices)
    assert.are.same(a.indices, b.indices)
  end)
end)

-- A small scene, saved.
local function small()
  local scene = sw.scene{ name = "small" }
  scene:obstacle{ name = "table", shape = "plane" }
  local wire = scene:wire{ name = "a", E = 1e8, density = 1000, radius = 0.003, segments = 6,
    from = { 0, 0, 0.003 }, to = { 0.2, 0, 0.003 } }
  scene:force{ kind = "plastic", on = wire, yield_moment = 1e-3 }
  scene:clamp(wire, { name = "hold", s = 0 }):follow{ points = { { 0, 0, 0 }, { 0, 0, 0.1 } },
    duration = 0.1, relative = true }
  scene:gripper{ name = "left" }
  return scene
end

local function small_file(path)
  local scene = small()
  scene:run{ duration = 0.03, dt = 0.005, frame = 0.01 }
  scene:save(path)
  return saving.read(path), scene
end

describe("a file of a scene", function()
  it("has the same bytes each time; a failure to write it is an error", function()
    local one, two = file(), file()
    local bytes, scene = small_file(one)
    scene:save(two)
    assert.are.equal(bytes, saving.read(two))
    fails("cannot write", scene.save, scene, "/no/such/folder/x.sws")
    fails({ "scene:save", "name of a file" }, scene.save, scene)
    fails("scene:save is a method", scene.save, 3)
  end)

  it("is refused with its fault named", function()
    local path = file()
    local bytes, scene = small_file(path)
    local before = saving.all(scene)
    local function wrong(texts, content)
      saving.write(path, content)
      local list = type(texts) == "table" and texts or { texts }
      list[#list + 1] = path
      fails(list, sw.load, path)
      local c = small()
      local here = saving.all(c)
      fails(list, c.resume, c, path)
      same(here, saving.all(c))
    end
    wrong("not a scene saved by SoftWorld", "")
    wrong("not a scene saved by SoftWorld", "hello, world, this is no scene")
    wrong("cut off", bytes:sub(1, 20))
    wrong("cut off", bytes:sub(1, -2))
    wrong("version 99", bytes:sub(1, 16) .. string.pack("<I4", 99) .. bytes:sub(21))
    wrong("another byte order", bytes:sub(1, 20) .. bytes:sub(21, 24):reverse() .. bytes:sub(25))
    wrong("damaged", bytes .. "x")
    wrong("damaged", bytes:sub(1, 500) .. "\1" .. bytes:sub(502))
    same(before, saving.all(scene))
    os.remove(path)
    fails({ path, "cannot read" }, sw.load, path)
    assert.is_false(small():resume(path))
  end)

  -- One file of each former version of the format: a clamped wire of four segments after 0.01 s.
  for version = 1, 31 do
    it("of version " .. version .. " of the format is told from one of now, with the way out", function()
      local path, scene = ("spec/scene/old/version_%d.sws"):format(version), small()
      local before = saving.all(scene)
      for _, read in ipairs{ sw.load, function(name) return scene:resume(name) end } do
        fails({ path, ("version %d of the file format, and this SoftWorld reads version 33"):format(version),
          "write it again with the scene's script", "the SoftWorld that wrote it" }, read, path)
      end
      same(before, saving.all(scene))
    end)
  end

  it("refuses what cannot be saved, and says what to do", function()
    local path = file()
    local scene = small()
    local force = scene:force{ kind = function() end, on = scene:find "a" }
    fails({ "force 2", "wire a", "Lua function", "remove it" }, scene.save, scene, path)
    force:release()
    scene:save(path)
    local hold = scene:find "hold"
    hold:follow(nil)
    local x = hold:pose()
    hold:follow{ func = function() return x end, duration = 0.02, step = 1e-3 }
    fails({ "'hold' follows a Lua function until t = 0.02 s", "points" }, scene.save, scene, path)
    scene:run{ duration = 0.03, dt = 0.005 }
    scene:save(path)
    hold:follow{ func = function() return x end, step = 1e-3 }
    fails({ "'hold'", "without an end" }, scene.save, scene, path)
    hold:follow(nil)
    scene:process(function(p) p:wait(1) end)
    scene:run{ duration = 0.01, dt = 0.005 }
    fails({ "process 1", "under way" }, scene.save, scene, path)
    local c = script(function(_, c) c.scene:save(path) end)
    fails({ "a run of scene 'laying' is under way" }, c.scene.run, c.scene, { dt = 0.005 })
  end)

  it("replaces a scene, whose older snapshots are refused", function()
    local path = file()
    small_file(path)
    local scene = small()
    local snapshot = scene:snapshot()
    scene:resume(path)
    fails("before a file took its place", scene.restore, scene, snapshot)
    local again = scene:snapshot()
    scene:run{ duration = 0.01, dt = 0.005 }
    scene:restore(again)
    assert.are.equal(0.03, scene.time)
  end)
end)

-- --- files that are not what they should be --------------------------------------------------

local HEAD = 40 -- bytes before the part that the checksum covers
local function sealed(bytes)
  local sum = -3750763034362895579 -- FNV-1a, as the core has it
  for i = HEAD + 1, #bytes do sum = (sum ~ bytes:byte(i)) * 1099511628211 end
  return bytes:sub(1, 24) .. string.pack("<I8i8", #bytes, sum) .. bytes:sub(HEAD + 1)
end

-- Reads a file: false if sw.load raises an error, true if it gives a scene, which is run, read and saved.
local function digest(path, bytes)
  saving.write(path, bytes)
  local fine, scene = pcall(sw.load, path)
  if not fine then
    assert.are.equal("string", type(scene))
    return false
  end
  pcall(function()
    scene:run{ duration = 0.01, dt = 0.005, max_steps = 4 }
    saving.all(scene)
    scene:save(path)
  end)
  scene:close()
  return true
end

-- Returns a generator of random numbers that are the same in every run.
local function numbers(seed)
  return function(n)
    seed = (seed * 1103515245 + 12345) % 2147483648
    return seed // 8 % n + 1
  end
end

describe("a file with false contents", function()
  local function all_files()
    local list, path = {}, file()
    list[1] = small_file(path)
    for _, case in ipairs(saving.cases) do
      if case.name:find "model = tube" or case.name:find "feed" or case.name:find "joined"
        or case.name == "particles" or case.name:find "released" or case.name:find "touch each" then
        local scene = case.build()
        case.before(scene)
        scene:save(path)
        list[#list + 1] = saving.read(path)
      end
    end
    return list
  end

  it("is refused wherever it is cut off, with or without a new checksum", function()
    local path, random = file(), numbers(1)
    for _, bytes in ipairs(all_files()) do
      for k = 1, 40 do
        local cut = bytes:sub(1, k <= 10 and #bytes - k or HEAD + random(#bytes - HEAD - 1))
        assert.is_false(digest(path, cut))
        assert.is_false(digest(path, sealed(cut)))
      end
    end
  end)

  it("does no harm, whatever its bytes are", function()
    local path, random, taken, refused = file(), numbers(2), 0, 0
    for _, bytes in ipairs(all_files()) do
      assert.are.equal(bytes, sealed(bytes))
      for k = 1, 120 do
        local at = HEAD + random(#bytes - HEAD)
        local byte = ({ 0, 255, 127, 128, 1 })[random(5)]
        if k % 2 == 0 then byte = bytes:byte(at) ~ (1 << (random(8) - 1)) end
        local changed = bytes:sub(1, at - 1) .. string.char(byte) .. bytes:sub(at + 1)
        if changed ~= bytes then
          assert.is_false(digest(path, changed)) -- the checksum finds it
          if digest(path, sealed(changed)) then taken = taken + 1 else refused = refused + 1 end
        end
      end
    end
    assert.is_true(taken > 50 and refused > 50, ("%d taken, %d refused"):format(taken, refused))
  end)

  it("leaves a scene as it was where it cannot be resumed", function()
    local path, random = file(), numbers(3)
    local bytes = small_file(path)
    local scene = small()
    local before, refused = saving.all(scene), 0
    for _ = 1, 300 do
      local at = HEAD + random(#bytes - HEAD)
      local changed = bytes:sub(1, at - 1) .. string.char(random(256) - 1) .. bytes:sub(at + 1)
      saving.write(path, sealed(changed))
      if pcall(scene.resume, scene, path) then
        scene = small()
      else
        refused = refused + 1
        same(before, saving.all(scene))
      end
    end
    assert.is_true(refused > 20, refused .. " refused")
  end)
end)

describe("memory of saved scenes", function()
  local function in_use()
    collectgarbage()
    collectgarbage()
    return (core.allocated())
  end

  it("may run out at any request; nothing is lost or changed", function()
    local path = file()
    small_file(path)
    local bytes = saving.read(path)
    local scene = small()
    scene:run{ duration = 0.01, dt = 0.005 }
    local here = saving.all(scene)
    local base = in_use()
    for name, work in pairs{
      save = function() core.save(scene, "") end,
      load = function() core.load(bytes):close() end,
      resume = function() core.resume(scene, bytes) end,
    } do
      local n, failed = 0, 0
      repeat
        n = n + 1
        core.fail_allocation(n)
        local fine, why = pcall(work)
        core.fail_allocation(0)
        if not fine then
          failed = failed + 1
          assert.is_truthy(tostring(why):find "memory", tostring(why))
          if name ~= "save" then same(here, saving.all(scene)) end
          assert.are.equal(base, in_use(), name .. " " .. n)
        end
      until fine
      assert.is_true(failed > 5, name)
      if name == "resume" then
        scene = small()
        scene:run{ duration = 0.01, dt = 0.005 }
        base = in_use()
      end
    end
  end)

  it("does not grow", function()
    local path = file()
    small_file(path)
    local function round()
      local scene = sw.load(path)
      scene:resume(path)
      scene:save(path)
      scene:close()
    end
    round()
    local before = in_use()
    for _ = 1, 20 do round() end
    assert.are.equal(before, in_use())
  end)
end)
