-- SPDX-License-Identifier: GPL-3.0-or-later
-- Holds that press a wire a tenth of a millimetre into something. That is no crash, but the force there is
-- that of the first free edge: 3 EI d/h^3 for the depth d and the edge h, without a limit as h gets shorter.
local sw = require "softworld"
local t = require "physics.tools"

local function of_kind(list, kind)
  local found = {}
  for _, e in ipairs(list) do if e.kind == kind then found[#found + 1] = e end end
  return found
end

-- A cable lies on a table, turned by o.turn [rad]; a hold at its place s = 0.1 m goes down by `down` [m].
local function pressed(cable, down, o)
  local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local c, s = math.cos(o.turn or 0), math.sin(o.turn or 0)
  local z = r - (o.sunk or 0) -- [m]
  local wire = scene:wire{ name = "w", cable = cable, from = { 0, 0, z }, to = { 0.3 * c, 0.3 * s, z },
    segments = o.segments or 40 }
  scene:force{ kind = "damping", mass = 5, stiffness = 1e-3 }
  local hold = o.make(scene, wire)
  if down ~= 0 then
    hold:follow{ relative = true, points = { { 0, 0, 0 }, { 0, 0, -down } }, duration = 0.2 }
  end
  local run = t.fine(scene:run{ dt = o.dt or 0.01, duration = 0.3 })
  return of_kind(run.events, "pressed"), hold:over().peak_force, of_kind(run.events, "crash"), run
end

local makers = {
  grip = function(scene, wire) return scene:grip(wire, { name = "h", s = 0.1, width = 0.01 }) end,
  clamp = function(scene, wire) return scene:clamp(wire, { name = "h", s = 0.1 }) end,
}

describe("a hold that presses a cable a little into a table", function()
  for kind, make in pairs(makers) do
    for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
      it(("is told of with the force: %s, %s"):format(kind, cable), function()
        local forces, down = {}, 0.1 * sw.cable(cable).outer_diameter.value / 2
        for _, o in ipairs{ { segments = 30 }, { segments = 60, dt = 0.002, turn = 0.8 },
          { segments = 75, dt = 0.005 } } do
          o.make = make
          local told, peak, crash = pressed(cable, down, o)
          assert.equal(1, #told)
          assert.equal(0, #crash)
          assert.equal("h", told[1].object)
          t.near(0.1, told[1].s, 0.002, "place [m]")
          t.near(1e3 * down, tonumber(told[1].text:match "presses wire 'w' ([%d.e-]+) mm into 'table'"),
            0.02e3 * down, "depth told [mm]")
          -- Besides the table the hold bears the weight of what it lifts off, less than the whole; the peak
          -- is a mean over 10 ms of a force that rises in 0.2 s.
          t.near(peak, told[1].value, 0.1 * peak + 9.81 * 0.3 * sw.cable(cable).mass_per_length.value,
            "force told [N]")
          forces[#forces + 1] = peak
        end
        -- Why it is told: the first free edge is 10, 5 and 4 mm long beside the clamp, and 5, 5 and 3 mm
        -- beside the grip, so the force grows at least by (5/3)^3 = 4.6; half of that is asked for.
        t.above(2.3 * forces[1], forces[3], "force with shorter edges [N]")
      end)
    end
  end

  -- 20 um give 0.6 to 3 N, for a weight of 0.06 to 0.2 N.
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("is told of if it begins there: " .. cable, function()
      for _, make in pairs(makers) do
        for _, o in ipairs{ { sunk = 2e-5 }, { sunk = 1e-4, segments = 60, dt = 0.002, turn = 0.8 },
          { sunk = 5e-5, segments = 75, dt = 0.005 } } do
          o.make = make
          local told, peak, crash = pressed(cable, 0, o)
          assert.same({ 1, 0 }, { #told, #crash })
          assert.is_true(told[1].value > 0.3 * peak) -- of the first step that is told
          o.sunk = 0
          local none, light = pressed(cable, 0, o)
          assert.equal(0, #none)
          assert.is_true(peak > 3 * light) -- what a reader would have taken for a load of the hold
        end
      end
    end)
  end

  -- Told by its force, at any depth: 8 um (0.3 % of the radius) gave GXL 10 1.5 to 203 weights. A hold at
  -- the wire's own height, or above it, leaves the table a little less than the weight.
  for _, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "GXL 10" } do
    it("is told of wherever the table bears 15 % too much: " .. cable, function()
      local r, heavy = sw.cable(cable).outer_diameter.value / 2, 0
      local weight = 9.81 * 0.3 * sw.cable(cable).mass_per_length.value
      for _, segments in ipairs{ 10, 20, 77 } do
        for _, share in ipairs{ 0.03, 0.01, 0.003, 0, -0.003 } do
          for _, dt in ipairs{ 0.02, 0.005 } do
            local told, _, _, run = pressed(cable, 0, { make = makers.clamp, segments = segments, dt = dt,
              sunk = share * r, turn = 10 * share })
            local bears = run.scene:find "table":force()[3] / -weight
            if bears > 1.15 then
              heavy = heavy + 1
              assert.equal(1, #told)
            elseif share <= 0 then
              t.below(1.001, bears, "load of the table over the weight")
              assert.equal(0, #told)
            end
          end
        end
      end
      t.above(8, heavy, "runs with a force that is false")
    end)
  end

  it("is not told of where it does not press", function()
    for _, make in pairs(makers) do
      for _, down in ipairs{ 0, -1e-3, 1e-6 } do
        local told, _, crash = pressed("GXL 1.5", down, { make = make })
        assert.same({ 0, 0 }, { #told, #crash })
      end
    end
  end)

  it("is a crash from a quarter of the radius on", function()
    local _, _, crash = pressed("GXL 1.5", 0.4e-3, { make = makers.clamp })
    assert.equal(1, #crash)
  end)
end)
