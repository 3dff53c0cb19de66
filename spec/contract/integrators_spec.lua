-- SPDX-License-Identifier: GPL-3.0-or-later
-- What every integrator must fulfil besides accuracy: the same bits again, a clean stop when a user's
-- function fails, correct start and end times.
local sw = require "softworld"
local samples = require "contract.samples"

-- A soft wire, clamped at one end, that swings; options.force is a function.
local function swing(options)
  options = options or {}
  local scene = sw.scene{ gravity = { 0, 0, -9.81 } }
  local wire = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 8, model = options.model }
  local clamp = scene:clamp(wire, { s = 0 })
  if options.obstacle then
    scene:obstacle{ shape = "plane", at = { 0, 0, -0.02 }, friction = 0.4, restitution = 0.3 }
  end
  if options.force then scene:force{ kind = options.force, on = wire } end
  return scene, wire, clamp
end

-- A step at which every method is stable; 8 edges with these values allow about 2 ms.
local function step_of(scene) return 0.25 * scene:stable_dt() end

-- Everything that can be read, in hexadecimal floats.
local function bits(scene, wire, clamp)
  local list = { scene.time }
  for _, flat in ipairs{ wire:positions(), wire:velocities(), clamp:force(), clamp:moment{} } do
    table.move(flat, 1, #flat, #list + 1, list)
  end
  list[#list + 1] = wire:tension(0.3)
  list[#list + 1] = scene:energy().total
  for i, value in ipairs(list) do list[i] = ("%a"):format(value) end
  return table.concat(list, " ")
end

local function drift(t, _, v, f)
  for i = 1, #f do f[i] = f[i] - 0.05 * v[i] + 0.01 * math.sin(20 * t) end
end

-- Returns the share that one step leaves of an axial wave a thousand times too fast for it (mean of forty
-- equal steps), and what is left after three steps. The wave is started with steps that resolve it, because
-- a method's start may damp it. A wave that pushes the wire would get parts of steps (step/buckle.c), but
-- the share is that of whole steps.
local function left_over(method)
  local scene = sw.core.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e4, EI = 1e-3, GJ = 1e-3, mass_per_length = 0.1, radius = 0.002,
    segments = 2, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
  scene:pin(wire, { s = 0 })
  wire:set_velocity{ 0.1, 0, 0 }
  local period, size = 1 / (4 * (1e4 / 0.1) ^ 0.5), {}
  scene:advance({ dt = 0.05 * period, integrator = method.name }, period)
  for i = 1, 60 do
    local dt = 1000 * period
    assert.is_true(scene:advance({ dt = dt, integrator = method.name, parts = false }, period + i * dt).ok)
    local x, v = wire:positions(), wire:velocities()
    size[i] = math.abs(x[7] - 1)
    if i == 3 then size.soon = (v[4] ^ 2 + v[7] ^ 2) ^ 0.5 / 0.1 end
  end
  return size[20] > 0 and (size[60] / size[20]) ^ (1 / 40) or 0, size.soon
end

for _, method in ipairs(samples.registry.integrators) do
  describe("integrator " .. method.name, function()
    it("gives the same bits in a second run", function()
      for _, options in ipairs{ {}, { model = "string" }, { force = drift },
        { obstacle = not method.no_contact } } do
        local seen
        for _ = 1, 2 do
          local scene, wire, clamp = swing(options)
          local run = scene:run{ duration = 0.05, dt = step_of(scene), integrator = method.name }
          assert.is_true(run.ok, run.reason)
          local now = bits(scene, wire, clamp)
          assert.are.equal(seen or now, now)
          seen = now
          scene:close()
        end
      end
    end)

    it("gives the same bits after a snapshot is restored", function()
      for _, options in ipairs{ {}, { force = drift }, { obstacle = not method.no_contact } } do
        local scene, wire, clamp = swing(options)
        local dt = step_of(scene)
        scene:run{ duration = 0.03, dt = dt, integrator = method.name }
        local here, before = bits(scene, wire, clamp), scene:snapshot()
        scene:run{ duration = 0.02, dt = dt, integrator = method.name }
        local there = bits(scene, wire, clamp)
        for _ = 1, 2 do
          scene:restore(before)
          assert.are.equal(here, bits(scene, wire, clamp))
          scene:run{ duration = 0.02, dt = dt, integrator = method.name }
          assert.are.equal(there, bits(scene, wire, clamp))
        end
        -- also after other methods and other holds in between
        scene:pin(wire, { s = 0.77 })
        scene:run{ duration = 0.013, dt = dt }
        scene:settle()
        scene:restore(before)
        assert.are.equal(here, bits(scene, wire, clamp))
        scene:run{ duration = 0.02, dt = dt, integrator = method.name }
        assert.are.equal(there, bits(scene, wire, clamp))
      end
    end)

    -- A triple root r, as generalized-alpha has, leaves n^2 r^n after n steps; the midpoint rule has a
    -- single root.
    if method.implicit then
      it("damps waves that are too fast by the share that it states", function()
        local share, soon = left_over(method)
        if method.at_infinity > 0 then
          local growth = method.at_infinity < 1 and (60 / 20) ^ (2 / 40) or 1
          assert.near(method.at_infinity, share / growth, 0.02, "share of a step")
        else
          assert.is_true(soon < 1e-4, soon .. " after three steps")
        end
      end)
    end

    it("stops at a failing function with the last good state and the same error value", function()
      for call = 1, 12 do
        local count, reason = 0, { call = call }
        local scene, wire, clamp
        local last -- state after each good step
        scene, wire, clamp = swing{ force = function()
          count = count + 1
          if count == call then error(reason) end
        end }
        local dt = step_of(scene)
        last = { bits(scene, wire, clamp) }
        local reference, wire2, clamp2 = swing{ force = function() end }
        for _ = 1, 12 do
          reference:run{ duration = dt, dt = dt, integrator = method.name }
          last[#last + 1] = bits(reference, wire2, clamp2)
        end
        local ok, value, run
        for step = 1, 12 do
          ok, value = pcall(scene.run, scene, { duration = dt, dt = dt, integrator = method.name })
          if not ok then
            assert.are.equal(last[step], bits(scene, wire, clamp), "call " .. call)
            break
          end
        end
        assert.is_false(ok)
        assert.are.equal(reason, value)
        run = scene:run{ duration = dt, dt = dt, integrator = method.name } -- still usable
        assert.is_true(run.ok)
      end
    end)

    it("does nothing in a run of no duration", function()
      local scene, wire, clamp = swing()
      scene:run{ duration = 0.01, dt = step_of(scene), integrator = method.name }
      local here = bits(scene, wire, clamp)
      local run = scene:run{ duration = 0, integrator = method.name }
      assert.is_true(run.ok)
      assert.are.equal(0, run.steps)
      assert.are.equal(here, bits(scene, wire, clamp))
    end)

    it("takes one shorter step when dt is longer than the duration", function()
      local scene, wire, clamp = swing()
      local dt = step_of(scene)
      local run = scene:run{ duration = dt, dt = 1, integrator = method.name }
      assert.are.equal(1, run.steps)
      assert.are.equal(dt, scene.time)
      local here = bits(scene, wire, clamp)
      scene, wire, clamp = swing()
      scene:run{ duration = dt, dt = dt, integrator = method.name }
      assert.are.equal(here, bits(scene, wire, clamp))
    end)

    it("ends exactly on time with steps that do not divide it", function()
      local scene = swing()
      local dt = step_of(scene)
      local run = scene:run{ duration = 3.7 * dt, dt = dt, integrator = method.name }
      assert.are.equal(4, run.steps)
      assert.are.equal(3.7 * dt, scene.time)
    end)

    it("reports the divergence of absurd steps, or stays finite", function()
      local scene, wire = swing()
      local run = scene:run{ duration = 20, dt = 5, integrator = method.name, unstable = true }
      if run.ok then
        for _, value in ipairs(wire:positions()) do assert.is_true(value - value == 0) end
      else
        assert.is_truthy(run.reason:find "at t =")
        assert.has_error(function() wire:positions() end)
      end
    end)

    if not method.adaptive then
      it("refuses a tolerance, having no error estimate", function()
        local scene = swing()
        local ok, message = pcall(scene.run, scene,
          { duration = 0.1, tolerance = 1e-3, integrator = method.name })
        assert.is_false(ok)
        assert.is_truthy(message:find("'" .. method.name .. "' has no error estimate", 1, true))
      end)
    end
  end)
end
