-- SPDX-License-Identifier: GPL-3.0-or-later
--- A piece of a long wire between long plates, one below and one above it.

-- Puts plates at a wire of radius R on the x-axis [m]. They approach by a share of its width in 0.4 s.
return function(scene, wire, R, share, friction)
  scene:force { kind = "plane_strain", on = wire, direction = { 1, 0, 0 } }
  for k, name in ipairs { "low", "top" } do
    local side = 2 * k - 3
    scene:obstacle { name = name, shape = "box", size = { 10 * R, 10 * R, 2 * R }, friction = friction,
      at = { R / 2, 0, 2 * side * R } }:follow { relative = true, duration = 0.4,
      points = { { 0, 0, 0 }, { 0, 0, -side * share * R } } }
  end
end
