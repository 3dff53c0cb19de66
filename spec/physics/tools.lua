-- SPDX-License-Identifier: GPL-3.0-or-later
-- Shared by the physics specs: comparisons that print their figures, orders, momentum.
local vec = require "softworld.vec"

local tools = {}

-- With scripts/spec.lua --measured, figures are printed, not only compared.
local told = os.getenv "SOFTWORLD_MEASURED"
local function measured(format, ...)
  if told then print("measured: " .. format:format(...)) end
end

-- Raises the error at level 3: at the line of the spec that asked.
local function check(good, format, ...)
  if not good then error(format:format(...), 3) end
end

--- Checks |actual - expected| <= tolerance; an error states the numbers.
function tools.near(expected, actual, tolerance, what)
  local off = math.abs(actual - expected)
  measured("%s: %.6g, %.2g off, allowed %.2g", what or "value", actual, off, tolerance)
  check(off <= tolerance, "%s: expected %.10g, got %.10g: %.3g off, allowed %.3g",
    what or "value", expected, actual, off, tolerance)
end

--- The same, relative to the expected value.
function tools.share(expected, actual, tolerance, what)
  local off = math.abs(actual / expected - 1)
  measured("%s: %.6g, %.2g of it off, allowed %.2g", what or "value", actual, off, tolerance)
  check(off <= tolerance, "%s: expected %.10g, got %.10g: %.3g of it off, allowed %.3g",
    what or "value", expected, actual, off, tolerance)
end

function tools.below(limit, value, what)
  measured("%s: %.4g, allowed %.4g", what or "value", value, limit)
  check(value <= limit, "%s is %.4g, allowed %.4g", what or "value", value, limit)
end

function tools.above(limit, value, what)
  measured("%s: %.4g, wanted %.4g", what or "value", value, limit)
  check(value >= limit, "%s is %.4g, wanted %.4g", what or "value", value, limit)
end

--- Checks that a settle or run went well, and returns it.
function tools.fine(result)
  check(result.ok, "%s", result.reason)
  return result
end

--- Checks that the values of make(dt), by name, are at these steps within limits of those at the fine one.
function tools.same_at(dts, make, fine, limits)
  local exact = make(fine)
  for _, dt in ipairs(dts) do
    local got = make(dt)
    for key, limit in pairs(limits) do
      tools.share(exact[key], got[key], limit, ("%s at %g ms"):format(key, 1e3 * dt))
    end
  end
end

--- Returns the slope of -log(error(n)) over log(n) by least squares, and the errors as text.
function tools.order(numbers, error_of)
  local sx, sy, sxx, sxy, k, list = 0, 0, 0, 0, #numbers, {}
  for i, n in ipairs(numbers) do
    local e = error_of(n)
    local x, y = math.log(n), math.log(e)
    sx, sy, sxx, sxy = sx + x, sy + y, sxx + x * x, sxy + x * y
    list[i] = ("%g: %.3g"):format(n, e)
  end
  return -(k * sxy - sx * sy) / (k * sxx - sx * sx), table.concat(list, ", ")
end

--- Checks that the order is at least this.
function tools.order_at_least(least, numbers, error_of, what)
  local slope, list = tools.order(numbers, error_of)
  check(slope >= least, "%s: order %.2f, wanted %.2f (%s)", what or "error", slope, least, list)
  return slope
end

function tools.distance(a, b)
  return ((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2) ^ 0.5
end

function tools.norm(a) return (a[1] ^ 2 + a[2] ^ 2 + a[3] ^ 2) ^ 0.5 end

function tools.cross(a, b)
  return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

-- Calls visit(mass, x, v) for points that carry the wire's momentum exactly: two Gauss
-- points per edge of linear positions and velocities.
local function material(wire, visit)
  local x, s = wire:positions()
  local v, m = wire:velocities(), wire.beam.mass_per_length
  for i = 1, #s - 1 do
    for _, f in ipairs{ 0.5 - 0.5 / 3 ^ 0.5, 0.5 + 0.5 / 3 ^ 0.5 } do
      local p, q = {}, {}
      for k = 1, 3 do
        p[k] = x[3 * i - 3 + k] * (1 - f) + x[3 * i + k] * f
        q[k] = v[3 * i - 3 + k] * (1 - f) + v[3 * i + k] * f
      end
      visit(0.5 * m * (s[i + 1] - s[i]), p, q)
    end
  end
end

--- Returns momentum [N s] and angular momentum about the origin [N m s] of a wire.
function tools.momentum(wire)
  local p, l = { 0, 0, 0 }, { 0, 0, 0 }
  material(wire, function(m, x, v)
    local c = tools.cross(x, v)
    for k = 1, 3 do p[k], l[k] = p[k] + m * v[k], l[k] + m * c[k] end
  end)
  return p, l
end

--- Returns a source of numbers in [-1, 1], the same on every machine.
function tools.random(seed)
  local state = seed
  return function()
    state = state * 6364136223846793005 + 1442695040888963407
    return ((state >> 11) & 0x1fffffffffffff) / 0x10000000000000 - 1
  end
end

--- Returns a source of numbers in [0, 1], and one of members of a list. skip: numbers to leave out first.
function tools.choices(seed, skip)
  local draw = tools.random(seed)
  for _ = 1, skip or 0 do draw() end
  local function random() return (draw() + 1) / 2 end
  return random, function(list) return list[math.min(#list, 1 + math.floor(random() * #list))] end
end

--- Returns a random unit quaternion.
function tools.turn(random)
  local q, n
  repeat
    q = { random(), random(), random(), random() }
    n = (q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2 + q[4] ^ 2) ^ 0.5
  until n > 0.1 and n < 1
  return { q[1] / n, q[2] / n, q[3] / n, q[4] / n }
end

--- Turns a vector about {1, 2, 2}/3 by an angle [rad]; nil: not at all.
function tools.turned(p, angle)
  if not angle then return p end
  local s = math.sin(angle / 2) / 3
  return vec.rotate({ math.cos(angle / 2), s, 2 * s, 2 * s }, p)
end

--- Makes a damped wire: a cable of the catalogue, or "soft". more: { segments =, mass =, stiffness = }, the
-- last two of the damping [1/s], [s].
function tools.damped(scene, cable, from, to, more)
  local o = { from = from, to = to, segments = more.segments }
  if cable == "soft" then o.E, o.density, o.radius = 5e6, 1500, 0.0025 else o.cable = cable end
  local wire = scene:wire(o)
  scene:force{ kind = "damping", on = wire, mass = more.mass or 1, stiffness = more.stiffness or 1e-3 }
  return wire
end

--- Returns the largest difference of two flat lists.
function tools.largest_difference(a, b)
  local most = 0
  for i = 1, math.max(#a, #b) do most = math.max(most, math.abs(a[i] - b[i])) end
  return most
end

--- For a wire lifted by a gripper near its end, at a place s outside the pads: returns the moment there with
-- what hangs beyond, and the moment due by M^2 / (2 EI) = w y - V sin theta, y above the lying wire.
function tools.lifted(g, wire, s, w, EI)
  local L, x, slope = wire.length, wire:position(s), wire:tangent(s)[3]
  local y = x[3] - wire:position(L / 5)[3]
  local V, M, n = g:force()[3] - w * (L - s), g:moment{ at = x }[2], 40
  for k = 1, n do -- weight of the part between there and the end
    M = M + w * (L - s) / n * (wire:position(s + (L - s) * (k - 0.5) / n)[1] - x[1])
  end
  return M, (2 * EI * (w * y - V * slope)) ^ 0.5
end

--- Returns the largest size of the numbers in a list.
function tools.largest(list)
  local most = 0
  for _, value in ipairs(list) do most = math.max(most, math.abs(value)) end
  return most
end

--- Returns the events of a run of this kind.
function tools.events(run, kind)
  local list = {}
  for _, e in ipairs(run.events) do
    if e.kind == kind then list[#list + 1] = e end
  end
  return list
end

return tools
