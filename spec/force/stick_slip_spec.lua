-- SPDX-License-Identifier: GPL-3.0-or-later
-- Stick-slip bending: EI while the strands slip, EI_stick while they stick.
local arc = require "force.arc"
local tools = require "physics.tools"

local EI_STICK, M_F = 0.05, 0.01
local KAPPA_F = M_F / (EI_STICK - arc.EI)

local function stranded(options)
  options = options or {}
  options.force = { kind = "stick_slip", EI_stick = EI_STICK, friction_moment = M_F }
  return arc.new(options)
end

-- The piecewise linear law, advanced by its own return mapping.
local function law()
  local slipped = 0
  return function(kappa)
    local friction = (EI_STICK - arc.EI) * (kappa - slipped)
    if math.abs(friction) > M_F then
      friction = friction > 0 and M_F or -M_F
      slipped = kappa - friction / (EI_STICK - arc.EI)
    end
    return arc.EI * kappa + friction
  end
end

describe("stick-slip bending", function()
  it("follows the piecewise linear loop", function()
    for _, N in ipairs{ 4, 11, 30 } do
      local bent, exact = stranded{ N = N }, law()
      local function compare(kappa, moment)
        tools.near(exact(kappa), moment, 1e-10, ("N = %d, kappa = %g"):format(N, kappa))
      end
      for _, kappa in ipairs{ 1, -1, 0.6, 0.5, 0.9, -1, 1 } do bent:sweep(kappa, 8, compare) end
    end
  end)

  it("loses 4 M_f (kappa_max - kappa_f) per length in a cycle", function()
    local bent = stranded()
    bent:sweep(1, 8):sweep(-1, 8)
    local start, area, last = bent.scene:energy(), 0, { -1, bent:moment() }
    local function add(kappa, moment)
      area = area + 0.5 * (moment + last[2]) * (kappa - last[1])
      last = { kappa, moment }
    end
    -- both corners of a branch are among the steps: kappa_f = 1/3
    bent:sweep(1, 6, add):sweep(-1, 6, add)
    local exact = 4 * M_F * (1 - KAPPA_F)
    tools.share(exact, area, 1e-9, "area of the loop")
    local now = bent.scene:energy()
    tools.share(exact * arc.L, now.dissipated - start.dissipated, 1e-9, "work dissipated")
    tools.near(start.total, now.total, 1e-12, "energy stored")
    tools.share(0.5 * M_F * KAPPA_F * arc.L, now.stick_slip, 1e-9, "energy in the strands")
  end)

  it("loses nothing below the friction moment", function()
    local bent = stranded()
    for _, kappa in ipairs{ 0.3, -0.3, 0.3 } do bent:sweep(kappa, 3) end
    assert.are.equal(0, bent.scene:energy().dissipated)
    tools.share(EI_STICK * 0.3, (bent:moment()), 1e-9, "moment")
  end)

  it("acts the same in every plane", function()
    for _, a in ipairs{ 0, 0.7, 2.5, 4 } do
      local bent, exact = stranded(), law()
      bent:sweep(0.9, 3, nil, a):sweep(-0.9, 6, nil, a)
      exact(0.9)
      local my, mz = bent:moment()
      local moment = my * math.sin(a) + mz * math.cos(a)
      tools.near(exact(-0.9), moment, 1e-9, "moment at " .. a)
      tools.near(0, my * math.cos(a) - mz * math.sin(a), 1e-9, "moment across at " .. a)
    end
  end)

  it("takes energy from a swinging wire and leaves it bent", function()
    local bent = stranded()
    bent:sweep(1, 4)
    bent.last:release()
    local start = bent.scene:energy()
    local run = tools.fine(bent.scene:run{ duration = 2, tolerance = 1e-5 })
    assert.is_true(run.steps > 10)
    local now = bent.scene:energy()
    assert.is_true(now.dissipated > start.dissipated)
    tools.below(start.total, now.total + now.dissipated - start.dissipated, "energy with losses")
    assert.is_true(math.abs(bent.wire:position(arc.L)[3]) > 1e-3)
  end)

  it("needs EI_stick above the wire's EI", function()
    for _, wrong in ipairs{ arc.EI, 0.01 } do
      local ok, message = pcall(arc.new,
        { force = { kind = "stick_slip", EI_stick = wrong, friction_moment = 1 } })
      assert.is_false(ok)
      assert.is_truthy(message:find("must be above the wire's EI", 1, true), message)
    end
    for _, args in ipairs{ { EI_stick = 1 }, { friction_moment = 1 },
      { EI_stick = 1, friction_moment = 0 }, { EI_stick = -1, friction_moment = 1 } } do
      args.kind = "stick_slip"
      assert.has_error(function() arc.new{ force = args } end)
    end
  end)

  it("allows for its stiffness in the stable step", function()
    local plain, bent = arc.new{ N = 60 }, stranded{ N = 60 }
    assert.is_true(bent.scene:stable_dt() <= plain.scene:stable_dt())
  end)
end)
