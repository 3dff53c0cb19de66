-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires without contact that pass through each other or through themselves: the event `through`.
local sw = require "softworld"
local t = require "spec.physics.tools"

local RADIUS, HIGH = 0.002, 0.03 -- of the wires; of the second above the first [m]

-- A wire in a plane goes down across another one, to `low` below it. o: ends of the upper wire, its way, a
-- function that edits the scene, how it runs. Returns the events and the scene.
local function lowered(o)
  local scene, points = sw.scene{ gravity = { 0, 0, 0 } }, { { 0, 0, 0 }, o.way or { 0, 0, -2 * HIGH } }
  local function wire(name, from, to)
    return scene:wire{ name = name, E = 50e6, density = 1500, radius = RADIUS, segments = 40, from = from,
      to = to }
  end
  local below = wire("below", { -0.2, 0, 0 }, { 0.2, 0, 0 })
  local above = wire("above", o.from or { 0, -0.2, HIGH }, o.to or { 0, 0.2, HIGH })
  for _, s in ipairs{ 0, below.length } do scene:clamp(below, { s = s }) end
  if o.back then points[3] = { 0, 0, 0 } end
  for _, s in ipairs{ 0, above.length } do
    scene:clamp(above, { s = s }):follow{ points = points, relative = true, duration = 0.6 }
  end
  if o.edit then o.edit(scene, below, above) end
  local run = scene:run{ duration = 0.7, dt = o.dt or 0.01, quasistatic = o.poses }
  t.fine(run)
  return t.events(run, "through"), run
end

describe("wires that meet without contact", function()
  it("are told of once they have passed, in motion and in poses, at any step", function()
    for _, how in ipairs{ { dt = 0.02 }, { dt = 0.002 }, { dt = 0.01, poses = true } } do
      local told = lowered(how)
      assert.equal(1, #told)
      t.near(0.2, told[1].s, 0.011, "its place: within an edge")
      assert.truthy(told[1].text:find("'below' and 'above'", 1, true))
    end
  end)

  -- At some of these steps both wires are exactly in a plane at a step's end, with nodes on each other.
  it("are told of askew, side by side, and where their nodes meet", function()
    for _, poses in ipairs{ false, true } do
      assert.equal(1, #lowered{ poses = poses, from = { 0.05, -0.2, HIGH }, to = { 0.031, 0.2, 0.04 },
        way = { 0.01, 0, -0.08 } })
      assert.equal(1, #lowered{ poses = poses, from = { -0.2, 0, HIGH }, to = { 0.2, 0, HIGH } })
      assert.equal(1, #lowered{ poses = poses, from = { 0.005, -0.2, HIGH }, to = { 0.005, 0.2, HIGH } })
    end
  end)

  it("are not told of if they only touch, or go by", function()
    assert.equal(0, #lowered{ way = { 0, 0, -HIGH }, back = true, poses = true }) -- into each other and back
    assert.equal(0, #lowered{ from = { 0.25, -0.2, HIGH }, to = { 0.25, 0.2, HIGH } }) -- beside its end
    assert.equal(0, #lowered{ way = { 0, 0, 2 * HIGH } })
  end)

  it("are not told of where contact keeps them apart, but are where it leaves them out", function()
    assert.equal(0, #lowered{ way = { 0, 0, -0.04 }, edit = function(scene) scene:wire_contact{} end })
    assert.equal(1, #lowered{ edit = function(scene, below) scene:wire_contact{ between = below } end })
  end)

  it("are told of if the scene is built anew while they are in each other", function()
    local function edit(scene)
      local other = scene:wire{ name = "other", E = 50e6, density = 1500, radius = RADIUS,
        from = { 1, 0, 0 }, to = { 1, 0.1, 0 }, segments = 4 }
      local hand = scene:clamp(other, { s = 0.05 })
      scene:process(function(p)
        p:wait(0.3) -- half way, when they are in a plane
        hand:release()
      end)
    end
    assert.equal(1, #lowered{ edit = edit })
  end)

  it("are told of one by one where a wire passes several at once", function()
    local function edit(scene)
      local more = scene:wire{ name = "more", E = 50e6, density = 1500, radius = RADIUS, segments = 40,
        from = { -0.2, 0.05, 0 }, to = { 0.2, 0.05, 0 } }
      for _, s in ipairs{ 0, more.length } do scene:clamp(more, { s = s }) end
    end
    local told = lowered{ edit = edit }
    assert.equal(2, #told)
    for k, name in ipairs{ "'below'", "'more'" } do
      assert.truthy(told[k].text:find(name, 1, true) or told[3 - k].text:find(name, 1, true))
    end
  end)

  it("make peaks of both wires OPEN", function()
    local _, run = lowered{}
    local check = run:check{ limits = { max_tension = { max = 1e9, sure = true } } }
    for _, name in ipairs{ "below", "above" } do
      local row = check:row(name .. ".max_tension")
      assert.equal("OPEN", row.verdict)
      assert.truthy(row.note:find("(event 'through')", 1, true), row.note)
    end
  end)
end)

-- Pulls a coil of two turns straight. Its writhe of 1.82 turns becomes twist (coil_pulled_spec). Where it
-- passes through itself, -0.18 turns are left. Returns what is left, and the events.
local function pulled(o)
  local scene, path = sw.scene{ gravity = { 0, 0, 0 } }, {}
  for i = -10, 130 do
    local u = math.min(math.max(i / 60, 0), 2)
    local z, a = math.min(2 * u, 4 - 2 * u, 1), 2 * math.pi * u
    local r = 0.03 * z ^ 3 * (10 - 15 * z + 6 * z * z)
    path[#path + 1] = { 0.02 * u + 0.005 * (i - 60 * u), r * math.cos(a), r * math.sin(a) }
  end
  local wire = scene:wire{ name = "coil", cable = o.cable or "GXL 1.5", segments = 40, path = path }
  if not o.poses then scene:force{ kind = "damping", on = wire, mass = 5 } end
  if o.contact then scene:wire_contact{ friction = 0 } end
  scene:clamp(wire, { s = 0, direction = { 1, 0, 0 } })
  local hand = scene:clamp(wire, { s = wire.length, direction = { 1, 0, 0 } })
  local way = 1.00002 * wire.length - (path[#path][1] - path[1][1])
  hand:follow{ points = { { 0, 0, 0 }, { way, 0, 0 } }, relative = true, duration = 1 }
  local run = scene:run{ duration = 1, dt = o.dt, quasistatic = o.poses }
  t.fine(run)
  return hand:moment().x * wire.length / (2 * math.pi * wire.beam.GJ), t.events(run, "through")
end

describe("a coil that is pulled straight", function()
  it("is told of where it passes through itself without contact, and not with it", function()
    for _, contact in ipairs{ false, true } do
      local turns, told = pulled{ contact = contact, dt = 0.002 }
      t.near(contact and 1.82 or -0.18, turns, 0.02, "turns of twist")
      assert.equal(not contact, #told > 0)
    end
  end)

  -- The search for rest throws the coil through itself, though a straight way leads by.
  it("is told of in poses, by its twist", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "H07V-K 4" } do
      local turns, told = pulled{ cable = cable, poses = true, dt = 0.05 }
      t.near(-0.18, turns, 0.02, "turns of twist")
      assert.equal(1, #told)
      assert.equal(1, told[1].value)
    end
    local turns, told = pulled{ contact = true, poses = true, dt = 0.05 }
    t.near(1.82, turns, 0.02, "turns of twist")
    assert.equal(0, #told)
  end)
end)
