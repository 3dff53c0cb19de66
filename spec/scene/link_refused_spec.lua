-- SPDX-License-Identifier: GPL-3.0-or-later
-- Refusals of ties, clips and channels name the object, the parameter, the value and the range. They do not
-- name the obstacles that it is made of, nor the matrix that such a stiffness would spoil.
local sw = require "softworld"

local function made(kind, given)
  local scene = sw.scene{}
  local wire = scene:wire{ E = 5e6, density = 1500, radius = 0.0025, from = { 0, 0, 0.1 },
    to = { 0.5, 0, 0.1 }, segments = 20 }
  local args = { tie = { s = 0.5, to = { 0.5, 0, 0.2 } },
    clip = { at = { 0.2, 0, 0.1 }, width = 0.006, insertion = 8, retention = 25 },
    channel = { points = { { 0, 0, 0 }, { 0.4, 0, 0 } }, width = 0.02, depth = 0.015 } }
  for key, value in pairs(given) do args[kind][key] = value end
  if kind == "tie" then scene:tie(wire, args.tie) else scene[kind](scene, args[kind]) end
  scene:clamp(wire, { s = 0 })
  return scene
end

local SIZE, FRICTION = "at least 1e-06 m and at most 1000 m", "at least 0 and at most 100"

describe("the range of a number that is too small or too large for", function()
  for _, case in ipairs{
    { "channel", "width", 1e300, SIZE }, { "channel", "width", 1e-300, SIZE },
    { "channel", "depth", 1e300, SIZE }, { "channel", "thickness", 1e-9, SIZE },
    { "channel", "friction", 101, FRICTION }, { "clip", "friction", 1e300, FRICTION },
    { "clip", "width", 1e-300, SIZE }, { "clip", "way", 1e-300, SIZE }, { "clip", "width", 1e300, SIZE },
    { "clip", "radius", 1e300, "above 0 m and at most 1000 m" },
    { "clip", "stiffness", 1e300, "above 0 N/m and at most 1e+12 N/m" },
    { "clip", "strength", 1e300, "above 0 N and at most 1e+10 N" },
    { "clip", "snap", 1e300, "at least 0 s and at most 1000 s" },
    { "tie", "stiffness", 1e300, "above 0 N/m and at most 1e+12 N/m" },
  } do
    local kind, key, value, range = table.unpack(case)
    it(("a %s is told: %s = %g"):format(kind, key, value), function()
      local ok, message = pcall(made, kind, { [key] = value })
      assert.is_false(ok)
      assert.truthy(message:find(("%s '%s1': %s = %.9g"):format(kind, kind, key, value), 1, true), message)
      assert.truthy(message:find("is not allowed; it must be " .. range, 1, true), message)
    end)
  end
end)

describe("the limits of allowed ranges", function()
  for _, case in ipairs{ { "tie", "stiffness", 1e12 }, { "clip", "stiffness", 1e12 },
    { "clip", "strength", 1e10 }, { "clip", "snap", 1000 }, { "clip", "way", 1e-6 },
    { "channel", "width", 1e-6 }, { "channel", "thickness", 1e-6 }, { "channel", "friction", 100 } } do
    it(("run: a %s with %s = %g"):format(table.unpack(case)), function()
      local run = made(case[1], { [case[2]] = case[3] }):run{ duration = 0.05 }
      assert.is_true(run.ok, run.reason)
    end)
  end
end)

it("a time that is not a number is refused in plain words", function()
  local scene = sw.scene{}
  local table_top = scene:obstacle{ shape = "plane" }
  local _, message = pcall(table_top.over, table_top, 0 / 0)
  assert.truthy(message:find("it must be finite", 1, true), message)
  _, message = pcall(table_top.over, table_top, "x")
  assert.truthy(message:find("it must be a number that is finite", 1, true), message)
end)
