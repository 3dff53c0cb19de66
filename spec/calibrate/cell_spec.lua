-- SPDX-License-Identifier: GPL-3.0-or-later
-- calibrate.cell, the beam stiffness of an endless mesh of springs: against formulas, and against itself
-- turned, moved, scaled and cut into other slices.
local sw = require "softworld"
local tools = require "physics.tools"
local near, share = tools.near, tools.share
local cell = sw.calibrate.cell

-- A tube without core: M particles at R = 1, spacing h, springs k = { l =, d =, h = }.
local function tube(M, h, k, reach)
  local args = { spacing = h, particles = {}, links = {}, stiffness = k }
  local function link(from, to, slices, group)
    args.links[#args.links + 1] = { from = from, to = to, slices = slices, group = group }
  end
  for i = 1, M do
    local angle, j = 2 * math.pi * (i - 1) / M, (i - 1 + (reach or 1)) % M + 1
    args.particles[i] = { math.cos(angle), math.sin(angle), 0 }
    link(i, i, 1, "l")
    link(i, j, 1, "d")
    link(j, i, 1, "d")
    link(i, i % M + 1, 0, "h")
  end
  return args
end

-- A random mesh: n particles, each linked along its line, to others of its slice and of the next two.
local function random_mesh(n, seed)
  math.randomseed(seed)
  local args = { spacing = 0.7, particles = {}, links = {}, stiffness = { a = 3, b = 0.5, c = 11 } }
  for i = 1, n do
    args.particles[i] = { math.random() - 0.5, math.random() - 0.5, 0.3 * math.random() }
  end
  for i = 1, n do
    args.links[#args.links + 1] = { from = i, to = i, slices = 1, group = "a" }
    for j = 1, n do
      for slices = 0, 2 do
        if i ~= j and math.random() < 0.6 then
          args.links[#args.links + 1] = { from = i, to = j, slices = slices,
            group = math.random() < 0.5 and "b" or "c", weight = 0.2 + math.random() }
        end
      end
    end
  end
  return args
end

-- Checks that two 4 x 4 matrices agree within a share of their largest entry.
local function same(expected, actual, tolerance, what)
  local largest = 0
  for i = 1, 4 do
    for j = 1, 4 do largest = math.max(largest, math.abs(expected[i][j])) end
  end
  for i = 1, 4 do
    for j = 1, 4 do
      near(expected[i][j], actual[i][j], tolerance * largest, ("%s, row %d, column %d"):format(what, i, j))
    end
  end
end

local function copy(args)
  local out = { spacing = args.spacing, particles = {}, links = {}, stiffness = args.stiffness }
  for i, p in ipairs(args.particles) do out.particles[i] = { p[1], p[2], p[3] } end
  for i, l in ipairs(args.links) do
    out.links[i] = { from = l.from, to = l.to, slices = l.slices, group = l.group, weight = l.weight }
  end
  return out
end

describe("calibrate.cell", function()
  it("has the stiffness of a bundle of loose lines", function()
    local h, k = 0.3, { l1 = 5, l2 = 2, l3 = 0.7 }
    local at = { { 0.4, 0.1, 0 }, { -0.2, 0.5, 0.1 }, { 0.1, -0.6, 0 } }
    local links, EA, EI, EI2, skew, x_moment, y_moment = {}, 0, 0, 0, 0, 0, 0
    for i, p in ipairs(at) do
      local kh = k["l" .. i] * h
      links[i] = { from = i, to = i, slices = 1, group = "l" .. i }
      EA, EI, EI2, skew = EA + kh, EI + kh * p[1] ^ 2, EI2 + kh * p[2] ^ 2, skew - kh * p[1] * p[2]
      x_moment, y_moment = x_moment - kh * p[1], y_moment + kh * p[2]
    end
    local b = cell { spacing = h, particles = at, links = links, stiffness = k }
    share(EA, b.EA, 1e-13)
    share(EI, b.EI, 1e-13)
    share(EI2, b.EI2, 1e-13)
    near(0, b.GJ, 1e-15)
    share(skew, b.matrix[2][3], 1e-13)
    share(y_moment, b.matrix[1][2], 1e-13)
    share(x_moment, b.matrix[1][3], 1e-13)
    near(0, b.squeeze, 0, "lines that nothing holds")
  end)

  it("resists twist with GJ = 2 M k h R^4 sin^2(2 pi m/M)/l^2 by its diagonals, exactly", function()
    for _, M in ipairs { 3, 4, 5, 8, 12, 17 } do
      for _, h in ipairs { 0.2, 0.7, 3 } do
        for reach = 1, math.min(3, (M - 1) // 2) do
          local k = { l = 1, d = 0.3, h = 0.2 }
          local length2 = h ^ 2 + 4 * math.sin(math.pi * reach / M) ^ 2
          share(2 * M * k.d * h * math.sin(2 * math.pi * reach / M) ^ 2 / length2,
            cell(tube(M, h, k, reach)).GJ, 1e-12, ("M = %d, reach %d"):format(M, reach))
        end
      end
    end
  end)

  -- Stretched by e, the ring shrinks by n e. With a = 2 k_d/l^2 and the chord c, EA h/M = k_l h^2 + a (h^2
  -- - c^2 n)^2 + k_h c^2 n^2, which is least at n = a h^2/(a c^2 + k_h).
  it("has the EA of a ring that may shrink, exactly", function()
    for _, M in ipairs { 3, 6, 8, 13 } do
      for _, hoop in ipairs { 1e-6, 0.3, 5, 1e6 } do
        local h, k = 0.8, { l = 1, d = 0.6, h = hoop }
        local c2 = 4 * math.sin(math.pi / M) ^ 2
        local a = 2 * k.d / (h ^ 2 + c2)
        local n = a * h ^ 2 / (a * c2 + hoop)
        share(M / h * (k.l * h ^ 2 + a * (h ^ 2 - c2 * n) ^ 2 + hoop * c2 * n ^ 2),
          cell(tube(M, h, k)).EA, 1e-11, ("M = %d, hoop %g"):format(M, hoop))
      end
    end
  end)

  it("has an EI below that of rigid sections, and equal about any axis", function()
    for _, M in ipairs { 6, 8, 12 } do
      for _, h in ipairs { 0.4, 0.7, 1 } do
        for _, d in ipairs { 0.2, 1 } do
          local k = { l = 1, d = d, h = 1 }
          local b = cell(tube(M, h, k))
          local length2 = h ^ 2 + 4 * math.sin(math.pi / M) ^ 2
          local stiff = M / 2 * h * (k.l + 2 * d * h ^ 2 / length2)
          tools.below(0.99, b.EI / stiff, "EI of the formula")
          tools.above(0.68, b.EI / stiff, "EI of the formula")
          share(b.EI, b.EI2, 1e-12)
          near(0, b.matrix[2][3], 1e-12 * b.EI)
          near(0, b.matrix[1][4], 1e-12 * b.EA, "two kinds of diagonals do not couple pull and twist")
        end
      end
    end
    local one_way = tube(8, 0.7, { l = 1, d = 0.2, h = 1 }) -- like a rope
    for i = #one_way.links, 1, -1 do
      local l = one_way.links[i]
      if l.group == "d" and l.to == l.from % 8 + 1 then table.remove(one_way.links, i) end
    end
    tools.above(0.01, math.abs(cell(one_way).matrix[1][4]), "coupling of one kind of diagonals")
  end)

  it("includes springs against bending", function()
    local b = cell { spacing = 0.25, particles = { { 0, 0, 0 } }, stiffness = { l = 8, b = 3 },
      links = { { from = 1, to = 1, slices = 1, group = "l" },
        { from = 1, to = 1, slices = 1, group = "b", bend = true, weight = 2 } } }
    share(2, b.EA, 1e-14)
    share(2 * 3 * 0.25, b.EI, 1e-14)
    share(2 * 3 * 0.25, b.EI2, 1e-14)
  end)

  it("has the squeeze stiffness of springs in series and in parallel", function()
    local at = { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } }
    local links = { { from = 1, to = 2, group = "a" }, { from = 2, to = 3, group = "b" } }
    local args = { spacing = 0.5, particles = at, links = links, stiffness = { a = 3, b = 6 } }
    share(2 / 0.5, cell(args).squeeze, 1e-12) -- 1/(1/3 + 1/6) per length
    links[3] = { from = 1, to = 3, group = "a", weight = 4 }
    share(14 / 0.5, cell(args).squeeze, 1e-12)
    local ring = tube(8, 0.7, { l = 1, d = 0.3, h = 1 })
    near(0, cell(ring).squeeze, 0, "a ring of hinged bars")
    for i = 1, 8 do ring.links[#ring.links + 1] = { from = i, to = (i + 1) % 8 + 1, group = "h" } end
    tools.above(0.01, cell(ring).squeeze, "the ring with chords")
  end)
end)

describe("calibrate.cell of any mesh", function()
  it("turns with the mesh as a tensor", function()
    for seed = 1, 4 do
      local args = random_mesh(5, seed)
      local S = cell(args).matrix
      for _, angle in ipairs { 0.3, math.pi / 2, 4 } do
        local c, s = math.cos(angle), math.sin(angle)
        local turned, T = copy(args), { { 1, 0, 0, 0 }, { 0, c, -s, 0 }, { 0, s, c, 0 }, { 0, 0, 0, 1 } }
        for _, p in ipairs(turned.particles) do p[1], p[2] = c * p[1] - s * p[2], s * p[1] + c * p[2] end
        local expected = {}
        for i = 1, 4 do
          expected[i] = {}
          for j = 1, 4 do
            local sum = 0
            for m = 1, 4 do
              for n = 1, 4 do sum = sum + T[i][m] * S[m][n] * T[j][n] end
            end
            expected[i][j] = sum
          end
        end
        same(expected, cell(turned).matrix, 1e-10, "turned by " .. angle)
      end
    end
  end)

  it("does not depend on where a slice begins", function()
    for seed = 1, 4 do
      local args = random_mesh(5, seed)
      local S, moved = cell(args).matrix, copy(args)
      for _, p in ipairs(moved.particles) do p[3] = p[3] + 0.234 end
      same(S, cell(moved).matrix, 1e-10, "moved along")
      -- particle 2 is now the one of the next slice
      moved.particles[2][3] = moved.particles[2][3] + moved.spacing
      for _, l in ipairs(moved.links) do
        local slices = l.slices + (l.from == 2 and 1 or 0) - (l.to == 2 and 1 or 0)
        if slices < 0 then l.from, l.to, slices = l.to, l.from, -slices end
        l.slices = slices
      end
      same(S, cell(moved).matrix, 1e-10, "particle 2 of the next slice")
    end
  end)

  it("does not depend on how many slices are taken as one", function()
    for seed = 1, 4 do
      local args = random_mesh(4, seed)
      local n, double = #args.particles, copy(args)
      double.spacing, double.links = 2 * args.spacing, {}
      for i = 1, n do
        local p = args.particles[i]
        double.particles[n + i] = { p[1], p[2], p[3] + args.spacing }
      end
      for _, l in ipairs(args.links) do
        for half = 0, 1 do
          local far = half + l.slices
          double.links[#double.links + 1] = { from = l.from + half * n, to = l.to + far % 2 * n,
            slices = far // 2, group = l.group, weight = l.weight }
        end
      end
      same(cell(args).matrix, cell(double).matrix, 1e-10, "two slices")
    end
  end)

  it("scales with lengths and stiffness, and stiffens with every spring", function()
    local args = random_mesh(5, 9)
    local b, big = cell(args), copy(args)
    big.spacing = 10 * args.spacing
    for _, p in ipairs(big.particles) do
      for i = 1, 3 do p[i] = 10 * p[i] end
    end
    big.stiffness = { a = 6e5, b = 1e5, c = 22e5 }
    local c = cell(big)
    share(b.EA * 10 * 2e5, c.EA, 1e-10)
    share(b.EI * 1e3 * 2e5, c.EI, 1e-10)
    share(b.GJ * 1e3 * 2e5, c.GJ, 1e-10)
    for _, group in ipairs { "a", "b", "c" } do
      local more = copy(args)
      more.stiffness = { a = 3, b = 0.5, c = 11 }
      more.stiffness[group] = 1.1 * more.stiffness[group]
      local m = cell(more)
      for _, name in ipairs { "EA", "EI", "EI2", "GJ" } do
        tools.above(b[name], m[name], name)
        tools.below(1.1 * b[name] * (1 + 1e-12), m[name], name)
      end
    end
  end)

  it("bears springs of very different stiffness", function()
    -- hoops 1e7 times the rest: the formula for rings that may shrink, with n near 0
    local h, k = 0.8, { l = 1, d = 1e-5, h = 1e7 }
    local a = 2 * k.d / (h ^ 2 + 4 * math.sin(math.pi / 8) ^ 2)
    share(8 / h * (k.l * h ^ 2 + a * h ^ 4), cell(tube(8, h, k)).EA, 1e-9)
    share(2 * 8 * k.d * h * 0.5 * a / (2 * k.d), cell(tube(8, h, k)).GJ, 1e-9)
  end)
end)

describe("calibrate.cell refuses:", function()
  local function refused(change, text)
    local args = tube(4, 1, { l = 1, d = 1, h = 1 })
    change(args)
    local ok, message = pcall(cell, args)
    assert.is_false(ok)
    assert.is_truthy(message:find(text, 1, true), message)
    assert.is_truthy(message:find("cell_spec", 1, true), message)
  end

  it("wrong arguments", function()
    refused(function(a) a.spacing = 0 end, "spacing = 0 m must be above 0 m")
    refused(function(a) a.spacing = "1" end, "spacing must be a number, got string")
    refused(function(a) a.particles = nil end, "particles must be a table, got nil")
    refused(function(a) a.particles = {} end, "0 particles in a slice; allowed are 1 to 512")
    refused(function(a) a.particles[2][3] = 0 / 0 end, "particle 2 has a place that is not finite")
    refused(function(a) a.particles[2][3] = nil end, "particle 2, item 3, must be a number, got nil")
    refused(function(a) a.links[3].to = 9 end, "link 3 names a particle or group that does not exist")
    refused(function(a) a.links[3].group = "dd" end, "link 3: stiffness has no group 'dd'; did you mean 'd'?")
    refused(function(a) a.links[4].to = a.links[4].from end, "link 4 has no length")
    refused(function(a) a.links[4].weight = -1 end, "out of range")
    refused(function(a) a.stiffness.d = -1 end, "has a stiffness of -1 N/m; it must be at least 0")
    refused(function(a) a.stiffness.d = 1 / 0 end, "has a stiffness of inf N/m")
    refused(function(a) a.linsk = 1 end, "there is no parameter 'linsk'; did you mean 'links'?")
    assert.has_error(function() cell(3) end)
  end)
end)
