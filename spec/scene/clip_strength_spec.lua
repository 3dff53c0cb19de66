-- SPDX-License-Identifier: GPL-3.0-or-later
-- Strength of a clip's floor and walls, and wires that meet the clip in ways that its law does not
-- describe: the clip never pushes with more than its strength, and reports every such case.
local sw = require "softworld"
local t = require "physics.tools"

local INTO, OUT = 10, 30
local STRENGTH = 20 * OUT -- as help says

-- A cable above a clip at the origin, held on both sides. from, to: the cable's ends.
local function scene_with(from, to, options)
  local o = options or {}
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ cable = "GXL 1.5", from = from, to = to, segments = 40 }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 1e-3 }
  local clip = scene:clip{ name = "c", at = { 0, 0, 0 }, width = 0.008, insertion = INTO, retention = OUT,
    friction = 0.3, strength = o.strength, stiffness = o.stiffness }
  local hands = o.wide and { scene:grip(wire, { s = wire.length / 2, width = o.wide }) }
    or { scene:grip(wire, { s = 0.02 }), scene:grip(wire, { s = wire.length - 0.02 }) }
  return scene, wire, clip, hands
end

-- Moves the hands; returns the run, the clip's largest force and its events.
local function move(scene, clip, hands, way, speed, run)
  local duration, most = t.norm(way) / speed, 0
  for _, hand in ipairs(hands) do
    hand:follow{ relative = true, points = { { 0, 0, 0 }, way }, duration = duration }
  end
  scene:process(function(p)
    local start = scene.time
    while scene.time < start + duration - 1e-9 do
      p:wait(run.dt)
      most = math.max(most, t.norm(clip:force()))
    end
  end)
  local result = t.fine(scene:run(run))
  local told = {}
  for _, e in ipairs(result.events) do if e.kind == "clip" then told[#told + 1] = e end end
  return result, most, told
end

local function line(y, z) return { -0.1, y, z }, { 0.1, y, z } end

describe("a clip's strength", function()
  for _, case in ipairs{ { "sideways", { 0, -0.03, -0.01 }, "a wall" },
    { "downwards", { 0, 0, -0.03 }, "its floor" } } do
    it("is the force that a seated wire swept " .. case[1] .. " has to break, at any step", function()
      for _, dt in ipairs{ 1e-3, 5e-3, 1e-2 } do
        local from, to = line(0, 0)
        local scene, wire, clip, hands = scene_with(from, to)
        local _, most, told = move(scene, clip, hands, case[2], 0.2, { dt = dt })
        t.below(1.1 * STRENGTH, most, "largest force")
        assert.equal(1, #told)
        assert.equal("c", told[1].object)
        assert.is_truthy(told[1].text:find("breaks through " .. case[3], 1, true), told[1].text)
        assert.equal("broken", clip:state())
        local o = clip.overloaded
        assert.same({ case[3], wire, STRENGTH }, { o.by, o.wire, math.floor(o.strength / 10 + 0.5) * 10 })
        t.below(1.1 * STRENGTH, o.force, "force told")
        t.below(1e-12, t.norm(clip:force()), "force of the broken clip")
        assert.is_nil(clip.pulled_out)
      end
    end)
  end

  -- A wide grip keeps the wire straight, so the force follows the law at every place.
  it("is reached and not exceeded where the wire is pressed slowly", function()
    for _, strength in ipairs{ 50, 200, false } do
      local from, to = line(0, 0)
      local scene, _, clip, hands = scene_with(from, to, { wide = 0.03, strength = strength or nil })
      local slowly = { dt = 1 / 200, quasistatic = true }
      local _, most, told = move(scene, clip, hands, { 0, -0.006, 0 }, 0.006, slowly)
      t.share(strength or STRENGTH, most, 0.01, "largest force")
      assert.is_truthy(told[1].text:find("a wall", 1, true), told[1].text)
      t.near(most, told[1].value, 0.1 * most, "force told")
    end
  end)

  it("can be given together with a stiffness", function()
    local from, to = line(0, 0)
    local scene, _, clip, hands = scene_with(from, to, { wide = 0.03, strength = 100, stiffness = 4e5 })
    local _, most = move(scene, clip, hands, { 0, -0.004, 0 }, 0.004, { dt = 1 / 400, quasistatic = true })
    t.share(100, most, 0.01, "largest force")
  end)

  it("must be above zero", function()
    local scene = sw.scene{}
    for value, text in pairs{ [0] = "strength = 0 N is not allowed", [-1] = "strength = -1 N is not allowed",
      weak = "strength = 'weak' is not allowed" } do
      local ok, message = pcall(scene.clip, scene, { at = { 0, 0, 0 }, width = 0.01, insertion = 1,
        retention = 2, strength = value })
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    assert.is_false((pcall(scene.clip, scene, { at = { 0, 0, 0 }, width = 0.01, insertion = 1, retention = 2,
      strenght = 3 })))
  end)

  it("is whole again after a restore; files keep the overload", function()
    local from, to = line(0, 0)
    local scene, _, clip, hands = scene_with(from, to)
    local before = scene:snapshot()
    move(scene, clip, hands, { 0, -0.03, 0 }, 0.2, { dt = 1e-2 })
    local force, path = clip.overloaded.force, os.tmpname()
    scene:save(path)
    local loaded = sw.load(path)
    os.remove(path)
    assert.equal(force, loaded:find "c".overloaded.force)
    scene:restore(before)
    assert.is_nil(clip.overloaded)
    assert.is_true(clip:seated())
  end)
end)

describe("a clip reports a wire that", function()
  for _, case in ipairs{ { 90, 1 }, { 60, 1 }, { 30, 0 } } do
    local angle = math.rad(case[1])
    local c, s = 0.1 * math.cos(angle), 0.1 * math.sin(angle)
    it(("crosses it at %d degrees: %d"):format(case[1], case[2]), function()
      local scene, _, clip, hands = scene_with({ -c, -s, 0.02 }, { c, s, 0.02 })
      local _, most, told = move(scene, clip, hands, { 0, 0, -0.02 }, 0.1, { dt = 5e-3 })
      t.below(2 * STRENGTH, most, "largest force")
      assert.equal(case[2], #told)
      if told[1] then
        assert.is_truthy(told[1].text:find("crosses the clip at", 1, true), told[1].text)
        t.near(case[1], told[1].value, 5, "angle")
      end
    end)
  end

  -- At any step, the wire does not pass without a report.
  for name, case in pairs{
    ["comes from behind"] = { { 0, -0.03 }, { 0, 0, 0.06 } },
    ["comes from the side"] = { { 0.03, 0 }, { 0, -0.06, 0 } },
    ["is driven down through mouth and floor"] = { { 0, 0.03 }, { 0, 0, -0.06 } },
  } do
    it(name, function()
      for _, speed in ipairs{ 0.2, 2 } do
        for _, dt in ipairs{ 1e-3, 1e-2 } do
          local scene, _, clip, hands = scene_with(line(case[1][1], case[1][2]))
          local _, most, told = move(scene, clip, hands, case[2], speed, { dt = dt })
          t.below(1.2 * STRENGTH, most, "largest force")
          assert.equal(1, #told, ("%s, %g m/s in steps of %g s"):format(name, speed, dt))
          assert.equal("broken", clip:state())
        end
      end
    end)
  end

  it("goes in and out, or lies beside, under or over it: no report", function()
    local from, to = line(0, 0.02)
    local scene, _, clip, hands = scene_with(from, to)
    local ways = { { 0, 0, -0.022 }, { 0, 0, 0.03 }, { 0, 0.02, 0 }, { 0, 0, -0.04 }, { 0, -0.02, 0 } }
    for _, way in ipairs(ways) do
      local result, most, told = move(scene, clip, hands, way, 0.05, { dt = 2e-3 })
      assert.equal(0, #told)
      if way[2] ~= 0 or way[3] < -0.03 then assert.equal(0, most) end -- aside, and down beside it
      t.below(0.01 * result:ledger().play, result:ledger().gained, "energy made")
    end
    assert.equal(1, clip.inserted.count)
    assert.equal(1, clip.pulled_out.count)
    assert.is_nil(clip.overloaded)
  end)
end)
