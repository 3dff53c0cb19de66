-- SPDX-License-Identifier: GPL-3.0-or-later
-- An open mesh is a sheet that is solid on one side only. A wire that comes to its back passes through, and
-- the run says so. Regression: no event.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local SIZE = 0.4 -- [m]

-- Content of an OBJ file: a sheet of n x n squares with the height z(x, y), facing up; down: facing down.
local function sheet(n, down, z)
  local text = {}
  local function at(i) return SIZE * (i / n - 0.5) end
  for i = 0, n do
    for j = 0, n do
      text[#text + 1] = ("v %.9g %.9g %.9g"):format(at(i), at(j), z and z(at(i), at(j)) or 0)
    end
  end
  local function id(i, j) return i * (n + 1) + j + 1 end
  for i = 0, n - 1 do
    for j = 0, n - 1 do
      local a, b, c, d = id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)
      if down then a, c = c, a end
      text[#text + 1] = ("f %d %d %d\nf %d %d %d"):format(a, b, c, a, c, d)
    end
  end
  return table.concat(text, "\n") .. "\n"
end

local function scene_with(o)
  local scene = sw.scene{}
  local obstacle = scene:obstacle{ name = "sheet", shape = "mesh", format = "obj", friction = 0.3,
    data = sheet(o.n or 4, o.down, o.z), rotation = { axis = { 0, 0, 1 }, angle = o.turn or 0 } }
  local from, to = o.from or { -0.1, 0.013, o.height }, o.to or { 0.1, 0.013, o.height }
  if o.swapped then from, to = to, from end
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", segments = o.segments or 20,
    from = from, to = to }
  scene:force{ kind = "damping", on = wire, mass = 2, stiffness = 0.001 }
  return scene, wire, obstacle
end

local function told(run)
  for _, e in ipairs(run.events) do
    if e.kind == "sheet" then return e end
  end
end

describe("a wire at the back of an open mesh", function()
  for _, o in ipairs{ { height = 0.0013 }, { height = 0.002, n = 1 }, { height = 0.01, swapped = true },
    { height = 0.1, turn = 0.7 }, { height = 0.1, dt = 0.02 }, { height = 0.1, dt = 0.001, n = 1 },
    { height = 0.05, n = 20, z = function(x, y) return x * x + y * y end },
    { height = 0.05, n = 20, z = function(x, y) return -x * x - y * y end } } do
    it(("falls through, and is told: from %g m, steps of %g s, %d x %d squares%s%s%s"):format(o.height,
      o.dt or 0.005, o.n or 4, o.n or 4, o.z and ", curved" or "", o.turn and ", turned" or "",
      o.swapped and ", ends swapped" or ""), function()
      o.down = true
      local scene, wire = scene_with(o)
      local run = scene:run{ duration = 0.3, dt = o.dt or 0.005 }
      t.below(-0.05, wire:position(0.1)[3], "height")
      local event = assert(told(run), "no event")
      assert.are.equal("wire", event.object)
      assert.is_truthy(event.text:find("'sheet'", 1, true))
    end)
  end

  -- The search for the first pose takes it through the sheet, at once or in part.
  it("is told in poses, too", function()
    for _, o in ipairs { { height = 0.0013 }, { height = 0.01, turn = 0.7, swapped = true },
      { height = 0.03, n = 20 } } do
      for _, dt in ipairs { 0.04, 0.005 } do
        o.down = true
        local scene, wire = scene_with(o)
        scene:pin(wire, { s = 0 })
        local run = scene:run { duration = 0.2, dt = dt, quasistatic = true }
        assert.is_truthy(told(run), ("from %g m, poses of %g s"):format(o.height, dt))
      end
    end
  end)

  it("is told if a clamp takes it there slowly, in motion and in poses", function()
    for _, quasistatic in ipairs{ false, true } do
      local scene, wire = scene_with{ down = true, height = 0.01 }
      scene:clamp(wire, { s = 0 }):follow{ points = { { -0.1, 0.013, 0.01 }, { -0.1, 0.013, -0.01 } },
        duration = 2 }
      local run = scene:run{ duration = 2, dt = 0.02, quasistatic = quasistatic }
      assert.is_truthy(told(run), quasistatic and "poses" or "motion")
    end
  end)

  it("is told if the sheet comes to the wire", function()
    local scene, wire, obstacle = scene_with{ down = true, height = 0.01 }
    scene:clamp(wire, { s = 0 })
    obstacle:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.03 } }, duration = 0.5 }
    assert.is_truthy(told(scene:run{ duration = 0.5, dt = 0.005 }))
  end)

  it("is not told of wires in front of it, over its border or far behind it", function()
    local function none(what, o, act)
      for _, dt in ipairs{ 0.02, 0.002 } do
        local scene, wire = scene_with(o)
        if act then act(scene, wire) end
        local run = scene:run{ duration = 0.5, dt = dt }
        assert.is_nil(told(run), ("%s, steps of %g s"):format(what, dt))
        scene, wire = scene_with(o)
        if act then act(scene, wire) end
        run = scene:run{ duration = 0.5, dt = dt, quasistatic = true }
        assert.is_nil(told(run), ("%s, poses of %g s"):format(what, dt))
      end
    end
    local near, far = { 0.05, 0.013, 0.002 }, { -0.1, 0.013, 0.002 }
    none("falls on it", { height = 0.05 })
    none("lies on it", { height = 0.0013, swapped = true })
    none("in a hollow", { height = 0.03, n = 20, z = function(x, y) return 2 * (x * x + y * y) end })
    none("hangs over the border", { segments = 50, from = far, to = { 0.4, 0.013, 0.002 } },
      function(scene, wire) scene:clamp(wire, { s = 0 }) end)
    none("drawn over the border", { segments = 40, from = near, to = { 0.35, 0.013, 0.002 } },
      function(scene, wire)
        scene:clamp(wire, { s = 0 }):follow{ points = { near, far }, duration = 0.5 }
      end)
    none("hangs below", { height = -0.02 }, function(scene, wire) scene:clamp(wire, { s = 0 }) end)
  end)
end)
