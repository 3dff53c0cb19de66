-- SPDX-License-Identifier: GPL-3.0-or-later
-- The probe of the player gives what the wire gives at the end of the run: at nodes, between them, at both
-- ends, beside clamps.
local stage = require "spec.page.stage"
local sw = require "softworld"

local page, folder

setup(function() page, folder = stage.open() end)
teardown(stage.close)

describe("the page's probe", function()
  local wires

  setup(function()
    local scene = sw.scene{ name = "probed" }
    wires = {}
    local function wire(name, from, to)
      wires[name] = scene:wire{ name = name, cable = "GXL 1.5", from = from, to = to, segments = 25 }
      scene:clamp(wires[name], { s = 0 })
      return wires[name]
    end
    wire("hanging", { 0, 0, 0.6 }, { 0, 0, 0.1 })
    wire("bent", { 0, 0.2, 0.6 }, { 0.5, 0.2, 0.6 })
    scene:clamp(wire("between", { 0, 0.4, 0.6 }, { 0.3, 0.4, 0.6 }), { s = 0.3 })
    local run = scene:run{ dt = 0.002, duration = 0.5 }
    run:report(folder .. "/probed.html")
    page:go(stage.address "probed.html")
    page:run("player.state.set({ time: arguments[0], playing: false })", run.time)
  end)

  -- Returns place, tension, curvature of the page.
  local function probed(name, s)
    return table.unpack(page:run([[
      const a = player.view.actors.find((a) => a.kind === "wire" && a.name === arguments[0]);
      const s = arguments[1];
      return [a.place(s).point.toArray(), a.value(0, s), a.value(1, s)];]], name, s))
  end

  for _, name in ipairs{ "hanging", "bent", "between" } do
    it("has the run's places, tensions and curvatures: wire '" .. name .. "'", function()
      local wire = wires[name]
      local most, sharpest = 0, 0
      for k = 0, 100 do
        most = math.max(most, math.abs(wire:tension(wire.length * k / 100)))
        sharpest = math.max(sharpest, wire:curvature(wire.length * k / 100))
      end
      for k = 0, 100 do
        local s = wire.length * k / 100
        local p, tension, curvature = probed(name, s)
        local where = ("s = %g"):format(s)
        for c, x in ipairs(wire:position(s)) do assert.near(x, p[c], 0.02 * wire.radius, where) end
        assert.near(wire:tension(s), tension, 0.01 * most, where)
        assert.near(wire:curvature(s), curvature, 0.001 * sharpest + 1e-9, where)
      end
    end)
  end
end)
