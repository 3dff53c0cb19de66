-- SPDX-License-Identifier: GPL-3.0-or-later
-- Steps in which a wire moves too fast are taken in parts (substeps). Damped cables that fall on things,
-- are struck, swung and laid have the tension, bend radius and end of fine steps, whatever dt is.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local flat = { axis = { 1, 0, 0 }, angle = math.pi / 2 }
local function peg(scene, at)
  return scene:obstacle{ shape = "cylinder", radius = 0.01, length = 0.2, rotation = flat, at = at,
    friction = 0.3 }
end

local soft = { E = 5e6, density = 1500, radius = 0.0025 }
local cables = { ["GXL 1.5"] = { cable = "GXL 1.5" }, ["FLRY-B 10"] = { cable = "FLRY-B 10" },
  ["GXL 0.5"] = { cable = "GXL 0.5" }, soft = soft }

local function wire(scene, name, from, to)
  local o = { from = from, to = to, segments = 50 }
  for key, value in pairs(cables[name]) do o[key] = value end
  local w = scene:wire(o)
  scene:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 }
  return w
end

-- Each returns the wire and the duration [s], if no process sets it.
local scenes = {
  ["falls on a table"] = function(s, name)
    s:obstacle{ shape = "plane", friction = 0.3 }
    return wire(s, name, { -0.2, 0, 0.1 }, { 0.2, 0, 0.25 }), 0.4
  end,
  ["falls on a peg"] = function(s, name)
    peg(s, { 0.05, 0, 0.1 })
    return wire(s, name, { -0.25, 0, 0.2 }, { 0.25, 0, 0.2 }), 0.35
  end,
  ["falls over two pegs, clamped"] = function(s, name)
    peg(s, { 0.15, 0, 0.12 })
    peg(s, { 0.4, 0, 0.05 })
    local w = wire(s, name, { 0, 0, 0.2 }, { 0.6, 0, 0.2 })
    s:clamp(w, { s = 0 })
    return w, 0.6
  end,
  ["falls on a box's edge, clamped"] = function(s, name)
    s:obstacle{ shape = "box", size = { 0.3, 0.4, 0.1 }, at = { 0.2, 0, 0.1 }, friction = 0.3 }
    local w = wire(s, name, { 0, 0, 0.2 }, { 0.5, 0, 0.25 })
    s:clamp(w, { s = 0 })
    return w, 0.6
  end,
  ["swings against a peg"] = function(s, name)
    peg(s, { 0.05, 0, 0.8 })
    local w = wire(s, name, { 0, 0, 1 }, { 0.5, 0, 1 })
    s:pin(w, { s = 0 })
    return w, 0.6
  end,
  ["is struck by a rod"] = function(s, name)
    local w = wire(s, name, { 0, 0, 0.5 }, { 0, 0, 0.1 })
    s:clamp(w, { s = 0 })
    peg(s, { -0.1, 0, 0.25 }):follow{ points = { { 0, 0, 0 }, { 0.25, 0, 0 } }, duration = 0.5,
      relative = true }
    return w, 0.9
  end,
  ["is swung against a wall"] = function(s, name)
    local w = wire(s, name, { 0, 0, 0.5 }, { 0, 0, 0.1 })
    s:obstacle{ shape = "box", size = { 0.02, 0.4, 0.5 }, at = { 0.25, 0, 0.2 }, friction = 0.3 }
    local g = s:gripper{}
    s:process(function(p)
      g:grasp(w, { s = 0.01 })
      g:move{ by = { 0.2, 0, 0 }, speed = 0.6 }
      p:wait(0.3)
    end)
    return w
  end,
}

local function measure(build, name, options)
  local scene = sw.scene{}
  local w, duration = build(scene, name)
  options.duration = duration
  local run = t.fine(scene:run(options))
  return { tension = w:max_tension(), radius = w:min_bend_radius(), place = w:position(w.length),
    steps = run.steps, ledger = run:ledger(), length = w.length }
end

describe("a damped cable that", function()
  for what, build in pairs(scenes) do
    for name in pairs(cables) do
      it(("%s is the same at all steps: %s"):format(what, name), function()
        local truth = measure(build, name, { dt = 2.5e-4, parts = false })
        for _, dt in ipairs{ 1e-2, 4e-3 } do
          local m = measure(build, name, { dt = dt })
          t.below(0.1, math.abs(m.tension / truth.tension - 1), "tension, share off [-]")
          t.below(0.03, math.abs(m.radius / truth.radius - 1), "bend radius, share off [-]")
          t.below(0.01, t.distance(m.place, truth.place) / m.length, "end, of the length [-]")
          t.below(5e-3, m.ledger.gained / m.ledger.play, "gained, of what is in play [-]")
        end
        local whole = measure(build, name, { parts = false }) -- for the manual's figures
        t.below(math.huge, math.abs(whole.tension / truth.tension - 1), "whole steps: tension, share off [-]")
        t.below(math.huge, math.abs(whole.radius / truth.radius - 1), "whole steps: radius, share off [-]")
        t.below(math.huge, measure(build, name, {}).steps / whole.steps, "steps, over whole ones [-]")
      end)
    end
  end
end)

-- A rebound cuts the part in which it happens; such a short part is no sign of a bad step. Softer cables
-- rebound differently after a shift of 1e-6 m: their tension scatters by 8 % at all steps.
describe("a stiff cable that is thrown back by a table", function()
  local function thrown(s, name)
    s:obstacle{ shape = "plane", friction = 0.4, restitution = 0.13 }
    local w = s:wire{ cable = name, from = { -0.2, 0, 0.4 }, to = { 0.25, 0, 0.6 }, segments = 32 }
    s:force{ kind = "damping", on = w, mass = 2, stiffness = 1e-3 }
    return w, 0.7
  end
  for _, name in ipairs{ "H07V-K 10", "FLRY-B 10", "GXL 6" } do
    it("is the same at all steps: " .. name, function()
      local truth = measure(thrown, name, { dt = 2.5e-4, parts = false })
      for _, dt in ipairs{ 2e-2, 1e-2, 4e-3 } do
        local m, what = measure(thrown, name, { dt = dt }), (" at steps of %g s"):format(dt)
        t.below(0.1, math.abs(m.tension / truth.tension - 1), "tension, share off [-]" .. what)
        t.below(0.03, math.abs(m.radius / truth.radius - 1), "bend radius, share off [-]" .. what)
        t.below(0.02, t.distance(m.place, truth.place) / m.length, "end, of the length [-]" .. what)
      end
    end)
  end
end)

describe("parts of steps", function()
  it("are not taken where nothing moves fast", function()
    local scene = sw.scene{}
    local w = wire(scene, "GXL 1.5", { 0, 0, 0 }, { 0.4, 0, 0 })
    scene:clamp(w, { s = 0 })
    scene:clamp(w, { s = 0.4 }):follow{ points = { { 0, 0, 0 }, { -0.02, 0, 0 } }, duration = 1,
      relative = true }
    scene:settle()
    assert.equal(100, scene:run{ duration = 1 }.steps)
  end)

  it("are few in a laying", function()
    local function lay(parts)
      local scene = sw.scene{}
      scene:obstacle{ shape = "plane", friction = 0.3 }
      for k = 1, 3 do
        scene:obstacle{ shape = "box", size = { 0.01, 1, 0.1 }, friction = 0.3,
          at = { 0.1 + 0.2 * k, 0, 0.05 } }
      end
      local w = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, from = { 0, 0, 0.0025 },
        to = { -1, 0, 0.0025 }, segments = 100 }
      local gripper = scene:gripper{}
      scene:process(function(p)
        gripper:grasp(w, { s = 0.03 })
        gripper:move{ by = { 0.2, 0, 0.15 }, speed = 0.25 }
        gripper:move{ by = { 0.6, 0, 0 }, speed = 0.25 }
        gripper:move{ by = { 0, 0, -0.14 }, speed = 0.25 }
        p:wait(0.5)
      end)
      return t.fine(scene:run{ parts = parts }).steps
    end
    t.below(1.1, lay() / lay(false), "steps, over whole ones in a laying [-]")
  end)

  it("can be switched off with parts = false", function()
    local build = scenes["swings against a peg"]
    local whole, parts = measure(build, "soft", { parts = false }), measure(build, "soft", {})
    assert.is_true(parts.steps > 1.5 * whole.steps, parts.steps)
  end)

  it("are as many for a turned scene, and as exact for shifted meshes", function()
    local function drop(turned, shift)
      local scene = sw.scene{ gravity = turned and { 0, -9.81, 0 } or { 0, 0, -9.81 } }
      local at = function(x, z) return turned and { x, z, 0 } or { x, 0, z } end
      local w = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, from = at(-0.2, 0.1),
        to = at(0.2, 0.25), segments = 40 + shift }
      scene:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 }
      scene:obstacle{ shape = "plane", friction = 0.3,
        rotation = turned and { axis = { 1, 0, 0 }, angle = -math.pi / 2 } or nil }
      local run = t.fine(scene:run{ duration = 0.4 })
      return run.steps, w:max_tension()
    end
    local steps, tension = drop(false, 0)
    local turned, same = drop(true, 0)
    assert.equal(steps, turned)
    t.below(1e-6, math.abs(same / tension - 1), "tension, turned [-]")
    local _, shifted = drop(false, 1)
    t.below(0.15, math.abs(shifted / tension - 1), "tension, one edge more [-]")
  end)
end)
