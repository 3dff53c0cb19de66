-- SPDX-License-Identifier: GPL-3.0-or-later
-- The `<close>` variables of a process that is ended where it waits: their errors are the script's.
local sw = require "softworld"

local function scene_of()
  local scene = sw.scene {}
  local w = scene:wire { E = 50e6, density = 1500, radius = 0.0025, segments = 8, from = { 0, 0, 0.1 },
    to = { 1, 0, 0.1 } }
  scene:clamp(w, { s = 0 })
  return scene, w
end

-- Adds a process that waits and raises this when it is ended; done: a list that gets its number.
local function waits(scene, raised, done)
  return scene:process(function(p)
    local _ <close> = setmetatable({}, { __close = function()
      if done then done[#done + 1] = p.number end
      if raised then error(raised) end
    end })
    p:wait(10)
  end)
end

describe("an error of a `<close>` variable of a process", function()
  it("comes out of process:finish", function()
    local scene, mine = scene_of(), { "mine" }
    local one = waits(scene, mine)
    scene:run { dt = 0.01, duration = 0.02 }
    local fine, why = pcall(one.finish, one)
    assert.is_false(fine)
    assert.equal(mine, why)
    one:finish() -- it has ended
    assert.is_true(scene:run { dt = 0.01, duration = 0.02 }.ok)
  end)

  it("comes out of scene:restore, which ends all processes and restores the scene", function()
    local scene, w = scene_of()
    local snapshot, before, done, mine = scene:snapshot(), w:positions(), {}, { "mine" }
    waits(scene, mine, done)
    waits(scene, "another", done)
    waits(scene, nil, done)
    scene:run { dt = 0.01, duration = 0.02 }
    local fine, why = pcall(scene.restore, scene, snapshot)
    assert.is_false(fine)
    assert.equal(mine, why)
    assert.same({ 1, 2, 3 }, done)
    assert.equal(0, scene.time)
    assert.same(before, w:positions())
    assert.is_true(scene:run { dt = 0.01, duration = 0.02 }.ok)
    assert.same({ 1, 2, 3 }, done)
  end)

  it("comes out of runs with several levels", function()
    for _, model in ipairs { false, "auto" } do
      local scene, w = scene_of()
      local before, mine = w:positions(), { "mine" }
      waits(scene, mine)
      local fine, why = pcall(scene.run, scene, { duration = 0.1, model = model or nil,
        tolerance = { tip = 1e-3 } })
      assert.is_false(fine)
      assert.equal(mine, why)
      assert.equal(0, scene.time)
      assert.same(before, w:positions())
    end
  end)
end)
