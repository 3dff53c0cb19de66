-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction work that runs record for wires modelled as lines, place by place. It is compared with the
-- capstan and the ledger, also for a fed wire.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local core = require "softworld.core"
local bent = require "spec.check.bent"
local capstan = require "spec.check.capstan"

local R, RADIUS = capstan.R, capstan.RADIUS

local function wave(t) return math.sin(math.pi * t / 2) / R end

describe("work of friction", function()
  -- Drawn over a third of a cylinder at a constant speed: T_in (exp(mu angle) - 1) v in total, and zero
  -- where nothing touches. No frame shows any of it.
  it("is that of the capstan, summed over the nodes", function()
    local Rw, mu, angle, v = R + RADIUS, 0.4, 2 * math.pi / 3, 0.02
    local scene, wire, pin, along = capstan.scene{ friction = mu, angle = angle, segments = 200 }
    pin:follow{ points = capstan.draw(along, 0.03), relative = true, speed = v, law = "linear" }
    scene:run{ duration = 0.5, dt = 0.002 }
    local run = scene:run{ duration = 0.5, dt = 0.002, wear = true, frame = 1 }
    local sum, places, n = 0, core.worn(wire), wire.segments + 1
    for k = 1, n do
      sum = sum + places[k].rubbed * (places[math.min(k + 1, n)].s - places[math.max(k - 1, 1)].s) / 2
      assert.is_near(places[k].rubbed, mu * places[k].slid, 1e-9 + 1e-3 * places[k].rubbed)
    end
    local wanted = (math.exp(mu * angle) - 1) * v * 0.5
    print(("measured: %.6g J, by the capstan %.6g J"):format(sum, wanted))
    assert.is_near(wanted, sum, 0.01 * wanted)
    assert.same({ 0, 0 }, { places[1].rubbed, places[n].rubbed })
    -- T/R is largest where the wire leaves: T_in exp(mu angle) / R, between frames
    local pressure = run:check{ limits = { max_sidewall = 1e3 } }:row "max_sidewall"
    assert.is_near(math.exp(mu * angle) / Rw, pressure.value, 0.02 * pressure.value)
    assert.equal("PASS", pressure.verdict)
    assert.is_nil(pressure.high)
    local row = run:check{ abrasion = { coefficient = 1e-12, source = "this spec", flag = "guessed" },
      limits = { wear_depth = 1e-9 } }:row "wear_depth"
    assert.truthy(row.note:find("1e-12 1/Pa, this spec; guessed", 1, true), row.note)
    assert.truthy(row.note:find("assumed to be the wire's radius", 1, true), row.note)
  end)

  -- A wire crosses a round post and is drawn along it: the same place of the wire touches all the time. In
  -- half the edges twice the work per area; the work itself stays (2 %). The row is a lower bound, so it
  -- cannot pass.
  it("is a lower bound where a wire touches at a point, because it is spread over an edge", function()
    local areas, works = {}, {}
    for k, segments in ipairs{ 20, 40 } do
      local scene = sw.scene{}
      scene:obstacle{ name = "post", shape = "cylinder", radius = 0.004, length = 0.2, friction = 0.4,
        rotation = { axis = { 0, 1, 0 }, angle = math.pi / 2 } }
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, -0.1, 0.0055 },
        to = { 0, 0.1, 0.0055 }, segments = segments }
      local clamps = { scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = 0.2 }) }
      scene:settle()
      for _, clamp in ipairs(clamps) do
        clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.002 }, { 0.05, 0, -0.002 } }, relative = true,
          duration = 1 }
      end
      local run = scene:run{ duration = 1, dt = 0.005, wear = true }
      local row = run:check{ limits = { friction_work = 1e5 } }:row "friction_work"
      assert.same({ "OPEN", math.huge }, { row.verdict, row.high })
      assert.truthy(row.note:find(("spread over %.3g m of edges"):format(0.2 / segments), 1, true), row.note)
      assert.equal("FAIL", run:check{ limits = { friction_work = 100 } }:row "friction_work".verdict)
      areas[k], works[k] = row.value, run:ledger().lost.friction
    end
    assert.is_near(2, areas[2] / areas[1], 0.04)
    assert.is_near(1, works[2] / works[1], 0.02)
  end)

  it("is open without a limit or a record, and fails without a coefficient", function()
    local run = bent(wave)
    local row = run:check{ abrasion = { coefficient = 1e-12 } }:row "wear_depth"
    assert.same({ 0, "OPEN" }, { row.value, row.verdict })
    assert.truthy(row.note:find("assumed: its source is not given", 1, true), row.note)
    assert.truthy(row.note:find("limits = { ['w.wear_depth'] = } [m]", 1, true), row.note)
    row = run:check{ limits = { wear_depth = 1e-6 } }:row "wear_depth"
    assert.equal("FAIL", row.verdict)
    row = bent(wave, nil, { wear = false }):check{ limits = { friction_work = 1 } }:row "friction_work"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("wear = true", 1, true), row.note)
    assert.has_error(function() run:check{ abrasion = {} } end)
    assert.has_error(function() run:check{ abrasion = { coefficient = -1 } } end)
  end)

  -- The node beside the feed moves along the wire and new nodes appear. The recorded friction stays at its
  -- place.
  it("is complete for a fed wire", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    local wire = scene:wire{ name = "w", E = 5e6, density = 1200, radius = 0.002, from = { 0, 0, 0.002 },
      to = { 0.1, 0, 0.002 }, segments = 20 }
    scene:force{ kind = "damping", mass = 4, stiffness = 0.002, on = wire }
    local feeder = scene:feed(wire, { s = 0 })
    scene:process(function(p) p:feed(feeder, { length = 0.1, speed = 0.2 }) end)
    local run = scene:run{ dt = 0.005, wear = true }
    local sum, places = 0, {}
    for _, place in ipairs((core.worn(wire))) do
      if place.side == 0 then places[#places + 1] = place end
    end
    for k, place in ipairs(places) do
      sum = sum + place.rubbed * (places[math.min(k + 1, #places)].s - places[math.max(k - 1, 1)].s) / 2
    end
    local wanted = run:ledger().lost.friction
    print(("measured: %.6g J, by the ledger %.6g J"):format(sum, wanted))
    assert.is_near(wanted, sum, 0.002 * wanted)
  end)
end)
