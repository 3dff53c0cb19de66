-- SPDX-License-Identifier: GPL-3.0-or-later
-- Elastic-plastic bending with a yield moment and kinematic hardening.
local arc = require "force.arc"
local sw = require "softworld"
local tools = require "physics.tools"

local M_Y, H = 0.01, 0.005

local function metal(options)
  options = options or {}
  options.force = { kind = "plastic", yield_moment = M_Y, hardening = options.hardening or H }
  return arc.new(options)
end

-- The law of one hinge in a plane: returns the moment and the plastic curvature at each curvature.
local function law()
  local p = 0
  return function(kappa)
    local xi = arc.EI * kappa - (arc.EI + H) * p
    if math.abs(xi) > M_Y then p = p + (xi - (xi > 0 and M_Y or -M_Y)) / (arc.EI + H) end
    return arc.EI * (kappa - p), p
  end
end

-- A cantilever of 1 m along x with a force across at its end; tiny deflections.
local function loaded(N, force, hardening)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e6, EI = 100, mass_per_length = 0.05, radius = 0.002,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = N }
  scene:clamp(wire, { s = 0 })
  scene:force{ kind = "plastic", on = wire, yield_moment = 0.05, hardening = hardening }
  local pull = scene:force{ kind = "point", on = wire, s = 1, force = force }
  tools.fine(scene:settle{ tolerance = 1e-13 })
  return scene, wire, pull
end

describe("plastic bending", function()
  it("follows the piecewise linear loop", function()
    for _, N in ipairs{ 4, 11, 16 } do
      local bent, exact = metal{ N = N }, law()
      local function compare(kappa, moment)
        tools.near(exact(kappa), moment, 1e-10, ("N = %d, kappa = %g"):format(N, kappa))
      end
      for _, kappa in ipairs{ 2, -2, 1.5, 1.2, 2, -2 } do bent:sweep(kappa, 20, compare) end
    end
  end)

  it("dissipates what its loop encloses and stores what hardening takes", function()
    local bent, exact, p = metal(), law(), nil
    bent:sweep(2, 8):sweep(-2, 16)
    local start = bent.scene:energy()
    bent:sweep(2, 16):sweep(-2, 16)
    local now = bent.scene:energy()
    for _, kappa in ipairs{ 2, -2 } do p = select(2, exact(kappa)) end
    local swing = 2 * math.abs(p) -- of the plastic curvature, in half a cycle
    tools.share(2 * M_Y * swing * arc.L, now.dissipated - start.dissipated, 1e-9, "dissipated")
    tools.share(0.5 * H * p ^ 2 * arc.L, now.plastic, 1e-9, "stored by hardening")
    tools.share(0.5 * arc.EI * (2 - math.abs(p)) ^ 2 * arc.L, now.bend, 1e-9, "stored by bending")
  end)

  it("leaves an elastic wire alone", function()
    local plain, bent = arc.new{}, metal()
    for _, kappa in ipairs{ 0.3, -0.45, 0.2 } do
      plain:sweep(kappa, 3)
      bent:sweep(kappa, 3)
      tools.near(0, tools.largest_difference(plain.wire:positions(), bent.wire:positions()),
        1e-12, "shape")
    end
    assert.are.equal(0, bent.scene:energy().dissipated)
  end)

  -- The wire is laid round a mandrel of radius 1/kappa and let go. It keeps the curvature (EI kappa - M_y)
  -- / (EI + H), but H times that curvature, which hardening holds back, can be no more than M_y. A free end
  -- has no hinge in its last half edge.
  it("springs back to the permanent curvature", function()
    for _, hardening in ipairs{ 0.002, H, 0.05 } do
      local bent = metal{ hardening = hardening }
      bent:sweep(3, 12)
      bent.last:release()
      tools.fine(bent.scene:settle{ tolerance = 1e-12 })
      local kept = math.min((arc.EI * 3 - M_Y) / (arc.EI + hardening), M_Y / hardening)
      tools.share(kept, bent.wire:curvature(arc.L / 2), 1e-8, "curvature")
      local x = bent.wire:positions()
      local n = #x
      local angle = math.atan(x[n] - x[n - 3], x[n - 2] - x[n - 5])
      tools.share(kept * (arc.L - 0.5 * arc.L / bent.N), angle, 1e-8, "angle of the last edge")
    end
  end)

  -- M = F (1 - x). Beyond M_y the plastic curvature is (M - M_y) / H; the end keeps the integral of it
  -- times (1 - x).
  it("keeps the deflection of a loaded end, second order in N", function()
    local F, hardening = 0.08, 50
    local a = 1 - 0.05 / F -- how far the wire yields
    local exact = (F / hardening) * (a - a ^ 2 + a ^ 3 / 3) - 0.05 / hardening * (a - a ^ 2 / 2)
    -- the wire yields up to a node, so meshes differ only in their size
    tools.order_at_least(1.9, { 8, 16, 32, 64 }, function(N)
      local scene, wire, pull = loaded(N, { 0, 0, F }, hardening)
      pull:release()
      tools.fine(scene:settle{ tolerance = 1e-13 })
      return math.abs(wire:position(1)[3] / exact - 1)
    end, "kept deflection")
  end)

  it("yields in both planes together", function()
    -- small angles keep the planes apart; the return is radial in them
    local bent = metal{}
    bent.force:release()
    local small, hard = 0.01, 1e-4
    bent.force = bent.scene:force{ kind = "plastic", on = bent.wire, yield_moment = 1e-4, hardening = hard }
    bent:sweep(small, 5)
    local k = arc.EI
    local p = { (k * small - 1e-4) / (k + hard), 0 }
    local path = { { small, 0.5 }, { small, 0.9 }, { small, 1.2 } } -- angle from plane z to y
    for _, step in ipairs(path) do
      bent:bend(step[1], math.pi / 2 - step[2])
      local kappa = { step[1] * math.cos(step[2]), step[1] * math.sin(step[2]) }
      local xi = { k * kappa[1] - (k + hard) * p[1], k * kappa[2] - (k + hard) * p[2] }
      local size = (xi[1] ^ 2 + xi[2] ^ 2) ^ 0.5
      assert.is_true(size > 1e-4)
      for c = 1, 2 do p[c] = p[c] + (size - 1e-4) / (k + hard) * xi[c] / size end
      local mz, my = bent:moment()
      tools.near(k * (kappa[1] - p[1]), mz, 1e-8, "moment in the first plane")
      tools.near(k * (kappa[2] - p[2]), my, 1e-8, "moment in the second plane")
    end
  end)

  it("does not depend on where the axes point", function()
    local function bent(turn)
      local scene, wire, pull = loaded(12, turn{ 0.01, 0.06, 0.08 }, 20)
      pull:release()
      scene:force{ kind = "point", on = wire, s = 1, force = turn{ 0, -0.09, 0.03 } }
      tools.fine(scene:settle{ tolerance = 1e-13 })
      return wire:position(1), scene:energy().dissipated
    end
    local here, lost = bent(function(v) return v end)
    for _, angle in ipairs{ 0.4, 1.9, 3 } do
      local c, s = math.cos(angle), math.sin(angle)
      local function turn(v) return { v[1], c * v[2] - s * v[3], s * v[2] + c * v[3] } end
      local there, also = bent(turn)
      tools.near(0, tools.distance(turn(here), there), 1e-12, "end")
      tools.share(lost, also, 1e-8, "work")
    end
  end)

  it("refuses wrong arguments", function()
    for _, args in ipairs{ {}, { yield_moment = 0 }, { yield_moment = -1 }, { yield_moment = "x" },
      { yield_moment = 1, hardening = -1 }, { yield_moment = 1, hardning = 1 } } do
      args.kind = "plastic"
      assert.has_error(function() arc.new{ force = args } end)
    end
    local scene = sw.scene{}
    scene:wire{ model = "string", EA = 1, EI = 1, mass_per_length = 1, radius = 0.1,
      from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local ok, message = pcall(scene.force, scene, { kind = "plastic", yield_moment = 1 })
    assert.is_false(ok)
    assert.is_truthy(message:find("is a string", 1, true), message)
  end)
end)
