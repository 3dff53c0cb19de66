-- SPDX-License-Identifier: GPL-3.0-or-later
-- What choosing a model leaves out because it can no longer change much, or costs more than it may save. Each
-- count of computations is that of the rungs and levels named beside it.
local contact = require "softworld.model.contact"
local motion = require "softworld.model.motion"
local probe = require "softworld.model.probe"
local refine = require "softworld.run.refine"
local rod = require "spec.model.rod"
local sealed = require "softworld.sealed"
local sw = require "softworld"

local function speed(wire)
  local most = 0
  for _, v in ipairs(wire:velocities()) do most = math.max(most, math.abs(v)) end
  return most
end

-- Two wires hang one above the other, by `gap` over the radius. value(touching, moving, level) is the
-- quantity, asked for to 0.03: true if touches of wires are computed, true for dynamics, and the level of
-- edges from 1.
local function beside(value, args, gap)
  local scene, a = sw.scene { name = "beside" }, nil
  scene:force { kind = "damping", mass = 5 }
  for _, z in ipairs { 0, gap * rod.radius } do
    local w = rod.wire(scene, { name = z > 0 and "b" or "a", from = { 0, 0, z }, to = { 0.6, 0, z } })
    scene:clamp(w, { s = 0 })
    scene:clamp(w, { s = 0.6 }):follow { relative = true, points = { { 0, 0, 0 }, { -0.1, 0, 0 } },
      duration = 0.5 }
    a = a or w
  end
  local function odd()
    local level = 1 + math.tointeger(math.log(sw.core.segments(a) / 6, 2) // 1)
    return value(sw.core.data(scene).touching ~= nil, speed(a) > 0, level)
  end
  args.duration, args.model, args.levels = 0.5, "auto", 3
  args.tolerance = { { name = "odd", value = 0.03, unit = "-", of = odd } }
  return scene:run(args)
end

local NEAR, FAR = 2.2, 40 -- gaps over the radius: the wires touch; they do not [-]
local LONG, SHORT = 1e-4, 0.01 -- steps of runs that take more than a moment, and less [s]

describe("choosing a model, where touches of wires change a value,", function()
  -- The change is d, less `less` for each level. The second level allows up to 0.875 of the tolerance,
  -- 0.02625. more: error of edges on level 0, a quarter of it on the next.
  local function changed(d, dt, less, more)
    local function value(touching, _, k)
      return 1 + (more or 0) / 4 ^ k + (touching and d - k * (less or 0) or 0)
    end
    return beside(value, { quasistatic = true, dt = dt }, NEAR)
  end

  -- By the second level, the bar of the third will be 1.5 (0.1 - 0.025) / 2 = 0.056: a fourth may be needed.
  it("compares no third level of rungs that cost nearly the same, unless it takes a moment only", function()
    local long, short = changed(0.05, LONG, 0.004, 0.4), changed(0.05, SHORT, 0.004, 0.4)
    assert.equal("wires", long.model.contact)
    assert.equal("wires", short.model.contact)
    assert.equal(4, long.model.probes, tostring(long:why())) -- two rungs on two levels
    assert.equal(6, short.model.probes, tostring(short:why()))
  end)

  it("takes touches if what they change leaves too little to edges and steps", function()
    local run = changed(0.0227, LONG) -- 0.243 of the tolerance is left: edges and steps of a quarter
    assert.equal("wires", run.model.contact)
    local why = tostring(run:why())
    assert.truthy(why:find("finer edges and steps for the rest", 1, true), why)
    assert.equal(0, run.quantities.odd.model_error)
  end)

  it("does not if more is left, or a run takes a moment only", function()
    for _, row in ipairs { { d = 0.014, dt = LONG }, { d = 0.0227, dt = SHORT } } do
      local run = changed(row.d, row.dt)
      assert.equal("none", run.model.contact, tostring(run:why()))
      assert.is_true(run.quantities.odd.model_error >= row.d * (1 - 1e-9)) -- 1 + d is rounded
    end
  end)
end)

describe("choosing a model, where dynamics change next to nothing and another choice rises,", function()
  local alike, free = motion.alike, contact.free
  after_each(function() motion.alike, contact.free = alike, free end)

  local function risen()
    function contact.free() return nil end -- as if it were not known that the wires are apart
    return beside(function(on, moving) return 1 + (on and 0.5 or 0) + (moving and 1e-5 or 0) end,
      { dt = 2e-4 }, FAR)
  end

  it("does not compute dynamics again", function()
    local run = risen()
    function motion.alike() return false end
    local other = risen()
    assert.equal("wires", run.model.contact)
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.equal("poses", other.model.motion)
    assert.equal(other.model.probes - 1, run.model.probes)
    assert.is_true(run.quantities.odd.model_error >= 1e-5)
  end)

  it("is not so if poses jump, or inertia has grown", function()
    local calm = { jumps = 0, acceleration = 1 }
    assert.is_true(alike(calm, { jumps = 0, acceleration = 1.9 }))
    assert.is_false(alike(calm, { jumps = 0, acceleration = 2.1 }))
    assert.is_false(alike(calm, { jumps = 1, acceleration = 1 }))
    assert.is_false(alike({ jumps = 1, acceleration = 1 }, calm))
    assert.is_false(alike(calm, { jumps = 0 }))
  end)
end)

describe("choosing a model, where touches of wires must be compared on three levels,", function()
  local computer, free, doubtful = refine.computer, contact.free, contact.doubtful
  after_each(function() refine.computer, contact.free, contact.doubtful = computer, free, doubtful end)

  local count
  before_each(function()
    count = 0
    function contact.free() return nil end
    function refine.computer(...)
      local compute = computer(...)
      return function(...)
        count = count + 1
        return compute(...)
      end
    end
  end)

  -- Poses stay by the third level; then touches are computed on the first one.
  it("takes over a third level after which another choice was compared", function()
    local run = beside(function(_, moving, k)
      return 1 + (moving and ({ 0.03, 0.02, 0.005 })[math.min(k, 3)] or 0)
    end, {}, NEAR)
    assert.same({ "poses", "none" }, { run.model.motion, run.model.contact }, tostring(run:why()))
    assert.equal(run.model.probes, count, tostring(run:why()))
    assert.equal(3, #run.levels)
    local scene, wire = run.scene, run.scene:find "a"
    local edges = run.levels[3].segments[1]
    local frame = scene:frame(scene:frame_count())
    assert.same({ edges, 0, 3 * (edges + 1) }, { sw.core.segments(wire), speed(wire), #frame.wires[1] })
    assert.is_near(run.time, frame.t, 1e-9)
  end)

  it("takes the third level over into the run", function()
    function contact.doubtful(_, k) return k < 3 end
    local run = beside(function(on) return 1 + (on and 0.002 or 0) end, { quasistatic = true }, NEAR)
    assert.equal("none", run.model.contact, tostring(run:why()))
    assert.same({ 6, 6, 3 }, { run.model.probes, count, #run.levels })
  end)
end)

describe("choosing a model, where wires pass through each other,", function()
  local of = probe.of
  after_each(function() probe.of = of end)

  -- The upper wire comes down through the other one, by a fifth of its length.
  it("computes no dynamics without touches", function()
    local without, with = 0, 0
    function probe.of(context, rungs, ...)
      local moves = rungs.motion == 2
      without, with = without + (moves and rungs.contact == 1 and 1 or 0), with + (moves and 1 or 0)
      return of(context, rungs, ...)
    end
    local scene = sw.scene { name = "crossed" }
    scene:force { kind = "damping", mass = 5 }
    local a = rod.wire(scene, { name = "a", from = { -0.2, 0, 0 }, to = { 0.2, 0, 0 } })
    local b = rod.wire(scene, { name = "b", from = { 0, -0.2, 0.02 }, to = { 0, 0.2, 0.02 } })
    for i, s in ipairs { 0, 0.4 } do
      scene:clamp(a, { s = s })
      scene:clamp(b, { s = s, name = "b" .. i }):follow { relative = true, duration = 1,
        points = { { 0, 0, 0 }, { 0, 0, -0.08 } } }
    end
    scene:settle()
    local run = scene:run { duration = 1, model = "auto", tolerance = { ["b1.force"] = { relative = 0.01 } } }
    assert.equal("wires", run.model.contact, tostring(run:why()))
    assert.same({ 0, true }, { without, with > 0 })
    assert.truthy(tostring(run:why()):find("with touches of wires b1.force changes by", 1, true))
  end)

  -- Half a circle of three edges, of radius R; a straight wire lies outside, 0.2 R from the middle edge. The
  -- arc would bow by R (1 - cos 30 degrees) = 0.134 R beside this edge; its bound is a quarter of half the
  -- edge times the angle, R/2 pi/3 / 4 = 0.131 R.
  it("sees by their edges whether they are in each other, not by their bow", function()
    local scene, arc, radius = sw.scene { gravity = { 0, 0, 0 } }, {}, 0.1
    for i = 0, 3 do
      local x = math.pi * i / 3
      arc[i + 1] = { radius * math.cos(x), radius * math.sin(x), 0 }
    end
    local y = arc[2][2] + 0.2 * radius
    for _, args in ipairs { { path = arc, rest = "path", segments = 3 },
      { from = { -0.2, y, 0 }, to = { 0.2, y, 0 }, segments = 4 } } do
      args.E, args.density, args.radius = 5e6, 1500, rod.radius
      scene:clamp(scene:wire(args), { s = 0 })
    end
    scene:run { dt = 1e-4, duration = 1e-3, frame = 1e-3 }
    local function apart(straight) return sw.core.frames_apart(scene, 1, 2, 0, 0, 1, straight) end
    assert.is_near(0.2 * radius, apart(true), 1e-5)
    assert.is_near((0.2 - math.pi / 24) * radius, apart(), 1e-5)
    assert.same({ true, true, true, false, false }, { contact.doubtful({ crossed = true, bowed = true }, 1),
      contact.doubtful({ crossed = true, bowed = true }, 2), contact.doubtful({ bowed = true }, 1),
      contact.doubtful({ bowed = true }, 2), contact.doubtful({}, 1) })
  end)
end)

-- Poses end at another value on each level, three times as large, as if the wire were at another place: a bar
-- of 900 tolerances. On the third level they jump, if this spec has it so.
describe("choosing a model, where coarse edges show another state,", function()
  local computer = refine.computer
  after_each(function() refine.computer = computer end)

  local function elsewhere(jumps)
    function refine.computer(job, steps, run_once, total)
      return computer(job, steps, function(scene, options, ...)
        local run = run_once(scene, options, ...)
        local fine = jumps and options.quasistatic and sw.core.segments(scene:find "a") >= 24
        if fine then rawset(sealed.fields(run), "jumps", 1) end
        return run
      end, total)
    end
    return beside(function(_, moving, level) return 3 ^ level + (moving and 0.005 or 0) end, {}, FAR)
  end

  it("takes dynamics at once if poses jump on fine edges and their bar is hopeless", function()
    local jump, calm = elsewhere(true), elsewhere(false)
    assert.equal("dynamic", jump.model.motion)
    local why = tostring(jump:why())
    local words = "poses jump on fine edges, which leaves an error bar of more than 50 times"
    assert.truthy(why:find(words, 1, true), why)
    assert.equal("poses", calm.model.motion) -- dynamics of the third level agree with poses
    assert.is_true(jump.model.probes < calm.model.probes, ("%d and %d"):format(jump.model.probes,
      calm.model.probes))
  end)
end)

-- Dynamics change nothing: the moment is 0 but for what edges and rounding leave, which differs from level to
-- level. The straight wire turns about itself: it is at the same place on all edges.
describe("choosing a model, where wires do not move,", function()
  it("compares no finer edges", function()
    local scene, r = sw.scene { name = "turned" }, 0.0025
    scene:obstacle { name = "table", shape = "plane", friction = 0 }
    local w = scene:wire { name = "w", E = 5e6, density = 1500, radius = r, from = { 0, 0, r },
      to = { 0.4, 0, r }, segments = 24 }
    scene:clamp(w, { s = 0, name = "hand" }):follow { relative = true, duration = 4,
      points = { { 0, 0, 0 }, { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = 1 } }
    scene:force { kind = "damping", mass = 5 }
    scene:settle()
    local run = scene:run { duration = 4, model = "auto",
      tolerance = { ["hand.moment"] = { relative = 0.03 }, tip = { relative = 0.03 } } }
    assert.is_true(run.ok)
    assert.equal("poses", run.model.motion)
    assert.equal(2, run.model.probes, tostring(run:why())) -- poses and dynamics on the coarsest edges
  end)
end)
