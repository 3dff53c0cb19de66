-- SPDX-License-Identifier: GPL-3.0-or-later
-- The bend of wires at a rigid joint: that of the joint's moment, in all read-outs.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "physics.tools"

local EI, RADIUS, LONG = 1e-3, 1e-3, 0.1

local function wire(scene, name, from, to, n, more)
  local args = { name = name, EA = 1e5, EI = EI, GJ = 1e-3, mass_per_length = 0.02, radius = RADIUS,
    from = from, to = to, segments = n }
  for k, v in pairs(more or {}) do args[k] = v end
  return scene:wire(args)
end

local function turned(v, way)
  if way == "turned" then return { v[3], v[1], v[2] } end -- x, y, z become y, z, x
  return v
end

-- Two wires in a line, clamped at the start of the first, with a force at the end of the second. Returns
-- scene, wires, joint and the places of the joint on both.
local function halves(n, way, force, more, rigid)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local function at(x) return turned({ x, 0, 0 }, way) end
  local back = way == "swapped"
  local a = wire(scene, "a", at(back and LONG or 0), at(back and 0 or LONG), n, more)
  local b = wire(scene, "b", at(back and 2 * LONG or LONG), at(back and LONG or 2 * LONG), n, more)
  local sa, sb = back and 0 or a.length, back and b.length or 0
  local joint = scene:join{ ends = { { a, s = sa }, { b, s = sb } }, rigid = rigid }
  scene:clamp(a, { s = a.length - sa })
  if rigid == false then scene:clamp(b, { s = b.length - sb }) end
  scene:force{ kind = "point", on = rigid == false and a or b, s = rigid == false and sa or b.length - sb,
    force = turned(force, way) }
  return scene, a, b, joint, sa, sb
end

describe("the bend at a rigid joint", function()
  for _, way in ipairs{ "plain", "swapped", "turned" } do
    it("is that of its moment at the ends of wires, " .. way, function()
      local scene, a, b, joint, sa, sb = halves(10, way, { 0, 0.03, 0.04 })
      t.fine(scene:settle())
      for k, w in ipairs{ a, b } do
        local s, right = k == 1 and sa or sb, t.norm(joint:moment(k)) / EI
        t.above(3.5, right, "bend [1/m]")
        t.share(right, w:curvature(s), 1e-6, "curvature at the joint")
        local radius, at = w:min_bend_radius{ now = true }
        if k == 2 then
          t.share(1 / right, radius, 1e-6, "smallest radius")
          t.near(sb, at, 1e-9, "its place [m]")
          t.share(RADIUS * right, (w:max_strain{ now = true }), 0.01, "largest strain")
        end
      end
    end)
  end

  it("is none at a hinge", function()
    local scene, a, b, _, sa, sb = halves(20, "plain", { 0, 0, 1 }, nil, false)
    t.fine(scene:settle())
    assert.equal(0, a:curvature(sa))
    assert.equal(0, b:curvature(sb))
    local _, at = b:min_bend_radius{ now = true }
    t.near(b.length, at, 1e-9, "place of the sharpest bend: the clamp [m]")
  end)

  it("jumps in mid-wire by that of the moment", function()
    local function tee(n)
      local scene = sw.scene{}
      local trunk = wire(scene, "trunk", { 0, 0, 0 }, { 0, 0, -0.4 }, 4 * n)
      local branch = wire(scene, "branch", { 0, 0, -0.2 }, { 0.2, 0, -0.2 }, n, { mass_per_length = 0.05 })
      scene:clamp(trunk, { s = 0 })
      local joint = scene:join{ ends = { { trunk, s = 0.2 }, { branch, s = 0 } } }
      t.fine(scene:settle())
      local radius, at = trunk:min_bend_radius{ now = true }
      return radius, at, trunk, branch, joint
    end
    local fine = tee(80)
    for _, n in ipairs{ 10, 20 } do
      local radius, at, trunk, branch, joint = tee(n)
      local jump = t.norm(joint:moment(1)) / EI
      t.near(0.2, at, 1e-9, "place of the sharpest bend [m]")
      t.share(fine, radius, 0.01, "radius before the joint")
      local after = trunk:curvature(0.2) -- to the other side
      t.share(jump, 1 / radius + after, 0.01, "jump of the bend")
      t.share(jump, branch:curvature(0), 1e-6, "bend of the branch")
    end
  end)

  it("adds to that of a clamp at the same place", function()
    local scene = sw.scene{}
    local trunk = wire(scene, "trunk", { 0, 0, 0 }, { 0.3, 0, 0 }, 30)
    local branch = wire(scene, "branch", { 0.15, 0, 0 }, { 0.15, 0, 0.1 }, 10, { mass_per_length = 0.05 })
    scene:clamp(trunk, { s = 0.15 })
    scene:join{ ends = { { trunk, s = 0.15 }, { branch, s = 0 } } }
    scene:force{ kind = "point", on = branch, s = branch.length, force = { 0.1, 0, 0 } }
    t.fine(scene:settle())
    -- Each half of the trunk bears its own weight only.
    t.share(0.02 * 9.81 * 0.15 ^ 2 / 2 / EI, trunk:curvature(0.15), 0.02, "bend beside the clamp")
  end)

  it("is right about both axes of a flat wire", function()
    local flat = { EI = { 4e-3, 1e-3 }, normal = { 0, 0, 1 } }
    for _, way in ipairs{ "plain", "swapped" } do
      for _, load in ipairs{ { 4e-3, { 0, 0, 0.06 } }, { 1e-3, { 0, 0.02, 0 } } } do
        local scene, _, b, joint, _, sb = halves(20, way, load[2], flat)
        t.fine(scene:settle())
        local right = t.norm(joint:moment(2)) / load[1]
        t.above(1.4, right, "bend [1/m]")
        t.share(right, b:curvature(sb), 1e-5, "bend of the flat wire")
        t.share(1 / right, (b:min_bend_radius{ now = true }), 1e-5, "radius of the flat wire")
        t.share(RADIUS * right, (b:max_strain{ now = true }), 0.02, "strain of the flat wire")
      end
    end
    -- Aslant: the bend goes on along the wire.
    local scene, _, b = halves(20, "plain", { 0, 0.02, 0.06 }, flat)
    t.fine(scene:settle())
    t.share(2 * b:curvature(0.005) - b:curvature(0.01), b:curvature(0), 0.01, "bend aslant")
  end)

  it("adds to the bend at rest of a curved wire, but not to its strain", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local R = 0.15
    local function arc(name, from, to)
      local path = {}
      for i = 0, 60 do
        local a = (from + (to - from) * i / 60) / R
        path[#path + 1] = { R * math.sin(a), 0, R * (1 - math.cos(a)) }
      end
      return wire(scene, name, nil, nil, 20, { path = path, rest = "path" })
    end
    local a, b = arc("a", 0, LONG), arc("b", LONG, 2 * LONG)
    local joint = scene:join{ ends = { { a, s = a.length }, { b, s = 0 } } }
    scene:clamp(a, { s = 0 })
    t.fine(scene:settle())
    t.share(1 / R, b:curvature(0), 0.01, "bend at rest")
    t.below(1e-5, (b:max_strain{ now = true }), "strain at rest")
    scene:force{ kind = "moment", on = b, s = b.length, moment = { 0, -2e-3, 0 } }
    t.fine(scene:settle())
    t.share(2e-3, t.norm(joint:moment(2)), 0.01, "moment of the joint [N m]")
    t.share(1 / R + 2e-3 / EI, b:curvature(0), 0.01, "bend under a couple")
    t.share(RADIUS * 2e-3 / EI, (b:max_strain{ now = true }), 0.01, "strain under a couple")
  end)

  it("counts in runs: series, checks and fatigue", function()
    local scene, _, _, joint = halves(10, "plain", { 0, 0, 0.05 })
    scene:force{ kind = "damping", mass = 20, stiffness = 2e-3 }
    local run = t.fine(scene:run{ duration = 1, dt = 0.01, wear = true })
    local right = t.norm(joint:moment(2)) / EI
    local radii
    for _, column in ipairs(run:series().columns) do
      if column.name == "b.bend_radius" then radii = column.values end
    end
    t.share(1 / right, radii[#radii], 1e-5, "radius in the series")
    local check = run:check{ trial = true, limits = { ["b.min_bend_radius"] = { min = 1.01 / right } },
      fatigue = { repeats = 1000, bending = { { 20, 1e6 }, { 40, 1e5 }, { 80, 1e4 } }, source = "here" } }
    assert.equal("FAIL", check:row "b.min_bend_radius".verdict)
    t.near(0, check:row "b.fatigue".s, 1e-9, "place of the largest fatigue [m]")
  end)

  it("has its energy", function()
    local energies = {}
    for i, n in ipairs{ 5, 80 } do
      local scene, a, b = halves(n, "plain", { 0, 0, 0.05 })
      t.fine(scene:settle())
      energies[i] = a:bend_energy() + b:bend_energy()
    end
    t.share(energies[2], energies[1], 0.01, "energy of the bends")
  end)
end)
