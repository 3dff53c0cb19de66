-- SPDX-License-Identifier: GPL-3.0-or-later
-- One slice of solid elements in plane strain, squeezed along x between rigid frictionless plates:
-- Newton's method over core.solid, written without the core's own solvers of scenes.
local core = require "softworld.core"

local plates = {}

local STIFF = 1e3 -- stiffness against a plate, over modulus times spacing: sinks in by 1e-5 R

-- Returns energy, gradient by particle {x, y}, blocks by pair of particles (9 numbers, z held), plate
-- force.
local function evaluate(m, x, semidefinite)
  local energy, gradient, blocks = 0, {}, {}
  for i = 1, 2 * m.n do gradient[i] = 0 end
  local function block(p, q)
    local key = p * m.n + q
    if not blocks[key] then blocks[key] = { 0, 0, 0, 0, 0, 0, 0, 0, 0 } end
    return blocks[key]
  end
  for _, e in ipairs(m.elements) do
    local places = {}
    for a, p in ipairs(e.particles) do
      places[3 * a - 2], places[3 * a - 1] = x[2 * p - 1], x[2 * p]
      places[3 * a] = e.rest[3 * a]
    end
    local w, g, H = core.solid(e.rest, m.mu, m.lambda, places, semidefinite)
    energy = energy + w
    local size = #places
    for a, p in ipairs(e.particles) do
      for i = 1, 2 do
        local row = 3 * (a - 1) + i
        gradient[2 * p - 2 + i] = gradient[2 * p - 2 + i] + g[row]
        for b, q in ipairs(e.particles) do
          local to = block(p - 1, q - 1)
          for j = 1, 2 do
            to[3 * (i - 1) + j] = to[3 * (i - 1) + j] + H[(row - 1) * size + 3 * (b - 1) + j]
          end
        end
      end
    end
  end
  local force = 0
  for p = 1, m.n do
    for side = -1, 1, 2 do
      local gap = m.plate - side * x[2 * p - 1]
      if gap < 0 then
        energy = energy + 0.5 * m.stiff * gap * gap
        gradient[2 * p - 1] = gradient[2 * p - 1] - side * m.stiff * gap
        local own = block(p - 1, p - 1)
        own[1] = own[1] + m.stiff
        if side > 0 then force = force - m.stiff * gap end
      end
    end
  end
  for p = 1, m.n do
    if m.held[p] then gradient[2 * p] = 0 end
  end
  return energy, gradient, blocks, force
end

-- Particles at y = 0 stay there, by symmetry; no particle moves along z.
local function solve(m, gradient, blocks)
  local own, pairs_, values, right = {}, {}, {}, {}
  for p = 0, m.n - 1 do
    for q = p, m.n - 1 do
      local block = blocks[p * m.n + q]
      if block then
        if m.held[p + 1] then block[4], block[5], block[6] = 0, 0, 0 end
        if m.held[q + 1] then block[2], block[5], block[8] = 0, 0, 0 end
        if p == q then
          block[9] = 1
          if m.held[p + 1] then block[5] = 1 end
          table.move(block, 1, 9, 9 * p + 1, own)
        else
          pairs_[#pairs_ + 1], pairs_[#pairs_ + 2] = p, q
          table.move(block, 1, 9, #values + 1, values)
        end
      end
    end
    right[3 * p + 1], right[3 * p + 2], right[3 * p + 3] = -gradient[2 * p + 1], -gradient[2 * p + 2], 0
  end
  return require("softworld.probe").sparse(3, own, pairs_, values, right)
end

-- Returns the largest share of the move that every element allows.
local function allowed(m, x, move)
  local least = 1
  for _, e in ipairs(m.elements) do
    local places, dx = {}, {}
    for a, p in ipairs(e.particles) do
      places[3 * a - 2], places[3 * a - 1], places[3 * a] = x[2 * p - 1], x[2 * p], e.rest[3 * a]
      dx[3 * a - 2], dx[3 * a - 1], dx[3 * a] = move[3 * p - 2], move[3 * p - 1], 0
    end
    least = math.min(least, (select(7, core.solid(e.rest, m.mu, m.lambda, places, false, dx))))
  end
  return least
end

local function settle(m, x)
  local iterations = 0
  local energy, gradient, blocks = evaluate(m, x)
  local force, largest
  repeat
    iterations = iterations + 1
    local move, negative = solve(m, gradient, blocks)
    if negative > 0 then
      local _, _, definite = evaluate(m, x, true)
      move = solve(m, gradient, definite)
    end
    local share, slope, trial, now = allowed(m, x, move), 0, {}
    largest = 0
    for p = 1, m.n do
      for i = 1, 2 do
        slope = slope + move[3 * (p - 1) + i] * gradient[2 * (p - 1) + i]
        largest = math.max(largest, math.abs(move[3 * (p - 1) + i]))
      end
    end
    local good
    repeat
      for p = 1, m.n do
        for i = 1, 2 do trial[2 * p - 2 + i] = x[2 * p - 2 + i] + share * move[3 * p - 3 + i] end
      end
      now, gradient, blocks, force = evaluate(m, trial)
      good = now <= energy + 1e-4 * share * slope + 1e-12 * math.abs(energy)
      share = 0.5 * share
    until good or share < 1e-6
    x, energy = trial, now
    if iterations > 60 then error "no equilibrium" end
  until largest < 1e-7 * m.size
  return x, force, iterations
end

--- Forces per length over modulus and radius, F/(E R), at approaches of the plates as shares of the
--- diameter, in rising order. c: a calibration's particles and elements; nu: of the elements. Contact starts
--- at the outermost particles; R is their distance from the axis.
function plates.squeeze(c, nu, approaches, per_step)
  local h = c.spacing
  local m = { n = #c.particles, elements = {}, held = {}, mu = 0.5 / (1 + nu),
    lambda = nu / ((1 + nu) * (1 - 2 * nu)), size = 0, stiff = STIFF * h }
  local x, forces, total = {}, {}, 0
  for p, at in ipairs(c.particles) do
    x[2 * p - 1], x[2 * p] = at[1], at[2]
    m.size = math.max(m.size, at[1])
    m.held[p] = math.abs(at[2]) < 1e-9 * h
  end
  for i, e in ipairs(c.elements) do
    local rest = {}
    for a, p in ipairs(e.particles) do
      local at = c.particles[p]
      rest[3 * a - 2], rest[3 * a - 1], rest[3 * a] = at[1], at[2], e.slices[a] * h
    end
    m.elements[i] = { particles = e.particles, rest = rest }
  end
  local done, force = 0, nil
  for i, approach in ipairs(approaches) do
    local steps = math.ceil((approach - done) / (per_step or 0.025) - 1e-9)
    for k = 1, steps do
      local iterations
      m.plate = m.size * (1 - done - (approach - done) * k / steps)
      x, force, iterations = settle(m, x)
      total = total + iterations
    end
    done = approach
    forces[i] = force / h / m.size
  end
  return forces, x, total
end

return plates
