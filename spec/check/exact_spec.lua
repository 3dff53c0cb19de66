-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:check at the limit: times at their limit, bends in edges that are too long, zones that a wire may have
-- entered, landing on a part of a path.
local edges = require "softworld.check.edges"
local sw = require "softworld"

local function still(segments)
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.2, 0, 0 },
    segments = segments or 8 }
  return scene, wire, scene:clamp(wire, { s = 0 })
end

describe("run:check of the cycle time", function()
  -- 0.1 + 0.2 - 0.1 is 4e-17 above 0.2. A value at the limit passes, whatever the clock showed at the start.
  it("passes a run as long as its limit, after another run", function()
    for _, times in ipairs{ { 0.1, 0.2 }, { 0.3, 0.3 }, { 0.7, 0.1 }, { 0.35, 0.7 } } do
      local scene = still()
      scene:run{ duration = times[1], dt = 0.01 }
      local run = scene:run{ duration = times[2], dt = 0.01 }
      local row = run:check{ limits = { cycle_time = times[2] } }:row "cycle_time"
      assert.same({ times[2], "PASS", 0 }, { row.value, row.verdict, row.margin })
      row = run:check{ limits = { cycle_time = times[2] - 1e-9 } }:row "cycle_time"
      assert.equal("FAIL", row.verdict)
    end
  end)
end)

describe("run:check of a clearance", function()
  -- 0.15 - 0.1 - 0.002 is 1.4e-17 below 0.048.
  it("passes at its limit, with a margin of 0", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ name = "w", EA = 1e4, EI = 1e-3, mass_per_length = 0.03, radius = 0.002,
      from = { 0, 0, 1 }, to = { 0, 0, 0 }, segments = 20 }
    scene:clamp(wire, { s = 0 })
    scene:zone{ shape = "sphere", radius = 0.1, at = { 0.15, 0, 0.5 } }
    local run = scene:run{ duration = 0.1, dt = 0.01, quasistatic = true }
    local row = run:check{ limits = { clearance = 0.048 } }:row "clearance"
    assert.same({ "PASS", 0 }, { row.verdict, row.margin })
    assert.equal("FAIL", run:check{ limits = { clearance = 0.048 + 1e-9 } }:row "clearance".verdict)
  end)
end)

describe("run:check of bends in edges that are too long", function()
  -- The centre line's radius of 5 mm may be 2.5 mm, so the inside of the bend 3 mm less than that: below 0.
  it("applies the factor to the radius of the centre line", function()
    local event = { kind = "edges", object = "w", value = 20 }
    local entry = { name = "w", object = { segments = 10 } }
    local value = edges.widen({ value = 0.002, inside = 0.003 }, "low", entry, { events = { event } })
    assert.is_near(-0.0005, value.low, 1e-15)
    value = edges.widen({ value = 0.002 }, "both", entry, { events = { event } })
    assert.same({ 0.001, 0.004 }, { value.low, value.high })
  end)
end)

describe("run:check of temperatures that the wire may have met", function()
  -- The wire goes up by 0.4 m in steps of 20 mm and ends in the zone of 50 degC. Thin zones lie between
  -- steps: the worst one counts, in any order.
  it("is open by the worst of several zones", function()
    local function zone(name, z, temperature, thick)
      return { name = name, shape = "box", size = { 1, 1, thick or 1e-4 }, at = { 0, 0, z },
        temperature = temperature }
    end
    local zones = { zone("mild", 0.4, 50, 0.05), zone("hot", 0.11, 200), zone("warm", 0.21, 80) }
    for _, order in ipairs{ { 1, 2, 3 }, { 3, 2, 1 }, { 2, 1, 3 }, { 2, 3 }, { 3, 2 } } do
      local scene, wire, clamp = still()
      for _, k in ipairs(order) do scene:zone(zones[k]) end
      for _, hold in ipairs{ clamp, scene:clamp(wire, { s = 0.2 }) } do
        hold:follow{ points = { { 0, 0, 0 }, { 0, 0, 0.4 } }, relative = true, duration = 1, law = "linear" }
      end
      local row = scene:run{ duration = 1, dt = 0.05, quasistatic = true }:check{}:row "max_temperature"
      assert.same({ #order == 3 and 50 or 200, 200, "OPEN" }, { row.value, row.high, row.verdict })
      assert.truthy(row.note:find("perhaps in zone 'hot'", 1, true), row.note)
    end
  end)
end)

describe("run:check of the landing error", function()
  local scene = still()
  local run = scene:run{ duration = 0.02, dt = 0.01 }
  local function row(landing)
    return run:check{ landing = landing, limits = { landing_error = 0.01 } }:row "landing_error"
  end

  -- Nodes are 25 mm apart; the path is 3 mm beside the wire.
  it("is measured between nodes, where the part is shorter than an edge", function()
    local path = { { 0, 0.003, 0 }, { 0.2, 0.003, 0 } }
    for _, part in ipairs{ { 0.11, 0.115 }, { 0.11, 0.11 }, { 0.2, 0.2 }, { 0, 0 }, { 0.19, 0.2 } } do
      local r = row{ path = path, from = part[1], to = part[2] }
      assert.is_near(0.003, r.value, 1e-9)
      assert.is_near(part[1], r.s, 1e-8)
    end
    -- the farthest point of the part up to 0.13 m is its end, 30 mm beyond the path
    local r = row{ path = { { 0, 0, 0 }, { 0.1, 0, 0 } }, to = 0.13 }
    assert.is_near(0.03, r.value, 1e-9)
    assert.is_near(0.13, r.s, 1e-9)
  end)

  it("does not depend on the path's direction, and says where the path goes on beyond the wire", function()
    for _, path in ipairs{ { { 0, 0, 0 }, { 0.2, 0, 0 } }, { { 0.2, 0, 0 }, { 0, 0, 0 } } } do
      local r = row{ path = path }
      assert.is_near(0, r.value, 1e-12)
      assert.is_nil(r.note)
    end
    local r = row{ path = { { 0, 0, 0 }, { 1, 0, 0 } } }
    assert.equal("OPEN", r.verdict) -- the wire reaches a fifth of it
    assert.equal("PASS", row{ path = { { 0, 0, 0 }, { 1, 0, 0 } }, from = 0 }.verdict)
    assert.truthy(r.note:find("point 2 of the path is 800.0 mm from the wire", 1, true), r.note)
  end)

  it("names a part beyond the wire", function()
    for _, part in ipairs{ { "from", 0.3 }, { "to", 0.3 } } do
      local r = row{ path = { { 0, 0, 0 }, { 0.2, 0, 0 } }, [part[1]] = part[2] }
      assert.equal("FAIL", r.verdict)
      assert.truthy(r.note:find(("landing.%s = %g m is beyond the wire's end at 0.2 m"):format(part[1],
        part[2]), 1, true), r.note)
    end
  end)
end)

describe("run:check of events that had no room", function()
  -- A run keeps 512 events. The clamp is driven into the table after 600 others.
  it("is open, because a crash may be among them", function()
    for _, case in ipairs{ { 600, "OPEN" }, { 6, "FAIL" } } do
      local scene, _, clamp = still()
      scene:obstacle{ name = "table", shape = "plane", at = { 0, 0, -0.05 } }
      scene:process(function(p)
        for k = 1, case[1] do scene:tell{ kind = "note", text = "a note", object = "part" .. k } end
        clamp:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.06 } }, relative = true, duration = 0.1 }
        p:wait(0.1)
      end)
      local row = scene:run{ dt = 0.01 }:check{}:row "events"
      assert.equal(case[2], row.verdict)
      assert.equal(case[2] == "OPEN", row.note:find("had no room in the record", 1, true) ~= nil)
    end
  end)
end)

describe("run:check of landing on a path that the wire does not reach", function()
  -- The wire of 0.2 m lies on the x axis, the path goes on beyond it.
  for to, verdict in pairs{ [0.2] = "PASS", [0.39] = "PASS", [0.42] = "OPEN", [200] = "OPEN" } do
    it(("is %s for a path of %g m"):format(verdict, to), function()
      local scene = still()
      local row = scene:run{ duration = 0.01, dt = 0.01, quasistatic = true }:check{
        limits = { landing_error = 2e-3 }, landing = { path = { { 0, 0, 0 }, { to, 0, 0 } } } }
        :row "landing_error"
      assert.equal(verdict, row.verdict)
      assert.equal(verdict == "OPEN", (row.note or ""):find("is its unit right (m)?", 1, true) ~= nil)
    end)
  end
end)
