-- SPDX-License-Identifier: GPL-3.0-or-later
-- Refused steps: states with impossible values, and explicit steps above their method's stability limit.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local bench = require "bench.rows"
local samples = require "contract.samples"
local t = require "spec.physics.tools"

local explicit = {}
for _, method in ipairs(samples.registry.integrators) do
  if not method.implicit then explicit[#explicit + 1] = method end
end

local function soft()
  local scene = sw.scene{}
  local wire = scene:wire{ EA = 60, EI = 0.02, mass_per_length = 0.1, radius = 0.005,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 8 }
  scene:clamp(wire, { s = 0 })
  return scene, wire
end

local function believable(values, most, what)
  for _, value in ipairs(values) do
    assert.is_true(math.abs(value) < most, what .. ": " .. value)
  end
end

describe("a state with infinite or huge velocities", function()
  it("is never accepted", function()
    local failed = 0
    for _, method in ipairs(samples.registry.integrators) do
      for _, force in ipairs{ 1e308, 1e200 } do
        local scene, wire = soft()
        local h = 1e-4
        -- a force at the very end of the step moves the nodes only in the next step
        scene:force{ on = wire, kind = function(time, _, _, f)
          for i = 1, time > 0.99 * h and #f or 0 do f[i] = force end
        end }
        local run = scene:run{ duration = h, dt = h, integrator = method.name }
        if run.ok then
          believable(wire:velocities(), 1e6, method.name)
          t.below(1e6, scene:energy().kinetic, "kinetic energy with " .. method.name)
        else
          failed = failed + 1
          assert.matches("'wire1'", run.reason .. (method.implicit and "'wire1'" or ""))
          assert.error_matches(function() return wire:velocities() end, "diverged")
        end
      end
    end
    t.above(6, failed, "failed runs")
  end)
end)

describe("solid elements", function()
  it("in steps above the limit stay within 1 m, or the run fails and names the torn wire", function()
    local failed, torn = 0, 0
    for _, method in ipairs(explicit) do
      for _, share in ipairs{ 1.5, 3, 20 } do
        for _, held in ipairs{ true, false } do
          local scene = sw.scene{}
          local wire = scene:wire{ E = 1e7, density = 1150, radius = 0.005, model = "radial",
            body = "solid", from = { 0, 0, 0 }, to = { 0.05, 0, 0 } }
          if held then scene:clamp(wire, { s = 0 }) end
          wire:set_velocity({ 0, 0, 1 }, { 0, 300, 0 })
          local dt = share * method.leapfrog_limit / 2 * scene:stable_dt()
          local run = scene:run{ duration = 30 * dt, dt = dt, integrator = method.name, unstable = true }
          if run.ok then
            believable(wire:particles(), 1, method.name)
          else
            failed = failed + 1
            assert.matches("wire 'wire1' .*near s = ", run.reason)
          torn = torn + (run.reason:find("torn apart", 1, true) and 1 or 0)
          end
        end
      end
    end
    t.above(20, failed, "failed runs")
    t.above(20, torn, "torn wires") -- the other wires had non-finite places at once
  end)

  it("can be stretched to six times their length", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e5, density = 1150, radius = 0.005, model = "cubic", body = "solid",
      from = { 0, 0, 0 }, to = { 0.02, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = wire.length }):follow{
      points = { { 0.02, 0, 0 }, { 0.12, 0, 0 } }, times = { 0, 1 } }
    t.fine(scene:run{ duration = 1, dt = 0.02 })
    t.near(0.12, wire:position(wire.length)[1], 1e-6, "end")
  end)
end)

describe("an explicit step above its method's limit", function()
  it("is refused by every explicit method, and nothing moves", function()
    t.above(7.5, #explicit, "explicit methods")
    for _, method in ipairs(explicit) do
      local scene, wire = soft()
      local most = method.leapfrog_limit / 2 * scene:stable_dt()
      local before = wire:positions()
      assert.error_matches(function()
        return scene:run{ duration = 1, dt = 1.01 * most, integrator = method.name }
      end, "is above .* s, up to which integrator '" .. method.name:gsub("%-", "%%-")
        .. "' is stable here .*unstable = true")
      assert.same(before, (wire:positions()))
      assert.equal(0, scene.time)
      t.fine(scene:run{ duration = 0.02, dt = 0.99 * most, integrator = method.name })
    end
  end)

  -- Dashpots lower the limit to 2/omega (sqrt(1 + zeta^2) - zeta), by up to a thousand for stiff cables.
  it("is known with dashpots, too", function()
    for _, method in ipairs(explicit) do
      for _, cable in ipairs{ "H07V-K 4", false } do
        for _, lag in ipairs{ 2e-7, 2e-6, 2e-5, 2e-4 } do
          for _, kind in ipairs{ "damping", "viscous_bend" } do
            local scene = sw.scene{}
            local wire = scene:wire{ cable = cable or nil, segments = 20, E = not cable and 5e6 or nil,
              density = not cable and 1500 or nil, radius = not cable and 0.002 or nil,
              path = { { 0, 0, 0 }, { 0.1, 0.02, 0 }, { 0.2, 0, 0.03 }, { 0.3, 0.02, 0 } } }
            scene:clamp(wire, { s = 0 })
            local undamped = scene:stable_dt()
            if kind == "damping" then
              scene:force{ kind = "damping", stiffness = lag }
            else
              scene:force{ kind = "viscous_bend", eta = 1000 * lag * wire.beam.EI }
            end
            local most = method.leapfrog_limit / 2 * scene:stable_dt()
            t.above(scene:stable_dt() - 1e-15, undamped, "limit without dashpots")
            t.fine(scene:run{ duration = 2000 * most, dt = 0.98 * most, integrator = method.name })
          end
        end
      end
    end
  end)

  it("is taken with unstable = true; the run then fails and names the wire", function()
    for _, method in ipairs(explicit) do
      local scene, wire = soft()
      wire:set_velocity{ 1, 0, 1 }
      local dt = 2.5 * method.leapfrog_limit * scene:stable_dt()
      local run = scene:run{ duration = 200 * dt, dt = dt, integrator = method.name, unstable = true }
      assert.is_false(run.ok)
      assert.matches("wire 'wire1' is", run.reason)
    end
  end)

  it("does not concern quasi-static runs, implicit methods and one short step", function()
    local scene = soft()
    t.fine(scene:run{ duration = 0.1, dt = 0.1, integrator = "rk4", quasistatic = true })
    t.fine(scene:run{ duration = 0.1, dt = 0.1 })
    t.fine(scene:run{ duration = scene:stable_dt(), dt = 1, integrator = "rk4" })
  end)

  it("is refused at any level of a run with error bars; the scene stays as it was", function()
    local scene, wire = soft()
    local before = wire:positions()
    for _, dt in ipairs{ 0.1, 0.03 } do
      assert.error_matches(function()
        return scene:run{ duration = 0.02, dt = dt, integrator = "velocity-verlet",
          tolerance = { tip = 1e-3 } }
      end, "unstable = true")
      assert.same(before, (wire:positions()))
      assert.equal(0, scene.time)
    end
    t.fine(scene:run{ duration = 0.02, dt = 1e-3 })
  end)

  it("is judged by limits that match the stability polynomials", function()
    for _, method in ipairs(explicit) do
      t.share(bench.limit(method.name, 20000, 100), method.leapfrog_limit, 2e-3, method.name)
    end
    for _, method in ipairs(samples.registry.integrators) do
      if method.implicit then assert.equal(0, method.leapfrog_limit) end
    end
  end)

  it("is judged by limits that a straight wire confirms", function()
    for _, method in ipairs(explicit) do
      for _, share in ipairs{ 0.98, 1.05 } do
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ E = 1e7, density = 1500, radius = 0.0025, from = { 0, 0, 0 },
          to = { 1, 0, 0 }, segments = 8 }
        scene:clamp(wire, { s = 0 })
        wire:set_velocity{ 1e-6, 0, 1e-6 }
        local start, dt = scene:energy().total, share * method.leapfrog_limit / 2 * scene:stable_dt()
        local run = scene:advance({ dt = dt, integrator = method.name, unstable = true }, 4000 * dt)
        local grown = run.ok and run.rejected == 0 and scene:energy().total / start or math.huge
        -- methods whose swings grow slowly reach factors up to 100 in 20000 steps at the limit
        if share < 1 then t.below(10, grown, "growth below the limit with " .. method.name) end
        if share > 1 and method.order ~= 5 then
          t.above(1e3, grown, "growth above the limit with " .. method.name)
        end
      end
    end
  end)
end)

describe("implicit-midpoint", function()
  it("is warned of once where wires touch something, because it gains energy there", function()
    local function events(method, floor)
      local scene = soft()
      scene:obstacle{ shape = "plane", at = { 0, 0, floor } }
      scene:run{ duration = 0.1, dt = 0.002, integrator = method } -- the run may end with ok = false
      local list = {}
      for _, event in ipairs(scene:events()) do
        if event.kind == "integrator" then list[#list + 1] = event end
      end
      return list
    end
    local told = events("implicit-midpoint", -0.01)
    assert.equal(1, #told)
    assert.equal(1, told[1].count)
    assert.matches("'implicit%-midpoint' gains energy in contacts of wires; use integrator = 'tr%-bdf2' for "
      .. "contact$",
      told[1].text)
    assert.same({}, events("implicit-midpoint", -5))
    assert.same({}, events("tr-bdf2", -0.01))
  end)
end)
