-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto" where the coarsest edges show another state than fine ones. The trunk of a harness is pushed
-- and buckles to one side or to the other. On 4 edges poses and dynamics agree on one side; on fine edges
-- dynamics end on the other, by inertia.
local sw = require "softworld"

local R = 0.0015
local SECTION = { EA = 1e5, EI = 0.0013, GJ = 0.0016, mass_per_length = 0.02, radius = R, rolls = false }

local function wire(scene, more)
  local args = {}
  for key, value in pairs(SECTION) do args[key] = value end
  for key, value in pairs(more) do args[key] = value end
  return scene:wire(args)
end

-- A trunk and branches at two angles; the hands come 40 mm nearer and rise within 1 s. mirrored: left and
-- right are exchanged.
local function harness(mirrored, segments)
  local scene, sign = sw.scene { name = "harness" }, mirrored and -1 or 1
  scene:obstacle { name = "table", shape = "plane", friction = 0 }
  local trunk = wire(scene, { name = "trunk", from = { 0, 0, R }, to = { 0.3, 0, R }, segments = segments })
  scene:clamp(trunk, { s = 0, name = "root" })
  local ends = { { trunk, s = 0.3 } }
  for k, angle in ipairs { 0.4876978, 0.2794877 } do
    local side = sign * (3 - 2 * k)
    local w = wire(scene, { name = ("branch%d"):format(k), from = { 0.3, 0, R }, segments = segments * 3 // 4,
      to = { 0.3 + 0.2 * math.cos(angle), side * 0.2 * math.sin(angle), R } })
    ends[k + 1] = { w, s = 0 }
    scene:clamp(w, { s = 0.2, name = ("hand%d"):format(k) }):follow { relative = true, duration = 1,
      points = { { 0, 0, 0 }, { -0.04, side * 0.007823, 0.05845 } } }
  end
  scene:join { name = "joint", ends = ends }
  scene:tie(trunk, { s = 0.15, to = { 0.15, 0, 0 }, slack = 0.02 + R })
  scene:force { kind = "damping", mass = 5 }
  scene:settle()
  return scene
end

local function distance(a, b)
  return ((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2) ^ 0.5
end

describe("model = 'auto' where coarse edges buckle to the other side", function()
  for _, mirrored in ipairs { false, true } do
    it(mirrored and "is not misled in the mirror image" or "compares on finer edges, and is not misled",
      function()
        local fine = harness(mirrored, 32)
        assert.is_true(fine:run { duration = 1, dt = 0.005 }.ok)
        local scene = harness(mirrored, 16)
        local run = scene:run { duration = 1, model = "auto", tolerance = {
          ["hand1.force"] = { relative = 0.1 }, ["hand2.force"] = { relative = 0.1 } } }
        assert.equal("dynamic", run.model.motion, tostring(run:why()))
        assert.is_true(run.met)
        for _, name in ipairs { "hand1", "hand2" } do
          local q = run.quantities[name .. ".force"]
          local truth = fine:find(name):force()
          -- 2 %: the error of 32 edges (0.439 N, against 0.447 N on 256 edges)
          assert.is_true(distance(q.value, truth) <= q.error + 0.02 * distance(truth, { 0, 0, 0 }),
            name .. ": " .. q:text())
        end
        local told
        for _, e in ipairs(run.events) do told = told or e.kind == "model" and e.text end
        assert.truthy(told and told:find("finer edges show another state than", 1, true), told)
      end)
  end
end)
