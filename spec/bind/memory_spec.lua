-- SPDX-License-Identifier: GPL-3.0-or-later
-- Memory: each memory request of every operation fails once; loops of tuning do not grow.
local sw = require "softworld"
local samples = require "contract.samples"
local core = sw.core

local function collect()
  collectgarbage()
  collectgarbage()
end

local function in_use()
  collect()
  return (core.allocated())
end

local WIRE = { EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005, segments = 6,
  from = { 0, 0, 0 }, to = { 1, 0, 0 } }

-- A scene with one object of each common kind, on which every act works.
local function make()
  local scene = sw.scene{}
  local wire = scene:wire(WIRE)
  local clamp = scene:clamp(wire, { s = 0 })
  scene:obstacle{ shape = "plane", at = { 0, 0, -0.05 } }
  scene:force{ kind = "drag", linear = 0.1 }
  scene:force{ kind = function(_, _, v, f) for i = 1, #f do f[i] = -0.01 * v[i] end end, on = wire }
  return scene, wire, clamp
end

local function new_shape(shape)
  local args = samples.obstacle(shape)
  args.at = { 0, 0, -5 }
  return args
end

-- { name, act(scene, wire, clamp) }: operations that are tried with each of their memory requests failing.
local acts = {
  { "making a scene", function() return sw.scene{} end },
  { "making a wire", function(scene) return scene:wire(WIRE) end },
  { "making a wire on a path", function(scene)
    return scene:wire{ E = 1e8, density = 1e3, radius = 1e-3,
      path = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } } }
  end },
  { "settling", function(scene) return scene:settle() end },
  { "reading a wire", function(_, wire) return wire:positions() end },
  { "reading energies", function(scene) return scene:energy() end },
  { "evaluating forces", function(scene, wire) return scene:evaluate(wire) end },
  { "finding frequencies", function(_, wire)
    return wire:frequencies{ modes = 3, shapes = true, tolerance = 1e9 }
  end },
  { "taking a snapshot", function(scene) return scene:snapshot() end },
  { "restoring after a change", function(scene, wire)
    local snapshot = scene:snapshot()
    scene:pin(wire, { s = 0.77 })
    scene:run{ duration = 0.02, integrator = "bdf2" }
    scene:restore(snapshot)
    scene:run{ duration = 0.02 }
  end },
  { "storing frames within little memory, and packing them", function(scene)
    scene:run{ duration = 0.2, dt = 0.01, frame = 0.01, frames = { memory = 1e4 } }
    local film = core.film(scene, 0, 1, true)
    return #core.deflate(film) + #core.base64(film)
  end },
  { "meshing anew as drawn", function(scene) core.remesh(scene, { 9 }) end },
  { "meshing anew what has moved", function(scene, wire)
    scene:grip(wire, { s = 0.5, width = 0.1 })
    scene:run{ duration = 0.02 }
    core.remesh(scene, { 9 })
  end },
  { "restoring another mesh", function(scene, wire)
    scene:pin(wire, { s = 0.77 })
    local snapshot = scene:snapshot()
    core.remesh(scene, { 9 })
    scene:restore(snapshot)
  end },
  { "settling with error bars", function()
    local scene <close> = sw.scene{}
    scene:clamp(scene:wire(WIRE), { s = 0 })
    return scene:settle{ tolerance = { tip = 1e3 } }
  end },
  { "running with error bars", function(scene, wire)
    local left = scene:gripper{}
    scene:process(function(p)
      left:grasp(wire, { s = 0.5 })
      p:wait(0.002)
    end)
    return scene:run{ tolerance = { tip = 1e3 } }
  end },
  { "following a path", function(_, _, clamp)
    clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.1 }, { 0.1, 0, 0.1 } }, speed = 1, relative = true }
  end },
  { "following a function", function(_, _, clamp) clamp:follow(function() return { 0, 0, 0 } end) end },
  { "following a spline", function(_, _, clamp)
    clamp:follow{ points = { { 0, 0, 0, t = 0 }, { 0, 0, 0.1, t = 1 }, { 0.1, 0, 0.1, t = 2 } },
      law = "spline" }
  end },
  { "rolling, with a clamp put on", function()
    local scene <close> = sw.scene{}
    scene:obstacle{ shape = "plane", rotation = { axis = { 1, 0, 0 }, angle = 0.3 } }
    local wire = scene:wire{ E = 1e8, density = 1e3, radius = 1e-3, from = { 0, 0, 0.0011 },
      to = { 0.2, 0, 0.0011 }, segments = 5, rolls = true }
    scene:run{ duration = 0.02, dt = 0.01 }
    local snapshot = scene:snapshot()
    scene:clamp(wire, { s = 0.11 })
    scene:run{ duration = 0.02, dt = 0.01 }
    scene:restore(snapshot)
    return wire:spin(0.1)
  end },
  { "feeding wire in and out", function(scene, wire)
    local feed = scene:feed(wire, { s = 1, speed = 4 })
    scene:run{ duration = 0.06, dt = 0.02 }
    local snapshot = scene:snapshot()
    feed:feed{ length = -0.2, duration = 0.05, law = "linear" }
    scene:run{ duration = 0.05, dt = 0.02 }
    scene:restore(snapshot)
  end },
  { "feeding curved wire", function()
    local scene <close> = sw.scene{}
    local args = { rest = "path", GJ = 0.01, path = { { 0, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 } } }
    for k, v in pairs(WIRE) do if k ~= "from" and k ~= "to" then args[k] = v end end
    local wire = scene:wire(args)
    scene:feed(wire, { force_limit = 10 })
    scene:feed(wire, { s = 2, speed = 4 })
    scene:run{ duration = 0.08, dt = 0.02 }
  end },
  { "making particles", function(scene) return samples.sheet(scene) end },
  { "making, holding, moving and restoring particles", function()
    local scene <close> = sw.scene{}
    scene:obstacle{ shape = "box", size = { 1, 1, 0.1 }, at = { 0, 0, -0.1 } }
    local x = {}
    for k = 0, 7 do x[k + 1] = { 0.1 * ((k + 1) // 2 % 2), 0.1 * (k // 2 % 2), 0.1 * (k // 4) } end
    x[9] = { 0.2, 0, 0 }
    local object = scene:particles{ positions = x, masses = 0.1, repel = { distance = 0.15, stiffness = 9 },
      elements = { { 1, 2, 3, 4, 5, 6, 7, 8, E = 1e4, nu = 0.2 } },
      links = { { 2, 9, k = 100, yield = 0.01 } } }
    scene:force{ kind = "push", on = object, particles = { 9 }, force = { 4, 0, 0 } }
    local snapshot = scene:snapshot()
    scene:hold(object, { particles = { 1, 5 } })
    scene:run{ duration = 0.02, dt = 0.01 }
    scene:restore(snapshot)
    scene:run{ duration = 0.02, dt = 0.01 }
    return object:positions(), object:links(), object:energy()
  end },
  { "clips, ties and a channel, and restoring them", function()
    local scene <close> = sw.scene{}
    local wire = scene:wire{ E = 1e8, density = 1e3, radius = 2e-3, from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
      segments = 6 }
    local other = scene:wire{ E = 1e8, density = 1e3, radius = 2e-3, from = { 0, 0.01, 0 },
      to = { 0.2, 0.01, 0 }, segments = 6 }
    local clip = scene:clip{ at = { 0.1, 0, 0 }, width = 0.01, insertion = 1, retention = 2, friction = 0.1 }
    scene:channel{ points = { { 0, 0.05, 0 }, { 0.1, 0.05, 0 } }, width = 0.01, depth = 0.01, lid = true }
    local tie = scene:tie(wire, { s = 0.05, strength = 1 })
    local pair = scene:tie(wire, { s = 0.15, to = { other, s = 0.15 } })
    local snapshot = scene:snapshot()
    scene:run{ duration = 0.02, dt = 0.01 }
    scene:restore(snapshot)
    clip:release()
    scene:run{ duration = 0.02, dt = 0.01 }
    return pair:tension(), tie:tension()
  end },
  { "pads that close, freezing what they hold, and restoring it", function()
    local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e7, nu = 0.4, density = 1e3, radius = 3e-3, from = { 0, 0, 0 },
      to = { 0.15, 0, 0 }, segments = 10 }
    local hand = scene:gripper{ pads = { opening = 8e-3 }, arm = { radius = 0.01, length = 0.02 } }
    scene:process(function()
      hand:grasp(wire, { s = 0.075, approach = "mixed", distance = 6e-3, speed = 0.1, spacing = 3e-3,
        freeze = false })
      hand:freeze()
    end)
    scene:run{ dt = 0.01, max_steps = 4 }
    local snapshot = scene:snapshot()
    if hand.frozen then hand:thaw() end
    scene:restore(snapshot)
    return hand:state(), hand:pressure_map(), hand:force()
  end },
  { "calibrating springs", function()
    sw.calibrate { mesh = "tube", particles = 3, EA = 1e4, EI = 0.05, GJ = 0.04, radius = 5e-3 }
    sw.calibrate { mesh = "composite", core = "line", particles = 3, E = 1e8, radius = 5e-3 }
    sw.calibrate { mesh = "composite", core = "cubic", core_across = 2, particles = 3, E = 1e8,
      radius = 5e-3, bonded = false }
    return sw.calibrate { mesh = "cubic", across = 2, E = 1e8, radius = 5e-3, density = 1e3 }
  end },
  { "a whole script", function()
    local scene <close> = sw.scene{}
    local wire = scene:wire(WIRE)
    local left = scene:gripper{}
    scene:process(function(p)
      left:grasp(wire, { s = 0.5 })
      left:move{ by = { 0, 0, 0.05 }, speed = 0.5 }
      p:wait(0.02)
      left:release()
    end)
    local run = scene:run{}
    return run:document(), scene:snapshot()
  end },
}
for _, hold in ipairs(samples.registry.holds) do
  acts[#acts + 1] = { "making a " .. hold.name, function(scene, wire)
    return scene[hold.name](scene, wire, samples.hold(hold, 0.6123))
  end }
end
for _, shape in ipairs(samples.registry.shapes) do
  acts[#acts + 1] = { "making an obstacle " .. shape.name, function(scene)
    return scene:obstacle(new_shape(shape))
  end }
end
for i, force in ipairs(samples.registry.forces) do
  if not force.inner then
    acts[#acts + 1] = { "making a force " .. force.name, function(scene, wire)
      local args = samples.force(force, i)
      args.on = force.of_web and samples.sheet(scene) or wire
      return scene:force(args)
    end }
  end
end
for _, method in ipairs(samples.registry.integrators) do
  acts[#acts + 1] = { "running with " .. method.name, function(scene)
    local dt = method.implicit and 0.01 or 0.0005
    return scene:run{ duration = 4 * dt, dt = dt, frame = dt, integrator = method.name }
  end }
end

-- Returns the error's text or nil; the result of act is dropped.
local function attempt(act, ...)
  local ok, message = pcall(act, ...)
  return not ok and tostring(message) or nil
end

describe("running out of memory", function()
  after_each(function() core.fail_allocation(0) end)

  for _, entry in ipairs(acts) do
    local name, act = entry[1], entry[2]
    it(name .. " leaves nothing behind and a scene that works", function()
      pcall(function()
        local scene <close>, wire, clamp = make()
        act(scene, wire, clamp)
      end)
      local before = in_use()
      local n, failures = 0, 0
      repeat
        n = n + 1
        local scene, wire, clamp = make()
        core.fail_allocation(n)
        local _, asked = core.allocated()
        local message = attempt(act, scene, wire, clamp)
        core.fail_allocation(0)
        local _, now = core.allocated()
        local reached = now - asked >= n
        if message then
          failures = failures + 1
          assert.is_true(reached)
          assert.is_truthy(message:find "memory", message)
        end
        local run = scene:run{ duration = 0.02 }
        assert.is_true(run.ok, ("request %d: %s"):format(n, run.reason))
        scene:pin(wire, { s = 0.3 })
        scene:restore(scene:snapshot())
        assert.are.equal("table", type(scene:settle()))
        scene:close()
      until not reached
      assert.are.equal(before, in_use()) -- of all rounds together: collecting takes long
      assert.is_true(failures > 0 or n == 1, "nothing ever failed")
    end)
  end
end)

describe("tuning loops", function()
  -- The core's memory must stay exactly the same; Lua's may vary, but must not grow with the loop.
  local function loop(count, body)
    for _ = 1, 50 do body() end
    local bytes = in_use()
    local lua = collectgarbage "count"
    for _ = 1, count do body() end
    assert.are.equal(bytes, in_use())
    collect()
    assert.is_true(collectgarbage "count" < lua + 64, "Lua's memory grew") -- [KiB]
  end

  it("of restoring and settling do not grow", function()
    local scene, wire, clamp = make()
    local snapshot = scene:snapshot()
    loop(2000, function()
      scene:restore(snapshot)
      clamp:pose{ 0, 0, 0.01 }
      assert.is_true(scene:settle().ok)
    end)
    assert.is_truthy(wire)
  end)

  it("of restoring, holding, laying obstacles and running do not grow", function()
    local scene, wire = make()
    local left = scene:gripper{ name = "left" }
    local snapshot = scene:snapshot()
    local peak
    loop(300, function()
      scene:restore(snapshot)
      scene:obstacle{ shape = "sphere", radius = 0.1, at = { 0, 0, -1 } }
      scene:force{ kind = function() end, on = wire }
      scene:process(function()
        left:grasp(wire, { s = 0.9 })
        left:move{ by = { 0, 0, 0.02 }, duration = 0.05 }
      end)
      scene:run()
      assert.are.equal(peak or left.peak_force, left.peak_force)
      peak = left.peak_force
    end)
  end)

  it("of making and closing scenes do not grow", function()
    loop(2000, function()
      local scene <close>, wire = make()
      assert.are.equal(6, wire.segments)
      assert.are.equal(0, scene.time)
    end)
  end)

  it("of making scenes and forgetting them do not grow", function()
    loop(500, function() make() end)
  end)
end)
