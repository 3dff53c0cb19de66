-- SPDX-License-Identifier: GPL-3.0-or-later
--- Points of a hanging wire, measured or from a photograph: they determine EI over the weight.
-- @module softworld.calibration.sag
local checks = require "softworld.checks"
local fitdata = require "softworld.study.fitdata"
local plane = require "softworld.calibration.plane"
local readings = require "softworld.calibration.readings"
local rows = require "softworld.rows"
local sagged = require "softworld.calibration.sagged"

local sag = { name = "sag" }

--- Standard deviation of the angles of a cantilever's picture and of its clamp without `directions` [rad].
sag.LEVEL = math.rad(3)

local WHAT = "sw.calibration: sag"
local LEAST, MOST = fitdata.LEAST_SIGMA, fitdata.MOST_SIGMA
local FARTHEST = 1.05 -- farthest point from the wire's start over its length
local FREE = 4 -- least number of points with which the angles of a cantilever are fitted
local BEHIND = 0.05 -- mean distance of points behind a cantilever's clamp, over its length [-]
local SOFTEST, STIFFEST = 1e5, 1e-3 -- range of weight length^3 / EI that is searched [-]

sag.rows = rows.list{
  { "file", "text", "-", "CSV with columns x [mm], z [mm], or u [px], v [px] with pixels" },
  { "points", "list of {x, z}", "m", "instead of a file; of pixels {u, v} [px]" },
  { "pixels", "list of {u, v, x, z}", "-", "four or more known points: in the picture [px] and in the "
    .. "plane [m]" },
  { "ends", "choice", "-", "how it is held", choices = { "clamped", "hung", "cantilever" },
    default = "clamped" },
  { "length", "number or {value, sigma =}", "m", "of the wire between its ends; or { value, sigma = }",
    required = true },
  { "from", "{x, z}", "m", "where the wire begins", usual = "{0, 0}" },
  { "to", "{x, z}", "m", "where it ends; not of a cantilever" },
  { "directions", "list of {x, z}", "-", "along the wire at clamps", usual = "level, along x" },
  { "sigma", "number", "m", "standard deviation of a point across the wire", min = LEAST, max = MOST,
    usual = "estimated" },
  { "pixel_sigma", "number", "px", "the same of pixels", min = LEAST, max = MOST },
}

local function fail(text, ...) error((WHAT .. ": " .. text):format(...), 0) end

local function pair(name, value, unit)
  local x, z = checks.field(value, 1), checks.field(value, 2)
  if type(value) == "table" then checks.only(("%s: %s"):format(WHAT, name), value, nil, 0) end
  for _, v in ipairs { x or "nothing", z or "nothing" } do
    if type(v) ~= "number" or v - v ~= 0 then
      fail("%s must be { x, z }%s, two finite numbers in the plane, z upwards; got %s", name, unit,
        checks.got(type(value) == "table" and v or value))
    end
  end
  if type(value) == "table" and checks.field(value, 3) ~= nil then
    fail("%s must be { x, z }: in the plane, without y", name)
  end
  return { x, z }
end

local function directions(o)
  local list, given = {}, o.directions
  if given ~= nil and type(given) ~= "table" then
    fail("directions must be a list of one { x, z } for each clamp, got %s", checks.got(given))
  end
  if given then checks.only(WHAT .. ": directions", given, nil, 0) end
  for k = 1, 2 do
    local d = given and given[k]
    local level = { (o.to and o.to[1] < o.from[1]) and -1 or 1, 0 }
    list[k] = d == nil and level or pair(("directions[%d]"):format(k), d, "")
    if list[k][1] == 0 and list[k][2] == 0 then fail("directions[%d] is {0, 0}, no direction", k) end
  end
  return list
end

-- Returns a vector turned by an angle, anticlockwise [rad].
local function turned(d, angle)
  local c, s = math.cos(angle), math.sin(angle)
  return { d[1] * c - d[2] * s, d[1] * s + d[2] * c }
end

local function ends(o)
  o.from = pair("from", o.from == nil and { 0, 0 } or o.from, " [m]")
  if o.ends == "cantilever" then
    if o.to ~= nil then fail "a cantilever has a free end: to does not go with it" end
  else
    if o.to == nil then fail("to is required: { x, z } [m], where the wire's far end is held") end
    o.to = pair("to", o.to, " [m]")
    local chord = math.sqrt((o.to[1] - o.from[1]) ^ 2 + (o.to[2] - o.from[2]) ^ 2)
    if chord == 0 then fail "from and to are the same place" end
    if o.length.value <= chord then
      fail("length = %.6g m is not allowed; it must be above %.6g m, the distance of its ends, for it to sag",
        o.length.value, chord)
    end
  end
  o.directions = directions(o)
end

-- Returns pixels as points of the plane, and the sigma of each.
local function from_pixels(o, list)
  local map, sigma = plane.map(WHAT, o.pixels), {}
  for k, p in ipairs(list) do
    local x, z, below = map(p[1], p[2])
    if below <= 0 then fail("%s lies beyond the horizon of the plane's picture", list.where(k)) end
    sigma[k] = o.pixel_sigma and o.pixel_sigma * plane.scale(map, p[1], p[2])
    list[k] = { x, z, p[1], p[2] }
  end
  return o.pixel_sigma and sigma or nil
end

local function read_points(o)
  local pixels = o.pixels ~= nil
  local columns = pixels and { { name = "u", unit = "px" }, { name = "v", unit = "px" } }
    or { { name = "x", unit = "m" }, { name = "z", unit = "m" } }
  local list = readings.read(WHAT, o, columns, 1)
  if o.pixel_sigma and (not pixels or o.sigma) then
    fail(pixels and "give sigma [m] or pixel_sigma [px], not both"
      or "pixel_sigma goes with pixels only; sigma is in m")
  end
  o.sigma = pixels and from_pixels(o, list) or o.sigma
  for k, p in ipairs(list) do
    local far = math.sqrt((p[1] - o.from[1]) ^ 2 + (p[2] - o.from[2]) ^ 2)
    if far > FARTHEST * o.length.value then
      fail("%s: {%.4g, %.4g} is %.4g m from where the wire begins, which is %.4g m long; are units and "
        .. "pixels right?", list.where(k), p[1], p[2], far, o.length.value)
    end
  end
  return list
end

-- Raises an error if the points of a cantilever that points along x lie on its other side.
local function refuse_mirrored(o, points)
  local ahead = 0
  for _, p in ipairs(points) do ahead = ahead + (p[1] - o.from[1]) / #points end
  if ahead > -BEHIND * o.length.value then return end
  fail("the points lie at x < %.4g m, behind the clamp, from which the wire points along x; is x mirrored? A "
    .. "wire that points along -x has directions = { { -1, 0 } }", o.from[1])
end

--- Reads the sag: a group { name =, sigma =, unit =, values = zeros (distances of the points from the wire),
-- predict(p) -> list, source =, EI = its range, points =, length =, curve(p) }; EA_measured is to be set if
-- EA is measured too; turns: the angles p.turn of the picture and
-- p.tilt of the clamp count, and have this standard deviation [rad]. radius [m], mass [kg/m].
function sag.read(o, radius, mass)
  local level = o.ends == "cantilever" and o.directions == nil
  ends(o)
  o.radius = radius
  local points = read_points(o)
  if level then refuse_mirrored(o, points) end
  local size = 9.81 * mass * o.length.value ^ 3
  local group = { name = "sag", sigma = o.sigma, unit = "m", values = {}, points = points, options = o,
    length = o.length, level = level, turns = level and #points >= FREE and sag.LEVEL,
    source = ("sag of %d points"):format(#points), EI = { size / SOFTEST, size / STIFFEST } }
  for k = 1, #points do group.values[k] = 0 end
  local key, kept
  -- Without a measured EA: no cable is stiffer in bending than a solid bar of its radius, EI = EA r^2 / 4.
  local function EA_of(p)
    return group.EA_measured and p.EA or math.max(p.EA, 4 * p.EI / radius ^ 2)
  end
  --- Returns the stations of the wire; the last ones are kept, because GJ and the like do not change them.
  function group.curve(p)
    local tilt = group.turns and p.tilt or 0
    local now = ("%a %a %a %a %a"):format(p.EI, p.EA, p.mass_per_length, p.length, tilt)
    if now ~= key then
      local at = setmetatable({ length = p.length }, { __index = o })
      if group.turns then at.directions = { turned(o.directions[1], tilt) } end
      key, kept = now, sagged.curve(at, p.EI, EA_of(p), p.mass_per_length)
    end
    return kept
  end
  --- Returns a place of the picture turned about the wire's start, anticlockwise [rad].
  function group.about(at, angle)
    local d = turned({ at[1] - o.from[1], at[2] - o.from[2] }, angle)
    return { o.from[1] + d[1], o.from[2] + d[2] }
  end
  function group.predict(p)
    local curve, beside = group.curve(p), {}
    for k, point in ipairs(points) do
      beside[k] = sagged.beside(curve, group.turns and group.about(point, -p.turn) or point)
    end
    return beside
  end
  return group
end

return sag
