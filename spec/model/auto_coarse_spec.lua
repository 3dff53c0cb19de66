-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto" where a cheap model and the next one agree on coarse edges only. A cable snaps into a clip:
-- on 8 edges poses and dynamics end alike; on 32 and more, friction holds it elsewhere after the snap. Cables
-- that are tied pass through each other without touches: on 6 and 12 edges touches hardly matter; from 24
-- edges on they do.
local sw = require "softworld"

local function distance(a, b)
  if type(a) == "number" then return math.abs(a - b) end
  return ((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2) ^ 0.5
end

-- Asserts that the true value lies within the bar, or within what the truth itself may be off.
local function holds(run, name, truth, off)
  local q = run.quantities[name]
  local is_near = distance(q.value, truth) <= q.error + off
  assert.is_true(is_near, ("%s = %s +- %.3g"):format(name, q:text(), q.error))
end

local STIFF = { E = 60e6, radius = 0.004, span = 0.17753318456863, force = 3.1938493866999,
  down = 0.047344989344687, share = 0.01 }
local SOFT = { E = 20e6, radius = 0.0025, span = 0.16131133910558, force = 1.1535811776084,
  down = 0.055550941100093, share = 0.1 }

-- The cable lies along x, or along y if turned.
local function clipped(c, turned)
  local scene, span = sw.scene { name = "clipped" }, c.span
  local function at(x, z) return turned and { 0, x, z } or { x, 0, z } end
  scene:clip { name = "clip", at = at(span / 2, 0), width = 0.01, insertion = c.force,
    retention = 3 * c.force, friction = 0.25,
    axis = turned and { 0, 1, 0 } or { 1, 0, 0 } }
  local w = scene:wire { name = "w", model = "auto", E = c.E, density = 1500, radius = c.radius,
    segments = 32, from = at(0, 0.035), to = at(span, 0.035) }
  for s, name in pairs { [0] = "left", [span] = "right" } do
    scene:clamp(w, { s = s, name = name }):follow { relative = true, duration = 1,
      points = { { 0, 0, 0 }, { 0, 0, -c.down } } }
  end
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 1, model = "auto", tolerance = { ["left.force"] = { relative = c.share },
    min_bend_radius = { relative = c.share } } }
end

describe("model = 'auto' where poses jump, and end elsewhere on fine edges", function()
  for _, turned in ipairs { false, true } do
    it(turned and "takes dynamics in the turned scene too" or "takes dynamics, and its bars hold", function()
      local run = clipped(STIFF, turned)
      assert.equal("dynamic", run.model.motion, tostring(run:why()))
      -- dynamics on 256 edges: 80.81 mm +- 0.08 mm; poses end at 82.12 mm
      holds(run, "min_bend_radius", 0.08081, 8e-5)
    end)
  end

  -- Compared on finer edges, poses leave out more than it seemed, but still less than is allowed.
  it("keeps poses, and shortens their bars by finer edges", function()
    local run = clipped(SOFT)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(run.met, tostring(run:why()))
    holds(run, "min_bend_radius", 0.02132, 8e-5) -- dynamics on 256 edges; poses end at 22.24 mm
  end)
end)

local function tied()
  local scene, r, length = sw.scene { name = "tied" }, 0.0025, 0.5
  local wide, before = 2.5 * r, nil
  for k = 1, 3 do
    local y = (k - 1) * wide
    local w = scene:wire { name = "w" .. k, model = "auto", E = 5e6, density = 1500, radius = r,
      from = { 0, y, 0 }, to = { length, y, 0 }, segments = 24 }
    scene:clamp(w, { s = 0, name = "near" .. k })
    scene:clamp(w, { s = length, name = "far" .. k }):follow { relative = true, duration = 4,
      points = { { 0, 0, 0 }, { -0.051651506115935, k == 3 and 0.056561674378897 or 0,
        k == 3 and 0.036591986520299 or 0 } } }
    if before then scene:tie(w, { s = length / 2, to = { before, s = length / 2 }, slack = wide }) end
    before = w
  end
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 4, model = "auto", tolerance = { ["near1.force"] = { relative = 0.03 },
    ["far3.force"] = { relative = 0.03 } } }
end

describe("model = 'auto' where wires pass through each other", function()
  it("compares touches on all coarse levels", function()
    local run = tied()
    assert.equal("wires", run.model.contact, tostring(run:why()))
    -- poses with touches on 192 edges; their bars are 1 and 0.6 mN. Without touches the forces are 9 and 6 mN
    -- off.
    holds(run, "far3.force", { 0.1587, 0.02929, 0.1510 }, 1e-3)
    holds(run, "near1.force", { -0.02603, -0.008267, 0.06130 }, 6e-4)
  end)
end)
