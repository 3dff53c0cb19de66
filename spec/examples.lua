-- SPDX-License-Identifier: GPL-3.0-or-later
--- Runs the examples as a user would run them, and reads their output.
local program = require "spec.host.program"

local examples = { program = program }

-- Returns the output of an example, and all its numbers in their order.
function examples.run(name, ...)
  local out, err, code = program.run { "examples/" .. name .. ".lua", ... }
  assert(code == 0, name .. " failed: " .. err)
  assert(not err:find("softworld: note:", 1, true), name .. " does not show its events: " .. err)
  local numbers = {}
  for word in out:gmatch "%f[%w+-][+-]?%d[%d.]*[eE]?[+-]?%d*" do
    numbers[#numbers + 1] = tonumber(word)
  end
  return out, numbers
end

function examples.after(out, words)
  local _, stop = out:find(words, 1, true)
  assert(stop, "'" .. words .. "' was not printed:\n" .. out)
  return tonumber(out:match("^%s*([+-]?%d[%d.]*[eE]?[+-]?%d*)", stop + 1))
end

function examples.near(expected, value, tolerance, what)
  local off = math.abs(value / expected - 1)
  assert(off <= tolerance, ("%s: %.6g instead of %.6g, off by %.2g, allowed %.2g"):format(what or "value",
    value, expected, off, tolerance))
end

return examples
