-- SPDX-License-Identifier: GPL-3.0-or-later
-- Observers of a run that goes on from a file are called at the times of the run without a stop.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local unread = require "softworld.unread"
local file = saving.temporary

after_each(saving.clean)

-- Returns a script with observers made before the run, by its process between two steps, and inside a step;
-- and the times of their calls.
local function observed(every)
  local calls = { before = {}, first = {}, between = {}, inside = {} }
  local c
  local function observe(name)
    c.scene:observe { every = every, call = function(o)
      table.insert(calls[name], o.scene.time)
    end }
  end
  c = { scene = sw.scene { name = "observed" }, calls = calls }
  local wire = c.scene:wire { E = 1e8, density = 1200, radius = 0.002, from = { 0, 0, 0 }, to = { 0.3, 0, 0 },
    segments = 8 }
  local hand = c.scene:gripper { name = "hand" }
  observe "before"
  c.scene:process(function(p)
    observe "first"
    p:step("grasp", function() hand:grasp(wire, { s = 0 }) end)
    p:step("lift", function() hand:move { by = { 0, 0, 0.02 }, duration = 0.035 } end)
    observe "between"
    p:step("back", function() hand:move { by = { 0, 0, -0.02 }, duration = 0.11 } end)
    p:step("last", function()
      observe "inside"
      hand:move { by = { 0, 0.01, 0 }, duration = 0.1 }
    end)
  end)
  return c
end

local function later(times, start)
  local list = {}
  for _, time in ipairs(times) do
    if time > start then list[#list + 1] = time end
  end
  return list
end

describe("observers of a run that goes on from a file", function()
  for _, args in ipairs { { dt = 0.005 }, { dt = 0.007 }, { tolerance = 1e-5 } } do
    for _, every in ipairs { 0.02, 0.013, 0.03 } do
      it(("are called at the times of the run without a stop, every %g s, %s"):format(every,
        args.dt and "dt = " .. args.dt or "adaptive"), function()
        local function with(more)
          for k, v in pairs(args) do more[k] = v end
          return more
        end
        local path, plain = file(), observed(every)
        local written = saving.files_of(plain, with { save = path })
        assert.equal(4, #written)
        assert.is_true(#plain.calls.before > 5 and #plain.calls.between > 4 and #plain.calls.inside > 2)
        for _, bytes in ipairs(written) do
          saving.write(path, bytes)
          local c = observed(every)
          c.scene:resume(path)
          local start = c.scene.time
          c.scene:run(with {})
          for name, times in pairs(plain.calls) do
            if name ~= "inside" or #c.calls.inside > 0 then -- a step that is left out makes none
              assert.are.same(later(times, start), c.calls[name])
            end
          end
        end
      end)
    end
  end

  it("begin a new clock with a run that begins after the file was read", function()
    local path, scene = file(), sw.scene {}
    scene:wire { E = 1e8, density = 1200, radius = 0.002, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:run { duration = 0.015, dt = 0.005 }
    scene:save(path)
    local again, times = sw.load(path), {}
    again:observe { every = 0.01, call = function() times[#times + 1] = again.time end }
    again:run { duration = 0.02, dt = 0.005 }
    assert.equal(2, #times)
    assert.is_true(math.abs(times[1] - 0.025) < 1e-12 and math.abs(times[2] - 0.035) < 1e-12)
  end)

  it("have no note that they were never called, if they were called before the file was written", function()
    local path = file()
    local written = saving.files_of(observed(0.1), { dt = 0.005, save = path })
    saving.write(path, written[3]) -- at 0.145 s
    local c, notes, note = observed(0.1), {}, unread.note
    unread.note = function(text) notes[#notes + 1] = text return {} end
    local fine, why = pcall(c.scene.run, c.scene, { dt = 0.005, resume = path, duration = 0.16 })
    unread.note = note
    assert(fine, why)
    assert.equal(0, #c.calls.before)
    local never = 0
    for _, text in ipairs(notes) do never = never + (text:find("never called", 1, true) and 1 or 0) end
    assert.equal(1, never) -- that of the last step, 0.015 s before the run's end
  end)
end)
