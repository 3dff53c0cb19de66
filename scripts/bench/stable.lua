-- SPDX-License-Identifier: GPL-3.0-or-later
--- Largest stable steps: measured by bisection, and expected from the largest natural frequency.
-- @module bench.stable
local bench = require "bench.rows"

local stable = {}

stable.steps = 2000 -- steps of one trial [-]
stable.blown = 1e8 -- a larger ratio of the energy to that at the start counts as unstable [-]

--- Wires of the reference table: straight, round, lumped masses, equal edges. omega: the rod's largest
-- natural frequency [rad/s], from exact eigenvalues (1e-12); given where axial waves determine it.
stable.wires = {
  { name = "rubber cord", E = 1e7, density = 1500, radius = 0.0025, length = 1, segments = 25,
    omega = 4080.468446 },
  { name = "rubber cord", E = 1e7, density = 1500, radius = 0.0025, length = 1, segments = 50,
    omega = 8163.958518 },
  { name = "rubber cord", E = 1e7, density = 1500, radius = 0.0025, length = 1, segments = 100,
    omega = 16329.42797 },
  { name = "nylon wire", E = 2e9, density = 1150, radius = 0.0005, length = 1, segments = 50,
    omega = 131859.8255 },
  { name = "thick stub", E = 1e7, density = 1500, radius = 0.0025, length = 0.05, segments = 40 },
}

-- Lengths of the clamp's two hinges in edges; all others are 1. This end-point rule is exact for constant,
-- linear and quadratic moments.
local clamp_hinges = { 5 / 12, 13 / 12 }

-- Returns K = sum over rows of k c c', divided on both sides by the roots of the masses, as a full matrix.
local function matrix(rows, root, n)
  local K = {}
  for i = 1, n do
    K[i] = {}
    for j = 1, n do K[i][j] = 0 end
  end
  for _, row in ipairs(rows) do
    for i, a in pairs(row.c) do
      for j, b in pairs(row.c) do
        if i >= 1 and j >= 1 then K[i][j] = K[i][j] + row.k * a * b / (root[i] * root[j]) end
      end
    end
  end
  return K
end

-- Rotates rows and columns p, q of K so that K[p][q] becomes 0; V collects the vectors (as rows).
local function rotate(K, V, n, p, q)
  local tau = (K[q][q] - K[p][p]) / (2 * K[p][q])
  local t = (tau >= 0 and 1 or -1) / (math.abs(tau) + (1 + tau * tau) ^ 0.5)
  local c = 1 / (1 + t * t) ^ 0.5
  local s = t * c
  for i = 1, n do
    local row = K[i]
    row[p], row[q] = c * row[p] - s * row[q], s * row[p] + c * row[q]
  end
  local a, b, va, vb = K[p], K[q], V[p], V[q]
  for i = 1, n do
    a[i], b[i] = c * a[i] - s * b[i], s * a[i] + c * b[i]
    va[i], vb[i] = c * va[i] - s * vb[i], s * va[i] + c * vb[i]
  end
end

-- Returns eigenvalues and eigenvectors of a symmetric matrix by Jacobi rotations. Destroys K.
local function eigen(K, n)
  local V = {}
  for i = 1, n do
    V[i] = {}
    for j = 1, n do V[i][j] = i == j and 1 or 0 end
  end
  for _ = 1, 30 do
    local off, diagonal = 0, 0
    for p = 1, n do
      diagonal = diagonal + K[p][p] ^ 2
      for q = p + 1, n do
        off = off + K[p][q] ^ 2
        if K[p][q] ^ 2 > 1e-30 * K[p][p] * K[q][q] then rotate(K, V, n, p, q) end
      end
    end
    if off < 1e-24 * diagonal then break end
  end
  return K, V
end

-- Returns the springs of a clamped chain of n edges in one direction: node 0 is held; the clamp's direction
-- is a separate hinge.
local function springs(w)
  local n, h = w.segments, w.length / w.segments
  local A = math.pi * w.radius ^ 2
  local EA, EI, m = w.E * A, w.E * A * w.radius ^ 2 / 4, w.density * A * h
  local root, stretch, bend = {}, {}, {}
  for i = 1, n do
    root[i] = (i < n and m or m / 2) ^ 0.5
    stretch[i] = { k = EA / h, c = { [i - 1] = -1, [i] = 1 } }
    local k = EI / ((clamp_hinges[i] or 1) * h)
    bend[i] = i == 1 and { k = k, c = { [1] = 1 / h } }
      or { k = k, c = { [i - 2] = 1 / h, [i - 1] = -2 / h, [i] = 1 / h } }
  end
  return root, stretch, bend
end

-- Adds the modes of one direction: { omega =, share = share of the energy if all nodes start with the same
-- velocity }.
local function add_modes(modes, rows, root, n)
  local K, V = eigen(matrix(rows, root, n), n)
  local mass = 0
  for i = 1, n do mass = mass + root[i] ^ 2 end
  for k = 1, n do
    local part = 0
    for i = 1, n do part = part + V[k][i] * root[i] end
    modes[#modes + 1] = { omega = math.max(K[k][k], 0) ^ 0.5, share = 0.5 * part ^ 2 / mass }
  end
end

--- Returns the natural frequencies [rad/s] of a straight clamped wire with lumped masses, and their shares of
-- the energy if all nodes start with the same velocity; axial modes first. The string's bending spring is
-- linear in the second difference of positions, so it stiffens axial waves too.
function stable.modes(w, model)
  local root, stretch, bend = springs(w)
  local modes, n = {}, w.segments
  if model == "string" then table.move(bend, 1, n, n + 1, stretch) end
  add_modes(modes, stretch, root, n)
  add_modes(modes, bend, root, n)
  return modes
end

--- Returns the smallest step [s] with which this energy grows more than allowed in one trial.
function stable.expected(integrator, modes)
  local fastest = 0
  for _, mode in ipairs(modes) do fastest = math.max(fastest, mode.omega) end
  for y = 0.2, 20, 0.002 do
    local energy = 0
    for _, mode in ipairs(modes) do
      energy = energy + mode.share * bench.growth(integrator, y * mode.omega / fastest) ^ (2 * stable.steps)
    end
    if energy > stable.blown then return y / fastest end
  end
end

--- Returns the largest value between low (expected good) and high (expected bad) for which test(value) is
-- true, by bisection of the logarithm; low if even low fails, high if high passes.
function stable.largest(test, low, high, rounds)
  if not test(low) then return low, "below" end
  if test(high) then return high, "above" end
  for _ = 1, rounds do
    local middle = (low * high) ^ 0.5
    if test(middle) then low = middle else high = middle end
  end
  return (low * high) ^ 0.5, "found"
end

--- Returns a scene for trials: no gravity, and a velocity so small that everything stays linear.
function stable.scene(w, model)
  local sw = require "softworld"
  local scene = sw.scene{ name = w.name, gravity = { 0, 0, 0 } }
  local wire = scene:wire{ model = model, E = w.E, density = w.density, radius = w.radius,
    from = { 0, 0, 0 }, to = { w.length, 0, 0 }, segments = w.segments }
  scene:clamp(wire, { s = 0 })
  wire:set_velocity{ 1e-6 * w.length, 0, 1e-6 * w.length }
  return scene
end

--- Returns the measured and the expected largest stable step [s] of an explicit method on a wire with these
-- modes; how it was found ("found", "below" or "above" the tried steps); the program's own step for the
-- leapfrog limit [s].
function stable.measure(integrator, w, model, modes, rounds)
  local scene = stable.scene(w, model)
  local snapshot, start = scene:snapshot(), scene:energy().total
  local expected = stable.expected(integrator, modes)
  local function bounded(dt)
    scene:restore(snapshot)
    local r = scene:advance({ dt = dt, integrator = integrator, unstable = true },
      stable.steps * dt)
    return r.ok and r.rejected == 0 and scene:energy().total < stable.blown * start
  end
  local found, how = stable.largest(bounded, expected / 1.5, expected * 1.5, rounds or 9)
  local own = scene:stable_dt()
  scene:close()
  return found, expected, how, own
end

return stable
