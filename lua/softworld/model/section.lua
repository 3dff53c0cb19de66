-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of section: round whatever presses on it, or pressed flat. A mesh is not tried by itself: where
-- the line does not suffice, that is told.
-- @module softworld.model.section
local facts = require "softworld.model.facts"
local material = require "softworld.wire.material"
local number = require "softworld.output.number"

local POISSON = 0.4 -- of what wires are made of, where nobody says [-]

local section = { name = "section", rungs = { { name = "round", as = "round sections",
  leaves = "flattening of the section" } } }

-- Young's modulus of what is pressed [Pa], and what it is of: of a wire told by E its own, of a cable that of
-- its insulation; nil where it is not known.
local function modulus(wire)
  local entry = wire:cable()
  if not entry then
    local EA, EI, r = wire:get().EA, wire:get().EI, wire.radius
    local E = EA / (math.pi * r * r)
    local round = type(EI) == "number" and math.abs(EI - EA * r * r / 4) <= 1e-6 * EI
    return round and E or nil, "the wire"
  end
  local word = entry.construction and entry.construction.insulation
  local known = word and material.find(word)
  if known and known.E then return known.E.value, word end
end

--- By how much two faces that press on a wire with q [N/m] come nearer, over its width; and of what the
-- modulus is. Of a solid cylinder: Johnson, Contact Mechanics, 1985, section 5.6. nil: not known.
function section.flattening(wire, q)
  local E, of = modulus(wire)
  if not E then return nil end
  if q <= 0 then return 0, of end
  local r, soft = wire.radius, (1 - POISSON ^ 2) / (math.pi * E)
  local half = (4 * q * r * soft) ^ 0.5 -- of the strip that touches [m]
  return 2 * q * soft * math.max(1, 2 * math.log(4 * r / half) - 1) / (2 * r), of
end

-- Is s at pads whose grip is chosen by itself, with the edge beside?
local function at_pads(context, wire, s, spacing)
  for _, asked in ipairs(context.data.auto and context.data.auto.asked or {}) do
    local from = type(asked.s) == "number" and math.abs(s - asked.s) or 0
    if asked.wire == wire and from <= asked.gripper.pads.width / 2 + 1.5 * spacing then return true end
  end
  return false
end

-- Largest force per length of touches, of the stored frames [N/m].
local function line_load(context, wire, w)
  local most = 0
  facts.frames(function(frame)
    local values, x = frame.values[w], frame.wires[w]
    local spacing = values and x and #x > 3
      and ((x[4] - x[1]) ^ 2 + (x[5] - x[2]) ^ 2 + (x[6] - x[3]) ^ 2) ^ 0.5 or 0
    for k = 1, spacing > 0 and #values.contact or 0 do
      local load = values.contact[k] / spacing
      if load > most and not at_pads(context, wire, (k - 1) * spacing, spacing) then most = load end
    end
  end)
  return most
end

function section.look(context)
  local worst = { q = 0, share = 0 }
  for i, w in ipairs(context.data.wires) do
    if w.object.model == "rod" or w.object.model == "string" then
      local q = line_load(context, w.object, i)
      local share, of = section.flattening(w.object, q)
      if not share and q > 0 then worst.unknown = w.name end
      if share and share > worst.share then worst = { q = q, share = share, wire = w.name, of = of,
        unknown = worst.unknown } end
    end
  end
  return worst
end

function section.free(_, _, f, share)
  if f.unknown then return nil, ("how stiff the section of '%s' is, is not known: give "
    .. "E"):format(f.unknown) end
  if f.q == 0 then return "nothing presses on a wire" end
  if f.share > share then return nil end
  return ("'%s' is pressed by up to %s and flattened by %s of its width, by the modulus of %s (limit "
    .. "%s)"):format(
    f.wire, number.text(f.q, "N/m"), facts.percent(f.share), f.of, facts.percent(share))
end

function section.short(_, f, share)
  if f.unknown or f.share <= share then return nil end
  return ("'%s' is pressed by up to %s and flattened by %s of its width (limit %s): take a mesh, help "
    .. "'models'")
    :format(f.wire, number.text(f.q, "N/m"), facts.percent(f.share), facts.percent(share))
end

return section
