-- SPDX-License-Identifier: GPL-3.0-or-later
-- Lines that touch something get other edges by a remodel. Nothing moves then, so what they touch bears what
-- it bore: a rod under a cantilever that hardly presses on it, a box's edge under a taut cable. With the
-- fault nodes that stayed kept the force of their former edges, new ones had none, and new chords were pushed
-- out: the rod bore 0.046 N instead of 0.024, the box's edge 5.23 N instead of 4.60 (FLRY-B 0.5).
local sw = require "softworld"
local t = require "spec.physics.tools"

-- A cantilever that lies on a rod [N].
local function on_rod(segments, later)
  local scene = sw.scene{}
  local w = scene:wire{ E = 4.75e7, density = 1400, radius = 0.003, segments = segments,
    from = { 0, 0, 0.02 }, to = { 0.3, 0, 0.02 } }
  scene:clamp(w, { s = 0 })
  local rod = scene:obstacle{ shape = "cylinder", radius = 0.02, length = 0.1, at = { 0.2, 0, -0.05 },
    rotation = { axis = { 1, 0, 0 }, angle = 1.57 } }
  scene:run{ duration = 0.05, quasistatic = true, max_steps = 1 }
  if later then
    scene:run{ duration = 0.02, dt = 1e-4 }
    w:remodel{ model = "rod", segments = later }
  end
  t.fine(scene:run{ duration = 0.02, dt = 1e-4 })
  return math.abs(rod:force()[3]), w:position(0.3)[3]
end

-- A cable that is drawn over the edge of a box by 3 N.
local function over_edge(cable, later)
  local scene, r = sw.scene{}, sw.cable(cable).outer_diameter.value / 2
  local box = scene:obstacle{ shape = "box", size = { 0.3, 0.2, 0.1 }, at = { 0, 0, -0.05 }, friction = 0.3 }
  local points = { { -0.1, 0, r }, { 0.15, 0, r } }
  for k = 1, 3 do
    local a, out = k * math.pi / 8, r * (k == 2 and 1.15 or 1.1)
    points[#points + 1] = { 0.15 + out * math.sin(a), 0, out * math.cos(a) }
  end
  points[#points + 1], points[#points + 2] = { 0.15 + r, 0, 0 }, { 0.15 + r, 0, -0.3 }
  local w = scene:wire{ cable = cable, segments = 150, path = points }
  scene:clamp(w, { s = 0 })
  scene:force{ kind = "point", on = w, s = w.length, force = { 0, 0, -3 } }
  scene:force{ kind = "damping", mass = 8 }
  local out = {}
  scene:process(function(p)
    p:wait(0.6)
    if later then w:remodel{ model = "rod", segments = later } end
    p:wait(0.35)
    out.force = t.norm(box:force())
  end)
  local run = t.fine(scene:run{ dt = 0.002 })
  return out.force, run:ledger().gained / run:ledger().play
end

-- A wire lies on a table without friction and damping brings it to rest; height of its end [m].
local function lying(segments, later)
  local scene, r = sw.scene{}, 0.0025
  scene:obstacle{ shape = "plane", friction = 0 }
  local w = scene:wire{ E = 5e6, density = 1500, radius = r, from = { 0, 0, r }, to = { 0.4, 0, r },
    segments = segments }
  scene:clamp(w, { s = 0 })
  scene:force{ kind = "damping", mass = 5 }
  scene:settle()
  if not later then return w:position(0.4)[3] end
  w:remodel{ model = "rod", segments = later }
  t.fine(scene:run{ duration = 4, dt = 0.02 })
  return w:position(0.4)[3]
end

describe("a line that touches something and gets other edges", function()
  it("presses on a rod as one that always had them", function()
    local right, height = on_rod(24)
    local force, z = on_rod(15, 24)
    t.share(right, force, 0.02, "force on the rod [N]")
    t.near(height, z, 1e-5, "height of its end [m]") -- it was 26 um lower; 15 edges hang 25 um higher
  end)

  it("presses on the edge of a box as before", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
      local right, usual = over_edge(cable)
      for _, segments in ipairs{ 75, 101, 197 } do
        local force, gained = over_edge(cable, segments)
        local what = ("%s, %d segments"):format(cable, segments)
        t.share(right, force, 0.012, "force on the edge [N]: " .. what)
        t.below(usual + 1e-5, gained, "energy from nowhere: " .. what)
      end
    end
  end)

  -- The depth of a touch is its force over its stiffness, so edges twice as long are twice as deep.
  it("lies as one that always had them", function()
    local r = 0.0025
    t.share(r - lying(12), r - lying(24, 12), 0.01, "depth of its end, 24 to 12 edges")
    t.share(r - lying(24), r - lying(12, 24), 0.01, "depth of its end, 12 to 24 edges")
  end)
end)
