-- SPDX-License-Identifier: GPL-3.0-or-later
-- Joins in a scene: contact, release, snapshots, error bars, and what is refused.
local sw = require "softworld"
local joined = require "spec.physics.joined"

local wire = joined.wire
local G = 9.81

describe("joins in a scene", function()
  local function harness(s)
    local t = wire(s, { -0.3, 0, 0.2 }, { 0, 0, 0.2 }, 30, { name = "trunk" })
    local b = wire(s, { 0, 0, 0.2 }, { 0.25, 0.12, 0.2 }, 30, { name = "b" })
    local c = wire(s, { 0, 0, 0.2 }, { 0.25, -0.12, 0.2 }, 30, { name = "c" })
    local join = s:join{ ends = { { t, s = t.length }, { b, s = 0 }, { c, s = 0 } }, name = "Y" }
    s:clamp(t, { s = 0 })
    return t, b, c, join
  end

  it("leave contact elsewhere to wire_contact and obstacles", function()
    local s = sw.scene{}
    local _, b, c, join = harness(s)
    s:wire_contact{ friction = 0.2 }
    s:obstacle{ shape = "plane", friction = 0.3 }
    local hand = s:clamp(b, { s = b.length })
    assert.is_true(s:settle().ok)
    for _, touch in ipairs(s:touches()) do assert.is_true(touch.s[1] > 0.01) end
    hand:follow{ points = { { 0, 0, 0 }, { -0.1, -0.25, 0.02 } }, duration = 0.5, relative = true }
    local run = s:run{ duration = 0.7, dt = 5e-3 }
    assert.is_true(run.ok, run.reason)
    assert.is_true(s:penetration() < 1e-3)
    local sum = { 0, 0, 0 }
    for k = 1, 3 do
      local f = join:force(k)
      for i = 1, 3 do sum[i] = sum[i] + f[i] end
    end
    for i = 1, 3 do assert.is_near(0, sum[i], 1e-6) end
    assert.is_true(c:position(c.length)[3] < 0.01) -- lies on the table
  end)

  it("are named where a joined wire would become a mesh, and nothing is changed", function()
    local s = sw.scene{}
    local t, b = harness(s)
    local hand = s:gripper{ name = "hand", pads = { width = 0.01, opening = 0.02 } }
    local told = {}
    s:process(function(p)
      told[1] = select(2, pcall(t.remodel, t, { model = "tube" }))
      told[2] = select(2, pcall(hand.grasp, hand, b, { s = 0.1, approach = "mixed", force = 5 }))
      p:wait(0.01)
    end)
    assert.is_true(s:run{ dt = 0.005 }.ok)
    for i, name in ipairs{ "trunk", "b" } do
      local text = tostring(told[i])
      assert.truthy(text:find("wire '" .. name .. "' is joined by 'Y': a joined wire cannot become a mesh", 1,
        true), text)
      assert.truthy(text:find("release the join first", 1, true), text)
    end
    assert.equal("rod", t.model)
    assert.equal("rod", b.model)
    assert.equal(0, #hand.wires)
  end)

  it("come apart when released", function()
    local s = sw.scene{}
    local t, b, _, join = harness(s)
    s:settle()
    local before = s:snapshot()
    s:run{ duration = 0.1, dt = 5e-3 }
    local there = b:position(0.2)
    join:release()
    assert.is_false(join.held)
    assert.matches("released", tostring(join))
    s:run{ duration = 0.2, dt = 5e-3 }
    assert.is_true(t:position(t.length)[3] - b:position(0)[3] > 0.05) -- falls freely
    for i = 1, 3 do assert.are.equal(0, join:force(1)[i]) end
    s:restore(before)
    assert.is_true(join.held)
    s:run{ duration = 0.1, dt = 5e-3 }
    for i = 1, 3 do assert.are.equal(there[i], b:position(0.2)[i]) end
  end)

  it("made after a snapshot are taken back when it is restored", function()
    local s = sw.scene{}
    local w = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 20)
    local v = wire(s, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 20)
    s:clamp(w, { s = 0 })
    local before = s:snapshot()
    local join = s:join{ ends = { { w, s = 0.3 }, { v, s = 0 } } }
    s:run{ duration = 0.05, dt = 5e-3 }
    s:restore(before)
    assert.matches("taken back", tostring(join))
    assert.has_error(function() join:force(1) end)
    s:run{ duration = 0.1, dt = 5e-3 }
    assert.is_near(-0.5 * G * 0.01, v:position(0)[3], 1e-4)
  end)

  it("are remeshed for error bars", function()
    local s = sw.scene{}
    local function make(segments)
      local a = wire(s, { 0, 0, 0 }, { 0.25, 0, 0 }, segments)
      local b = wire(s, { 0.1, 0, 0 }, { 0.1, 0, -0.1 }, segments // 2)
      s:join{ ends = { { a, s = 0.1 }, { b, s = 0 } } }
      s:clamp(a, { s = 0 })
      return a, b
    end
    local a = make(12)
    local run = s:settle{ tolerance = { { name = "tip", value = 1e-4, unit = "m",
      of = function() return a:position(0.25)[3] end } } }
    assert.is_true(run.ok, run.reason)
    -- the same on a fine mesh
    local fine = sw.scene{}
    s = fine
    local exact = make(200)
    fine:settle()
    local tip = run.quantities.tip
    assert.is_true(math.abs(tip.value - exact:position(0.25)[3]) <= tip.error + 2e-6)
  end)

  it("hold many branches and chains of wires", function()
    local s = sw.scene{}
    local chain, last = {}, nil
    for k = 1, 12 do
      local w = wire(s, { 0.1 * (k - 1), 0, 0 }, { 0.1 * k, 0, 0 }, 8)
      if last then s:join{ ends = { { last, s = 0.1 }, { w, s = 0 } } } end
      chain[k], last = w, w
    end
    s:clamp(chain[1], { s = 0 })
    s:clamp(last, { s = 0.1 })
    assert.is_true(s:settle().ok)
    local one = sw.scene{}
    local w = wire(one, { 0, 0, 0 }, { 1.2, 0, 0 }, 96)
    one:clamp(w, { s = 0 })
    one:clamp(w, { s = 1.2 })
    one:settle()
    -- the joins stretch by 11 hundredths of a segment's stretch, of 96 segments
    assert.is_near(w:position(0.6)[3], chain[6]:position(0.1)[3], 5e-6)
  end)

  describe("refuse", function()
    local s, a, b
    before_each(function()
      s = sw.scene{}
      a = wire(s, { 0, 0, 0 }, { 0.3, 0, 0 }, 20, { name = "a" })
      b = wire(s, { 0.3, 0, 0.01 }, { 0.5, 0, 0.01 }, 20, { name = "b" })
    end)

    local function refuses(pattern, args)
      local ok, message = pcall(s.join, s, args)
      assert.is_false(ok)
      assert.matches(pattern, message)
      assert.are.equal(21, a.segments + 1)
    end

    it("ends that do not meet", function()
      refuses("'b' at s = 0 m is 0.01 m away from 'a'", { ends = { { a, s = 0.3 }, { b, s = 0 } } })
    end)
    it("places beside the wire", function()
      refuses("s = 0.4 m is not on wire 'a', which goes from 0 to 0.3 m",
        { ends = { { a, s = 0.4 }, { b, s = 0 } } })
    end)
    it("one end, nine ends, none", function()
      refuses("it must be from 2 to 8", { ends = { { a, s = 0.3 } } })
      local nine = {}
      for k = 1, 9 do nine[k] = { a, s = 0.3 } end
      refuses("lists 9 wires", { ends = nine })
      refuses("ends is required", {})
      refuses("ends is required", { ends = a })
    end)
    it("what is no end", function()
      refuses("ends%[2%] must be { wire, s = arc length }, got number 3", { ends = { { a, s = 0.3 }, 3 } })
      refuses("ends%[1%]", { ends = { { s = 0.3 }, { b, s = 0 } } })
      refuses("s is required", { ends = { { a }, { b, s = 0 } } })
      refuses("S.*did you mean 's'", { ends = { { a, S = 0.3 }, { b, s = 0 } } })
      refuses("did you mean 'rigid'", { ends = { { a, s = 0.3 }, { b, s = 0 } }, rigit = true })
    end)
    it("a wire joined to its own neighbourhood", function()
      refuses("less than three segments apart", { ends = { { a, s = 0.1 }, { a, s = 0.12 } } })
    end)
    it("a wire of another scene", function()
      local other = sw.scene{}
      local c = wire(other, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 5)
      refuses("scene", { ends = { { a, s = 0.3 }, { c, s = 0 } } })
    end)

    it("explicit integrators, feeds and frequencies of joined wires", function()
      local c = wire(s, { 0.3, 0, 0 }, { 0.5, 0, 0 }, 20, { name = "c" })
      s:join{ ends = { { a, s = 0.3 }, { c, s = 0 } }, name = "splice" }
      s:clamp(a, { s = 0 })
      local function fails(pattern, f, ...)
        local ok, message = pcall(f, ...)
        assert.is_false(ok)
        assert.matches(pattern, message)
      end
      fails("'splice', which joins wires, needs an implicit", s.run, s,
        { duration = 0.1, dt = 1e-6, integrator = "rk4" })
      local join = s:join{ ends = { { a, s = 0 }, { wire(s, { 0, 0, 0 }, { 0, 1, 0 }, 5), s = 0 } } }
      fails("from 1, got", join.force, join)
      fails("from 1, got number 0", join.force, join, 0)
      fails("there is no end 3; it has 2", join.moment, join, 3)
      join:release()
      fails("wire 'c' is joined to others by 'splice'", s.feed, s, c, { s = 0.2 })
      s:settle()
      fails("'a' is joined to others by 'splice'", a.frequencies, a)
      local d = wire(s, { 0.5, 1, 0 }, { 0.7, 1, 0 }, 20, { name = "d" })
      s:feed(d, { s = 0, speed = 0, name = "spool" })
      fails("wire 'd' is fed by 'spool'", s.join, s, { ends = { { c, s = 0.2 }, { d, s = 0 } } })
    end)
  end)
end)
