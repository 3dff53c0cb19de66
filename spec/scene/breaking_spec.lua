-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires pulled beyond their breaking load: one event with time, place and load. Runs that stop because of
-- the pull name it in their reason.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local L = 0.3

-- A wire between two clamps; one of them moves away by `way` [m] within a second.
local function stretched(options, way)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  options.from, options.to = { 0, 0, 0 }, { L, 0, 0 }
  options.segments, options.name = options.segments or 20, "cord"
  local wire = scene:wire(options)
  scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = L }):follow{ points = { { 0, 0, 0 }, { way, 0, 0 } }, relative = true, duration = 1,
    law = "linear" }
  return scene, wire
end

local function breaks(events)
  local list = {}
  for _, e in ipairs(events) do if e.kind == "breaking" then list[#list + 1] = e end end
  return list
end

local function only(events)
  local list = breaks(events)
  assert.are.equal(1, #list)
  return list[1]
end

-- Breaking load of a catalogue cable: the area of its strands times 220 MPa [N].
local function of_strands(entry)
  local c = entry.construction
  return 220e6 * c.strands * math.pi / 4 * c.strand_diameter ^ 2
end

describe("a cable pulled beyond its breaking load", function()
  for name, how in pairs{
    ["in motion"] = { dt = 5e-3 }, ["in poses"] = { dt = 0.02, quasistatic = true },
    ["by sdirk2"] = { dt = 5e-3, integrator = "sdirk2" },
    ["at a tolerance"] = { dt = 5e-3, tolerance = 1e-5 },
  } do
    it("is reported once, with time, place and load, " .. name, function()
      local scene, wire = stretched({ cable = "GXL 1.5" }, 3e-3)
      how.duration = 1.2
      local run = t.fine(scene:run(how))
      local load = of_strands(wire:cable())
      local e = only(run.events)
      assert.are.equal("cord", e.object)
      t.near(load / wire.beam.EA * L / 3e-3, e.first, 0.021, "time of passing it") -- one step, half a window
      t.share(wire.beam.EA * 0.01, e.value, 2e-3, "largest pull")
      t.near(1, e.time, 0.03, "time of that")
      t.above(0, e.s, "place")
      t.below(L, e.s, "place")
      assert.matches("^wire 'cord' is pulled by 137[23] N near s = [%d.]+ m, more than its breaking load of "
        .. "268.5 N %(computed%); the simulation goes on as if the wire held$", e.text)
      assert.is_truthy(require "softworld.output.summary".text(run:document()):find("breaking load", 1, true))
    end)
  end

  it("gives no event below that load, nor for a wire whose load is unknown", function()
    local scene, wire = stretched({ cable = "GXL 1.5" }, 0.9 * 3e-3 * 0.195724)
    local run = t.fine(scene:run{ duration = 1.2, dt = 5e-3 })
    t.above(0.85 * of_strands(wire:cable()), (wire:max_tension()), "pull")
    assert.same({}, breaks(run.events))
    scene = stretched({ E = 1e9, density = 2000, radius = 1e-3 }, 3e-2)
    assert.same({}, breaks(t.fine(scene:run{ duration = 1.2, dt = 5e-3 }).events))
  end)

  it("is reported for any wire with its own breaking_load, with the source of the load", function()
    for _, flag in ipairs{ "given", "measured" } do
      local scene = stretched({ E = 1e9, density = 2000, radius = 1e-3, breaking_load = 20,
        breaking_flag = flag ~= "given" and flag or nil }, 3e-3)
      local e = only(t.fine(scene:run{ duration = 1.2, dt = 5e-3 }).events)
      t.near(20 / 31.416, e.first, 0.011, "time")
      assert.is_truthy(e.text:find("more than its breaking load of 20 N (" .. flag .. ")", 1, true), e.text)
    end
    local scene = stretched({ cable = "GXL 1.5", breaking_load = 1e4 }, 3e-3)
    assert.same({}, breaks(t.fine(scene:run{ duration = 1.2, dt = 5e-3 }).events))
  end)

  it("is reported for meshes", function()
    for _, model in ipairs{ "tube", "radial" } do
      local scene = stretched({ model = model, E = 1e8, density = 1200, radius = 3e-3, breaking_load = 10,
        segments = model == "tube" and 60 or 150 }, 3e-3)
      local e = only(t.fine(scene:run{ duration = 1, dt = 0.05, quasistatic = true }).events)
      t.near(10 / 28.27, e.first, 0.051, model)
    end
  end)

  -- The blow lasts a few ms and exceeds 268.5 N in single steps, but its mean over the window of 10 ms does
  -- not: no event. With window = 0 the blow is an event.
  it("is reported only where the mean over the window exceeds the load", function()
    local function jerked(options)
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 20 }
      scene:force{ kind = "damping", on = wire, stiffness = 2e-4 }
      scene:clamp(wire, { s = 0 })
      wire:set_velocity{ 12, 0, 0 }
      options.duration, options.dt = options.duration or 0.03, 1e-5
      return t.fine(scene:run(options)), wire
    end
    local run, wire = jerked{}
    t.above(268.5, (wire:max_tension{ raw = true }), "pull of a step")
    t.below(268.5, (wire:max_tension()), "pull")
    assert.same({}, breaks(run.events))
    assert.are.equal(1, #breaks(jerked{ window = 0 }.events))
  end)

  it("is reported in runs shorter than the window, and by settle", function()
    local scene = stretched({ cable = "GXL 1.5" }, 3e-3)
    t.fine(scene:run{ duration = 1, dt = 0.05, quasistatic = true })
    assert.are.equal(1, #breaks(t.fine(scene:run{ duration = 5e-3, dt = 1e-3 }).events))
    local fresh, wire = stretched({ cable = "GXL 1.5" }, 3e-3)
    fresh:clamp(wire, { s = L / 2 }):pose{ L / 2 + 2e-3, 0, 0 }
    assert.is_true(fresh:settle().ok)
    assert.are.equal(1, #breaks(fresh:events()))
  end)

  it("is reported for a scene loaded from a file", function()
    local path = os.tmpname()
    stretched({ cable = "GXL 1.5" }, 3e-3):save(path)
    local scene = sw.load(path)
    os.remove(path)
    local e = only(t.fine(scene:run{ duration = 1.2, dt = 5e-3 }).events)
    assert.is_truthy(e.text:find("268.5 N (computed)", 1, true), e.text)
  end)

  it("is judged by the breaking_load of sw.cable.define", function()
    local entry = sw.cable.define{ name = "spec of breaking", outer_diameter = 2e-3,
      mass_per_length = 0.01, EA = 5e4, EI = 1e-4, GJ = 1e-4, friction = 0.3, breaking_load = 42,
      temperature = { low = 0, high = 60 },
      bend = { fixed = 4, use = "fixed" }, source = "a test", flag = "measured", spread = 0.1 }
    assert.are.equal(42, entry.breaking_load.value)
    assert.matches("breaking_load +42 +N +37.8 .. 46.2 +measured", tostring(entry))
    local scene = stretched({ cable = entry }, 3e-3)
    local e = only(t.fine(scene:run{ duration = 1.2, dt = 5e-3 }).events)
    assert.is_truthy(e.text:find("42 N (measured)", 1, true), e.text)
    assert.is_nil(sw.cable "identified white".breaking_load)
    assert.matches("breaking_load +268.5 +N +244 .. 317 +computed", tostring(sw.cable "GXL 1.5"))
  end)

  it("refuses an invalid breaking_load", function()
    local scene = sw.scene{}
    local function refused(text, args)
      args.E, args.density, args.radius, args.from, args.to = 1e9, 1000, 1e-3, { 0, 0, 0 }, { 1, 0, 0 }
      local ok, why = pcall(scene.wire, scene, args)
      assert.is_false(ok)
      assert.is_truthy(why:find(text, 1, true), why)
    end
    refused("breaking_load = 0 N is not allowed", { breaking_load = 0 })
    refused("breaking_load must be a number", { breaking_load = "much" })
    refused("did you mean 'breaking_load'?", { breakingload = 5 })
    refused("did you mean 'measured'?", { breaking_load = 5, breaking_flag = "mesured" })
  end)
end)

describe("a run that cannot go on", function()
  -- The clamps draw the cable over a cylinder, to more than its triple length.
  it("names the pull on the cable and its breaking load", function()
    local scene = sw.scene{}
    scene:obstacle{ shape = "cylinder", radius = 0.02, length = 0.2, at = { 0.15, 0, -0.0215 },
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 }, friction = 0.4 }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0 }, to = { L, 0, 0 }, segments = 100,
      name = "cord" }
    for s, x in pairs{ [0] = -0.25, [L] = 0.5 } do
      scene:clamp(wire, { s = s }):follow{ points = { { 0, 0, 0 }, { x, 0, -0.5 } }, relative = true,
        duration = 0.5, law = "linear" }
    end
    local run = scene:run{ duration = 0.6, dt = 0.05 }
    local e = only(run.events)
    t.below(0.3, e.first, "time")
    t.above(1e3, e.value, "pull")
    assert.is_false(run.ok)
    assert.matches("; obstacle 'cylinder1' presses 'cord' with [%d.]+ k?N near s = 0.%d+ m", run.reason)
    assert.is_truthy(run.reason:find("; wire 'cord' was pulled by ", 1, true), run.reason)
    assert.is_truthy(run.reason:find(" kN, its breaking load is 268.5 N", 1, true), run.reason)
  end)

  local function duct(scene, width)
    return scene:channel{ name = "duct", points = { { 0.1, 0, -0.003 }, { 0.4, 0, -0.003 } }, width = width,
      depth = 0.02, friction = 0.3 }
  end

  -- The wire is 5 mm thick, the channel 4 mm wide.
  it("names the wall of a channel that is too narrow", function()
    local scene = sw.scene{}
    duct(scene, 0.004)
    local wire = scene:wire{ name = "w", from = { 0, 0, 0 }, to = { 0.5, 0, 0 }, E = 5e7, density = 1400,
      radius = 0.0025, segments = 50 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.5 })
    local run = scene:run{ duration = 0.1, dt = 0.01 }
    assert.is_false(run.ok)
    assert.matches("; obstacle 'duct %a+ 1' presses 'w' with [%d.]+ k?N near s = 0.%d+ m", run.reason)
  end)

  -- A hand draws the wire sideways over the wall, away from a guide that pays out, takes in or slips.
  it("does not blame a fast feed where a channel's wall holds the wire", function()
    local feeds = { { speed = 0.1 }, { speed = -0.1 }, { speed = 0, force_limit = 2 }, { force = 0.2 } }
    for _, feed in ipairs(feeds) do
      local scene = sw.scene{}
      duct(scene, 0.01)
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
        segments = 25 }
      feed.s, feed.name = 0, "spool"
      scene:feed(wire, feed)
      scene:clamp(wire, { s = 0.5, name = "hand" }):follow{ points = { { 0, 0, 0 }, { -0.05, 0.1, 0 } },
        relative = true, duration = 0.5 }
      local run = scene:run{ duration = 0.3, dt = 0.01, max_steps = 500 }
      assert.is_nil(run.reason:find("fast", 1, true), run.reason)
      if not run.ok then assert.matches("duct", run.reason) end
      for _, e in ipairs(run.events) do assert.is_nil(e.text:find("fast", 1, true), e.text) end
    end
  end)

  it("names the hand that draws a wire against a wall, the overload and the breaking load", function()
    local scene = sw.scene{}
    duct(scene, 0.01)
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
      segments = 50 }
    scene:clamp(wire, { s = 0 })
    scene:clamp(wire, { s = 0.25, name = "hand" }):follow{ points = { { 0, 0, 0 }, { 0, 0.05, 0 } },
      relative = true, duration = 0.5 }
    local kinds = {}
    for _, e in ipairs(scene:run{ duration = 0.3, dt = 0.01 }.events) do kinds[e.kind] = e.text end
    assert.matches("^clamp 'hand' pushes wire 'w' [%d.]+ mm deep into 'duct left 1'", kinds.crash)
    assert.matches("^clamp 'hand' loads wire 'w' with", kinds.overload)
    assert.matches("^wire 'w' is pulled by [%d.]+ kN near s = 0.%d+ m, more than its breaking load",
      kinds.breaking)
  end)

  -- The clamp turns by 2.4 rad in a thousandth of a step.
  it("stops when its steps have collapsed, and names the cause", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ E = 1e8, density = 1200, radius = 1e-3, from = { 0, 0, 0 }, to = { 0.1, 0, 0 },
      segments = 4 }
    scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true,
      duration = 10, law = "linear", turn = { axis = { 1, 0, 0 }, angle = 2.4e5 } }
    local run = scene:run{ duration = 10, dt = 0.1 }
    assert.is_false(run.ok)
    assert.matches("^at t = 1.95%d+ s: steps have collapsed: the last 20000 were about [%d.e-]+ s long, and "
      .. "dt is 0.1 s; larger steps fail: a hold of a wire turns too far in one step", run.reason)
    assert.are.equal(20000, run.steps)
  end)
end)
