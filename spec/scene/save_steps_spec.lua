-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs that save a file after every step of a process, and go on from it.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local fails, script, files_of = saving.fails, saving.script, saving.files_of
local file, same = saving.temporary, saving.same

after_each(saving.clean)

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

describe("a run that is saved after every step", function()
  for _, args in ipairs{ { dt = 0.005 }, { tolerance = 1e-5 } } do
    it("goes on from each file with the same bits, " .. (args.dt and "fixed" or "adaptive")
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
        assert.are.equal(5 - k, #c.log) -- steps that are done are skipped
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

  it("goes on after its process was killed", function()
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
    local new = file() .. ".new"
    local plain = go("live", new)
    os.remove(new)
    assert.is_truthy(plain:find "^0x")
    assert.is_nil(go("die", path):find "0x") -- the killed run did not reach its end
    assert.are.equal(plain, go("live", path))
  end)

  it("keeps what steps return, with the script's own objects", function()
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

  it("writes the file only when no process is inside a step", function()
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
    assert.are.equal(3, #written) -- after grasp, after move, and when the last process is done
    for _, bytes in ipairs(written) do
      saving.write(path, bytes)
      local c = two()
      c.scene:run{ dt = 0.005, resume = path }
      same(saving.all(plain.scene), saving.all(c.scene))
    end
  end)

  it("refuses what would happen twice after a resume", function()
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
    -- without a file all of these are allowed
    local c = script(function(p, c) p:wait(0.01) c.left:release() end)
    assert.is_true(c.scene:run{ dt = 0.005 }.ok)
  end)

  it("is not resumed by another script; the difference is named", function()
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
    assert.is_truthy(other("friction"):find("obstacle 'plane1' differs from the file", 1, true))
    assert.is_truthy(other("wire"):find("wire 'wire1' differs from the file", 1, true))
    assert.is_truthy(other("gripper"):find("gripper 'left' of the file is missing in the script", 1, true))
    assert.is_truthy(other("more"):find("obstacle 'sphere2' of the script is not in the file", 1, true))
    assert.is_truthy(other("gravity"):find("gravity differs from the file", 1, true))
    local bare = sw.scene{ name = "laying" }
    -- gravity stands last in the list: in a scene without objects it meets the file's first object
    assert.is_truthy(fails("of another scene", bare.resume, bare, path)
      :find("of the file is missing in the script", 1, true))

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

  it("may have steps with error bars, which start again at every level", function()
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

  it("is refused with error bars, without processes and with an invalid file", function()
    local c = script()
    fails("tolerance", c.scene.run, c.scene, { save = "x", tolerance = { ["wire1.tension"] = 1 } })
    fails("save: the name of a file", c.scene.run, c.scene, { save = 3 })
    fails("resume: the name of a file", c.scene.run, c.scene, { resume = true })
    local path = file()
    files_of(c, { dt = 0.005, save = path })
    local d = script()
    d.scene:resume(path)
    fails({ "error bars need a computation from the start", path }, d.scene.run, d.scene,
      { tolerance = { ["wire1.tension"] = 1 } })
    local scene = sw.scene{}
    fails("there is no process", scene.run, scene, { duration = 1, save = "x" })
    c = script()
    fails("cannot write", c.scene.run, c.scene, { dt = 0.005, save = "/no/such/folder/x.sws" })
  end)
end)
