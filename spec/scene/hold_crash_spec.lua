-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that grips, clamps or feeds drive into obstacles: nothing stops these holds, so events report it.
local sw = require "softworld"
local t = require "physics.tools"

local function new_scene(options)
  options = options or {}
  local scene = sw.scene{}
  scene:obstacle{ name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, options.z or 0.1 },
    to = { 0.4, 0, options.z or 0.1 }, segments = 40 }
  return scene, wire
end

local function of_kind(list, kind)
  local found = {}
  for _, e in ipairs(list) do if e.kind == kind then found[#found + 1] = e end end
  return found
end

-- A gripper that moves its wire by way [m].
local function gripped(way, options)
  local scene, wire = new_scene(options)
  if options.add then options.add(scene) end
  local hand = scene:gripper{ name = "hand", on_crash = options.on_crash }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.2 })
    hand:move{ by = way, speed = options.speed or 0.2 }
    p:wait(0.05)
  end)
  local run = scene:run{ dt = options.dt, quasistatic = options.quasistatic }
  return run, hand, scene, wire
end

describe("an imposed grip", function()
  it("driven into a table gives an event of the run and of the gripper", function()
    local run, hand, _, wire = gripped({ 0, 0, -0.15 }, {})
    local crashes = of_kind(run.events, "crash")
    assert.equal(1, #crashes)
    local e = crashes[1]
    assert.equal("hand", e.object)
    t.near(0.2, e.s, 1e-3, "place")
    t.near(0.05 + wire.radius, e.value, 1e-9, "depth")
    assert.is_truthy(e.text:find("'table'", 1, true), e.text)
    assert.equal(1, #hand.events)
    local own = hand.events[1]
    assert.same({ "crash", "hand", "table" }, { own.kind, own.part, own.obstacle })
    t.below(0.004, own.depth, "depth at its first step")
    local overload = of_kind(run.events, "overload")
    assert.equal(1, #overload)
    t.share(hand:over(0, run.time, { window = 0 }).peak_force, overload[1].value, 1e-12, "force told")
  end)

  it("driven through a peg gives an event at any step", function()
    for _, dt in ipairs{ 2e-3, 1e-2, 2e-2 } do
      local run = gripped({ 0, 0.2, 0 }, { speed = 1, dt = dt, add = function(scene)
        scene:obstacle{ name = "peg", shape = "cylinder", radius = 0.002, length = 0.05,
          at = { 0.2, 0.1, 0.1 } }
      end })
      local e = of_kind(run.events, "crash")[1]
      assert.is_table(e, "dt = " .. dt)
      assert.is_truthy(e.text:find("'peg'", 1, true), e.text)
    end
  end)

  it("is reported in a quasi-static run too", function()
    local run = gripped({ 0, 0, -0.12 }, { quasistatic = true, dt = 0.05 })
    assert.is_table(of_kind(run.events, "crash")[1])
  end)

  it("stops the run or calls a function, as on_crash says", function()
    local run = gripped({ 0, 0, -0.15 }, { on_crash = "stop" })
    assert.is_truthy(run.reason:find("'hand' runs into 'table'", 1, true), run.reason)
    t.below(0.004, of_kind(run.events, "crash")[1].value, "depth when it stopped")
    local calls = {}
    gripped({ 0, 0, -0.15 }, { on_crash = function(hand, e)
      calls[#calls + 1] = { hand.name, e.obstacle }
    end })
    assert.same({ { "hand", "table" } }, calls)
  end)

  it("that lays a wire on the table gives no event", function()
    local run, hand = gripped({ 0, 0, -0.1 + 0.002 }, {})
    t.fine(run)
    assert.equal(0, #of_kind(run.events, "crash"))
    assert.equal(0, #hand.events)
    assert.equal(0, #of_kind(run.events, "overload"))
  end)
end)

describe("clamps and feeds", function()
  local function driven(make, way)
    local scene, wire = new_scene()
    local hold = make(scene, wire)
    hold:follow{ relative = true, points = { { 0, 0, 0 }, way or { 0, 0, -0.11 } }, duration = 0.5 }
    local run = scene:run{ duration = 0.5 }
    return of_kind(run.events, "crash")[1], hold
  end

  it("driven into a table give an event", function()
    for _, make in ipairs{ function(s, w) return s:clamp(w, { s = 0 }) end,
      function(s, w) return s:pin(w, { s = 0.1 }) end,
      function(s, w) return s:feed(w, { s = 0, speed = 0.01 }) end } do
      local e, hold = driven(make)
      assert.is_table(e)
      assert.equal(hold.name, e.object)
      local crash = hold:crash()
      assert.equal("table", crash.obstacle)
      t.below(e.value, crash.depth, "depth at first")
      assert.is_nil((driven(make, { 0, 0, -0.02 })))
    end
  end)

  it("give none where the wire comes out of a wall, until they go deeper", function()
    local function walled(way)
      local scene, wire = new_scene()
      scene:obstacle{ name = "wall", shape = "box", size = { 0.1, 0.2, 0.2 }, at = { -0.05, 0, 0.1 } }
      local clamp = scene:clamp(wire, { s = 0 })
      if way then clamp:follow{ relative = true, points = { { 0, 0, 0 }, way }, duration = 0.3 } end
      return #of_kind(scene:run{ duration = 0.3 }.events, "crash")
    end
    assert.equal(0, walled())
    assert.equal(1, walled{ -0.02, 0, 0 })
  end)

  it("give an event when a moving obstacle runs into them", function()
    local scene, wire = new_scene()
    scene:clamp(wire, { name = "held", s = 0 })
    local ram = scene:obstacle{ name = "ram", shape = "sphere", radius = 0.01, at = { -0.1, 0, 0.1 } }
    ram:follow{ relative = true, points = { { 0, 0, 0 }, { 0.1, 0, 0 } }, duration = 0.3 }
    local e = of_kind(scene:run{ duration = 0.3 }.events, "crash")[1]
    assert.is_table(e)
    assert.equal("held", e.object)
    assert.is_truthy(e.text:find("'ram'", 1, true), e.text)
  end)

  it("have crashes that snapshots undo and files keep", function()
    local scene, wire = new_scene()
    local clamp = scene:clamp(wire, { s = 0 })
    clamp:follow{ relative = true, points = { { 0, 0, 0 }, { 0, 0, -0.11 } }, duration = 0.5 }
    t.fine(scene:run{ duration = 0.1 })
    local before = scene:snapshot()
    scene:run{ duration = 0.4 }
    local crash, path = clamp:crash(), os.tmpname()
    scene:save(path)
    local loaded = sw.load(path)
    os.remove(path)
    assert.same(crash, loaded:find(clamp.name):crash())
    scene:restore(before)
    assert.is_nil(clamp:crash())
    scene:run{ duration = 0.4 }
    assert.same(crash, clamp:crash())
  end)
end)
