-- SPDX-License-Identifier: GPL-3.0-or-later
-- A peak that an event of the run doubts does not pass: it may be larger in truth.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local doubted = require "softworld.check.doubted"

-- So many cables land a little aslant on a table, 0.1 m apart. While more than 32 move, their blows are
-- spread over whole steps: the bend radius is some times too large.
local function landed(count)
  local scene, r = sw.scene{}, sw.cable "GXL 1.5".outer_diameter.value / 2
  scene:obstacle{ shape = "plane", friction = 0.3 }
  for i = 1, count do
    scene:wire{ cable = "GXL 1.5", from = { 0, 0.1 * i, r + 6e-3 }, to = { 0.3, 0.1 * i, r + 2e-3 },
      segments = 30 }
  end
  return scene:run{ dt = 0.005, duration = 0.2 }
end

describe("run:check", function()
  it("leaves peaks open where a blow is spread over a step, and names the step that would tell", function()
    local row = landed(33):check{ limits = { min_bend_radius = { min = 0.02, sure = true } } }
      :row "wire1.min_bend_radius"
    assert.are.equal("OPEN", row.verdict)
    assert.truthy(row.margin > 0)
    assert.truthy(row.note:find("a step was too long for peaks (event 'coarse'): dt = ", 1, true), row.note)
    row = landed(20):check{ limits = { min_bend_radius = { min = 0.02, sure = true } } }
      :row "wire1.min_bend_radius"
    assert.are.equal("PASS", row.verdict)
  end)

  -- Clamps push a cable together by 2 s, then turn against its bow until it snaps through. In poses its bends
  -- are never below 55 mm, with motion they are 14 mm. Regression: the poses passed, with a bar of 0.8 mm.
  it("leaves peaks and places open where poses jumped, but not counts", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local path = {}
    for i = 0, 20 do path[#path + 1] = { 0.3 * i / 20, 0, 0.002 * math.sin(math.pi * i / 20) ^ 2 } end
    local wire = scene:wire{ name = "w", cable = "GXL 1.5", path = path, segments = 20 }
    scene:force{ kind = "damping", mass = 2 }
    local function turn(t) return { axis = { 0, 1, 0 }, angle = math.max(0, math.min(1, (t - 2) / 4)) } end
    scene:clamp(wire, { s = 0 }):follow{ duration = 6, func = function(t) return { 0, 0, 0 }, turn(t) end }
    scene:clamp(wire, { s = wire.length }):follow{ duration = 6, func = function(t)
      local back = turn(t)
      back.angle = -back.angle
      return { 0.3 - 0.05 * math.min(1, t / 2), 0, 0 }, back
    end }
    local run = scene:run{ duration = 6.3, dt = 0.1, quasistatic = true }
    assert.truthy(run.ok, run.reason)
    assert.is_true(run.jumps > 0)
    local check = run:check{ use = "movement" }
    local row = check:row "w.min_bend_radius"
    assert.are.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("poses jumped", 1, true), row.note)
    assert.are.equal("OPEN", check:row "w.max_tension".verdict)
    assert.are.equal("PASS", check:row "kinks".verdict)
  end)

  -- Pushed by 1 % of its length along itself, a wire between clamps buckles. A straight one that nothing
  -- bends stays straight, and its bend radius would pass any limit.
  it("leaves a wire open that should have buckled", function()
    local verdicts = {}
    for _, sag in ipairs{ 0, 1e-4 } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ name = "rod", E = 5e6, density = 1500, radius = 0.002, segments = 20,
        path = { { 0, 0, 0 }, { 0.15, 0, sag }, { 0.3, 0, 0 } } }
      scene:force{ kind = "damping", on = wire, mass = 3, stiffness = 0.003 }
      scene:clamp(wire, { s = 0 })
      local far = scene:clamp(wire, { s = wire.length })
      far:follow(sw.trajectory{ points = { { 0, 0, 0 }, { -0.003, 0, 0 } }, duration = 0.5,
        relative = true })
      local run = scene:run{ dt = 0.005, duration = 0.6 }
      local check = run:check{ limits = { min_bend_radius = { min = 0.2, sure = true } } }
      local row = check:row "rod.min_bend_radius"
      verdicts[#verdicts + 1] = row.verdict
      if sag == 0 then assert.truthy(row.note:find("buckl", 1, true), row.note) end
    end
    assert.same({ "OPEN", "FAIL" }, verdicts)
  end)

  it("does not pass what breaks its limit", function()
    local check = landed(33):check{ limits = { min_bend_radius = { min = 10, sure = true } } }
    assert.are.equal("FAIL", check:row "wire1.min_bend_radius".verdict)
  end)
end)

describe("an event doubts", function()
  local function why(event, member, value, name)
    return doubted.why(member or { peaks = true }, value or { value = 1 }, { name = name or "a" },
      { events = { event } })
  end

  it("peaks without an error bar only", function()
    local coarse = { kind = "coarse", object = "", text = "too long; again with dt = 0.0012 s and" }
    assert.truthy(why(coarse):find("dt = 0.0012 s", 1, true))
    assert.is_nil(why(coarse, {}))
    assert.is_nil(why(coarse, nil, { value = 1, error = 0.1 }))
    assert.is_nil(why{ kind = "removed", object = "a", text = "" })
  end)

  it("those of the wire whose end it names", function()
    for _, kind in ipairs{ "threshold", "rebound" } do
      local event = { kind = kind, object = "a", text = "an end of wire 'a'" }
      assert.truthy(why(event):find(kind, 1, true))
      assert.is_nil(why(event, nil, nil, "b"))
      assert.truthy(why(event, { peaks = true, on = "gripper" }, nil, "hand")) -- it may hold the wire
      assert.truthy(why(event, { places = true }))
    end
  end)

  it("peaks where a struck end buckles in waves too short for its edges", function()
    local event = { kind = "edges", object = "a",
      text = "the end of wire 'a' strikes 'wall' with 0.6 m/s and sticks: it buckles in half waves of 6 mm" }
    assert.truthy(why(event):find("event 'edges'", 1, true))
    assert.truthy(why(event, { peaks = true, on = "gripper" }, nil, "hand"))
    assert.is_nil(why(event, nil, nil, "b"))
    event.text = "the sharpest bend of wire 'a', 20 mm at s = 0 m, takes only one or two edges"
    assert.is_nil(why(event)) -- gives the value a range, see spec/check/bend_range_spec
  end)

  it("forces of a hold that presses a rod on something, unless a bar tells of them", function()
    local event = { kind = "pressed", object = "hand", text = "" }
    assert.truthy(why(event):find("edges decide the force", 1, true))
    assert.is_nil(why(event, nil, { value = 1, error = 0.1 }))
  end)

  it("values that no error bar tells of", function()
    local bar = { value = 1, error = 0.1 }
    for _, kind in ipairs{ "crash", "overload", "breaking", "integrator", "walls", "kink", "clip",
      "buckling", "couple" } do
      assert.truthy(why({ kind = kind, object = "a", text = "" }, nil, bar), kind)
    end
  end)

  it("bends of the wires of a joint that passes no twist", function()
    local bar, event = { value = 1, error = 0.1 }, { kind = "joint", object = "j",
      text = "'j' passes no twist from wire 'a' to 'b'; between 'hand' and 'root' the holds turn" }
    for name, doubt in pairs{ a = true, b = true, c = false } do
      assert.equal(doubt, why(event, nil, bar, name) ~= nil, name)
    end
    assert.truthy(why(event, { peaks = true, on = "gripper" }, bar, "hand"))
    assert.is_nil(why(event, { name = "cycle_time" }))
    local scene = sw.scene{}
    scene:force{ kind = "damping", mass = 2, stiffness = 2e-3 }
    local function wire(name, from)
      return scene:wire{ name = name, cable = "GXL 1.5", from = { from, 0, 0 }, to = { from + 0.2, 0, 0 },
        segments = 8, rolls = true } -- such a joint passes no twist
    end
    local a, b = wire("a", 0), wire("b", 0.2)
    scene:join{ name = "j", ends = { { a, s = 0.2 }, { b, s = 0 } } }
    scene:clamp(a, { s = 0 })
    scene:clamp(b, { s = 0.2 }):follow{ relative = true, duration = 0.6, points = { { 0, 0, 0 },
      { -0.1, 0.04, -0.01 } } }
    local check = scene:run{ duration = 1 }:check{ limits = {
      ["a.min_bend_radius"] = 1e-3, ["b.min_bend_radius"] = 1e-3, ["a.end_bend_radius"] = 1e-3 } }
    for _, row in ipairs{ "a.min_bend_radius", "b.min_bend_radius", "a.end_bend_radius" } do
      assert.equal("OPEN", check:row(row).verdict)
      assert.truthy(check:row(row).note:find("(event 'joint')", 1, true), check:row(row).note)
    end
  end)

  it("rows of wires and grippers by a false balance, a false grasp and a hand", function()
    local bar, time = { value = 1, error = 0.1 }, { name = "cycle_time" }
    local function event(kind) return { kind = kind, object = "a", text = "" } end
    for kind, rows in pairs{ unbalanced = { true, false, false }, grasp = { true, true, false },
      hand = { true, true, true } } do
      for i, member in ipairs{ { peaks = true }, { places = true }, time } do
        assert.equal(rows[i], why(event(kind), member, bar) ~= nil, kind .. i)
      end
      assert.truthy(why(event(kind), { peaks = true, on = "gripper" }, bar, "hand"), kind)
    end
    assert.is_nil(why(event "unbalanced", nil, bar, "b"))
    assert.truthy(why(event "hand", time, bar, "b"))
  end)

  -- A gripper at rest that takes its wire from afar holds the right wire, at a place that it cannot reach.
  it("rows after a grasp from afar, in words of their own", function()
    local scene = sw.scene{}
    local wire = scene:wire{ name = "a", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local hand = scene:gripper{ name = "hand", at = { 0, 0.5, 0 } }
    scene:process(function() hand:grasp(wire, { s = 0.1 }) end)
    local row = scene:run{ dt = 0.005, duration = 0.02 }:check{ use = "movement" }:row "a.max_tension"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("took a wire far from its centre", 1, true), row.note)
    assert.is_nil(row.note:find("another wire", 1, true), row.note)
  end)

  it("checks of the script, unless they say that it does not matter", function()
    for _, kind in ipairs{ "crash", "buckling", "hand", "grasp", "unbalanced" } do
      local scene = sw.scene{}
      local wire = scene:wire{ name = "a", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
      scene:clamp(wire, { s = 0 })
      scene:process(function(p)
        p:wait(0.01)
        scene:tell{ kind = kind, object = "a", text = "something is wrong" }
      end)
      local function one(name, max, asked)
        return { name = name, unit = "m", max = max, doubted = asked, of = function() return 1 end }
      end
      local check = scene:run{ dt = 0.005, duration = 0.02 }:check{ trial = true, checks = {
        one("kept", 2), one("broken", 0.5), one("certain", 2, false) } }
      assert.same({ "OPEN", "FAIL", "PASS" }, { check:row "kept".verdict, check:row "broken".verdict,
        check:row "certain".verdict })
      assert.truthy(check:row "kept".note:find(("event '%s'"):format(kind), 1, true))
    end
  end)

  it("nothing where the model is right: a clip that breaks, steps that were redone", function()
    assert.is_nil(why{ kind = "clip", object = "a", text = "clip 'a': OVERLOADED, the wire breaks" })
    local made = { kind = "energy", object = "", text = "steps made 0.1 J from nowhere, 3 % of" }
    assert.truthy(why(made))
    made.text = "11 steps were redone, more than 1 % of all, because they made energy, the worst at"
    assert.is_nil(why(made))
    made.text = "1 step was accepted although it made energy, because smaller steps made energy too"
    assert.truthy(why(made):find("forces jumped", 1, true))
  end)

  it("peaks beside more than a tenth of energy from nowhere, which no step made", function()
    local gap = { kind = "energy", object = "", value = 0.99,
      text = "1 J come from nowhere, 99 % of the energy in play" }
    assert.truthy(why(gap):find("energy comes from nowhere", 1, true))
    gap.value = 0.07
    assert.is_nil(why(gap))
    assert.truthy(why{ kind = "late", object = "hand", text = "" }:find("(event 'late')", 1, true))
  end)

  it("forces of grippers by the share of energy from nowhere", function()
    local gap = { kind = "energy", object = "", value = 0.07,
      text = "1 J come from nowhere, 7 % of the energy in play" }
    local hand = { on = "gripper", unit = "N" }
    local v = doubted.widen({ value = 2 }, hand, { events = { gap } })
    assert.is_near(2 * 0.93, v.low, 1e-12)
    assert.is_near(2 * 1.07, v.high, 1e-12)
    assert.is_nil(doubted.widen({ value = 2, error = 0.1 }, hand, { events = { gap } }).high)
    assert.is_nil(doubted.widen({ value = 2 }, { on = "wire", unit = "N" }, { events = { gap } }).high)
  end)
end)
