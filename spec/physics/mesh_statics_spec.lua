-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that are meshes of particles at rest, compared with the beam that they are calibrated to. Wires are
-- short and thick (length over diameter 25), with the number of slices that the models choose.
package.path = "./?.lua;" .. package.path
local meshes = require "spec.physics.meshes"
local t = require "spec.physics.tools"

local L, R = meshes.length, meshes.radius

-- Tolerance of lengths, forces and moments [-]. A thick wire differs from its beam: at a clamp sections
-- keep their shape, which the elements there compensate to 0.2 %; and strains of R/bend radius, up to 7 %
-- here, meet springs and elements that are not quite linear.
local BEAM = 5e-3

-- Elliptic integrals (Bisshopp and Drucker 1945): P L^2/EI, tip x/L, tip z/L, moment L/EI.
local end_loads = { { 1, 0.9435667637, -0.3017207738, 0.9435667637 },
  { 4, 0.6710587578, -0.6699641813, 2.684235031 } }
-- Heavy elastica by shooting: gamma, tip x/L, tip z/L, moment L/EI.
local droops = { { 1, 0.9912463953, -0.123471402, 0.4969333999 },
  { 10, 0.6563537612, -0.7001997155, 3.742191111 } }

local function off(wire, row, length)
  local p = wire:position(wire.length)
  return t.distance({ p[1] / length, p[2] / length, p[3] / length }, { row[2], 0, row[3] })
end

-- Gravity that makes gamma = m g L^3/EI.
local function gravity_of(wire, gamma)
  local b = wire.beam
  return gamma * b.EI / (b.mass_per_length * wire.length ^ 3)
end

local function drooped(model, gamma, changes)
  local scene, wire = meshes.scene(model, changes)
  scene:gravity{ 0, 0, -gravity_of(wire, gamma) }
  local clamp = scene:clamp(wire, { s = 0 })
  t.fine(scene:settle())
  return wire, clamp, scene
end

-- Returns curvature times L at arc length s of a rod that droops in the same way.
local rods = {}
local function rod_moment(gamma, s)
  rods[gamma] = rods[gamma] or drooped({ "rod", { model = "rod", segments = 200 } }, gamma)
  return rods[gamma]:curvature(s) * L
end

describe("a cantilever that is a mesh:", function()
  for _, model in ipairs(meshes.all) do
    describe(model[1], function()
      it("bends under a load at its end", function()
        local scene, wire = meshes.scene(model)
        local clamp, EI = scene:clamp(wire, { s = 0 }), wire.beam.EI
        for _, row in ipairs(end_loads) do
          local P = row[1] * EI / L ^ 2
          local force = scene:force{ kind = "point", on = wire, s = L, force = { 0, 0, -P } }
          t.fine(scene:settle())
          t.below(BEAM, off(wire, row, L), "tip error")
          t.share(row[4] * EI / L, -clamp:moment()[2], BEAM, "clamp moment")
          -- forces are read from the last linear solve
          t.near(P, clamp:force()[3], 1e-9 * P, "clamp force")
          t.share(P * wire:position(L)[1], -clamp:moment()[2], 1e-6, "moment of the load")
          force:release()
        end
      end)

      it("droops under its own weight", function()
        for _, row in ipairs(droops) do
          local wire, clamp = drooped(model, row[1])
          t.below(BEAM, off(wire, row, L), "tip error")
          local weight = wire.beam.mass_per_length * L * gravity_of(wire, row[1])
          t.near(weight, clamp:force()[3], 1e-9 * weight, "weight on the clamp")
          t.share(row[4] * wire.beam.EI / L, -clamp:moment()[2], BEAM, "clamp moment")
          -- away from the clamp a section's curvature is the moment over EI; at large strains sections are
          -- up to 5 % softer or stiffer, which shows by a hundredth here at most
          local moment = rod_moment(row[1], 0.2 * L)
          t.share(moment, wire:curvature(0.2 * L) * L, 0.01, "curvature times L")
        end
      end)

      it("is twisted and pulled between two clamps", function()
        local scene, wire = meshes.scene(model)
        local a, b, beam = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = L }), wire.beam
        for _, angle in ipairs{ 0.1, -0.02 } do
          b:pose({ L, 0, 0 }, { axis = { 1, 0, 0 }, angle = angle })
          t.fine(scene:settle())
          local torque = beam.GJ * angle / L
          t.share(torque, b:moment()[1], BEAM, "torque")
          t.share(b:moment()[1], -a:moment()[1], 1e-6, "torque at the other end")
          t.share(b:moment()[1], wire:twist_moment(L / 2), 1e-6, "torque in the middle")
        end
        for _, strain in ipairs{ 1e-3, -1e-3 } do
          b:pose({ L * (1 + strain), 0, 0 }, { axis = { 1, 0, 0 }, angle = 0 })
          t.fine(scene:settle())
          t.share(beam.EA * strain, b:force()[1], BEAM, "pull")
          t.share(b:force()[1], wire:tension(L / 2), 1e-6, "tension in the middle")
        end
      end)

      it("droops the same at half the spacing", function()
        local row = droops[2]
        local first = drooped(model, row[1])
        local wire = drooped(model, row[1], { segments = 2 * first.segments })
        assert.equal(2 * first.segments, wire.segments)
        t.below(BEAM, off(wire, row, L), "tip error")
      end)
    end)
  end

  it("is within 0.5 % of its beam at a length of 20 diameters, with default meshes", function()
    local l = 40 * R
    local solids = {}
    for _, nu in ipairs{ 0, 0.2, 0.45, 0.49 } do
      solids[#solids + 1] = { "radial solid, nu " .. nu, { model = "radial", body = "solid", nu = nu } }
      solids[#solids + 1] = { "cubic solid, nu " .. nu, { model = "cubic", body = "solid", nu = nu } }
    end
    table.move(meshes.all, 1, #meshes.all, #solids + 1, solids)
    for _, model in ipairs(solids) do
      local scene, wire = meshes.scene(model, { to = { l, 0, 0 } })
      scene:clamp(wire, { s = 0 })
      local b, beam = scene:clamp(wire, { s = l }), wire.beam
      b:pose({ l, 0, 0 }, { axis = { 1, 0, 0 }, angle = 0.02 })
      t.fine(scene:settle())
      t.share(beam.GJ * 0.02 / l, b:moment()[1], BEAM, "torque of " .. model[1])
      b:pose({ l * (1 + 1e-4), 0, 0 }, { axis = { 1, 0, 0 }, angle = 0 })
      t.fine(scene:settle())
      t.share(beam.EA * 1e-4, b:force()[1], BEAM, "pull of " .. model[1])
      b:release()
      scene:force{ kind = "point", on = wire, s = l, force = { 0, 0, -0.05 * beam.EI / l ^ 2 } }
      t.fine(scene:settle())
      -- P l^3/(3 EI); a large deflection is less by 9e-5 of it (0.036 P^2)
      t.share(0.05 / 3 * l, -wire:position(l)[3], BEAM, "tip of " .. model[1])
    end
  end)

  it("depends on gamma only, over four decades of stiffness", function()
    for _, model in ipairs(meshes.few) do
      local usual = drooped(model, 10):position(L)
      for _, E in ipairs{ 1e5, 1e7, 1e9 } do
        local wire = drooped(model, 10, { E = E })
        -- errors: calibration to 1e-9, and settling, which ends with shifts of 1e-9 m
        t.below(1e-7 * L, t.distance(usual, wire:position(L)), ("tip moved, E = %g"):format(E))
      end
    end
  end)

  it("bends the same in every direction in space", function()
    local random = t.random(4)
    for _, model in ipairs(meshes.few) do
      for _ = 1, 3 do
        local d, n = { random(), random(), random() }, { random(), random(), random() }
        local size = t.norm(d)
        for k = 1, 3 do d[k] = d[k] / size end
        local across = t.cross(d, n)
        local side = t.norm(across)
        for k = 1, 3 do across[k] = across[k] / side end
        local at = { random(), random(), random() }
        local scene, wire = meshes.scene(model, { from = at, to = { at[1] + L * d[1], at[2] + L * d[2],
          at[3] + L * d[3] } })
        local g = gravity_of(wire, 10)
        scene:gravity{ g * across[1], g * across[2], g * across[3] }
        scene:clamp(wire, { s = 0 })
        t.fine(scene:settle())
        local p, along, down = wire:position(wire.length), 0, 0
        for k = 1, 3 do
          along, down = along + (p[k] - at[k]) * d[k], down + (p[k] - at[k]) * across[k]
        end
        -- the section stands at any turn about the axis; sections of four or eight sides bend the same
        -- about all axes, except for the clamp and large strains
        t.below(BEAM, ((along / L - droops[2][2]) ^ 2 + (down / L + droops[2][3]) ^ 2) ^ 0.5, model[1])
      end
    end
  end)

  it("does not depend on where it is, with the section turned along", function()
    local random = t.random(9)
    for _, model in ipairs(meshes.few) do
      local function tip(q, at)
        local function turn(v)
          local u = { q[2], q[3], q[4] }
          local c = t.cross(u, v)
          local d = t.cross(u, { c[1] + q[1] * v[1], c[2] + q[1] * v[2], c[3] + q[1] * v[3] })
          return { v[1] + 2 * d[1], v[2] + 2 * d[2], v[3] + 2 * d[3] }
        end
        local x = turn{ L, 0, 0 }
        local scene, wire = meshes.scene(model, { from = at, normal = turn{ 0, 1, 0 },
          to = { at[1] + x[1], at[2] + x[2], at[3] + x[3] } })
        scene:gravity(turn{ 0, 0, -gravity_of(wire, 5) })
        scene:clamp(wire, { s = 0 })
        t.fine(scene:settle())
        local p = wire:position(L)
        local back = { q[1], -q[2], -q[3], -q[4] }
        q = back
        return turn{ p[1] - at[1], p[2] - at[2], p[3] - at[3] }
      end
      local usual = tip({ 1, 0, 0, 0 }, { 0, 0, 0 })
      for _ = 1, 2 do
        -- rounding of coordinates of a metre over slices of some millimetres
        t.below(1e-8, t.distance(usual, tip(t.turn(random), { random(), random(), random() })), model[1])
      end
    end
  end)
end)

describe("a flat mesh", function()
  it("has its two bending stiffnesses where normal says", function()
    local w, h, E = 0.024, 0.012, 1e7
    local EI1, EI2 = E * h * w ^ 3 / 12, E * w * h ^ 3 / 12
    for _, body in ipairs{ "springs", "solid" } do
      local p = { model = "cubic", section = "rectangle", width = w, height = h, across = 6, body = body,
        EA = E * w * h, EI = { EI1, EI2 }, GJ = 0.2287 * E / 2.7 * w * h ^ 3, mass_per_length = 0.3,
        radius = 0.0134, normal = { 0, 1, 0 }, nu = body == "solid" and 0.35 or nil }
      local scene, wire = meshes.scene({ "", {} }, p)
      scene:clamp(wire, { s = 0 })
      for k, EI in ipairs{ EI1, EI2 } do
        local P = 0.1 * EI / L ^ 2
        local force = scene:force{ kind = "point", on = wire, s = L, force = { 0, k == 1 and P or 0,
          k == 2 and P or 0 } }
        t.fine(scene:settle())
        -- P L^3/(3 EI); the bound covers large deflection, shear of w^2/L^2 and the clamp
        t.share(0.1 / 3 * L, wire:position(L)[k + 1], 0.01, ("EI%d of %s"):format(k, body))
        t.near(0, wire:position(L)[4 - k], 1e-4 * L, "across")
        force:release()
      end
    end
  end)
end)

-- Energy that rounding makes: coordinates of a metre in springs (1e-16 m squared, times EA over a slice),
-- and the terms of each element's energy, which have the size of E V times the strain's rounding.
local function nothing(wire)
  return 1e-16 * wire.beam.EA * wire.length
end

describe("a mesh without load", function()
  local R1 = L / 2
  local arc = {}
  for i = 0, 200 do
    local a = i / 200 * L / R1
    arc[i + 1] = { R1 * math.sin(a), 0, R1 * (1 - math.cos(a)) }
  end

  for _, model in ipairs(meshes.few) do
    it("keeps the shape it is drawn in, as " .. model[1], function()
      if model[2].core == "line" then
        -- three particles in a row do not define a direction of bending
        local ok, message = pcall(meshes.scene, model, { path = arc, rest = "path" })
        assert.is_false(ok)
        assert.truthy(message:find("core = 'radial' or 'cubic'", 1, true), message)
        return
      end
      local scene, wire = meshes.scene(model, { path = arc, rest = "path" })
      local x = wire:particles()
      local bent = wire.beam.EI / R1 ^ 2 * L / 2 -- energy of a straight one bent to it
      t.below(1e-12 * bent, math.abs(scene:energy().total), "energy")
      t.fine(scene:run{ duration = 0.02, dt = 0.01 })
      t.below(1e-12, t.largest_difference(x, (wire:particles())), "particles moved")
      scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      t.below(1e-9, t.largest_difference(x, (wire:particles())), "particles moved")
    end)

    it("unwinds to the twist it has at rest, as " .. model[1], function()
      local scene, wire = meshes.scene(model, { rest_twist = 2 })
      scene:clamp(wire, { s = 0 })
      local drawn = scene:energy().total
      -- sections are as drawn; those of voxels warp only when they may
      t.share(wire.beam.GJ * 4 * L / 2, drawn, 0.1, "energy as drawn")
      t.fine(scene:settle())
      t.below(1e-12 * drawn, math.abs(scene:energy().total), "energy")
      t.near(0, wire:twist_moment(L / 2), 1e-6 * wire.beam.GJ * 2, "torque")
      local scene2, held = meshes.scene(model, { rest_twist = 2 })
      local clamp = scene2:clamp(held, { s = 0 })
      scene2:clamp(held, { s = L })
      t.fine(scene2:settle())
      t.share(-held.beam.GJ * 2, held:twist_moment(L / 2), BEAM, "torque, held")
      t.share(held:twist_moment(L / 2), -clamp:moment()[1], 1e-6, "torque of the clamp")
    end)
  end

  it("has no energy if it is drawn straight in any direction", function()
    local random = t.random(2)
    for _, model in ipairs(meshes.few) do
      local at = { random(), random(), random() }
      local scene, wire = meshes.scene(model, { from = at,
        to = { at[1] + 0.3 * random(), at[2] + 0.4, at[3] + 0.2 * random() } })
      t.below(nothing(wire), math.abs(scene:energy().total), model[1])
    end
  end)

  it("has no energy, tension or curvature after the whole is turned", function()
    for _, model in ipairs(meshes.few) do
      local scene, wire = meshes.scene(model)
      local grip = scene:grip(wire, { s = L / 2, width = L })
      grip:pose({ 0.3, -0.2, 0.1 }, { axis = { 1, 2, -0.5 }, angle = 2.2 })
      t.fine(scene:settle())
      t.below(nothing(wire), math.abs(scene:energy().total), "energy of " .. model[1])
      t.near(0, wire:tension(L / 3), 1e-10 * wire.beam.EA, "tension of " .. model[1])
      t.near(0, wire:curvature(L / 3), 1e-6 / R, "curvature of " .. model[1])
    end
  end)
end)

describe("a mesh between clamps", function()
  it("is bent to a quarter circle by them, with the moment EI/radius", function()
    for _, model in ipairs{ meshes.all[1], meshes.all[4] } do
      local scene, wire = meshes.scene(model)
      local a, b = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = L })
      local r = L / (math.pi / 2)
      for k = 1, 2 do
        local phi, rho = math.pi / 4 * k, L / (math.pi / 4 * k)
        b:pose({ rho * math.sin(phi), 0, rho * (1 - math.cos(phi)) }, { axis = { 0, -1, 0 }, angle = phi })
        t.fine(scene:settle())
      end
      -- the strain outside is R/r = 3 %, and the clamps keep sections round: measured 1.4 % for the solid
      t.share(wire.beam.EI / r, t.norm(b:moment()), 0.02, "moment of " .. model[1])
      t.share(1 / r, wire:curvature(L / 2), 0.01, "curvature of " .. model[1])
      -- the stiffer ends keep the wire from being a circle: 5.4 % of EI/r^2 for the solid
      t.near(0, t.norm(a:force()), 0.08 * wire.beam.EI / r ^ 2, "force of " .. model[1])
    end
  end)
end)
