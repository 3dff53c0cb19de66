-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the specs of wires that are meshes of particles: the models, and a short thick wire, so that
-- slices are few.
local sw = require "softworld"

local meshes = {}

-- Every model at its defaults, and variants that make another mesh; core_E is in units of E.
meshes.all = {
  { "tube", { model = "tube" } },
  { "hollow tube", { model = "tube", core = false } },
  { "radial", { model = "radial" } },
  { "radial solid", { model = "radial", body = "solid" } },
  { "cubic", { model = "cubic" } },
  { "cubic solid", { model = "cubic", body = "solid" } },
  { "composite, line", { model = "composite", core = "line" } },
  { "composite, radial", { model = "composite", core = "radial" } },
  { "composite, cubic", { model = "composite", core = "cubic" } },
  { "composite, 3 lines", { model = "composite", core = "line", cores = 3 } },
  { "composite, 3 radial", { model = "composite", core = "radial", cores = 3 } },
  { "composite solid", { model = "composite", body = "solid", core_nu = 0.3, nu = 0.4 }, core_E = 5 },
}

-- One of each kind, for costly specs.
meshes.few = { meshes.all[1], meshes.all[3], meshes.all[4], meshes.all[5], meshes.all[6],
  meshes.all[7], meshes.all[12] }

meshes.length, meshes.radius, meshes.E, meshes.density = 0.5, 0.01, 1e7, 1200 -- L/d = 25

--- Adds a wire of 0.5 m by 20 mm along x that is such a mesh; `changes` override everything else.
function meshes.wire(scene, model, changes)
  local p = { E = meshes.E, density = meshes.density, radius = meshes.radius, from = { 0, 0, 0 },
    to = { meshes.length, 0, 0 } }
  for k, v in pairs(model[2]) do p[k] = v end
  for k, v in pairs(changes or {}) do
    p[k] = v
    if k == "path" then p.from, p.to = nil, nil end
    if k == "EA" then p.E = nil end
    if k == "mass_per_length" then p.density = nil end
  end
  if model.core_E and p.E then p.core_E = model.core_E * p.E end
  return scene:wire(p)
end

--- Returns a scene with such a wire; gravity is 0 unless changes.gravity gives it.
function meshes.scene(model, changes)
  local c = {}
  for k, v in pairs(changes or {}) do c[k] = v end
  local scene = sw.scene{ gravity = c.gravity or { 0, 0, 0 } }
  c.gravity = nil
  return scene, meshes.wire(scene, model, c)
end

return meshes
