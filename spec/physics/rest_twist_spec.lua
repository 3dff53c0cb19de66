-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that are twisted when unloaded. Between two clamps the torque is GJ (turn / L - rest_twist), with
-- and without material frames. Also unwinding through a free end, and feeding.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local EI, GJ, rest = 3e-3, 2e-3, 1.7
local kinds = {
  plain = {},
  framed = { EI = { EI, 1.5 * EI }, normal = { 0, 1, 0 } },
}

local function make(kind, options)
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local args = { EA = 1e5, EI = EI, GJ = GJ, mass_per_length = 0.03, radius = 0.002, segments = 20,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, rest_twist = rest }
  for k, v in pairs(kinds[kind]) do args[k] = v end
  for k, v in pairs(options or {}) do args[k] = v end
  if args.path then args.from, args.to = nil, nil end
  return scene, scene:wire(args)
end

local function turn(clamp, angle)
  clamp:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = angle },
    duration = 1, relative = true }
end

for kind in pairs(kinds) do
  describe("a wire twisted at rest, " .. kind, function()
    it("has the torque GJ (turn / L - rest_twist) between two clamps", function()
      local scene, wire = make(kind)
      local left, right = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = 1 })
      t.fine(scene:settle())
      t.share(-GJ * rest, right:moment()[1], 1e-9, "moment as drawn")
      t.share(0.5 * GJ * rest ^ 2, scene:energy().twist or scene:energy().frame, 1e-9, "energy")
      for _, angle in ipairs { 1, 3 } do
        turn(right, angle - (angle == 3 and 1 or 0))
        t.fine(scene:run { duration = 1, dt = 0.1, quasistatic = true })
        local torque = GJ * (angle - rest)
        t.share(torque, right:moment()[1], 1e-9, "moment")
        t.share(-torque, left:moment()[1], 1e-9, "moment at the other end")
        t.share(torque, wire:twist_moment(0.4), 1e-9, "torque")
        t.share(0.5 * torque ^ 2 / GJ, scene:energy().twist or scene:energy().frame, 1e-9, "energy")
      end
    end)

    it("unwinds through a free end before it is held there", function()
      local scene, wire = make(kind)
      scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      local right = scene:clamp(wire, { s = 1 })
      t.fine(scene:settle())
      t.near(0, right:moment()[1], 1e-9, "moment")
      turn(right, 0.5)
      t.fine(scene:run { duration = 1, dt = 0.1, quasistatic = true })
      t.share(GJ * 0.5, right:moment()[1], 1e-6, "moment")
    end)

    it("stays as drawn until something moves, after reading and snapshots too", function()
      local scene, wire = make(kind)
      local before = scene:snapshot()
      assert.are.equal(0, wire:position(0)[1]) -- reading is not a motion
      for _ = 1, 2 do
        local right = scene:clamp(wire, { s = 1 })
        scene:clamp(wire, { s = 0 })
        t.fine(scene:settle())
        t.share(-GJ * rest, right:moment()[1], 1e-9, "moment")
        scene:restore(before)
      end
      t.fine(scene:settle()) -- free: it unwinds
      local right = scene:clamp(wire, { s = 1 })
      scene:clamp(wire, { s = 0 })
      t.fine(scene:settle())
      t.near(0, right:moment()[1], 1e-8, "moment after unwinding")
    end)

    it("brings its rest twist along from the spool", function()
      local scene, wire = make(kind)
      local feed, clamp = scene:feed(wire), scene:clamp(wire, { s = 1 })
      t.fine(scene:settle())
      feed:feed { length = 0.2, duration = 1 }
      clamp:follow { points = { { 0, 0, 0 }, { 0.2, 0, 0 } }, duration = 1, relative = true }
      t.fine(scene:run { duration = 1, dt = 0.05, quasistatic = true })
      t.share(-GJ * rest, clamp:moment()[1], 1e-6, "moment") -- no turn, over any length
      turn(clamp, 2)
      t.fine(scene:run { duration = 1, dt = 0.1, quasistatic = true })
      t.share(GJ * (2 / 1.2 - rest), clamp:moment()[1], 1e-6, "moment after turning")
    end)
  end)
end

describe("rest_twist", function()
  -- The path stays the shape without load; the material turns about it along the way. Drawn untwisted, its
  -- bend does not fit; with a free end the wire returns to the path.
  it("with rest = 'path' leaves the path as the shape without load", function()
    local k, points = 5, {}
    for i = 0, 400 do
      local a = k * i / 400
      points[i + 1] = { math.sin(a) / k, 0, (1 - math.cos(a)) / k }
    end
    local scene, wire = make("plain", { path = points, rest = "path", rest_twist = 4, segments = 40 })
    scene:clamp(wire, { s = 0 })
    local drawn, energy = wire:positions(), scene:energy().total
    t.above(0.5 * GJ * 4 ^ 2 * 0.9, energy, "energy as drawn")
    t.fine(scene:settle())
    t.below(1e-9 * energy, scene:energy().total, "energy at rest")
    t.below(1e-6, t.largest_difference(drawn, wire:positions()), "off the path by")
  end)

  it("refuses impossible values", function()
    local function refused(words, options)
      local ok, message = pcall(make, "plain", options)
      assert.is_false(ok)
      assert.truthy(message:find(words, 1, true), message)
    end
    refused("rest_twist = ", { rest_twist = 0 / 0 })
    refused("rest_twist = inf rad/m", { rest_twist = 1 / 0 })
    refused("model = 'rod'", { model = "string" })
    refused("did you mean 'rest_twist'", { rest_twst = 1 })
    refused("needs more segments", { rest_twist = 40, normal = { 0, 1, 0 }, EI = { EI, 2 * EI } })
  end)
end)
