-- SPDX-License-Identifier: GPL-3.0-or-later
-- Turns about a given centre: what moves goes round it, x(t) = c + d(t) + R(t) (x0 - c), with R the turn
-- and d the way-points.
local sw = require "softworld"

local function near(expected, got, tolerance)
  for k = 1, 3 do assert.near(expected[k], got[k], tolerance) end
end

-- A turn by 2 rad about the line through (0.1, 0, 0) along z, with a rise of 0.3 m: a screw.
local function screw(position)
  return sw.trajectory{ turn = { axis = { 0, 0, 1 }, angle = 2 }, about = { 0.1, 0, 0 }, duration = 1,
    points = { { 0, 0, 0 }, { 0, 0, 0.3 } }, relative = true }:placed(position, { 1, 0, 0, 0 })
end

describe("a turn about a centre", function()
  it("leads round it, and along the way-points", function()
    local t = screw{ 0.3, 0, 0.2 }
    for _, time in ipairs{ 0, 0.2, 0.5, 0.9, 1, 2 } do
      local part = t:rotation(time) -- about z: w = cos(a/2), z = sin(a/2)
      local a = 2 * math.atan(part[4], part[1])
      near({ 0.1 + 0.2 * math.cos(a), 0.2 * math.sin(a), 0.2 + 0.15 * a }, t:position(time), 1e-15)
    end
  end)

  it("has exact velocities and accelerations", function()
    local t, h = screw{ 0.3, 0.1, 0 }, 1e-4
    for _, time in ipairs{ 0.1, 0.37, 0.5, 0.8 } do
      local before, at, after = t:position(time - h), t:position(time), t:position(time + h)
      local v, a = {}, {}
      for k = 1, 3 do
        v[k] = (after[k] - before[k]) / (2 * h)
        a[k] = (after[k] - 2 * at[k] + before[k]) / h ^ 2
      end
      -- differences err by h^2/6 of the third derivative, here below 100 m/s3, and by rounding, 1e-16/h^2
      near(v, t:velocity(time), 1e-6)
      near(a, t:acceleration(time), 1e-5)
    end
  end)

  it("moves a hold on a circle, and the wire with it", function()
    for _, axis in ipairs{ { 0, 0, 1 }, { 0, 1, 0 }, { 1, 1, 0 } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0.1, 0, 0 }, to = { 0.3, 0, 0 }, segments = 20 }
      local hold = scene:clamp(wire, { s = 0 })
      hold:follow{ turn = { axis = axis, angle = math.pi }, about = { 0, 0, 0.02 }, duration = 1 }
      assert.is_true(scene:run{ duration = 1.5 }.ok)
      local n = math.sqrt(axis[1] ^ 2 + axis[2] ^ 2 + axis[3] ^ 2)
      local x, along = { 0.1, 0, -0.02 }, 0 -- half a turn: 2 (x.n) n - x
      for k = 1, 3 do along = along + x[k] * axis[k] / n end
      local wanted = {}
      for k = 1, 3 do wanted[k] = 2 * along * axis[k] / n - x[k] + (k == 3 and 0.02 or 0) end
      near(wanted, (hold:pose()), 1e-14)
      near(wanted, wire:position(0), 1e-12)
    end
  end)

  it("moves a gripper, by move and by rotate", function()
    for _, method in ipairs{ "move", "rotate" } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0.1, 0, 0 }, to = { 0.3, 0, 0 }, segments = 20 }
      local hand, turn = scene:gripper{}, { axis = { 0, 0, 1 }, angle = math.pi / 2 }
      scene:process(function()
        hand:grasp(wire, { s = 0 })
        hand[method](hand, method == "move" and { turn = turn, about = { 0, 0, 0 }, angular_speed = 2 }
          or { axis = turn.axis, angle = turn.angle, about = { 0, 0, 0 }, angular_speed = 2 })
      end)
      assert.is_true(scene:run().ok)
      near({ 0, 0.1, 0 }, hand:position(), 1e-14)
    end
  end)

  it("is in files and in scripts of a scene", function()
    local function make()
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ E = 1e8, density = 1000, radius = 0.002, segments = 8,
        from = { 0.1, 0, 0 }, to = { 0.2, 0, 0 } }
      scene:clamp(wire, { s = 0, name = "tip" }):follow{ turn = { axis = { 0, 0, 1 }, angle = 2 },
        about = { 0, 0.01, 0 }, duration = 1 }
      return scene, wire
    end
    local path = os.tmpname()
    local whole, wire = make()
    whole:run{ duration = 0.5 }
    whole:run{ duration = 0.5 }
    local first = make()
    first:run{ duration = 0.5 }
    first:save(path)
    local second = sw.load(path)
    second:run{ duration = 0.5 }
    assert.same(wire:positions(), second:find "wire1":positions())
    first = make()
    first:script(path)
    local again = dofile(path)
    os.remove(path)
    again:run{ duration = 0.5 }
    again:run{ duration = 0.5 }
    assert.same(wire:positions(), again:find "wire1":positions())
  end)

  it("needs a turn, displacements and a place", function()
    local turn = { axis = { 0, 0, 1 }, angle = 1 }
    for text, given in pairs{
      ["about needs a turn, or way%-points with rotations"] = { relative = true,
        points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 1, about = { 0, 0, 0 } },
      ["about needs way%-points that are displacements"] = { turn = turn, duration = 1,
        points = { { 0, 0, 0 }, { 1, 0, 0 } }, about = { 0, 0, 0 } },
      ["about, item 3, must be a number %[m%], got nil"] = { turn = turn, duration = 1, about = { 0, 0 } },
      ["about has no use with func"] = { func = function() return { 0, 0, 0 } end, about = { 0, 0, 0 } },
      ["did you mean 'about'"] = { turn = turn, duration = 1, abuot = { 0, 0, 0 } },
    } do
      local fine, message = pcall(sw.trajectory, given)
      assert.is_false(fine)
      assert.truthy(message:find(text), message)
    end
  end)
end)
