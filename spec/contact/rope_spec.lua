-- SPDX-License-Identifier: GPL-3.0-or-later
-- A rope over a thick wire, on coarse meshes. Touches of the same two segments come and go; a new touch
-- must not take over the state of another one.
local core = require "softworld.core"

local R, RADIUS = 0.05, 0.0005

local function drawn(mu, segments)
  local path, Rw = {}, R + RADIUS
  for i = 10, 1, -1 do path[#path + 1] = { -Rw, 0, -0.01 * i } end
  for i = 0, 200 do
    local a = math.pi * (1 - i / 200)
    path[#path + 1] = { Rw * math.cos(a), 0, Rw * math.sin(a) }
  end
  for i = 1, 10 do path[#path + 1] = { Rw, 0, -0.01 * i } end
  local s = core.scene{ gravity = { 0, 0, 0 } }
  local thick = s:wire{ EA = 1e8, EI = 1e6, mass_per_length = 10, radius = R,
    from = { 0, -0.5, 0 }, to = { 0, 0.5, 0 }, segments = 10 }
  s:clamp(thick, { s = 0 })
  s:clamp(thick, { s = 1 })
  local w = s:wire{ model = "string", EA = 1e4, EI = 1e-9, mass_per_length = 0.1, radius = RADIUS,
    path = path, segments = segments }
  s:wire_contact{ between = { thick, w }, friction = mu, self = false }
  s:force{ kind = "point", on = w, s = 0, force = { 0, 0, -1 } }
  s:force{ kind = "damping", mass = 20, on = w }
  local c = s:pin(w, { s = w.length })
  local begun = s:advance({ dt = 0.002 }, 0.2)
  assert.is_true(begun.ok, begun.reason)
  assert.is_true(begun.rejected < 50, begun.rejected .. " steps rejected")
  c:follow{ points = { { 0, 0, 0 }, { 0, 0, -0.02 } }, relative = true, speed = 0.02, law = "linear" }
  local sum = 0
  for i = 1, 20 do
    assert.is_true(s:advance({ dt = 0.002 }, 0.6 + 0.01 * i).ok)
    sum = sum - c:force()[3] / 20
  end
  return sum
end

describe("a rope over a thick wire", function()
  for _, mu in ipairs{ 0.1, 0.3, 0.5 } do
    for _, n in ipairs{ 60, 100 } do
      it(("is drawn with exp(mu angle) times the pull: mu %g, %d segments"):format(mu, n), function()
        local ratio = drawn(mu, n) / math.exp(mu * math.pi)
        assert.is_true(math.abs(ratio - 1) < 0.02, ratio)
      end)
    end
  end
end)
