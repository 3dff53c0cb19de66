-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto" with wires that are joined or move together: what need not be computed to choose. Poses
-- that jump on the coarsest edges decide nothing.
local contact = require "softworld.model.contact"
local motion = require "softworld.model.motion"
local rod = require "spec.model.rod"
local sw = require "softworld"

local R, core = rod.radius, sw.core

-- Calls f() while instead(own, ...) replaces a function of a table.
local function with(of, name, instead, f)
  local own = of[name]
  of[name] = function(...) return instead(own, ...) end
  local fine, why = pcall(f)
  of[name] = own
  assert(fine, why)
end

local function choice(run, name)
  for _, c in ipairs(run.model.choices) do
    if c.name == name then return c end
  end
end

-- Two branches at an angle [rad] at the end of a trunk; their ends are moved. nearer: way of each hand to
-- the middle [m]; join = false: clamps hold the ends where they would be joined. rolls: with material frames.
local function branched(angle, nearer, join, rolls)
  local scene = sw.scene { name = "branched" }
  scene:force { kind = "damping", mass = 5 }
  local trunk = rod.wire(scene, { name = "trunk", to = { 0.3, 0, 0 }, segments = 16, rolls = rolls })
  local ends = { { trunk, s = 0.3 } }
  scene:clamp(trunk, { s = 0, name = "root" })
  for k, name in ipairs { "left", "right" } do
    local side = 3 - 2 * k
    local w = rod.wire(scene, { name = name, from = { 0.3, 0, 0 }, segments = 12, rolls = rolls,
      to = { 0.3 + 0.2 * math.cos(angle), side * 0.2 * math.sin(angle), 0 } })
    ends[k + 1] = { w, s = 0 }
    scene:clamp(w, { s = 0.2 }):follow { relative = true, duration = 4,
      points = { { 0, 0, 0 }, { 0, -side * nearer, -0.02 } } }
  end
  if join ~= false then scene:join { ends = ends } end
  for _, e in ipairs(join == false and ends or {}) do scene:clamp(e[1], { s = e.s }) end
  scene:settle()
  return scene:run { duration = 4, model = "auto", tolerance = { ["root.force"] = { relative = 0.1 } } }
end

describe("model = 'auto' of a harness", function()
  it("knows without computing touches that its wires meet only where they are joined", function()
    local run = branched(0.6, 0.02)
    assert.equal("none", run.model.contact, tostring(run:why()))
    assert.equal("free", choice(run, "contact").by, tostring(run:why()))
    assert.truthy(tostring(run:why()):find("wires cannot meet", 1, true))
  end)

  it("says that a joint passes no twist where one wire would resist it", function()
    local text = "not checked: joints: 'join1' passes no twist from wire"
    local joined = branched(0.6, 0.02, nil, true)
    assert.truthy(tostring(joined:why()):find(text, 1, true), tostring(joined:why()))
    for _, run in ipairs { branched(0.6, 0.02, false, true), branched(0.6, 0.02) } do
      assert.is_nil(tostring(run:why()):find("joints", 1, true), tostring(run:why()))
    end
  end)

  it("computes touches where its branches come near each other elsewhere", function()
    local run = branched(0.6, 0.2 * math.sin(0.6) - R)
    assert.is_not.equal("free", choice(run, "contact").by, tostring(run:why()))
  end)

  it("computes touches where the ends of wires lie together without a join", function()
    local run = branched(0.6, 0.02, false)
    assert.is_not.equal("free", choice(run, "contact").by, tostring(run:why()))
  end)

  -- Two halves of a wire between clamps, joined in a row. Each alone swings faster than the whole.
  it("uses a period below that of all wires together", function()
    local swing
    local scene = sw.scene { name = "halves" }
    scene:force { kind = "damping", mass = 5 }
    local a = rod.wire(scene, { name = "a", to = { 0.3, 0, 0 }, segments = 24 })
    local b = rod.wire(scene, { name = "b", from = { 0.3, 0, 0 }, to = { 0.6, 0, 0 }, segments = 24 })
    scene:clamp(a, { s = 0 })
    scene:join { ends = { { a, s = 0.3 }, { b, s = 0 } } }
    scene:clamp(b, { s = 0.3, name = "right" }):follow { relative = true, duration = 0.5,
      points = { { 0, 0, 0 }, { -0.02, 0, 0 } } }
    with(motion, "look", function(own, ...)
      local f = own(...)
      swing = swing or f.swing
      assert.is_nil(f.period) -- it would have to be no shorter than theirs
      return f
    end, function()
      scene:settle()
      scene:run { duration = 0.5, model = "auto", tolerance = { ["right.force"] = { relative = 0.1 } } }
    end)
    local whole = sw.scene()
    local w = rod.wire(whole, { model = "rod", segments = 48 })
    whole:clamp(w, { s = 0 })
    whole:clamp(w, { s = 0.6 })
    whole:settle()
    local longest = 1 / w:frequencies { modes = 1 }[1]
    assert.is_true(swing > 0.1 * longest and swing < longest, ("%s of %g s"):format(swing, longest))
  end)
end)

-- A clamped trunk lies on a rough table; the end of a branch that leaves it sideways is lifted. args: of the
-- wires.
local function lifted(args)
  local scene, wires = sw.scene { name = "lifted" }, {}
  local height, angle = 2.6e-3, math.rad(35)
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:force { kind = "damping", mass = 4, stiffness = 5e-3 }
  for _, name in ipairs { "trunk", "branch" } do
    local all = { name = name, cable = name == "trunk" and "GXL 6" or "GXL 1.5",
      from = { name == "trunk" and 0 or 0.3, 0, height },
      to = name == "trunk" and { 0.3, 0, height }
        or { 0.3 + 0.2 * math.cos(angle), 0.2 * math.sin(angle), height } }
    for key, value in pairs(args) do all[key] = value end
    wires[name] = scene:wire(all)
  end
  scene:join { ends = { { wires.trunk, s = 0.3 }, { wires.branch, s = 0 } }, name = "joint" }
  scene:clamp(wires.trunk, { s = 0 })
  scene:tie(wires.trunk, { s = 0.15, to = { 0.15, 0, 0 } })
  local hand = scene:gripper { name = "hand" }
  scene:process(function(p)
    hand:grasp(wires.branch, { s = wires.branch.length })
    hand:move { by = { -0.03, 0, 0.08 }, duration = 1 }
    hand:move { by = { -0.03, 0.05, 0 }, duration = 1 }
    p:wait(0.5)
  end)
  return scene, wires.branch
end

-- Wires that roll pass no twist on through a joint: rolling gave 78.8 mm +- 1.3 mm, and was taken.
describe("model = 'auto' of a harness that friction rubs", function()
  it("keeps the twist that a rigid joint passes on", function()
    local fine, branch = lifted { segments = 80 }
    assert(fine:run { dt = 2.5e-3 }.ok)
    local run = lifted { segments = 20 }:run { model = "auto",
      tolerance = { ["hand.peak_force"] = { relative = 0.05 },
        ["branch.min_bend_radius"] = { relative = 0.1 } } }
    local q = run.quantities["branch.min_bend_radius"]
    print(("measured: radius %.2f +- %.2f mm, of fine rods %.2f mm"):format(1e3 * q.value, 1e3 * q.error,
      1e3 * branch:min_bend_radius()))
    assert.equal("held", run.model.twist, tostring(run:why()))
    assert.is_near(branch:min_bend_radius(), q.value, q.error)
    for _, e in ipairs(run.events) do assert.is_not.equal("joint", e.kind, e.text) end
    assert.truthy(tostring(run:why()):find("not checked: twist: wires that roll pass no twist", 1, true))
  end)

  it("knows the joints of a loaded scene", function()
    local file = os.tmpname()
    lifted({ segments = 20, model = "rod" }):save(file)
    local scene = sw.load(file)
    os.remove(file)
    scene:clamp(scene:find "branch", { s = 0.2 }):follow { relative = true, duration = 1,
      points = { { 0, 0, 0 }, { -0.03, 0.05, 0.08 } } }
    local run = scene:run { duration = 1.2, model = "auto",
      tolerance = { ["branch.min_bend_radius"] = { relative = 0.1 } } }
    assert.truthy(tostring(run:why()):find("not checked: twist: wires that roll pass no twist", 1, true))
  end)
end)

describe("how near wires come by their frames", function()
  -- Two wires side by side, both drawn along by 0.1 m between frames: their distance stays.
  it("ignores the motion that both share", function()
    local scene = sw.scene { gravity = { 0, 0, 0 } }
    for k = 0, 1 do
      local w = rod.wire(scene, { model = "rod", name = "w" .. k, from = { 0, 0.05 * k, 0 },
        to = { 0.3, 0.05 * k, 0 } })
      for _, s in ipairs { 0, 0.3 } do
        scene:clamp(w, { s = s }):follow { relative = true, duration = 1,
          points = { { 0, 0, 0 }, { 0, 1, 0 } } }
      end
    end
    scene:run { duration = 1, dt = 0.05, quasistatic = true, frame = 0.1 }
    assert.is_near(0.05, core.frames_apart(scene, 1, 2, 0, 2 * R), 1e-4)
    assert.is_near(0.03, core.frames_apart(scene, 1, 2, 0, 2 * R, 0.03), 0) -- the search ends at this limit
  end)
end)

-- One end of a wire on a rough table is drawn aside. parts(moves, rolls, level): the quantity, which is
-- made up. The choices are told that poses jump.
local function drawn(parts, share)
  local scene, seen = sw.scene { name = "drawn" }, {}
  scene:force { kind = "damping", mass = 5 }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local w = rod.wire(scene, { from = { 0, 0, R }, to = { 0.6, 0, R } })
  scene:clamp(w, { s = 0 }):follow { relative = true, duration = 1,
    points = { { 0, 0, 0 }, { 0, 0.02, 0 } } }
  scene:settle()
  local function odd()
    local level = math.tointeger(math.log(core.segments(w) / 6, 2) // 1) + 1
    local moves, rolls = false, w:get().spin_inertia ~= nil
    for _, v in ipairs(w:velocities()) do moves = moves or v ~= 0 end
    if rolls then seen[level] = true end
    return parts(moves, rolls, level)
  end
  local run
  with(motion, "look", function(own, context, of)
    local f = own(context, of)
    f.jumps = context.job.moves and 0 or 1
    return f
  end, function()
    run = scene:run { duration = 1, model = "auto",
      tolerance = { { name = "odd", relative = share, unit = "-", of = odd } } }
  end)
  return run, seen
end

describe("model = 'auto', where poses on coarse edges jump to another place than on finer ones,", function()
  it("stays with poses that suffice on finer edges, and leaves the first level out of the bar", function()
    local run = drawn(function(moves, _, level) return level == 1 and not moves and 50 or 1 end, 0.1)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(run.met, tostring(run:why()))
    assert.is_true(#run.quantities.odd.levels == #run.levels - 1)
    for _, value in ipairs(run.quantities.odd.levels) do assert.is_near(1, value, 1e-12) end
  end)

  it("goes on with dynamics where poses differ on finer edges too", function()
    local run = drawn(function(moves, _, level) return not moves and (level == 1 and 50 or 3) or 1 end, 0.1)
    assert.equal("dynamic", run.model.motion, tostring(run:why()))
  end)

  -- A tenth of 0.2 allows a change of 0.02; of 1, the value on the next level, this is a small part.
  it("takes a relative tolerance from the finest level known", function()
    local run, rolled = drawn(function(moves, rolls, level)
      return (level == 1 and 0.2 or 1) + (moves and 0.03 or 0) + (rolls and level == 1 and 0.02 or 0)
    end, 0.1)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.equal("held", run.model.twist, tostring(run:why()))
    assert.is_true(rolled[1])
    assert.is_nil(rolled[2])
  end)
end)

describe("what was seen of touches", function()
  it("is not evaluated again when the run has ended", function()
    local frames = {}
    with(contact, "look", function(own, context, ...)
      local from = context.guard and context.guard.from
      frames[#frames + 1] = { watched = context.watching, from = from, time = context.scene.time }
      return own(context, ...)
    end, function() branched(0.6, 0.02) end)
    local last = frames[#frames]
    assert.is_true(last.watched)
    assert.is_true(last.from > 0.5 * last.time, ("%g of %g s"):format(last.from, last.time))
  end)
end)
