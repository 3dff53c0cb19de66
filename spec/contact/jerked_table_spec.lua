-- SPDX-License-Identifier: GPL-3.0-or-later
-- A free wire lies on a table whose velocity jumps to the opposite while the wire slides. The wire moves as
-- a block: friction mu m g drives it towards the table's velocity. Friction turns round at once at the jump.
-- A method that starts the next step with the friction of before the jump counts it for a third of that step:
-- the wire's velocity was off by up to 0.6 mu g dt, and part of the heat was missing.
local sw = require "softworld"

local G, MU, LENGTH = 9.81, 0.3, 0.4
local CABLES = { "GXL 1.5", "GXL 10", "soft" } -- soft: E = 10 MPa, radius 2 mm

-- Returns way and way of slip of a block on a table of velocity u(t) in time T, in steps of 10 us [m].
local function block(u, T)
  local h, v, x, slip = 1e-5, 0, 0, 0
  for k = 0, math.floor(T / h + 0.5) - 1 do
    local off = u((k + 0.5) * h) - v
    local dv = math.max(-MU * G * h, math.min(MU * G * h, off))
    if math.abs(off) > MU * G * h then slip = slip + math.abs(off - dv / 2) * h end
    x, v = x + (v + dv / 2) * h, v + dv
  end
  return x, slip
end

-- o: cable, speed [m/s], stroke: time of a stroke [s], by_function, angle of the scene [rad], swapped
local function run(o, step)
  local scene = sw.scene{}
  local c, s = math.cos(o.angle or 0), math.sin(o.angle or 0)
  local function place(x, z) return { c * x, s * x, z } end
  local soft = o.cable == "soft"
  local r = soft and 0.002 or sw.cable(o.cable).outer_diameter.value / 2
  local a, b = place(0, r), place(LENGTH, r)
  if o.swapped then a, b = b, a end
  local w = scene:wire{ cable = not soft and o.cable or nil, E = soft and 1e7 or nil,
    density = soft and 1200 or nil, radius = soft and r or nil, from = a, to = b,
    segments = o.segments or 40 }
  scene:force{ kind = "damping", on = w, stiffness = 1e-3 }
  local box = scene:obstacle{ shape = "box", size = { 3, 3, 0.1 }, at = { 0, 0, -0.05 }, friction = MU }
  scene:settle()
  local strokes = 5
  local T, points = strokes * o.stroke, { place(0, 0) }
  for k = 1, strokes do points[k + 1] = place(k % 2 == 1 and o.speed * o.stroke or 0, 0) end
  local function to_and_fro(t)
    local k = math.min(math.floor(t / o.stroke), strokes)
    local into = math.min(t, T) - k * o.stroke
    return place(k % 2 == 0 and o.speed * into or o.speed * (o.stroke - into), 0)
  end
  box:follow(o.by_function and { func = to_and_fro, relative = true, duration = T }
    or { points = points, relative = true, law = "linear", duration = T })
  local before = w:position(LENGTH / 2)
  local result = scene:run{ duration = T, dt = not o.tolerance and step or nil, tolerance = o.tolerance }
  assert.is_true(result.ok)
  local after = w:position(LENGTH / 2)
  local way = c * (after[1] - before[1]) + s * (after[2] - before[2])
  local ledger = result:ledger()
  return { way = way, heat = ledger.lost.friction / (MU * G * w.beam.mass_per_length * LENGTH),
    work = ledger.work.obstacles, lost = ledger.lost.friction, gap = ledger.gap / ledger.play }
end

local known = {} -- way and way of slip of the block, by stroke: each speed has its own
local function check(o, step)
  local right = known[o.stroke]
  if not right then
    right = { block(function(t) return math.floor(t / o.stroke) % 2 == 0 and o.speed or -o.speed end,
      5 * o.stroke) }
    known[o.stroke] = right
  end
  local way, slip = right[1], right[2]
  local r = run(o, step)
  local what = ("%s, %s: way off by %.2g mm, heat by %.2g %%, gap %.2g"):format(o.cable,
    o.tolerance and "tolerance" or step * 1e3 .. " ms", 1e3 * (r.way - way), 100 * (r.heat / slip - 1), r.gap)
  print("measured: " .. what)
  -- 1 % of a stroke, 1 % of heat: each stroke begins with a catch of at most one step of 20 ms
  assert.is_true(math.abs(r.way - way) < 0.01 * o.speed * o.stroke, what)
  assert.is_true(math.abs(r.heat / slip - 1) < 0.01, what)
  assert.is_true(math.abs(r.gap) < 1e-3, what)
end

describe("a free wire on a table that reverses at once", function()
  for _, cable in ipairs(CABLES) do
    it("moves as a block at any step: " .. cable, function()
      -- in each stroke the wire slides all the time, or until 3 ms before its end
      for _, motion in ipairs{ { 0.3, 0.105 }, { 1, 0.2 } } do
        local o = { cable = cable, speed = motion[1], stroke = motion[2] }
        for _, step in ipairs{ 0.02, 0.01, 0.005, 0.002, 0.001 } do check(o, step) end
        o.tolerance = 1e-4
        check(o)
      end
    end)
  end

  it("does so too turned, with swapped ends and other edges", function()
    local o = { cable = "GXL 1.5", speed = 0.3, stroke = 0.105, angle = 0.7, swapped = true, segments = 41 }
    for _, step in ipairs{ 0.02, 0.01, 0.005 } do check(o, step) end
  end)

  it("does so too if a function moves the table", function()
    local o = { cable = "GXL 1.5", speed = 0.3, stroke = 0.105, by_function = true }
    for _, step in ipairs{ 0.02, 0.01, 0.005 } do check(o, step) end
  end)
end)
