-- SPDX-License-Identifier: GPL-3.0-or-later
-- A joint of wires with material frames passes no twist: a branch that leaves a held trunk sideways swings
-- about it. An event says so. A joint of straight round wires passes it (joint_console_spec).
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "physics.tools"

local LONG, ASIDE = 0.1, 0.08

local function event(result)
  local found
  for _, e in ipairs(result.events) do
    if e.kind == "joint" then
      assert.is_nil(found)
      found = e
    end
  end
  return found
end

-- A clamped trunk along x with a branch at this angle to it, towards `aside`, at its end or in its middle.
local function harness(o)
  local scene = sw.scene{ gravity = o.weightless and { 0, 0, 0 } or nil }
  local trunk = scene:wire{ name = "trunk", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { LONG, 0, 0 },
    segments = 20, rolls = not o.round }
  local angle, at = o.angle or math.pi / 2, o.middle and LONG / 2 or LONG
  local function branch(name, way)
    local along, across = ASIDE * math.cos(angle), way * ASIDE * math.sin(angle)
    return scene:wire{ name = name, cable = "GXL 1.5", segments = 16, rolls = not o.round,
      from = { at, 0, 0 }, to = { at + along, o.plane and 0 or across, o.plane and across or 0 } }
  end
  local b = branch("branch", 1)
  local ends = { { trunk, s = at }, { b, s = 0 } }
  if o.second then ends[3] = { branch("second", -1), s = 0 } end
  if o.swap then ends[1], ends[2] = ends[2], ends[1] end
  if o.table then scene:obstacle{ shape = "plane", at = { 0, 0, -trunk.radius }, friction = 0.3 } end
  scene:join{ name = "j", ends = ends, rigid = o.rigid }
  local hold = not o.free and scene:clamp(trunk, { name = "clamp", s = 0 })
  return scene, b, hold, trunk
end

describe("a rigid joint", function()
  it("of straight round wires holds a branch like one wire", function()
    -- One wire of this cable with a corner of 5 mm as its rest shape has its end at -9.4 mm.
    local p = {}
    for i = 0, 20 do p[#p + 1] = { (LONG - 0.005) * i / 20, 0, 0 } end
    for i = 1, 20 do
      local u = i / 20 * math.pi / 2
      p[#p + 1] = { LONG - 0.005 + 0.005 * math.sin(u), 0.005 * (1 - math.cos(u)), 0 }
    end
    for i = 1, 20 do p[#p + 1] = { LONG, 0.005 + (ASIDE - 0.005) * i / 20, 0 } end
    local one = sw.scene{}
    local w = one:wire{ cable = "GXL 1.5", path = p, rest = "path", segments = 90 }
    one:clamp(w, { s = 0 })
    t.fine(one:settle())
    t.near(-9.4e-3, w:position(w.length)[3], 2e-4, "end of one wire [m]")
    for _, o in ipairs{ {}, { swap = true } } do
      o.round = true
      local scene, branch = harness(o)
      assert.is_nil(event(t.fine(scene:settle())))
      t.near(-9.53e-3, branch:position(branch.length)[3], 1e-5, "end of the branch [m]")
    end
  end)

  it("tells of a branch that swings down about its trunk", function()
    for _, o in ipairs{ {}, { middle = true }, { angle = 0.6 }, { swap = true },
      { round = true, angle = 0.12 } } do -- nearly in line: round wires pass twist only to one another
      local scene, branch = harness(o)
      local result = t.fine(scene:settle())
      local e = event(result)
      t.near(math.pi / 2, e.value, 0.02, "angle told [rad]")
      assert.equal("j", e.object)
      assert.truthy(e.text:find("'trunk'", 1, true) and e.text:find("'branch'", 1, true)
        and e.text:find("'clamp'", 1, true), e.text)
      if not (o.angle or o.middle) then
        t.near(-0.085, branch:position(branch.length)[3], 5e-4, "end of the branch [m]")
      end
    end
  end)

  it("tells of a hold at the joint itself, which keeps only the trunk from turning", function()
    for _, width in ipairs{ 0, 0.02 } do
      local scene, _, _, trunk = harness{ round = true, middle = true, free = true }
      if width > 0 then
        scene:grip(trunk, { s = LONG / 2, width = width })
      else
        scene:clamp(trunk, { s = LONG / 2 })
      end
      t.above(1.5, event(t.fine(scene:settle())).value, "angle told [rad]")
    end
  end)

  it("tells of it in motion and in poses, and its rows do not pass", function()
    for _, how in ipairs{ { dt = 0.01 }, { dt = 0.1, quasistatic = true } } do
      local scene = harness{}
      scene:force{ kind = "damping", mass = 5, stiffness = 2e-3 }
      how.duration = 1
      local run = t.fine(scene:run(how))
      t.above(1.5, event(run).value, "angle told [rad]")
      local check = run:check{ use = "movement" }
      for _, row in ipairs{ "trunk.min_bend_radius", "branch.min_bend_radius" } do
        assert.equal("OPEN", check:row(row).verdict)
        assert.truthy(check:row(row).note:find("(event 'joint')", 1, true), check:row(row).note)
      end
    end
  end)

  it("tells of a hand that turns the trunk, also after another hold and a settle", function()
    for _, settled in ipairs{ false, true } do
      local scene, _, _, trunk = harness{ free = true, weightless = true }
      if settled then
        local first = scene:clamp(trunk, { s = LONG / 2 })
        t.fine(scene:settle())
        first:release()
      end
      local hand = scene:clamp(trunk, { name = "hand", s = 0 })
      scene:force{ kind = "damping", mass = 5, stiffness = 2e-3 }
      hand:follow{ relative = true, duration = 0.5, points = { { 0, 0, 0 }, { 1e-5, 0, 0 } },
        turn = { axis = { 1, 0, 0 }, angle = 0.4 } }
      local run = t.fine(scene:run{ duration = 0.6, dt = 0.01 })
      t.near(0.4, event(run).value, 0.02, "angle told [rad]")
    end
  end)

  it("does not tell of an angle that hardly moves the branch", function()
    for angle, told in pairs{ [0.04] = false, [0.08] = true } do
      local scene, _, hand = harness{ weightless = true }
      scene:force{ kind = "damping", mass = 5, stiffness = 2e-3 }
      hand:follow{ relative = true, duration = 0.5, points = { { 0, 0, 0 }, { 1e-5, 0, 0 } },
        turn = { axis = { 1, 0, 0 }, angle = angle } }
      assert.equal(told, event(t.fine(scene:run{ duration = 0.6, dt = 0.01 })) ~= nil)
    end
  end)

  it("keeps the angle over a snapshot", function()
    local scene = harness{}
    local before = scene:snapshot()
    t.fine(scene:settle())
    local swung = scene:snapshot()
    scene:restore(before)
    scene:restore(swung)
    local run = t.fine(scene:run{ duration = 0.05, dt = 0.01 })
    t.above(1.5, event(run).value, "angle told [rad]")
  end)

  it("tells nothing where no twist is missing", function()
    for _, o in ipairs{ { angle = 0.02 }, { plane = true }, { second = true }, { weightless = true },
      { table = true }, { rigid = false }, { free = true, table = true } } do
      local scene = harness(o)
      scene:force{ kind = "damping", mass = 5, stiffness = 2e-3 }
      assert.is_nil(event(t.fine(scene:run{ duration = 0.5, dt = 0.01 })))
    end
  end)
end)
