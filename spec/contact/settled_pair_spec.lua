-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two wires wound round each other are drawn taut by scene:settle alone. Touches 0.05 mm deep shorten their
-- ways and took 50 to 98 % of the pull, without an event. Where depth remains that takes more than 5 % of a
-- tension, an event tells it, and rows of the tension are open.
local sw = require "softworld"
local t = require "physics.tools"
local twisted = require "contact.twisted"

local FLRY = { cables = { "FLRY-B 0.5", "FLRY-B 0.5" }, pitch = 0.02, turns = 6 }
local GXL = { cables = { "GXL 1.5", "GXL 1.5" }, pitch = 0.04, turns = 3 }
local MIXED = { cables = { "H07V-K 4", "FLRY-B 0.5" }, pitch = 0.08, turns = 3 }

-- Winds two wires round each other between clamps. Returns the scene, the clamps to be drawn, and their way
-- [m] for a share of the distance.
local function wound(o, strain, gravity)
  local scene = sw.scene{ gravity = { 0, 0, -(gravity or 0) } }
  local ends, distance = twisted(scene, o)
  return scene, ends, strain * distance
end

local function pull(ends) return ends[1]:force()[1] + ends[2]:force()[1] end

-- Returns the pull [N] after settling or a run, and the number of events about depth. look: called with the
-- result.
local function drawn(o, strain, how, look)
  local scene <close>, ends, way = wound(o, strain, how.gravity)
  local result
  for _, clamp in ipairs(ends) do
    local p = clamp:pose()
    if how.settle then
      clamp:pose({ p[1] + way, p[2], p[3] })
    else
      clamp:follow{ points = { { 0, 0, 0 }, { way, 0, 0 } }, relative = true, duration = 0.5 }
    end
  end
  if how.settle then
    result = scene:settle()
  else
    result = scene:run{ duration = 0.8, dt = how.dt or 0.01, quasistatic = not how.dt }
  end
  local told = 0
  for _, e in ipairs(t.fine(result).events) do
    if e.kind == "pressed" then told = told + 1 end
  end
  if look then look(result) end
  return pull(ends), told
end

describe("a twisted pair that settles between clamps further apart", function()
  for _, case in ipairs{ { FLRY, 1e-3 }, { GXL, 1e-3 }, { MIXED, 1e-3 }, { MIXED, 2e-4 } } do
    local o, strain = case[1], case[2]
    local what = ("%s, by %g %%"):format(table.concat(o.cables, " and "), 100 * strain)
    it("has the pull of poses: " .. what, function()
      local right, told = drawn(o, strain, {})
      assert.equal(0, told)
      for _, gravity in ipairs{ 0, 9.81 } do
        local found, events = drawn(o, strain, { settle = true, gravity = gravity })
        t.share(right, found, 0.05, "pull after settle [N]")
        assert.equal(0, events)
      end
    end)
  end

  it("settles as before where its wires are not taut", function()
    local right = drawn(FLRY, 2e-4, {})
    local found, told = drawn(FLRY, 2e-4, { settle = true })
    t.share(right, found, 0.05, "pull after settle [N]")
    assert.equal(0, told)
  end)
end)

describe("depth that takes more than 5 % of a tension", function()
  -- In motion depths below 1 um remain: 7 % of the pull of this pair, 2 % of the other one.
  it("is told in motion, and makes rows of the tension open", function()
    local _, told = drawn(FLRY, 1e-3, { dt = 0.01 }, function(run)
      local row = run:check{ limits = { max_tension = 1e3 } }:row "max_tension"
      assert.equal("OPEN", row.verdict)
      assert.truthy(row.note:find("in each other", 1, true), row.note)
    end)
    assert.equal(2, told)
  end)

  it("is not told where it takes less", function()
    local _, told = drawn(MIXED, 1e-3, { dt = 0.01 }, function(run)
      assert.equal("PASS", run:check{ limits = { max_tension = 1e3 } }:row "max_tension".verdict)
    end)
    assert.equal(0, told)
  end)

  -- Two loops of H07V-K 4 that hook into each other. In poses with little tension depth of 0.03 mm remains.
  -- The bound of the first touch was above the tensions of all later states, and was told: 9 %.
  it("is not told of wires that begin to touch, where later tensions are larger", function()
    local function hooked(settle)
      local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
      local round, leg, ends = 0.03, 0.08, {}
      local inside = round - 1.02 * sw.cable("H07V-K 4").outer_diameter.value / 2
      for k, sign in ipairs{ 1, -1 } do
        local path = {}
        local function add(x, out)
          local along, across = sign * (x + inside), round * out
          path[#path + 1] = { along, k == 1 and across or 0, k == 1 and 0 or across }
        end
        for i = 0, 60 do add(leg * (1 - i / 60), 1) end
        for i = 1, 40 do
          local phi = math.pi * (0.5 + i / 40)
          add(round * math.cos(phi), math.sin(phi))
        end
        for i = 1, 60 do add(leg * i / 60, -1) end
        local wire = scene:wire{ cable = "H07V-K 4", path = path, segments = 40, rest = "path" }
        for _, s in ipairs{ 0, wire.length } do ends[#ends + 1] = scene:clamp(wire, { s = s }) end
      end
      scene:wire_contact{ friction = 0.2 }
      for i = 1, 2 do
        local p = ends[i]:pose()
        if settle then ends[i]:pose({ p[1] + 0.004, p[2], p[3] })
        else ends[i]:follow{ points = { { 0, 0, 0 }, { 0.004, 0, 0 } }, relative = true, duration = 0.5 } end
      end
      local result = settle and scene:settle() or scene:run{ duration = 0.6, dt = 0.02, quasistatic = true }
      for _, e in ipairs(t.fine(result).events) do assert.not_equal("pressed", e.kind) end
      return ends[1]:force()[1]
    end
    t.share(hooked(true), hooked(), 0.01, "pull of the hook [N]")
  end)
end)
