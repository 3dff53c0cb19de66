-- SPDX-License-Identifier: GPL-3.0-or-later
-- A beam of finite length, assembled from a calibration's springs and elements and solved by the general
-- sparse solver. It uses no periodic cells. Both end slices are rigid.
local core = require "softworld.core"

local beam = {}

-- Adds the stiffness against the displacement sum signs[i] u[node i] along direction.
local function element(matrix, nodes, signs, direction, stiffness)
  for a, p in ipairs(nodes) do
    for b, q in ipairs(nodes) do
      local key = p * matrix.count + q
      local block = matrix.block[key]
      if not block then
        block = { 0, 0, 0, 0, 0, 0, 0, 0, 0 }
        matrix.block[key] = block
      end
      local factor = stiffness * signs[a] * signs[b]
      for i = 1, 3 do
        for j = 1, 3 do
          local at = 3 * (i - 1) + j
          block[at] = block[at] + factor * direction[i] * direction[j]
        end
      end
    end
  end
end

local function add_link(matrix, c, l, slice, M)
  local stiffness = c.springs[l.group] * l.weight
  if l.bend then -- against the angle at slice + 1, of the small deflections across the line
    local nodes = {}
    for k = 0, 2 do nodes[k + 1] = (slice + k) * M + l.from - 1 end
    for _, across in ipairs { { 1, 0, 0 }, { 0, 1, 0 } } do
      element(matrix, nodes, { 1, -2, 1 }, across, stiffness / c.spacing ^ 2)
    end
    return
  end
  local p, q, d, length = c.particles[l.from], c.particles[l.to], {}, 0
  for i = 1, 3 do d[i] = q[i] - p[i] + (i == 3 and l.slices * c.spacing or 0) end
  for i = 1, 3 do length = length + d[i] ^ 2 end
  for i = 1, 3 do d[i] = d[i] / math.sqrt(length) end
  element(matrix, { slice * M + l.from - 1, (slice + l.slices) * M + l.to - 1 }, { -1, 1 }, d, stiffness)
end

local function add_element(matrix, c, e, slice, M)
  local rest = {}
  for a, p in ipairs(e.particles) do
    local at = c.particles[p]
    rest[3 * a - 2], rest[3 * a - 1], rest[3 * a] = at[1], at[2], at[3] + e.slices[a] * c.spacing
  end
  local mu = 0.5 * e.modulus / (1 + e.nu)
  local _, _, H = core.solid(rest, mu, 2 * mu * e.nu / (1 - 2 * e.nu), rest)
  for a, p in ipairs(e.particles) do
    for b, q in ipairs(e.particles) do
      local key = ((slice + e.slices[a]) * M + p - 1) * matrix.count + (slice + e.slices[b]) * M + q - 1
      local block = matrix.block[key] or { 0, 0, 0, 0, 0, 0, 0, 0, 0 }
      matrix.block[key] = block
      for i = 1, 3 do
        for j = 1, 3 do
          local at = 3 * (i - 1) + j
          block[at] = block[at] + H[(3 * a + i - 4) * #rest + 3 * (b - 1) + j]
        end
      end
    end
  end
end

-- Returns the stiffness matrix of slices 0 to n, as blocks by node.
local function assemble(c, n)
  local M = #c.particles
  local matrix = { block = {}, count = (n + 1) * M, M = M, n = n }
  for slice = 0, n do
    for _, l in ipairs(c.links) do
      if slice + (l.bend and 2 or l.slices) <= n then add_link(matrix, c, l, slice, M) end
    end
    for _, e in ipairs(slice < n and c.elements or {}) do add_element(matrix, c, e, slice, M) end
  end
  return matrix
end

-- Displacements of the last slice as a rigid body: u = t + r x (x, y, z).
local motions = {
  stretch = function() return { 0, 0, 1 } end,
  twist = function(p) return { -p[2], p[1], 0 } end,
  across = function() return { 1, 0, 0 } end,
  turn = function(p) return { p[3], 0, -p[1] } end, -- about y
}

local function times(block, u, out)
  for i = 1, 3 do
    for j = 1, 3 do out[i] = out[i] + block[3 * (i - 1) + j] * u[j] end
  end
end

-- Returns the displacements of all nodes when the last slice moves by motion.
local function solve(matrix, c, motion)
  local M, first, last = matrix.M, matrix.M, matrix.n * matrix.M -- free nodes: first to last - 1
  local own, pairs_, values, right, u = {}, {}, {}, {}, {}
  for i = 0, matrix.count - 1 do u[i] = { 0, 0, 0 } end
  for i = 0, M - 1 do u[last + i] = motion(c.particles[i + 1]) end
  local force = {}
  for i = first, last - 1 do force[i] = { 0, 0, 0 } end
  for key, block in pairs(matrix.block) do
    local p, q = key // matrix.count, key % matrix.count
    local free_p, free_q = p >= first and p < last, q >= first and q < last
    if free_p and free_q and p < q then
      pairs_[#pairs_ + 1], pairs_[#pairs_ + 2] = p - first, q - first
      table.move(block, 1, 9, #values + 1, values)
    elseif free_p and p == q then
      table.move(block, 1, 9, 9 * (p - first) + 1, own)
    elseif free_p and q >= last then
      times(block, u[q], force[p])
    end
  end
  for i = first, last - 1 do
    for k = 1, 3 do right[3 * (i - first) + k] = -force[i][k] end
  end
  local solved, negative = require("softworld.probe").sparse(3, own, pairs_, values, right)
  assert(negative == 0, "the mesh has a direction without stiffness")
  for i = first, last - 1 do
    for k = 1, 3 do u[i][k] = solved[3 * (i - first) + k] end
  end
  return u
end

-- Returns the generalised force: the work of the end's forces in state u on the motion.
local function reaction(matrix, c, u, motion)
  local last, sum = matrix.n * matrix.M, 0
  for key, block in pairs(matrix.block) do
    local p, q = key // matrix.count, key % matrix.count
    if p >= last then
      local f, m = { 0, 0, 0 }, motion(c.particles[p - last + 1])
      times(block, u[q], f)
      for k = 1, 3 do sum = sum + f[k] * m[k] end
    end
  end
  return sum
end

--- Compliances of the end of n slices: stretch, twist, across (force), turn (moment).
function beam.compliances(c, n, bending_only)
  local matrix, out = assemble(c, n), {}
  if not bending_only then
    for _, name in ipairs { "stretch", "twist" } do
      out[name] = 1 / reaction(matrix, c, solve(matrix, c, motions[name]), motions[name])
    end
  end
  local a, t = solve(matrix, c, motions.across), solve(matrix, c, motions.turn)
  local aa, tt = reaction(matrix, c, a, motions.across), reaction(matrix, c, t, motions.turn)
  local at = reaction(matrix, c, a, motions.turn)
  local determinant = aa * tt - at * at
  out.across, out.turn = tt / determinant, aa / determinant
  return out
end

--- EA, EI (from a moment, and from a force) and GJ of the beam without its ends. Equal ends add the same to
--- stretch, twist and turn at every length. A deflection by a force is L^3/3EI plus a polynomial of second
--- order, whose third difference vanishes.
function beam.stiffness(c, n, more)
  local d, at = more * c.spacing, {}
  for k = 0, 3 do at[k] = beam.compliances(c, n + k * more, k > 1) end
  local third = at[3].across - 3 * at[2].across + 3 * at[1].across - at[0].across
  return { EA = d / (at[1].stretch - at[0].stretch), GJ = d / (at[1].twist - at[0].twist),
    EI = d / (at[1].turn - at[0].turn), EI_by_force = 2 * d ^ 3 / third }
end

return beam
