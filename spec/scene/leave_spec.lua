-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:remove: an object leaves the scene with what belongs to it, and nothing else. Its earlier results
-- stay readable.
local sw = require "softworld"
local leaving = require "spec.scene.leaving"

local rod, three, at, refused = leaving.rod, leaving.three, leaving.at, leaving.refused
local core = sw.core
local R = 0.0025

describe("scene:remove", function()
  it("takes a wire with everything that holds it, and leaves the others alone", function()
    local scene, a, b, c = three()
    local clamp, pin = scene:clamp(b, { s = 0 }), scene:pin(c, { s = 0 })
    local force = scene:force{ kind = "point", on = b, s = 0.3, force = { 0, 0, 0.01 } }
    local tie, own = scene:tie(b, { s = 0.25, to = { c, s = 0.25 } }), scene:tie(c, { s = 0.5 })
    scene:remove(b)
    assert.is_false(clamp.held)
    assert.is_false(force.held)
    assert.is_false(tie:exists())
    assert.is_true(pin.held)
    assert.is_true(own:exists())
    assert.are.same({ true, false, true }, { a.present, b.present, c.present })
    -- handles of other wires stay valid, also of c, whose place in the scene's list has changed
    assert.are.near(0.1, c:position(0.2)[2], 1e-12)
    assert.are.near(0, a:position(0.2)[2], 1e-12)
    assert.is_false(core.exists(b))
    assert.are.equal("b", b.name)
    assert.are.equal("wire 'b' (taken away)", tostring(b))
  end)

  it("tells when a removed object left, and refuses objects of other scenes", function()
    local scene, a, b = three()
    scene:run{ duration = 0.01, dt = 0.005 }
    scene:remove(b)
    local gone = "'b' was taken away from scene 'three' at t = 0.01 s"
    refused(gone, function() b:position(0.1) end)
    refused(gone, function() scene:clamp(b, { s = 0 }) end)
    refused(gone, function() scene:force{ kind = "point", on = b, s = 0, force = { 0, 0, 1 } } end)
    refused("scene:remove: 'b' was taken away already", function() scene:remove(b) end)
    refused("nothing named 'b'", function() scene:remove "b" end)
    refused("scene:remove expects an object or its name, got 3", function() scene:remove(3) end)
    refused("got nil", function() scene:remove() end)
    refused("is of another scene", function() three():remove(a) end)
    refused("scene:remove is a method", function() scene.remove(a) end)
  end)

  it("books the energy that leaves as a change of the scene, without a gap", function()
    -- each wire has its own energy: without b the total is that of a and c
    local scene, _, b = three()
    local before, after
    at(scene, 0.05, function()
      before = scene:energy().total
      scene:remove(b)
      after = scene:energy().total
    end)
    local run = scene:run{ duration = 0.1, dt = 0.005 }
    local ledger = run:ledger()
    assert.are.near(2 / 3, after / before, 1e-9)
    assert.are.near(after - before, ledger.work.changes, 1e-9 * before)
    assert.is_true(math.abs(ledger.gap) < 1e-9 * before)
  end)

  it("moves the remaining wires as if the removed one had never been there", function()
    -- three wires fall freely and do not touch; a and c must fall by g t^2 / 2
    local scene, a, b, c = three()
    at(scene, 0.05, function() scene:remove(b) end)
    scene:run{ duration = 0.1, dt = 0.005, integrator = "tr-bdf2" }
    local fall = 0.1 - 0.5 * 9.81 * 0.1 ^ 2 -- z0 - g t^2 / 2 [m]
    for _, wire in ipairs{ a, c } do assert.are.near(fall, wire:position(0.25)[3], 1e-6) end
  end)

  it("keeps the contacts of the remaining wires, with their friction", function()
    -- On a slope of 15 degrees with friction 0.4 > tan(15 degrees) a wire stays. Friction that was lost, or
    -- that was another wire's, would let it creep.
    local g, slope = 9.81, math.rad(15)
    local scene = sw.scene{ gravity = { 0, g * math.sin(slope), -g * math.cos(slope) } }
    scene:obstacle{ shape = "plane", friction = 0.4 }
    local a = rod(scene, "a", 0, { from = { 0, 0, R }, to = { -0.5, 0, R } })
    local b = rod(scene, "b", 0.1, { from = { 0, 0.1, R }, to = { -0.5, 0.1, R } })
    scene:settle()
    scene:run{ duration = 0.05, dt = 0.002 }
    local before = b:position(0.25)[2]
    scene:remove(a)
    scene:run{ duration = 0.05, dt = 0.002 }
    assert.are.near(before, b:position(0.25)[2], 1e-6)
  end)

  it("keeps the wire in frames, series, events and pictures until it left", function()
    local scene, _, b = three()
    at(scene, 0.05, function() scene:remove(b) end)
    local run = scene:run{ duration = 0.1, dt = 0.005, frame = 0.01 }
    local doc = run:document()
    assert.are.same({ "a", "b", "c" }, { doc.wires[1].name, doc.wires[2].name, doc.wires[3].name })
    for _, frame in ipairs(doc.frames) do
      local there = frame.t <= 0.05 + 1e-9
      assert.are.equal(there and 63 or 0, #frame.wires[2])
      assert.are.equal(63, #frame.wires[3])
      assert.are.near(0.1, frame.wires[3][2], 1e-6) -- y of c, float
      assert.are.equal(there and 21 or 0, #frame.values[2].tension)
    end
    local event = run.events[1]
    assert.are.same({ "removed", "b", "wire 'b' is taken away" }, { event.kind, event.object, event.text })
    assert.are.near(0.05, event.time, 1e-9)
    local column
    for _, one in ipairs(run:series().columns) do column = one.name == "b.tension" and one or column end
    for i, t in ipairs(run:series().time) do
      assert.are.equal(t <= 0.05 + 1e-9, column.values[i] == column.values[i])
    end
    local path = os.tmpname()
    for ending, method in pairs{ html = "report", glb = "gltf", obj = "obj", pvd = "vtk" } do
      run[method](run, path .. "." .. ending)
    end
    for _, technique in ipairs{ "particles", "wireframe", "shaded" } do
      run:picture{ path = path .. ".png", technique = technique, t = 0.1 }
    end
    os.execute(("rm -rf %s %s.* %s_*"):format(path, path, path))
  end)

  it("is undone by a snapshot from before, also by one with fewer wires than there are", function()
    local scene, _, b, c = three()
    local clamp = scene:clamp(b, { s = 0 })
    local empty = scene:snapshot()
    scene:run{ duration = 0.01, dt = 0.005 }
    local snapshot = scene:snapshot()
    scene:run{ duration = 0.02, dt = 0.005 }
    local wanted = b:position(0.4)
    scene:restore(snapshot)
    scene:remove(b)
    local d = rod(scene, "d", 0.2)
    rod(scene, "e", 0.3)
    scene:run{ duration = 0.02, dt = 0.005 }
    scene:restore(snapshot)
    assert.is_true(b.present and clamp.held)
    assert.is_false(core.exists(d))
    scene:run{ duration = 0.02, dt = 0.005 }
    assert.are.same(wanted, b:position(0.4))
    scene:restore(empty)
    assert.are.near(0.1, c:position(0.4)[2], 0)
    assert.are.equal(0, scene.time)
  end)

  it("frees the name; scene:script writes what is there", function()
    local scene, _, b = three()
    scene:remove(b)
    rod(scene, "b", 0.07)
    assert.are.equal("a b c", table.concat(scene:names(), " "))
    local again = assert(load(scene:script()))()
    assert.are.equal("a b c", table.concat(again:names(), " "))
    assert.are.near(0.07, again:find("b"):position(0.1)[2], 1e-12)
    assert.are.equal(3, #scene:describe().wires)
    scene:run{ duration = 0.01, dt = 0.005 }
    scene:remove "b"
    rod(scene, "b", 0.05)
    local names = {}
    for _, column in ipairs(scene:run{ duration = 0.01, dt = 0.005 }:series().columns) do
      assert.is_nil(names[column.name])
      names[column.name] = true
    end
    assert.is_true(names["b.tension"])
  end)

  it("goes on from a file with the same bits", function()
    local scene, a, _, c = three()
    scene:remove "b"
    scene:run{ duration = 0.01, dt = 0.005 }
    scene:remove(a)
    local path = os.tmpname()
    scene:save(path)
    local copy = sw.load(path)
    os.remove(path)
    assert.are.equal("c", table.concat(copy:names(), " "))
    for _, one in ipairs{ scene, copy } do one:run{ duration = 0.01, dt = 0.005 } end
    assert.are.same((c:positions()), (copy:find("c"):positions()))
  end)

  -- Without wires nothing is solved. Obstacles and grippers follow their motions, which are functions of
  -- time, with any method, and the run ends at its usual time.
  for _, how in ipairs{ { dt = 0.005 }, { tolerance = 1e-5 }, { dt = 0.005, quasistatic = true },
    { dt = 0.005, wear = true }, { dt = 0.005, integrator = "bdf2" },
    { dt = 2e-5, integrator = "velocity-verlet" }, { dt = 2e-5, integrator = "gsl-rk4" } } do
    local words = how.quasistatic and "quasi-static" or how.wear and "with wear" or how.integrator
      or how.tolerance and "with a tolerance" or "of fixed steps"
    it("of the last wire leaves a run that goes on to its end, " .. words, function()
      local scene = sw.scene{ name = "left" }
      scene:obstacle{ shape = "plane", friction = 0.3 }
      local box = scene:obstacle{ name = "box", shape = "box", size = { 0.1, 0.1, 0.1 },
        at = { 0.3, 0, 0.05 } }
      box:follow(sw.trajectory{ points = { { 0.3, 0, 0.05 }, { 0.3, 0, 0.15 } }, times = { 0, 0.1 },
        law = "linear" })
      local a = rod(scene, "a", 0)
      local clamp, force = scene:clamp(a, { s = 0 }), scene:force{ kind = "damping", mass = 1 }
      local hand = scene:gripper{ name = "hand", at = { 0, 0, 0.3 },
        pads = { friction = 0.5, opening = 0.01 } }
      scene:wire_contact{}
      local looks, when = 0
      scene:observe{ every = 0.01, call = function() looks = looks + 1 end }
      scene:process(function(p)
        p:wait(0.02)
        scene:remove(a)
        when = p.time
        hand:move{ by = { 0, 0, 0.01 }, duration = 0.05 }
        hand:close_jaws{ distance = 0.008, speed = 0.1 }
        p:wait_until({ force = 1, on = box }, { timeout = 0.01 })
      end)
      local run = scene:run(how)
      assert.is_true(run.ok, run.reason)
      assert.are.same({ false, false }, { clamp.held, a.present })
      assert.is_true(force.held) -- it acts on all wires of the scene
      assert.are.near(when + 0.05 + 0.02 + 0.01, run.time, 2 * (how.dt or 0.01))
      assert.are.near(0.31, hand:position()[3], 1e-9)
      assert.are.near(0.05 + math.min(run.time, 0.1), (box:pose()[3]), 1e-9)
      assert.are.same({ 0, 0, 0 }, box:force())
      assert.is_true(looks >= 8)
      assert(run.events[1].text:find("wire 'a' is taken away; no wire is left", 1, true))
      -- its earlier results stay; reading its present state is refused
      local doc, ledger = run:document(), run:ledger()
      assert.are.equal(0, #doc.frames[#doc.frames].wires[1])
      assert.are.equal(63, #doc.frames[1].wires[1])
      assert.are.same({ 0, 0, 0 }, { ledger.kinetic, ledger.stored, ledger.gravity })
      assert.is_true(math.abs(ledger.gap) < 1e-4 * ledger.play)
      refused("'a' was taken away from scene 'left' at t =", function() a:max_tension() end)
      local check = run:check{}
      assert.are.same({ "OPEN", "OPEN" }, { check.verdict, check:row "removed".verdict })
      assert.are.equal(run.time, run:series().time[#run:series().time])
      assert.are.equal(0, scene:energy().total)
      -- a wire made later moves as usual: it falls, damped by 1/s: v' = -g - v
      local b = rod(scene, "b", 0.2)
      local more = { duration = 0.02, dt = how.dt, integrator = how.integrator or "tr-bdf2" }
      local next = scene:run(more)
      assert.is_true(next.ok, next.reason)
      assert.are.near(0.1 - 9.81 * (0.02 - 1 + math.exp(-0.02)), b:position(0)[3], 3e-6)
    end)
  end

  it("of the last wire lets another wire come in the same run", function()
    local scene = sw.scene()
    local a, b = rod(scene, "a", 0), nil
    at(scene, 0.02, function() scene:remove(a) end)
    at(scene, 0.05, function() b = rod(scene, "b", 0.1) end)
    local run = scene:run{ duration = 0.1, dt = 0.005, integrator = "tr-bdf2" }
    assert.is_true(run.ok, run.reason)
    assert.are.near(0.1, scene.time, 1e-12)
    assert.are.near(0.1 - 0.5 * 9.81 * 0.05 ^ 2, b:position(0.25)[3], 1e-6) -- it fell for 0.05 s
    assert.are.near(0.1, b:position(0.25)[2], 1e-12)
  end)

  it("of the last wire is undone by a snapshot and kept in a file", function()
    local scene = sw.scene()
    local a = rod(scene, "a", 0)
    local box = scene:obstacle{ shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 0, 0, 1 }, name = "box" }
    box:follow(sw.trajectory{ points = { { 0, 0, 1 }, { 0, 0, 2 } }, times = { 0, 0.1 }, law = "linear" })
    scene:run{ duration = 0.01, dt = 0.005 }
    local before, path = scene:snapshot(), os.tmpname()
    at(scene, 0.02, function() scene:remove(a) end)
    scene:run{ duration = 0.03, dt = 0.005 }
    scene:save(path)
    local none = scene:snapshot()
    local copy = sw.load(path)
    os.remove(path)
    assert.are.near(0.04, copy.time, 1e-12)
    assert.are.equal("box", table.concat(copy:names(), " "))
    assert.are.near(1.4, copy:find("box"):pose()[3], 1e-9)
    refused("there is no wire", function() copy:run{ duration = 0.01 } end)
    rod(copy, "c", 0)
    assert.is_true(copy:run{ duration = 0.01, dt = 0.005 }.ok)
    scene:restore(before)
    assert.is_true(a.present)
    assert.is_true(scene:run{ duration = 0.01, dt = 0.005 }.ok)
    scene:restore(none)
    assert.are.equal("box", table.concat(scene:names(), " "))
    refused("there is no wire", function() scene:settle() end)
  end)

  it("of the last wire, in a run with save, can be resumed from the file", function()
    local path = os.tmpname()
    os.remove(path)
    local function made(stops)
      local scene = sw.scene{ name = "written" }
      local a, hand = rod(scene, "a", 0), scene:gripper{ name = "hand", at = { 0, 0, 1 } }
      scene:process(function(p)
        p:step("leave", function()
          p:wait(0.01)
          scene:remove(a)
        end)
        p:step("rest", function() p:wait(0.02) end)
        if stops then error "here it stops" end
        p:step("go", function() hand:move{ by = { 0, 0, 0.1 }, duration = 0.05 } end)
      end)
      return scene, hand
    end
    local scene = made(true)
    refused("here it stops", function() scene:run{ dt = 0.005, save = path } end)
    local again, hand = made(false)
    local run = again:run{ dt = 0.005, save = path, resume = path }
    os.remove(path)
    assert.is_true(run.ok, run.reason)
    assert.are.near(0.08, again.time, 1e-9)
    assert.are.near(1.1, hand:position()[3], 1e-9)
  end)

  it("of the last wire between runs lets a process make another", function()
    for _, emptied in ipairs{ true, false } do
      local scene, b = sw.scene(), nil
      if emptied then scene:remove(rod(scene, "a", 0)) end
      scene:process(function(p)
        b = rod(scene, "b", 0)
        p:wait(0.02)
      end)
      assert.is_true(scene:run{ dt = 0.005 }.ok)
      assert.is_true(b:position(0)[3] < 0.1) -- it fell
    end
  end)

  it("of the last wire between runs leaves an empty scene, in which no run begins", function()
    local scene = sw.scene()
    scene:remove(rod(scene, "a", 0))
    refused("there is no wire", function() scene:run{ duration = 0.01 } end)
    local b = rod(scene, "b", 0)
    assert.is_true(scene:run{ duration = 0.01, dt = 0.005 }.ok)
    assert.is_true(b.present)
  end)

  it("works before a run with error bars, and is refused within one", function()
    local function run(work)
      local scene, a, b = three()
      scene:clamp(a, { s = 0 })
      scene:remove "c"
      scene:process(function(p)
        p:wait(0.01)
        work(scene, b)
        p:wait(0.01)
      end)
      return scene:run{ tolerance = { ["a.tip"] = 1e-3 } }
    end
    assert.is_true(run(function() end).ok)
    refused("'b' was taken away during the run", function() run(function(scene, b) scene:remove(b) end) end)
  end)

  it("takes obstacles, clamps, forces and ties", function()
    local scene, a, b = three()
    local box = scene:obstacle{ shape = "box", size = { 0.1, 0.1, 0.1 }, at = { 0, 1, 0 }, name = "box" }
    local clamp = scene:clamp(a, { s = 0 })
    local force = scene:force{ kind = "damping", mass = 1 }
    local tie = scene:tie(b, { s = 0.25, name = "tie" })
    for _, one in ipairs{ "box", clamp, force, "tie" } do scene:remove(one) end
    assert.are.same({ false, false, false, false }, { box.present, clamp.held, force.held, tie:exists() })
    refused("'box' was taken away already", function() scene:remove(box) end)
    assert.are.equal("box", scene:describe().obstacles[1].name)
  end)

  it("takes objects of particles", function()
    local scene, _, _, c = three()
    local net = scene:particles{ name = "net", positions = { 0, 1, 0, 0.1, 1, 0 }, masses = 0.01,
      links = { { pairs = { 1, 2 }, k = 10 } } }
    local d = rod(scene, "d", 0.2)
    scene:run{ duration = 0.01, dt = 0.005, frame = 0.005 }
    scene:remove(net)
    scene:remove "b"
    local run = scene:run{ duration = 0.01, dt = 0.005, frame = 0.005 }
    assert.are.near(0.2, d:position(0.1)[2], 1e-9)
    assert.are.near(0.1, c:position(0.1)[2], 1e-9)
    local frames = run:document().frames
    assert.are.equal(0, #frames[#frames].particles[1])
    assert.is_false(net.present)
    assert.are.same({ "net", "particles 'net' (taken away)" }, { net.name, tostring(net) })
    assert.are.near(0.2, frames[#frames].wires[4][2], 1e-6)
  end)
end)
