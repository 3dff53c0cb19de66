-- SPDX-License-Identifier: GPL-3.0-or-later
-- A quantity of the script that cannot be read is the script's fault, whichever computation reads it: the run
-- that is kept, or one that only chooses a model.
local sw = require "softworld"

-- Returns a scene in which 0.1 s take some comparisons, and its wire.
local function lying()
  local scene = sw.scene { name = "s" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local w = scene:wire { name = "w", E = 50e6, density = 1500, radius = 0.0025, segments = 20,
    from = { 0, 0, 0.0025 }, to = { -1, 0, 0.0025 } }
  return scene, w
end

-- Runs with a quantity whose function calls `odd` instead in its n-th call.
local function run_with(n, odd, at)
  local scene, w = lying()
  local calls = 0
  local function of()
    calls = calls + 1
    if calls == n then return odd(scene) end
    return w:position(1)[3]
  end
  local fine, why = pcall(scene.run, scene, { duration = 0.1, model = "auto",
    tolerance = { { name = "height", value = 1e-6, unit = "m", of = of, at = at } } })
  assert.is_false(fine, ("call %d: %s"):format(n, tostring(why)))
  return why, scene
end

describe("a quantity in a run that chooses its model", function()
  it("passes on its error from any computation", function()
    for n = 1, 5 do
      local mine = { "mine" }
      assert.equal(mine, run_with(n, function() error(mine) end))
      local why, scene = run_with(n, function() error "boom in my quantity" end, 0.05)
      assert.truthy(why:find("boom in my quantity", 1, true), why)
      assert.equal(0, scene.time)
      assert.is_true(scene:run { duration = 0.01 }.ok)
    end
  end)

  it("must return numbers, and lists of the same length, in any computation", function()
    for n = 1, 5 do
      local why = run_with(n, function() return 0 / 0 end)
      assert.truthy(why:find("quantity 'height': its function must return a number", 1, true), why)
      assert.truthy(why:find("got nan", 1, true), why)
    end
    local why = run_with(2, function() return { 1, 2 } end)
    assert.truthy(why:find("quantity 'height': its list must have the same length", 1, true), why)
  end)

  it("cannot change the scene in any computation", function()
    for n = 1, 5 do
      local why = run_with(n, function(scene)
        pcall(scene.obstacle, scene, { shape = "plane", at = { 0, 0, -9 } })
        return 0
      end)
      local asked = "cannot be changed inside the function `of` of the quantity 'height'"
      assert.truthy(why:find(asked, 1, true), why)
    end
  end)
end)
