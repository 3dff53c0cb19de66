-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto" does not compute more than it needs: a comparison with dynamics takes few steps; one that
-- two levels agree on is not made on a third; the levels of the run serve as comparisons.
local probe = require "softworld.model.probe"
local refine = require "softworld.run.refine"
local sw = require "softworld"

local computer = refine.computer

-- Counts what is computed while f runs: a list of { poses = bool, segments = of the first wire, choosing = }.
local function counted(f)
  local list = {}
  function refine.computer(job, ...)
    local inner = computer(job, ...)
    return function(k, name)
      local run = inner(k, name)
      list[#list + 1] = { poses = not job.moves, choosing = name == "choosing a model", steps = run.steps,
        segments = job.first[1] << (k - 1) }
      return run
    end
  end
  local fine, result = pcall(f)
  refine.computer = computer
  if not fine then error(result, 0) end
  return result, list
end

-- Returns the first item for which f is true.
local function first(list, f)
  for _, item in ipairs(list) do
    if f(item) then return item end
  end
  return nil
end

-- A cable lies over a peg without friction. Its end is drawn away and down within 20 s. On 10 edges, a node
-- meets the peg. A chord that began to touch there took the node's force once more, and steps of dynamics
-- collapsed to 0.1 us after 2 s; the comparison was then made on 20 edges.
local function pegged(turned)
  local scene, r, peg = sw.scene { name = "pegged" }, 0.0025, 0.033557287888891
  local function at(x, z) return turned and { 0, x, z } or { x, 0, z } end
  scene:obstacle { name = "peg", shape = "cylinder", radius = peg, length = 0.4, friction = 0,
    at = { 0, 0, -peg - r },
    rotation = { axis = turned and { 0, 1, 0 } or { 1, 0, 0 }, angle = math.pi / 2 } }
  local w = scene:wire { name = "w", E = 50e6, density = 1500, radius = r, from = at(-0.2, 0),
    to = at(0.3, 0), segments = 40 }
  scene:clamp(w, { s = 0, name = "hand" }):follow { relative = true, duration = 20,
    points = { { 0, 0, 0 }, at(-0.099042448603764, -0.078931349183082) } }
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 20, model = "auto", tolerance = { ["hand.force"] = { relative = 0.1 } } }
end

describe("choosing a model, where a node meets a peg on the coarsest edges,", function()
  for _, turned in ipairs { false, true } do
    it(turned and "does the same in the turned scene" or "compares without a collapse of steps", function()
      local run, list = counted(function() return pegged(turned) end)
      assert.equal("poses", run.model.motion)
      assert.equal("compared", run.model.choices[1].by, tostring(run:why()))
      assert.is_true(run.met, tostring(run:why()))
      -- without this, dynamics took 40000 steps on the coarsest edges, twice; poses take 125
      for _, c in ipairs(list) do assert.is_true(c.steps < 4000, ("%d steps"):format(c.steps)) end
      local compared = first(list, function(c) return not c.poses end)
      assert.truthy(compared, tostring(run:why()))
      assert.truthy(compared.segments <= 20)
    end)
  end
end)

-- A trunk with two branches lies on a table with friction; its hands are lifted. Poses jump once. Poses and
-- dynamics differ by 0.18 of what is allowed on 8 edges, and by 0.17 on 16.
local function harness()
  local scene, r = sw.scene { name = "harness" }, 0.0018
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local function made(name, from, to, segments)
    return scene:wire { name = name, EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03, radius = r,
      from = from, to = to, segments = segments, model = "auto" }
  end
  local trunk = made("trunk", { 0, 0, r }, { 0.3, 0, r }, 16)
  scene:clamp(trunk, { s = 0, name = "root" })
  local ends, angle = { { trunk, s = 0.3 } }, 0.59117730119905
  for k, name in ipairs { "left", "right" } do
    local side, a = 3 - 2 * k, k == 1 and angle or angle * 0.65381312047331
    local w = made(name, { 0.3, 0, r }, { 0.3 + 0.2 * math.cos(a), side * 0.2 * math.sin(a), r }, 12)
    ends[k + 1] = { w, s = 0 }
    scene:clamp(w, { s = 0.2, name = name .. " hand" }):follow { relative = true, duration = 16,
      points = { { 0, 0, 0 }, { -0.04, -side * 0.026394248250473, 0.049703270098642 } } }
  end
  scene:join { name = "joint", ends = ends }
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene:run { duration = 16, tolerance = { ["left hand.force"] = { relative = 0.01 },
    ["right hand.force"] = { relative = 0.01 } } }
end

describe("choosing a model, where poses jump and two levels agree,", function()
  local run, list = counted(harness)

  it("compares with dynamics on no third level, and its bars hold", function()
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(run.met, tostring(run:why()))
    -- dynamics on 16 to 128 segments; on 64 the forces are 0.1 and 0.4 mN off. In rods with material frames,
    -- whose joint passes no twist, they are 20 and 16 mN off; rolling alone changes them by less than 1 mN.
    local truth = { ["left hand.force"] = { -0.4711, -0.2052, -0.0430 },
      ["right hand.force"] = { -0.3496, 0.2736, 0.0014 } }
    for name, t in pairs(truth) do
      local q = run.quantities[name]
      local off = ((q.value[1] - t[1]) ^ 2 + (q.value[2] - t[2]) ^ 2 + (q.value[3] - t[3]) ^ 2) ^ 0.5
      assert.is_true(off <= q.error, ("%s is %g N off"):format(name, off))
    end
    assert.truthy(first(list, function(c) return not c.poses and c.segments == 8 end))
    assert.falsy(first(list, function(c) return not c.poses and c.segments > 16 end))
  end)
end)

-- A cable is pressed down by its ends and snaps into a clip. c: of the cable and of the way; flip: the same
-- seen from the other side, with swapped ends; options: of the run.
local function pressed(c, flip, options)
  local scene, span = sw.scene { name = "clipped" }, c.span
  scene:clip { name = "clip", at = { flip and 0 or span / 2, flip and span / 2 or 0, 0 }, width = 0.01,
    insertion = c.insertion, retention = 3 * c.insertion, friction = 0.25,
    axis = flip and { 0, 1, 0 } or nil }
  local from, to = { 0, 0, 0.035 }, flip and { 0, span, 0.035 } or { span, 0, 0.035 }
  if flip then from, to = to, from end
  local w = scene:wire { name = "w", E = c.E, density = 1500, radius = c.radius, segments = 32, from = from,
    to = to }
  for s, name in pairs { [0] = "left", [span] = "right" } do
    scene:clamp(w, { s = s, name = name }):follow { relative = true, duration = c.duration,
      points = { { 0, 0, 0 }, { 0, 0, -c.down } } }
  end
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  options.duration = c.duration
  return scene:run(options)
end

-- The radius on 8 edges is far from that of the finest run, so poses and dynamics are compared on finer ones,
-- up to 32, on which the run had computed poses.
local function clipped()
  return pressed({ E = 20e6, radius = 0.0025, span = 0.16131133910558, insertion = 1.1535811776084,
    duration = 1, down = 0.055550941100093 }, false, { model = "auto",
      tolerance = { min_bend_radius = { relative = 0.1 } } })
end

-- On 8 and 16 edges the bend radius is off by 11 and 1.1 %, and 1 % is asked for. The wire is at the same
-- place there, and dynamics change the force by 0.08 and 0.03 of what is allowed.
describe("choosing a model, where a finer comparison confirms a coarse one,", function()
  local cable = { E = 60e6, radius = 0.004, span = 0.165, insertion = 3.6, duration = 4, down = 0.0463 }

  for _, flip in ipairs { false, true } do
    it(flip and "does the same with the cable turned and its ends swapped"
      or "makes no third one, and its bars hold", function()
      local run, list = counted(function()
        return pressed(cable, flip, { model = "auto", tolerance = { min_bend_radius = { relative = 0.01 },
          ["left.force"] = { relative = 0.01 } } })
      end)
      assert.equal("poses", run.model.motion, tostring(run:why()))
      assert.is_true(run.met, tostring(run:why()))
      assert.truthy(first(list, function(c) return not c.poses and c.segments == 16 end))
      assert.falsy(first(list, function(c) return not c.poses and c.segments > 16 end), tostring(run:why()))
      -- dynamics on 8 to 128 segments: bars of 0.19 mm and 17 mN
      local q, force = run.quantities.min_bend_radius, run.quantities["left.force"]
      assert.is_true(math.abs(q.value - 0.08016) <= q.error, tostring(q))
      assert.is_true(math.abs((force.value[1] ^ 2 + force.value[2] ^ 2) ^ 0.5 - 31.42) <= force.error,
        tostring(force))
      assert.is_true(math.abs(force.value[3] + 7.901) <= force.error, tostring(force))
    end)
  end
end)

describe("choosing a model, where the finest run asks for finer comparisons,", function()
  local function times(list, poses, segments)
    local n = 0
    for _, c in ipairs(list) do n = n + ((c.poses == poses and c.segments == segments) and 1 or 0) end
    return n
  end

  it("takes the poses of the run's levels, with the same result as if they were computed again", function()
    local run, list = counted(clipped)
    assert.equal(1, times(list, true, 32), tostring(run:why()))
    assert.is_true(times(list, false, 32) == 1, tostring(run:why()))
    local keep = probe.keep
    function probe.keep() end
    local other, more = counted(clipped)
    probe.keep = keep
    assert.equal(2, times(more, true, 32), tostring(other:why()))
    local a, b = run.quantities.min_bend_radius, other.quantities.min_bend_radius
    assert.same({ b.value, b.error, b.model_error }, { a.value, a.error, a.model_error })
    assert.equal(other.model.motion, run.model.motion)
  end)
end)
