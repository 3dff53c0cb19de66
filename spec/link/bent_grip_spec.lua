-- SPDX-License-Identifier: GPL-3.0-or-later
-- A bent wire at rest is gripped and stays at rest: the hold takes it in the shape that it has. Its bend
-- radius must not change. A hold moves or inserts nodes, so two errors are possible. A node moved alone
-- leaves the curve. And the hinges beside a clamp have the bend of the wire only if the clamp lies k h^2/12
-- inside the curve through the nodes (csrc/state/near.c). With both errors a wire bent by 30 mm had 8.5 to
-- 28 mm.
local sw = require "softworld"
local t = require "physics.tools"

-- Makes an arch between two clamps in the plane of the z axis and the direction `turn`, at rest. Returns the
-- scene, the wire, its smallest bend radius [m] and the clamps.
local function arch(cable, segments, turn)
  local scene, c, s = sw.scene{}, math.cos(turn), math.sin(turn)
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { 0.4 * c, 0.4 * s, 0 },
    segments = segments }
  scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
  local start, far = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = wire.length })
  far:follow{ duration = 1, points = { { 0.4 * c, 0.4 * s, 0 }, { 0.1 * c, 0.1 * s, 0.001 } } }
  t.fine(scene:run{ duration = 3 })
  t.fine(scene:settle())
  t.fine(scene:run{ duration = 0.02 })
  return scene, wire, (wire:min_bend_radius()), { start, far }
end

-- A grip, or a clamp where the hold has no width.
local function held_by(scene, wire, hold)
  return hold.width and scene:grip(wire, hold) or scene:clamp(wire, { s = hold.s })
end

describe("a bent wire at rest that is gripped", function()
  for k, cable in ipairs{ "FLRY-B 0.5", "GXL 1.5", "H07V-K 4" } do
    it("keeps its bend radius: " .. cable, function()
      for n, segments in ipairs{ 40, 47, 55 } do
        for _, hold in ipairs{ { s = 0.2, width = 0.01 }, { s = 0.2027, width = 0.01 },
          { s = 0.205, width = 0.02 }, { s = 0.197 } } do
          local scene, wire, before = arch(cable, segments, 0.4 * k + n)
          held_by(scene, wire, hold)
          t.fine(scene:run{ duration = 0.1 })
          -- Edges of 7 to 10 mm on a bend of 30 mm: h^2/R^2 is 0.05 to 0.1. The shape near the hold is right
          -- to a third of this.
          t.near(before, wire:min_bend_radius(), 0.03 * before,
            ("smallest radius, %d segments, at %g [m]"):format(segments, hold.s))
        end
      end
    end)
  end

  it("keeps it when it is let go, and when it is held again at once", function()
    for n, segments in ipairs{ 40, 47, 55 } do
      for _, hold in ipairs{ { s = 0.2, width = 0.01 }, { s = 0.2 }, { s = 0.2027 } } do
        local scene, wire, before = arch("GXL 1.5", segments, 0.7 * n)
        local held = held_by(scene, wire, hold)
        t.fine(scene:run{ duration = 0.5 })
        held:release()
        if n == 2 then scene:clamp(wire, { s = hold.s }) end
        t.fine(scene:run{ duration = 0.1 })
        -- The nodes go back by what they went in, with the curvature as a mean over four edges. Where they
        -- stayed, a place let go was 10 % too sharp.
        t.near(before, wire:min_bend_radius(), 0.04 * before,
          ("%d segments, at %g [m]"):format(segments, hold.s))
      end
    end
  end)

  it("keeps its bend at an end that is let go and held again", function()
    for _, segments in ipairs{ 40, 55 } do
      local scene, wire, before, clamps = arch("H07V-K 4", segments, 0.3)
      for k, s in ipairs{ 0, wire.length } do
        clamps[k]:release()
        scene:clamp(wire, { s = s })
      end
      t.fine(scene:run{ duration = 0.1 })
      -- Only one side tells the curvature at an end: 2.5 %. Before, 12 %.
      t.near(before, wire:min_bend_radius(), 0.04 * before, ("%d segments [m]"):format(segments))
    end
  end)

  -- What a script does after it has bent a wire; returns nothing. The other hold is 30 mm beside, on edges of
  -- 9 mm: between both, edges are halved.
  local acts = {
    ["is handed over"] = function(scene, wire)
      local near, far = scene:gripper{ pads = { width = 0.01 } }, scene:gripper{ pads = { width = 0.01 } }
      near:grasp(wire, { s = 0.4 * wire.length, approach = "imposed" })
      t.fine(scene:run{ duration = 0.2 })
      far:grasp(wire, { s = 0.4 * wire.length + 0.03, approach = "imposed" })
      near:release()
    end,
    ["is held at many places"] = function(scene, wire)
      for k = 1, 4 do scene:clamp(wire, { s = 0.2 * k * wire.length + 0.0017 }) end
    end,
    ["is gripped"] = function(scene, wire) scene:grip(wire, { s = 0.37 * wire.length, width = 0.012 }) end,
  }
  for what, act in pairs(acts) do
    for _, kind in ipairs{ "a rod", "a rod that rolls", "a coil" } do
      it("keeps it when it " .. what .. ": " .. kind, function()
        local scene, path = sw.scene{}, { { 0, 0, 0 }, { 0.4, 0, 0 } }
        for i = 1, kind == "a coil" and 200 or 0 do
          path[i] = { 0.18 * math.sin(0.011 * i), 0, 0.18 * (1 - math.cos(0.011 * i)) }
        end
        local wire = scene:wire{ cable = "GXL 1.5", path = path, segments = 43,
          rest = kind == "a coil" and "path" or nil, rolls = kind == "a rod that rolls" or nil }
        scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
        scene:clamp(wire, { s = 0 })
        scene:clamp(wire, { s = wire.length }):follow{ relative = true, duration = 1,
          points = { { 0, 0, 0 }, { -0.5 * wire:position(wire.length)[1], 0.03, 0.01 } },
          turn = kind == "a rod that rolls" and { axis = { 1, 0, 0 }, angle = 1 } or nil }
        t.fine(scene:run{ duration = 3.5 })
        t.fine(scene:settle())
        t.fine(scene:run{ duration = 0.02 })
        local before, weight = wire:min_bend_radius(), wire.beam.mass_per_length * 9.81 * wire.length
        local tension = wire:max_tension()
        act(scene, wire)
        t.fine(scene:run{ duration = 0.2 })
        -- Before, 17 to 48 % too sharp where a wire was handed over, 27 % where one that rolls was gripped.
        t.near(before, wire:min_bend_radius(), 0.03 * before, "smallest radius [m]")
        -- Between two holds a stretch by 1e-6 is 0.1 N, more than the weight of 0.08 N.
        t.near(tension, wire:max_tension(), weight, "largest tension [N]")
      end)
    end
  end

  it("keeps its shape and the tension", function()
    local scene, wire = arch("GXL 1.5", 50, 1.1)
    local from, tension = wire:position(0.15), wire:tension(0.1)
    scene:grip(wire, { s = 0.2033, width = 0.012 })
    t.fine(scene:run{ duration = 0.5 })
    -- The free part swings by what the hold shifts its nodes, k h^2/12 = 0.18 mm.
    t.below(2e-4, t.distance(from, wire:position(0.15)), "position beside the grip moved by [m]")
    t.near(tension, wire:tension(0.1), 0.05 * math.abs(tension), "tension [N]")
  end)
end)
