-- SPDX-License-Identifier: GPL-3.0-or-later
-- The cost of choosing a model: nothing is computed that cannot change the choice, and nothing with a rung
-- that has turned out to be the dearer one.
local hung = require "spec.model.hung"
local quantity = require "softworld.quantity"
local rod = require "spec.model.rod"
local sealed = require "softworld.sealed"
local sw = require "softworld"

local function toils(run_once, ...)
  local run = run_once(...)
  rawset(sealed.fields(run), "iterations", 1000 * run.steps)
  return run
end

describe("model = 'auto', where poses of fine edges need many iterations,", function()
  it("goes on with dynamics before the next level, and has the same value", function()
    local poses, run = hung.run(), hung.run(toils)
    assert.equal("poses", poses.model.motion)
    assert.equal("dynamic", run.model.motion)
    local why = tostring(run:why())
    assert.truthy(why:find("poses cost more: %d+ iterations on a mesh on which dynamics take %d+"), why)
    local away, bars = hung.apart(poses, run)
    assert.is_true(away <= bars, ("%.3g N apart"):format(away))
  end)
end)

-- Two wires hang one above the other. The quantity differs from level to level, so that its bar is never
-- short; computing touches changes it by `change`.
local function beside(change)
  local scene = sw.scene { name = "beside" }
  local a = rod.beside(scene, { relative = true, points = { { 0, 0, 0 }, { -0.1, 0, 0 } }, duration = 0.5 })
  local function odd()
    local level = math.tointeger(math.log(sw.core.segments(a) / 6, 2) // 1)
    return 1 + 0.02 * (level % 2) + (sw.core.data(scene).touching and change or 0)
  end
  return scene:run { duration = 0.5, model = "auto", levels = 4, quasistatic = false,
    tolerance = { { name = "odd", value = 0.03, unit = "-", of = odd } } }
end

describe("model = 'auto', where a bar stays too long,", function()
  it("computes the next rung if that may shorten it", function()
    local run = beside(0.015)
    assert.is_false(run.met)
    assert.equal("wires", run.model.contact, tostring(run:why()))
    assert.truthy(tostring(run:why()):find("with no touches of wires the error bar of odd is still", 1, true))
  end)

  it("does not if the value changes by far less than the bar is too long", function()
    local run = beside(1e-5)
    assert.is_false(run.met)
    assert.equal("none", run.model.contact, tostring(run:why()))
  end)
end)

describe("model = 'auto', where wires touch each other,", function()
  it("no longer measures how near they come", function()
    local apart, alone, touching = sw.core.frames_apart, 0, 0
    function sw.core.frames_apart(scene, ...)
      if sw.core.data(scene).touching then touching = touching + 1 else alone = alone + 1 end
      return apart(scene, ...)
    end
    local fine, run = pcall(beside, 0.015)
    sw.core.frames_apart = apart
    assert.is_true(fine, tostring(run))
    assert.equal("wires", run.model.contact)
    assert.is_true(alone > 0)
    assert.equal(0, touching)
  end)
end)

-- A cable is pressed into a clip and jumps over its lips. Both ends go down by `past` [m] below the clip.
local function clipped(row, args)
  local scene, high = sw.scene { name = "clipped" }, 0.035
  scene:clip { name = "clip", at = { row.span / 2, 0, 0 }, width = 0.01, insertion = row.insertion,
    retention = 3 * row.insertion, friction = 0.25 }
  local w = scene:wire { name = "w", from = { 0, 0, high }, to = { row.span, 0, high }, segments = 32,
    E = row.E, density = 1500, radius = row.radius }
  for s, name in pairs { [0] = "left", [row.span] = "right" } do
    scene:clamp(w, { s = s, name = name }):follow { relative = true, duration = 4,
      points = { { 0, 0, 0 }, { 0, 0, -high - row.past } } }
  end
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  args.duration, args.tolerance = 4, { ["left.force"] = { relative = args.share } }
  args.share = nil
  return scene:run(args)
end

-- On one level, because the wire swings after the jump, and step control shortens the steps there. The mean
-- step of the run, 9 to 25 ms, would not show a swing of 5 to 20 ms.
describe("model = 'auto', where a wire jumps,", function()
  for _, row in ipairs { { E = 60e6, radius = 0.0025, span = 0.15, insertion = 2, past = 0.015 },
    { E = 60e6, radius = 0.004, span = 0.16, insertion = 1.6, past = 0.0046 },
    { E = 60e6, radius = 0.004, span = 0.13, insertion = 2.5, past = 0.0011 },
    { E = 20e6, radius = 0.004, span = 0.12, insertion = 3.3, past = 0.013 } } do
    it(("compares with dynamics on one level, E %g MPa, span %g m"):format(row.E / 1e6, row.span), function()
      local run = clipped(row, { share = 0.1, model = "auto" })
      assert.is_true(run.met, tostring(run:why()))
      assert.equal("poses", run.model.motion)
      assert.equal("compared", run.model.choices[1].by)
      assert.equal(2, run.model.probes)
      local truth = clipped(row, { share = 0.01 }).quantities["left.force"]
      local q = run.quantities["left.force"]
      local away = quantity.distance(q.value, truth.value)
      assert.is_true(away <= q.error + truth.error, ("%.3g N apart"):format(away))
    end)
  end
end)

-- A wire falls on a table while one end is moved to the side.
describe("model = 'auto', where the scene does not rest as it begins,", function()
  local function dropped(args)
    local scene = sw.scene { name = "dropped" }
    scene:obstacle { name = "table", shape = "plane", friction = 0 }
    local w = scene:wire { name = "w", EA = 1e4, EI = 2e-3, GJ = 2e-3, mass_per_length = 0.03,
      radius = 0.0018, from = { 0, 0, 0.02 }, to = { 0.5, 0, 0.02 }, segments = 24 }
    scene:clamp(w, { s = 0 }):follow { relative = true, duration = 0.4,
      points = { { 0, 0, 0 }, { 0, 0.03, 0 } } }
    scene:force { kind = "damping", mass = 5 }
    args.duration, args.tolerance = 0.5, { tip = { relative = args.share } }
    args.share = nil
    return scene:run(args)
  end

  it("judges by where the first poses end what coarse steps show of a swing, and stays with poses", function()
    local truth = dropped { share = 0.01 }
    local run = dropped { share = 0.1, model = "auto" }
    local a, b = truth.quantities.tip, run.quantities.tip
    local away = 0
    for i = 1, 3 do away = away + (a.value[i] - b.value[i]) ^ 2 end
    assert.equal("poses", run.model.motion, tostring(run:why()))
    assert.is_true(away ^ 0.5 <= a.error + b.error, ("%.3g m apart"):format(away ^ 0.5))
    assert.is_true(away ^ 0.5 > 0.3 * b.tolerance) -- the change is visible
  end)
end)

-- A cantilever lies down on a rod that hardly presses on it. Meshes of its section would take a minute on the
-- second level, which a bar needs; two levels of the line tell that no mesh meets 1e-12 of the tip's place.
describe("model = 'auto', asked for more than any mesh reaches,", function()
  it("computes no mesh, and says why", function()
    local scene = sw.scene {}
    local w = scene:wire { E = 4.75e7, density = 1400, radius = 0.003, from = { 0, 0, 0.02 },
      to = { 0.3, 0, 0.02 }, segments = 15 }
    scene:clamp(w, { s = 0 })
    scene:obstacle { shape = "cylinder", radius = 0.02, length = 0.1, at = { 0.2, 0, -0.05 },
      rotation = { axis = { 1, 0, 0 }, angle = 1.57 } }
    scene:run { duration = 0.05, quasistatic = true, max_steps = 1 }
    scene:run { duration = 0.02, tolerance = { tip = 1e-2 }, levels = 3 } -- it touches the rod
    local run = scene:run { duration = 0.02, model = "auto", levels = 3,
      tolerance = { tip = { relative = 1e-12 } } }
    assert.is_true(run.ok)
    assert.is_false(run.met)
    assert.equal("round", run.model.section)
    assert.truthy(tostring(run:why()):find("no mesh helps", 1, true), tostring(run:why()))
    assert.equal("rod", w.model)
  end)
end)
