-- SPDX-License-Identifier: GPL-3.0-or-later
-- A flat plate of a mesh file, turned in space. Files with floats round each coordinate to 6e-8 of its size,
-- so edges between its facets stick out by some nanometres: of facets of 2 mm by 1e-5 rad. A cable on it
-- rocked on such edges, and the first pose ended with "not at rest".
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"
local tools = require "spec.shape.tools"

local MU = 0.3

local function float(x) return (string.unpack("<f", string.pack("<f", x))) end

-- A turn about three axes, as for a part that was drawn aslant.
local function turned(v)
  local c, s = math.cos(0.7), math.sin(0.7)
  local x, z = c * v[1] + s * v[3], c * v[3] - s * v[1]
  c, s = math.cos(0.4), math.sin(0.4)
  x, v = c * x - s * v[2], { 0, s * x + c * v[2], z }
  c, s = math.cos(-0.3), math.sin(-0.3)
  return { x, c * v[2] - s * v[3], s * v[2] + c * v[3] }
end

-- A plate of n x m facets with rounded coordinates.
local function plate(scene, n, m)
  local points, triangles = tools.sheet(n, m, false, function(i, j)
    local p = turned{ -0.1 + 0.5 * i / n, -0.03 + 0.06 * j / m, 0 }
    return { float(p[1]), float(p[2]), float(p[3]) }
  end)
  scene:obstacle{ shape = "mesh", data = tools.obj(points, triangles), format = "obj", friction = MU }
end

-- Draws a cable along it in poses: pull over mu W.
local function pull(cable, n, m)
  local scene = sw.scene{ gravity = turned{ 0, 0, -9.81 } }
  if n then plate(scene, n, m) else
    scene:obstacle{ shape = "plane", normal = turned{ 0, 0, 1 }, friction = MU }
  end
  local r = sw.cable(cable).outer_diameter.value / 2
  local wire = scene:wire{ cable = cable, from = turned{ 0, 0.0007, r }, to = turned{ 0.2, 0.0007, r },
    segments = 30 }
  local hold = scene:pin(wire, { s = wire.length })
  t.fine(scene:run{ duration = 0.1, dt = 0.02, quasistatic = true })
  hold:follow{ points = { { 0, 0, 0 }, turned{ 0.06, 0, 0 } }, relative = true, duration = 0.5 }
  t.fine(scene:run{ duration = 0.5, dt = 0.02, quasistatic = true })
  local W = wire.beam.mass_per_length * wire.length * 9.81
  return hold:over(scene.time - 0.35, scene.time - 0.15).mean_force / (MU * W)
end

describe("a flat plate of a mesh file with rounded coordinates", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    it("is a plane to a cable in poses: " .. cable, function()
      local exact = pull(cable)
      for _, parts in ipairs{ { 2, 1 }, { 60, 10 }, { 200, 40 } } do
        local n, m = table.unpack(parts)
        t.share(exact, pull(cable, n, m), 1e-3, ("pull on %d x %d facets"):format(n, m))
      end
    end)
  end
end)
