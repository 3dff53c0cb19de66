-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs that chose their model are watched. Where the condition of a free check breaks on the way, the run
-- goes on with the next rung from an earlier snapshot, or begins again.
local sw = require "softworld"
local core = sw.core

local grip = require "softworld.model.grip"
local rod = require "spec.model.rod"
local section = require "softworld.model.section"

local function event_of(run, words)
  for _, e in ipairs(run.events) do
    if e.kind == "model" and e.text:find(words, 1, true) then return e end
  end
end

local function choice(run, name)
  for _, c in ipairs(run.model.choices) do
    if c.name == name then return c end
  end
end

-- A wire hangs between two clamps at rest. In the second half of the time one clamp moves gently in the
-- first run, and starts abruptly in all runs from number `since` on (2): the coarse poses come first and
-- take the motion for slow.
local function sets_off(options, more, since)
  local scene, count = sw.scene { name = "off" }, 0
  scene:force { kind = "damping", mass = 5 }
  local w = rod.wire(scene, options)
  scene:clamp(w, { s = 0 })
  local right = scene:clamp(w, { s = 0.6, name = "right" })
  scene:settle()
  scene:process(function(p)
    count = count + 1
    p:wait(20)
    right:follow { points = { { 0.6, 0, 0 }, { 0.5, 0, 0 } }, duration = 20,
      law = count >= (since or 2) and "linear" or nil }
    p:wait(20)
  end)
  local all = { tolerance = { ["right.force"] = { relative = 0.1 } } }
  for key, value in pairs(more or {}) do all[key] = value end
  return scene:run(all), scene, w
end

describe("a run that chose its model", function()
  it("goes on with dynamics from a snapshot where poses speed up, and says so", function()
    local run = sets_off()
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
    assert.equal("switched", choice(run, "motion").by)
    local words = "motion dynamic: poses until 20.00 s, where the run went back to a snapshot, because by 2"
    assert.truthy(tostring(run:why()):find(words, 1, true), tostring(run:why()))
    local e = event_of(run, "motion: poses until")
    assert.is_near(20, e.time, 0.2)
    assert.is_true(run.met)
    local fine = sets_off({ model = "rod" }, { levels = 5, tolerance = {
      ["right.force"] = { relative = 0.005 } } }, 1)
    local q, t, off = run.quantities["right.force"], fine.quantities["right.force"], 0
    for k = 1, 3 do off = off + (q.value[k] - t.value[k]) ^ 2 end
    assert.is_true(off ^ 0.5 <= q.error + t.error, ("%g off, %g stated"):format(off ^ 0.5, q.error))
  end)

  -- 12 first periods long, so poses are slow enough on coarse edges, but not on fine ones.
  it("says that nothing is left of poses where it went back to the start", function()
    local scene = sw.scene { name = "twisted" }
    local w = scene:wire { name = "w", EA = 2e4, EI = 3e-3, GJ = 2.4e-3, mass_per_length = 0.04,
      radius = 0.002, from = { 0, 0, 0 }, to = { 0.3, 0, 0 }, segments = 32 }
    scene:clamp(w, { s = 0, name = "left" })
    scene:clamp(w, { s = 0.3, name = "right" }):follow { relative = true, duration = 3,
      points = { { 0, 0, 0 }, { -0.03, 0.02, 0 } }, turn = { axis = { 1, 0, 0 }, angle = 5 } }
    scene:force { kind = "damping", mass = 4 }
    scene:settle()
    local run = scene:run { duration = 3, model = "auto", tolerance = {
      ["right.moment"] = { relative = 0.03 }, ["left.force"] = { relative = 0.03 } } }
    local c, why = choice(run, "motion"), tostring(run:why())
    assert.equal("switched", c.by, why)
    assert.truthy(c.why:find("^poses given up: the run went back to its start, because by "), why)
    assert.truthy(c.why:find("; dynamics from there; on coarse edges: the run lasts", 1, true), why)
    assert.falsy(why:find("until", 1, true), why)
  end)

  it("gives the same bits in a second run", function()
    local one, two = sets_off(), sets_off()
    assert.equal(tostring(one:error_bars()), tostring(two:error_bars()))
    local _, scene, w = sets_off()
    assert.is_nil(w:get().spin_inertia)
    assert.is_true(math.abs(scene.time - 40) < 1e-9)
  end)

  -- A script that counts its runs: the later runs contain something that the coarse run does not.
  -- aside: the way of the table across the plane in which the wire hangs [m].
  local function lifted(turn, aside)
    local scene, count = sw.scene { name = "rub" }, 0
    scene:force { kind = "damping", mass = 5 }
    local w = rod.wire(scene)
    scene:clamp(w, { s = 0, name = "left" })
    scene:clamp(w, { s = 0.6 }):follow { points = { { 0.6, 0, 0 }, { 0.5, 0, 0 } }, duration = 4,
      turn = turn and { axis = { 1, 0, 0 }, angle = turn } or nil }
    local table_ = scene:obstacle { name = "table", shape = "plane", friction = 0.3, at = { 0, 0, -0.3 } }
    scene:process(function(p)
      count = count + 1
      p:wait(5)
      if count > 1 then
        table_:follow { relative = true, points = { { 0, 0, 0 }, { 0, aside or 0, 0.17 } },
          duration = 5 }
      end
      p:wait(15)
    end)
    return scene:run { quasistatic = true, tolerance = { ["left.force"] = { relative = 0.1 } } }, w
  end

  it("lets a wire roll from where something begins to rub it", function()
    local run, w = lifted(nil, 0.03)
    assert.equal("switched", choice(run, "twist").by, tostring(run:why()))
    assert.equal("rolling", run.model.twist)
    assert.truthy(event_of(run, "'table' rubs; rolling from there"))
    assert.is_true(event_of(run, "'table' rubs").time > 5)
    assert.is_not_nil(w:get().spin_inertia)
  end)

  it("does not let it roll where nothing rubs across the plane in which it hangs", function()
    local run, w = lifted()
    assert.equal("free", choice(run, "twist").by, tostring(run:why()))
    assert.is_nil(w:get().spin_inertia)
  end)

  it("begins again where a twisted wire cannot go on rolling, and says why", function()
    local run = lifted(1)
    assert.are_not.equal("switched", choice(run, "twist").by)
    assert.truthy(tostring(run:why()):find("and the run began again, because ", 1, true), tostring(run:why()))
    assert.truthy(tostring(run:why()):find("is twisted by", 1, true), tostring(run:why()))
  end)

  -- Two wires hang side by side, and a table begins to rub the lower one, which is twisted. The quantity
  -- depends on touches only if wires roll.
  it("decides the other choices again where one is given up", function()
    local scene, count = sw.scene { name = "both" }, 0
    local a = rod.beside(scene, { relative = true, points = { { 0, 0, 0 }, { -0.1, 0, 0 } }, duration = 4,
      turn = { axis = { 1, 0, 0 }, angle = 1 } })
    local table_ = scene:obstacle { name = "table", shape = "plane", friction = 0.3, at = { 0, 0, -0.3 } }
    scene:process(function(p)
      count = count + 1
      p:wait(5)
      if count > 2 then
        table_:follow { relative = true, points = { { 0, 0, 0 }, { 0, 0.03, 0.17 } }, duration = 5 }
      end
      p:wait(15)
    end)
    local function odd()
      local rolls = a:get().spin_inertia ~= nil
      return 1 + (rolls and 0.05 or 0) + (rolls and core.data(scene).touching and 0.05 or 0)
    end
    local run = scene:run { quasistatic = true, model = "auto",
      tolerance = { { name = "odd", value = 0.03, unit = "-", of = odd } } }
    assert.equal("rolling", run.model.twist, tostring(run:why()))
    assert.truthy(event_of(run, "twist: no rolling given up; \"no friction torque"))
    assert.equal("wires", run.model.contact, tostring(run:why()))
    assert.is_true(run.met)
  end)

  -- The same way in a fifth of the time loads the pads more: 29 % become more than 50 %.
  it("ends a run whose pads bear too much, compares the grip and begins again", function()
    local scene, count = sw.scene { name = "carry" }, 0
    scene:force { kind = "damping", mass = 8 }
    local w = rod.wire(scene, { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0.003 },
      to = { 0.24, 0, 0.003 } })
    local hand = scene:gripper { name = "hand", pads = { width = 0.012, friction = 0.6, opening = 0.009 } }
    scene:obstacle { name = "table", shape = "plane", friction = 0.2 }
    scene:process(function(p)
      count = count + 1
      local fast = count > 1
      hand:grasp(w, { s = 0.12, approach = "auto", force = 0.3 })
      hand:move { by = { 0, 0, 0.04 }, duration = fast and 0.1 or 0.5 }
      p:wait(1)
    end)
    local run = scene:run { quasistatic = false, tolerance = { tip = 0.003 } }
    local e = event_of(run, "the pads of 'hand' bore")
    assert.truthy(e, tostring(run:why()))
    assert.is_true(e.time < 1.1, ("%g s"):format(e.time))
    assert.truthy(tostring(run:why()):find("began again, because a run cannot change its grip on the way", 1,
      true))
    assert.are_not.equal("free", choice(run, "grip").by)
  end)

  -- The checks between two frames on the way, which are those made before the run.
  it("checks the pressure on wires and the load of pads, by rung", function()
    local f = { share = 0.03, q = 9.7, wire = "w", flat = 0.2, wall = 0.2 }
    assert.truthy(section.broken(f, 0.02, 1):find("'w' was pressed by 9.7", 1, true))
    assert.is_nil(section.broken(f, 0.04, 1))
    assert.truthy(section.broken(f, 0.02, 2):find("of which springs leave out 6.8 %", 1, true))
    assert.is_nil(section.broken(f, 0.1, 2))
    local g = { load = 0.6, gripper = "hand", flat = 0.01, wire = "w" }
    assert.truthy(grip.broken(g, 0.02, 1):find("the pads of 'hand' bore 60 %", 1, true))
    assert.is_nil(grip.broken(g, 0.02, 2))
    assert.truthy(grip.broken(g, 0.005, 2):find("pads flattened 'w' by 1 %", 1, true))
  end)

  it("lets wires touch from where they come near", function()
    local scene, count = sw.scene { name = "near", gravity = { 0, 0, 0 } }, 0
    scene:force { kind = "damping", mass = 5 }
    local a = rod.wire(scene, { name = "a", from = { -0.2, 0, 0 }, to = { 0.2, 0, 0 } })
    local b = rod.wire(scene, { name = "b", from = { 0, -0.2, 0.1 }, to = { 0, 0.2, 0.1 } })
    for i, s in ipairs { 0, 0.4 } do scene:clamp(a, { s = s, name = "a" .. i }) end
    local held = { scene:clamp(b, { s = 0 }), scene:clamp(b, { s = 0.4 }) }
    scene:process(function(p)
      count = count + 1
      p:wait(2)
      for _, clamp in ipairs(count > 1 and held or {}) do
        clamp:follow { relative = true, points = { { 0, 0, 0 }, { 0, 0, -0.11 } }, duration = 8 }
      end
      p:wait(8)
    end)
    local run = scene:run { quasistatic = true, tolerance = { ["a1.force"] = 0.1 } }
    assert.equal("switched", choice(run, "contact").by, tostring(run:why()))
    assert.equal("wires", run.model.contact)
    assert.is_true(scene:contacts() > 0)
  end)
end)

-- v = (x - x before)/span at free nodes; only for lines with the same number of nodes.
describe("core.came_from", function()
  it("gives the velocity of a displacement", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { model = "rod", segments = 4 })
    scene:clamp(w, { s = 0 })
    local before = w:positions()
    for i = 3, #before, 3 do before[i] = before[i] - 0.02 end
    core.came_from(w, before, 0.1)
    local v = w:velocities()
    assert.is_near(0.2, v[#v], 1e-12)
    assert.equal(0, v[3]) -- held
    assert.has_error(function() core.came_from(w, { 0, 0, 0 }, 0.1) end)
    assert.has_error(function() core.came_from(w, before, 0) end)
    assert.has_error(function() core.came_from(w, before, 1e-300) end)
  end)
end)
