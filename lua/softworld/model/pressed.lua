-- SPDX-License-Identifier: GPL-3.0-or-later
--- Where wires are pressed in a run, and by how much.
-- @module softworld.model.pressed
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local flat = require "softworld.model.flat"

local pressed = {}

local PLACE = 0.1     -- of the largest load of its time: from there a place is pressed [-]
local FLATTENED = 0.1 -- no more flattening than this is needed to count [-]
local OVAL, RING = 1.5, 1.1 -- flattening over ovalisation: a solid section widens less than a ring [-]
local TWO_SIDED = 0.5 -- of the sizes of forces: what their sum lacks of them, from both sides [-]

-- Is s at pads whose grip is chosen by itself, with the edge beside?
local function at_pads(context, wire, s, spacing)
  for _, asked in ipairs(context.data.auto and context.data.auto.asked or {}) do
    local from = type(asked.s) == "number" and math.abs(s - asked.s) or 0
    if asked.wire == wire and from <= asked.gripper.pads.width / 2 + 1.5 * spacing then return true end
  end
  return false
end

-- Loads on the nodes of a line in one frame, and the largest [N/m].
local function loads_of(context, wire, forces, spacing)
  local loads, most = {}, 0
  for k, force in ipairs(spacing > 0 and forces or {}) do
    local load = force / spacing
    if load > 0 and not at_pads(context, wire, (k - 1) * spacing, spacing) then
      loads[k], most = load, math.max(most, load)
    end
  end
  return loads, most
end

-- From where to where loads of their time's largest size press on a line [m].
local function reach(wire, loads, most, count, from, to)
  local edge = wire.length / (count - 1)
  for k, load in pairs(loads) do
    if load >= PLACE * most then
      local s = (k - 1) * edge
      from = math.min(from or wire.length, math.max(0, s - edge / 2))
      to = math.max(to or 0, math.min(wire.length, s + edge / 2))
    end
  end
  return from, to
end

--- Largest force per length of touches on a line, of the stored frames [N/m], and from where to where it is
-- pressed [m]: whenever that flattens it by a tenth, or is a tenth of its largest.
function pressed.line(context, wire, w, body)
  local most, seen = 0, {}
  facts.touched(w, function(forces, spacing)
    local loads, top = loads_of(context, wire, forces, spacing)
    most = math.max(most, top)
    if top > 0 then seen[#seen + 1] = { loads = loads, top = top, count = #forces } end
  end)
  local enough = PLACE * math.min(most, flat.stiffness(body, FLATTENED) * FLATTENED * 2 * body.radius)
  local from, to
  for _, s in ipairs(seen) do
    if s.top >= enough then from, to = reach(wire, s.loads, s.top, s.count, from, to) end
  end
  return most, from, to
end

--- The same of a wire that is a mesh in a region: of the lines beside it.
function pressed.beside(scene, w, region)
  local most = 0
  facts.touched(w, function(forces, _, number)
    local s, x = 0, scene:frame(number).wires[w]
    for k = 1, #forces - 1 do
      local i = 3 * k
      local step = ((x[i + 1] - x[i - 2]) ^ 2 + (x[i + 2] - x[i - 1]) ^ 2 + (x[i + 3] - x[i]) ^ 2) ^ 0.5
      local outside = s + step < region[1] or s > region[2]
      if outside and step > 0 then most = math.max(most, forces[k] / step) end
      s = s + step
    end
  end)
  return most
end

--- By how much a mesh was flattened in the run, over its width.
function pressed.mesh(wire, body)
  local fine, oval = pcall(wire.max_ovalisation, wire)
  return fine and oval and (body.inner and RING or OVAL) * oval or 0
end

--- The largest force per length by which a line is pressed from both sides [N/m]: no line tells that force,
-- as faces that leave it no room push as hard as can be.
function pressed.squeeze(context, wire, w)
  local most = 0
  facts.touched(w, function(forces, _, number)
    local edge = wire.length / (#forces - 1)
    for k, force in ipairs(core.frame_squeeze(context.scene, number, w)) do
      local both = force > TWO_SIDED * forces[k]
      local counts = both and not at_pads(context, wire, (k - 1) * edge, edge)
      if counts then most = math.max(most, force / edge) end
    end
  end)
  return most
end

return pressed
