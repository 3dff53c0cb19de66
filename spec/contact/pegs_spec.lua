-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pegs and rings are often thinner than the wire's edges are long. The wire meets them with its smooth
-- curve, so no place along an edge holds better than another.
local vec = require "softworld.vec"
local drawing = require "contact.drawn"

local H = drawing.H
local WIRE = 0.0005 -- the wire's radius [m]

local flat = { axis = { 1, 0, 0 }, angle = math.pi / 2 }
local function rod(shape, r)
  return { shape = shape, radius = r, length = 1, at = { 0, 0, -r }, rotation = flat }
end
local shapes = {
  cylinder = function(r) return rod("cylinder", r) end,
  capsule = function(r) return rod("capsule", r) end,
  -- the wire lies in the hole, on the lowest point of the tube
  ring = function(r)
    return { shape = "torus", radius = 0.2, tube = r, at = { 0, 0, 0.2 - r },
      rotation = { axis = { 0, 1, 0 }, angle = math.pi / 2 } }
  end,
}

local function drawn(o)
  o.round = o.radius
  return drawing.pull(o, WIRE, function(scene, see)
    local peg = shapes[o.shape or "cylinder"](o.radius)
    peg.at, peg.friction = see(peg.at), o.mu or 0
    local turn = vec.turn(peg.rotation.axis, peg.rotation.angle)
    peg.rotation = vec.multiply(o.turn or { 1, 0, 0, 0 }, turn)
    scene:obstacle(peg)
  end)
end

local function check(o, bound)
  o.angle, o.radius = math.rad(o.angle or 90), o.part * H
  local least, mean, most = drawn(o)
  local text = ("%.4f to %.4f of the pull, mean %.4f"):format(least, most, mean)
  print("measured: " .. text)
  local off = math.max(0.002, 0.4 * bound) -- allowed error of the mean
  assert.is_true(math.abs(mean - 1) < off and least > 1 - bound and most < 1 + bound, text)
end

describe("a thin peg (without friction unless mu is given)", function()
  -- Cases: T h^2/EI, radius over edge length. With chords the pull swings by 10 to 15 % at T h^2/EI = 0.05,
  -- by 15 to 47 % at 0.5, and by 11 to 96 % at 2.
  for _, case in ipairs{ { 0.05, 0.1 }, { 0.05, 0.3 }, { 0.05, 0.5 }, { 0.05, 0.8 } } do
    it(("lets a stiff wire slide: T h^2/EI %g, radius of %g edges"):format(case[1], case[2]), function()
      check({ taut = case[1], part = case[2] }, 0.01)
    end)
  end
  for _, case in ipairs{ { 0.5, 0.1 }, { 0.5, 0.5 }, { 0.5, 0.8 }, { 2, 0.1 }, { 2, 0.5 }, { 2, 0.8 } } do
    it(("lets a taut wire slide: T h^2/EI %g, radius of %g edges"):format(case[1], case[2]), function()
      check({ taut = case[1], part = case[2] }, 0.1)
    end)
  end
  -- Thicker pegs, as long as the wire does not wrap round them. With chords the pull swings by 5 to 16 % at
  -- 0.05, by 17 to 21 % at 0.5, and by 4 to 6 % at 2 and 30 degrees.
  for _, case in ipairs{ { 0.05, 1 }, { 0.05, 1.5 }, { 0.05, 2 }, { 0.05, 3.5 }, { 0.5, 1 }, { 0.5, 1.2 } } do
    it(("lets a wire slide if thicker: T h^2/EI %g, radius of %g edges"):format(case[1], case[2]), function()
      check({ taut = case[1], part = case[2] }, 0.005)
    end)
  end
  for _, part in ipairs{ 1, 1.5, 2 } do
    it(("lets a wire slide if thicker, at a small angle: radius of %g edges"):format(part), function()
      check({ taut = 2, part = part, angle = 30 }, 0.01)
    end)
  end
  -- Pegs thicker than four edges, as long as the wire does not begin to wrap. With chords the pull swings
  -- by 0.5 to 0.7 %, and steps chosen by tolerance follow each blow: 12 times as many iterations with edges
  -- of R/10.
  for _, part in ipairs{ 5, 6, 8 } do
    it(("lets a wire slide if it only leans on it: radius of %g edges"):format(part), function()
      check({ taut = 0.05, part = part, angle = 20 }, 0.002)
    end)
  end
  for name, o in pairs{
    ["a capsule"] = { shape = "capsule" }, ["a ring"] = { shape = "ring" },
    ["steps of 10 ms"] = { dt = 0.01, bound = 0.05 }, ["steps of 0.5 ms"] = { dt = 0.0005 },
    ["a small angle"] = { angle = 30 }, ["the other end"] = { swap = true },
    ["all turned"] = { turn = vec.turn({ 0.6, 0, 0.8 }, 1.1) },
    ["the mesh shifted"] = { fine = 41 / 40 },
  } do
    it("lets a wire slide: " .. name, function()
      o.taut, o.part = 0.2, 0.7
      check(o, o.bound or 0.03)
    end)
  end

  -- A stiff wire touches in one place, so friction there does not depend on the edges.
  for _, mu in ipairs{ 0.1, 0.3 } do
    it("has the same friction on coarse and fine edges: mu " .. mu, function()
      local function pull(fine)
        local _, mean = drawn{ taut = 0.05, angle = math.rad(60), radius = 0.5 * H, mu = mu, fine = fine }
        return mean
      end
      local coarse, fine = pull(1), pull(4)
      print(("measured: pulls %.4f and %.4f"):format(coarse, fine))
      assert.is_true(coarse > 1 + mu and math.abs(coarse / fine - 1) < 0.005, coarse .. " and " .. fine)
    end)
  end
end)
