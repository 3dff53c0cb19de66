-- SPDX-License-Identifier: GPL-3.0-or-later
-- The path of a wire over a drum is given by a few points. Its chords begin inside the drum, at other nodes
-- for every number of segments.
local scenes = require "spec.contact.scenes"
local core = require "softworld.core"

local R, W, DOWN = 0.06, 5, 0.25 -- radius of the drum [m], weight on the end [N], its depth [m]

describe("a wire whose path over a drum is a few chords", function()
  local cable = scenes.cable "GXL 1.5"
  local q = R + cable.radius

  local function pull(segments, dt)
    local s, path = core.scene{}, { { -0.25, 0, q } }
    s:obstacle{ shape = "cylinder", radius = R, length = 0.2, friction = 0,
      rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    for i = 0, 12 do
      local t = i / 12 * math.pi / 2
      path[#path + 1] = { q * math.sin(t), 0, q * math.cos(t) }
    end
    path[#path + 1] = { q, 0, -DOWN }
    local w = scenes.add_wire(s, nil, nil, segments, { EA = cable.EA, EI = cable.EI, GJ = cable.GJ,
      mass_per_length = cable.mass_per_length, radius = cable.radius, path = path })
    s:force{ kind = "damping", on = w, mass = 3, stiffness = 0.001 }
    local pin = s:pin(w, { s = 0 })
    s:force{ kind = "point", on = w, s = w.length, force = { 0, 0, -W } }
    local run = s:advance({ dt = dt }, 0.8)
    assert.is_true(run.ok, run.reason)
    return -pin:force()[1]
  end

  -- Without friction the pull is W plus the weight of the wire that hangs below the pin.
  local expected = W + 9.81 * cable.mass_per_length * (q + DOWN)
  for _, segments in ipairs{ 120, 160, 200, 240, 400 } do
    it(("is drawn with %d segments"):format(segments), function()
      for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
        assert.near(expected, pull(segments, dt), 0.005 * expected)
      end
    end)
  end
end)
