-- SPDX-License-Identifier: GPL-3.0-or-later
-- model = "auto", a solid wire squeezed by a fifth: the mesh of springs with which poses were compared with
-- dynamics becomes one of elements, which has another force.
local mesh = require "softworld.model.mesh"
local probe = require "softworld.model.probe"
local squeeze = require "spec.model.plates"
local sw = require "softworld"

local R, E, DEPTH = 0.01, 5e5, 0.2
local FORCE = 0.2240633922 * E * R * R -- reference case 11: plates that stick, nu = 0.3 [N]

local function squeezed()
  local scene = sw.scene { gravity = { 0, 0, 0 } }
  local w = scene:wire { name = "w", model = "auto", E = E, nu = 0.3, density = 1200, radius = R,
    from = { 0, 0, 0 }, to = { R, 0, 0 }, segments = 4 }
  squeeze(scene, w, R, DEPTH, 2)
  scene:force { kind = "damping", mass = 50 }
  return scene:run { duration = 0.4, tolerance = { ["top.force"] = { relative = 0.1 } } }
end

describe("model = 'auto', where poses were compared with another mesh than that of the run,", function()
  local of, list = probe.of, {}
  function probe.of(context, rungs, k, ...)
    list[#list + 1] = { motion = rungs.motion, section = rungs.section, k = k }
    return of(context, rungs, k, ...)
  end
  local fine, run = pcall(squeezed)
  probe.of = of
  if not fine then error(run, 0) end

  it("compares them with this mesh, and on no finer edges", function()
    local least, most = math.huge, 0
    for _, c in ipairs(list) do
      if c.motion == 2 and c.section == mesh.elements then
        least, most = math.min(least, c.k), math.max(most, c.k)
      end
    end
    assert.equal(1, least)
    assert.equal(1, most)
  end)

  it("has a true bar", function()
    assert.equal("poses", run.model.motion)
    assert.equal("elements", run.model.section)
    assert.is_true(run.met, tostring(run:why()))
    local q = run.quantities["top.force"]
    assert.is_true(math.abs(q.value[3] - FORCE) <= q.error + 0.005 * FORCE, tostring(run:why()))
  end)
end)
