-- SPDX-License-Identifier: GPL-3.0-or-later
-- What every motion law promises, whatever the way-points and the timing.
package.path = "./?.lua;" .. package.path
local core = require "softworld.core"
local d = require "spec.motion.differences"

local function laws()
  for _, row in ipairs(core.trajectory_parameters()) do
    if row.name == "law" then return row.choices end
  end
end

local corners = {
  { 0, 0, 0 },
  { 0.3, 0, 0, rotation = { axis = { 0, 0, 1 }, angle = 1.2 } },
  { 0.3, 0.2, 0.1, rotation = { axis = { 1, 1, 0 }, angle = 0.7 } },
  { 0.25, 0.5, 0.1, rotation = { axis = { 1, 0, -1 }, angle = -1.1 } },
}

local function with(base, more)
  local out = {}
  for key, value in pairs(base) do out[key] = value end
  for key, value in pairs(more) do out[key] = value end
  return out
end

local cases = {
  ["two points, speed"] = { points = { { 0, 0, 0 }, { 0.4, 0.1, 0 } }, speed = 0.2 },
  ["two points, duration, late"] = { points = { { 0, 0, 0 }, { 0.4, 0.1, 0 } }, duration = 1.7, start = 0.6 },
  ["corners, speed"] = { points = corners, speed = 0.3 },
  ["corners, both speeds"] = { points = corners, speed = 0.3, angular_speed = 0.8 },
  ["corners, times"] = { points = corners, times = { 0.5, 1.5, 2.25, 4 } },
  ["turning on the spot"] = { points = { { 1, 2, 3 } }, turn = { axis = { 1, 2, 2 }, angle = 3 },
    angular_speed = 2 },
  ["displacement"] = { points = { { 0.1, 0, 0.2 } }, relative = true, duration = 0.8 },
}
local resting = {
  ["corners, duration, blend"] = { points = corners, duration = 3, blend = 0.08 },
  ["corners, speed, stop"] = { points = corners, speed = 0.3, stop = true },
  ["corners, accelerations"] = { points = corners, speed = 0.3, acceleration = 0.5,
    angular_acceleration = 3 },
  ["there and back"] = { points = { { 0, 0, 0 }, { 0.2, 0, 0 }, { 0, 0.01, 0 } }, speed = 0.3 },
  ["seven turns"] = {
    points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0.1, 0.2, 0 } }, turn = { axis = { 0, 1, 1 }, angle = 44 },
      speed = 0.1 },
}

local function check_derivatives(trajectory, t, h, tolerance)
  local function pick(method) return function(at) return trajectory[method](trajectory, at) end end
  local scale = 1 + d.norm(trajectory:acceleration(t)) + d.norm(trajectory:angular_acceleration(t))
  assert.is_true(d.apart(trajectory:velocity(t), d.rate(pick "position", t, h)) < tolerance * scale)
  assert.is_true(d.apart(trajectory:acceleration(t), d.rate(pick "velocity", t, h)) < tolerance * scale)
  assert.is_true(d.apart(trajectory:angular_velocity(t),
    d.angular_velocity(pick "rotation", t, h)) < tolerance * scale)
  assert.is_true(d.apart(trajectory:angular_acceleration(t),
    d.rate(pick "angular_velocity", t, h)) < tolerance * scale)
end

-- Where the acceleration has a bend, differences across it are wrong by about h.
local function smooth_near(trajectory, t, h)
  local a, b = trajectory:acceleration(t - 3 * h), trajectory:acceleration(t + 3 * h)
  local m = trajectory:acceleration(t)
  local p, q = trajectory:angular_acceleration(t - 3 * h), trajectory:angular_acceleration(t + 3 * h)
  local n, bend = trajectory:angular_acceleration(t), 0
  for i = 1, 3 do
    bend = math.max(bend, math.abs(a[i] - 2 * m[i] + b[i]), math.abs(p[i] - 2 * n[i] + q[i]))
  end
  return bend < 1e-3 * (1 + d.norm(m) + d.norm(n))
end

local function check_law(law, case)
  local trajectory = core.trajectory(with(case, { law = law }))
  local from, to = trajectory:starts(), trajectory:ends()

  it("has exact derivatives", function()
    local checked, h = 0, 2e-4
    for i = 1, 400 do
      local t = from + (to - from) * (i - 0.4371) / 400
      if t - from > 4 * h and to - t > 4 * h and smooth_near(trajectory, t, h) then
        check_derivatives(trajectory, t, h, 1e-6)
        checked = checked + 1
      end
    end
    assert.is_true(checked > 300)
  end)

  it("rests at its first pose before and at its last pose after", function()
    local zero = { 0, 0, 0 }
    for at, times in pairs { [from] = { from - 1e-9, from - 5, -1e6 }, [to] = { to, to + 1e-9, to + 1e6 } } do
      for _, t in ipairs(times) do
        assert.is_true(d.apart(trajectory:position(t), trajectory:position(at)) < 1e-14)
        assert.is_true(d.apart(trajectory:rotation(t), trajectory:rotation(at)) < 1e-14)
        for _, method in ipairs { "velocity", "acceleration", "angular_velocity", "angular_acceleration" } do
          assert.are.same(zero, trajectory[method](trajectory, t))
        end
      end
    end
  end)

  it("begins and ends at its way-points and moves without jumps", function()
    local last = case.points[#case.points]
    assert.is_true(d.apart(trajectory:position(to), { last[1], last[2], last[3] }) < 1e-12)
    local speed = trajectory:length() / (to - from)
    local step = (to - from) / 5000
    for i = 1, 5000 do
      local a, b = trajectory:position(from + (i - 1) * step), trajectory:position(from + i * step)
      for k = 1, 3 do a[k] = b[k] - a[k] end
      assert.is_true(d.norm(a) < 20 * speed * step + 1e-12)
    end
    if law ~= "linear" then assert.is_true(d.norm(trajectory:velocity(to - 1e-9)) < 1e-6) end
  end)

  it("keeps the limits and the duration", function()
    local fastest, fastest_turn = 0, 0
    for i = 0, 4000 do
      local t = from + (to - from) * i / 4000
      fastest = math.max(fastest, d.norm(trajectory:velocity(t)))
      fastest_turn = math.max(fastest_turn, d.norm(trajectory:angular_velocity(t)))
    end
    if case.speed then assert.is_true(fastest <= case.speed * (1 + 1e-9)) end
    if case.angular_speed then assert.is_true(fastest_turn <= case.angular_speed * (1 + 1e-9)) end
    if case.duration then assert.are.equal(case.duration, trajectory:duration()) end
    if case.times then
      assert.are.equal(case.times[1], from)
      assert.is_true(math.abs(to - case.times[#case.times]) < 1e-12)
    end
  end)

  it("keeps its motion when it is placed and delayed", function()
    local q = d.turn({ 1, 0, 1 }, 0.8)
    local moved = trajectory:placed({ 1, 2, 3 }, q):delayed(0.25)
    local t = from + 0.37 * (to - from)
    local p = trajectory:position(t)
    assert.is_true(d.apart(moved:position(t + 0.25), { p[1] + 1, p[2] + 2, p[3] + 3 }) < 1e-12)
    assert.is_true(d.apart(moved:rotation(t + 0.25), d.multiply(trajectory:rotation(t), q)) < 1e-12)
    assert.is_true(d.apart(moved:velocity(t + 0.25), trajectory:velocity(t)) < 1e-10)
    assert.is_true(d.apart(moved:angular_velocity(t + 0.25), trajectory:angular_velocity(t)) < 1e-10)
    assert.is_true(math.abs(moved:starts() - from - 0.25) < 1e-15)
    assert.is_false(moved:relative())
  end)
end

for _, law in ipairs(laws()) do
  for name, case in pairs(cases) do
    describe(law .. ", " .. name, function() check_law(law, case) end)
  end
  if law ~= "linear" and law ~= "spline" then
    for name, case in pairs(resting) do
      describe(law .. ", " .. name, function() check_law(law, case) end)
    end
  end
end

describe("every law", function()
  it("leaves nothing behind at any failing allocation", function()
    collectgarbage()
    collectgarbage()
    for _, law in ipairs(laws()) do
      local before, n = core.allocated(), 0
      repeat
        n = n + 1
        core.fail_allocation(n)
        local fine, made = pcall(core.trajectory, with(cases["corners, speed"], { law = law }))
        core.fail_allocation(0)
        if fine then made:close() else assert.matches("out of memory", made) end
        assert.are.equal(before, (core.allocated()))
      until fine
      assert.is_true(n > 6)
    end
  end)

  it("can be evaluated without allocating", function()
    for _, law in ipairs(laws()) do
      local trajectory = core.trajectory(with(cases["corners, speed"], { law = law }))
      local _, before = core.allocated()
      trajectory:sample(100)
      local _, after = core.allocated()
      assert.are.equal(before, after)
    end
  end)
end)

describe("a turn without way-points", function()
  it("is one in place: a displacement by nothing", function()
    local turn = { axis = { 1, 2, 2 }, angle = 9 }
    local one = core.trajectory{ turn = turn, duration = 2 }
    local other = core.trajectory{ turn = turn, duration = 2, points = { { 0, 0, 0 }, { 0, 0, 0 } },
      relative = true }
    assert.is_true(one:relative())
    for k = 0, 8 do
      assert.same(other:rotation(k / 4), one:rotation(k / 4))
      assert.same({ 0, 0, 0 }, one:position(k / 4))
    end
  end)
end)
