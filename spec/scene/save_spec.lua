-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scenes in files: going on from one is going on, to the last bit.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local sink = require "softworld.output.sink"
local core = sw.core

local files = {}
local function file()
  files[#files + 1] = saving.file()
  return files[#files]
end

after_each(function()
  for _, name in ipairs(files) do os.remove(name) end
  files = {}
end)

local function same(a, b) assert.is_nil(saving.difference(a, b)) end

local function fails(texts, f, ...)
  local fine, message = pcall(f, ...)
  assert.is_false(fine, "no error")
  message = tostring(message)
  for _, text in ipairs(type(texts) == "table" and texts or { texts }) do
    assert.is_truthy(message:find(text, 1, true), ("'%s' is not in: %s"):format(text, message))
  end
  return message
end

describe("a saved scene goes on with the same bits:", function()
  for _, case in ipairs(saving.cases) do
    it(case.name, function()
      local path, plain = file(), case.build()
      case.before(plain)
      case.after(plain)
      local wanted = saving.all(plain)
      assert.is_true(#wanted > 50)

      local saved = case.build()
      case.before(saved)
      local here = saving.all(saved) -- reading builds a scene that was edited; so does the next
      saved = case.build()
      case.before(saved)
      saved:save(path)
      local loaded = sw.load(path)
      same(here, saving.all(loaded))
      case.after(saved) -- saving disturbs nothing
      same(wanted, saving.all(saved))
      loaded = sw.load(path)
      case.after(loaded)
      same(wanted, saving.all(loaded))

      local resumed = case.build()
      assert.is_true(resumed:resume(path))
      case.after(resumed)
      same(wanted, saving.all(resumed))
      assert.are.equal(table.concat(plain:names(), " "), table.concat(resumed:names(), " "))
    end)

    it(case.name .. ", edited just before", function()
      -- what a scene remembers of its last system goes into the file; building it would not do
      local function edited()
        local scene = case.build()
        case.before(scene)
        scene:obstacle{ name = "distant", shape = "sphere", radius = 0.1, at = { 0, 0, -50 } }
        return scene
      end
      local path, plain, saved = file(), edited(), edited()
      saved:save(path)
      local ran = saved.time > 0 -- what was made before the first run is the script's to make
      case.after(plain)
      case.after(saved)
      local wanted = saving.all(plain)
      same(wanted, saving.all(saved))
      local loaded, resumed = sw.load(path), (ran and case.build or edited)()
      case.after(loaded)
      same(wanted, saving.all(loaded))
      resumed:resume(path)
      case.after(resumed)
      same(wanted, saving.all(resumed))
    end)
  end
end)

-- --- processes ----------------------------------------------------------------------------

-- A script: its scene and processes; more(p, c) comes at the end of the first process.
local function script(more)
  local c = { log = {}, scene = sw.scene{ name = "laying" } }
  c.scene:obstacle{ shape = "plane", friction = 0.3 }
  c.wire = c.scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.0021 }, to = { 0.6, 0, 0.0021 },
    segments = 30 }
  c.left = c.scene:gripper{ name = "left" }
  local function step(p, name, work)
    return p:step(name, function()
      c.log[#c.log + 1] = name
      return work()
    end)
  end
  c.scene:process(function(p)
    step(p, "grasp", function() c.left:grasp(c.wire, { s = 0.02 }) end)
    c.end_of_lift = step(p, "lift", function()
      c.left:move{ by = { 0.05, 0, 0.1 }, duration = 0.3 }
      return c.wire:position(0.6), c.left
    end)
    step(p, "back", function()
      c.left:move{ by = { 0, 0.05, -0.05 }, duration = 0.15 }
      p:wait(0.05)
    end)
    step(p, "release", function() c.left:release() end)
    step(p, "again", function()
      c.left:grasp(c.wire, { s = 0.3 })
      c.left:move{ by = { 0, 0, 0.05 }, duration = 0.1 }
    end)
    if more then more(p, c, step) end
  end)
  return c
end

local function results(c, run)
  local all = saving.all(c.scene)
  local series = run:series()
  table.move(series.time, 1, #series.time, #all + 1, all)
  for _, column in ipairs(series.columns) do
    all[#all + 1] = column.name
    for _, value in ipairs(column.values) do all[#all + 1] = value == value and value or "nan" end
  end
  for _, key in ipairs{ "peak_force", "mean_force", "peak_moment", "mean_moment" } do
    all[#all + 1] = c.left[key]
  end
  for k = 1, 3 do all[#all + 1] = c.end_of_lift[k] end
  for _, key in ipairs{ "steps", "iterations", "time", "start", "smallest_dt", "reason" } do
    all[#all + 1] = run[key]
  end
  return all
end

-- The files that a run wrote, one after each step.
local function files_of(c, args)
  local written, write = {}, sink.write_file
  sink.write_file = function(path, bytes)
    written[#written + 1] = bytes
    return write(path, bytes)
  end
  local fine, run = pcall(c.scene.run, c.scene, args)
  sink.write_file = write
  assert(fine, run)
  return written, run
end

describe("a run that is saved after every step", function()
  for _, args in ipairs{ { dt = 0.005 }, { tolerance = 1e-5 } } do
    it("goes on from each of them with the same bits, " .. (args.dt and "fixed" or "adaptive")
      .. " steps", function()
      local function with(more)
        for k, v in pairs(args) do more[k] = v end
        return more
      end
      local plain, path = script(), file()
      local wanted = results(plain, plain.scene:run(with{}))
      local saved = script()
      local written, run = files_of(saved, with{ save = path })
      same(wanted, results(saved, run))
      assert.are.equal(5, #written)
      for k, bytes in ipairs(written) do
        saving.write(path, bytes)
        local c = script()
        local later, rest = files_of(c, with{ save = path, resume = path })
        same(wanted, results(c, rest))
        assert.are.equal(5 - k, #c.log) -- steps that are done are left out
        assert.are.equal(5 - k, #later)
        assert.are.equal(k < 5, c.log[1] == plain.log[k + 1] and k < 5)
      end
    end)
  end

  for _, way in ipairs{ "plates", "mixed" } do
    it("goes on with grippers that have pads, " .. way, function()
      local function make()
        local c = { scene = sw.scene{ name = "pads", gravity = { 0, 0, -0.3 } } }
        local wire = c.scene:wire{ name = "a", model = "tube", E = 2e6, density = 1200, radius = 0.005,
          from = { 0, 0, 0 }, to = { 0.15, 0, 0 } }
        c.scene:clamp(wire, { s = 0, name = "root" })
        c.left = c.scene:gripper{ name = "left", at = { 0.12, 0, 0 },
          pads = { friction = 0.6, width = 0.02 } }
        c.scene:process(function(p)
          p:step("grasp", function() c.left:grasp(wire, { s = 0.12, approach = way, force = 0.4 }) end)
          p:step("move", function() c.left:move{ by = { 0, 0, 0.01 }, duration = 0.1 } end)
          p:step("release", function() c.left:release() end)
          p:step("wait", function() p:wait(0.02) end)
        end)
        return c
      end
      local path, plain = file(), make()
      plain.scene:run{ dt = 0.005 }
      local written = files_of(make(), { dt = 0.005, save = path })
      assert.are.equal(4, #written)
      for _, bytes in ipairs(written) do
        saving.write(path, bytes)
        local c = make()
        c.scene:run{ dt = 0.005, resume = path }
        same(saving.all(plain.scene), saving.all(c.scene))
        assert.are.equal(plain.left.peak_force, c.left.peak_force)
      end
    end)
  end

  it("survives its process being killed", function()
    local path, body, out = file(), file(), file()
    saving.write(body, ([[
local sw = require "softworld"
local scene = sw.scene{ name = "killed" }
scene:obstacle{ shape = "plane", friction = 0.3 }
local wire = scene:wire{ E = 1e8, density = 1200, radius = 0.002, from = {0, 0, 0.002},
  to = {0.5, 0, 0.002}, segments = 20 }
local left = scene:gripper{ name = "left" }
scene:process(function(p)
  p:step("grasp", function() left:grasp(wire, { s = 0 }) end)
  p:step("lift", function() left:move{ by = {0, 0, 0.1}, duration = 0.2 } end)
  p:step("wait", function()
    p:wait(0.05)
    if arg[1] == "die" then os.execute("kill -9 $PPID") end
    p:wait(0.05)
  end)
end)
scene:run{ dt = 0.005, save = arg[2], resume = arg[2] }
print(("%%a %%a %%a"):format(wire:max_tension(), left.peak_force, wire:position(0.5)[1]))
]]):gsub("%%%%", "%%"))
    os.remove(path)
    local binary = os.getenv "SOFTWORLD_BIN" or "build/softworld"
    local function go(word, target)
      os.execute(("%s %s %s %s >%s 2>&1"):format(binary, body, word, target, out))
      return saving.read(out)
    end
    local plain = go("live", file() .. ".new")
    os.remove(files[#files] .. ".new")
    assert.is_truthy(plain:find "^0x")
    assert.is_nil(go("die", path):find "0x") -- it did not come to its end
    assert.are.equal(plain, go("live", path))
  end)

  it("keeps what steps return, and gives scripts their own objects", function()
    local path, c = file(), script()
    c.scene:run{ dt = 0.005, save = path }
    local again = script(function(p, made)
      made.last = { p:step("values", function()
        return nil, 1, 2.5, "x", { true, { 7 } }, made.wire, nil
      end) }
      made.count = select("#", p:step("none", function() end))
    end)
    again.scene:run{ dt = 0.005, resume = path, save = path }
    local third = script(function(p, made)
      made.last = table.pack(p:step("values", error))
      made.count = select("#", p:step("none", error))
    end)
    third.scene:run{ dt = 0.005, resume = path }
    assert.are.same({}, third.log)
    assert.are.equal(7, third.last.n)
    assert.are.same({ true, { 7 } }, third.last[5])
    assert.are.equal("integer float", math.type(third.last[2]) .. " " .. math.type(third.last[3]))
    assert.is_true(rawequal(third.wire, third.last[6]))
    assert.are.equal(0, third.count)
    assert.are.equal(again.end_of_lift[1], third.end_of_lift[1])
  end)

  it("waits with the file until no process is inside of a step", function()
    local function two()
      local c = { scene = sw.scene{} }
      c.wire = c.scene:wire{ E = 1e8, density = 1200, radius = 0.002, from = { 0, 0, 0 },
        to = { 0.5, 0, 0 }, segments = 12 }
      local grippers = { c.scene:gripper{ name = "one" }, c.scene:gripper{ name = "two" } }
      for k, gripper in ipairs(grippers) do
        c.scene:process(function(p)
          p:step("grasp", function() gripper:grasp(c.wire, { s = 0.5 * (k - 1) }) end)
          p:step("move", function() gripper:move{ by = { 0, 0, 0.05 * k }, duration = 0.1 } end)
          p:step("apart", function() p:wait(0.03 * k) end)
          p:step("alone", function() p:wait(0.05) end)
        end)
      end
      return c
    end
    local path, plain = file(), two()
    plain.scene:run{ dt = 0.005 }
    local written = files_of(two(), { dt = 0.005, save = path })
    assert.are.equal(3, #written) -- after grasp and move, and when the last one is done
    for _, bytes in ipairs(written) do
      saving.write(path, bytes)
      local c = two()
      c.scene:run{ dt = 0.005, resume = path }
      same(saving.all(plain.scene), saving.all(c.scene))
    end
  end)

  it("is refused what would happen twice", function()
    local path = file()
    local function with(work)
      local c = script(function(p, made) work(p, made) end)
      return function() c.scene:run{ dt = 0.005, save = path } end
    end
    fails({ "p:wait", "between two steps" }, with(function(p) p:wait_until(function() return false end) end))
    fails({ "let time pass", "p:step" }, with(function(p) p:wait(0.1) end))
    fails({ "left", "between two steps" }, with(function(_, c) c.left:release() end))
    fails({ "scene:clamp" }, with(function(_, c) c.scene:clamp(c.wire, { s = 0.5 }) end))
    fails({ "scene:settle" }, with(function(_, c) c.scene:settle() end))
    fails({ "step 'b' begins inside of step 'a'" },
      with(function(p) p:step("a", function() p:step("b", print) end) end))
    fails({ "p:step 'c' expects a function" }, with(function(p) p:step("c") end))
    fails({ "results", "a function, which cannot be saved" },
      with(function(p) p:step("d", function() return print end) end))
    -- without a file all this is allowed
    local c = script(function(p, c) p:wait(0.01) c.left:release() end)
    assert.is_true(c.scene:run{ dt = 0.005 }.ok)
  end)

  it("does not go on in another script", function()
    local path, c = file(), script()
    local written = files_of(c, { dt = 0.005, save = path })
    saving.write(path, written[3])
    local function other(change)
      local scene = sw.scene{ name = "laying" }
      scene:obstacle{ shape = "plane", friction = change == "friction" and 0.2 or 0.3 }
      scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.0021 }, segments = 30,
        to = { change == "wire" and 0.61 or 0.6, 0, 0.0021 } }
      scene:gripper{ name = change == "gripper" and "right" or "left" }
      if change == "more" then scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0, 9, 0 } } end
      if change == "gravity" then scene:gravity{ 0, 0, -1 } end
      local before = saving.all(scene)
      local message = fails("of another scene", scene.resume, scene, path)
      same(before, saving.all(scene))
      return message
    end
    assert.is_truthy(other("friction"):find("obstacle 'plane1' is not as it was", 1, true))
    assert.is_truthy(other("wire"):find("wire 'wire1' is not as it was", 1, true))
    assert.is_truthy(other("gripper"):find("gripper 'right' is there instead of gripper 'left'", 1, true))
    assert.is_truthy(other("more"):find("obstacle 'sphere2' is there instead of", 1, true))
    assert.is_truthy(other("gravity"):find("gravity is not as it was", 1, true))

    local e = sw.scene{ name = "laying" }
    e:obstacle{ shape = "plane", friction = 0.3 }
    local wire = e:wire{ cable = "GXL 1.5", from = { 0, 0, 0.0021 }, to = { 0.6, 0, 0.0021 }, segments = 30 }
    local left = e:gripper{ name = "left" }
    e:resume(path)
    fails({ "has process 1", "'grasp'" }, e.run, e, { duration = 0.1 })
    e:process(function(p)
      p:step("grasp", function() left:grasp(wire, { s = 0.02 }) end)
      p:step("something else", print)
    end)
    fails({ "p:step 'something else'", "has 'lift' as step 2" }, e.run, e)
  end)

  it("may have steps with error bars, which begin anew on every level", function()
    local function make()
      local scene, count = sw.scene{}, 0
      local wire = scene:wire{ E = 1e8, density = 1200, radius = 0.002, from = { 0, 0, 0 },
        to = { 0.3, 0, 0 } }
      local tool = scene:clamp(wire, { s = 0 })
      scene:process(function(p)
        p:step("move", function()
          count = count + 1
          tool:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.05 } }, duration = 0.1 }
          p:wait(0.1)
        end)
      end)
      return scene, function() return count end
    end
    local scene, count = make()
    local r = scene:run{ tolerance = { tip = 1e-3 } }
    assert.is_true(r.ok)
    assert.are.equal(#r.levels, count())
    assert.is_true(count() >= 2)
  end)

  it("is refused with error bars, without processes and with other things than files", function()
    local c = script()
    fails("tolerance", c.scene.run, c.scene, { save = "x", tolerance = { ["wire1.tension"] = 1 } })
    fails("save: the name of a file", c.scene.run, c.scene, { save = 3 })
    fails("resume: the name of a file", c.scene.run, c.scene, { resume = true })
    local path = file()
    files_of(c, { dt = 0.005, save = path })
    local d = script()
    d.scene:resume(path)
    fails({ "error bars need the whole computation", path }, d.scene.run, d.scene,
      { tolerance = { ["wire1.tension"] = 1 } })
    local scene = sw.scene{}
    fails("there is none", scene.run, scene, { duration = 1, save = "x" })
    c = script()
    fails("cannot write", c.scene.run, c.scene, { dt = 0.005, save = "/no/such/folder/x.sws" })
  end)
end)

-- --- files ----------------------------------------------------------------------------------

describe("sw.load", function()
  it("gives a scene that is read, settled and run on by its names", function()
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
  it("is written whole or not at all, and twice the same", function()
    local one, two = file(), file()
    local bytes, scene = small_file(one)
    scene:save(two)
    assert.are.equal(bytes, saving.read(two))
    fails("cannot write", scene.save, scene, "/no/such/folder/x.sws")
    fails({ "scene:save", "name of a file" }, scene.save, scene)
    fails("scene:save is a method", scene.save, 3)
  end)

  it("says what is wrong with it", function()
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
    wrong("no scene that SoftWorld saved", "")
    wrong("no scene that SoftWorld saved", "hello, world, this is no scene")
    wrong("cut off", bytes:sub(1, 20))
    wrong("cut off", bytes:sub(1, -2))
    wrong("version 99", bytes:sub(1, 16) .. string.pack("<I4", 99) .. bytes:sub(21))
    wrong("order of bytes", bytes:sub(1, 20) .. bytes:sub(21, 24):reverse() .. bytes:sub(25))
    wrong("damaged", bytes .. "x")
    wrong("damaged", bytes:sub(1, 500) .. "\1" .. bytes:sub(502))
    same(before, saving.all(scene))
    os.remove(path)
    fails({ path, "cannot read" }, sw.load, path)
    assert.is_false(small():resume(path))
  end)

  it("refuses what cannot leave the process, and says what to do", function()
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

  it("takes the place of a scene: its snapshots are none of its own any more", function()
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

local HEAD = 40 -- bytes before what the checksum is of
local function sealed(bytes)
  local sum = -3750763034362895579 -- FNV-1a, as the core has it
  for i = HEAD + 1, #bytes do sum = (sum ~ bytes:byte(i)) * 1099511628211 end
  return bytes:sub(1, 24) .. string.pack("<I8i8", #bytes, sum) .. bytes:sub(HEAD + 1)
end

-- Either an error, or a scene that can be used.
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

-- The same numbers in every run.
local function numbers(seed)
  return function(n)
    seed = (seed * 1103515245 + 12345) % 2147483648
    return seed // 8 % n + 1
  end
end

describe("a file that lies", function()
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

  it("is found out wherever it is cut off, sealed anew or not", function()
    local path, random = file(), numbers(1)
    for _, bytes in ipairs(all_files()) do
      for k = 1, 40 do
        local cut = bytes:sub(1, k <= 10 and #bytes - k or HEAD + random(#bytes - HEAD - 1))
        assert.is_false(digest(path, cut))
        assert.is_false(digest(path, sealed(cut)))
      end
    end
  end)

  it("does no harm whatever its bytes are", function()
    local path, random, taken, refused = file(), numbers(2), 0, 0
    for _, bytes in ipairs(all_files()) do
      assert.are.equal(bytes, sealed(bytes))
      for k = 1, 120 do
        local at = HEAD + random(#bytes - HEAD)
        local byte = ({ 0, 255, 127, 128, 1 })[random(5)]
        if k % 2 == 0 then byte = bytes:byte(at) ~ (1 << (random(8) - 1)) end
        local changed = bytes:sub(1, at - 1) .. string.char(byte) .. bytes:sub(at + 1)
        if changed ~= bytes then
          assert.is_false(digest(path, changed)) -- the checksum
          if digest(path, sealed(changed)) then taken = taken + 1 else refused = refused + 1 end
        end
      end
    end
    assert.is_true(taken > 50 and refused > 50, ("%d taken, %d refused"):format(taken, refused))
  end)

  it("leaves a scene that was to be resumed as it is", function()
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

  it("may run out at any request, and nothing is lost or changed", function()
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
