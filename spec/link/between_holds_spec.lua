-- SPDX-License-Identifier: GPL-3.0-or-later
-- A bent wire at rest is pinned at two places within three edges, and stays at rest: its tension must not
-- change. So little wire between pins cannot yield along itself: its tension is EA times what is left after
-- its bends are shared out between nodes: up to 0.25 EI/R^2 too much, or too little. Where that makes the
-- largest tension, an event tells so.
local sw = require "softworld"
local t = require "physics.tools"

local LENGTH, AT = 0.4, 0.14 -- [m]

local function arch(cable, segments, turn)
  local scene, c, s = sw.scene{}, math.cos(turn), math.sin(turn)
  local wire = scene:wire{ cable = cable, from = { 0, 0, 0 }, to = { LENGTH * c, LENGTH * s, 0 },
    segments = segments }
  scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = LENGTH }):follow{ duration = 1, relative = true,
    points = { { 0, 0, 0 }, { -0.28 * c, -0.28 * s, 1e-3 } } }
  t.fine(scene:run{ duration = 3 })
  t.fine(scene:run{ duration = 0.3 })
  return scene, wire
end

-- Holds the wire at two places `gap` edges apart. Returns largest tensions before and after, and the event.
local function held(cable, segments, turn, kinds, gap, dt)
  local scene, wire = arch(cable, segments, turn)
  local before, event = math.max(0, (wire:max_tension()))
  scene[kinds[1]](scene, wire, { s = AT })
  scene[kinds[2]](scene, wire, { s = AT + gap * LENGTH / segments })
  for _, e in ipairs(t.fine(scene:run{ duration = 0.3, dt = dt }).events) do
    assert(e.kind == "edges", e.kind .. ": " .. e.text)
    event = e
  end
  return before, math.max(0, (wire:max_tension())), event
end

describe("a bent wire between two pins within three edges", function()
  for k, cable in ipairs{ "GXL 0.5", "GXL 1.5", "H07V-K 10" } do
    it("has an event if its largest tension is false: " .. cable, function()
      local told = 0
      for n, segments in ipairs{ 25, 40, 60 } do
        for _, gap in ipairs{ 0.3, 0.5, 0.9, 1.2, 1.7, 2.4 } do
          for _, dt in ipairs{ 0.01, 0.002 } do
            local before, after, event = held(cable, segments, k + n, { "pin", "pin" }, gap, dt)
            local what = ("%d segments, %g edges, %g ms: "):format(segments, gap, 1e3 * dt)
            told = told + (event and 1 or 0)
            -- a tenth is told; the peak is a mean over 10 ms, which differs a little from the state's tension
            if not event then t.below(1.15 * before, after, what .. "largest tension [N]") end
            if event then t.below(1.3 * event.value, after - before, what .. "false part [N]") end
          end
        end
      end
      t.above(6, told, "cases of 36 that are told")
    end)
  end

  it("has none between clamps, or five edges apart", function()
    for n, segments in ipairs{ 25, 40, 60 } do
      for _, gap in ipairs{ 0.5, 0.9, 1.7, 5 } do
        local kind = gap < 5 and "clamp" or "pin"
        local before, after, event = held("GXL 1.5", segments, n, { kind, kind }, gap, 0.01)
        assert(not event, event and event.text)
        t.near(before, after, 0.05 * before, "largest tension [N]")
      end
    end
  end)

  it("has none if it is straight, or drawn by the pins", function()
    for _, pull in ipairs{ 0, 1e-6 } do
      local scene = sw.scene{ gravity = { 0, 0, pull > 0 and 0 or -9.81 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { LENGTH, 0, 0 }, segments = 30 }
      scene:force{ kind = "damping", mass = 4, stiffness = 4e-3 }
      scene:pin(wire, { s = 0.2 })
      scene:pin(wire, { s = 0.21 }):follow{ duration = 0.3, relative = true,
        points = { { 0, 0, 0 }, { pull + 1e-9, 0, 0 } } }
      local run = t.fine(scene:run{ duration = 0.5 })
      assert(#run.events == 0, run.events[1] and run.events[1].text)
      if pull > 0 then
        -- EA times the strain, which has the way's thousandth more
        local right = wire.beam.EA * pull / 0.01
        t.near(right, wire:max_tension{ now = true }, 2e-3 * right, "tension [N]")
      end
    end
  end)
end)
