-- SPDX-License-Identifier: GPL-3.0-or-later
-- The impulse on obstacles over any time is weight times time less the change of momentum, blows included.
-- This holds for every integrator, to the rounding of speeds in steps of nanoseconds.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = sw.core
local t = require "spec.physics.tools"
local window = require "softworld.run.window"

local G = 9.81
local soft = { E = 1e6, density = 1200, radius = 0.003 }

local function rotated(q, v) -- unit quaternion {w, x, y, z}
  local c = t.cross({ q[2], q[3], q[4] }, v)
  local d = t.cross({ q[2], q[3], q[4] }, c)
  return { v[1] + 2 * (q[1] * c[1] + d[1]), v[2] + 2 * (q[1] * c[2] + d[2]), v[3] + 2 * (q[1] * c[3] + d[3]) }
end

-- Throws a wire on a table with a step in it, all turned by q. Returns scene, wire, obstacles, gravity.
local function thrown(o)
  local q = o.q or { 1, 0, 0, 0 }
  local gravity = rotated(q, { 0, 0, -G })
  local scene = sw.scene{ gravity = gravity }
  local parts = { scene:obstacle{ shape = "plane", rotation = q, friction = 0.3, restitution = o.e },
    scene:obstacle{ shape = "box", size = { 0.02, 1, 0.01 }, at = rotated(q, { 0.1, 0, 0.005 }), rotation = q,
      friction = 0.2, restitution = o.e } }
  local args = { from = rotated(q, { 0, 0, 0.02 }), to = rotated(q, { 0.3, 0, 0.03 }), segments = 12 }
  for k, v in pairs(o.wire or soft) do args[k] = v end
  local wire = scene:wire(args)
  wire:set_velocity(rotated(q, o.v or { 1, 0.3, -1 }))
  return scene, wire, parts, gravity
end

local function sum_of(parts, t1, t2)
  local sum = { 0, 0, 0 }
  for _, part in ipairs(parts) do
    local m = part:over(t1, t2)
    t.near(t.norm(m.impulse), m.impulse_size, 1e-15, "size of the impulse")
    for k = 1, 3 do sum[k] = sum[k] + m.impulse[k] end
  end
  return sum
end

-- Checks that the impulse on the obstacles equals what the wires lost, in shares of weight times time.
-- momentum: a function. Returns the impulse, and its size as a share.
local function balanced(mass, gravity, parts, scene, momentum, run, what)
  local before, from = momentum(), scene.time
  run()
  local after, T = momentum(), scene.time - from
  local got, off = sum_of(parts, from, scene.time), 0
  for k = 1, 3 do
    off = math.max(off, math.abs(got[k] - (mass * gravity[k] * T - (after[k] - before[k]))))
  end
  t.near(0, off / (mass * G * T), 1e-6, what .. ": momentum")
  return got, t.norm(got) / (mass * G * T)
end

local function mass_of(wire) return wire.beam.mass_per_length * wire.length end

local function check(o)
  local what = ("%s, e = %g, dt = %g"):format(o.method, o.e, o.dt)
  local scene, wire, parts, gravity = thrown(o)
  local rejected
  local function momentum() return (t.momentum(wire)) end
  local _, share = balanced(mass_of(wire), gravity, parts, scene, momentum, function()
    local run = t.fine(scene:run{ duration = o.duration or 0.2, dt = o.dt, integrator = o.method,
      tolerance = o.tolerance })
    rejected = run.rejected
  end, what)
  t.above(0.9, share, what .. ": something struck") -- it arrived at 1 m/s: 0.1 s of its weight
  return rejected
end

describe("the impulse on obstacles balances the momentum:", function()
  local methods = {}
  for _, method in ipairs(core.registry().integrators) do -- generalized-alpha is not for contact
    if method.name ~= "generalized-alpha" then methods[#methods + 1] = method end
  end
  for _, method in ipairs(methods) do
    it("by " .. method.name, function()
      for _, e in ipairs{ 0, 0.8 } do
        if not method.implicit then
          check{ method = method.name, e = e, dt = 2e-5, duration = 0.08 }
        else
          for _, dt in ipairs{ 0.02, 0.005, 0.001 } do
            local midpoint = method.name == "implicit-midpoint" -- not for contact: a short time only
            if not midpoint or dt == 0.001 then
              check{ method = method.name, e = e, dt = dt, duration = midpoint and 0.03 or nil }
            end
          end
        end
      end
    end)
  end

  it("in short steps, in turned scenes, with stiff cables, rolling wires and redone steps", function()
    local random, redone = t.random(3), 0
    for _, e in ipairs{ 0, 0.8 } do
      redone = redone + check{ method = "tr-bdf2", e = e, dt = 1e-4, duration = 0.1 }
      redone = redone + check{ method = "tr-bdf2", e = e, dt = 0.005, tolerance = e == 0 and 1e-4 or nil }
      check{ method = "tr-bdf2", e = e, dt = 0.002,
        wire = { E = 1e6, density = 1200, radius = 0.003, rolls = true } }
      for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10" } do
        for _, dt in ipairs{ 0.01, 0.001, 0.0002 } do
          redone = redone + check{ method = "tr-bdf2", e = e, dt = dt, wire = { cable = cable },
            q = t.turn(random) }
        end
      end
    end
    t.above(0, redone, "steps redone")
  end)

  it("with obstacles that move", function()
    for _, e in ipairs{ 0, 0.8 } do
      local scene, wire, parts, gravity = thrown{ e = e, wire = { cable = "GXL 1.5" } }
      parts[2]:follow{ points = { { 0.1, 0, 0.005 }, { 0.1, 0.05, 0.06 } }, duration = 0.1, law = "linear" }
      balanced(mass_of(wire), gravity, parts, scene, function() return (t.momentum(wire)) end,
        function() t.fine(scene:run{ duration = 0.2, dt = 0.002 }) end, "moved")
    end
  end)

  it("with particles and meshes", function()
    local scene = sw.scene{}
    local parts = { scene:obstacle{ shape = "plane", friction = 0.3, restitution = 0.5 } }
    local object = scene:particles{ positions = { 0, 0, 0.02, 0.1, 0, 0.03, 0.2, 0, 0.03, 0.1, 0.1, 0.04 },
      masses = 0.01, links = { { pairs = { 1, 2, 2, 3, 1, 4, 2, 4, 3, 4 }, k = 100 } }, radius = 0.005 }
    object:set_velocity{ 0.2, 0, -1 }
    local function momentum()
      local sum, v = { 0, 0, 0 }, object:velocities()
      for i = 1, #v do sum[(i - 1) % 3 + 1] = sum[(i - 1) % 3 + 1] + 0.01 * v[i] end
      return sum
    end
    balanced(0.04, { 0, 0, -G }, parts, scene, momentum,
      function() t.fine(scene:run{ duration = 0.2, dt = 0.002 }) end, "particles")
    scene = sw.scene{}
    scene:force{ kind = "damping", mass = 0, stiffness = 1e-3 }
    parts = { scene:obstacle{ shape = "plane", friction = 0.3 } }
    local wire = scene:wire{ model = "radial", E = 2e6, nu = 0.4, density = 1200, radius = 0.005,
      from = { 0, 0, 0.02 }, to = { 0.05, 0, 0.02 } }
    t.fine(scene:run{ duration = 1, dt = 0.005 })
    local m = parts[1]:over()
    t.share(-mass_of(wire) * G * 1, m.impulse[3], 2e-3, "a mesh that has come to rest")
    t.share(mass_of(wire) * G, parts[1]:over(0.9, 1).mean_force, 0.05, "at rest")
  end)

  it("with a gripper's pads", function()
    local scene, r = sw.scene{}, 0.003
    local table_ = scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire = scene:wire{ E = 2e7, nu = 0.4, density = 1200, radius = r, from = { 0, 0, r },
      to = { 0.2, 0, r } }
    local g = scene:gripper{ pads = { width = 0.02, friction = 0.6, opening = 3 * r } }
    scene:process(function()
      g:grasp(wire, { s = 0.1, approach = "plates", force = 5 })
      g:move{ by = { 0, 0, 0.05 }, duration = 0.05, law = "linear" } -- starts with a jerk
    end)
    t.fine(scene:run{ dt = 0.001 })
    local p, on = t.momentum(wire), table_:over().impulse
    local by = g:over().impulse
    for k = 1, 3 do
      local weight = k == 3 and -mass_of(wire) * G * scene.time or 0
      t.near(p[k], weight + by[k] - on[k], 1e-9 * mass_of(wire) * G * scene.time + 1e-12, "momentum " .. k)
    end
    t.above(1e-3, p[3], "it was going up")
  end)
end)

describe("an obstacle's force", function()
  it("is the mean over the last step, and is in the series", function()
    local scene, _, parts = thrown{ e = 0.8 }
    local run = t.fine(scene:run{ duration = 0.1, dt = 0.004 })
    local rows, n = parts[1]:log()
    assert.are.same({ rows[5 * n - 3], rows[5 * n - 2], rows[5 * n - 1] }, parts[1]:force())
    local largest = 0
    for _, c in ipairs(run:series().columns) do
      if c.name == parts[1].name .. ".contact_force" then
        for _, f in ipairs(c.values) do largest = math.max(largest, f) end
      end
    end
    t.near(largest, parts[1]:over().raw_peak_force, 1e-12, "largest of the series")
    t.above(10 * mass_of(scene:find "wire1") * G, largest, "the blow")
  end)

  it("adds up over parts of the time, whatever the parts", function()
    local scene, _, parts = thrown{ e = 0.8 }
    t.fine(scene:run{ duration = 0.2, dt = 0.004 })
    local all = parts[1]:over()
    local one, two = parts[1]:over(nil, 0.0613), parts[1]:over(0.0613)
    for k = 1, 3 do t.near(all.impulse[k], one.impulse[k] + two.impulse[k], 1e-15, "impulse") end
    t.near(0.2, one.duration + two.duration, 1e-12, "duration")
    t.near(all.mean_force * 0.2, one.mean_force * one.duration + two.mean_force * two.duration, 1e-12, "mean")
  end)

  -- The mean is the same sum, and so has the same bits.
  it("has the same mean where only that is read", function()
    local scene, _, parts = thrown{ e = 0.8 }
    t.fine(scene:run{ duration = 0.1, dt = 0.004 })
    for _, part in ipairs(parts) do
      for _, start in ipairs{ 0, 0.0313 } do
        assert.equal(part:over(start).mean_force, window.mean_force(part, start))
      end
    end
  end)

  it("is that of the equilibrium after settling", function()
    local scene = sw.scene{}
    local plane = scene:obstacle{ shape = "plane" }
    local wire = scene:wire{ E = 1e6, density = 1200, radius = 0.003, from = { 0, 0, 0.003 },
      to = { 0.3, 0, 0.003 } }
    t.fine(scene:settle())
    t.share(-mass_of(wire) * G, plane:force()[3], 1e-6, "weight")
    local m = plane:moment{ at = { 0.15, 0, 0 } }
    t.near(0, m[2], 1e-6, "moment about the middle")
    t.share(mass_of(wire) * G * 0.15, plane:moment()[2], 1e-6, "about the origin")
    assert.are.equal("at rest", plane:over().peak_force_note)
  end)

  it("goes on to the same bits from snapshots and files", function()
    for _, method in ipairs{ "tr-bdf2", "bdf2" } do
      local function begun()
        local scene, wire, parts = thrown{ e = 0.8 }
        t.fine(scene:run{ duration = 0.03, dt = 0.002, integrator = method })
        return scene, wire, parts
      end
      local function go(scene, part)
        t.fine(scene:run{ duration = 0.05, dt = 0.002, integrator = method })
        return (part:log())
      end
      local scene, _, parts = begun()
      local snapshot, force = scene:snapshot(), parts[1]:force()
      local straight = go(scene, parts[1])
      scene:restore(snapshot)
      assert.are.same(force, parts[1]:force())
      assert.are.same(straight, go(scene, parts[1]))
      scene:restore(snapshot)
      local file = os.tmpname()
      scene:save(file)
      local loaded = sw.load(file)
      os.remove(file)
      local same = loaded:find(parts[1].name)
      assert.are.same(force, same:force())
      assert.are.same(straight, go(loaded, same))
    end
  end)

  it("refuses arguments that make no sense", function()
    local scene, _, parts = thrown{ e = 0 }
    t.fine(scene:run{ duration = 0.01 })
    local function refused(text, ...)
      local ok, message = pcall(parts[1].over, ...)
      assert.is_false(ok)
      assert.is_truthy(message:find(text, 1, true), message)
    end
    refused("call it with a colon", 0)
    refused("did you mean 'window'", parts[1], nil, nil, { windw = 1 })
    refused("window = -1 s is not allowed", parts[1], nil, nil, { window = -1 })
    refused("t1 = 'x'", parts[1], "x")
  end)
end)
