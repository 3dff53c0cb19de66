-- SPDX-License-Identifier: GPL-3.0-or-later
-- The event `pierced`: something reaches into a solid element of an object of particles. Faces do not touch,
-- so a small thing passes through them.
local sw = require "softworld"

local SIZE = 0.04 -- of the block [m]

-- A cube of n x n x n elements whose lower corner is at height z [m].
local function block(scene, z, n)
  local positions, hexes, edge = {}, {}, SIZE / n
  local function number(i, j, k) return (k * (n + 1) + j) * (n + 1) + i + 1 end
  for k = 0, n do
    for j = 0, n do
      for i = 0, n do positions[#positions + 1] = { i * edge, j * edge, z + k * edge } end
    end
  end
  for e = 0, n ^ 3 - 1 do
    local i, j, k = e % n // 1, e // n % n, e // n ^ 2
    for level = k, k + 1 do
      for _, c in ipairs { { i, j }, { i + 1, j }, { i + 1, j + 1 }, { i, j + 1 } } do
        hexes[#hexes + 1] = math.tointeger(number(c[1], c[2], level))
      end
    end
  end
  return scene:particles { name = "block", positions = positions, masses = 0.02 / #positions, radius = 1e-3,
    elements = { { hexes = hexes, E = 5e5, nu = 0.2 } } }
end

local function pierced(run, what)
  local found
  for _, e in ipairs(run.events) do
    if e.kind == "pierced" and e.text:find(("'%s'"):format(what), 1, true) then found = e end
  end
  return found
end

-- The block falls on a post that is thinner than its faces. It fell past it without an event.
local function on_post(x, y, n)
  local scene = sw.scene {}
  scene:obstacle { name = "post", shape = "capsule", radius = 0.002, length = 0.04, at = { x, y, 0 } }
  block(scene, 0.025, n)
  local run = scene:run { duration = 0.3, dt = 0.005 }
  assert.is_true(run.ok, run.reason)
  return pierced(run, "post")
end

-- A ball or a short piece of wire falls on the block, which lies on a table. Returns the run, and where it
-- ends [m].
local function dropped(what, n)
  local scene = sw.scene {}
  scene:obstacle { name = "table", shape = "box", size = { 0.3, 0.3, 0.02 }, at = { 0, 0, -0.01 } }
  block(scene, 1e-3, n)
  local ball = what == "ball" and scene:particles { name = "ball", positions = { { 0.02, 0.02, 0.06 } },
    masses = 0.01, radius = 0.005 }
  local wire = what == "piece" and scene:wire { name = "piece", cable = "GXL 1.5",
    from = { 0.013, 0.012, 0.06 }, to = { 0.027, 0.012, 0.06 }, segments = 8 }
  scene:wire_contact { friction = 0.3 }
  scene:force { kind = "damping", mass = 5 }
  local run = scene:run { duration = 0.3, dt = 0.005 }
  assert.is_true(run.ok, run.reason)
  return run, (ball and ball:particle(1) or wire:position(0))[3]
end

describe("event pierced", function()
  it("tells of a post within an element", function()
    for _, at in ipairs { { 0.02, 0.02 }, { 0.013, 0.027 }, { 0.033, 0.031 } } do
      local e = on_post(at[1], at[2], 1)
      assert.truthy(e)
      assert.equal("block", e.object)
      assert.is_true(e.value > 0.001 and e.value < 0.0021, tostring(e.value))
    end
  end)

  it("tells of particles and wires within an element", function()
    for _, what in ipairs { "ball", "piece" } do
      local run, height = dropped(what, 1)
      assert.is_true(height < 0.01) -- on the table
      assert.truthy(pierced(run, what))
    end
  end)

  it("tells nothing where edges and particles bear the load", function()
    for _, what in ipairs { "ball", "piece" } do
      local run, height = dropped(what, 4)
      assert.is_true(height > 0.04)
      for _, e in ipairs(run.events) do assert.is_not.equal("pierced", e.kind, e.text) end
    end
  end)

  it("tells nothing where a ball presses on edges", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    scene:obstacle { shape = "plane" }
    block(scene, 1e-3, 4)
    scene:obstacle { name = "ball", shape = "sphere", radius = 0.03, at = { 0.021, 0.018, 0.073 } }
      :follow { points = { { 0, 0, 0 }, { 0, 0, -0.004 } }, relative = true, duration = 0.3 }
    scene:force { kind = "damping", mass = 20 }
    local run = scene:run { duration = 0.3, dt = 0.005 }
    assert.is_true(run.ok, run.reason)
    for _, e in ipairs(run.events) do assert.is_not.equal("pierced", e.kind, e.text) end
  end)
end)
