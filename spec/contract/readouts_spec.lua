-- SPDX-License-Identifier: GPL-3.0-or-later
-- Read-outs of one number: each is right for every wire model, or refuses it by name.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local samples = require "contract.samples"
local t = require "spec.physics.tools"

local L, EI, GJ, ANGLE, TURN = 0.15, 0.02, 0.015, 0.3, 0.3

-- Returns every way to make a wire with these values: { name, args }.
local function subjects()
  local list = {}
  local function add(name, more)
    local args = { EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05, radius = 0.005, from = { 0, 0, 0 },
      to = { L, 0, 0 } }
    for k, v in pairs(more) do args[k] = v end
    list[#list + 1] = { name = name, args = args }
  end
  for _, model in ipairs(samples.registry.models) do add(model.name, { model = model.name }) end
  add("rolling rod", { rolls = true })
  add("rod of two EI", { EI = { EI, 0.4 * EI }, normal = { 0, 0, 1 } })
  add("composite with lines that bend", { model = "composite", core = "line" })
  add("tube with a wall", { model = "tube", core = false, wall_bending = 0.05, particles = 12 })
  add("radial of elements", { model = "radial", body = "solid" })
  add("cubic of elements", { model = "cubic", body = "solid" })
  add("tube that bends along", { model = "tube", bend = true })
  return list
end

-- A wire clamped along an arc in the plane of x and z, and twisted by turn [rad].
local function arc(args, turn)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire(args)
  scene:clamp(wire, { s = 0 })
  local end_ = scene:clamp(wire, { s = wire.length })
  local r = L / ANGLE
  local c, s = math.cos(turn / 2), math.sin(turn / 2) -- about the wire, then about -y
  local c2, s2 = math.cos(ANGLE / 2), -math.sin(ANGLE / 2)
  end_:pose({ r * math.sin(ANGLE), 0, r * (1 - math.cos(ANGLE)) }, { c2 * c, c2 * s, s2 * c, -s2 * s })
  t.fine(scene:settle())
  return scene, wire, end_
end

for _, subject in ipairs(subjects()) do
  describe("read-outs of a " .. subject.name, function()
    -- A uniform arc: 1/2 EI (angle/L)^2 L and GJ turn/L. Hinges of lines are exact. A mesh of slices has
    -- the moments to a percent or two, because its sections next to clamps cannot contract.
    it("are finite, or refused by the wire's name; bend_energy and twist_moment fit the arc", function()
      local _, wire = arc(subject.args, TURN)
      for _, readout in ipairs(samples.registry.readouts) do
        local ok, value = pcall(wire[readout.name], wire, readout.at_place and L / 3 or nil)
        if ok then
          assert.is_true(value == value and math.abs(value) < math.huge, readout.name)
        else
          assert.is_truthy(value:find("wire '" .. wire.name .. "': " .. readout.name, 1, true), value)
        end
      end
      t.share(0.5 * EI * ANGLE * ANGLE / L, wire:bend_energy(), 0.02, "bend_energy")
      if subject.name == "string" then
        assert.error_matches(function() wire:twist_moment(L / 2) end, "is a string, which has none")
      else
        t.share(GJ * TURN / L, wire:twist_moment(L / 2), 0.03, "twist_moment")
      end
    end)

    it("bend_energy is close to zero where the wire is only twisted and pulled", function()
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire(subject.args)
      scene:clamp(wire, { s = 0 })
      scene:clamp(wire, { s = L }):pose({ L + 1e-4, 0, 0 }, { axis = { 1, 0, 0 }, angle = 0.3 })
      t.fine(scene:settle())
      -- a string counts the stretch at a clamp as a bend: its hinges use second differences only
      local share = subject.name == "string" and 1e-3 or 1e-4
      t.below(share * 0.5 * EI * ANGLE * ANGLE / L, wire:bend_energy(), "bend_energy")
    end)
  end)
end

describe("bend_energy", function()
  it("counts from the wire's shape without load", function()
    local path = {}
    for i = 0, 60 do
      local a = ANGLE * i / 60
      path[i + 1] = { L / ANGLE * math.sin(a), 0, L / ANGLE * (1 - math.cos(a)) }
    end
    for _, model in ipairs{ "rod", "tube", "radial" } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05, radius = 0.005,
        model = model, path = path, rest = "path" }
      local first, last = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = wire.length })
      t.fine(scene:settle())
      t.below(1e-6, wire:bend_energy(), model .. " as drawn")
      first:pose({ 0, 0, 0 }, { 1, 0, 0, 0 })
      last:pose({ wire.length, 0, 0 }, { axis = { 0, 1, 0 }, angle = ANGLE })
      t.fine(scene:settle())
      t.share(0.5 * EI * ANGLE ^ 2 / L, wire:bend_energy(), 0.02, model .. " made straight")
    end
  end)

  it("is the same where a part of the wire has become a mesh", function()
    local _, wire = arc({ EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05, radius = 0.005,
      from = { 0, 0, 0 }, to = { L, 0, 0 } }, 0)
    local before = wire:bend_energy()
    wire:remodel{ model = "radial", region = { 0.05, 0.1 } }
    t.share(before, wire:bend_energy(), 0.02, "with a region")
    assert.error_matches(function() wire:twist_moment(0.03) end, "is a line of particles, which has none")
  end)

  it("is refused for meshes with two values of EI", function()
    local scene = sw.scene{}
    -- a section of 10 by 5 mm
    local wire = scene:wire{ model = "cubic", section = "rectangle", width = 0.01, height = 0.005, EA = 1e4,
      EI = { 0.08, 0.02 }, GJ = 0.05, normal = { 0, 0, 1 }, mass_per_length = 0.06,
      radius = 0.005, from = { 0, 0, 0 }, to = { 0.1, 0, 0 } }
    assert.error_matches(function() wire:bend_energy() end, "two values of EI")
  end)

  it("leaves out the plastic work", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05, radius = 0.005,
      from = { 0, 0, 0 }, to = { L, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local last = scene:clamp(wire, { s = L })
    local yield = 0.5 * EI * ANGLE / L -- hinges yield at this moment: 1/2 M^2/EI L is stored
    scene:force{ kind = "plastic", on = wire, yield_moment = yield, hardening = 0 }
    for k = 1, 20 do
      local a = ANGLE * k / 20
      last:pose({ L / a * math.sin(a), 0, L / a * (1 - math.cos(a)) }, { axis = { 0, -1, 0 }, angle = a })
      t.fine(scene:settle())
    end
    t.share(0.5 * yield ^ 2 / EI * L, wire:bend_energy(), 0.02, "stored")
  end)
end)

describe("max_torsion", function()
  -- one end turns by ANGLE: a rod and a mesh have ANGLE / L (a mesh within 0.1 %), a string bears no twist
  local function turned(model)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", model = model, EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05,
      radius = 0.005, from = { 0, 0, 0 }, to = { L, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = L }):follow{ duration = 0.2, func = function(time)
      return { L, 0, 0 }, { axis = { 1, 0, 0 }, angle = 5 * ANGLE * time }
    end }
    return wire, t.fine(scene:run{ duration = 0.2, dt = 0.1, quasistatic = true })
  end

  for _, model in ipairs{ "rod", "radial" } do
    it("is the turn per metre of a " .. model, function()
      local wire, run = turned(model)
      t.share(ANGLE / L, (wire:max_torsion()), 1e-3, "torsion")
      assert.equal("FAIL", run:check{ limits = { max_torsion = 0.9 * ANGLE / L } }:row "max_torsion".verdict)
      assert.equal("PASS", run:check{ limits = { max_torsion = 1.1 * ANGLE / L } }:row "max_torsion".verdict)
    end)
  end

  it("is refused for a string, and passes no check", function()
    local wire, run = turned "string"
    assert.error_matches(function() wire:max_torsion() end, "'w' is a string, which bears no twist")
    assert.error_matches(function() wire:max_torsion{ now = true } end, "which bears no twist")
    local row = run:check{ limits = { max_torsion = 100 } }:row "max_torsion"
    assert.equal("FAIL", row.verdict)
    assert.truthy(row.note:find("a string bears no twist", 1, true), row.note)
    assert.error_matches(function() run:check{}:row "max_torsion" end, "no row") -- nobody asked
  end)

  it("of a free rod is 0, and of a rod that becomes a string that of its time as a rod", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ EA = 1e4, EI = EI, GJ = GJ, mass_per_length = 0.05, radius = 0.005,
      from = { 0, 0, 0 }, to = { L, 0, 0 } }
    assert.equal(0, (wire:max_torsion{ now = true }))
    local held = turned "rod"
    held:remodel{ model = "string" }
    t.share(ANGLE / L, (held:max_torsion()), 1e-3, "torsion")
  end)
end)
