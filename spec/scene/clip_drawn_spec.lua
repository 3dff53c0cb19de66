-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction on a wire that is drawn through a clip. Friction is mu N, with N = (1/W) integral of
-- |grad U| chi da over the clip's width W. Most of N is a couple that bends the wire: its forces cancel in
-- the clip's force. N of straight edges depended on where nodes lie, in proportion to (edge/W)^2: 31 % with
-- edges of W/2. N is now that of a beam with the clip's force and moment. What is left is the error of the
-- moment itself.
local sw = require "softworld"
local t = require "spec.physics.tools"

local LENGTH, WIDTH, GAP, WAY = 0.24, 0.008, 0.06, 0.001

-- Feeds a wire from a feed that moved `aside` through clips at `places`. Returns the largest and smallest
-- force of the feed over 12 mm, which are two or more edges, and the run.
local function drawn(o)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = o.cable, from = { 0, 0, 0 }, to = { LENGTH, 0, 0 },
    segments = o.segments }
  scene:force{ kind = "damping", on = wire, mass = 5, stiffness = 0.003 }
  for _, x in ipairs(o.places or { GAP }) do
    scene:clip{ at = { x + (o.shift or 0), 0, 0 }, width = WIDTH, insertion = o.lips or 8,
      retention = 3 * (o.lips or 8), friction = 0.2 }
  end
  if o.pull then scene:force{ kind = "point", on = wire, s = LENGTH, force = { o.pull, 0, 0.2 * o.pull } } end
  local feeder = scene:feed(wire, { s = 0 })
  local aside = o.across and { 0, o.aside, 0 } or { 0, 0, o.aside }
  feeder:follow{ points = { { 0, 0, 0 }, aside }, duration = 0.3, relative = true }
  local most, least = -math.huge, math.huge
  scene:process(function(p)
    p:wait(0.35)
    p:feed(feeder, { length = 0.005, speed = 0.05 })
    for _ = 1, 12 do
      p:feed(feeder, { length = WAY, speed = 0.05 })
      most, least = math.max(most, feeder:drive_force()), math.min(least, feeder:drive_force())
    end
  end)
  local run = scene:run{ dt = o.poses and 0.005 or 0.002, quasistatic = o.poses, frames = false }
  assert.is_true(run.ok)
  scene:close()
  return least, most, run
end

-- Both must be within `share` of the middle of those with edges of 1 mm.
local function same(o, share)
  local segments = o.segments
  o.segments = 240
  local low, high = drawn(o)
  o.segments = segments
  local least, most, run = drawn(o)
  local right = 0.5 * (low + high)
  local what = ("%d segments: %.4g to %.4g N, fine %.4g N"):format(segments, least, most, right)
  assert.is_true(math.abs(least - right) < share * math.abs(right), what)
  assert.is_true(math.abs(most - right) < share * math.abs(right), what)
  return run
end

describe("the friction on a wire that is drawn through a clip", function()
  for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
    -- The friction itself changes by 0.6 % over this way. The soft FLRY-B bends within edges of W/2.
    local coarse = cable == "FLRY-B 0.5" and 0.055 or 0.045
    it(("does not depend on edges of up to a half of its width: %s"):format(cable), function()
      for _, across in ipairs{ false, true } do
        same({ cable = cable, aside = 0.006, across = across, segments = 60, shift = 0.0007 },
          coarse)
        same({ cable = cable, aside = 0.006, across = across, segments = 90, shift = 0.0003 }, 0.017)
        same({ cable = cable, aside = 0.006, across = across, segments = 120 }, 0.012)
      end
    end)
  end

  it("is the same in poses", function()
    for _, segments in ipairs{ 60, 75, 120 } do
      same({ cable = "GXL 1.5", aside = 0.006, poses = true, segments = segments },
        segments == 60 and 0.02 or 0.01)
    end
  end)

  it("counts the bend that passes through a row of clips", function()
    local o = { cable = "GXL 1.5", aside = 0.004, places = { 0.05, 0.11, 0.17 }, lips = 80 }
    o.segments = 60
    same(o, 0.04)
    o.segments = 120
    same(o, 0.01)
  end)

  it("counts tension", function()
    same({ cable = "FLRY-B 0.5", aside = 0.004, places = { 0.05, 0.11, 0.17 }, lips = 80, pull = 40,
      segments = 120 }, 0.017)
    same({ cable = "GXL 1.5", aside = 0.004, places = { 0.05, 0.11, 0.17 }, lips = 80, pull = 20,
      segments = 120 }, 0.01)
  end)

  it("is told with edges over 0.6 of its width, if the clip's couple bends the wire", function()
    local _, _, run = drawn{ cable = "GXL 1.5", aside = 0.006, segments = 45 }
    local events = t.events(run, "edges")
    assert.is_true(#events > 0)
    assert.truthy(events[1].text:find(" in a clip of 8 mm", 1, true), events[1].text)
    _, _, run = drawn{ cable = "GXL 1.5", aside = 0.006, segments = 60 }
    assert.equal(0, #t.events(run, "edges"))
  end)
end)
