-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shapes of hanging wires, for specs of sw.calibration: heavy inextensible elastica between level clamps,
-- half of the span, every 0.05 L along the wire: x / L, z / L. Boundary-value solver, error 1e-9.
local SHAPES = {
  { ratio = 1.05, gamma = 10, { 0.04981117264, -0.003775845908 }, { 0.09864806161, -0.0143444499 },
    { 0.1460496901, -0.03019614521 }, { 0.192152407, -0.04953265175 }, { 0.23755981, -0.07046394333 },
    { 0.283095945, -0.09111118997 }, { 0.3295207689, -0.1096549857 }, { 0.3772770164, -0.1244002755 },
    { 0.4263344345, -0.1339097031 }, { 0.4761904762, -0.137197352 } },
  { ratio = 1.05, gamma = 100, { 0.04952816151, -0.006039785908 }, { 0.09730818327, -0.02065114467 },
    { 0.1435076484, -0.0397503454 }, { 0.1889799232, -0.0605405067 } },
}

local function mirrored(shape)
  local points, span = {}, 1 / shape.ratio
  for _, p in ipairs(shape) do
    points[#points + 1] = { p[1], p[2] }
    if p[1] < span / 2 - 1e-6 then points[#points + 1] = { span - p[1], p[2] } end
  end
  return points
end

return { SHAPES = SHAPES, mirrored = mirrored }
