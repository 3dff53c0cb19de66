-- SPDX-License-Identifier: GPL-3.0-or-later
-- Channels: troughs of mitred prisms; wires in them, forces, friction, the lid, refusals.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local WIDTH, DEPTH, WALL, R = 0.012, 0.01, 0.0015, 0.002

local function bent(options)
  local o = options or {}
  local scene = sw.scene{ gravity = o.gravity }
  local duct = scene:channel{ name = "duct",
    points = o.points or { { -0.01, 0, 0 }, { 0.2, 0, 0 }, { 0.2, 0.2, 0 } },
    width = WIDTH, depth = DEPTH, thickness = WALL, friction = o.friction or 0.2, lid = o.lid, up = o.up }
  local wire = scene:wire{ name = "w", E = 2e7, density = 1500, radius = R, segments = 60,
    path = o.path or { { 0, 0, o.z or 0.005 }, { 0.2, 0, o.z or 0.005 }, { 0.2, 0.18, o.z or 0.005 } },
    rest = "path", model = o.model }
  scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 1e-3 }
  return scene, wire, duct
end

describe("a channel", function()
  it("bears the weight of a wire that lies round its corner", function()
    local scene, wire, duct = bent()
    t.fine(scene:run{ duration = 1, dt = 5e-3 })
    local weight = wire.beam.mass_per_length * wire.length * 9.81
    t.share(-weight, duct:force()[3], 1e-3, "force on it")
    t.near(1, duct:contains(wire), 0, "share of the wire in it")
    for k = 0, 20 do
      t.near(R, wire:position(wire.length * k / 20)[3], 5e-5, "height over its floor")
    end
    -- moment about the channel's first point: weight times lever of the centre of mass
    local p = { 0, 0 }
    for k = 1, 2000 do
      local q = wire:position(wire.length * (k - 0.5) / 2000)
      p[1], p[2] = p[1] + (q[1] + 0.01) / 2000, p[2] + q[2] / 2000
    end
    local m = duct:moment()
    t.near(-weight * p[2], m[1], 2e-3 * weight * 0.2, "moment about x")
    t.near(weight * p[1], m[2], 2e-3 * weight * 0.2, "moment about y")
  end)

  it("keeps a wire between its walls, at the corner too", function()
    for _, push in ipairs{ { 0, 2, 0 }, { 0, -2, 0 }, { 2, 0, 0 }, { -2, 0, 0 } } do
      local scene, wire, duct = bent{ lid = true }
      assert.is_true(duct.closed)
      scene:force{ kind = "line", on = wire, force = push }
      t.fine(scene:run{ duration = 0.5, dt = 2e-3 })
      local f = duct:force()
      t.share(t.norm(push) * wire.length, math.abs(f[1] * push[1] + f[2] * push[2]) / t.norm(push), 0.05,
        "force on the walls")
      local x = wire:positions()
      for k = 1, #x, 3 do
        local p = { x[k], x[k + 1] }
        local inside = math.abs(p[2]) < WIDTH / 2 - R + 1e-4 and p[1] < 0.2 + WIDTH / 2
          or math.abs(p[1] - 0.2) < WIDTH / 2 - R + 1e-4 and p[2] > -WIDTH / 2
        -- the wire may slide out of the legs' ends
        assert.is_true(inside, ("(%.4f, %.4f) is not inside"):format(p[1], p[2]))
      end
    end
  end)

  -- Neighbouring legs share the corner points of floor and walls; the mitres lie in the bisecting plane.
  it("closes at its corners", function()
    local _, _, duct = bent{ points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.15, 0.08, 0 }, { 0.15, 0.2, 0.02 } } }
    local function vertices(part)
      local list = part.shape:triangles()
      local points = {}
      for i = 1, #list, 3 do points[#points + 1] = { list[i], list[i + 1], list[i + 2] } end
      return points
    end
    for k = 1, 3 do -- floor, left, right
      for leg = 1, 2 do
        local a, b, shared = vertices(duct.parts[3 * (leg - 1) + k]), vertices(duct.parts[3 * leg + k]), 0
        for _, p in ipairs(a) do
          for _, q in ipairs(b) do
            if t.distance(p, q) < (leg == 1 and 1e-9 or 2e-3) then shared = shared + 1 end
          end
        end
        t.above(4, shared, ("points that parts %d of legs %d and %d share"):format(k, leg, leg + 1))
      end
    end
  end)

  it("has a lid that holds wires in, does not close on a wire that stands out, and comes off", function()
    local scene, wire, duct = bent{ z = DEPTH }
    local parts = #scene:run{ duration = 0.01, dt = 5e-3, frame = 0.01 }:document().obstacles
    local ok, message = pcall(duct.close, duct)
    assert.is_false(ok)
    assert.is_truthy(message:find "channel 'duct': wire 'w' stands out by 0.00[12]%d* m at s = 0 m")
    assert.is_false(duct.closed)
    assert.are.equal(parts, #scene:run{ duration = 0.01, dt = 5e-3, frame = 0.01 }:document().obstacles)
    t.fine(scene:run{ duration = 0.5, dt = 5e-3 })
    duct:close()
    assert.is_true(duct.closed)
    scene:gravity{ 0, 0, 9.81 }
    t.fine(scene:run{ duration = 0.5, dt = 5e-3 })
    local weight = wire.beam.mass_per_length * wire.length * 9.81
    t.share(weight, duct:force()[3], 1e-3, "pull on the lid")
    t.near(1, duct:contains(wire), 0, "share")
    local snapshot = scene:snapshot()
    duct:open()
    assert.is_false(duct.closed)
    t.fine(scene:run{ duration = 0.1, dt = 5e-3 })
    t.below(0.9, duct:contains(wire), "share without the lid")
    scene:restore(snapshot)
    assert.is_true(duct.closed)
    t.near(1, duct:contains(wire), 0, "share")
    t.fine(scene:run{ duration = 0.05, dt = 5e-3 })
    t.share(weight, duct:force()[3], 1e-3, "pull on the lid")
    duct:open()
    duct:close()
    assert.is_true(duct.closed)
  end)

  it("lies the way that up says", function()
    local scene, wire, duct = bent{ up = { 0, 0, -1 }, gravity = { 0, 0, 9.81 }, z = -0.005 }
    t.fine(scene:run{ duration = 0.5, dt = 5e-3 })
    t.near(1, duct:contains(wire), 0, "share")
    t.share(wire.beam.mass_per_length * wire.length * 9.81, duct:force()[3], 1e-3, "force")
  end)

  it("exerts friction mu m g on a straight wire that slides in it", function()
    local scene = sw.scene{}
    local wire = scene:wire{ E = 1e9, density = 1500, radius = R, from = { 0.02, 0, R }, to = { 0.12, 0, R },
      segments = 20 }
    scene:channel{ points = { { 0, 0, 0 }, { 0.3, 0, 0 } }, width = WIDTH, depth = DEPTH, friction = 0.3 }
    t.fine(scene:run{ duration = 0.1, dt = 2e-3 })
    scene:force{ kind = "line", on = wire,
      force = { 2 * 0.3 * wire.beam.mass_per_length * 9.81, 0, 0 } }
    t.fine(scene:run{ duration = 0.1, dt = 1e-3 })
    t.share(0.3 * 9.81 * 0.1, wire:velocity(0.05)[1], 0.02, "speed") -- a = mu g
  end)

  it("is in the summary and in pictures, and can be released", function()
    local scene, wire, duct = bent{ lid = true }
    local run = t.fine(scene:run{ duration = 0.05, dt = 5e-3, frame = 0.05 })
    local document = run:document()
    assert.are.equal(8, #document.obstacles) -- three parts and a lid for each of two legs
    assert.are.equal(0.7, document.obstacles[8].transparency)
    local text = require "softworld.output.summary".text(document)
    assert.is_truthy(text:find("duct: share of 'w' in it", 1, true))
    assert.is_truthy(tostring(duct):find "of 2 legs")
    duct:release()
    assert.has_error(function() duct:force() end,
      "channel 'duct' was released, or taken back when a snapshot was restored")
    t.fine(scene:run{ duration = 0.2, dt = 5e-3 })
    t.below(-0.1, wire:position(0.1)[3], "height of the wire without it")
  end)

  -- With two wires in it, force(wire) was the force of both.
  it("refuses a wire where it answers for all", function()
    local _, wire, duct = bent()
    for verb, why in pairs{ force = "it is the force of all wires", close = "it puts the whole lid on",
      open = "it takes the whole lid off" } do
      local ok, text = pcall(duct[verb], duct, wire)
      assert.is_false(ok)
      local wanted = ("channel:%s takes no argument, got a wire; %s"):format(verb, why)
      assert.is_truthy(text:find(wanted, 1, true), text)
    end
  end)

  it("refuses invalid arguments, naming them", function()
    local function refused(message, args)
      local scene = sw.scene{}
      local a = { name = "d", points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.1, 0.1, 0 } }, width = 0.01,
        depth = 0.01 }
      for k, v in pairs(args) do a[k] = v end
      local ok, text = pcall(scene.channel, scene, a)
      assert.is_false(ok)
      assert.is_truthy(text:find(message, 1, true), text)
      for k in pairs(args) do a[k] = nil end
      a.points, a.width, a.depth = { { 0, 0, 0 }, { 0.1, 0, 0 } }, 0.01, 0.01
      assert.are.equal("d", scene:channel(a).name) -- nothing was left behind
    end
    refused("channel 'd': width = a boolean is not allowed; it must be a number at least 1e-06 m and at most"
      .. " 1000 m", { width = false })
    refused("channel 'd': depth = -1 m is not allowed", { depth = -1 })
    refused("channel 'd': points is required, a list of at least two", { points = { { 0, 0, 0 } } })
    refused("channel 'd': points[2] must be a table of 3 finite numbers",
      { points = { { 0, 0, 0 }, { 1, 2 } } })
    refused("channel 'd': points has 3 items, but item 2 is nil",
      { points = { { 0, 0, 0 }, nil, { 1, 0, 0 } } })
    local far = { { 0, 0, 0 }, { 1, 0, 0 } }
    far[9] = { 2, 0, 0 }
    refused("channel 'd': points has 9 items, but item 3 is nil", { points = far })
    refused("channel 'd': points 1 and 2 are the same", { points = { { 0, 0, 0 }, { 0, 0, 0 } } })
    refused("channel 'd': leg 1 is parallel to up", { points = { { 0, 0, 0 }, { 0, 0, 1 } } })
    refused("meet at 180 degrees", { points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 0, 0 } } })
    refused("leg 2 is too short for the bends", { points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.1, 0.005, 0 },
      { 0, 0.005, 0 } } })
    refused("there is no parameter 'widht'; did you mean 'width'?", { widht = 1 })
    refused("channel 'd': lid must be true or false, got 1", { lid = 1 })
    refused("restitution = 2 is not allowed", { restitution = 2 })
  end)
end)
