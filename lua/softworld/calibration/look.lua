-- SPDX-License-Identifier: GPL-3.0-or-later
--- Looks at the points of a sag before the fit: it compares them with computed wires over the range of EI.
-- This gives the fit its start, and finds points that no wire passes and points that tell nothing of EI.
-- @module softworld.calibration.look
local look = {}

local WHAT = "sw.calibration: sag"
local FAR = 16          -- sum of squares over the smallest one at which a scan ends [-]
local TELLS = 0.5       -- least change of all points over their sigma, between soft and stiff wires [-]
local FINE = 1e-6       -- sigma over the wire's length if none is given [-]
local SIGMAS, SHARE = 6, 0.002 -- least height above the chord: in sigma, and over the wire's length [-]
local NEARLY = 0.98     -- of that height: nearest computed wire [-]
local TURN = 0.01       -- of a picture, for differences [rad]
local TURNED = 3        -- angle to which a picture may be turned upwards, in its standard deviation [-]
local STEEP = 0.1       -- horizontal part of a chord below which nothing is above it [-]

local function fail(text, ...) error((WHAT .. ": " .. text):format(...), 0) end

local function sigma_of(group, k)
  return type(group.sigma) == "table" and group.sigma[k] or group.sigma
end

-- Computes the distances of the points from the wire with an EI. Returns true if they are far larger than the
-- smallest so far.
local function add(scan, EI)
  local group = scan.group
  local fine, list = pcall(group.predict, setmetatable({ EI = EI }, { __index = scan.p }))
  if not fine then
    scan.why = scan.why or list
    return false
  end
  local sum, along, lever = 0, 0, 0
  local turned = group.turns and group.predict(setmetatable({ EI = EI, turn = TURN }, { __index = scan.p }))
  for k, r in ipairs(list) do
    local sigma = sigma_of(group, k) or 1
    local rate = turned and (turned[k] - r) / sigma or 0
    sum, along, lever = sum + (r / sigma) ^ 2, along + rate * r / sigma, lever + rate ^ 2
  end
  if lever > 0 then sum = math.max(0, sum - along ^ 2 / lever) end -- the picture turned to fit best
  scan.lists[#scan.lists + 1] = list
  if sum < scan.least then scan.least, scan.best = sum, EI end
  return sum > FAR * scan.least + (group.sigma and FAR ^ 2 or 0)
end

-- Goes from soft to stiff in decades; unless `whole`, it stops behind a clear smallest sum of squares.
-- Returns { best = EI, least = sum, lists = distances from each computed wire }.
local function scanned(group, p, whole)
  local low, high = group.EI[1], group.EI[2]
  local count = math.ceil(math.log(high / low, 10) - 1e-9)
  local scan = { group = group, p = p, lists = {}, least = math.huge }
  for k = 0, count do
    if add(scan, low * (high / low) ^ (k / count)) and not whole then break end
  end
  if not scan.best then
    fail("no EI from %.3g to %.3g N m2 gives a wire at rest: %s", low, high, scan.why)
  end
  return scan
end

-- Returns the height of a point above the line through the ends, or above the direction of a cantilever [m],
-- and 1 if above is to the left of the wire, -1 if it is to the right; nil if the line is upright.
local function above(o, point)
  local d = o.ends == "cantilever" and o.directions[1] or { o.to[1] - o.from[1], o.to[2] - o.from[2] }
  local size = math.sqrt(d[1] ^ 2 + d[2] ^ 2)
  if math.abs(d[1]) < STEEP * size then return nil end
  local left = (d[1] * (point[2] - o.from[2]) - d[2] * (point[1] - o.from[1])) / size
  if d[1] < 0 then return -left, -1 end
  return left, 1
end

-- Returns the point that is highest above the chord and above all computed wires, and its height; nil without
-- one.
local function highest(group, lists)
  local o, worst, most = group.options, nil, 0
  for k, point in ipairs(group.points) do
    local high, up = above(o, point)
    local turned = (group.turns or 0) * TURNED * math.abs(point[1] - o.from[1]) -- height by a turned picture
    local least = math.max(SHARE * group.length.value, SIGMAS * (sigma_of(group, k) or 0), most)
    if high and high - turned > least then
      local nearest = math.huge
      for _, list in ipairs(lists) do nearest = math.min(nearest, up * list[k]) end
      if nearest >= NEARLY * high then worst, most = k, high end
    end
  end
  return worst, most
end

local function refuse_high(group, p, lists)
  if not highest(group, lists) then return end
  local k, high = highest(group, scanned(group, p, true).lists)
  if not k then return end
  local point = group.points[k]
  fail("%s: {%.4g, %.4g} lies %.3g m above the %s, and a wire with any EI from %.3g to %.3g N m2 hangs below "
    .. "it there; z points upwards: are the signs of z, from, to and directions right?",
    group.points.where(k), point[1], point[2], high, group.options.ends == "cantilever"
      and "clamp's direction" or "line between the ends", group.EI[1], group.EI[2])
end

-- Raises an error if the points are at the same distance from all computed wires.
local function refuse_mute(group, lists)
  local all, most, which = 0, -1, 1
  for k in ipairs(group.points) do
    local low, high = math.huge, -math.huge
    for _, list in ipairs(lists) do low, high = math.min(low, list[k]), math.max(high, list[k]) end
    all = all + ((high - low) / (sigma_of(group, k) or FINE * group.length.value)) ^ 2
    if high - low > most then most, which = high - low, k end
  end
  if math.sqrt(all) >= TELLS then return end
  local point = group.points[which]
  fail("the points tell nothing of EI: %s, {%.4g, %.4g}, would move most, by %.2g m between EI = %.3g and "
    .. "%.3g N m2; measure points away from the clamps, where the wire sags", group.points.where(which),
    point[1], point[2], most, group.EI[1], group.EI[2])
end

--- Returns an EI whose computed wire is near to the points of a sag. p: values of the other parameters.
-- Raises an error for points that no wire passes, and if they tell nothing of EI.
function look.at(group, p)
  local scan = scanned(group, p)
  refuse_mute(group, scan.lists)
  refuse_high(group, p, scan.lists)
  local middle = scan.best
  for _, times in ipairs { 10 ^ -0.5, 10 ^ 0.5 } do
    local EI = middle * times
    if EI > group.EI[1] and EI < group.EI[2] then add(scan, EI) end
  end
  return scan.best
end

return look
