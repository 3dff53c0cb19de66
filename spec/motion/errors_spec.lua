-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wrong arguments: the message names the thing, the value, the unit and what was expected.
local core = require "softworld.core"

local ways = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }
local wrong = {
  { { points = ways, sped = 1 }, "trajectory: there is no parameter 'sped'; did you mean 'speed'?" },
  { { points = ways, speed = -1 }, "trajectory: speed = -1 m/s is not allowed; it must be above 0 m/s" },
  { { points = ways, speed = 0 / 0 }, "is not allowed; it must be above 0 m/s" },
  { { points = ways, speed = "fast" }, "trajectory: speed must be a number [m/s], got string" },
  { { points = ways, speed = 1, law = "minimum jerk" }, "did you mean 'minimum-jerk'?" },
  { { points = ways, speed = 1, law = "sudden" },
    "is not one of: linear, trapezoidal, minimum-jerk, spline" },
  { { points = ways, speed = 1, law = "callback" },
    "is not one of: linear, trapezoidal, minimum-jerk, spline" },
  { { points = ways }, "the speed is not given; give speed [m/s], duration [s] or a time for every "
    .. "way-point" },
  { { points = ways, speed = 1, duration = 2 }, "give duration = 2 s or a speed, not both" },
  { { points = ways, times = { 0, 1, 2 }, speed = 1 }, "the way-points have times; leave out speed" },
  { { points = ways, times = { 0, 1 } }, "times must have one entry per way-point, 3 in all, got 2" },
  { { points = ways, times = { 0, 1, 1 } }, "times must increase, but way-point 3 has t = 1 s after 1 s" },
  { { points = ways, times = { 0, "a", 1 } }, "trajectory: times[2] must be a number [s], got string" },
  { { points = ways, times = 3 }, "times must be an array of numbers [s], got number" },
  { { points = { { 0, 0, 0, t = 0 }, { 1, 0, 0 } } }, "way-point 1 has a time and way-point 2 has none" },
  { { points = { { 0, 0, 0 } }, speed = 1 }, "a path needs at least 2 way-points, got 1" },
  { { speed = 1 }, "a path needs at least 2 way-points, got 0 (give points = {{x,y,z}, ...}, or turn" },
  { { path = function() return { 0, 0, 0 } end }, "path is a file or way-points; give a function of time" },
  { { points = 3, speed = 1 }, "points must be an array of way-points {x,y,z}, got number" },
  { { points = { { 0, 0, 0 }, 4 }, speed = 1 }, "way-point 2 must be a table {x, y, z} [m], got number" },
  { { points = { { 0, 0, 0 }, { 1, 0 } }, speed = 1 }, "way-point 2, item 3, must be a number [m]" },
  { { points = { { 0, 0, 0 }, { 1, 0, 1 / 0 } }, speed = 1 }, "way-point 2, item 3, = inf m is not allowed" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, 0 } }, speed = 1 }, "way-point 2 must have 3 numbers, got 4" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, rotatoin = 1 } }, speed = 1 }, "did you mean 'rotation'?" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, rotation = { 0, 0, 0, 0 } } }, speed = 1 },
    "way-point 2: rotation must not be the zero quaternion" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, turn = { axis = { 0, 0, 0 }, angle = 1 } } }, speed = 1 },
    "way-point 2: turn.axis must not be the zero vector" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, turn = { axis = { 0, 0, 1 } } } }, speed = 1 },
    "way-point 2: turn.angle must be a number [rad]" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, turn = { axis = { 0, 0, 1 }, angel = 1 } } }, speed = 1 },
    "way-point 2: turn: there is no parameter 'angel'; known are: axis angle" },
  { { points = { { 0, 0, 0 }, { 0, 0, 0 } }, speed = 1 },
    "way-point 2 (0, 0, 0) m repeats the one before it" },
  { { points = ways, speed = 1, law = "linear", acceleration = 1 }, "an acceleration cannot be kept" },
  { { points = ways, speed = 1, law = "linear", stop = true }, "law 'linear' never rests" },
  { { points = ways, speed = 1, law = "spline", stop = true },
    "law 'spline' passes through every way-point" },
  { { points = ways, speed = 1, stop = true, blend = 0.1 },
    "blend = 0.1 m has no use where law 'minimum-jerk' rests" },
  { { points = ways, times = { 0, 1, 2 }, law = "minimum-jerk", stop = false },
    "use 'spline' to pass through" },
  { { points = ways, speed = 1, stop = 1 }, "stop must be true or false, got number" },
  { { points = ways, times = { 0, 1, 2 }, law = "trapezoidal", acceleration = 1 },
    "1 s from way-point 1 to 2 is too short for the acceleration; it takes at least 2 s" },
  { { points = ways, times = { 0, 1, 2 }, acceleration = 1 },
    "the times are too short for the acceleration" },
  { { points = { { 0, 0, 0 }, { 1, 0, 0, rotation = { axis = { 0, 0, 1 }, angle = 1 } } }, turn = { axis = {
    1, 0, 0 },
    angle = 1 }, speed = 1 }, "turn cannot be combined with orientations" },
  { { points = { { 0, 0, 0 } }, turn = { axis = { 1, 0, 0 }, angle = 1 }, speed = 1 },
    "between way-points 1 and 2 there is only a turn of 1 rad" },
  { { points = ways, angular_speed = 1 }, "give speed [m/s], or a time for every way-point" },
  { { points = ways, turn = { axis = { 1, 0, 0 }, angle = 7 }, duration = 2, law = "spline" },
    "law 'spline' needs turns below 3.1 rad" },
  { { points = { { 0.1, 0, 0, t = 0 }, { 1, 0, 0, t = 1 } }, relative = true },
    "way-point 1 is not at displacement 0, so its time (0 s) must be above 0 s" },
  { { func = 3 }, "func must be a function of time [s], got number" },
  { { func = print, speed = 2 }, "speed has no use with func" },
  { { func = print, step = 0 }, "step = 0 s is not allowed; it must be in (0, 1] s" },
  { { func = print, duration = 1e-5 }, "a duration (1e-05 s) of at least two steps (of 0.0001 s)" },
  { { points = ways, path = ways, speed = 1 }, "give points or path, not both" },
  { { points = ways, speed = 1, scale = 1e-3 }, "scale has no use without a path that names a file" },
  { { points = ways, speed = 1, step = 1e-3 }, "step has no use without func" },
}

describe("a trajectory", function()
  for i, case in ipairs(wrong) do
    it(("%d: %s"):format(i, case[2]), function()
      local before = core.allocated()
      local fine, message = pcall(core.trajectory, case[1])
      assert.is_false(fine)
      assert.is_truthy(message:find(case[2], 1, true), message)
      assert.is_truthy(message:find("trajectory", 1, true), message)
      assert.are.equal(before, (core.allocated()))
    end)
  end

  it("refuses what is no trajectory, and wrong calls", function()
    for _, value in ipairs { 3, "lay.csv", true, print } do
      if value ~= print then assert.has_error(function() core.trajectory(value) end) end
    end
    assert.has_error(function() core.trajectory() end)
    local m = core.trajectory { points = ways, speed = 1 }
    assert.are.equal(m, core.trajectory(m))
    assert.has_error(function() m:position() end)
    assert.has_error(function() m:position(0 / 0) end)
    assert.has_error(function() m.position({}, 1) end)
    for _, n in ipairs { 1, 2.5, -3, 1e9, 0 / 0, "x" } do
      assert.has_error(function() m:sample(n) end)
    end
    assert.has_error(function() core.trajectory(function() end):sample(3) end)
    assert.has_error(function() core.trajectory(function() end):length() end)
  end)

  it("prints itself", function()
    local m = core.trajectory { points = { { 0, 0, 0 }, { 0.5, 0, 0 } }, speed = 0.25, law = "linear" }
    assert.are.equal("trajectory: linear, 2 way-points, 0.5 m in 2 s", tostring(m))
    assert.are.equal("trajectory: a function of time", tostring(core.trajectory(print)))
  end)

  it("has a unit and a meaning for every parameter", function()
    for _, row in ipairs(core.trajectory_parameters()) do
      assert.is_true(#row.unit > 0 and #row.doc > 10, row.name)
    end
  end)
end)
