-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the specs of fits: a straight line, its data, and helpers.
local assert = require "luassert"
local sw = require "softworld"

local lines = {}

function lines.study(parameters, evaluate, more)
  local args = { name = "f", parameters = parameters, evaluate = evaluate, workers = 0 }
  for key, value in pairs(more or {}) do args[key] = value end
  return sw.study(args)
end

function lines.near(expected, value, tolerance, what)
  local off = math.abs(value - expected)
  assert.is_true(off <= tolerance * math.max(1e-300, math.abs(expected)),
    ("%s: %.12g instead of %.12g"):format(what or "value", value, expected))
end

lines.X = { 0.1, 0.4, 0.5, 0.9, 1.3, 1.4, 1.9, 2.2, 2.6, 3.0 }
lines.Y = { 1.12, 1.61, 1.75, 2.13, 2.92, 2.87, 3.64, 4.02, 4.61, 4.95 }

function lines.line(p)
  local y = {}
  for k, x in ipairs(lines.X) do y[k] = p.a + p.b * x end
  return { y = y }
end

lines.RANGES = { a = { -5, 5 }, b = { 0, 10 } }

function lines.data(list, sigma)
  local copy = table.move(list, 1, #list, 1, {})
  copy.sigma = sigma
  return copy
end

return lines
