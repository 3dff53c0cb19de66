-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a run with error bars reads of a computation is read once, and the loads of an object once for all
-- quantities of it: long runs have long records. A scene cannot run while it is read.
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local refine = require "softworld.run.refine"
local sw = require "softworld"

-- A wire between two clamps; one moves. wall: an obstacle that it does not reach.
local function scene_of()
  local scene = sw.scene { name = "read" }
  scene:force { kind = "damping", mass = 5 }
  local w = scene:wire { name = "w", E = 5e6, density = 1500, radius = 0.0025, segments = 24,
    from = { 0, 0, 0 }, to = { 0.6, 0, 0 } }
  scene:clamp(w, { s = 0, name = "left" })
  scene:clamp(w, { s = 0.6, name = "right" }):follow { relative = true, duration = 0.5,
    points = { { 0, 0, 0 }, { -0.1, 0, 0 } } }
  scene:settle()
  return scene, w
end

describe("a computation with error bars", function()
  local over, computer = core.class.clamp.over, refine.computer
  after_each(function() core.class.clamp.over, refine.computer = over, computer end)

  -- Returns the run; numbers of computations, of calls of the function of a quantity, and of reads of loads.
  local function run_with(extra)
    local scene, calls, loads, computed = scene_of(), 0, 0, 0
    function refine.computer(...)
      local compute = computer(...)
      return function(...)
        computed = computed + 1
        return compute(...)
      end
    end
    function core.class.clamp.over(...)
      loads = loads + 1
      return over(...)
    end
    local args = { duration = 0.5, tolerance = { ["right.peak_force"] = { relative = 0.3 },
      ["right.mean_force"] = { relative = 0.3 }, ["right.mean_moment"] = { relative = 0.3 },
      { name = "odd", value = 1, unit = "-", of = function()
        calls = calls + 1
        return 1
      end } } }
    for key, value in pairs(extra) do args[key] = value end
    local run = scene:run(args)
    assert.is_true(run.met, tostring(run:error_bars()))
    return run, computed, calls, loads
  end

  it("is read once, and the loads of a hold once for all quantities", function()
    local run, computed, calls, loads = run_with {}
    assert.equal(#run.levels, computed)
    assert.equal(computed, calls)
    assert.equal(computed, loads)
  end)

  it("is not read again where levels serve the choice of a model", function()
    local run, computed, calls, loads = run_with { model = "auto" }
    assert.equal(computed, calls, tostring(run:why()))
    assert.equal(computed, loads)
  end)
end)

describe("obstacles that rub", function()
  it("are found by looks at a run that goes on as by one look at all of it", function()
    local scene, w = scene_of()
    local log, read = core.class.obstacle.log, {}
    scene:obstacle { name = "floor", shape = "plane", at = { 0, 0, -0.22 }, friction = 0.3 }
    scene:obstacle { name = "far", shape = "plane", at = { 0, 0, -1 }, friction = 0.3 }
    local seen, found = {}, {}
    function core.class.obstacle.log(o, from)
      read[#read + 1] = from
      return log(o, from)
    end
    for i = 1, 4 do
      if i == 2 then scene:find "right":follow { relative = true, duration = 0.5,
        points = { { 0, 0, 0 }, { -0.3, 0, 0 } } } end
      scene:run { duration = 0.5 }
      local names = facts.rubbing(scene, 0, seen)
      local all = facts.rubbing(scene, 0)
      assert.same(all, names)
      found[i] = #names
    end
    core.class.obstacle.log = log
    assert.same({ 0, 1, 1, 1 }, found)
    assert.is_true(core.exists(w))
    -- by looks: both; both, from 0.5 s on; then only the far one, from 1 and 1.5 s on
    local later = 0
    for _, from in ipairs(read) do later = later + (from > 0 and 1 or 0) end
    assert.equal(4, later)
  end)
end)

describe("a scene that runs inside the function of a quantity or a check", function()
  local function refused(words, f)
    local scene, w = scene_of()
    local function inside()
      scene:run { duration = 0.1 }
      return 1
    end
    local fine, message = pcall(f, scene, inside)
    assert.is_false(fine)
    for _, word in ipairs(words) do assert.truthy(message:find(word, 1, true), message) end
    assert.is_true(scene:run { duration = 0.1 }.ok) -- it can run afterwards
    assert.is_true(core.exists(w))
  end

  it("is told what to read instead", function()
    local asked = { "'read' cannot be run inside the function `of` of the quantity 'odd'", "wire:position" }
    for _, model in ipairs { false, "auto" } do
      refused(asked, function(scene, of)
        scene:run { duration = 0.2, model = model or nil,
          tolerance = { { name = "odd", value = 1, of = of } } }
      end)
    end
    refused(asked, function(scene, of)
      scene:settle { tolerance = { { name = "odd", value = 1, of = of } } }
    end)
    refused({ "inside the function `of` of the check 'odd'", "the run that is passed to it" },
      function(scene, of)
        local own = { name = "odd", unit = "-", of = of, max = 2 }
        return scene:run { duration = 0.2 }:check { checks = { own } }
      end)
  end)

  it("may not change it either", function()
    local calls = {
      ["scene:settle"] = function(scene) scene:settle() end,
      ["scene:set"] = function(scene) scene:set { gravity = { 0, 0, -1 } } end,
      ["scene:remove"] = function(scene, w) scene:remove(w) end,
      ["scene:restore"] = function(scene) scene:restore(scene:snapshot()) end,
      ["scene:obstacle"] = function(scene) scene:obstacle { shape = "plane", at = { 0, 0, -9 } } end,
      ["gripper 'hand'"] = function(_, w, hand) hand:grasp(w, { s = 0.2 }) end,
      ["wire:remodel"] = function(_, w) w:remodel { segments = 7 } end,
    }
    for name, call in pairs(calls) do
      local scene, w = scene_of()
      local hand = scene:gripper { name = "hand" }
      local function of() -- also if the script's own pcall takes the error
        pcall(call, scene, w, hand)
        return 1
      end
      local fine, message = pcall(scene.run, scene, { duration = 0.02,
        tolerance = { { name = "odd", value = 1, of = of } } })
      assert.is_false(fine, name)
      local asked = name .. ": scene 'read' cannot be changed inside the function `of` of the quantity 'odd'"
      assert.truthy(message:find(asked, 1, true), message)
      assert.truthy(message:find("read the scene as the run left it", 1, true), message)
      assert.is_true(scene:run { duration = 0.01 }.ok)
    end
  end)

  it("may not change its objects either", function()
    local calls = {
      ["obstacle:set"] = function(o) o.floor:set { friction = 0.9 } end,
      ["obstacle:remove"] = function(o) o.floor:remove() end,
      ["obstacle:follow"] = function(o) o.floor:follow { relative = true, duration = 1,
        points = { { 0, 0, 0 }, { 0, 0, 0.1 } } } end,
      ["obstacle:pose"] = function(o) o.floor:pose { 0, 0, -7 } end,
      ["force:set"] = function(o) o.damping:set { mass = 1 } end,
      ["force:release"] = function(o) o.damping:release() end,
      ["hold:release"] = function(o) o.left:release() end,
      ["hold:pose"] = function(o) o.left:pose { 0, 0, 0 } end,
      ["wire:set_velocity"] = function(o) o.wire:set_velocity { 0, 0, 1 } end,
      ["scene:gravity"] = function(o) o.scene:gravity { 0, 0, -1 } end,
      ["scene:clear_frames"] = function(o) o.scene:clear_frames() end,
    }
    for name, call in pairs(calls) do
      for _, own in ipairs { "quantity", "check" } do
        local scene, w = scene_of()
        local o = { scene = scene, wire = w, left = scene:find "left",
          floor = scene:obstacle { shape = "plane", at = { 0, 0, -9 } },
          damping = scene:force { kind = "damping", mass = 2 } }
        local function of() -- also if the script's own pcall takes the error
          pcall(call, o)
          return 1
        end
        local fine, message = pcall(function()
          if own == "quantity" then
            return scene:run { duration = 0.02, tolerance = { { name = "odd", value = 1, of = of } } }
          end
          local odd = { name = "odd", unit = "-", of = of, max = 2 }
          return scene:run { duration = 0.02 }:check { checks = { odd } }
        end)
        assert.is_false(fine, name)
        local asked = ("scene 'read' cannot be changed inside the function `of` of the %s 'odd'"):format(own)
        assert.truthy(message:find(asked, 1, true), name .. ": " .. message)
        assert.is_true(scene:run { duration = 0.01 }.ok)
        call(o) -- allowed outside
      end
    end
  end)

  it("may read what does not change it", function()
    local scene, w = scene_of()
    local read = {}
    local function of()
      read = { w:min_bend_radius(), scene:gravity()[3], scene:find("left"):force(), scene:energy(),
        scene:snapshot(), w:max_tension(), (scene:find("left"):pose()), tostring(scene) }
      return 1
    end
    local run = scene:run { duration = 0.02, tolerance = { { name = "odd", value = 1, of = of } } }
    local check = run:check { checks = { { name = "odd", unit = "-", of = of, max = 2 } } }
    for _, row in ipairs(check.rows) do
      if row.name == "odd" then assert.equal(1, row.value) end
    end
    assert.equal(8, #read)
  end)

  it("may read the frequencies of wires at rest", function()
    local scene, w = scene_of()
    local settled = scene:settle { tolerance = { { name = "pitch", value = 100, unit = "Hz", of = function()
      return w:frequencies { modes = 1 }[1]
    end } } }
    assert.is_true(settled.ok)
    assert.is_true(settled.quantities.pitch.value > 0)
  end)

  it("may save it", function()
    local scene = scene_of()
    local file = os.tmpname()
    assert.is_true(scene:run { duration = 0.02, tolerance = { { name = "odd", value = 1, of = function()
      scene:save(file)
      return 1
    end } } }.ok)
    os.remove(file)
  end)

  it("may be another scene", function()
    local scene, other = scene_of(), scene_of()
    local run = scene:run { duration = 0.2, tolerance = { { name = "odd", value = 1, of = function()
      return other:run { duration = 0.01 }.time
    end } } }
    assert.is_true(run.ok)
  end)
end)
