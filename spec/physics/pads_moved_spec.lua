-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cables moved between pads have the same results at all steps. With whole steps, forces were up to 70 %
-- off at 20 ms, and nothing reported it. Of 168 values of random scenes like these three, 36 were more than
-- 10 % off those of steps of 0.25 ms at 20 ms, and 22 at 10 ms. With divided steps these are 1 and 2.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local function damped(scene, cable, from, to, segments)
  local wire = scene:wire{ cable = cable, from = from, to = to, segments = segments }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  local got = wire:get()
  return wire, got.radius, 9.81 * got.mass_per_length * wire.length
end

-- Waits until a time. The jaws meet the wire at a step's end, so a grasp takes longer with longer steps.
local function till(p, scene, time) p:wait(time - scene.time) end

-- The wire is lifted off a table, carried to a side and dropped.
local function lifted(scene, cable)
  scene:obstacle{ name = "met", shape = "plane", friction = 0.3 }
  local radius = sw.cable(cable).outer_diameter.value / 2
  local wire, _, weight = damped(scene, cable, { 0, 0, radius }, { 0.45, 0, radius }, 43)
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, width = 0.015 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.16, approach = "plates", force = 8 * weight })
    till(p, scene, 0.8)
    hand:move{ by = { 0, 0, 0.22 }, duration = 0.6 }
    hand:move{ by = { 0, -0.18, 0 }, duration = 0.4 }
    p:wait(0.1)
    hand:release()
    p:wait(0.3)
  end)
  return wire, hand, weight
end

-- The wire is swung against the side of a box.
local function swung(scene, cable)
  scene:obstacle{ name = "met", shape = "box", size = { 0.1, 0.4, 0.4 }, at = { 0.25, 0, 0.2 },
    friction = 0.3 }
  local wire, _, weight = damped(scene, cable, { 0, 0, 0.6 }, { 0, 0, 0.18 }, 47)
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.6, width = 0.02 } }
  local held = scene:clamp(wire, { s = 0 })
  scene:process(function(p)
    hand:grasp(wire, { s = 0.02, approach = "plates", force = 16 * weight })
    till(p, scene, 0.8)
    held:release()
    hand:move{ by = { 0.3, 0.05, 0.1 }, duration = 0.35 }
    p:wait(0.3)
  end)
  return wire, hand, weight
end

-- The wire's end is pushed against a slanted wall.
local function poked(scene, cable)
  scene:obstacle{ name = "met", shape = "box", size = { 0.1, 0.4, 0.4 }, at = { 0.23, 0, 0.2 },
    rotation = { axis = { 0, 1, 0 }, angle = 0.4 }, friction = 0.2 }
  local wire, _, weight = damped(scene, cable, { 0, 0, 0.2 }, { 0.15, 0, 0.2 }, 31)
  local hand = scene:gripper{ name = "hand", pads = { friction = 0.6, width = 0.02 } }
  local held = { scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = 0.15 }) }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.03, approach = "plates", force = 60 * weight })
    till(p, scene, 0.8)
    for _, clamp in ipairs(held) do clamp:release() end
    hand:move{ by = { 0.06, 0, 0 }, speed = 0.15 }
    p:wait(0.2)
  end)
  return wire, hand, weight
end

local function outcome(build, cable, options)
  local scene = sw.scene{}
  local wire, hand, weight = build(scene, cable)
  t.fine(scene:run(options))
  local loads = hand:over()
  local out = { -- loads below half the weight and bends wider than 300 radii do not count
    tension = wire:max_tension() + 0.5 * weight,
    bend = 1 / wire:min_bend_radius() + 1 / (300 * wire:get().radius),
    force = loads.peak_force + 0.5 * weight,
    moment = loads.peak_moment + 0.05 * weight * wire.length,
    met = scene:find("met"):over().peak_force + 0.5 * weight }
  out.squeeze, out.place = loads.peak_squeeze, wire:position(wire.length)
  scene:close()
  return out
end

describe("a cable between pads", function()
  local ways = { lifted = lifted, swung = swung, poked = poked }
  for name, build in pairs(ways) do
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 10" } do
      it(("%s, %s, is the same at all steps"):format(cable, name), function()
        local fine = outcome(build, cable, { dt = 2e-4 })
        for _, options in ipairs{ { dt = 0.02 }, { dt = 0.01 }, { dt = 0.005 }, { tolerance = 1e-4 } } do
          local at, got = options.dt and options.dt .. " s" or "tolerance", outcome(build, cable, options)
          for _, key in ipairs{ "tension", "bend", "force", "moment", "met" } do
            t.share(fine[key], got[key], 0.1, ("%s, %s"):format(key, at))
          end
          -- the jaws' force is met to 1.5 % when it is first reached; a blow may add to it
          t.below(1.03 * fine.squeeze, got.squeeze, "squeeze, " .. at)
          for k = 1, 3 do t.near(fine.place[k], got.place[k], 0.012, "end, " .. at) end
        end
      end)
    end
  end
end)

describe("the moment of a tool that turns", function()
  -- Fingers press from both sides with 200 times the cable's weight. If a step's moment is made of mean
  -- forces at the fingers' places at its end, each has an arm of 4 mm from the turn within the step. At 20
  -- ms the moment about the wire was then 20 times that at 1 ms, the moment about the vertical 3.2 times.
  local function turned(axis, dt)
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire, _, weight = damped(scene, "GXL 1.5", { 0, 0, 0.0012 }, { 0.3, 0, 0.0012 }, 41)
    local hand, began = scene:gripper{ name = "hand", pads = { friction = 0.5, width = 0.02 } }, nil
    scene:process(function(p)
      hand:grasp(wire, { s = 0.15, approach = "plates", force = 200 * weight })
      till(p, scene, 0.8)
      hand:move{ by = { 0, 0, 0.2 }, duration = 0.6 }
      p:wait(0.2)
      began = scene.time
      hand:rotate{ axis = axis, angle = 1, duration = 0.5 }
      p:wait(0.2)
    end)
    t.fine(scene:run{ dt = dt })
    return hand:over(began).peak_moment, weight * 0.3
  end

  for name, axis in pairs{ vertical = { 0, 0, 1 }, across = { 0, 1, 0 }, along = { 1, 0, 0 } } do
    it("is the same at all steps: " .. name, function()
      local fine, scale = turned(axis, 1e-3)
      for _, dt in ipairs{ 0.02, 0.01, 0.005 } do
        local got = turned(axis, dt) -- about the wire only its inertia resists: 0
        t.near(fine, got, 0.05 * fine + 1e-3 * scale, ("moment at %g s"):format(dt))
      end
    end)
  end
end)

describe("the largest margin", function()
  local function carried(dt, release)
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire, _, weight = damped(scene, "GXL 1.5", { 0, 0, 0.0012 }, { 0.3, 0, 0.0012 }, 40)
    local hand = scene:gripper{ name = "hand", pads = { friction = 0.5, width = 0.02 } }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.15, approach = "plates", force = 20 * weight })
      hand:move{ by = { 0, 0, 0.1 }, speed = 0.2 }
      hand:move{ by = { 0, 0, -0.099 }, speed = 0.2 }
      if release then hand:release() end
      p:wait(0.2)
    end)
    t.fine(scene:run{ dt = dt })
    return hand
  end

  it("covers what the pads hold, not what they let go", function()
    for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
      local kept, let = carried(dt, false):over(), carried(dt, true):over()
      -- weight and inertia over mu N of both pads: some hundredths
      t.above(1 / 20, kept.peak_margin, "margin")
      t.below(2 / 20, kept.peak_margin, "margin")
      t.share(kept.peak_margin, let.peak_margin, 1e-6, "let go")
      t.above(kept.peak_margin * (1 - 1e-12), kept.raw_peak_margin, "of a single step")
    end
  end)

  it("is given for no step in which the jaws move, nor before the first grasp", function()
    local hand = carried(0.01, true)
    local series, numbers = hand:series(), 0
    for i, margin in ipairs(series.margin) do
      local moves = i > 1 and math.abs(series.opening[i] - series.opening[i - 1]) > 1e-4
      if moves then assert.is_true(margin ~= margin, "at " .. series.t[i]) end
      if margin == margin then numbers = numbers + 1 end
    end
    t.above(20, numbers, "steps with a margin")
  end)
end)

describe("pads that go to an opening", function()
  it("report an overload when they press harder than the cable bears", function()
    for share, told in pairs{ [0.98] = 1, [1] = 0 } do
      local scene = sw.scene{}
      local wire, radius = damped(scene, "H07V-K 10", { 0, 0, 0.05 }, { 0.2, 0, 0.05 }, 20)
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = 0.2 })
      local hand = scene:gripper{ name = "hand" }
      scene:process(function()
        hand:grasp(wire, { s = 0.1, approach = "plates", distance = 2 * radius * share })
      end)
      local run, found = t.fine(scene:run{ dt = 0.01 }), {}
      for _, e in ipairs(run.events) do if e.kind == "overload" then found[#found + 1] = e end end
      assert.equal(told, #found, "at a share of " .. share)
      if told == 1 then
        assert.matches("'hand' presses on wire 'wire1' with %d.%d%de%+04 N per finger", found[1].text)
        t.near(hand:state().squeeze, found[1].value, 1, "its value")
      end
    end
  end)
end)
