-- SPDX-License-Identifier: GPL-3.0-or-later
--- Was a cable pulled harder than its conductor bears? Nothing breaks; an event tells of it.
-- @module softworld.breaking
local build = require "softworld.build"
local number = require "softworld.output.number"

-- Tensile strength of soft-annealed conductors [Pa]: value, low, high. Copper as in EN 13602 (Cu-ETP
-- wire, annealed: 200 MPa and more), aluminium 1350-O.
local strengths = { copper = { 220e6, 200e6, 260e6 }, aluminium = { 75e6, 60e6, 95e6 } }

local breaking = {}

--- Breaking load of a catalogue entry [N]: { value, low, high, flag, source }, computed from its
-- conductor; nil where that is not known.
function breaking.load(entry)
  local c = entry.construction
  local strength = c and strengths[c.conductor]
  if not strength or not c.strands or not c.strand_diameter then return nil end
  local area = c.strands * math.pi / 4 * c.strand_diameter ^ 2
  return { value = strength[1] * area, low = strength[2] * area, high = strength[3] * area,
    unit = "N", flag = "computed",
    source = ("area of the %s strands times their strength"):format(c.conductor) }
end

--- Events of wires that were pulled harder in this run.
function breaking.look(scene)
  for _, w in ipairs(build.data(scene).wires) do
    local entry = w.object:cable()
    local limit = entry and breaking.load(entry)
    local pull, s, t = w.object:max_tension()
    if limit and pull > limit.value then
      scene:tell{ kind = "breaking", object = w.name, s = s, value = pull,
        text = ("wire '%s' bore %s at t = %s, more than its conductor's breaking load of about %s (%s)")
          :format(w.name, number.text(pull, "N"), number.text(t, "s"), number.text(limit.value, "N"),
            limit.flag) }
    end
  end
end

return breaking
