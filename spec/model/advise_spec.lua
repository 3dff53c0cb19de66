-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:advise: rules of thumb with their numbers, without running anything.
local sw = require "softworld"
local tools = require "spec.shape.tools"

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

  it("chooses edges by the radius of a mesh whose facets are round", function()
    local scene, w = cantilever()
    scene:obstacle { name = "cube", shape = "mesh", data = tools.obj(tools.box_triangles(0.1, 0.1, 0.1)),
      format = "obj", at = { 0, 0, 2 } }
    assert.falsy(scene:advise {}.segments_why.w:find("radius", 1, true))
    scene:obstacle { name = "peg", shape = "mesh", data = tools.obj(tools.ball(0.01, 40, 40)),
      format = "obj", at = { 0, 0, 1 } }
    local a = scene:advise { tolerance = 0.02 }
    assert.is_near(3 * 0.5 / (0.01 + w.radius), a.segments.w, 2)
    assert.equal("edges of a third of the radius of 'peg'", a.segments_why.w)
  end)

  it("runs nothing and changes nothing", function()
    local scene, w = cantilever()
    local x = w:positions()
    scene:advise { tolerance = 0.01, duration = 3 }
    assert.same(x, w:positions())
    assert.equal(0, scene.time)
    assert.equal(0, scene:frame_count())
  end)

  -- On a table a wire has a period of some ms, that of its contact; lifted, it swings like a hanging one. Its
  -- squared frequency is at least the sum of those of a beam and of a chain (Southwell), and at most 12 %
  -- more here. Without friction it may also swing to the side on the table, more slowly.
  it("takes steps for the swing of a lifted wire where wires lie on something", function()
    for _, E in ipairs { 5e6, 50e6, 5e9 } do
      local function wire_to(scene, to, z)
        return scene:wire { name = "w", E = E, density = 1500, radius = 0.0025, segments = 40,
          from = { 0, 0, z }, to = to }
      end
      local hung = sw.scene {}
      local w = wire_to(hung, { 0, 0, -0.6 }, 0)
      hung:clamp(w, { s = 0 })
      hung:settle()
      local period = 1 / w:frequencies { modes = 1 }[1]
      for _, friction in ipairs { 0, 0.3 } do
        local scene = sw.scene {}
        scene:obstacle { shape = "plane", friction = friction }
        w = wire_to(scene, { 0.6, 0, 0.0025 }, 0.0025)
        scene:clamp(w, { s = 0 })
        scene:settle()
        local a = scene:advise { tolerance = 0.02, duration = 0.002 }
        assert.is_true(a.swing >= period * (1 - 1e-3), ("%g beside %g s"):format(a.swing, period))
        assert.is_true(friction == 0 or a.swing < 1.06 * period, ("%g beside %g s"):format(a.swing, period))
        assert.equal("dynamic", a.motion)
        assert.is_near(math.min(0.01, a.swing / 40 * 2 ^ 0.5), a.dt, 1e-12)
        assert.is_true(a.auto_time.dynamic > a.auto_time.poses)
      end
    end
  end)

  it("says that a wire which snaps into a clip swings, and counts periods without exponents", function()
    local function along(clip)
      local scene = sw.scene {}
      if clip then
        scene:clip { name = "c", at = { 0.1, 0, -0.05 }, width = 0.01, insertion = 2, retention = 6 }
      end
      local w = scene:wire { name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
      for _, s in ipairs { 0, 0.2 } do scene:clamp(w, { s = s }) end
      scene:settle()
      return scene:advise { tolerance = 0.02, duration = 100 }
    end
    local plain, snapping = along(false), along(true)
    assert.same({ "poses", "poses" }, { plain.motion, snapping.motion })
    assert.is_nil(tostring(plain):find("if it finds that poses suffice", 1, true))
    assert.truthy(tostring(snapping):find("if it finds that poses suffice", 1, true), tostring(snapping))
    assert.truthy(snapping.motion_why:find("a wire that snaps into 'c'", 1, true))
    assert.is_nil(tostring(snapping):find("e+", 1, true), tostring(snapping))
  end)

  it("takes 10 s where no duration is given, and the steps of the automatic choice", function()
    local scene = cantilever()
    scene:settle()
    local a, b = scene:advise {}, scene:advise { duration = 10 }
    assert.same({ b.motion, b.dt, b.time, b.auto_time }, { a.motion, a.dt, a.time, a.auto_time })
    assert.truthy(a.motion_why:find("assumed", 1, true) and not b.motion_why:find("assumed", 1, true))
    local w = sw.core.data(scene).wires[1].object
    a = scene:advise { duration = 20 }
    assert.equal("poses", a.motion)
    local run = scene:run { duration = 20, model = "auto",
      tolerance = { ["w.min_bend_radius"] = { relative = 0.02 } } }
    assert.equal("poses", run.model.motion)
    local third = run.levels[3].segments[1] / sw.core.segments(w) -- edges of level 3 over those of the last
    assert.is_near(20 / a.dt, run.steps * third, 0.05 * run.steps)
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
