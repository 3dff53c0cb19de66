-- SPDX-License-Identifier: GPL-3.0-or-later
-- A cable on the floor of a tube is drawn back by its weight m g: a shift y to a side meets m g y/c per
-- length, c the play R - r. So it buckles under 2 (EI m g/c)^0.5 (Dawson and Paslay), not under the load of
-- Euler's strut, which is 25 times smaller here. No event doubts a cable that stays straight below that.
local sw = require "softworld"
local t = require "physics.tools"

local c, T = 8e-3, 3e-3 -- play and wall of the tube [m]

-- Writes a tube along x from x0 to x1 as a mesh with n flat facets; a facet is its floor. R: of the bore [m].
local function tube(name, R, x0, x1, n)
  local out, rows = assert(io.open(name, "w")), {}
  for ring = 0, 3 do
    local x, r = ring % 3 == 0 and x0 or x1, (ring < 2 and R or R + T) / math.cos(math.pi / n)
    for i = 0, n - 1 do
      local a = 2 * math.pi * (i + 0.5) / n
      out:write(("v %.12g %.12g %.12g\n"):format(x, r * math.sin(a), -r * math.cos(a)))
    end
  end
  for ring = 0, 3 do
    for i = 0, n - 1 do
      local a, b = ring * n + i + 1, ring * n + (i + 1) % n + 1
      local d, e = (ring + 1) % 4 * n + i + 1, (ring + 1) % 4 * n + (i + 1) % n + 1
      rows[#rows + 1] = ("f %d %d %d\nf %d %d %d\n"):format(a, e, b, a, d, e)
    end
  end
  out:write(table.concat(rows))
  out:close()
end

-- Pushes a cable along the tube by `times` its buckling load, or by `way` [m]. o: cable, length [m],
-- segments, quasistatic; wave: of the drawn cable, as height over play and wavenumber [1/m]; turn: of the
-- scene [rad]; half: the tube ends in the cable's middle, the rest lies on a table. Returns the push over the
-- buckling load, the events, and the buckling load over Euler's.
local function pushed(o)
  local turn, r, name = o.turn or 0, sw.cable(o.cable).outer_diameter.value / 2, os.tmpname()
  local scene, q = sw.scene{ gravity = t.turned({ 0, 0, -9.81 }, turn) }, math.sin(turn / 2) / 3
  tube(name .. ".obj", r + c, -0.1, (o.half and 0.5 or 1) * o.length + 0.1, 96)
  scene:obstacle{ shape = "mesh", file = name .. ".obj", friction = 0,
    rotation = { math.cos(turn / 2), q, 2 * q, 2 * q } }
  os.remove(name)
  os.remove(name .. ".obj")
  if o.half then scene:obstacle{ shape = "plane", at = { 0, 0, -r - c }, friction = 0 } end
  local path, wave = {}, o.wave or { 0, 0 }
  for i = 0, 200 do
    local x = o.length * i / 200
    path[i + 1] = t.turned({ x, wave[1] * c * math.sin(wave[2] * x), -c }, turn)
  end
  local wire = scene:wire{ name = "w", cable = o.cable, path = path, segments = o.segments }
  local beam = wire.beam
  local load = 2 * math.sqrt(beam.EI * beam.mass_per_length * 9.81 / c)
  local euler = 4 * math.pi ^ 2 * beam.EI / o.length ^ 2
  local way = o.way or o.times * load * wire.length / beam.EA
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = wire.length })
  scene:force{ kind = "damping", mass = 4, stiffness = 0.003 }
  hand:follow{ points = { { 0, 0, 0 }, t.turned({ -way, 0, 0 }, turn) }, relative = true,
    duration = 1, law = "linear" }
  local run = scene:run{ duration = 1, dt = 0.02, quasistatic = o.quasistatic }
  t.fine(run)
  local f = hand:force()
  return t.norm{ f.x, f.y, f.z } / load, t.events(run, "buckling"), load / euler
end

local stiff = { cable = "H07V-K 4", length = 2, segments = 100 }
local soft = { cable = "FLRY-B 0.5", length = 1.5, segments = 90 }

local function with(o, more)
  local all = {}
  for _, list in ipairs{ o, more } do
    for k, v in pairs(list) do all[k] = v end
  end
  return all
end

describe("a cable on the floor of a tube", function()
  for _, turn in ipairs{ 0, 0.7 } do
    it(("bears more than Euler's load, without an event: turned by %g"):format(turn), function()
      for _, o in ipairs{ stiff, soft } do
        local push, told, more = pushed(with(o, { times = 0.8, turn = turn }))
        -- measured 0.8024. Before, an event: unstable under 0.73 N (H07V-K 4; right: 0.92 N).
        t.share(0.8, push, 0.02, "push over the buckling load")
        t.above(5, more, "buckling load over Euler's")
        assert.equal(0, #told, told[1] and told[1].text)
      end
    end)
  end

  it("buckles at Dawson-Paslay's load if it is drawn a little wavy, without an event", function()
    for _, o in ipairs{ with(stiff, { wave = { 3e-3, 8.5 } }), with(soft, { wave = { 3e-3, 18 } }) } do
      local push, told = pushed(with(o, { way = 4e-4, quasistatic = true }))
      -- measured 1.12, and 1.00 to 1.06 as the waves begin; with the waves' height the push rises, up to
      -- 2^0.5 where they become a helix. Before, an event: buckles under 0.035 N at most (H07V-K 4).
      t.above(1, push, "push over the buckling load")
      t.below(1.3, push, "push over the buckling load")
      assert.equal(0, #told, told[1] and told[1].text)
    end
  end)

  it("is told of if it stays straight under more", function()
    local push, told = pushed(with(stiff, { times = 3 }))
    t.above(0, push, "push over the buckling load")
    assert.equal(1, #told)
    -- a bend grows for a while before the cable has left its line: measured 1.81 N, the load is 0.92 N
    t.above(0.92, told[1].value, "push of the event [N]")
  end)

  it("is told of if half of it lies on a table", function()
    local _, told = pushed(with(stiff, { times = 0.8, half = true }))
    assert.equal(1, #told)
  end)
end)
