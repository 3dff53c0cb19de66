-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:advise: rules of thumb with their numbers, without running anything.
local sw = require "softworld"

local function cantilever(more)
  local scene = sw.scene { name = "s" }
  local args = { name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.5, 0, 0 } }
  for key, value in pairs(more or {}) do args[key] = value end
  local w = scene:wire(args)
  scene:clamp(w, { s = 0 })
  return scene, w
end

describe("scene:advise", function()
  it("calls a motion slow from ten first periods of the scene at rest on", function()
    local scene, w = cantilever()
    local before = scene:advise { duration = 1000 }
    assert.equal("dynamic", before.motion)
    assert.truthy(before.motion_why:find("call scene:settle() before", 1, true))
    scene:settle()
    local period = 1 / w:frequencies { modes = 1 }[1]
    assert.equal("dynamic", scene:advise { duration = 9.9 * period }.motion)
    local slow = scene:advise { duration = 10.1 * period }
    assert.equal("poses", slow.motion)
    assert.is_near(period, slow.period, 1e-12)
  end)

  -- edges of a third of the axis's radius around the peg; for a bow, an error of 1.25 / n^2
  it("chooses edges by the sharpest round obstacle, or by the tolerance", function()
    local scene, w = cantilever()
    assert.equal(math.ceil((1.25 / 0.002) ^ 0.5), scene:advise { tolerance = 0.002 }.segments.w)
    scene:obstacle { name = "peg", shape = "cylinder", radius = 0.01, length = 0.1, at = { 0, 0, 1 } }
    local a = scene:advise { tolerance = 0.02 }
    assert.equal(math.ceil(3 * 0.5 / (0.01 + w.radius)), a.segments.w)
    assert.truthy(tostring(a):find("edges of a third of the radius of 'peg'", 1, true))
  end)

  it("runs nothing and changes nothing", function()
    local scene, w = cantilever()
    local x = w:positions()
    scene:advise { tolerance = 0.01, duration = 3 }
    assert.same(x, w:positions())
    assert.equal(0, scene.time)
    assert.equal(0, scene:frame_count())
  end)

  it("names settings that have no effect", function()
    local scene = cantilever { rolls = true }
    assert.equal(1, #scene:advise {}.spare)
    assert.truthy(scene:advise {}.spare[1]:find("nothing here has friction", 1, true))
    scene:obstacle { shape = "plane", friction = 0.3, at = { 0, 0, -1 } }
    local a = scene:advise {}
    assert.same({ 0, "rolling" }, { #a.spare, a.twist })
  end)

  -- 1.25 / n^2 = 1e-300 asks for n = 1e150 edges; a wire takes 1e7 at most.
  it("never advises more edges or longer steps than there can be, and says so", function()
    local scene = cantilever()
    local a = scene:advise { tolerance = 1e-300, duration = 1 }
    assert.equal(10000000, a.segments[next(a.segments)])
    assert.truthy(tostring(a):find("the most there can be; 1.12e+150 would be needed", 1, true))
    assert.is_true(scene:settle().ok)
    a = scene:advise { duration = 1e9 }
    assert.same({ "poses", 1000 }, { a.motion, a.dt })
    assert.truthy(tostring(a))
  end)

  it("refuses arguments that make no sense", function()
    local scene = cantilever()
    for text, args in pairs { ["tolerance = 2 is not allowed"] = { tolerance = 2 },
      ["duration = 0 s is not allowed"] = { duration = 0 },
      ["duration = 1e+300 s is not allowed"] = { duration = 1e300 },
      ["did you mean 'tolerance'"] = { tolerence = 1 } } do
      local fine, why = pcall(scene.advise, scene, args)
      assert.is_false(fine)
      assert.truthy(why:find(text, 1, true), why)
    end
    local fine, why = pcall(sw.scene {}.advise, sw.scene {}, {})
    assert.is_false(fine)
    assert.truthy(why:find("has no wire", 1, true), why)
  end)
end)
