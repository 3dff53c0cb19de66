-- SPDX-License-Identifier: GPL-3.0-or-later
-- A net of particles.

-- Makes n x n particles in a plane, with threads and bending stiffness between them.
local function net(scene, n, more)
  local positions, pairs_, triples = {}, {}, {}
  local function add(list, ...) for _, k in ipairs{ ... } do list[#list + 1] = k end end
  for j = 0, n - 1 do
    for i = 0, n - 1 do
      local k = j * n + i + 1
      add(positions, 0.1 * i, 0.1 * j, 1)
      if i + 1 < n then add(pairs_, k, k + 1) end
      if j + 1 < n then add(pairs_, k, k + n) end
      if i + 2 < n then add(triples, k, k + 1, k + 2) end
    end
  end
  local args = { positions = positions, masses = 0.01, links = { { pairs = pairs_, k = 50 } },
    folds = { { triples = triples, stiffness = 0.01 } }, radius = 0.005 }
  for k, v in pairs(more or {}) do args[k] = v end
  return scene:particles(args)
end

return { net = net }
