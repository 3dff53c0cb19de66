-- SPDX-License-Identifier: GPL-3.0-or-later
-- The energy ledger: it balances; each source and sink is right by itself; the integrator's losses fall
-- with the step; and no step makes energy unreported.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local soft = { E = 50e6, density = 1500, radius = 0.0025, from = { 0, 0, 0 }, to = { 1, 0, 0 },
  segments = 20 }

local function wire_of(scene, more)
  local args = {}
  for k, v in pairs(soft) do args[k] = v end
  for k, v in pairs(more or {}) do args[k] = v end
  return scene:wire(args)
end

-- Checks, to rounding: start + work - losses + gap (energy that nothing explains) = total now. Returns the
-- ledger.
local function balanced(run, what)
  local l = run:ledger()
  local sum, size = l.at_start + l.gap, math.abs(l.at_start) + l.gap + math.abs(l.total)
  for _, w in pairs(l.work) do sum, size = sum + w, size + math.abs(w) end
  for _, w in pairs(l.lost) do sum, size = sum - w, size + math.abs(w) end
  t.near(l.total, sum, 1e-11 * size + 1e-15, (what or "") .. ": balance")
  return l
end

-- A cantilever, released, with a force on it.
local function damped(dt, force)
  local s = sw.scene{}
  local w = wire_of(s)
  force.on = w
  s:force(force)
  s:clamp(w, { s = 0 })
  return s:run{ duration = 0.5, dt = dt }
end

-- Each case makes a scene with one source or sink, and runs it with steps of dt.
local cases = {
  release = function(dt)
    local s = sw.scene{}
    s:clamp(wire_of(s), { s = 0 })
    return s:run{ duration = 0.5, dt = dt }
  end,
  hold = function(dt)
    local s = sw.scene{}
    local w, g = wire_of(s), s:gripper{}
    s:process(function()
      g:grasp(w, { s = 0.02 })
      g:move{ by = { 0.1, 0.05, 0.1 }, duration = 0.6 }
    end)
    return s:run{ dt = dt }
  end,
  turned = function(dt)
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local w, g = wire_of(s), s:gripper{}
    s:process(function()
      g:grasp(w, { s = 0.02 })
      g:rotate{ axis = { 0, 0, 1 }, angle = 1, duration = 0.6 }
    end)
    return s:run{ dt = dt }
  end,
  damping = function(dt) return damped(dt, { kind = "damping", mass = 1, stiffness = 0.01 }) end,
  drag = function(dt) return damped(dt, { kind = "drag", linear = 0.05, quadratic = 0.1 }) end,
  load = function(dt)
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local w = wire_of(s)
    s:force{ kind = "line", on = w, force = { 0, 0.1, -0.2 } }
    s:force{ kind = "point", on = w, s = 0.7, force = { 0, 0.05, 0 } }
    s:clamp(w, { s = 0 })
    return s:run{ duration = 0.5, dt = dt }
  end,
  callback = function(dt)
    local s = sw.scene{ gravity = { 0, 0, 0 } }
    local w = wire_of(s)
    s:force{ on = w, kind = function(time, _, _, f) f[3 * 20 + 3] = 0.02 * math.sin(10 * time) end }
    s:clamp(w, { s = 0 })
    return s:run{ duration = 0.5, dt = dt }
  end,
  slide = function(dt) -- 1 m/s over a table; friction takes mu m g times the way
    local s = sw.scene{}
    s:obstacle{ shape = "plane", at = { 0, 0, -0.0025 }, friction = 0.3 }
    local w = wire_of(s)
    s:settle()
    w:set_velocity{ 1, 0, 0 }
    return s:run{ duration = 0.2, dt = dt }
  end,
  belt = function(dt) -- a board lifts the wire
    local s = sw.scene{}
    local board = s:obstacle{ shape = "box", size = { 2, 0.2, 0.1 }, at = { 0.5, 0, -0.0525 },
      friction = 0.3 }
    wire_of(s)
    s:settle()
    board:follow{ points = { { 0.5, 0, -0.0525 }, { 0.5, 0.02, 0.0475 } }, duration = 0.5 }
    return s:run{ duration = 0.5, dt = dt }
  end,
}

describe("energy ledger", function()
  for name, case in pairs(cases) do
    it("balances, and loses less with smaller steps: " .. name, function()
      local shares = {}
      for k, dt in ipairs{ 4e-3, 2e-3, 1e-3, 5e-4 } do
        local run = case(dt)
        t.fine(run)
        local l = balanced(run, name)
        shares[k] = (l.lost.integrator + l.gap) / l.play
        assert.equal(0, l.accepted.count)
      end
      -- At fine steps at most a thousandth of the energy in play is lost. The quadratures and tr-bdf2 are
      -- of second order: from 4 to 0.5 ms smooth losses fall to a 64th. Loads and motions that begin
      -- abruptly raise axial waves that the steps do not resolve and that keep losing energy, so a tenth is
      -- demanded.
      t.below(1e-3, shares[4], name .. ": lost at 0.5 ms, share of what was in play")
      if shares[1] > 1e-6 then t.below(0.1, shares[4] / shares[1], name .. ": from 4 to 0.5 ms") end
    end)
  end

  it("gives the work of friction: mu m g times the way", function()
    local run = cases.slide(1e-3)
    local mass = 1500 * math.pi * 0.0025 ^ 2
    local way = 0.2 - 0.5 * 0.3 * 9.80665 * 0.2 ^ 2
    t.share(0.3 * mass * 9.80665 * way, run:ledger().lost.friction, 5e-3, "friction")
  end)

  it("shows in the series, at each step, where the energy is: kept, lost or unexplained", function()
    local s = sw.scene{}
    wire_of(s, { from = { 0, 0, 0.05 }, to = { 1, 0, 0.05 } })
    s:obstacle{ shape = "plane", friction = 0.3 }
    local run = s:run{ duration = 0.4, dt = 0.002 }
    local rows, count = sw.core.energy_log(s)
    local start = run:ledger().at_start
    assert.is_true(count >= 200)
    for i = 0, count - 1 do
      local _, kinetic, stored, gravity, gap, lost = table.unpack(rows, 6 * i + 1, 6 * i + 6)
      t.near(start, kinetic + stored + gravity + lost - gap, 1e-11 * start, "sum of a row")
    end
    assert.is_true(rows[#rows] > 0.9 * start) -- the wire lies: all but its height of 2.5 mm is lost
  end)

  it("gives the work of a hold: lifting a wire gives it height", function()
    local s = sw.scene{}
    s:force{ kind = "damping", mass = 20 }
    local w, g = wire_of(s, { E = 1e9 }), s:gripper{}
    s:process(function(p)
      g:grasp(w, { s = 0.5 })
      p:wait(1)
      g:move{ by = { 0, 0, 0.3 }, duration = 1 }
      p:wait(1)
    end)
    local l = balanced(t.fine(s:run{ dt = 2e-3 }))
    local mass = 1500 * math.pi * 0.0025 ^ 2
    -- damping takes the cost of the lift's speed; the rest is height
    t.share(l.work.holds - l.lost.damping, l.total - l.at_start, 1e-2, "work")
    t.above(mass * 9.80665 * 0.3, l.work.holds, "more than the height")
  end)

  it("balances in quasi-static runs: work is the change of potential", function()
    local s = sw.scene{}
    local w = wire_of(s)
    local clamp = s:clamp(w, { s = 0.5 })
    t.fine(s:settle())
    clamp:follow{ points = { { 0.5, 0, 0 }, { 0.5, 0.1, 0.2 } }, duration = 1 }
    local l = balanced(t.fine(s:run{ duration = 1, dt = 0.02, quasistatic = true }))
    t.share(l.work.holds, l.total - l.at_start, 2e-3, "work of the clamp")
    t.share(1500 * math.pi * 0.0025 ^ 2 * 9.80665 * 0.2, l.work.holds, 2e-3, "weight over height")
    assert.equal(0, l.redone.count)
  end)

  -- Damped methods lose energy; none gains it unreported. The loss falls with the step by the method's
  -- order.
  for _, method in ipairs(sw.core.registry().integrators) do
    it("balances with " .. method.name, function()
      local lost = {}
      for k = 1, 2 do
        local s = sw.scene{}
        s:clamp(wire_of(s, { segments = 10 }), { s = 0 })
        local dt = method.implicit and 4e-3 / k or 0.2 * s:stable_dt() / k
        local l = balanced(t.fine(s:run{ duration = 0.1, dt = dt, integrator = method.name }), method.name)
        lost[k] = math.abs(l.lost.integrator - l.gap) / l.play
      end
      if lost[1] > 1e-9 and method.implicit then
        -- an error of order p; the ledger's own quadratures are of second order
        t.below(method.order == 1 and 0.65 or 0.4, lost[2] / lost[1], method.name .. ": by half the step")
      end
      t.below(method.order == 1 and 0.05 or 2e-3, lost[2], method.name .. ": lost")
    end)
  end

  -- The first run stops at the end of step two; its file is of the end of step one.
  it("is kept, to the bit, in a run that is resumed", function()
    local function make(stops)
      local s = sw.scene{ name = "resumed" }
      s:obstacle{ shape = "plane", friction = 0.3, at = { 0, 0, -0.1 } }
      local w = wire_of(s)
      local g = s:gripper{ name = "hand" }
      s:process(function(p)
        p:step("one", function() g:grasp(w, { s = 0.02 }) p:wait(0.2) end)
        p:step("two", function()
          g:move{ by = { 0, 0.1, 0 }, duration = 0.3 }
          if stops then error("the lights go out", 0) end
        end)
      end)
      return s
    end
    local file = os.tmpname()
    os.remove(file)
    local whole = make():run{ dt = 5e-3 }:ledger()
    local fine, why = pcall(function() make(true):run{ dt = 5e-3, save = file } end)
    assert.same({ false, "the lights go out" }, { fine, why })
    t.near(0.2, sw.load(file).time, 1e-12, "time of the file")
    local resumed = make():run{ dt = 5e-3, resume = file }:ledger()
    os.remove(file)
    local compared = 0
    local function same(a, b, path)
      for key, value in pairs(a) do
        local name = path .. key
        if type(value) == "table" then same(value, b[key], name .. ".")
        else
          assert.equal(value, b[key], name)
          compared = compared + 1
        end
      end
    end
    same(whole, resumed, "")
    same(resumed, whole, "")
    assert.is_true(compared >= 40 and whole.lost.friction > 0 and whole.work.holds > 0)
  end)
end)

-- Returns the largest rise of the scene's energy above its lowest value so far, over unit [-], and the run.
local function rise(scene, unit, total, options)
  local lowest, worst = scene:energy().total, 0
  scene:process(function(p)
    p:wait_until(function()
      local e = scene:energy().total
      lowest = math.min(lowest, e)
      worst = math.max(worst, e - lowest)
      return scene.time >= total
    end)
  end)
  local run = scene:run(options)
  return worst / unit, run
end

describe("energy is not made", function()
  it("by a wire dropped on a wall, at any step", function() -- once 0.5 J from 0.04 J
    for _, dt in ipairs{ 1e-3, 2e-4, 1e-4 } do
      local s = sw.scene{}
      s:obstacle{ shape = "plane", friction = 0.3 }
      s:obstacle{ shape = "box", size = { 0.01, 1, 0.1 }, at = { 0.45, 0, 0.05 }, friction = 0.3 }
      wire_of(s, { from = { 0, 0, 0.15 }, to = { 1, 0, 0.15 } })
      local unit = 1500 * math.pi * 0.0025 ^ 2 * 9.80665 * 0.15
      local share, run = rise(s, unit, 0.5, { dt = dt })
      t.below(0.02, share, ("rise at dt = %g"):format(dt))
      t.fine(run)
    end
  end)

  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10", "identified white" } do
    it("by a stiff cable thrown at a wall: " .. cable, function() -- once 0.25 J became 8.5 J
      for _, dt in ipairs{ 1e-2, 2e-3, 5e-4 } do
        local s = sw.scene{ gravity = { 0, 0, 0 } }
        s:obstacle{ shape = "box", size = { 0.01, 1, 1 }, at = { 1.2, 0, 0 } }
        local w = s:wire{ cable = cable, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 50 }
        s:force{ kind = "damping", on = w, stiffness = 0.005 }
        w:set_velocity{ 5, 0, 1 }
        local unit = s:energy().total
        local share, run = rise(s, unit, 0.06, { dt = dt })
        t.below(0.02, share, ("%s: rise at dt = %g"):format(cable, dt))
        local l = run:ledger()
        t.below(0.05, l.gained / l.play, cable .. ": gained")
      end
    end)
  end

  -- The wire weighs 0.29 N; drawn over three walls with friction it needs a few times that. In whole steps
  -- every force stays that small. Parts (substeps) of 1 ms resolve blows of 7 N; with them the mean over 10
  -- ms stays that small.
  it("by laying over walls: forces stay below 8 times the wire's weight", function() -- once 86 to 363 N
    local laying = require "softworld.cases.laying"
    local function largest(c)
      local rows, count = c.clamp:log()
      local peak = 0
      for i = 0, count - 1 do
        peak = math.max(peak, (rows[10 * i + 2] ^ 2 + rows[10 * i + 3] ^ 2 + rows[10 * i + 4] ^ 2) ^ 0.5)
      end
      return peak
    end
    for _, case in ipairs{ { 50, 0.01 }, { 100, 0.02 } } do
      for _, parts in ipairs{ false, true } do
        local c = laying{ segments = case[1] }
        local run = t.fine(c.run{ dt = case[2], parts = parts })
        local what = ("N = %d, dt = %g, parts %s: "):format(case[1], case[2], parts)
        t.below(8 * 0.29, parts and c.wire:max_tension() or largest(c), what .. "largest force")
        local l = run:ledger()
        t.below(0.02, l.gained / l.play, what .. "gained")
        t.below(0.03, l.redone.count / l.steps, what .. "steps redone")
      end
    end
  end)

  it("in smooth turning, nor lost: kinetic energy stays within 2 %", function()
    for _, dt in ipairs{ 0.02, 0.01 } do
      local s = sw.scene{ gravity = { 0, 0, 0 } }
      local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.5, 0, 0 } }
      w:set_velocity({ 0, 0, 0 }, { 0, 0, 8 }, { 0.25, 0, 0 })
      local before = s:energy().kinetic
      t.fine(s:run{ duration = 1, dt = dt })
      t.share(before, s:energy().kinetic, 0.02, ("kinetic energy at dt = %g"):format(dt))
    end
  end)

  it("by a wire that starts inside a table: it is pushed out, not thrown", function()
    local s = sw.scene{}
    s:obstacle{ shape = "plane" }
    local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 1.2e-3 }, to = { 0.3, 0, 1.2e-3 } }
    local highest = 0
    s:process(function(p)
      p:wait_until(function()
        highest = math.max(highest, w:velocity(0.15)[3])
        return s.time > 0.2
      end)
    end)
    t.fine(s:run{ dt = 5e-3 })
    t.below(0.03, highest, "speed [m/s]") -- once 0.48 m/s
    t.near(1.5e-3, w:position(0.15)[3], 5e-5, "height")
  end)

  -- A taut wire springs up and down between its ends. In steps of a twentieth of its period the method's
  -- own error is large. It falls with the cube of the step: where one step makes 5 %, a part (substep) of a
  -- fifteenth makes no more than its share. Parts that allow no gain at all were 7300 for 100 steps, and
  -- made more together.
  it("by a taut wire, at a cost that stays within bounds", function()
    for _, segments in ipairs{ 22, 40 } do
      local s = sw.scene{}
      local w = s:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.49, 0, 0 }, segments = segments }
      s:pin(w, { s = 0 })
      s:clamp(w, { s = 0.49 })
      local run = t.fine(s:run{ duration = 0.5, dt = 5e-3 })
      local l = balanced(run, "taut")
      t.below(0.12, l.gap / l.play, "from nowhere, of what was in play")
      t.below(16 * 100, run.steps, "parts of 100 steps")
    end
  end)

  -- A stiff cable springs open on a floor. Nothing drives it, so all unexplained energy is gain: what the
  -- energy referee lets pass, 1 % and its allowance for one step. The powers at a step's ends give the
  -- losses to damping, friction and blows only to one part in ten; booked side by side for each step, that
  -- was 3 to 17 %.
  it("beyond 2 % by a cable that springs open on a floor, and no loss is negative", function()
    local path = {}
    for i = 0, 40 do
      local a = math.pi * i / 40
      path[#path + 1] = { -0.15 * math.cos(a), 0, 0.12 + 0.15 * math.sin(a) }
    end
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 10" } do
      for _, friction in ipairs{ 0, 0.3 } do
        for _, damping in ipairs{ 0, 1e-3 } do
          for _, dt in ipairs{ 1e-2, 2.5e-3, 6.25e-4 } do
            local s = sw.scene{}
            local w = s:wire{ cable = cable, path = path, segments = 47 }
            if damping > 0 then s:force{ kind = "damping", on = w, mass = 0.3, stiffness = damping } end
            s:obstacle{ shape = "plane", friction = friction }
            local what = ("%s, mu %g, damping %g, dt %g"):format(cable, friction, damping, dt)
            local l = balanced(t.fine(s:run{ duration = 0.8, dt = dt }), what)
            t.below(0.02, l.gap / l.play, what .. ": from nowhere, of what was in play")
            t.above(l.gained * (1 - 1e-9) - 1e-12, l.gap, what .. ": at least what was gained")
            t.above(0, math.min(l.lost.integrator, l.lost.contact), what .. ": no loss below zero")
          end
        end
      end
    end
  end)

  it("unreported: a run that made too much fails", function()
    local s = sw.scene{}
    local w = wire_of(s, { segments = 10 })
    s:clamp(w, { s = 0 })
    local run = s:run{ duration = 0.2, dt = 1.02 * s:stable_dt(), integrator = "velocity-verlet",
      unstable = true }
    assert.is_false(run.ok)
    assert.has_error(function() w:position(1) end)
  end)
end)
