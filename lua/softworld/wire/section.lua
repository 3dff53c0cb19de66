-- SPDX-License-Identifier: GPL-3.0-or-later
--- Sections of wires that are meshes of particles: shape, torsion, strain, contact pressure.
--
--     local section = wire:section(0.5)
--     print(section)                        -- widths, ovalisation, torsion, strains
--     print(section:width{ 0, 0, 1 })       -- between plates above and below [m]
--     for _, p in ipairs(wire:contact_pressure()) do print(p.s, p.pressure) end
--
-- @module softworld.wire.section
local checks = require "softworld.checks"
local core = require "softworld.core"
local build = require "softworld.scene.build"
local methods = require "softworld.methods"
local number = require "softworld.output.number"

local class = core.class
local Section = { __name = "section" }
Section.__index = Section

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

--- Returns the width between two planes across a direction; only its component across the wire counts.
-- @tparam {x,y,z} direction
-- @treturn number [m]
function Section:width(direction)
  local d, t = direction, self.tangent
  local numbers = type(checks.field(d, 1)) == "number" and type(checks.field(d, 2)) == "number"
    and type(checks.field(d, 3)) == "number"
  if not numbers then error("section:width: direction must be {x, y, z}, got " .. type(d), 2) end
  local along, size = dot(d, t), dot(d, d)
  local across = { d[1] - along * t[1], d[2] - along * t[2], d[3] - along * t[3] }
  local norm = dot(across, across) ^ 0.5
  if norm ~= norm or norm <= 1e-9 * size ^ 0.5 then
    error(("section:width: direction {%g, %g, %g} must not be along the wire or zero"):format(d[1],
      d[2], d[3]), 2)
  end
  local low, high = math.huge, -math.huge
  for _, p in ipairs(self.particles) do
    local at = dot(p, across) / norm
    low, high = math.min(low, at), math.max(high, at)
  end
  return high - low + 2 * self.skin
end

local chart_takes = checks.set "path name with title"

local function text_of(options, key)
  local value = options[key]
  if value ~= nil and type(value) ~= "string" then
    error(("section:chart: %s must be a string, got %s"):format(key, checks.got(value)), 0)
  end
  return value
end

local function chart(self, options)
  if type(checks.field(options, "path")) ~= "string" then
    error("section:chart takes { path = 'file.svg', name =, with = { { name, section }, ... } }", 0)
  end
  checks.keys("section:chart", options, chart_takes, 0)
  local list = { { text_of(options, "name") or ("s = %.4g m"):format(self.s), self } }
  local with = options.with == nil and {} or options.with
  if checks.kind(with) ~= "table" then
    error("section:chart: with must be a list of { name, section }, got " .. checks.got(with), 0)
  end
  for i, item in ipairs(with) do
    if type(item) ~= "table" or getmetatable(item[2]) ~= Section then
      error(("section:chart: with, item %d, must be { name, section }"):format(i), 0)
    end
    list[#list + 1] = { checks.shown(item[1]), item[2] }
  end
  return require("softworld.output.outlines").draw(options.path, list, text_of(options, "title"))
end

--- Draws its outline, with those of others over it: { path = "x.svg" | ".png" | ".pdf", name =,
-- with = { { name, section }, ... }, title = }. Returns the path.
Section.chart = build.placed(chart)

local function range(list)
  return math.min(table.unpack(list)), math.max(table.unpack(list))
end

function Section:__tostring()
  local lines = { ("section at s = %s, %d particles round it"):format(number.text(self.s, "m"),
    #self.particles) }
  local function add(name, text) lines[#lines + 1] = ("  %-16s %s"):format(name, text) end
  local function from_to(list, unit)
    local low, high = range(list)
    return ("%s to %s"):format(number.text(low, unit), number.text(high, unit))
  end
  add("width", from_to({ self.least_width, self.largest_width }, "m"))
  if self.height then add("height", number.text(self.height, "m")) end
  add("ovalisation", ("%.4g"):format(self.ovalisation))
  add("area", ("%.4g mm2"):format(1e6 * self.area))
  add("torsion", number.text(self.torsion, "rad"))
  add("twist rate", number.text(self.twist_rate, "rad/m"))
  add("axial strain", ("%.4g to %.4g"):format(range(self.axial_strain)))
  add("hoop strain", ("%.4g to %.4g"):format(range(self.hoop_strain)))
  add("axial stress", from_to(self.stress, "Pa") .. " (E times axial strain)")
  return table.concat(lines, "\n")
end

local section = class.wire.section
--- Returns a section of a wire that is a mesh of particles (model = "tube", "radial", "cubic", ...),
-- in its present state, at arc length s.
-- @tparam number s [m]
-- @treturn table `outline`, points of the surface in order {x, y, z}, and `particles`, which lie
-- `skin` inside of them [m]; `middle` [m], `tangent`, `axis` (direction of the section's own x);
-- `least_width` and `largest_width` between two parallel plates [m], with `least_direction` and
-- `largest_direction`; `width(direction)`; `height`, the width upwards [m]; `ovalisation`, (largest -
-- least)/(largest + least) of widths as in API RP 1111 (other rules take twice that), for round sections of
-- the smooth curve through the particles, so that an undeformed one has none; `area` within the surface [m2];
-- `torsion`, the section's turn about the tangent since the wire's start, beyond that of a line that is only
-- bent [rad], and `twist_rate` [rad/m], both of the present shape; for each of the `particles` `axial_strain`
-- and `hoop_strain`, and `stress` = E times axial strain, an estimate [Pa]
function class.wire.section(wire, s)
  return setmetatable(build.call(3, section, wire, s), Section)
end

for _, name in ipairs { "width", "contact_pressure", "von_mises", "max_ovalisation", "max_torsion" } do
  local read = class.wire[name]
  class.wire[name] = function(...) return build.call(3, read, ...) end
end

local calibration = class.wire.calibration
--- Returns the springs of a wire that is a mesh, as sw.calibrate gives them.
function class.wire.calibration(wire)
  local c = build.call(3, calibration, wire)
  return require("softworld.wire.calibrate").named(c, wire.model)
end

methods.guard_table("section", Section)
