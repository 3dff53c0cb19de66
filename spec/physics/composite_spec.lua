-- SPDX-License-Identifier: GPL-3.0-or-later
-- Composites whose parts slide on each other: bending is compared with beams of the parts, friction along
-- the wire with Coulomb's law; also energy, momentum and snapshots.
local sw = require "softworld"
local tools = require "physics.tools"
local near, share, below, above, fine = tools.near, tools.share, tools.below, tools.above, tools.fine

local R, LENGTH, MASS = 0.005, 0.1, 0.1
local EA = 1e8 * math.pi * R ^ 2
local EI = EA * R ^ 2 / 4
local FRICTION = 0.3

local function make(more, gravity)
  local scene = sw.scene { gravity = gravity or { 0, 0, 0 } }
  local args = { model = "composite", EA = EA, EI = EI, GJ = EI / 1.35, radius = R,
    mass_per_length = MASS, from = { 0, 0, 0 }, to = { LENGTH, 0, 0 }, bonded = false, core = "line" }
  for key, value in pairs(more or {}) do args[key] = value end
  return scene, scene:wire(args)
end

-- A cantilever. load(F) finds the equilibrium under a force at its end and returns the deflection.
local function cantilever(more)
  local scene, wire = make(more)
  local length, force = wire.length
  scene:clamp(wire, { s = 0 })
  return function(F)
    if force then force:release() end
    force = scene:force { kind = "point", on = wire, s = length, force = { 0, 0, F } }
    fine(scene:settle())
    return wire:position(length)[3]
  end, scene, wire, function() force:release() end
end

local function stiffness(more)
  local load, _, wire = cantilever(more)
  local F = 1e-3 -- droops by less than 1e-3 of the length
  return F * wire.length ^ 3 / 3 / load(F)
end

-- Returns EI of the parts by themselves, and of a section that stays plane. It bends towards the lattice's
-- y or, by symmetry of three and more cores, in any direction.
local function parts(wire)
  local c = wire:calibration()
  local slide, stick = c.shell.EI, c.shell.EI
  for _, p in ipairs(c.centres) do
    slide = slide + c.core.EI
    stick = stick + c.core.EI + c.core.EA * (p[1] ^ 2 + p[2] ^ 2) / 2
  end
  return slide, stick
end

-- Returns the numbers of the shell's particles, and those of a core that is a line.
local function members(wire, ring)
  local n, shell, core = ring + 1, {}, {}
  for r = 0, wire.segments do
    for i = 1, ring do shell[#shell + 1] = n * r + i end
    core[#core + 1] = n * r + n
  end
  return shell, core
end

local function mean(list, numbers, k)
  local sum = 0
  for _, p in ipairs(numbers) do sum = sum + list[3 * p - 3 + k] end
  return sum / #numbers
end

describe("a composite whose parts slide", function()
  -- A clamp holds a whole section; near it and near the free end sections differ from those of an endless
  -- wire. In a length of 20 diameters these zones are a percent.
  it("bends as its parts do, without friction", function()
    for _, more in ipairs { {}, { core = "radial" }, { cores = 3 }, { cores = 3, core = "radial" },
      { cores = 7 } } do
      more.to = { 0.2, 0, 0 }
      local _, wire = make(more)
      local slide = parts(wire)
      share(slide, stiffness(more), 0.01, (more.cores or 1) .. " " .. (more.core or "line"))
    end
  end)

  -- Sticking parts hand on their force within three slices, so sections near the ends do not stay plane,
  -- and shear of what holds the cores adds to the deflection: 6 % at 10 to 20 diameters.
  it("bends as one section while it sticks", function()
    for _, cores in ipairs { 3, 7 } do
      local more = { cores = cores, friction = FRICTION, grip = 1e4, to = { 0.2, 0, 0 } }
      local _, wire = make(more)
      local slide, stick = parts(wire)
      above(1.1 * slide, stick, "EI of the whole") -- there is something to tell apart
      share(stick, stiffness(more), 0.06, cores .. " cores")
    end
  end)

  -- Once round the loop, the work of the load is what was dissipated. Trapezoids over 20 loads each way
  -- miss a few thousandths of the loop; pressure lags by one load.
  it("dissipates the area of its loop", function()
    local load, scene, wire = cantilever { cores = 3, friction = FRICTION, grip = 1 }
    local slide, stick = parts(wire)
    local F, at, work, most = 0, 0, 0, 0.2
    local function go(to, steps)
      local from = F
      for i = 1, steps do
        local next = from + (to - from) * i / steps
        local z = load(next)
        work = work + 0.5 * (F + next) * (z - at)
        F, at = next, z
      end
    end
    go(most, 20)
    local top = at
    go(-most, 40)
    local before = scene:energy().dissipated
    work = 0
    go(most, 40)
    go(-most, 40)
    local lost = scene:energy().dissipated - before
    share(work, lost, 0.02, "dissipated")
    -- the loop has an area: some percent of all that is stored at its end
    above(0.01 * most * top, lost, "dissipated")
    -- between sliding and sticking
    local L = wire.length
    above(slide, most / top * L ^ 3 / 3, "EI at the end")
    below(stick, most / top * L ^ 3 / 3, "EI at the end")
  end)

  -- Both ends of the core are pinned and the shell is pushed along. It stays below friction * grip *
  -- length; above, it is accelerated by the rest. Friction spread over the core stretches it and makes
  -- waves, by a few percent of what has slid.
  it("slides at friction times grip times length", function()
    local grip, T = 50, 1e-3
    local most = FRICTION * grip * LENGTH
    local function pushed(by)
      local scene, wire = make { friction = FRICTION, grip = grip, particles = 12 }
      local shell, core = members(wire, 12)
      scene:pin(wire, { s = 0 })
      scene:pin(wire, { s = LENGTH })
      scene:force { kind = "push", on = wire, particles = shell, force = { by * most, 0, 0 } }
      local before = wire:particles()
      fine(scene:run { duration = T, dt = 2e-5 })
      local x = wire:particles()
      local moved = mean(x, shell, 1) - mean(before, shell, 1) - mean(x, core, 1) + mean(before, core, 1)
      local c = wire:calibration()
      local mass = 0
      for i = 1, 12 do mass = mass + c.shares[i] * MASS * LENGTH end
      return moved, mass, scene:energy().dissipated
    end
    local stays = pushed(0.5)
    for _, by in ipairs { 2, 4 } do
      local moved, mass, lost = pushed(by)
      share((by - 1) * most * T ^ 2 / 2 / mass, moved, 0.05, "way of the shell")
      share(most * moved, lost, 0.05, "dissipated")
      below(0.03 * moved, math.abs(stays), "what sticks")
    end
  end)

  -- Line forces on opposite sides, all along. Across the wire, sliding parts are held as stiffly as by
  -- bonds within a slice, but bonds are inclined too.
  it("resists squeezing as a bonded one does", function()
    for _, core in ipairs { "line", "radial" } do
      local function stiffness_across(bonded)
        local scene, wire = make { core = core, bonded = bonded, particles = 12 }
        local n, middle = #wire:calibration().shares, wire.segments // 2
        local sides = { {}, {} }
        for r = 0, wire.segments do
          sides[1][r + 1], sides[2][r + 1] = n * r + 1, n * r + 7
        end
        local function apart()
          local x, d = wire:particles(), {}
          for k = 1, 3 do
            d[k] = x[3 * sides[1][middle] - 3 + k] - x[3 * sides[2][middle] - 3 + k]
          end
          return tools.norm(d), d
        end
        local before, d = apart()
        scene:clamp(wire, { s = 0 })
        for side, sign in ipairs { -1 / before, 1 / before } do
          scene:force { kind = "push", on = wire, particles = sides[side],
            force = { sign * d[1], sign * d[2], sign * d[3] } }
        end
        fine(scene:settle())
        return 1 / (before - apart())
      end
      share(stiffness_across(true), stiffness_across(false), 0.25, core)
    end
  end)

  it("is at rest without dissipation", function()
    for _, cores in ipairs { 1, 3 } do
      local scene, wire = make { cores = cores, friction = FRICTION, grip = 5 }
      scene:clamp(wire, { s = 0 })
      local before = wire:particles()
      fine(scene:run { duration = 0.01, dt = 1e-3 })
      near(0, scene:energy().dissipated, 1e-20) -- rounding
      local after = wire:particles()
      for i = 1, #before do near(before[i], after[i], 1e-12, "place") end
    end
  end)

  -- Free flight after a blow that bends and slides: forces between parts are inner ones.
  -- spec/contract/forces_spec.lua checks that they have no moment either.
  it("keeps momentum", function()
    local scene, wire = make { cores = 3, friction = FRICTION, grip = 2 }
    local force = scene:force { kind = "point", on = wire, s = 0.08, force = { 1, 0, 3 } }
    fine(scene:run { duration = 2e-3, dt = 1e-4 })
    force:release()
    local function momentum()
      local v, p, n = wire:velocities(), { 0, 0, 0 }, wire.segments
      for r = 0, n do
        local m = MASS * LENGTH / n * ((r == 0 or r == n) and 0.5 or 1)
        for k = 1, 3 do p[k] = p[k] + m * v[3 * r + k] end
      end
      return p
    end
    local before = momentum()
    fine(scene:run { duration = 5e-3, dt = 1e-4, integrator = "implicit-midpoint" })
    local after = momentum()
    above(1e-9, scene:energy().dissipated, "dissipated")
    for k = 1, 3 do -- tolerance of the iterations
      near(before[k], after[k], 1e-9 * tools.norm(before), "momentum")
    end
  end)

  -- The method has no damping of its own, so friction takes all the energy. A part of second order in the
  -- step is in neither sum: the friction of a step acts at its middle.
  it("loses in free vibration what friction dissipates", function()
    local load, scene, _, release = cantilever { cores = 3, friction = FRICTION, grip = 10 }
    load(0.5)
    release()
    local before, last = scene:energy(), nil
    for _ = 1, 10 do
      fine(scene:run { duration = 2e-3, dt = 1e-4, integrator = "implicit-midpoint" })
      local e = scene:energy()
      local lost = e.dissipated - before.dissipated
      if last then
        below(last.total * (1 + 1e-3), e.total, "energy")
        above(last.dissipated, e.dissipated, "dissipated")
      end
      near(before.total, e.total + lost, 0.02 * before.total, "sum")
      last = e
    end
    above(0.05 * before.total, last.dissipated - before.dissipated, "dissipated")
  end)

  it("goes on to the same bits from a snapshot", function()
    local load, scene, wire = cantilever { cores = 3, friction = FRICTION, grip = 1 }
    load(0.1)
    local before = scene:snapshot()
    local function go()
      fine(scene:run { duration = 2e-3, dt = 1e-4 })
      scene:clamp(wire, { s = LENGTH, name = "end" }) -- another system: what has slid goes over
      fine(scene:run { duration = 1e-3, dt = 1e-4 })
      return wire:particles(), scene:energy().dissipated
    end
    local x, lost = go()
    above(1e-12, lost, "dissipated")
    scene:restore(before)
    local y, again = go()
    assert.are.same(x, y)
    assert.are.equal(lost, again)
  end)

  it("keeps what has slid when the scene changes", function()
    local load, scene, wire = cantilever { cores = 3, friction = FRICTION, grip = 1 }
    load(0.2)
    for _ = 1, 8 do load(0) end -- until the pressure, which lags, has followed
    local bent, lost = wire:position(LENGTH)[3], scene:energy().dissipated
    above(1e-6, bent, "what friction keeps bent")
    scene:obstacle { shape = "plane", at = { 0, 0, -1 } }
    assert.are.equal(lost, scene:energy().dissipated)
    fine(scene:settle())
    near(bent, wire:position(LENGTH)[3], 1e-4 * bent)
  end)

  it("refuses parameters that do not go together", function()
    local function refused(more, ...)
      local ok, text = pcall(make, more)
      assert.is_false(ok)
      for _, part in ipairs { ... } do
        assert.is_truthy(tostring(text):find(part, 1, true), tostring(text))
      end
    end
    refused({ friction = -0.1 }, "friction = -0.1", "[0, 100]")
    refused({ friction = FRICTION, grip = -1 }, "grip = -1", "N/m")
    refused({ friction = FRICTION, grip = 0 / 0 }, "grip")
    refused({ bonded = true, friction = FRICTION }, "friction = 0.3 goes with bonded = false")
    refused({ bonded = true, grip = 10 }, "grip = 10 N/m goes with bonded = false")
    refused({ bond = 2 }, "bond = 2 goes with bonded = true")
    refused({ model = "tube", core = true }, "bonded")
  end)
end)
