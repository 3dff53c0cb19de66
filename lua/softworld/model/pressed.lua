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
local function loads_of(context, wire, values, x)
  local loads, most = {}, 0
  local spacing = values and x and #x > 3
    and ((x[4] - x[1]) ^ 2 + (x[5] - x[2]) ^ 2 + (x[6] - x[3]) ^ 2) ^ 0.5 or 0
  for k = 1, spacing > 0 and #values.contact or 0 do
    local load = values.contact[k] / spacing
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
  facts.frames(function(frame)
    local loads, top = loads_of(context, wire, frame.values[w], frame.wires[w])
    most = math.max(most, top)
    if top > 0 then seen[#seen + 1] = { loads = loads, top = top, count = #frame.values[w].contact } end
  end)
  local enough = PLACE * math.min(most, flat.stiffness(body, FLATTENED) * FLATTENED * 2 * body.radius)
  local from, to
  for _, s in ipairs(seen) do
    if s.top >= enough then from, to = reach(wire, s.loads, s.top, s.count, from, to) end
  end
  return most, from, to
end

--- The same of a wire that is a mesh in a region: of the lines beside it.
function pressed.beside(w, region)
  local most = 0
  facts.frames(function(frame)
    local values, x = frame.values[w], frame.wires[w]
    local s, n = 0, values and x and #values.contact or 0
    for k = 1, n - 1 do
      local i = 3 * k
      local step = ((x[i + 1] - x[i - 2]) ^ 2 + (x[i + 2] - x[i - 1]) ^ 2 + (x[i + 3] - x[i]) ^ 2) ^ 0.5
      local outside = s + step < region[1] or s > region[2]
      if outside and step > 0 then most = math.max(most, values.contact[k] / step) end
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
  facts.frames(function(frame)
    local values = frame.values[w]
    local count = values and #values.contact or 0
    local edge = count > 1 and wire.length / (count - 1)
    for k, force in ipairs(edge and core.frame_squeeze(context.scene, frame.number, w) or {}) do
      local both = force > TWO_SIDED * values.contact[k]
      local counts = both and not at_pads(context, wire, (k - 1) * edge, edge)
      if counts then most = math.max(most, force / edge) end
    end
  end)
  return most
end

return pressed
