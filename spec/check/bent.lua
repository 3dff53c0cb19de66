-- SPDX-License-Identifier: GPL-3.0-or-later
local sw = require "softworld"

local L, RADIUS = 0.1, require "spec.check.capstan".RADIUS

-- Product of two rotations { w, x, y, z }; one about z [rad]; a point turned about z.
local function times(a, b)
  return { a[1] * b[1] - a[2] * b[2] - a[3] * b[3] - a[4] * b[4],
    a[1] * b[2] + a[2] * b[1] + a[3] * b[4] - a[4] * b[3],
    a[1] * b[3] - a[2] * b[4] + a[3] * b[1] + a[4] * b[2],
    a[1] * b[4] + a[2] * b[3] - a[3] * b[2] + a[4] * b[1] }
end
local function about_z(angle) return { math.cos(angle / 2), 0, 0, math.sin(angle / 2) } end
local function turned(p, angle)
  local c, s = math.cos(angle), math.sin(angle)
  return { c * p[1] - s * p[2], s * p[1] + c * p[2], p[3] }
end

-- Returns a function that runs a wire between two clamps, which follow a circle of curvature k(t). turn(t,
-- s): rotation of the section at s about the wire. how: plain = true: the wire has only its ends, unless
-- wire_options gives more; changes = { { time, arguments of remodel }, ... }; about = [rad] by which the
-- whole scene is turned about z; swapped = true: start and end of the wire change places.
return function(k, turn, run_options, wire_options, how)
  how = how or {}
  local about = how.about or 0
  local scene = sw.scene{ gravity = { 0, 0, 0 } }
  local given = how.plain and { name = "w" } or { name = "w", EA = 1e4, EI = 1e-3, GJ = 1e-3,
    mass_per_length = 0.02, radius = RADIUS, segments = 40 }
  given.from, given.to = { 0, 0, 0 }, turned({ L, 0, 0 }, about)
  if how.swapped then given.from, given.to = given.to, given.from end
  for key, value in pairs(wire_options or {}) do given[key] = value end
  local wire = scene:wire(given)
  turn = turn or function() return 0 end
  -- the rotation: first about the undeformed wire, then in the plane of the circle
  local function rotation(roll, angle)
    local a, b, c, d = math.cos(roll / 2), math.sin(roll / 2), math.cos(angle / 2), math.sin(-angle / 2)
    return times(about_z(about), times({ a * c, b * c, a * d, -b * d }, about_z(-about)))
  end
  local function place(s)
    return function(t)
      local angle = k(t) * s
      local r = math.abs(angle) > 1e-9 and s / angle
      return turned(r and { r * math.sin(angle), 0, r * (1 - math.cos(angle)) } or { s, 0, 0 }, about),
        rotation(turn(t, s), angle)
    end
  end
  for _, s in ipairs{ 0, L } do
    scene:clamp(wire, { s = how.swapped and L - s or s }):follow{ duration = 4, func = place(s) }
  end
  if how.changes then
    scene:process(function(p)
      local t = 0
      for _, change in ipairs(how.changes) do
        p:wait(change[1] - t)
        t = change[1]
        wire:remodel(change[2])
      end
      p:wait(4 - t)
    end)
  end
  local options = { duration = not how.changes and 4 or nil, dt = 0.02, quasistatic = true, wear = true,
    frame = 4 }
  for key, value in pairs(run_options or {}) do options[key] = value end
  return scene:run(options), scene, wire
end
