-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs that choose their model: the reasons of each choice, in scenes whose answer is known.
local sw = require "softworld"
local rod = require "spec.model.rod"

local R = rod.radius

local function fails(f, ...)
  local fine, why = pcall(f)
  assert.is_false(fine)
  for _, words in ipairs { ... } do assert.truthy(tostring(why):find(words, 1, true), tostring(why)) end
end

local function follow(hold, points, duration) hold:follow { points = points, duration = duration } end

-- A wire hangs between two clamps, one of which comes nearer. more: arguments of the wire.
local function hung(duration, tolerance, more, settled)
  local scene = sw.scene { name = "hung" }
  scene:force { kind = "damping", mass = 5 }
  local w = rod.wire(scene, more)
  scene:clamp(w, { s = 0 })
  local right = scene:clamp(w, { s = 0.6, name = "right" })
  if settled ~= false then scene:settle() end
  follow(right, { { 0.6, 0, 0 }, { 0.4, 0.1, 0 } }, duration)
  return scene:run { duration = duration, tolerance = tolerance or { min_bend_radius = { relative = 0.1 } } },
    scene, w
end

-- One end of a wire on a table is turned about the wire.
local function turned(friction, settled)
  local scene = sw.scene { name = "turned" }
  scene:force { kind = "damping", mass = 5 }
  scene:obstacle { name = "table", shape = "plane", friction = friction }
  local w = rod.wire(scene, { from = { 0, 0, R }, to = { 0.4, 0, R } })
  local hand = scene:clamp(w, { s = 0, name = "hand" })
  if settled then scene:settle() end
  hand:follow { points = { { 0, 0, 0 }, { 0, 0, 0 } }, relative = true, duration = 1,
    turn = { axis = { 1, 0, 0 }, angle = 1 } }
  return scene:run { duration = 1, tolerance = { ["hand.moment"] = { relative = 0.1 } } }, scene, hand
end

-- Two wires that cross; the upper one comes down.
local function crossed(gap, down)
  local scene = sw.scene { name = "crossed" }
  scene:force { kind = "damping", mass = 5 }
  local a = rod.wire(scene, { name = "a", from = { -0.2, 0, 0 }, to = { 0.2, 0, 0 } })
  local b = rod.wire(scene, { name = "b", from = { 0, -0.2, gap }, to = { 0, 0.2, gap } })
  for i, s in ipairs { 0, 0.4 } do
    scene:clamp(a, { s = s, name = "a" .. i })
    scene:clamp(b, { s = s, name = "b" .. i }):follow { points = { { 0, 0, 0 }, { 0, 0, -down } },
      relative = true, duration = 1 }
  end
  return scene:run { duration = 1, tolerance = { ["b1.force"] = { relative = 0.1 } } }, scene
end

describe("model = 'auto'", function()
  it("takes poses where motion is slow and dynamics where it is fast, and says how they differ",
    function()
    local slow, fast = hung(40), hung(0.5)
    assert.equal("poses", slow.model.motion, tostring(slow:why()))
    assert.equal("dynamic", fast.model.motion, tostring(fast:why()))
    assert.truthy(tostring(fast:why()):find("motion dynamic: ", 1, true))
    assert.truthy(tostring(slow:why()):find("leaves out inertia", 1, true))
  end)

  -- The truth: the same scene with the dearest model on finer edges and steps.
  it("keeps to the error that it states, and to the tolerance", function()
    for _, duration in ipairs { 0.5, 40 } do
      local share = duration > 1 and 0.05 or 0.5 -- the force of a swinging wire is not known better
      local run = hung(duration, { ["right.force"] = { relative = share },
        min_bend_radius = { relative = 0.05 } })
      local scene = sw.scene()
      scene:force { kind = "damping", mass = 5 }
      local w = rod.wire(scene, { model = "rod", rolls = true })
      scene:wire_contact {}
      scene:clamp(w, { s = 0 })
      local right = scene:clamp(w, { s = 0.6, name = "right" })
      scene:settle()
      follow(right, { { 0.6, 0, 0 }, { 0.4, 0.1, 0 } }, duration)
      local fine = scene:run { duration = duration, levels = 6, tolerance = {
        ["right.force"] = { relative = 0.005 }, min_bend_radius = { relative = 0.005 } } }
      assert.is_true(run.met, tostring(run:why()))
      for name, q in pairs(run.quantities) do
        local truth, off = fine.quantities[name], 0
        if type(q.value) == "number" then off = math.abs(q.value - truth.value)
        else
          for k = 1, 3 do off = off + (q.value[k] - truth.value[k]) ^ 2 end
          off = off ^ 0.5
        end
        assert.is_true(off <= q.error + truth.error, ("%s: %g off, %g stated"):format(name, off, q.error))
        assert.is_true(math.abs(q.error - q.discretisation - q.model_error) <= 1e-12 * q.error)
      end
    end
  end)

  it("lets a wire roll where friction twists it, also one that has settled", function()
    for _, settled in ipairs { false, true } do
      local rough = turned(0.5, settled)
      assert.equal("rolling", rough.model.twist, tostring(rough:why()))
      local smooth = turned(0, settled)
      assert.equal("held", smooth.model.twist, tostring(smooth:why()))
      assert.truthy(tostring(smooth:why()):find("no friction torque", 1, true))
    end
  end)

  it("lets wires touch where they meet, and only there", function()
    local meet, apart = crossed(0.02, 0.04), crossed(0.1, 0.04)
    assert.equal("wires", meet.model.contact, tostring(meet:why()))
    assert.equal("none", apart.model.contact, tostring(apart:why()))
    assert.truthy(tostring(apart:why()):find("wires cannot meet: the boxes that they sweep stay", 1, true))
  end)

  -- Two slanted wires side by side: their boxes meet, their axes stay 0.1 m/sqrt(2) apart.
  it("measures how near axes come where boxes meet, and how near a wire comes to itself", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    local wires = {}
    for i, name in ipairs { "a", "b" } do
      local x = 0.1 * (i - 1)
      wires[i] = rod.wire(scene, { name = name, from = { x, 0, 0 }, to = { x + 0.3, 0.3, 0 } })
      scene:clamp(wires[i], { s = 0 })
    end
    local run = scene:run { duration = 0.1, tolerance = { { name = "place", value = 1e-3, unit = "m",
      of = function() return wires[1]:position(0.3) end } } }
    local _, _, room = tostring(run:why()):find("they stay at least ([%d.]+) mm apart")
    assert.is_near(0.1 / 2 ^ 0.5 - 2 * R, tonumber(room) / 1e3, 1e-3, tostring(run:why()))
    local coil, path = sw.scene { gravity = { 0, 0, 0 } }, {}
    for i = 0, 60 do -- three turns with a pitch of 0.03 m
      local a = 2 * math.pi * i / 20
      path[#path + 1] = { 0.05 * math.cos(a), 0.05 * math.sin(a), 0.03 * a / (2 * math.pi) }
    end
    local w = rod.wire(coil, { path = path, rest = "path", segments = 96 })
    coil:clamp(w, { s = 0 })
    run = coil:run { duration = 0.1, tolerance = { tip = 1e-3 } }
    assert.equal("none", run.model.contact, tostring(run:why()))
    _, _, room = tostring(run:why()):find("comes no nearer to itself than ([%d.]+) mm")
    assert.is_true(tonumber(room) > 10 and tonumber(room) < 30, tostring(run:why()))
  end)

  it("computes no mesh for a tolerance that no level can meet, and says so", function()
    local scene = sw.scene()
    scene:force { kind = "damping", mass = 5 }
    scene:obstacle { shape = "plane", friction = 0.3 }
    local w = rod.wire(scene, { from = { 0, 0, R }, to = { 0.6, 0, R } })
    scene:clamp(w, { s = 0, name = "hand" }):follow { duration = 2,
      points = { { 0, 0, R }, { 0.05, 0.1, 0.12 } } }
    local run = scene:run { duration = 2, tolerance = { ["hand.force"] = 1e-12 } }
    assert.equal("round", run.model.section)
    assert.is_false(run.met)
    assert.truthy(tostring(run:why()):find("no mesh helps", 1, true), tostring(run:why()))
  end)

  it("reports the cost of choosing apart from the run's; levels that both use count as the run's", function()
    local run = hung(2)
    local sum = 0
    for _, level in ipairs(run.levels) do sum = sum + level.cpu end
    assert.is_near(sum, run.model.run_cost, 1e-9)
    assert.is_true(run.model.cost >= 0)
  end)

  it("keeps what the script has decided", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { rolls = true })
    scene:clamp(w, { s = 0 })
    scene:wire_contact {}
    local run = scene:run { duration = 0.05, model = "auto", quasistatic = true, tolerance = { tip = 0.01 } }
    assert.same({ "poses", "rolling", "wires" }, { run.model.motion, run.model.twist, run.model.contact },
      tostring(run:why()))
    for _, c in ipairs(run.model.choices) do
      if c.name ~= "section" then assert.equal("given", c.by, c.name) end
    end
  end)

  -- Pads hold 2 mu F by friction. A load of 29 % of that needs no comparison; at F = 0.02 N the wire gives.
  it("grips by friction only where that may slip", function()
    local function carry(force)
      local scene = sw.scene { name = "carry" }
      scene:force { kind = "damping", mass = 8 }
      local w = rod.wire(scene, { E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0.003 },
        to = { 0.24, 0, 0.003 } })
      local hand = scene:gripper { name = "hand", pads = { width = 0.012, friction = 0.6, opening = 0.009 } }
      scene:obstacle { name = "table", shape = "plane", friction = 0.2 }
      scene:process(function()
        hand:grasp(w, { s = 0.12, approach = "auto", force = force })
        hand:move { by = { 0, 0, 0.04 }, duration = 0.5 }
      end)
      return scene:run { tolerance = { tip = 0.002 } }, hand
    end
    local firm = carry(0.3)
    assert.equal("imposed", firm.model.grip, tostring(firm:why()))
    assert.truthy(tostring(firm:why()):find("of what their friction holds (limit 50 %)", 1, true))
    local loose, hand = carry(0.02)
    assert.equal("plates", loose.model.grip, tostring(loose:why()))
    assert.is_true(hand:over(0).slip > 0) -- it is held by friction, which gives a little
  end)

  it("says when no round section suffices", function()
    local scene = sw.scene { name = "soft" }
    scene:obstacle { name = "edge", shape = "cylinder", radius = 0.01, length = 0.2, at = { 0.2, 0, -0.0126 },
      rotation = { math.cos(math.pi / 4), math.sin(math.pi / 4), 0, 0 }, friction = 0 }
    local w = rod.wire(scene, { E = 2e4, to = { 0.4, 0, 0 } })
    for i, s in ipairs { 0, 0.4 } do
      scene:clamp(w, { s = s }):follow { points = { { 0, 0, 0 }, { i == 1 and -0.05 or 0.05, 0, -0.06 } },
        relative = true, duration = 1 }
    end
    local run = scene:run { duration = 1, quasistatic = true,
      tolerance = { max_tension = { relative = 0.001 } } }
    assert.is_false(run.met)
    assert.truthy(tostring(run:why()):find("NOT enough: 'w' is pressed by up to", 1, true),
      tostring(run:why()))
  end)

  it("first reports what is unknown of the cable, and refines no further than that allows", function()
    local scene = sw.scene()
    scene:force { kind = "damping", mass = 5 }
    local w = scene:wire { name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.4, 0, 0 },
      model = "auto" }
    scene:clamp(w, { s = 0 })
    scene:settle()
    local run = scene:run { duration = 0.1, tolerance = { tip = 1e-6 } }
    local lines = {}
    for line in tostring(run:why()):gmatch "[^\n]+" do lines[#lines + 1] = line end
    assert.truthy(lines[2]:find("first: EI of 'w' (GXL 1.5) is between 0.0009 and 0.022 N m2", 1, true),
      lines[2])
    assert.truthy(lines[2]:find("no model can repair that", 1, true))
    assert.is_false(run.met)
    assert.is_true(#run.levels <= 3)
  end)

  -- Poses cannot show that the wire does not bear this motion; what cannot be checked is not met.
  it("is not met where the dearer model cannot be computed", function()
    local scene = sw.scene()
    local w = rod.wire(scene, { E = 1e4 })
    scene:clamp(w, { s = 0 })
    follow(scene:clamp(w, { s = 0.6 }), { { 0.6, 0, 0 }, { 40, 0, 0.05 } }, 0.01)
    local run = scene:run { duration = 0.3, tolerance = { tip = 0.01 } }
    assert.is_true(run.ok, run.reason)
    assert.equal("poses", run.model.motion)
    assert.is_false(run.met)
    local why = tostring(run:why())
    assert.truthy(why:find("motion poses: dynamics cannot be computed: ", 1, true), why)
    assert.truthy(why:find("NOT known: whether this model suffices", 1, true), why)
    assert.truthy(tostring(run):find("see run:why()", 1, true))
  end)

  it("is in the summary and on the page", function()
    local run = hung(2)
    local words = {}
    run:summary { write = function(_, ...)
      for _, word in ipairs { ... } do words[#words + 1] = word end
    end }
    local said = table.concat(words)
    assert.truthy(said:find "model: motion %a+, twist held, contact none", said)
    local path = os.tmpname() .. ".html"
    run:report(path)
    local file = assert(io.open(path))
    local text = file:read "a"
    file:close()
    os.remove(path)
    assert.truthy(text:find("no friction torque: nothing with friction touches a wire", 1, true))
  end)

  it("gives the same bits in a second run, and leaves nothing behind", function()
    local one, two = hung(2), hung(2)
    assert.equal(tostring(one:error_bars()), tostring(two:error_bars()))
    local a, b = tostring(one:why()):gsub(" took [%d.e-]+ s; the run.*", ""), tostring(two:why()):gsub(
      " took [%d.e-]+ s; the run.*", "")
    assert.equal(a, b)
    local _, scene, w = hung(2)
    assert.is_nil(w:get().spin_inertia)
    assert.truthy(scene:script():find('model = "auto"', 1, true))
    assert.is_nil(scene:script():find("wire_contact", 1, true))
  end)

  -- An error of a process is the script's: it comes out unchanged, and the scene is as before.
  it("passes on errors of processes, and puts the scene back", function()
    local scene = sw.scene()
    local w = rod.wire(scene)
    scene:clamp(w, { s = 0 })
    scene:process(function(p)
      p:wait(0.02)
      error({ "mine" })
    end)
    local before = w:positions()
    local fine, why = pcall(scene.run, scene, { tolerance = { tip = 0.01 } })
    assert.is_false(fine)
    assert.truthy(type(why) == "table" and why[1] == "mine" or tostring(why):find "mine", tostring(why))
    assert.same(before, w:positions())
    assert.equal(0, scene.time)
  end)

  it("refuses runs without a tolerance, and wrong arguments", function()
    local scene = sw.scene()
    local w = rod.wire(scene)
    scene:clamp(w, { s = 0 })
    fails(function() scene:run { duration = 0.1 } end, "wire 'w' has model = 'auto'", "tolerance = {")
    fails(function() scene:run { duration = 0.1, model = "auto" } end, "needs a purpose")
    fails(function() scene:run { duration = 0.1, model = "rod", tolerance = { tip = 1 } } end,
      "model = rod is not allowed", "'auto'")
    fails(function() scene:run { duration = 0.1, tolerance = { tip = { relative = 2 } } } end,
      "relative = 2 is not allowed", "above 0 and below 1")
    fails(function() scene:run { duration = 0.1, tolerance = { tip = { share = 0.1 } } } end,
      "no parameter 'share'")
    local hand = scene:gripper { name = "hand" }
    fails(function() hand:grasp(w, { s = 0.1, approach = "auto" }) end, "gripper 'hand'", "model = 'auto'")
    local plain = sw.scene()
    plain:clamp(rod.wire(plain, { model = "rod" }), { s = 0 })
    fails(function() plain:run { duration = 0.01 }:why() end, "was given, not chosen", "model = 'auto'")
  end)

  -- Changes of 1 % in a parameter change the value by about as much, and the choice in few cases.
  it("changes little under small changes of the scene", function()
    local other, base = 0, hung(3)
    local q = base.quantities.min_bend_radius
    for k = 1, 6 do
      local run = hung(3 * (1 + 0.01 * (k % 3 - 1)), nil, { E = 5e6 * (1 + 0.01 * ((k + 1) % 3 - 1)) })
      local p = run.quantities.min_bend_radius
      assert.is_true(math.abs(p.value - q.value) <= p.error + q.error + 0.02 * q.value)
      for _, name in ipairs { "motion", "twist", "contact" } do
        if run.model[name] ~= base.model[name] then other = other + 1 end
      end
    end
    assert.is_true(other <= 1, ("%d other choices"):format(other))
  end)
end)
